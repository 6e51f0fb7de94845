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

/// Beyond, coordinates are rounded too coarsely for slopes to tell anything.
const FAR: f64 = 1e6;

/// An interval that holds the noise of every point of a box.
///
/// From the middle on noise changes by no more than its steepest slope: with s = 3t² − 2t³, |s′| is at
/// most 1.5, and the linear functions of two neighbouring corners, of |value| ≤ ½ + 3 within a cell and
/// slope ≤ 1, differ by at most 7; so 1.5·7 + 1 along each axis. Perlin's have |value| ≤ √3.
pub fn bounds(generator: NoiseGenerator, point: [Interval; 3]) -> Interval {
    const RANGE: Interval = Interval { low: 0.0, high: 1.0 };
    if point.iter().any(|i| i.low.abs().max(i.high.abs()) >= FAR) {
        return RANGE;
    }
    let slope = match generator {
        NoiseGenerator::Plateaus => 11.5,
        NoiseGenerator::RangeCorrected => 11.5 * 0.489_855_83,
        // 1.5·2√3 + 1, and its scale.
        NoiseGenerator::Perlin => 6.2 * 0.795,
    };
    let middle = point.map(|i| i.low + 0.5 * (i.high - i.low));
    let away: f64 = point.iter().zip(middle).map(|(i, m)| (i.high - m).max(m - i.low)).sum();
    // What coordinates and sums are rounded by.
    let reach = slope * (away + 1e-8);
    let value = noise(generator, Vector::from_array(middle));
    Interval { low: (value - reach).max(0.0), high: (value + reach).min(1.0) }
}

/// Intervals that hold noise's slope along each axis at every point of a box; where it is cut off, 0 as well.
///
/// As [`bounds`], one derivative on: |s″| ≤ 6, so from the middle on each slope changes by at most
/// 6·7 + 2·1.5·2 for each length along its axis, and by 1.5²·14 + 1.5·2·2 along another. Perlin's lattice has
/// half of the slopes' sizes.
pub fn slopes(generator: NoiseGenerator, point: [Interval; 3]) -> [Interval; 3] {
    let (steepest, share) = match generator {
        NoiseGenerator::Plateaus => (11.5, 1.0),
        NoiseGenerator::RangeCorrected => (11.5 * 0.489_855_83, 0.489_855_83),
        NoiseGenerator::Perlin => (6.2 * 0.795, 0.795),
    };
    let all = Interval { low: -steepest, high: steepest };
    let away = point.map(|i| 0.5 * (i.high - i.low));
    if away.iter().sum::<f64>() > 0.5 || point.iter().any(|i| i.low.abs().max(i.high.abs()) >= FAR)
    {
        return [all; 3];
    }
    let middle = Vector::from_array(point.map(|i| i.low + 0.5 * (i.high - i.low)));
    let gradient = match generator {
        NoiseGenerator::Plateaus | NoiseGenerator::RangeCorrected => plain_gradient(middle),
        NoiseGenerator::Perlin => perlin::gradient(middle),
    };
    let range = bounds(generator, point);
    let may_be_cut = range.low <= 0.0 || range.high >= 1.0;
    std::array::from_fn(|axis| {
        let along: f64 = (0..3).map(|i| away[i] * if i == axis { 48.0 } else { 38.0 }).sum();
        let (slope, reach) = (share * gradient[axis], share * along + 1e-6);
        let near =
            Interval { low: (slope - reach).max(all.low), high: (slope + reach).min(all.high) };
        if may_be_cut { near.hull(Interval::point(0.0)) } else { near }
    })
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

/// The gradient of the first.
fn plain_gradient(point: Vector) -> Vector {
    let [x, y, z] = cells(point, LATTICE_ORIGIN);
    let mut sum = Vector::ZERO;
    for (i, x) in x.corners() {
        let row = step(i);
        for (j, y) in y.corners() {
            let column = step(row ^ j);
            for (k, z) in z.corners() {
                let at = step(column ^ k) % 256;
                let slope = Vector::new(NUMBERS[at + 1], NUMBERS[at + 2], NUMBERS[at + 3]);
                let offset = Vector::new(x.offset, y.offset, z.offset);
                let value = 0.5 * NUMBERS[at] + slope.dot(offset);
                sum += weighted_slope([&x, &y, &z], value, slope);
            }
        }
    }
    sum
}

/// The gradient of a corner's linear function times its weights.
fn weighted_slope([x, y, z]: [&Corner; 3], value: f64, slope: Vector) -> Vector {
    let rises = Vector::new(
        x.rise * y.weight * z.weight,
        x.weight * y.rise * z.weight,
        x.weight * y.weight * z.rise,
    );
    slope * (x.weight * y.weight * z.weight) + rises * value
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
    /// The weight's slope.
    rise: f64,
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
        let rise = 6.0 * t * (1.0 - t);
        [
            (self.low, Corner { offset: t, weight: 1.0 - weight, rise: -rise }),
            (self.low.wrapping_add(1), Corner { offset: t - 1.0, weight, rise }),
        ]
    }
}

#[inline]
fn cells(point: Vector, origin: i64) -> [Cell; 3] {
    point.to_array().map(|coordinate| Cell::new(coordinate, origin))
}

#[cfg(test)]
mod tests;
