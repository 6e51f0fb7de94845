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

/// Returns [`noise_bounds`], and intervals that contain the slope along each axis.
pub(super) fn noise_slopes(
    generator: NoiseGenerator,
    point: Vector,
    reach: Vector,
) -> (Interval, [Interval; 3]) {
    let (low, high) = (point - reach, point + reach);
    let axis = |i: usize| Interval { low: low[i].next_down(), high: high[i].next_up() };
    noise::bounds_and_slopes(generator, [axis(0), axis(1), axis(2)])
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
        let mut sum = Interval { low: 0.0, high: 0.0 };
        for i in 0..self.count {
            let scale = f64::from(1u32 << i);
            let frequency = self.frequency * scale;
            let noise = noise_bounds(setting.noise, point * frequency, reach * frequency);
            self.add(&mut sum, spread_bounds(setting.noise, noise), scale);
        }
        self.total(sum, range)
    }

    /// Returns [`Layers::bounds`], and intervals that contain the slope along each axis.
    pub fn sloped(
        &self,
        point: Vector,
        reach: Vector,
        setting: &Setting,
        range: Interval,
    ) -> (Interval, [Interval; 3]) {
        let mut sum = Interval { low: 0.0, high: 0.0 };
        let mut slopes = [Interval { low: 0.0, high: 0.0 }; 3];
        // Each layer is as steep as the others.
        let steep = match setting.noise {
            NoiseGenerator::Plateaus => self.frequency * self.amplitude,
            _ => 2.0 * self.frequency * self.amplitude,
        };
        for i in 0..self.count {
            let scale = f64::from(1u32 << i);
            let frequency = self.frequency * scale;
            let (noise, layer) = noise_slopes(setting.noise, point * frequency, reach * frequency);
            let noise = spread_bounds(setting.noise, noise);
            self.add(&mut sum, noise, scale);
            let is_cut = noise.low <= 0.0 || noise.high >= 1.0;
            for (slope, layer) in slopes.iter_mut().zip(layer) {
                let zero = is_cut || self.is_folded && noise.contains(0.5);
                let layer = if zero { layer.hull(Interval { low: 0.0, high: 0.0 }) } else { layer };
                let layer = match self.is_folded {
                    true if noise.high < 0.5 => -layer,
                    true if noise.low <= 0.5 => layer.hull(-layer),
                    _ => layer,
                };
                *slope = Interval {
                    low: slope.low + steep * layer.low,
                    high: slope.high + steep * layer.high,
                };
            }
        }
        let off = 1e-12 * steep;
        let slopes =
            slopes.map(|Interval { low, high }| Interval { low: low - off, high: high + off });
        (self.total(sum, range), slopes)
    }

    /// Adds the bounds of a layer.
    fn add(&self, sum: &mut Interval, noise: Interval, scale: f64) {
        let layer = match self.is_folded {
            true => Interval { low: 0.5 - noise.high, high: 0.5 - noise.low }.abs(),
            false => noise,
        };
        let amplitude = self.amplitude / scale;
        sum.low += layer.low * amplitude;
        sum.high += layer.high * amplitude;
    }

    fn total(&self, Interval { low, high }: Interval, range: Interval) -> Interval {
        // The sums and the differences are rounded.
        Interval { low: (low - 1e-14).max(range.low), high: (high + 1e-14).min(range.high) }
    }
}

fn spread_bounds(generator: NoiseGenerator, Interval { low, high }: Interval) -> Interval {
    Interval { low: spread(generator, low), high: spread(generator, high) }
}
