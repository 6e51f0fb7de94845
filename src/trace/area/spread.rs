//! Samples spread over an area light: fewer where they agree.
//!
//! **Invariant:** a sample depends on the place that is lit and its number; how many there are, on these samples.
//!
//! A shadow's edge that crosses the area divides about √n of n cells, and the light is known to about n^(−3/4) times
//! the deviation of the samples. That is held against the threshold.
//!
//! **Source:** I. Sobol, "On the distribution of points in a cube and the approximate evaluation of integrals", USSR
//! Comput. Math. Math. Phys. 7(4), 1967; T. Kollig, A. Keller, "Efficient multidimensional sampling", CGF 21(3), 2002.

use super::super::Walk;
use super::panel::{Facing, centred};
use super::sight::{Seen, Sight};
use crate::color::Rgb;
use crate::math::wide::{ROW, Rows};
use crate::plan::Samples;

/// How an area light is sampled.
pub(in crate::trace) struct Spread {
    /// Each power of two of them, from the first on, is stratified in all ways.
    sequence: Vec<[u32; 2]>,
    /// By how much the light may be off; below 0 for all samples.
    threshold: f64,
}

impl Spread {
    /// Returns `None` for what the scene says.
    pub fn new(samples: Samples) -> Option<Self> {
        let (most, threshold) = match samples {
            Samples::Scene => return None,
            Samples::Fixed(most) => (most, -1.0),
            Samples::Adaptive { threshold, most } => (most, threshold),
        };
        Some(Self { sequence: (0..most.max(1)).map(sobol).collect(), threshold })
    }

    pub fn most(&self) -> usize {
        self.sequence.len()
    }

    /// Returns the positions of samples from a number on, and how many there are.
    #[inline(always)]
    pub fn positions(&self, facing: &Facing, first: usize) -> (Rows, usize) {
        let mut positions = Rows::ZERO;
        let scramble = facing.bits(u64::MAX);
        let samples = &self.sequence[first..self.most().min(first + ROW)];
        for (number, bits) in samples.iter().enumerate() {
            let place = [0, 1].map(|side| centred(bits[side] ^ scramble[side]));
            positions.set(number, facing.position(place));
        }
        (positions, samples.len())
    }
}

/// Returns the point of this number of a sequence of points in a square, by their bits behind the point.
fn sobol(number: u32) -> [u32; 2] {
    let (mut second, mut direction) = (0, 1u32 << 31);
    for bit in 0..u32::BITS {
        second ^= if number >> bit & 1 == 1 { direction } else { 0 };
        direction ^= direction >> 1;
    }
    [number.reverse_bits(), second]
}

/// Samples so far.
#[derive(Default)]
struct Sums {
    count: usize,
    factors: Rgb,
    /// Of each component of the light, and of its square.
    light: [f64; 3],
    squares: [f64; 3],
}

impl Sums {
    fn add(&mut self, factor: Rgb, color: Rgb) {
        self.count += 1;
        self.factors += factor;
        for (i, c) in (factor * color).components().into_iter().enumerate() {
            self.light[i] += c;
            self.squares[i] += c * c;
        }
    }

    /// Whether the light is off by no more than `threshold`, by estimate.
    fn is_known(&self, threshold: f64) -> bool {
        let n = self.count as f64;
        let variance = |i: usize| self.squares[i] / n - (self.light[i] / n) * (self.light[i] / n);
        let most = (0..3).map(variance).fold(0.0, f64::max);
        threshold >= 0.0 && most <= threshold * threshold * n * n.sqrt()
    }
}

/// Returns what part of a light comes from its samples; `color` is the light without shadows.
pub(super) fn visible(sight: &Sight, walk: &mut Walk, spread: &Spread, color: Rgb) -> Rgb {
    let mut sums = Sums::default();
    while sums.count < spread.most() && !walk.patience.is_over {
        let (positions, count) = spread.positions(&sight.facing, sums.count);
        let seen = sight.look(walk, &positions, count);
        for number in 0..count {
            let factor = match &seen {
                Seen::Plain(lit) if lit >> number & 1 == 1 => Rgb::WHITE,
                Seen::Plain(_) => Rgb::BLACK,
                Seen::Filtered(factors) => factors[number],
            };
            sums.add(factor, color);
        }
        if sums.is_known(spread.threshold) {
            break;
        }
    }
    sums.factors * (1.0 / sums.count.max(1) as f64)
}
