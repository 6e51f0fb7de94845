//! `dents`: the cube of noise, which is low but for scattered peaks.

use super::layers::noise_bounds;
use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::{ROW, Row, Rows, numbers};
use crate::noise::{noise, noises, vector_noise, vector_noises};

parameters! {
    /// The cube of the noise of the block's generator, 0 … 1.
    ///
    /// **Source:** measured on POV-Ray 3.7.
    pub struct Dents {}
}

impl Pattern for Dents {
    const COST: &str = "one noise a point";

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        cube(noise(sample.setting.noise, sample.point))
    }

    fn values(&self, points: &Rows, mask: u32, setting: &Setting, values: &mut Row) {
        noises(setting.noise, points, mask, values);
        for number in numbers(mask) {
            values[number] = cube(values[number]);
        }
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        noise_bounds(setting.noise, point, reach).rising_exactly(cube)
    }

    /// Returns the vector noise, where the noise is high.
    ///
    /// **Source:** measured on POV-Ray 3.7; frequency, phase and wave have no effect.
    fn displacement(&self, _normal: Vector, sample: &Sample) -> Option<Vector> {
        Some(vector_noise(sample.point) * self.value(sample))
    }

    fn displacements(
        &self,
        _normals: &Rows,
        points: &Rows,
        mask: u32,
        setting: &Setting,
        vectors: &mut Rows,
    ) -> bool {
        let mut values = [0.0; ROW];
        self.values(points, mask, setting, &mut values);
        vector_noises(points, mask, vectors);
        for number in numbers(mask) {
            vectors.set(number, vectors.at(number) * values[number]);
        }
        true
    }
}

/// Non-decreasing, rounding included.
fn cube(noise: f64) -> f64 {
    noise * noise * noise
}

#[cfg(test)]
mod tests {
    use crate::pattern::Kind;
    use crate::pattern::measured::noises_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        noises_are_those_measured(Kind::of_word("dents"), include_str!("measured/dents.txt"));
    }
}
