//! `leopard`: a regular arrangement of round spots.

use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::elementary::sin;
use crate::math::interval::Interval;

parameters! {
    /// The square of the mean of the coordinates' sines, 0 … 1.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.15 "Leopard Pattern".
    pub struct Leopard {}
}

impl Pattern for Leopard {
    fn value(&self, sample: &Sample) -> f64 {
        let Vector { x, y, z } = sample.point;
        let mean = (sin(x) + sin(y) + sin(z)) / 3.0;
        mean * mean
    }

    fn bounds(&self, point: Vector, reach: Vector, _setting: &Setting) -> Interval {
        let (low, high) = (point - reach, point + reach);
        if !low.is_finite() || !high.is_finite() {
            return Self::RANGE;
        }
        let sine =
            |i: usize| Interval::sin(Interval { low: low[i].next_down(), high: high[i].next_up() });
        let mean = (sine(0) + sine(1) + sine(2)) / Interval::point(3.0);
        let square = mean.square();
        Interval { low: square.low.min(1.0), high: square.high.min(1.0) }
    }
}

#[cfg(test)]
mod tests {
    use crate::pattern::Kind;
    use crate::pattern::measured::values_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/leopard.txt");
        values_are_those_measured(Kind::of_word("leopard"), table, 1e-14);
    }
}
