//! Solid noise: a smooth pseudorandom number, or vector, for every point of space.
//!
//! **In:** any point. **Out:** 0 … 1, or a vector whose components are within 2 of zero. **Invariant:**
//! finite for every point; continuous, and smooth where it is not clamped; equal to POV-Ray 3.7's out to
//! 2·10⁹ units, so that pictures based on it are the same.
//!
//! This is lattice noise: each point of the integer lattice has a value and a gradient, which define a linear
//! function; between lattice points, the functions of the eight corners are blended by 3t² − 2t³ along each
//! axis. The data of a lattice point are selected by a walk through a shuffled table, one step per axis.
//!
//! **Source:** found by experiment on POV-Ray 3.7: its values at lattice points repeat every 4096 units and
//! are 256 in number; each line of the lattice is a permutation of any other by exclusive or of the index.
//! For this kind of noise, see Ebert and others, *Texturing and Modeling*, 3rd ed., chapter 2, and Perlin,
//! "An Image Synthesizer", 1985.

mod four;
mod lattice;
mod perlin;
mod range;
mod table;
mod turbulence;

pub(crate) use four::noise_of_four;
pub use turbulence::Turbulence;

use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::*;
use lattice::Cell;
use table::{HASHES, NUMBERS, PERMUTATION, ROWS, STRIDE, TRIPLES};

/// The noise that patterns are based on: `noise_generator` 1, 2 or 3.
///
/// **Source:** POV-Ray manual, section 3.4.7.5.4 "Noise Generators".
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NoiseGenerator {
    /// 1: exceeds 0 … 1, and is clamped to plateaus there.
    Plateaus,
    /// 2: the same, scaled to 0 … 1.
    #[default]
    RangeCorrected,
    /// 3: Perlin's gradient noise.
    Perlin,
}

/// These make 0 … 1 of −0.55242 … 1.48900, the range of generator 1 before it is clamped.
const SHIFT: f64 = 0.552_42;
const SCALE: f64 = 0.489_855_82;

/// Returns noise of generators 2 and 3 stretched to twice its range around 0.5: the spread of generator 1.
///
/// **Source:** measured on POV-Ray 3.7, in `granite`, `wrinkles` and turbulence.
#[inline(always)]
pub(crate) fn stretched(noise: f64) -> f64 {
    2.0 * noise - 0.5
}

/// Returns [`stretched`] for four.
#[inline(always)]
pub(crate) fn four_stretched<S: Simd>(simd: S, noise: Wide<S>) -> Wide<S> {
    noise * 2.0 - all(simd, 0.5)
}

/// Returns the noise at `point`, 0 … 1.
pub fn noise(generator: NoiseGenerator, point: Vector) -> f64 {
    dispatch!(Instructions::best().level(), simd => noise_by(simd, generator, point))
}

/// Returns [`noise`]; several at once save the choice of instructions.
#[inline(always)]
pub(crate) fn noise_by<S: Simd>(simd: S, generator: NoiseGenerator, point: Vector) -> f64 {
    let noise = match generator {
        NoiseGenerator::Plateaus => plain(simd, point) + 0.5,
        NoiseGenerator::RangeCorrected => (plain(simd, point) + 0.5 + SHIFT) * SCALE,
        NoiseGenerator::Perlin => perlin::noise(simd, point),
    };
    noise.clamp(0.0, 1.0)
}

/// Returns the noise at `point` before it is clamped, and its slopes along x, y and z.
fn noise_and_slopes(generator: NoiseGenerator, point: Vector) -> (f64, [f64; 3]) {
    dispatch!(Instructions::best().level(), simd => noise_and_slopes_by(simd, generator, point))
}

#[inline(always)]
fn noise_and_slopes_by<S: Simd>(
    simd: S,
    generator: NoiseGenerator,
    point: Vector,
) -> (f64, [f64; 3]) {
    if generator == NoiseGenerator::Perlin {
        return perlin::noise_and_slopes(simd, point);
    }
    let cell = Cell::new(simd, point, LATTICE_ORIGIN as f64);
    let (plain, [x, y, z]) = cell.blend_and_slopes(&ROWS, hashes(cell.low));
    match generator {
        NoiseGenerator::RangeCorrected => {
            ((plain + 0.5 + SHIFT) * SCALE, [x * SCALE, y * SCALE, z * SCALE])
        }
        _ => (plain + 0.5, [x, y, z]),
    }
}

