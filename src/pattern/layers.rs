//! Noise as patterns use it: over a box, and in layers of doubled frequency.

use super::Setting;
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::*;
use crate::noise::{self, NoiseGenerator, four_stretched, noise_by, noise_of_four, stretched};

/// Returns an interval that contains the noise at each point within `reach` of `point` along each axis.
pub(super) fn noise_bounds(generator: NoiseGenerator, point: Vector, reach: Vector) -> Interval {
    let (low, high) = (point - reach, point + reach);
    let axis = |i: usize| Interval { low: low[i].next_down(), high: high[i].next_up() };
    noise::bounds(generator, [axis(0), axis(1), axis(2)])
}

/// Returns noise with the spread of generator 1: that of the others is stretched to twice its range around
/// 0.5, and clamped.
///
/// **Source:** measured on POV-Ray 3.7, in `granite` and `wrinkles`.
#[inline(always)]
fn spread(generator: NoiseGenerator, noise: f64) -> f64 {
    match generator {
        NoiseGenerator::Plateaus => noise,
        NoiseGenerator::RangeCorrected | NoiseGenerator::Perlin => stretched(noise).clamp(0.0, 1.0),
    }
}

/// A sum of layers of noise, each of twice the frequency and half the amplitude of the one before.
pub(super) struct Layers {
    /// The frequency of the first layer.
    pub frequency: f64,
    /// The amplitude of the first layer.
    pub amplitude: f64,
    /// The number of layers.
    pub count: u32,
    /// Whether a layer is the distance of noise from 0.5, instead of noise.
    pub is_folded: bool,
}

impl Layers {
    /// Returns the sum of the layers.
    pub fn value(&self, point: Vector, setting: &Setting) -> f64 {
        dispatch!(Instructions::best().level(), simd => self.value_by(simd, point, setting.noise))
    }

    #[inline(always)]
    fn value_by<S: Simd>(&self, simd: S, point: Vector, generator: NoiseGenerator) -> f64 {
        let [mut frequency, mut amplitude] = [self.frequency, self.amplitude];
        let mut sum = 0.0;
        for _ in 0..self.count {
            let noise = spread(generator, noise_by(simd, generator, point * frequency));
            sum += amplitude * if self.is_folded { (0.5 - noise).abs() } else { noise };
            frequency *= 2.0;
            amplitude *= 0.5;
        }
        sum
    }

    /// Replaces the values that the mask has a bit for by [`Layers::value`]; others may have any value then.
    pub fn values(&self, points: &Rows, mask: u32, setting: &Setting, values: &mut Row) {
        by_group!(points, mask, |simd, four, lanes, group| {
            store(self.values_of_four(simd, four, lanes, setting.noise), values, group)
        });
    }

    #[inline(always)]
    fn values_of_four<S: Simd>(
        &self,
        simd: S,
        points: WideVector<S>,
        lanes: u32,
        generator: NoiseGenerator,
    ) -> Wide<S> {
        let [zero, half, one] = [all(simd, 0.0), all(simd, 0.5), all(simd, 1.0)];
        let [mut frequency, mut amplitude] = [self.frequency, self.amplitude];
        let mut sum = zero;
        for _ in 0..self.count {
            let finer = points * all(simd, frequency);
            let mut noise = noise_of_four(simd, generator, finer, lanes);
            if generator != NoiseGenerator::Plateaus {
                noise = four_stretched(simd, noise).max(zero).min(one);
            }
            sum += if self.is_folded { (half - noise).abs() } else { noise } * amplitude;
            frequency *= 2.0;
            amplitude *= 0.5;
        }
        sum
    }

    /// Returns an interval that contains the value at each point within `reach` of `point`, cut to `range`.
    pub fn bounds(
        &self,
        point: Vector,
        reach: Vector,
        setting: &Setting,
        range: Interval,
    ) -> Interval {
        let generator = setting.noise;
        let layer = |frequency: f64| {
            let Interval { low, high } =
                noise_bounds(generator, point * frequency, reach * frequency);
            let noise = Interval { low: spread(generator, low), high: spread(generator, high) };
            match self.is_folded {
                true => Interval { low: 0.5 - noise.high, high: 0.5 - noise.low }.abs(),
                false => noise,
            }
        };
        let [low, high] = [self.sum(|f| layer(f).low), self.sum(|f| layer(f).high)];
        // The sums and the differences are rounded.
        Interval { low: (low - 1e-14).max(range.low), high: (high + 1e-14).min(range.high) }
    }

    fn sum(&self, layer: impl Fn(f64) -> f64) -> f64 {
        let halves = (0..self.count).map(|i| f64::from(1u32 << i));
        halves.map(|scale| layer(self.frequency * scale) * (self.amplitude / scale)).sum()
    }
}
