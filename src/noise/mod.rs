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

#![expect(clippy::needless_range_loop, reason = "one form for all loops over lanes")]

mod lattice;
mod perlin;
mod range;
mod table;
mod turbulence;

pub use turbulence::Turbulence;

use crate::math::Vector;
use crate::math::interval::Interval;
use lattice::{Axis, Lanes, are_near};
use table::{NUMBERS, PERMUTATION, ROWS, STRIDE, TRIPLES};

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

/// Returns the noise at `point`, 0 … 1.
pub fn noise(generator: NoiseGenerator, point: Vector) -> f64 {
    let [value] = noises(generator, [[point.x], [point.y], [point.z]]);
    value
}

/// Returns the noise at several points, given as x, y and z of each. Two at once take less time than each alone.
#[inline(always)]
pub(crate) fn noises<const L: usize>(generator: NoiseGenerator, points: [[f64; L]; 3]) -> [f64; L] {
    let mut values = match generator {
        NoiseGenerator::Plateaus => plain(points),
        NoiseGenerator::RangeCorrected => {
            let mut values = plain(points);
            // −0.55242 … 1.48900 becomes 0 … 1.
            for value in &mut values {
                *value = (*value + 0.552_42) * 0.489_855_82;
            }
            values
        }
        NoiseGenerator::Perlin => perlin::noise(points),
    };
    for value in &mut values {
        *value = value.clamp(0.0, 1.0);
    }
    values
}

/// Returns an interval that contains the noise of every point of a box.
pub fn bounds(generator: NoiseGenerator, point: [Interval; 3]) -> Interval {
    range::range(generator, point).0
}

/// Returns [`bounds`], and intervals that contain the slope along each axis at every point of a box,
/// including 0 where noise is clamped.
pub fn bounds_and_slopes(
    generator: NoiseGenerator,
    point: [Interval; 3],
) -> (Interval, [Interval; 3]) {
    range::range(generator, point)
}

/// Returns three independent noises: a displacement of `point`, centred on zero.
#[inline]
pub fn vector_noise(point: Vector) -> Vector {
    // Four take as long as three.
    let [x, y, z, _] = blend(point);
    Vector::new(x, y, z)
}

/// Returns x and y of [`vector_noise`].
#[inline]
pub(crate) fn planar_noise(point: Vector) -> [f64; 2] {
    blend(point)
}

/// Noise around 0.5, rarely outside of 0 … 1.
#[inline(always)]
fn plain<const L: usize>(points: Lanes<L>) -> [f64; L] {
    let mut values = if are_near(&points) { first(points) } else { first_far(points) };
    for value in &mut values {
        *value += 0.5;
    }
    values
}

/// The first component of the vector noise.
#[inline(always)]
fn first<const L: usize>([x, y, z]: Lanes<L>) -> [f64; L] {
    const ORIGIN: f64 = LATTICE_ORIGIN as f64;
    let (x, y, z) = (Axis::new(x, ORIGIN), Axis::new(y, ORIGIN), Axis::new(z, ORIGIN));
    let mut rows = [[&ROWS[0].0; L]; 8];
    for l in 0..L {
        for i in 0..2 {
            let row = step(x.low[l].wrapping_add(i));
            for j in 0..2 {
                let column = step(row ^ y.low[l].wrapping_add(j));
                for k in 0..2 {
                    let place = step(column ^ z.low[l].wrapping_add(k)) % 256;
                    rows[i << 2 | j << 1 | k][l] = &ROWS[place].0;
                }
            }
        }
    }
    let mut sum = [0.0; L];
    for i in 0..2 {
        for j in 0..2 {
            let mut column = [0.0; L];
            for l in 0..L {
                column[l] = x.weight[i][l] * y.weight[j][l];
            }
            for k in 0..2 {
                let row = rows[i << 2 | j << 1 | k];
                let mut value = [0.0; L];
                for l in 0..L {
                    value[l] = row[l][0];
                }
                for l in 0..L {
                    value[l] += row[l][1] * x.offset[i][l];
                }
                for l in 0..L {
                    value[l] += row[l][2] * y.offset[j][l];
                }
                for l in 0..L {
                    value[l] += row[l][3] * z.offset[k][l];
                }
                let mut weight = column;
                for l in 0..L {
                    weight[l] *= z.weight[k][l];
                }
                for l in 0..L {
                    sum[l] += weight[l] * value[l];
                }
            }
        }
    }
    sum
}

