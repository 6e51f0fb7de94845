//! `square`: square rods along y in four kinds, in blocks of two by two.

use super::lattice::{cell, cell_off_seams, remainder};
use super::parameter::parameters;
use super::{Measured, Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// 0 in the unit square of the x-z plane that starts at the origin, and then, around the point (1, 1): 1
    /// beyond it along z, 2 across from it, and 3 beyond it along x.
    ///
    /// **Source:** POV-Ray manual, section "Square Pattern"; measured on POV-Ray 3.7.
    pub struct Square {}
}

/// Returns the value in the square with these lower ends.
fn kind(x: f64, z: f64) -> f64 {
    match (remainder(x, 2), remainder(z, 2)) {
        (0, 0) => 0.0,
        (0, _) => 1.0,
        (_, 0) => 3.0,
        _ => 2.0,
    }
}

impl Pattern for Square {
    const COLORS: &[(f64, [f64; 3])] = &[
        (0.0, [1.0, 0.0, 0.0]),
        (1.0, [0.0, 1.0, 0.0]),
        (2.0, [0.0, 0.0, 1.0]),
        (3.0, [1.0, 1.0, 0.0]),
    ];
    const LIST: Option<usize> = Some(4);
    const HAS_SEAMS: bool = true;
    const RANGE: Interval = Interval { low: 0.0, high: 3.0 };

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        let Sample { point, error, .. } = *sample;
        kind(cell(point.x, error.x), cell(point.z, error.z))
    }

    #[inline]
    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        let value = kind(cell_off_seams(sample.point.x)?, cell_off_seams(sample.point.z)?);
        Some(Measured { value, error: 0.0 })
    }

    fn bounds(&self, point: Vector, reach: Vector, _setting: &Setting) -> Interval {
        let (low, high) = ((point - reach).floor(), (point + reach).floor());
        let is_one = low.x == high.x && low.z == high.z;
        if is_one { Interval::point(kind(low.x, low.z)) } else { Self::RANGE }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{Kind, measured};

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/square.txt");
        measured::values_are_those_measured(Kind::of_word("square"), table, 0.0);
    }

    #[test]
    fn squares_contain_their_lower_sides() {
        let setting = Setting::default();
        let value = |x, z, error| {
            let (point, error) = (Vector::new(x, 7.3, z), Vector::splat(error));
            Square {}.value(&Sample { point, error, setting: &setting })
        };
        for off in [-9e-13, 0.0, 9e-13] {
            assert_eq!(value(1.0 + off, 0.5, 1e-12), 3.0);
            assert_eq!(value(0.5, -1.0 + off, 1e-12), 1.0);
        }
        assert_eq!(value(1.0 - 1e-9, 0.5, 1e-12), 0.0);
    }
}
