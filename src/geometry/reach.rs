//! Reach: how far a solid goes along any direction, and how large the numbers are that this is made of.
//!
//! **In:** a World and a shape of it. **Out:** the least and the greatest direction·P over what is in it.
//! **Invariant:** the sums are taken in double-double arithmetic, so that a [`Reach`] is off by what rounded the
//! World's own numbers: a few roundings of its `size`.

use crate::math::double::{Double, DoubleVector};
use crate::math::{AbsDot, Matrix, UnitVector, Vector};
use crate::shape::body::Body;
use crate::shape::local::Local;
use crate::shape::{Bounds, Box_, Placed, Plane, Shape};
use crate::world::World;

/// Unit vectors whose components differ by no more may be one, each rounded where it was made.
const ONE_DIRECTION: f64 = 4.0 * f64::EPSILON;
/// Of an outline with more sides, none is a direction to look along.
const MOST_SIDES: usize = 16;

/// From the least to the greatest direction·P.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    pub low: f64,
    pub high: f64,
    /// Of the numbers that were added up: what rounding may have moved the two by is in proportion to it.
    pub size: f64,
}

impl Reach {
    pub const EVERYWHERE: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY, size: 0.0 };

    fn around(direction: Vector, centre: Vector, half: f64, half_size: f64) -> Self {
        let middle = exact_dot(direction, centre);
        let [low, high] = [-half, half].map(|end| (middle + Double::from(end)).round());
        Self { low, high, size: direction.abs_dot(centre) + half_size }
    }

    /// Of what is behind a plane: endless, but across its normal.
    pub fn of_half_space(plane: &Plane, direction: Vector) -> Self {
        let (normal, distance) = (plane.normal.get(), plane.distance);
        let is_along = |other: Vector| (other - direction).abs().max_element() <= ONE_DIRECTION;
        let size = distance.abs();
        if is_along(normal) {
            Self { high: distance, size, ..Self::EVERYWHERE }
        } else if is_along(-normal) {
            Self { low: -distance, size, ..Self::EVERYWHERE }
        } else {
            Self::EVERYWHERE
        }
    }

    /// Of a box along the axes.
    pub fn of_bounds(bounds: &Bounds, direction: Vector) -> Self {
        let mut reach = Self { low: 0.0, high: 0.0, size: 0.0 };
        for axis in 0..3 {
            let share = direction[axis];
            if share == 0.0 {
                continue;
            }
            let ends = [bounds.low[axis] * share, bounds.high[axis] * share];
            reach.low += ends[0].min(ends[1]);
            reach.high += ends[0].max(ends[1]);
            let far = ends.map(f64::abs).into_iter().filter(|end| end.is_finite());
            reach.size += far.fold(0.0, f64::max);
        }
        reach
    }

    /// Of what is inside of a shape; a plane's is a half space.
    pub fn of_shape(world: &World, shape: Shape, direction: Vector) -> Self {
        match shape {
            Shape::Plane(i) => Self::of_half_space(&world.planes[i as usize], direction),
            Shape::Sphere(i) => {
                let sphere = &world.spheres[i as usize];
                Self::around(direction, sphere.centre, sphere.radius, sphere.radius)
            }
            Shape::Box(i) => Self::of_box(&world.boxes[i as usize], direction),
            Shape::Ellipsoid(i) => {
                let placement = &world.ellipsoids[i as usize].placement;
                let half = (placement.world_from_local.transpose() * direction).length();
                let size = sum_of_sizes(&placement.world_from_local, direction);
                Self::around(direction, placement.centre, half, size)
            }
            Shape::Placed(i) => Self::of_placed(&world.placed[i as usize], direction),
        }
    }

    fn of_box(solid: &Box_, direction: Vector) -> Self {
        let normals = solid.normals.map(UnitVector::get);
        let [a, b, c] = normals.map(DoubleVector::from);
        let crosses = [b.cross(c), c.cross(a), a.cross(b)];
        let determinant = a.dot(crosses[0]);
        // The edges' error grows as the normals near one plane.
        let flatness = 1.0 / determinant.round().abs();
        let (mut half, mut size) = (Double::ZERO, 0.0);
        for (axis, cross) in crosses.into_iter().enumerate() {
            let width = solid.half_widths[axis];
            let share = DoubleVector::from(direction).dot(cross) / determinant;
            half = half + share.abs() * Double::from(width);
            size += direction.abs_dot(cross.round()) * flatness * width;
        }
        Self::around(direction, solid.centre, half.round(), size * flatness)
    }

    fn of_placed(placed: &Placed, direction: Vector) -> Self {
        let (body, placement) = (&placed.body, &placed.placement);
        // As a part it counts for what is below it, too.
        if body.reach().is_infinite() {
            return Self::EVERYWHERE;
        }
        let (low, high) = body.nearest_extent(placement.world_from_local.transpose() * direction);
        let middle = exact_dot(direction, placement.centre);
        let [low, high] = [low, high].map(|end| (middle + Double::from(end)).round());
        let size = sum_of_sizes(&placement.world_from_local, direction) * body.reach();
        Self { low, high, size: direction.abs_dot(placement.centre) + size }
    }
}

fn exact_dot(a: Vector, b: Vector) -> Double {
    DoubleVector::from(a).dot(DoubleVector::from(b))
}

fn sum_of_sizes(matrix: &Matrix, direction: Vector) -> f64 {
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    columns.into_iter().map(|column| direction.abs_dot(column)).sum()
}

/// The normals of a shape's flat faces, as far as they are no axes and not many.
pub fn slanted_faces(world: &World, shape: Shape) -> impl Iterator<Item = Vector> {
    let faces = match shape {
        Shape::Plane(i) => vec![world.planes[i as usize].normal.get()],
        Shape::Box(i) => world.boxes[i as usize].normals.map(UnitVector::get).to_vec(),
        Shape::Sphere(_) | Shape::Ellipsoid(_) => Vec::new(),
        Shape::Placed(i) => {
            let Placed { body, placement, .. } = &world.placed[i as usize];
            let normals = Vector::AXES.into_iter().chain(walls(body));
            let normals = normals.map(|local| placement.world_normal(local));
            normals.filter_map(UnitVector::from_direction).map(UnitVector::get).collect()
        }
    };
    faces.into_iter().filter(|normal| normal.is_finite() && normal.abs().max_element() < 1.0)
}

/// The normals of a prism's straight walls.
fn walls(body: &Body) -> Vec<Vector> {
    match body {
        Body::Prism(prism) if !prism.conic && prism.outline.pieces.len() <= MOST_SIDES => {
            let straight = prism.outline.pieces.iter().filter(|piece| piece.is_straight());
            let sides = straight.map(|piece| (piece.first(), piece.last()));
            sides.map(|([ax, ay], [bx, by])| Vector::new(by - ay, ax - bx, 0.0)).collect()
        }
        _ => Vec::new(),
    }
}
