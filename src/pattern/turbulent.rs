//! Turbulence for the patterns that apply it themselves.

use super::Setting;
use crate::math::Vector;
use crate::math::finite::finite;
use crate::math::interval::Interval;
use crate::math::wide::{ROW, Row, Rows};

/// Returns the number that turbulence adds to a value: its amount along x times its noise at `point`.
///
/// **Source:** measured on POV-Ray 3.7, in `marble`, `spiral1` and `spiral2`.
#[inline]
pub(super) fn number(setting: &Setting, point: Vector) -> f64 {
    match setting.amount.x == 0.0 {
        true => 0.0,
        false => setting.amount.x * finite(setting.turbulence.number(setting.noise, point)),
    }
}

/// Replaces the values by [`number`]; see [`super::Kind::values`].
pub(super) fn numbers(setting: &Setting, points: &Rows, mask: u32, values: &mut Row) {
    if setting.amount.x == 0.0 {
        *values = [0.0; ROW];
        return;
    }
    setting.turbulence.numbers(setting.noise, points, mask, values);
    for value in values {
        *value = setting.amount.x * finite(*value);
    }
}

/// Returns an interval that contains [`number`] at each point of a box.
pub(super) fn number_bounds(setting: &Setting, sides: [Interval; 3]) -> Interval {
    match setting.amount.x == 0.0 {
        true => Interval::point(0.0),
        false => {
            let number = setting.turbulence.number_bounds(setting.noise, sides);
            Interval::point(setting.amount.x) * number
        }
    }
}

/// Returns x and y of the vector noise of turbulence, without its amount.
pub(super) fn planar(setting: &Setting, point: Vector) -> [f64; 2] {
    in_plane(setting.turbulence.vector(point))
}

/// Returns x and y of turbulence, 0 where they overflow.
pub(super) fn in_plane(Vector { x, y, .. }: Vector) -> [f64; 2] {
    if x.is_finite() && y.is_finite() { [x, y] } else { [0.0; 2] }
}

/// Returns whether there is no turbulence.
#[inline]
pub(super) fn is_still(setting: &Setting) -> bool {
    setting.amount == Vector::ZERO
}
