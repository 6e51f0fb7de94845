//! `checker`: unit cubes of two kinds, alternating along every axis.
//!
//! A cell is half-open: a point on a lattice plane belongs to the cell on its positive side.

use super::parameter::parameters;
use super::{Measured, NEAR, Pattern, Sample, Setting, settled};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// 0 in the cell that starts at the origin, 1 in its six neighbours, and so on.
    pub struct Checker {}
}

impl Pattern for Checker {
    const COLORS: &[(f64, [f64; 3])] = &[(0.0, [0.0, 0.0, 1.0]), (1.0, [0.0, 1.0, 0.0])];
    const LIST: Option<usize> = Some(2);
    const HAS_SEAMS: bool = true;

    /// Exact for coordinates up to 2⁵³; beyond, every number is even and the value is constant.
    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        // Parities are added, not indices: the sum of three large indices would round.
        let parity = |coordinate: f64, error: f64| {
            let half = settled(coordinate, error).floor() * 0.5;
            half != half.floor()
        };
        let Sample { point, error, .. } = *sample;
        let [x, y, z] = [(point.x, error.x), (point.y, error.y), (point.z, error.z)];
        f64::from(parity(x.0, x.1) ^ parity(y.0, y.1) ^ parity(z.0, z.1))
    }

    /// Returns the value if each coordinate is either an integer or not within [`NEAR`] of one: then no
    /// smaller error changes it.
    #[inline]
    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        // The sum is rounded to a whole number; its last bit says whether that is odd.
        let parity = |coordinate: f64| {
            let sum = coordinate + WHOLE;
            let off = coordinate - (sum - WHOLE);
            let is_told = off == 0.0 || off.abs() > NEAR;
            is_told.then_some((sum.to_bits() & 1 == 1) ^ (off < 0.0))
        };
        let point = sample.point;
        let value = f64::from(parity(point.x)? ^ parity(point.y)? ^ parity(point.z)?);
        Some(Measured { value, error: 0.0 })
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let (low, high) = ((point - reach).floor(), (point + reach).floor());
        match low == high {
            true => Interval::point(self.value(&Sample { point, error: Vector::ZERO, setting })),
            false => Self::RANGE,
        }
    }
}

/// 3·2⁵¹: numbers near it are integers.
const WHOLE: f64 = 1.5 / f64::EPSILON;

#[cfg(test)]
mod tests {
    use super::*;

    fn value_within(point: Vector, error: Vector) -> f64 {
        Checker {}.value(&Sample { point, error, setting: &Setting::default() })
    }

    fn value(point: Vector) -> f64 {
        value_within(point, Vector::ZERO)
    }

    #[test]
    fn neighbours_differ_and_cells_are_half_open() {
        assert_eq!(value(Vector::new(0.0, 0.0, 0.0)), 0.0);
        assert_eq!(value(Vector::new(-1e-9, 0.0, 0.0)), 1.0);
        assert_eq!(value(Vector::new(1.0, 0.5, 0.5)), 1.0);
        assert_eq!(value(Vector::new(1.5, -0.5, 0.5)), 0.0);
    }

    #[test]
    fn cells_beyond_two_to_the_31_still_alternate() {
        let far = 4_503_599_627_370_497.0; // 2^52 + 1
        assert_eq!(value(Vector::new(far, 0.0, 0.0)), 1.0);
        assert_eq!(value(Vector::new(far - 1.0, 0.0, 0.0)), 0.0);
    }

    #[test]
    fn a_point_that_may_be_on_a_seam_is_in_the_cell_on_its_positive_side() {
        let error = Vector::splat(1e-12);
        for off in [-9e-13, 0.0, 9e-13] {
            assert_eq!(value_within(Vector::new(2.0 + off, 0.5, 0.5), error), 0.0, "{off}");
            assert_eq!(value_within(Vector::new(0.5, 0.5, -3.0 + off), error), 1.0, "{off}");
        }
        // Farther off it is where it is.
        assert_eq!(value_within(Vector::new(2.0 - 2e-12, 0.5, 0.5), error), 1.0);
    }
}
