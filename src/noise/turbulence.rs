//! Turbulence: a sum of noise layers of increasing frequency and decreasing amplitude.
//!
//! **Invariant:** layer i has weight ωⁱ and is noise at λⁱ times the point. λ and ω are in single precision
//! (`f32`), their powers in double precision, as found in POV-Ray 3.7.

use super::four::{noise_of_four, triples_of_four};
use super::range::vector_range;
use super::{NoiseGenerator, bounds, four_stretched, noise_by, stretched, triple};
use crate::math::Vector;
use crate::math::finite::single;
use crate::math::interval::Interval;
use crate::math::wide::*;

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
        let [x, y, z, _] =
            dispatch!(Instructions::best().level(), simd => self.triple(simd, point).into());
        Vector::new(x, y, z)
    }

    #[inline(always)]
    fn triple<S: Simd>(&self, simd: S, point: Vector) -> Wide<S> {
        let mut sum = all(simd, 0.0);
        for (finer, weight) in self.layers() {
            sum += triple(simd, point * finer) * weight;
        }
        sum
    }

    /// Replaces the vectors that the mask has a bit for by [`vector`](Self::vector); others may have any value then.
    pub fn vectors(&self, points: &Rows, mask: u32, vectors: &mut Rows) {
        by_group!(points, mask, |simd, four, lanes, group| {
            self.vectors_of_four(simd, four, lanes).store(vectors, group)
        });
    }

    #[inline(always)]
    fn vectors_of_four<S: Simd>(
        &self,
        simd: S,
        points: WideVector<S>,
        lanes: u32,
    ) -> WideVector<S> {
        let mut sum = WideVector::splat(simd, Vector::ZERO);
        for (finer, weight) in self.layers() {
            let noise = triples_of_four(simd, points * all(simd, finer), lanes);
            sum = sum + noise * all(simd, weight);
        }
        sum
    }

    /// Returns a number without a fixed range; finite like [`vector`](Self::vector).
    ///
    /// The noise of all generators but the first is scaled to twice its range, and then only the first layer
    /// is clamped to 0 … 1.
    pub fn number(&self, generator: NoiseGenerator, point: Vector) -> f64 {
        dispatch!(Instructions::best().level(), simd => self.number_by(simd, generator, point))
    }

    #[inline(always)]
    fn number_by<S: Simd>(&self, simd: S, generator: NoiseGenerator, point: Vector) -> f64 {
        let (mut sum, mut is_first) = (0.0, true);
        for (finer, weight) in self.layers() {
            let noise = noise_by(simd, generator, point * finer);
            sum += weight * layer(generator, noise, is_first);
            is_first = false;
        }
        sum
    }

    /// Replaces the numbers that the mask has a bit for by [`number`](Self::number); others may have any value then.
    pub fn numbers(&self, generator: NoiseGenerator, points: &Rows, mask: u32, numbers: &mut Row) {
        by_group!(points, mask, |simd, four, lanes, group| {
            store(self.numbers_of_four(simd, generator, four, lanes), numbers, group)
        });
    }

    /// Returns its numbers at four points; those of lanes that are not asked for are any.
    #[inline(always)]
    pub(crate) fn numbers_of_four<S: Simd>(
        &self,
        simd: S,
        generator: NoiseGenerator,
        points: WideVector<S>,
        lanes: u32,
    ) -> Wide<S> {
        let (mut sum, mut is_first) = (all(simd, 0.0), true);
        for (finer, weight) in self.layers() {
            let noise = noise_of_four(simd, generator, points * all(simd, finer), lanes);
            let layer = match generator {
                NoiseGenerator::Plateaus => noise,
                _ if is_first => {
                    four_stretched(simd, noise).max(all(simd, 0.0)).min(all(simd, 1.0))
                }
                _ => four_stretched(simd, noise),
            };
            sum += layer * weight;
            is_first = false;
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
    match generator {
        NoiseGenerator::Plateaus => noise,
        _ if is_first => stretched(noise).clamp(0.0, 1.0),
        _ => stretched(noise),
    }
}
