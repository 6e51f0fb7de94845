//! `bumps`: another word for `bozo`.

use super::parameter::parameters;
use super::{Bozo, Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::{Row, Rows};
use crate::noise::{vector_noise, vector_noises};

parameters! {
    /// The values of [`Bozo`].
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.3 "Bozo Pattern"; measured on POV-Ray 3.7.
    pub struct Bumps {}
}

impl Pattern for Bumps {
    const COST: &str = "one noise a point";

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        Bozo {}.value(sample)
    }

    fn values(&self, points: &Rows, mask: u32, setting: &Setting, values: &mut Row) {
        Bozo {}.values(points, mask, setting, values);
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        Bozo {}.bounds(point, reach, setting)
    }

    fn sloped(
        &self,
        point: Vector,
        reach: Vector,
        setting: &Setting,
    ) -> Option<(Interval, [Interval; 3])> {
        Bozo {}.sloped(point, reach, setting)
    }

    /// Returns the vector noise.
    ///
    /// **Source:** measured on POV-Ray 3.7; frequency, phase and wave have no effect.
    fn displacement(&self, _normal: Vector, sample: &Sample) -> Option<Vector> {
        Some(vector_noise(sample.point))
    }

    fn displacements(
        &self,
        _normals: &Rows,
        points: &Rows,
        mask: u32,
        _setting: &Setting,
        vectors: &mut Rows,
    ) -> bool {
        vector_noises(points, mask, vectors);
        true
    }
}
