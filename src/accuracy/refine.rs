//! Refines a picture as long as time permits, first where that reduces the error most.
//!
//! **In:** a film of one ray per pixel. **Out:** the same film with more samples in its pixels, spread over
//! all of it. **Invariant:** each pixel has the first samples of its sequence, and its bits depend on their number
//! alone. No pixel is neglected: a third of all samples is spread evenly, and no pixel is far ahead of its
//! neighbours. The work between two checks of the clock is bounded.

use std::collections::BTreeSet;

use super::measure::Clock;
use super::reference::{Studio, clamped};
use crate::color::Rgb;
use crate::film::{Film, Pixel};
use crate::plan::{Plan, Region};
use crate::trace::{self, Counters, Crew, FEW, Sampling, Sight, gain};

/// Maximum number of samples of a pixel, as in the most expensive setting of the knob.
pub const MOST: u32 = 1024;
/// Memory per pixel beside the film: the sum, the variance, and, while pixels are chosen, two more variances and a color or
/// a level and a place in the list.
pub const BYTES_PER_PIXEL: u64 =
    (size_of::<Sight>() + 3 * size_of::<f32>() + size_of::<(usize, u32)>()) as u64;
/// Ratio of variances at which a pixel has 16 times the samples of a neighbour, the most.
const AHEAD: f32 = 1024.0;
/// Standard deviation that each pixel is assumed to have besides its own, as a fraction of their mean: about a third of
/// all samples is then spread evenly.
const EVENLY: f64 = 0.25;
/// Number of adjacent pixels that are traced in sequence.
const RUN: usize = 16;
/// Maximum number of samples that a pass adds, as a fraction of those that are there and of those that there is time for:
/// each chooses anew where they are needed.
const AT_ONCE: f64 = 0.5;
const IN_TIME: f64 = 0.8;
/// A pass adds at least so many samples per pixel: choosing them takes time, too.
const LEAST: f64 = 1.0 / 64.0;
/// Maximum number of pixels between two looks at the clock.
pub const MOST_IN_PART: usize = 1 << 16;
/// Pixels with the same first bits of their gains, eight levels for each factor of two, are alike.
const LEVEL_BITS: u32 = 20;

/// Number of pixels that a thread looks at between checks of the clock.
const AT_A_TIME: usize = 1 << 14;

/// A film, with the variance of each pixel's samples.
pub struct Canvas {
    pub film: Film,
    /// Sum of each pixel's samples: what the film rounds, more samples continue.
    sums: Vec<Sight>,
    /// Pixels whose sample was taken with cheaper settings: it is dropped once there are others.
    cheap: BTreeSet<usize>,
    /// Variance of each pixel's samples, linear and clamped, summed over the components and opacity; 0 for a single
    /// sample.
    variances: Vec<f32>,
    pub counters: Counters,
    pace: Pace,
}

/// Time that samples took so far.
#[derive(Debug, Clone, Copy)]
pub struct Pace {
    pub seconds: f64,
    pub samples: f64,
}

impl Pace {
    /// Returns the seconds per sample.
    pub fn a_sample(self) -> f64 {
        self.seconds / self.samples.max(1.0)
    }
}

impl Canvas {
    /// Starts from a film of one ray per pixel, which took `pace`; those of `cheap` pixels were traced with cheaper
    /// settings.
    pub fn new(film: Film, cheap: &[usize], counters: Counters, pace: Pace) -> Self {
        let cheap: BTreeSet<usize> = cheap.iter().copied().collect();
        let sum = |(i, &pixel): (usize, &Pixel)| match cheap.contains(&i) {
            true => Sight::NOTHING,
            false => pixel.into(),
        };
        let sums = film.pixels.iter().enumerate().map(sum).collect();
        let variances = vec![0.0; film.pixels.len()];
        Self { film, sums, cheap, variances, counters, pace }
    }

    pub fn pixels(&self) -> usize {
        self.film.pixels.len()
    }

