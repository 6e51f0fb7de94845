//! A picture made better as long as there is time, first where it buys most.
//!
//! **In:** a film of one ray a pixel. **Out:** the same film with more samples in some pixels, spread
//! over the whole of it. **Invariant:** each pixel has the bits of `--antialias N` for some N, or of
//! the first pass, and its samples say which; without a deadline the same film on every run.

use super::reference::{Studio, clamped};
use crate::film::Film;
use crate::plan::{Antialias, Plan, Region};
use crate::trace::{Counters, Sampling};

/// Samples along a pixel's side, one after the other.
const SIDES: [u32; 5] = [2, 4, 8, 16, MOST_SIDE];
/// At most: as in the dearest setting of the knob.
const MOST_SIDE: u32 = 32;
/// Even a flat pixel may hide something: it counts as if it differed this much from its neighbours.
const HIDDEN: f64 = 1e-3;
/// From one sweep over the picture to the next, what is worth its samples falls by this.
const FINER: f64 = 0.25;
/// Neighbours in the film that are traced one after the other.
const RUN: usize = 16;

/// What came of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Refined {
    /// Pixels that were traced anew.
    pub pixels: usize,
    /// Each has the most samples there are.
    pub is_finest: bool,
    pub counters: Counters,
}

/// Gives the film's pixels more samples by the settings of `plan`, its antialiasing aside, until
/// `studio` is stopped. Where they are `other` settings than the film was made with, each pixel gets
/// one new ray first.
///
/// An edge of height d crosses about n of a pixel's n × n parts, and each is then wrong by about d/n²,
/// at random: together d/n^1.5. So twice as many parts along a side take (1 − 1/8)·d²/n³ off the
/// square error, for 4n² samples. What buys most for a sample goes first.
pub fn refine(studio: &Studio, plan: &Plan, other: bool, film: &mut Film) -> Refined {
    let heights = contrasts(film);
    let count = heights.len();
    let first = if other { 0 } else { 1 };
    let sides = vec![first; count];
    let mut canvas = Canvas { studio, plan, film, heights, sides, counters: Counters::default() };
    if !other || canvas.sweep(1, (0..count).collect()) {
        canvas.refine();
    }
    let pixels = canvas.sides.iter().filter(|&&side| side > first).count();
    Refined { pixels, is_finest: canvas.is_finest(), counters: canvas.counters }
}

/// What twice as many parts along a side as before, `side` then, take off the square error for a
/// sample.
fn worth(height: f64, side: u32) -> f64 {
    let n = f64::from(side / 2);
    let height = height.max(HIDDEN);
    0.875 * height * height / (n * n * n) / (4.0 * n * n)
}

struct Canvas<'a> {
    studio: &'a Studio<'a>,
    plan: &'a Plan,
    film: &'a mut Film,
    /// Of the edge that each pixel may hold.
    heights: Vec<f64>,
    /// Of each pixel the samples along its side; 0 where it has other settings.
    sides: Vec<u32>,
    counters: Counters,
}

impl Canvas<'_> {
    fn is_finest(&self) -> bool {
        self.sides.iter().all(|&side| side == MOST_SIDE)
    }

    fn refine(&mut self) {
        let greatest = self.heights.iter().copied().fold(HIDDEN, f64::max);
        let mut least = worth(greatest, 2);
        while !self.is_finest() {
            // The finest first: a pixel gets at once all that it is worth.
            for &side in SIDES.iter().rev() {
                let is_worth =
                    |&i: &usize| self.sides[i] < side && worth(self.heights[i], side) >= least;
                let list = (0..self.sides.len()).filter(is_worth).collect();
                if !self.sweep(side, list) {
                    return;
                }
            }
            least *= FINER;
        }
    }

    /// Traces pixels anew. False when it was stopped.
    fn sweep(&mut self, side: u32, list: Vec<usize>) -> bool {
        let list = spread(list);
        let plan = Plan { antialias: Antialias::Grid(side), ..self.plan.clone() };
        let region = self.film.frame.region;
        let places: Vec<_> = list.iter().map(|&i| place(region, i)).collect();
        let seen = self.studio.pixels(&plan, &places, Sampling::Planned);
        self.counters += seen.counters;
        let mut all = true;
        for (i, radiance) in list.into_iter().zip(seen.radiance) {
            let Some(radiance) = radiance else {
                all = false;
                continue;
            };
            if side > 1 {
                // By how much the last samples were wrong tells more than the neighbours did.
                let n = f64::from(self.sides[i]);
                let gamma = self.film.assumed_gamma;
                let wrong =
                    difference(clamped(self.film.radiance[i], gamma), clamped(radiance, gamma));
                self.heights[i] = (2.0 * wrong * n * n.sqrt()).max(self.heights[i] / 4.0);
            }
            self.film.radiance[i] = radiance;
            (self.film.samples[i], self.sides[i]) = (side * side, side);
        }
        all
    }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

/// Where the pixel lies that a film of this region has at `i`.
pub fn place(region: Region, i: usize) -> (u32, u32) {
    let width = region.width as usize;
    (region.x + (i % width) as u32, region.y + (i / width) as u32)
}

/// How much each pixel differs from one of its four neighbours.
fn contrasts(film: &Film) -> Vec<f64> {
    let colors: Vec<_> = film.radiance.iter().map(|&c| clamped(c, film.assumed_gamma)).collect();
    let width = film.frame.region.width as usize;
    let mut heights = vec![0.0; colors.len()];
    let mut compare = |i: usize, j: usize| {
        let off = difference(colors[i], colors[j]);
        heights[i] = off.max(heights[i]);
        heights[j] = off.max(heights[j]);
    };
    for i in 0..colors.len() {
        if (i + 1) % width != 0 {
            compare(i, i + 1);
        }
        if i + width < colors.len() {
            compare(i, i + width);
        }
    }
    heights
}

/// In another order: of each first part, about the same share lies in any part of the picture.
pub fn spread(list: Vec<usize>) -> Vec<usize> {
    let runs: Vec<&[usize]> = list.chunks(RUN).collect();
    // By the golden ratio, in a step that has no divisor in common with their number.
    let golden = (0.618 * runs.len() as f64).round() as usize;
    let step = (golden.max(1)..).find(|&step| divisor(step, runs.len()) == 1).unwrap_or(1);
    (0..runs.len()).flat_map(|k| runs[k * step % runs.len()]).copied().collect()
}

/// The greatest common one.
fn divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { divisor(b, a % b) }
}
