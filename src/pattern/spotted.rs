//! `spotted`: another word for `bozo`.

use super::parameter::parameters;
use super::{Bozo, Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::{Row, Rows};

parameters! {
    /// The values of [`Bozo`].
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.3 "Bozo Pattern"; measured on POV-Ray 3.7.
    pub struct Spotted {}
}

impl Pattern for Spotted {
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
}
