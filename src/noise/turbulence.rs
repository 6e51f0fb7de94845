//! Turbulence: noise upon noise, each layer finer and fainter than the last.
//!
//! **Invariant:** layer i counts ωⁱ and is noise at λⁱ times the point. λ and ω are single numbers
//! (`f32`), their powers double ones: as POV-Ray 3.7 was found to have them.

use super::{NoiseGenerator, noise, vector_noise};
use crate::math::Vector;

/// How layers of noise become finer and fainter.
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
    /// `lambda`: how much finer each layer is than the one before; `omega`: how much fainter.
    /// `octaves`: how many layers; its fraction is dropped, and it is taken into 1 … 10.
    pub fn new(lambda: f64, omega: f64, octaves: f64) -> Self {
        let octaves = octaves.clamp(1.0, 10.0) as u8;
        Self { lambda: single(lambda), omega: single(omega), octaves: octaves.max(1) }
    }

    /// A push for `point`. Finite so long as `omega` to the power of the octaves is.
    pub fn vector(&self, point: Vector) -> Vector {
        self.layers(point).fold(Vector::ZERO, |sum, (weight, p)| sum + vector_noise(p) * weight)
    }

    /// A number of no fixed range, as [`vector`](Self::vector) is finite.
    ///
    /// All generators but the first are stretched to twice their range, and there only the first
    /// layer is kept within 0 … 1.
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

    /// How much each layer counts, and where it takes its noise.
    fn layers(&self, point: Vector) -> impl Iterator<Item = (f64, Vector)> {
        let Self { lambda, omega, octaves } = *self;
        let next = move |(finer, fainter): &(f64, f64)| Some((finer * lambda, fainter * omega));
        std::iter::successors(Some((1.0, 1.0)), next)
            .take(usize::from(octaves))
            .map(move |(finer, fainter)| (fainter, point * finer))
    }
}

/// Rounded to single precision, and never to infinity.
fn single(number: f64) -> f64 {
    let greatest = f64::from(f32::MAX);
    f64::from(number.clamp(-greatest, greatest) as f32)
}
