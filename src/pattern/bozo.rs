//! `bozo`: smooth noise.

use super::layers::{noise_bounds, noise_slopes};
use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::{Row, Rows};
use crate::noise::{noise, noises};

parameters! {
    /// The noise of the block's generator, 0 … 1.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.3 "Bozo Pattern"; measured on POV-Ray 3.7.
    pub struct Bozo {}
}

impl Pattern for Bozo {
    const COST: &str = "one noise a point";
    const COLORS: &[(f64, [f64; 3])] = &[
        (0.0, [1.0, 1.0, 1.0]),
        (0.4, [1.0, 1.0, 1.0]),
        (0.4, [0.0, 1.0, 0.0]),
        (0.6, [0.0, 1.0, 0.0]),
        (0.6, [0.0, 0.0, 1.0]),
        (0.8, [0.0, 0.0, 1.0]),
        (0.8, [1.0, 0.0, 0.0]),
        (1.0, [1.0, 0.0, 0.0]),
    ];
    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        noise(sample.setting.noise, sample.point)
    }

    fn values(&self, points: &Rows, mask: u32, setting: &Setting, values: &mut Row) {
        noises(setting.noise, points, mask, values);
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        noise_bounds(setting.noise, point, reach)
    }

    fn sloped(
        &self,
        point: Vector,
        reach: Vector,
        setting: &Setting,
    ) -> Option<(Interval, [Interval; 3])> {
        Some(noise_slopes(setting.noise, point, reach))
    }
}

#[cfg(test)]
mod tests {
    use crate::pattern::Kind;
    use crate::pattern::measured::noises_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/bozo.txt");
        for word in ["bozo", "spotted", "bumps"] {
            noises_are_those_measured(Kind::of_word(word), table);
        }
    }
}
