//! `wrinkles`: layers of noise, like crumpled foil.

use super::layers::Layers;
use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::{Row, Rows, numbers};
use crate::noise::{vector_noise, vector_noises};

parameters! {
    /// The sum of ten layers of noise, from frequency 1 and amplitude ½ on.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.31 "Wrinkles Pattern"; layers, frequencies and amplitudes measured on POV-Ray 3.7.
    pub struct Wrinkles {}
}

const LAYERS: Layers = Layers { frequency: 1.0, amplitude: 0.5, count: 10, is_folded: false };

impl Pattern for Wrinkles {
    const COST: &str = "ten noises a point";
    const RANGE: Interval = Interval { low: 0.0, high: 1023.0 / 1024.0 };

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

    /// Returns layers of the absolute vector noise, so that no component is negative.
    ///
    /// **Source:** measured on POV-Ray 3.7; frequency, phase and wave have no effect.
    fn displacement(&self, _normal: Vector, sample: &Sample) -> Option<Vector> {
        let layer = |finer: f64| vector_noise(sample.point * finer).abs() / finer;
        Some(finer().map(layer).fold(Vector::ZERO, |sum, layer| sum + layer))
    }

    fn displacements(
        &self,
        _normals: &Rows,
        points: &Rows,
        mask: u32,
        _setting: &Setting,
        vectors: &mut Rows,
    ) -> bool {
        *vectors = Rows::ZERO;
        for finer in finer() {
            let [mut scaled, mut noise] = [Rows::ZERO; 2];
            for number in numbers(mask) {
                scaled.set(number, points.at(number) * finer);
            }
            vector_noises(&scaled, mask, &mut noise);
            for number in numbers(mask) {
                vectors.set(number, vectors.at(number) + noise.at(number).abs() / finer);
            }
        }
        true
    }
}

/// Returns the frequencies of the layers of displacements.
fn finer() -> impl Iterator<Item = f64> {
    std::iter::successors(Some(1.0), |finer| Some(finer * 2.0)).take(10)
}

#[cfg(test)]
mod tests {
    use crate::pattern::Kind;
    use crate::pattern::measured::noises_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        noises_are_those_measured(Kind::of_word("wrinkles"), include_str!("measured/wrinkles.txt"));
    }
}
