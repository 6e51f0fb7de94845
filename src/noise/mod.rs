//! Solid noise: a smooth number, or vector, for every point of space, random from point to point.
//!
//! **In:** any point. **Out:** 0 … 1, or a vector whose components stay within 2 of zero.
//! **Invariant:** finite for every point; continuous, and smooth where it is not cut off; out to
//! 2·10⁹ units equal to POV-Ray 3.7's, so that a picture made of it is the same picture.
//!
//! Lattice noise: each point of the integer lattice holds a value and a gradient, and so a linear
//! function; between lattice points those of the eight corners are blended by 3t² − 2t³ along each
//! axis. What a point holds hangs on one walk through a shuffled table, a step an axis.
//!
//! **Source:** found by experiment on POV-Ray 3.7: its values at lattice points repeat every 4096
//! units and are 256 in number; each line of the lattice is a reordering of any other by exclusive
//! or of the index. For noise of this kind see Ebert and others, *Texturing and Modeling*, 3rd ed.,
//! chapter 2, and Perlin, "An Image Synthesizer", 1985.

mod perlin;
mod range;
mod table;
mod turbulence;

pub use turbulence::Turbulence;

use crate::math::Vector;
use crate::math::interval::Interval;
use table::{NUMBERS, PERMUTATION, STRIDE};

/// Which noise patterns are made of: `noise_generator` 1, 2 or 3.
///
/// **Source:** POV-Ray manual, section 3.4.7.5.4 "Noise Generators".
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NoiseGenerator {
    /// 1: reaches below 0 and above 1, where it is cut off to plateaus.
    Plateaus,
    /// 2: the same, shrunk to its range.
    #[default]
    RangeCorrected,
    /// 3: gradients alone.
    Perlin,
}

/// Noise at `point`, 0 … 1.
pub fn noise(generator: NoiseGenerator, point: Vector) -> f64 {
    let value = match generator {
        NoiseGenerator::Plateaus => plain(point),
        // −0.55242 … 1.48900 becomes 0 … 1.
        NoiseGenerator::RangeCorrected => (plain(point) + 0.552_42) * 0.489_855_82,
        NoiseGenerator::Perlin => perlin::noise(point),
    };
    value.clamp(0.0, 1.0)
}

/// An interval that holds the noise of every point of a box.
pub fn bounds(generator: NoiseGenerator, point: [Interval; 3]) -> Interval {
    range::range(generator, point).0
}

/// The same, and intervals that hold noise's slope along each axis at every point of a box; where it is cut
/// off, 0 as well.
pub fn bounds_and_slopes(
    generator: NoiseGenerator,
    point: [Interval; 3],
) -> (Interval, [Interval; 3]) {
    range::range(generator, point)
}

/// Three noises at once: a direction to push `point` in, about zero.
pub fn vector_noise(point: Vector) -> Vector {
    Vector::from_array(blend(point))
}

/// About 0.5, seldom outside 0 … 1.
fn plain(point: Vector) -> f64 {
    let [first] = blend(point);
    first + 0.5
}

/// The first `N` components of the vector noise.
#[inline]
fn blend<const N: usize>(point: Vector) -> [f64; N] {
    let [x, y, z] = cells(point, LATTICE_ORIGIN);
    let mut sum = [0.0; N];
    for (i, x) in x.corners() {
        let row = step(i);
        for (j, y) in y.corners() {
            let column = step(row ^ j);
            let weight = x.weight * y.weight;
            for (k, z) in z.corners() {
                let place = step(column ^ k) % 256;
                let weight = weight * z.weight;
                for (c, sum) in sum.iter_mut().enumerate() {
                    let at = place + STRIDE * c;
                    let value = 0.5 * NUMBERS[at]
                        + NUMBERS[at + 1] * x.offset
                        + NUMBERS[at + 2] * y.offset
                        + NUMBERS[at + 3] * z.offset;
                    *sum += weight * value;
                }
            }
        }
    }
    sum
}

/// What a lattice point holds of the first.
fn plain_corner([i, j, k]: [usize; 3]) -> range::Linear {
    let at = step(step(step(i) ^ j) ^ k) % 256;
    [0.5 * NUMBERS[at], NUMBERS[at + 1], NUMBERS[at + 2], NUMBERS[at + 3]]
}

/// Where the table's zero lies: at (−10000, −10000, −10000).
const LATTICE_ORIGIN: i64 = 10_000;

fn step(index: usize) -> usize {
    usize::from(PERMUTATION[index % PERMUTATION.len()])
}

/// One coordinate among its two lattice neighbours.
#[derive(Clone, Copy)]
struct Cell {
    /// The lower neighbour; only its low bits are used, so that it may wrap.
    low: usize,
    /// From the lower neighbour, 0 … 1.
    fraction: f64,
}

/// What a corner of a cell means to one axis.
struct Corner {
    /// From the corner to the point, −1 … 1.
    offset: f64,
    /// How much the corner counts, 0 … 1.
    weight: f64,
}

impl Cell {
    /// Coordinates beyond 2⁵³ are lattice points; what is no number lies at 0.
    ///
    /// Not by `floor`, which is a call where the processor is not known to have it.
    #[inline]
    fn new(coordinate: f64, origin: i64) -> Self {
        let towards_zero = coordinate as i64;
        let above = towards_zero as f64 > coordinate;
        let low = towards_zero.wrapping_sub(i64::from(above));
        let fraction = coordinate - low as f64;
        let fraction = if (0.0..=1.0).contains(&fraction) { fraction } else { 0.0 };
        Self { low: low.wrapping_add(origin) as usize, fraction }
    }

    #[inline]
    fn corners(self) -> [(usize, Corner); 2] {
        let t = self.fraction;
        let weight = t * t * (3.0 - 2.0 * t);
        [
            (self.low, Corner { offset: t, weight: 1.0 - weight }),
            (self.low.wrapping_add(1), Corner { offset: t - 1.0, weight }),
        ]
    }
}

#[inline]
fn cells(point: Vector, origin: i64) -> [Cell; 3] {
    point.to_array().map(|coordinate| Cell::new(coordinate, origin))
}

#[cfg(test)]
mod tests;
