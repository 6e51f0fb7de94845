//! Estimates the error of a picture with unevenly distributed samples by drawing more pixels where errors
//! are likely.
//!
//! **In:** the expected error of each pixel. **Out:** randomly drawn pixels, their true colors, and the
//! error of the picture. **Invariant:** each pixel is weighted by the inverse of its probability, so that
//! the estimate is unbiased whatever errors were expected.
//!
//! **Source:** M. Hansen, W. Hurwitz, "On the theory of sampling from finite populations", Annals of
//! Mathematical Statistics 14, 1943.

use std::collections::BTreeSet;

use super::affordable_reference::{Deadline, LEAST};
use super::measure::Clock;
use super::proof::Audit;
use super::reference::{Studio, clamped, colors_of};
use super::refine::{Canvas, place};
use super::statistics::{Deviation, Estimate, Metric, weighted};
use crate::film::Film;
use crate::math::random::Random;
use crate::plan::Plan;
use crate::trace::{Counters, Sampling};

/// Fraction of draws that are uniform over all pixels. It bounds the weight of a pixel by its inverse,
/// however small the expected error.
const ANYWHERE: f64 = 0.5;
/// Number of draws between checks of the remaining time; enough for many threads.
const BLOCK: usize = 64;
/// Number of pixels whose shares are summed before one of them is drawn.
const CHUNK: usize = 64;
/// Maximum number of draws; more add little, as the interval is about a tenth of the error wide.
pub const MOST: usize = 2000;

/// A pixel that was drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Drawn {
    place: (u32, u32),
    /// Weight, 1 on average.
    weight: f64,
    /// Number of samples.
    count: u32,
}

/// Draws pixels with replacement.
pub struct Urn<'a> {
    canvas: &'a Canvas,
    /// Square of the expected error of each pixel.
    errors: Vec<f32>,
    /// Cumulative sums of `errors`, by chunk.
    sums: Vec<f64>,
    random: Random,
}

impl<'a> Urn<'a> {
    /// `expected` are the variances of the same `canvas`.
    pub fn new(canvas: &'a Canvas, expected: &[f32], seed: u64) -> Self {
        // The error of n samples, spread evenly over a pixel: an edge crosses the parts of about √n of them, and each
        // is then wrong at random; so its square falls with n√n.
        let error = |i: usize| {
            let n = canvas.film.pixels[i].samples() as f32;
            expected[i] / (n * n.sqrt())
        };
        let errors: Vec<f32> = (0..canvas.pixels()).map(error).collect();
        let mut sum = 0.0;
        let sums = errors.chunks(CHUNK).map(|chunk| {
            sum += chunk.iter().map(|&error| f64::from(error)).sum::<f64>();
            sum
        });
        Self { canvas, sums: sums.collect(), errors, random: Random::of(seed, 2) }
    }

    fn draw(&mut self) -> Drawn {
        let pixels = self.errors.len();
        let all = self.sums.last().copied().unwrap_or(0.0);
        let i = match all > 0.0 && self.random.number(0.0, 1.0) >= ANYWHERE {
            true => {
                let at = self.random.number(0.0, all);
                let chunk = self.sums.partition_point(|&sum| sum <= at).min(self.sums.len() - 1);
                let mut left = at - if chunk == 0 { 0.0 } else { self.sums[chunk - 1] };
                let first = chunk * CHUNK;
                let chunk = &self.errors[first..(first + CHUNK).min(pixels)];
                let found = chunk.iter().position(|&error| {
                    left -= f64::from(error);
                    left < 0.0
                });
                first + found.unwrap_or(chunk.len() - 1)
            }
            false => self.random.below(pixels),
        };
        let share = match all > 0.0 {
            true => ANYWHERE + (1.0 - ANYWHERE) * f64::from(self.errors[i]) / all * pixels as f64,
            false => 1.0,
        };
        Drawn {
            place: place(self.canvas.film.frame.region, i),
            weight: 1.0 / share,
            count: self.canvas.film.pixels[i].samples(),
        }
    }
}

/// True colors of drawn pixels, as two independent halves like a `Reference`.
pub struct Truth {
    drawn: Vec<Drawn>,
    halves: [Vec<[f64; 3]>; 2],
    pub counters: Counters,
}

