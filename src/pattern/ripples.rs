//! `ripples`: waves of one frequency from many centres.

use super::centres::{Beat, centres, change, mean_away};
use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// The mean of the waves, scaled to 0 … 1. The frequency and the phase of the block act on the distance
    /// from each centre; the block applies them to the value once more.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.23 "Ripples Pattern"; the formula was found by experiment
    /// on POV-Ray 3.7.
    pub struct Ripples {}
}

impl Pattern for Ripples {
    fn value(&self, sample: &Sample) -> f64 {
        let (centres, beat) = (centres(sample.setting), Beat::of(sample.setting));
        let waves = centres.iter().map(|centre| beat.wave(centre.distance(sample.point)));
        let mean = waves.sum::<f64>() / centres.len() as f64;
        (0.5 + 0.5 * mean).clamp(0.0, 1.0)
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let value = self.value(&Sample { point, error: Vector::ZERO, setting });
        let change = 0.5 * change(Beat::of(setting), point, reach);
        let Interval { low, high } = Self::RANGE;
        Interval { low: (value - change).max(low), high: (value + change).min(high) }
    }

    /// Returns the mean over the centres of the direction away from each, times the wave there.
    ///
    /// **Source:** measured on POV-Ray 3.7; the wave type has no effect.
    fn displacement(&self, _normal: Vector, sample: &Sample) -> Option<Vector> {
        let beat = Beat::of(sample.setting);
        Some(mean_away(sample, |_, distance| beat.wave(distance)))
    }
}

#[cfg(test)]
mod tests {
    use crate::pattern::Kind;
    use crate::pattern::measured::waves_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        waves_are_those_measured(Kind::of_word("ripples"), include_str!("measured/ripples.txt"));
    }
}
