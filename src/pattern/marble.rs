//! `marble`: planes across x, with veins where turbulence moves them.

use super::parameter::parameters;
use super::turbulent::{self, is_still, number, number_bounds};
use super::{Measured, NEAR, Pattern, Sample, Setting, WaveKind, sides};
use crate::math::Vector;
use crate::math::finite::finite;
use crate::math::interval::Interval;
use crate::math::wide::{Row, Rows, numbers};

parameters! {
    /// The x coordinate, plus the number of the block's turbulence.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.16 "Marble Pattern"; turbulence measured on POV-Ray 3.7.
    pub struct Marble {}
}

impl Pattern for Marble {
    const COLORS: &[(f64, [f64; 3])] =
        &[(0.0, [0.9, 0.8, 0.8]), (0.9, [0.9, 0.08, 0.08]), (0.9, [0.0; 3]), (1.0, [0.0; 3])];
    const WAVE: WaveKind = WaveKind::Triangle;
    const APPLIES_TURBULENCE: bool = true;
    const RANGE: Interval = Interval::EVERYTHING;

    fn is_exact(&self, setting: &Setting) -> bool {
        !is_still(setting)
    }

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        finite(sample.point.x + number(sample.setting, sample.point))
    }

    #[inline]
    fn measured(&self, sample: &Sample) -> Measured {
        let error = if is_still(sample.setting) { sample.error.x } else { 0.0 };
        Measured { value: self.value(sample), error }
    }

    /// Returns the value in any case: it has no seams.
    #[inline]
    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        Some(self.measured(&Sample { error: Vector::splat(0.25 * NEAR), ..*sample }))
    }

    fn values(&self, points: &Rows, mask: u32, setting: &Setting, values: &mut Row) {
        turbulent::numbers(setting, points, mask, values);
        for number in numbers(mask) {
            values[number] = finite(points.at(number).x + values[number]);
        }
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let [x, y, z] = sides(point, reach);
        match is_still(setting) {
            true => x,
            false => x + number_bounds(setting, [x, y, z]),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::pattern::Kind;
    use crate::pattern::measured::turbulent_values_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/marble.txt");
        turbulent_values_are_those_measured(Kind::of_word("marble"), table);
    }
}