impl Truth {
    /// Computes as many pixels, up to [`MOST`], as fit before the clock reaches the time that `until`
    /// returns for those already known.
    pub fn find(
        studio: &Studio,
        plan: &Plan,
        urn: &mut Urn,
        (metric, seed): (Metric, u64),
        (clock, until): (&dyn Clock, &dyn Fn(usize) -> f64),
    ) -> Self {
        let mut truth =
            Self { drawn: Vec::new(), halves: Default::default(), counters: Counters::default() };
        // A small picture's pixels are soon all known.
        let most = MOST.min(urn.errors.len()).max(LEAST);
        while truth.drawn.len() < most && clock.wall() < until(truth.drawn.len()) {
            let block = if truth.drawn.is_empty() { LEAST } else { BLOCK };
            let drawn: Vec<Drawn> = (0..block).map(|_| urn.draw()).collect();
            let first = truth.drawn.len() as u64;
            let aims = drawn.iter().zip(first..).flat_map(|(drawn, number)| {
                let side = side(metric, drawn.count);
                let half = |half| {
                    let seed = seed.wrapping_add((2 * number + half) << 32);
                    (drawn.place, Sampling::Jittered { side, seed })
                };
                [half(0), half(1)]
            });
            let watch = &Deadline { clock, until: until(truth.drawn.len()), watch: studio.watch };
            let studio = Studio { watch, ..*studio };
            let (seen, counters) = studio.pixels(plan, &aims.collect::<Vec<_>>());
            truth.counters += counters;
            let gamma = studio.world.settings.assumed_gamma;
            let colors: Vec<_> = seen
                .into_iter()
                .map_while(|seen| Some(clamped(seen?.mean.radiance, gamma)))
                .collect();
            for (drawn, pair) in drawn.iter().zip(colors.chunks_exact(2)) {
                truth.drawn.push(*drawn);
                (0..2).for_each(|half| truth.halves[half].push(pair[half]));
            }
            if colors.len() < 2 * drawn.len() {
                break;
            }
        }
        truth
    }

    pub fn pixels(&self) -> usize {
        self.drawn.len()
    }

    /// Estimates the error of a film.
    pub fn audit(&self, film: &Film, metric: Metric) -> Audit {
        let list: Vec<_> = self.drawn.iter().map(|drawn| drawn.place).collect();
        let weights: Vec<f64> = self.drawn.iter().map(|drawn| drawn.weight).collect();
        let colors = colors_of(film, &list);
        let halves = self.halves[0].iter().zip(&self.halves[1]);
        let off = colors.iter().zip(halves).map(|(color, (a, b))| Deviation {
            off: std::array::from_fn(|i| color[i] - (a[i] + b[i]) / 2.0),
            noise: std::array::from_fn(|i| (a[i] - b[i]) / 2.0),
        });
        let off: Vec<Deviation> = off.collect();
        let (error, noise) = weighted(metric, &off, &weights);
        let resolution = resolution(metric, error, noise);
        // Some are drawn more than once.
        let pixels = list.iter().collect::<BTreeSet<_>>().len();
        Audit { metric, error, resolution, pixels, depth: None, adc_bailout: None }
    }
}

/// Returns the bound below which an error cannot be distinguished from that of the reference. The mean of
/// (x − A)(x − B) is the true square error whatever the noise of A and B, and its interval accounts for
/// that noise; if the interval reaches 0, only its upper end is known. The other metrics count noise as
/// error.
fn resolution(metric: Metric, error: Estimate, noise: f64) -> f64 {
    match metric {
        Metric::Rmse if error.low > 0.0 => 0.0,
        Metric::Rmse => error.high.max(noise),
        Metric::P99 | Metric::Bad => 4.0 * noise,
    }
}

/// Returns the samples along the side of each half of the reference of a pixel with `count` samples. For RMSE,
/// a fifth more than these: their noise is then about as large as its error, which is the most efficient use of a
/// given time. Other metrics count noise as error and need it to be small.
fn side(metric: Metric, count: u32) -> u32 {
    let side = count.isqrt();
    match metric {
        Metric::Rmse => (side + side.div_ceil(10)).max(2),
        Metric::P99 | Metric::Bad => (2 * side).clamp(8, 48),
    }
}
