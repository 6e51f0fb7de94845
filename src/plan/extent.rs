//! Measures the size of a solid, and how thin it is in relation to its length.
//!
//! **Invariant:** shapes that are flat by nature (polygons, patches, height fields) count as thin if they
//! are nearly a line, not because they are flat.

use crate::math::singular::singular_values;
use crate::math::{Matrix, Vector};
use crate::shape::local::Local;
use crate::shape::{Body, Placed, Shape};
use crate::world::World;

/// Size of a bounded shape.
pub(super) struct Extent {
    pub centre: Vector,
    /// Least and greatest half width along the axes of the shape's own frame; never 0.
    pub least: f64,
    pub greatest: f64,
    /// Ratio of length to thickness.
    pub slenderness: f64,
}

impl Extent {
    pub fn of(world: &World, shape: Shape) -> Option<Self> {
        let along_axes = |centre, least: f64, greatest| {
            Some(Self { centre, least, greatest, slenderness: greatest / least })
        };
        match shape {
            Shape::Sphere(at) => {
                let sphere = &world.spheres[at as usize];
                along_axes(sphere.centre, sphere.radius, sphere.radius)
            }
            Shape::Ellipsoid(at) => {
                let placement = &world.ellipsoids[at as usize].placement;
                let [greatest, _, least] = singular_values(placement.world_from_local);
                along_axes(placement.centre, least, greatest)
            }
            Shape::Box(at) => {
                let solid = &world.boxes[at as usize];
                // Ignores the zero side of a flat box.
                let sides = solid.half_widths.into_iter().filter(|&side| side > 0.0);
                let least = sides.clone().fold(f64::INFINITY, f64::min);
                along_axes(solid.centre, least, sides.fold(0.0, f64::max))
            }
            Shape::Placed(at) => Self::placed(&world.placed[at as usize]),
            Shape::Plane(_) => None,
        }
    }

    fn placed(Placed { body, placement, .. }: &Placed) -> Option<Self> {
        let axes = [Vector::X, Vector::Y, Vector::Z];
        let extents = axes.map(|axis| body.nearest_extent(axis));
        if !extents.into_iter().all(|(low, high)| (0.5 * high - 0.5 * low).is_finite()) {
            return None;
        }
        let middle = Vector::from_array(extents.map(|(low, high)| 0.5 * low + 0.5 * high));
        let centre = placement.centre + placement.world_from_local * middle;
        let half_widths = |frame: [Vector; 3]| {
            let [x, y, z] =
                frame.map(|way| placement.world_from_local * way * half_width(body, way));
            singular_values(Matrix::from_cols(x, y, z))
        };
        let is_sheet = match **body {
            Body::Mesh(_) => false,
            Body::Disc(_) => true,
            _ => body.is_sheet(),
        };
        let is_flat = is_sheet || matches!(**body, Body::HeightField(_));
        // Sheets have only two relevant sizes.
        let least_of = |sizes: [f64; 3], is_flat: bool| {
            let counted = if is_flat { 2 } else { 3 };
            sizes.into_iter().take(counted).rfind(|&half| half > 0.0)
        };
        let along_axes = half_widths(axes);
        let least = least_of(along_axes, is_sheet)?;
        let mut slenderness = along_axes[0] / least_of(along_axes, is_flat)?;
        if let Some(along) = frame_along(body).map(half_widths) {
            slenderness = slenderness.max(along[0] / along[if is_flat { 1 } else { 2 }]);
        }
        match &**body {
            Body::Disc(disc) => slenderness = slenderness.max(2.0 / (1.0 - disc.hole)),
            Body::SphereSweep(sweep) => slenderness = slenderness.max(sweep.slenderness()),
            _ => {}
        }
        Some(Self { centre, least, greatest: along_axes[0], slenderness })
    }
}

fn half_width(body: &Body, along: Vector) -> f64 {
    let (low, high) = body.nearest_extent(along);
    0.5 * high - 0.5 * low
}

/// Returns an orthogonal frame for a body whose own axes do not reveal its length. If the body is nearly a
/// line, the first direction runs along it.
fn frame_along(body: &Body) -> Option<[Vector; 3]> {
    let along = |u: Vector, v: Vector| {
        let (a, b) = (half_width(body, u), half_width(body, v));
        let b = if half_width(body, u + v) < half_width(body, u - v) { -b } else { b };
        (u * a + v * b).normalize_or(u)
    };
    match body {
        Body::Polygon(_) | Body::Prism(_) => {
            let first = along(Vector::X, Vector::Y);
            Some([first, Vector::Z.cross(first), Vector::Z])
        }
        Body::BicubicPatch(_) => {
            let level = along(Vector::X, Vector::Y);
            let aside = Vector::Z.cross(level);
            let first = along(level, Vector::Z);
            let second = along(aside, first.cross(aside));
            Some([first, second, first.cross(second)])
        }
        _ => None,
    }
}
