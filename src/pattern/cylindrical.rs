//! `cylindrical`: falls with the distance from the y axis.

use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

/// More than the rounding errors of values.
const ROUNDED: f64 = 8.0 * f64::EPSILON;

parameters! {
    /// 1 on the y axis, falling evenly to 0 at a distance of 1; 0 beyond.
    ///
    /// **Source:** POV-Ray manual, section "Cylindrical Pattern"; checked on POV-Ray 3.7.
    pub struct Cylindrical {}
}

impl Pattern for Cylindrical {
    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        1.0 - (sample.point.x * sample.point.x + sample.point.z * sample.point.z).sqrt().min(1.0)
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let value = self.value(&Sample { point, error: Vector::ZERO, setting });
        let far = (reach.x * reach.x + reach.z * reach.z).sqrt() + ROUNDED;
        Interval { low: (value - far).max(0.0), high: (value + far).min(1.0) }
    }
}

#[cfg(test)]
mod tests {
    use crate::pattern::{Kind, measured};

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/cylindrical.txt");
        measured::values_are_those_measured(Kind::of_word("cylindrical"), table, 1e-15);
    }
}
