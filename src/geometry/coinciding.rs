//! Parts of one solid whose surfaces coincide: what other tracers draw as speckles.
//!
//! **In:** a [`World`]. **Out:** pairs of its objects. **Invariant:** found as rays find it: a line crosses
//! both at places that their error bounds cannot tell apart. Each part is tried by lines along its own three
//! axes, so that none of its faces is missed for being small, and askew, so that no line runs in a face.
//! What coincides only in a small part of both surfaces may be missed; what is told is so.

use std::collections::BTreeSet;

use super::whole::Whole;
use super::{Geometry, Solid};
use crate::math::random::Random;
use crate::math::{UnitVector, Vector};
use crate::shape::local::{Local, Met};
use crate::shape::{Box_, Placed, Ray};
use crate::world::World;

/// So many lines along each axis of a part.
const LINES: usize = 8;
/// How far from its axis a line may be turned.
const ASKEW: f64 = 0.1;
/// What lines aim at is inside of a part's hull, and not on it.
const INNER: f64 = 0.95;
/// Parts that are compared with one where a line crosses that: of many that all lie around each other, not each pair
/// is.
const MOST_OTHERS: usize = 256;

/// Of each part, the first declared with which it shares a surface; as two objects, the first one first.
pub fn coinciding_parts(world: &World) -> Vec<[u32; 2]> {
    let geometry = Geometry::build(world);
    let mut pairs = BTreeSet::new();
    for whole in &geometry.wholes {
        for (leaf, entry) in (0..).zip(&whole.leaves) {
            let other = geometry.hull(&entry.solid).and_then(|hull| {
                let mut random = Random::of(29, entry.object.into());
                let lines = (0..3 * LINES).filter_map(|line| hull.line(line % 3, &mut random));
                lines.filter_map(|line| geometry.partner(whole, leaf, &line)).min()
            });
            let objects = other.map(|other| [leaf.min(other), leaf.max(other)]);
            pairs.extend(objects.map(|both| both.map(|leaf| whole.leaves[leaf as usize].object)));
        }
    }
    pairs.into_iter().collect()
}

/// A centre, and three vectors from there to the middles of faces that hold a solid.
struct Hull {
    centre: Vector,
    axes: [Vector; 3],
}

impl Hull {
    /// About along an axis, through a place inside.
    fn line(&self, axis: usize, random: &mut Random) -> Option<Ray> {
        let mut inside = |reach: f64| {
            let shares = [0; 3].map(|_| random.number(-reach, reach));
            (0..3).fold(Vector::ZERO, |sum, i| sum + self.axes[i] * shares[i])
        };
        let origin = self.centre + inside(INNER);
        let direction = UnitVector::from_direction(self.axes[axis] + inside(ASKEW))?.get();
        Some(Ray { origin, direction })
    }
}

impl Geometry {
    /// `None` of what has no end.
    fn hull(&self, solid: &Solid) -> Option<Hull> {
        let axes = [Vector::X, Vector::Y, Vector::Z];
        match solid {
            Solid::Sphere(sphere) => {
                Some(Hull { centre: sphere.centre, axes: axes.map(|axis| axis * sphere.radius) })
            }
            Solid::Ellipsoid(i) => {
                let placement = &self.ellipsoids[*i as usize].placement;
                let axes = axes.map(|axis| placement.world_from_local * axis);
                Some(Hull { centre: placement.centre, axes })
            }
            Solid::Box(i) => Some(hull_of_box(&self.boxes[*i as usize].0)),
            Solid::Placed(i) => hull_of_placed(&self.placed[*i as usize]),
            // A whole's leaves are no wholes.
            Solid::Plane(_) | Solid::Whole(_) => None,
        }
    }

    /// The first of the other leaves whose surface a line crosses where it crosses that of `leaf`.
    fn partner(&self, whole: &Whole, leaf: u32, line: &Ray) -> Option<u32> {
        let seen = |met: &Met| met.is_seen() && met.t.is_finite();
        let mut first: Option<u32> = None;
        for own in
            self.crossings(&whole.leaves[leaf as usize].solid, line).iter().filter(|own| seen(own))
        {
            let mut looked = 0;
            // Their boxes are rounded outward.
            whole.search_within(line, (own.t - own.error, own.t + own.error), |other| {
                if other == leaf
                    || first.is_some_and(|first| first < other)
                    || looked == MOST_OTHERS
                {
                    return;
                }
                looked += 1;
                let others = self.crossings(&whole.leaves[other as usize].solid, line);
                let meets = |met: &Met| (own.t - met.t).abs() <= own.error + met.error;
                if others.iter().any(|met| seen(met) && meets(met)) {
                    first = Some(other);
                }
            });
        }
        first
    }
}

fn hull_of_box(solid: &Box_) -> Hull {
    let axes = [0, 1, 2].map(|axis| solid.face(axis).centre - solid.centre);
    Hull { centre: solid.centre, axes }
}

fn hull_of_placed(Placed { body, placement, .. }: &Placed) -> Option<Hull> {
    let ends = [Vector::X, Vector::Y, Vector::Z].map(|axis| body.extent(axis));
    let middle = Vector::from_array(ends.map(|(low, high)| 0.5 * low + 0.5 * high));
    let half = ends.map(|(low, high)| 0.5 * high - 0.5 * low);
    let axes = [0, 1, 2].map(|i| placement.world_from_local.col(i) * half[i]);
    let centre = placement.centre + placement.world_from_local * middle;
    axes.iter().all(|axis| axis.is_finite()).then_some(Hull { centre, axes })
}
