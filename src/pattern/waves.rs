//! `waves`: waves of many frequencies, the lower the higher, from many centres.

use super::centres::{Beat, centres, change, mean_away};
use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// The mean of the waves; each has its own frequency, and a height in inverse proportion to it. The
    /// frequency and the phase of the block act on the distance from each centre; the block applies them to
    /// the value once more. Values of ten waves are within 0 … 1; with another number they may exceed it.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.29 "Waves Pattern"; the formula was found by experiment on
    /// POV-Ray 3.7.
    pub struct Waves {}
}

/// Half of the height of a wave of frequency 1.
const HEIGHT: f64 = 0.2;

impl Pattern for Waves {
    /// The rarest waves, of frequency 0.01, are the highest.
    const RANGE: Interval = Interval { low: 0.5 - 100.0 * HEIGHT, high: 0.5 + 100.0 * HEIGHT };

    fn value(&self, sample: &Sample) -> f64 {
        let (centres, beat) = (centres(sample.setting), Beat::of(sample.setting));
        let waves = centres.iter().map(|centre| {
            beat.wave(centre.distance(sample.point) * centre.frequency) / centre.frequency
        });
        0.5 + HEIGHT * (waves.sum::<f64>() / centres.len() as f64)
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let value = self.value(&Sample { point, error: Vector::ZERO, setting });
        // Frequency and height cancel in the slope. Rounding counts more where waves are high.
        let change = HEIGHT * change(Beat::of(setting), point, reach) + 1e-13;
        let centres = centres(setting);
        let heights = centres.iter().map(|centre| 1.0 / centre.frequency).sum::<f64>();
        let most = HEIGHT * (heights / centres.len() as f64) + 1e-13;
        Interval { low: (value - change).max(0.5 - most), high: (value + change).min(0.5 + most) }
    }

    /// Returns the mean over the centres of the direction away from each, times the wave there.
    ///
    /// **Source:** measured on POV-Ray 3.7; the wave type has no effect.
    fn displacement(&self, _normal: Vector, sample: &Sample) -> Option<Vector> {
        let beat = Beat::of(sample.setting);
        Some(mean_away(sample, |centre, distance| {
            beat.wave(distance * centre.frequency) / centre.frequency
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Kind;
    use crate::pattern::measured::waves_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        waves_are_those_measured(Kind::of_word("waves"), include_str!("measured/waves.txt"));
    }

    #[test]
    fn ten_waves_are_within_zero_and_one() {
        let (point, reach) = (Vector::ZERO, Vector::splat(1e9));
        let bounds = Waves {}.bounds(point, reach, &Setting::default());
        assert!(bounds.low > 0.05 && bounds.high < 0.95, "{bounds:?}");
    }
}
