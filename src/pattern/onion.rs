//! `onion`: the fractional part of the distance from the origin.

use super::parameter::parameters;
use super::{Measured, NEAR, Pattern, Sample, Setting, settled};
use crate::math::Vector;
use crate::math::finite::length;
use crate::math::interval::Interval;

parameters! {
    /// The fractional part of the distance from the origin; 0 at every integer.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.17 "Onion Pattern"; the value at 1 as in POV-Ray 3.7
    /// (measured).
    pub struct Onion {}
}

impl Pattern for Onion {
    const HAS_SEAMS: bool = true;

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        self.measured(sample).value
    }

    #[inline]
    fn measured(&self, sample: &Sample) -> Measured {
        let distance = length(sample.point);
        let error = length(sample.error) + distance * (4.0 * f64::EPSILON);
        // Without an error from outside, a point is where it is.
        let off = if sample.error == Vector::ZERO { 0.0 } else { error };
        let along = settled(distance, off);
        Measured { value: along - along.floor(), error }
    }

    /// Returns the value if it is not within [`NEAR`] of its jump.
    #[inline]
    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        let distance = length(sample.point);
        let value = distance - distance.floor();
        (value > NEAR && value < 1.0 - NEAR).then_some(Measured { value, error: NEAR })
    }

    fn bounds(&self, point: Vector, reach: Vector, _setting: &Setting) -> Interval {
        let distance = length(point);
        let far = length(reach) + distance * (8.0 * f64::EPSILON);
        let (low, high) = ((distance - far).max(0.0), (distance + far).next_up());
        match low.floor() == high.floor() {
            true => Interval { low: low - low.floor(), high: high - high.floor() },
            false => Self::RANGE,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Kind;
    use crate::pattern::measured::values_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/onion.txt");
        values_are_those_measured(Kind::of_word("onion"), table, 1e-14);
    }

    #[test]
    fn where_it_may_have_jumped_back_it_has() {
        let value = |distance: f64, error: f64| {
            let point = Vector::new(0.48, 0.64, 0.6) * distance;
            let error = Vector::splat(error);
            Onion {}.value(&Sample { point, error, setting: &Setting::default() })
        };
        for off in [-1e-13, 0.0, 1e-13] {
            assert_eq!(value(3.0 + off, 1e-12), 0.0, "{off}");
        }
        assert!(value(3.0 - 1e-11, 1e-12) > 0.9);
        assert!(value(3.0 - 1e-13, 0.0) > 0.9);
    }
}
