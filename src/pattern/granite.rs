//! `granite`: layers of folded noise, like the grain of stone.

use super::layers::Layers;
use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::{Row, Rows};

parameters! {
    /// The sum of six layers: the distances of noise from 0.5, from frequency 4 and amplitude 1 on.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.14 "Granite Pattern"; layers, frequencies and amplitudes measured on POV-Ray 3.7.
    pub struct Granite {}
}

const LAYERS: Layers = Layers { frequency: 4.0, amplitude: 1.0, count: 6, is_folded: true };

impl Pattern for Granite {
    const COST: &str = "six noises a point";
    const RANGE: Interval = Interval { low: 0.0, high: 63.0 / 64.0 };

    fn value(&self, sample: &Sample) -> f64 {
        LAYERS.value(sample.point, sample.setting)
    }

    fn values(&self, points: &Rows, mask: u32, setting: &Setting, values: &mut Row) {
        LAYERS.values(points, mask, setting, values);
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        LAYERS.bounds(point, reach, setting, Self::RANGE)
    }

    fn sloped(
        &self,
        point: Vector,
        reach: Vector,
        setting: &Setting,
    ) -> Option<(Interval, [Interval; 3])> {
        Some(LAYERS.sloped(point, reach, setting, Self::RANGE))
    }
}

#[cfg(test)]
mod tests {
    use crate::pattern::Kind;
    use crate::pattern::measured::noises_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        noises_are_those_measured(Kind::of_word("granite"), include_str!("measured/granite.txt"));
    }
}