/// Returns an interval that contains the noise of every point of a box.
pub fn bounds(generator: NoiseGenerator, point: [Interval; 3]) -> Interval {
    range::value_range(generator, point)
}

/// Returns how far computed noise may be from the exact one.
pub fn rounding(generator: NoiseGenerator) -> f64 {
    range::rounding(generator)
}

/// Returns [`bounds`], and intervals that contain the slope along each axis at every point of a box,
/// including 0 where noise is clamped.
pub fn bounds_and_slopes(
    generator: NoiseGenerator,
    point: [Interval; 3],
) -> (Interval, [Interval; 3]) {
    range::range(generator, point)
}

/// Replaces the values that the mask has a bit for by [`noise`]; others may have any value then.
pub fn noises(generator: NoiseGenerator, points: &Rows, mask: u32, values: &mut Row) {
    by_group!(points, mask, |simd, four, lanes, group| {
        store(noise_of_four(simd, generator, four, lanes), values, group)
    });
}

/// Returns three independent noises: a displacement of `point`, centred on zero.
pub fn vector_noise(point: Vector) -> Vector {
    let [x, y, z, _] = dispatch!(Instructions::best().level(), simd => triple(simd, point).into());
    Vector::new(x, y, z)
}

/// Replaces the vectors that the mask has a bit for by [`vector_noise`]; others may have any value then.
pub fn vector_noises(points: &Rows, mask: u32, vectors: &mut Rows) {
    by_group!(points, mask, |simd, four, lanes, group| {
        four::triples_of_four(simd, four, lanes).store(vectors, group)
    });
}

/// The first component of the vector noise.
#[inline(always)]
fn plain<S: Simd>(simd: S, point: Vector) -> f64 {
    let cell = Cell::new(simd, point, LATTICE_ORIGIN as f64);
    cell.blend(&ROWS, hashes(cell.low))
}

/// The components of [`vector_noise`], and 0.
#[inline(always)]
fn triple<S: Simd>(simd: S, point: Vector) -> Wide<S> {
    let cell = Cell::new(simd, point, LATTICE_ORIGIN as f64);
    cell.blend_triples(&TRIPLES, hashes(cell.low))
}

/// Returns the hashes of the corners of a cell, by x, then y, then z.
#[inline(always)]
fn hashes([x, y, z]: [usize; 3]) -> [usize; 8] {
    let mut hashes = [0; 8];
    for i in 0..2 {
        let row = step(x.wrapping_add(i));
        for j in 0..2 {
            let column = step(row ^ y.wrapping_add(j));
            for k in 0..2 {
                hashes[i << 2 | j << 1 | k] = last_step(column ^ z.wrapping_add(k));
            }
        }
    }
    hashes
}

/// A component's data at the corners of a cell, by x, then y, then z.
#[inline(always)]
fn corners(component: usize, low: [usize; 3]) -> [range::Linear; 8] {
    hashes(low).map(|hash| {
        let at = hash + STRIDE * component;
        [0.5 * NUMBERS[at], NUMBERS[at + 1], NUMBERS[at + 2], NUMBERS[at + 3]]
    })
}

/// Returns the number of an integer cell, 0 … 4095, by the same walk as for lattice points, but with the
/// table's origin at 0; only the low bits of the indices are used.
pub fn cell_number([i, j, k]: [i64; 3]) -> usize {
    let low = |index: i64| index as usize % PERMUTATION.len();
    step(step(step(low(i)) ^ low(j)) ^ low(k))
}

/// The origin of the table is at (−10000, −10000, −10000).
const LATTICE_ORIGIN: i64 = 10_000;

#[inline(always)]
fn step(index: usize) -> usize {
    usize::from(PERMUTATION[index % PERMUTATION.len()])
}

#[inline(always)]
fn last_step(index: usize) -> usize {
    usize::from(HASHES[index % HASHES.len()])
}

#[cfg(test)]
mod tests;
