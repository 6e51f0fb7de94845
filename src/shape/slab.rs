//! Slab: what of a line lies between two planes across an axis of local space.
//!
//! A line that cannot be told from one in such a plane is inside of one, and not of the other, of two solids that
//! touch there: as if it were moved by [`NUDGE`], a way of the world that is the same for all.
//!
//! **Source:** H. Edelsbrunner, E. Mücke, "Simulation of simplicity", ACM Transactions on Graphics 9(1),
//! 1990, p. 66.

use super::U;
use super::body::{InWorld, LocalRay, Met};
use crate::math::Vector;

/// 1, ∛3 and ∛5: at right angles to no way that scenes have, not even to one turned by 30°, as 1 and √3 are.
pub(super) const NUDGE: Vector = Vector::new(1.0, 1.442_249_570_307_408_3, 1.709_975_946_676_697);

/// Whether what is moved a little from a plane comes to the side that `normal`, a way of the world, points away
/// from.
#[cold]
pub fn falls_inside(normal: Vector) -> bool {
    normal.dot(NUDGE) < 0.0
}

/// [`NUDGE`] as the body sees it.
#[cold]
pub(super) fn nudge(ray: &LocalRay) -> Vector {
    ray.in_world.map_or(NUDGE, |world| world.placed.placement.local_from_world * NUDGE)
}

/// Two planes across an axis.
pub(super) struct Slab {
    pub axis: usize,
    pub heights: [f64; 2],
    /// The body ends nearer than half of this to the local origin.
    pub far: f64,
    /// The parts that the lower and the higher are of the surface.
    pub parts: [u32; 2],
}

impl Slab {
    /// Where the line enters and leaves.
    ///
    /// **Error:** B + 2u·(far/2 + |z|) over |d.z|, with B the line's blur there. What is certainly met beyond
    /// all of the body is met nowhere; for all that is known of a line so flat, its crossing might be anywhere
    /// else beyond.
    pub fn chord(&self, ray: &LocalRay) -> Option<(Met, Met)> {
        let Self { axis, heights: [low, high], far, parts: [base, cap] } = *self;
        let (place, speed) = (ray.nearest[axis], ray.direction[axis]);
        let rounded = rounding(far, place);
        let flat_off = ray.blur_at(far) + rounded;
        let beyond = |leaving| if leaving { f64::INFINITY } else { f64::NEG_INFINITY };
        // Of two that touch the one is nudged inside, and has all that it may have; the other has nothing then, but
        // surely whatever is left. A quarter, as a ray that starts from the surface keeps off by more.
        let most = 0.25 * flat_off;
        let steep = far * speed.abs();
        let met = |end: f64, leaving| {
            let (part, way) = if end == high { (cap, 1.0) } else { (base, -1.0) };
            if steep <= most {
                let gap = way * gap(ray, axis, end);
                let falls_inside = way * nudge(ray)[axis] < 0.0;
                let room = if falls_inside { -most } else { 0.5 * most };
                if falls_inside || steep <= 0.25 * most {
                    let whole = Met { t: beyond(leaving), error: 0.0, leaving, part };
                    return (gap > room).then_some(whole);
                }
            }
            let t = (end - place) / speed;
            if (t.abs() - far) * speed.abs() > flat_off {
                return Some(Met { t: t * f64::INFINITY, error: 0.0, leaving, part });
            }
            let off = ray.blur_at(t) + rounded;
            Some(Met { t, error: off / speed.abs() + 2.0 * U * t.abs(), leaving, part })
        };
        let (near, far) = if speed > 0.0 { (low, high) } else { (high, low) };
        Some((met(near, false)?, met(far, true)?))
    }
}

/// How far a plane may be off as a line at `place` along its axis sees it.
fn rounding(far: f64, place: f64) -> f64 {
    2.0 * U * (0.5 * far + place.abs())
}

/// From a line to a plane across an axis that it goes along, as the world has it: there all that touches it has
/// the same.
#[cold]
fn gap(ray: &LocalRay, axis: usize, end: f64) -> f64 {
    let seen = ray.in_world.and_then(|InWorld { ray, placed }| {
        placed.exact.as_deref().map(|exact| (ray, &placed.placement, exact))
    });
    let Some((line, placement, exact)) = seen else { return end - ray.nearest[axis] };
    let mut place = Vector::ZERO;
    place[axis] = end;
    let way = exact.way(line.origin, place);
    let start = placement.local_point(line.origin).dot(ray.direction);
    placement.local_direction(way)[axis] + ray.direction[axis] * start
}

/// Which way along an axis, 1 or −1, a line is off a plane across it where a body has an end, no farther than 1 from
/// the local origin: in the plane, as far as rounding tells, as a [`Slab`] there has it. `holds` tells whether the
/// body is on the side of that way. `None` where the line does not go along.
#[cold]
pub(super) fn side(
    ray: &LocalRay,
    axis: usize,
    end: f64,
    holds: impl FnOnce(f64) -> bool,
) -> Option<f64> {
    let far = 2.0;
    let most = 0.25 * (ray.blur_at(far) + rounding(far, ray.nearest[axis]));
    if far * ray.direction[axis].abs() > most {
        return None;
    }
    let way = nudge(ray)[axis].signum();
    let room = if holds(way) { most } else { 0.5 * most };
    Some(if way * gap(ray, axis, end) > room { -way } else { way })
}
