//! `planar`: falls with the distance from the x-z plane.

use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

/// More than the rounding errors of values.
const ROUNDED: f64 = 8.0 * f64::EPSILON;

parameters! {
    /// 1 on the x-z plane, falling evenly to 0 at a distance of 1; 0 beyond.
    ///
    /// **Source:** POV-Ray manual, section "Planar Pattern"; checked on POV-Ray 3.7.
    pub struct Planar {}
}

impl Pattern for Planar {
    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        1.0 - sample.point.y.abs().min(1.0)
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let value = self.value(&Sample { point, error: Vector::ZERO, setting });
        let far = reach.y + ROUNDED;
        Interval { low: (value - far).max(0.0), high: (value + far).min(1.0) }
    }
}

#[cfg(test)]
mod tests {
    use crate::pattern::{Kind, measured};

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/planar.txt");
        measured::values_are_those_measured(Kind::of_word("planar"), table, 1e-15);
    }
}