    /// Estimates each pixel's variance from its own samples and its neighbours'. `None` if stopped.
    ///
    /// If n samples agree, features smaller than 1/n of the pixel may be missed. Each pixel's variance is
    /// therefore shrunk toward its surroundings: the mean of its neighbours' variances, or the variance of
    /// an edge as high as its difference from a neighbour, d²/4.
    pub fn expected(&self, studio: &Studio) -> Option<Vec<f32>> {
        let crew = Crew::new(&studio.options, studio.watch);
        let (count, gamma) = (self.pixels(), self.film.assumed_gamma);
        let colors = crew
            .map(count, AT_A_TIME, |i| clamped(self.film.radiance(i), gamma).map(|c| c as f32))?;
        let alone = crew.map(count, AT_A_TIME, |i| {
            let (mut near, mut sum, mut edge) = (0.0f32, 0.0f32, 0.0f32);
            self.around(i, |j| {
                near += 1.0;
                sum += self.variances[j];
                let off =
                    colors[i].iter().zip(colors[j]).map(|(a, b)| (a - b) * (a - b)).sum::<f32>();
                edge = edge.max(off);
            });
            let near = trace::of_edge(edge.into()).max((sum / near.max(1.0)).into());
            let known = match self.film.pixels[i].samples() {
                0 | 1 => 0.0,
                samples => samples.into(),
            };
            trace::expected(self.variances[i].into(), known, near) as f32
        })?;
        crew.map(count, AT_A_TIME, |i| {
            let mut most = 0.0f32;
            self.around(i, |j| most = most.max(alone[j]));
            alone[i].max(most / AHEAD)
        })
    }

    /// Returns the number of a pixel's next sample.
    fn first(&self, i: usize) -> u32 {
        if self.cheap.contains(&i) { 0 } else { self.film.pixels[i].samples() }
    }

    /// Visits the up to eight neighbours of a pixel.
    fn around(&self, i: usize, mut each: impl FnMut(usize)) {
        let Region { width, height, .. } = self.film.frame.region;
        let (width, height) = (width as usize, height as usize);
        let (row, column) = (i / width, i % width);
        for y in row.saturating_sub(1)..(row + 2).min(height) {
            for x in column.saturating_sub(1)..(column + 2).min(width) {
                if (x, y) != (column, row) {
                    each(y * width + x);
                }
            }
        }
    }

    /// Gives more samples to the pixels where these lower the error most, if they have the `expected` variances. Returns
    /// false if stopped, if nothing is left to do or no time before the clock reaches `until`.
    pub fn pass(
        &mut self,
        studio: &Studio,
        plan: &Plan,
        expected: &[f32],
        (clock, until): (&dyn Clock, f64),
    ) -> bool {
        let all: f64 = self.film.samples().map(f64::from).sum();
        let left = (until - clock.wall()) / self.pace.a_sample();
        let most = (AT_ONCE * all).max(MOST.into()).min(IN_TIME * left);
        if most < LEAST * self.pixels() as f64 {
            return false;
        }
        let Some(list) = self.chosen(studio, expected, most) else { return false };
        // Samples in difficult pixels take longer than earlier ones, whose pace is therefore discounted.
        self.pace = Pace { seconds: self.pace.seconds / 16.0, samples: self.pace.samples / 16.0 };
        let mut parts = list.chunks(MOST_IN_PART);
        let is_whole =
            parts.all(|part| clock.wall() < until && self.trace(studio, plan, part, clock));
        !list.is_empty() && is_whole
    }

