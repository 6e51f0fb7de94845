//! Slabs: the part of a line between two planes perpendicular to an axis of local space.
//!
//! If rounding cannot separate a line from a plane in which two solids touch, the line is inside exactly one
//! of them: the one that the point lies in after moving by [`NUDGE`], a fixed direction in world space.
//!
//! **Source:** H. Edelsbrunner, E. Mücke, "Simulation of simplicity", ACM Transactions on Graphics 9(1),
//! 1990, p. 66.

use super::U;
use super::local::{InWorld, LocalRay, Met};
use crate::math::Vector;
use crate::math::placement::Rise;

/// 1, ∛3 and ∛5: not perpendicular to any direction common in scenes, including rotations by 30°, which
/// contain 1 and √3.
pub(super) const NUDGE: Vector = Vector::new(1.0, 1.442_249_570_307_408_3, 1.709_975_946_676_697);

/// Returns whether a point in a plane is on the inner side of the plane after the nudge; `normal` is the
/// outward normal in world space.
#[cold]
pub fn falls_inside(normal: Vector) -> bool {
    normal.dot(NUDGE) < 0.0
}

/// Returns [`NUDGE`] in local space.
#[cold]
pub(super) fn nudge(ray: &LocalRay) -> Vector {
    ray.in_world.map_or(NUDGE, |world| world.placed.placement.local_from_world * NUDGE)
}

/// Two planes perpendicular to an axis.
pub(super) struct Slab {
    pub axis: usize,
    pub heights: [f64; 2],
    /// Twice the distance from the local origin within which the body lies.
    pub far: f64,
    /// Error bound of the stored heights.
    pub off: f64,
    /// Part numbers of the lower and the upper plane.
    pub parts: [u32; 2],
}

impl Slab {
    /// Returns the entry and exit of the line.
    ///
    /// **Error:** B + 2u·(far/2 + |z|) over |d.z|, with B the line's blur there; for a line nearly parallel
    /// to the planes, that of [`Level`]. A crossing that is certainly beyond the body is put at ±∞.
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

    /// [`Self::chord`] for a line nearly parallel to the planes.
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

/// Lines are classified against a plane in world space where rounding may move the crossing by 1/64 of the
/// body.
pub(super) const NEARLY_ALONG: f64 = 64.0;

/// Error of a plane's position for a line at `place` along its axis.
fn rounding(far: f64, place: f64) -> f64 {
    2.0 * U * (0.5 * far + place.abs())
}

/// Position of a nearly parallel line relative to a plane, determined in world space, so that two solids that
/// touch there get the same answer.
pub(super) enum Level {
    /// In the plane, within the rounding of the ray.
    In,
    /// On one side throughout the body: above if positive, below if negative.
    Beside(f64),
    /// Crosses the plane, upward or downward.
    Through { s: f64, error: f64, rise: f64 },
}

/// Number of roundings that may be in the start and direction of a ray that was meant to lie in a plane. A
/// ray that leaves the plane at such a small slope may be classified as in it: it runs along the surface and
/// contributes no light to it.
pub(super) const MEANT: f64 = 16.0 * U;

/// Returns how far from a plane, in local space, a line classified as lying in it may be.
pub(super) fn meant(ray: &LocalRay) -> f64 {
    ray.in_world.map_or(0.0, |InWorld { ray, placed }| {
        let greatest = ray.origin.abs().max(placed.placement.centre.abs()).max_element();
        // A unit normal's components add up to √3 at most.
        placed.exact.as_deref().map_or(0.0, |exact| 1.75 * MEANT * exact.norm * greatest)
    })
}

/// Returns whether a line's start is as near to a plane, and its direction as parallel, as rounding leaves a
/// line that was meant to lie in it. This includes the ray's own rounding and that of the plane, which may be
/// `off`.
#[cold]
pub(super) fn lies_in(rise: &Rise, off: f64) -> bool {
    rise.up.abs() <= MEANT * rise.up_size + off && rise.speed.abs() <= MEANT * rise.speed_size
}

impl Level {
    /// Classifies a line for a body that extends to at most `far` and whose end may be `off`.
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

    /// Classifies a line that is `up` from the plane at `start`. **Error:** `off` over the speed, and
    /// 4u·(|start| + |s|).
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
