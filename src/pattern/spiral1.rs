//! `spiral1 <arms>`: a spiral around the z axis, like the thread of a screw.

use super::parameter::parameters;
use super::spiral::{bounds, error, is_off_seam, place, whole_arms};
use super::{Measured, NEAR, Pattern, Sample, Setting, WaveKind};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// z, plus the distance from the z axis, plus the number of arms times the angle around it in turns.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.25 "Spiral1 Pattern"; the formula was found by experiment
    /// on POV-Ray 3.7.
    pub struct Spiral1 {
        after arms: f64 = 1.0, "the number of arms";
    }
}

impl Pattern for Spiral1 {
    const WAVE: WaveKind = WaveKind::Triangle;
    const HAS_SEAMS: bool = true;
    const RANGE: Interval = Interval::EVERYTHING;

    fn canonical(self) -> Self {
        Self { arms: whole_arms(self.arms) }
    }

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        place(self.arms, sample).along
    }

    #[inline]
    fn measured(&self, sample: &Sample) -> Measured {
        Measured { value: self.value(sample), error: error(self.arms, sample) }
    }

    /// Returns the value if the point is not within [`NEAR`] of the seam.
    #[inline]
    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        let sample = Sample { error: Vector::splat(0.25 * NEAR), ..*sample };
        is_off_seam(&sample).then(|| self.measured(&sample))
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let [_, along] = bounds(self.arms, point, reach, setting);
        along
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Kind;
    use crate::pattern::measured::spiral_values_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        let kind = |arms| Kind::Spiral1(Spiral1 { arms });
        spiral_values_are_those_measured(kind, include_str!("measured/spiral1.txt"));
    }

    #[test]
    fn a_point_that_may_be_on_the_seam_is_on_it() {
        let value = |x: f64, y: f64| {
            let (point, error) = (Vector::new(x, y, 0.0), Vector::splat(1e-12));
            Spiral1 { arms: 2.0 }.value(&Sample { point, error, setting: &Setting::default() })
        };
        for x in [-1e-13, -0.0, 0.0, 1e-13] {
            assert_eq!(value(x, -3.0), 3.0, "{x}");
            assert!((value(x, 3.0) - 4.0).abs() < 1e-12, "{x}");
        }
        assert!(value(-1e-11, -3.0) > 4.9);
    }

    #[test]
    fn arms_are_whole_and_wrap_in_16_bits() {
        for (given, counted) in
            [(2.9, 2.0), (-1.9, -1.0), (40_000.0, -25_536.0), (1e6, 16_960.0), (f64::NAN, 0.0)]
        {
            assert_eq!(Spiral1 { arms: given }.canonical().arms, counted);
        }
    }
}
