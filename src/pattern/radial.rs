//! `radial`: the angle around the y axis.

use std::f64::consts::TAU;

use super::parameter::parameters;
use super::{Measured, NEAR, Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::elementary::atan2;
use crate::math::finite::length;
use crate::math::interval::Interval;

parameters! {
    /// The angle around the y axis in turns, 0.25 … 1.25: from −z, where it jumps, by −x, +z and +x; so a map
    /// that repeats starts at +x. The axis itself has 0.25.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.22 "Radial Pattern"; range and jump as in POV-Ray 3.7
    /// (measured).
    pub struct Radial {}
}

/// The angle from +z towards +x, in turns, where −z is 0.
const AHEAD: f64 = 0.75;

impl Pattern for Radial {
    const COLORS: &[(f64, [f64; 3])] = &[
        (0.0, [0.0, 1.0, 1.0]),
        (0.333, [1.0, 1.0, 0.0]),
        (0.666, [1.0, 0.0, 1.0]),
        (1.0, [0.0, 1.0, 1.0]),
    ];
    const HAS_SEAMS: bool = true;
    const RANGE: Interval = Interval { low: 0.25, high: 1.25 };

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        self.measured(sample).value
    }

    #[inline]
    fn measured(&self, sample: &Sample) -> Measured {
        let Sample { point: Vector { x, z, .. }, error, .. } = *sample;
        // On the seam it has turned as far as it can.
        let is_on_seam = x.abs() <= error.x && z <= error.z;
        if is_on_seam {
            let is_on_axis = z.abs() <= error.z;
            let value = if is_on_axis { Self::RANGE.low } else { Self::RANGE.high };
            return Measured { value, error: turn_error(error.x + error.z, x, z) };
        }
        let value = AHEAD + atan2(x, z) / TAU;
        Measured { value, error: turn_error(error.x + error.z, x, z) }
    }

    /// Returns the value if the point is not within [`NEAR`] of the seam.
    #[inline]
    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        let Vector { x, z, .. } = sample.point;
        let is_off = x.abs() > NEAR || z > NEAR;
        is_off.then(|| self.measured(&Sample { error: Vector::splat(0.25 * NEAR), ..*sample }))
    }

    fn bounds(&self, point: Vector, reach: Vector, _setting: &Setting) -> Interval {
        let (low, high) = (point - reach, point + reach);
        let axis = |i: usize| Interval { low: low[i].next_down(), high: high[i].next_up() };
        let (x, z) = (axis(0), axis(2));
        if x.contains(0.0) && z.low <= 0.0 {
            return Self::RANGE;
        }
        let turns = Interval::atan2(x, z) / Interval::point(TAU) + Interval::point(AHEAD);
        let Interval { low, high } = Self::RANGE;
        Interval { low: turns.low.max(low), high: turns.high.min(high) }
    }
}

/// Returns by how many turns an angle may be off at (a, b), if the sum of the coordinates' errors is `error`.
pub(super) fn turn_error(error: f64, a: f64, b: f64) -> f64 {
    let far = TAU * length(Vector::new(a, b, 0.0));
    // Twice, as the point may be nearer to the axis than it seems.
    let turns = if error <= 0.25 * far { 2.0 * error / far } else { 1.0 };
    if error == 0.0 { 0.0 } else { turns }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Kind;
    use crate::pattern::measured::values_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/radial.txt");
        values_are_those_measured(Kind::of_word("radial"), table, 1e-13);
    }

    #[test]
    fn a_point_that_may_be_on_the_seam_is_on_it() {
        let value = |x: f64, z: f64, error: f64| {
            let (point, error) = (Vector::new(x, 5.0, z), Vector::splat(error));
            Radial {}.value(&Sample { point, error, setting: &Setting::default() })
        };
        for x in [-1e-13, -0.0, 0.0, 1e-13] {
            assert_eq!(value(x, -2.0, 1e-12), 1.25);
            assert_eq!(value(x, 2.0, 1e-12), 0.75 + x / (2.0 * TAU));
            assert_eq!(value(x, 0.0, 1e-12), 0.25);
        }
        assert_eq!(value(-0.0, -2.0, 0.0), 1.25);
        assert!(value(-1e-9, -2.0, 0.0) < 0.26);
    }
}