#[cold]
#[inline(never)]
fn first_far<const L: usize>([x, y, z]: Lanes<L>) -> [f64; L] {
    std::array::from_fn(|l| {
        let [first] = blend_far(Vector::new(x[l], y[l], z[l]));
        first
    })
}

/// The first `N` components of the vector noise; a fourth is 0.
#[inline(always)]
fn blend<const N: usize>(point: Vector) -> [f64; N] {
    if !are_near(&[[point.x], [point.y], [point.z]]) {
        return blend_far(point);
    }
    let xy = Axis::new([point.x, point.y], LATTICE_ORIGIN as f64);
    let z = Axis::new([point.z], LATTICE_ORIGIN as f64);
    let mut sum = [0.0; N];
    for i in 0..2 {
        let row = step(xy.low[0].wrapping_add(i));
        for j in 0..2 {
            let column = step(row ^ xy.low[1].wrapping_add(j));
            let weight = xy.weight[i][0] * xy.weight[j][1];
            for k in 0..2 {
                let place = step(column ^ z.low[0].wrapping_add(k)) % 256;
                let weight = weight * z.weight[k][0];
                let [values, along_x, along_y, along_z] = &TRIPLES[place].0;
                let mut value = [0.0; N];
                for c in 0..N {
                    value[c] = values[c] + along_x[c] * xy.offset[i][0];
                }
                for c in 0..N {
                    value[c] += along_y[c] * xy.offset[j][1];
                }
                for c in 0..N {
                    value[c] += along_z[c] * z.offset[k][0];
                }
                for c in 0..N {
                    sum[c] += weight * value[c];
                }
            }
        }
    }
    sum
}

/// [`blend`], for coordinates of any size.
#[cold]
#[inline(never)]
fn blend_far<const N: usize>(point: Vector) -> [f64; N] {
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
                for (c, sum) in sum.iter_mut().take(3).enumerate() {
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

/// A component's data at a lattice point.
fn corner(component: usize, [i, j, k]: [usize; 3]) -> range::Linear {
    let at = step(step(step(i) ^ j) ^ k) % 256 + STRIDE * component;
    [0.5 * NUMBERS[at], NUMBERS[at + 1], NUMBERS[at + 2], NUMBERS[at + 3]]
}

/// Returns the number of an integer cell, 0 … 4095, by the same walk as for lattice points, but with the
/// table's origin at 0; only the low bits of the indices are used.
pub fn cell_number([i, j, k]: [i64; 3]) -> usize {
    let low = |index: i64| index as usize % PERMUTATION.len();
    step(step(step(low(i)) ^ low(j)) ^ low(k))
}

/// The origin of the table is at (−10000, −10000, −10000).
const LATTICE_ORIGIN: i64 = 10_000;

fn step(index: usize) -> usize {
    usize::from(PERMUTATION[index % PERMUTATION.len()])
}

/// A coordinate relative to its two lattice neighbours.
#[derive(Clone, Copy)]
struct Cell {
    /// The lower neighbour; only its low bits are used, so it may wrap.
    low: usize,
    /// Distance from the lower neighbour, 0 … 1.
    fraction: f64,
}

/// A corner of a cell relative to one axis.
struct Corner {
    /// Offset from the corner to the point, −1 … 1.
    offset: f64,
    /// Weight of the corner, 0 … 1.
    weight: f64,
}

impl Cell {
    /// Splits a coordinate. Coordinates beyond 2⁵³ are lattice points; NaN counts as 0.
    ///
    /// Avoids `floor`, which is a function call unless the target is known to support it.
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
