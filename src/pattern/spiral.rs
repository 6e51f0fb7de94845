//! Spirals around the z axis: what `spiral1` and `spiral2` share.

use std::f64::consts::TAU;

use super::radial::turn_error;
use super::turbulent::{is_still, number, number_bounds};
use super::{NEAR, Sample, Setting, sides};
use crate::math::Vector;
use crate::math::elementary::atan2;
use crate::math::finite::{finite, length};
use crate::math::interval::Interval;

/// A point in a spiral.
pub(super) struct Place {
    /// Distance from the axis.
    pub radius: f64,
    /// z, plus the radius, plus the angle in turns times the number of arms, plus the number of turbulence.
    pub along: f64,
}

/// Returns the place of a point that turbulence has displaced. Its number is added, too.
///
/// **Source:** found by experiment on POV-Ray 3.7.
#[inline]
pub(super) fn place(arms: f64, sample: &Sample) -> Place {
    let Sample { error, setting, .. } = *sample;
    let error = if is_still(setting) { error } else { Vector::ZERO };
    let point = sample.point;
    let radius = length(Vector::new(point.x, point.y, 0.0));
    let along = point.z + radius + arms * turns(point, error) + number(setting, point);
    Place { radius, along: finite(along) }
}

/// Returns the error of [`Place::along`]: 0 with turbulence, as maps need not know it there.
#[inline]
pub(super) fn error(arms: f64, sample: &Sample) -> f64 {
    let Sample { point, error, setting } = *sample;
    if !is_still(setting) {
        return 0.0;
    }
    let arms = arms.abs();
    let across = error.x + error.y;
    let rounding = (point.abs().element_sum() + arms) * (4.0 * f64::EPSILON);
    error.z + across + arms * turn_error(across, point.x, point.y) + rounding
}

/// Returns the angle around the axis from −y by +x, +y and −x, 0 … 1; 0 on the axis.
///
/// It jumps at −y: a point that may be there is there.
#[inline]
fn turns(point: Vector, error: Vector) -> f64 {
    let Vector { x, y, .. } = point;
    if x.abs() <= error.x && y <= error.y {
        return 0.0;
    }
    let turns = atan2(x, -y) / TAU;
    if turns < 0.0 { turns + 1.0 } else { turns }
}

/// Returns whether no error less than [`NEAR`] / 4 moves a point across −y.
#[inline]
pub(super) fn is_off_seam(sample: &Sample) -> bool {
    let Vector { x, y, .. } = sample.point;
    x.abs() > NEAR || y > NEAR || !is_still(sample.setting)
}

/// Returns intervals that contain the radius and `along` at each point within `reach` of `point`.
pub(super) fn bounds(arms: f64, point: Vector, reach: Vector, setting: &Setting) -> [Interval; 2] {
    let (low, high) = (point - reach, point + reach);
    let everything = [Interval { low: 0.0, high: f64::INFINITY }, Interval::EVERYTHING];
    // Beyond, squares may overflow.
    if low.min(-high).min_element() < -1e100 {
        return everything;
    }
    let [x, y, z] = sides(point, reach);
    let radius = (x.square() + y.square()).sqrt();
    // Below, squares lose digits.
    let radius = match radius.low > 1e-100 {
        true => radius,
        false => Interval { low: 0.0, high: radius.high.max(2e-100) },
    };
    let per_turn = Interval::point(TAU);
    let turns = if y.low > 0.0 {
        Interval::point(0.5) - Interval::atan2(x, y) / per_turn
    } else if x.low > 0.0 {
        Interval::atan2(x, -y) / per_turn
    } else if x.high < 0.0 {
        Interval::atan2(x, -y) / per_turn + Interval::point(1.0)
    } else {
        Interval { low: 0.0, high: 1.0 }
    };
    let turns = Interval { low: turns.low - 1e-15, high: turns.high + 1e-15 };
    let along = z + radius + turns * Interval::point(arms) + number_bounds(setting, [x, y, z]);
    // The order of the sum differs, at most, by its rounding.
    let size = z.abs().high + radius.high + arms.abs();
    let off = size * (4.0 * f64::EPSILON);
    [radius, Interval { low: along.low - off, high: along.high + off }]
}

/// Returns the number of arms as POV-Ray 3.7 counts them: truncated, and wrapped to 16 bits (measured).
pub(super) fn whole_arms(arms: f64) -> f64 {
    f64::from(arms as i64 as i16)
}
