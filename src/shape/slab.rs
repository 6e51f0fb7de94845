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
use crate::math::placement::Rise;

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
    /// How far the heights may be off, as the body holds them.
    pub off: f64,
    /// The parts that the lower and the higher are of the surface.
    pub parts: [u32; 2],
}

impl Slab {
    /// Where the line enters and leaves.
    ///
    /// **Error:** B + 2u·(far/2 + |z|) over |d.z|, with B the line's blur there; of a line that goes nearly along,
    /// that of [`Level`]. What is certainly met beyond all of the body is met nowhere.
    pub fn chord(&self, ray: &LocalRay) -> Option<(Met, Met)> {
        let Self { axis, heights: [low, high], far, parts: [base, cap], .. } = *self;
        let (place, speed) = (ray.nearest[axis], ray.direction[axis]);
        let rounded = rounding(far, place);
        let flat_off = ray.blur_at(far) + rounded;
        if far * speed.abs() <= NEARLY_ALONG * flat_off {
            return self.chord_along(ray);
        }
        let met = |end: f64, part, leaving| {
            let t = (end - place) / speed;
            if (t.abs() - far) * speed.abs() > flat_off {
                return Met { t: t * f64::INFINITY, error: 0.0, leaving, part };
            }
            let off = ray.blur_at(t) + rounded;
            Met { t, error: off / speed.abs() + 2.0 * U * t.abs(), leaving, part }
        };
        Some(match speed > 0.0 {
            true => (met(low, base, false), met(high, cap, true)),
            false => (met(high, cap, false), met(low, base, true)),
        })
    }

    /// Of a line that goes nearly along the planes.
    #[cold]
    #[inline(never)]
    fn chord_along(&self, ray: &LocalRay) -> Option<(Met, Met)> {
        let Self { axis, heights: [low, high], far, off, parts: [base, cap] } = *self;
        let beyond = |t, leaving, part| Met { t, error: 0.0, leaving, part };
        let mut enter = beyond(f64::NEG_INFINITY, false, base);
        let mut leave = beyond(f64::INFINITY, true, cap);
        for (end, part, out) in [(low, base, -1.0), (high, cap, 1.0)] {
            match Level::of(ray, axis, end, (far, off)) {
                Level::In if out * nudge(ray)[axis] < 0.0 => {}
                Level::Beside(side) if out * side < 0.0 => {}
                Level::In | Level::Beside(_) => return None,
                Level::Through { s: t, error, rise } => {
                    let leaving = out * rise > 0.0;
                    let met = Met { t, error, leaving, part };
                    *(if leaving { &mut leave } else { &mut enter }) = met;
                }
            }
        }
        Some((enter, leave))
    }
}

/// A line is asked how it lies to a plane in the world where rounding may move its crossing by a
/// sixty-fourth of the body.
pub(super) const NEARLY_ALONG: f64 = 64.0;

/// How far a plane may be off as a line at `place` along its axis sees it.
fn rounding(far: f64, place: f64) -> f64 {
    2.0 * U * (0.5 * far + place.abs())
}

/// How a line that goes nearly along a plane lies to it, as the world has it: of two solids that touch there, both
/// are told the same.
pub(super) enum Level {
    /// In the plane, as far as is known of a ray whose numbers were rounded.
    In,
    /// As far as the body goes, up from it or down, by the sign.
    Beside(f64),
    /// It goes through the plane, up or down.
    Through { s: f64, error: f64, rise: f64 },
}

/// So many roundings may be behind the start and the direction of a ray that was meant to lie in a plane. One that
/// leaves the plane by so small a slope may be told to be in it: it goes along the surface, and brings it no light.
const MEANT: f64 = 16.0 * U;

/// How far from a plane a line may be that is told to lie in it, as the body sees it.
pub(super) fn meant(ray: &LocalRay) -> f64 {
    ray.in_world.map_or(0.0, |InWorld { ray, placed }| {
        let greatest = ray.origin.abs().max(placed.placement.centre.abs()).max_element();
        // A unit normal's components add up to √3 at most.
        placed.exact.as_deref().map_or(0.0, |exact| 1.75 * MEANT * exact.norm * greatest)
    })
}

/// Whether a line starts as near to a plane, and goes as level, as rounding makes them of one that was meant to lie
/// there: the ray's own rounding, and that of the plane, which may be `off`.
#[cold]
pub(super) fn lies_in(rise: &Rise, off: f64) -> bool {
    rise.up.abs() <= MEANT * rise.up_size + off && rise.speed.abs() <= MEANT * rise.speed_size
}

impl Level {
    /// Of a body that goes no farther than `far`, whose end may be `off`.
    #[cold]
    pub fn of(ray: &LocalRay, axis: usize, end: f64, (far, off): (f64, f64)) -> Self {
        let in_world = ray.in_world.and_then(|InWorld { ray, placed }| {
            placed.exact.as_deref().map(|exact| (ray, &placed.placement, exact))
        });
        let Some((line, placement, exact)) = in_world else {
            let (up, speed) = (ray.nearest[axis] - end, ray.direction[axis]);
            let off = ray.blur_at(far) + rounding(far, ray.nearest[axis]);
            let is_in = up.abs() <= 0.25 * off && far * speed.abs() <= off;
            return if is_in {
                Self::In
            } else {
                Self::beside_or_through(up, speed, 0.0, (far, off))
            };
        };
        let rise = exact.rise(axis, end, line.origin, line.direction);
        let start = placement.local_point(line.origin).dot(ray.direction);
        let step = placement.local_direction(line.direction).length();
        match lies_in(&rise, off) {
            true => Self::In,
            false => Self::beside_or_through(rise.up, rise.speed / step, start, (far, off)),
        }
    }

    /// Of a line that is `up` from the plane at `start`. **Error:** `off` over the speed, and 4u·(|start| + |s|).
    fn beside_or_through(up: f64, speed: f64, start: f64, (far, off): (f64, f64)) -> Self {
        // What could as well not rise at all is judged where it is nearest.
        if far * speed.abs() <= off {
            return Self::Beside(up - speed * start);
        }
        let s = start - up / speed;
        let error = off / speed.abs() + 4.0 * U * (start.abs() + s.abs());
        match s.abs() - error <= far {
            true => Self::Through { s, error, rise: speed },
            false => Self::Beside(-s * speed),
        }
    }
}
