//! `boxed`: falls from the origin to the sides of a cube.

use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

/// More than the rounding errors of values.
const ROUNDED: f64 = 8.0 * f64::EPSILON;

parameters! {
    /// 1 at the origin, falling evenly to 0 on the cube from <-1, -1, -1> to <1, 1, 1>; 0 beyond.
    ///
    /// **Source:** POV-Ray manual, section "Boxed Pattern"; checked on POV-Ray 3.7.
    pub struct Boxed {}
}

impl Pattern for Boxed {
    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        1.0 - sample.point.abs().max_element().min(1.0)
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let value = self.value(&Sample { point, error: Vector::ZERO, setting });
        let far = reach.max_element() + ROUNDED;
        Interval { low: (value - far).max(0.0), high: (value + far).min(1.0) }
    }
}

#[cfg(test)]
mod tests {
    use crate::pattern::{Kind, measured};

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/boxed.txt");
        measured::values_are_those_measured(Kind::of_word("boxed"), table, 1e-15);
    }
}
