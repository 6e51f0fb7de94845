//! Turbulence: a sum of noise layers of increasing frequency and decreasing amplitude.
//!
//! **Invariant:** layer i has weight ωⁱ and is noise at λⁱ times the point. λ and ω are in single precision
//! (`f32`), their powers in double precision, as found in POV-Ray 3.7.

use super::{NoiseGenerator, noise, vector_noise};
use crate::math::Vector;

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
        let octaves = octaves.clamp(1.0, 10.0) as u8;
        Self { lambda: single(lambda), omega: single(omega), octaves: octaves.max(1) }
    }

    /// Returns the displacement of `point`. Finite if `omega` to the power of the octaves is.
    pub fn vector(&self, point: Vector) -> Vector {
        self.layers(point).fold(Vector::ZERO, |sum, (weight, p)| sum + vector_noise(p) * weight)
    }

    /// Returns a number without a fixed range; finite like [`vector`](Self::vector).
    ///
    /// The noise of all generators but the first is scaled to twice its range, and then only the first layer
    /// is clamped to 0 … 1.
    pub fn number(&self, generator: NoiseGenerator, point: Vector) -> f64 {
        let stretched = |p| 2.0 * noise(generator, p) - 0.5;
        let layers = self.layers(point).enumerate();
        layers.fold(0.0, |sum, (i, (weight, p))| {
            let layer = match generator {
                NoiseGenerator::Plateaus => noise(generator, p),
                NoiseGenerator::RangeCorrected | NoiseGenerator::Perlin if i == 0 => {
                    stretched(p).clamp(0.0, 1.0)
                }
                NoiseGenerator::RangeCorrected | NoiseGenerator::Perlin => stretched(p),
            };
            sum + weight * layer
        })
    }

    /// Returns the weight of each layer, and the point at which it is evaluated.
    fn layers(&self, point: Vector) -> impl Iterator<Item = (f64, Vector)> {
        let Self { lambda, omega, octaves } = *self;
        let next = move |(finer, fainter): &(f64, f64)| Some((finer * lambda, fainter * omega));
        std::iter::successors(Some((1.0, 1.0)), next)
            .take(usize::from(octaves))
            .map(move |(finer, fainter)| (fainter, point * finer))
    }
}

/// Rounds to single precision, clamped to finite numbers.
fn single(number: f64) -> f64 {
    let greatest = f64::from(f32::MAX);
    f64::from(number.clamp(-greatest, greatest) as f32)
}
