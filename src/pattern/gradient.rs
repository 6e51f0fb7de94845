//! `gradient <direction>`: the fractional part of the distance along a direction.

use super::{Measured, NEAR, settled};
use crate::math::Vector;
use crate::math::interval::Interval;

/// Returns the fractional part of `direction · point`, 0 … 1, for a `direction` of length 1. It is 0 at every
/// integer except 1, where it is 1: so the top of a box as high as its gradient has the last colour.
///
/// **Source:** POV-Ray manual, section "Gradient"; the value at 1 as in POV-Ray 3.7 (measured).
#[inline]
pub fn value(direction: Vector, point: Vector, error: Vector) -> Measured {
    // The direction and the sum are rounded, too.
    let error = direction.abs().dot(error + point.abs() * (4.0 * f64::EPSILON));
    let along = settled(direction.dot(point), error);
    if along == 1.0 {
        return Measured { value: 1.0, error };
    }
    let fraction = along - along.floor();
    // A tiny negative number rounds up to 1, which is outside of the half-open range.
    Measured { value: if fraction < 1.0 { fraction } else { 0.0 }, error }
}

/// Returns the range of values within `reach` of `point` along each axis.
pub fn bounds(direction: Vector, point: Vector, reach: Vector) -> Interval {
    let along = direction.dot(point);
    let far = direction.abs().dot(reach + point.abs() * (4.0 * f64::EPSILON));
    let (low, high) = ((along - far).next_down(), (along + far).next_up());
    match low.floor() == high.floor() {
        true => Interval { low: low - low.floor(), high: high - high.floor() },
        false => Interval { low: 0.0, high: 1.0 },
    }
}

/// Returns the value if it is not within [`NEAR`] of its jump.
#[inline]
pub fn value_off_seams(direction: Vector, point: Vector) -> Option<f64> {
    let along = direction.dot(point);
    let fraction = along - along.floor();
    (fraction > NEAR && fraction < 1.0 - NEAR).then_some(fraction)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rises_from_zero_to_one_in_each_unit() {
        let y = Vector::Y;
        let value = |direction, point| value(direction, point, Vector::ZERO).value;
        assert_eq!(value(y, Vector::new(9.0, 0.25, 7.0)), 0.25);
        assert_eq!(value(y, Vector::new(0.0, -0.25, 0.0)), 0.75);
        assert_eq!(value(y, Vector::new(0.0, 3.0, 0.0)), 0.0);
        assert_eq!(value(y, Vector::new(0.0, 1.0, 0.0)), 1.0);
        assert_eq!(value(y, Vector::new(0.0, -1.0, 0.0)), 0.0);
        assert!(value(y, Vector::new(0.0, -1e-30, 0.0)) < 1.0);
    }

    #[test]
    fn where_it_may_have_jumped_back_it_has() {
        let slanted = Vector::new(0.6, 0.8, 0.0);
        for off in [-1e-13, 0.0, 1e-13] {
            let seen = value(slanted, slanted * (3.0 + off), Vector::splat(1e-12));
            assert_eq!(seen.value, 0.0, "{off}");
            assert!(seen.error > 1e-12 && seen.error < 2e-12);
        }
        assert!(value(slanted, slanted * (3.0 - 1e-11), Vector::splat(1e-12)).value > 0.9);
    }
}