    /// Returns pixels and the samples that they get, spread over the film, where one more sample gains most; at most
    /// `most` new samples. `None` if stopped.
    fn chosen(&self, studio: &Studio, expected: &[f32], most: f64) -> Option<Vec<(usize, u32)>> {
        let roots: f64 = expected.iter().map(|&variance| f64::from(variance.sqrt())).sum();
        let evenly = EVENLY * roots / expected.len().max(1) as f64;
        // Where nothing differs, all pixels are alike.
        let evenly = if evenly > 0.0 { evenly * evenly } else { 1.0 };
        let crew = Crew::new(&studio.options, studio.watch);
        let levels = crew.map(self.pixels(), AT_A_TIME, |i| {
            let count = f64::from(self.film.pixels[i].samples());
            let gain = gain(f64::from(expected[i]) + evenly, count);
            ((gain as f32).to_bits() >> LEVEL_BITS) as u16
        })?;
        let next = |count: u32| (2 * count).clamp(FEW, MOST);
        let mut wanted = vec![0u64; 1 << (u32::BITS - LEVEL_BITS)];
        for (&level, count) in levels.iter().zip(self.film.samples()) {
            wanted[usize::from(level)] += u64::from(next(count) - count);
        }
        let mut left = most;
        let last = wanted.iter().rposition(|&samples| {
            left -= samples as f64;
            left < 0.0
        });
        // Of the last level there is time for some.
        let mut some = last.map_or(0.0, |last| left + wanted[last] as f64);
        let pick = |i: usize| {
            let count = self.film.pixels[i].samples();
            let mut new = next(count) - count;
            let level = Some(usize::from(levels[i]));
            if level < last {
                return None;
            }
            if level == last {
                new = new.min(some as u32);
                some -= f64::from(new);
            }
            (new > 0).then_some((i, count + new))
        };
        Some(spread(self.pixels()).filter_map(pick).collect())
    }

    /// Continues pixels, each up to a number of samples. Returns false if stopped.
    fn trace(
        &mut self,
        studio: &Studio,
        plan: &Plan,
        list: &[(usize, u32)],
        clock: &dyn Clock,
    ) -> bool {
        let began = clock.wall();
        let (region, gamma) = (self.film.frame.region, self.film.assumed_gamma);
        let aim = |&(i, count): &(usize, u32)| {
            let (first, sum) = (self.first(i), self.sums[i]);
            (place(region, i), Sampling::Numbered { first, end: count, sum })
        };
        let (seen, counters) = studio.pixels(plan, &list.iter().map(aim).collect::<Vec<_>>());
        self.counters += counters;
        let is_whole = seen.iter().all(Option::is_some);
        for (&(i, count), seen) in list.iter().zip(seen) {
            let Some(seen) = seen else { continue };
            let (before, all) = (f64::from(self.first(i)), f64::from(count));
            let new = all - before;
            let mean = |sum: Rgb, count: f64| clamped(sum * (1.0 / count), gamma);
            let (old, sum) = (self.sums[i].radiance, seen.sum.radiance);
            let off: f64 = match self.cheap.remove(&i) {
                true => 0.0,
                false => {
                    let means = [mean(old, before), mean(sum + old * -1.0, new)];
                    means[0].iter().zip(means[1]).map(|(a, b)| (a - b) * (a - b)).sum()
                }
            };
            let within = before * f64::from(self.variances[i]) + new * seen.variance;
            self.variances[i] = ((within + off * before * new / all) / all) as f32;
            self.film.pixels[i] = seen.mean.pixel(count);
            self.sums[i] = seen.sum;
        }
        self.pace.seconds += clock.wall() - began;
        self.pace.samples += counters.camera as f64;
        is_whole
    }
}

/// Whether each pixel has the maximum number of samples.
pub fn is_finest(film: &Film) -> bool {
    film.samples().all(|samples| samples == MOST)
}

/// Returns the pixel at index `i` of a film of this region.
pub fn place(region: Region, i: usize) -> (u32, u32) {
    let width = region.width as usize;
    (region.x + (i % width) as u32, region.y + (i / width) as u32)
}

/// Returns the numbers below `count`, in an order such that every prefix is spread over all of them.
pub fn spread(count: usize) -> impl Iterator<Item = usize> {
    let runs = count.div_ceil(RUN);
    // By the golden ratio, in a step that has no divisor in common with their number.
    let golden = (0.618 * runs as f64).round() as usize;
    let step = (golden.max(1)..).find(|&step| divisor(step, runs) == 1).unwrap_or(1);
    (0..runs).flat_map(move |number| {
        let run = (number as u128 * step as u128 % runs as u128) as usize;
        run * RUN..((run + 1) * RUN).min(count)
    })
}

/// Returns the greatest common divisor.
fn divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { divisor(b, a % b) }
}
