//! Turbulence: a sum of noise layers of increasing frequency and decreasing amplitude.
//!
//! **Invariant:** layer i has weight ωⁱ and is noise at λⁱ times the point. λ and ω are in single precision
//! (`f32`), their powers in double precision, as found in POV-Ray 3.7.

use super::range::vector_range;
use super::{NoiseGenerator, bounds, noises_at, planar_noise, vector_noise};
use crate::math::Vector;
use crate::math::finite::single;
use crate::math::interval::Interval;
use crate::math::wide::{Instructions, dispatch};

/// The most layers.
const MOST: usize = 10;

/// The parameters of turbulence.
///
/// **Source:** POV-Ray manual, section 3.4.7.5.5.4 "Turbulence"; rules found by experiment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turbulence {
    lambda: f64,
    omega: f64,
    octaves: u8,
}

impl Default for Turbulence {
    fn default() -> Self {
        Self::new(2.0, 0.5, 6.0)
    }
}

impl Turbulence {
    /// Builds turbulence. `lambda` is the ratio of the frequencies of consecutive layers, `omega` that of
    /// their amplitudes. `octaves` is the number of layers, truncated and clamped to 1 … 10.
    pub fn new(lambda: f64, omega: f64, octaves: f64) -> Self {
        let octaves = octaves.clamp(1.0, MOST as f64) as u8;
        Self { lambda: single(lambda), omega: single(omega), octaves: octaves.max(1) }
    }

    /// Returns the displacement of `point`. Finite if `omega` to the power of the octaves is.
    #[inline(never)]
    pub fn vector(&self, point: Vector) -> Vector {
        dispatch!(Instructions::best().level(), _ => self.vector_at(point))
    }

    #[inline(always)]
    fn vector_at(&self, point: Vector) -> Vector {
        let mut sum = Vector::ZERO;
        for (finer, weight) in self.layers() {
            sum += vector_noise(point * finer) * weight;
        }
        sum
    }

    /// Returns x and y of [`vector`](Self::vector).
    #[inline(never)]
    pub fn planar(&self, point: Vector) -> [f64; 2] {
        dispatch!(Instructions::best().level(), _ => self.planar_at(point))
    }

    #[inline(always)]
    fn planar_at(&self, point: Vector) -> [f64; 2] {
        let [mut x, mut y] = [0.0; 2];
        for (finer, weight) in self.layers() {
            let [first, second] = planar_noise(point * finer);
            (x, y) = (x + first * weight, y + second * weight);
        }
        [x, y]
    }

    /// Returns a number without a fixed range; finite like [`vector`](Self::vector).
    ///
    /// The noise of all generators but the first is scaled to twice its range, and then only the first layer
    /// is clamped to 0 … 1.
    #[inline(never)]
    pub fn number(&self, generator: NoiseGenerator, point: Vector) -> f64 {
        dispatch!(Instructions::best().level(), _ => self.number_at(generator, point))
    }

    #[inline(always)]
    fn number_at(&self, generator: NoiseGenerator, point: Vector) -> f64 {
        let mut layers = [(0.0, 0.0); MOST];
        let mut count = 0;
        for layer in self.layers() {
            layers[count] = layer;
            count += 1;
        }
        let noises: [f64; MOST] = noises_at(generator, |layer| point * layers[layer].0, count);
        let mut sum = 0.0;
        for number in 0..count {
            sum += layers[number].1 * layer(generator, noises[number], number == 0);
        }
        sum
    }

    /// Returns intervals that contain the components of [`vector`](Self::vector) at each point of a box.
    pub fn vector_bounds(&self, point: [Interval; 3]) -> [Interval; 3] {
        self.layers().fold([Interval::point(0.0); 3], |sum, (finer, weight)| {
            let noise = vector_range(point.map(|axis| axis * Interval::point(finer)));
            std::array::from_fn(|axis| sum[axis] + noise[axis] * Interval::point(weight))
        })
    }

    /// Returns an interval that contains [`number`](Self::number) at each point of a box.
    pub fn number_bounds(&self, generator: NoiseGenerator, point: [Interval; 3]) -> Interval {
        let layers = self.layers().enumerate();
        layers.fold(Interval::point(0.0), |sum, (index, (finer, weight))| {
            let noise = bounds(generator, point.map(|axis| axis * Interval::point(finer)));
            let of = |noise| layer(generator, noise, index == 0);
            sum + Interval { low: of(noise.low), high: of(noise.high) } * Interval::point(weight)
        })
    }

    /// Returns the frequency and the weight of each layer.
    fn layers(&self) -> impl Iterator<Item = (f64, f64)> {
        let Self { lambda, omega, octaves } = *self;
        let next = move |(finer, fainter): &(f64, f64)| Some((finer * lambda, fainter * omega));
        std::iter::successors(Some((1.0, 1.0)), next).take(usize::from(octaves))
    }
}

/// Returns what a layer of [`Turbulence::number`] has for a noise.
#[inline]
fn layer(generator: NoiseGenerator, noise: f64, is_first: bool) -> f64 {
    let stretched = 2.0 * noise - 0.5;
    match generator {
        NoiseGenerator::Plateaus => noise,
        _ if is_first => stretched.clamp(0.0, 1.0),
        _ => stretched,
    }
}
