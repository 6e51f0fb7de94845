//! Refines a picture as long as time permits, first where that reduces the error most.
//!
//! **In:** a film of one ray per pixel. **Out:** the same film with more samples in its pixels, spread over
//! all of it. **Invariant:** each pixel has the exact bits of `--antialias N` for some N, which its sample
//! count shows. No pixel is neglected: a third of all samples is spread evenly, and no pixel is far ahead
//! of its neighbours. The work between two checks of the clock is bounded.

use std::num::NonZero;
use std::thread;

use super::measure::Clock;
use super::reference::{Studio, clamped};
use crate::color::{Gamma, Rgb};
use crate::film::{Film, Pixel};
use crate::plan::{Plan, Region};
use crate::trace::{Aim, Counters, Seen, Watch};

/// Maximum number of samples along a pixel's side, as in the most expensive setting of the knob.
pub const MOST_SIDE: u32 = 32;
/// Memory per pixel beside the film: three variances, and a color.
pub const BYTES_PER_PIXEL: u64 = (3 * size_of::<f32>() + size_of::<[f32; 3]>()) as u64;
/// Number of samples that the information from a pixel's neighbours counts as.
const NEIGHBOURS: f32 = 1.0;
/// Maximum ratio of a pixel's samples to those of a neighbour, squared, since weights are roots of
/// variances.
const AHEAD: f32 = 16.0 * 16.0;
/// Fraction of all samples that is spread evenly.
const EVENLY: f64 = 1.0 / 3.0;
/// Minimum factor, along its side, by which a retraced pixel's samples grow. 4/3 is the most efficient, as
/// (1 − x⁻³)/x² has its maximum at 1.36.
const ANEW: (u32, u32) = (4, 3);
/// Number of adjacent pixels that are traced in sequence.
const RUN: usize = 16;
/// Number of parts of a pass; each is as fine as time permits after the previous ones. More parts are used
/// if one would have more pixels than can be listed in a few milliseconds.
const PARTS: usize = 8;
pub const MOST_IN_PART: usize = 1 << 16;
/// Number of pixels used to predict the cost of a pass.
const PRICED: usize = 1 << 14;
/// Ratio of fineness between levels. Levels range from less than a sample for sixteen pixels to the maximum
/// for every pixel.
const LEVEL: f64 = 1.189_207_115_002_721;
const LEVELS: i32 = 72;
const COARSEST: i32 = -20;

/// Rows of pixels between checks of the clock, and number of pixels that justifies another thread.
const ROWS: usize = 64;
const LEAST_OF_THREAD: usize = 1 << 14;

/// A film, with the variance of each pixel's samples.
pub struct Canvas {
    pub film: Film,
    /// Variance of each pixel's samples, linear and clamped, summed over the components; 0 for a single
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

/// Weight of each pixel for distributing samples, and its expected error.
pub struct Worth {
    /// Variances, as estimated by [`Canvas::worth`].
    pub variances: Vec<f32>,
    /// Contribution of the evenly spread samples, equal for all pixels.
    evenly: f64,
    /// Mean of the roots of variances.
    mean: f64,
}

impl Worth {
    /// Returns the samples along a pixel's side if an average pixel has `fineness` samples: Neyman
    /// allocation in proportion to the standard deviation, plus the evenly spread samples.
    fn side(&self, i: usize, fineness: f64) -> u32 {
        let weight =
            (f64::from(self.variances[i].sqrt()) + self.evenly) / (self.mean + self.evenly);
        in_reach((fineness * weight).sqrt().round() as u32)
    }
}

/// Time available for refining a film.
#[derive(Clone, Copy)]
pub struct Until<'a> {
    pub clock: &'a dyn Clock,
    /// Deadline in clock time.
    pub until: f64,
}

impl Canvas {
    /// Starts from a film of one ray per pixel, which took `pace`.
    pub fn new(film: Film, counters: Counters, pace: Pace) -> Self {
        Self { variances: vec![0.0; film.pixels.len()], film, counters, pace }
    }

    pub fn pixels(&self) -> usize {
        self.film.pixels.len()
    }

    pub fn pace(&self) -> Pace {
        self.pace
    }

    pub fn side(&self, i: usize) -> u32 {
        self.film.pixels[i].samples().isqrt()
    }

    /// Estimates each pixel's variance from its own samples and its neighbours'. `None` if stopped.
    ///
    /// If n samples agree, features smaller than 1/n of the pixel may be missed. Each pixel's variance is
    /// therefore shrunk toward its surroundings: the mean of its neighbours' variances, or the variance of
    /// an edge as high as its difference from a neighbour, d²/4.
    pub fn worth(&self, studio: &Studio) -> Option<Worth> {
        let threads =
            studio.options.threads.or(thread::available_parallelism().ok().map(NonZero::get));
        let in_rows =
            Rows { width: self.film.frame.region.width as usize, threads, watch: studio.watch };
        let (count, gamma) = (self.pixels(), self.film.assumed_gamma);
        let colors =
            in_rows.map(count, |i| clamped(self.film.radiance(i), gamma).map(|c| c as f32))?;
        let alone = in_rows.map(count, |i| {
            let (mut near, mut sum, mut edge) = (0.0f32, 0.0f32, 0.0f32);
            in_rows.around(i, count, |j| {
                near += 1.0;
                sum += self.variances[j];
                let off =
                    colors[i].iter().zip(colors[j]).map(|(a, b)| (a - b) * (a - b)).sum::<f32>();
                edge = edge.max(off / 4.0);
            });
            let near = edge.max(sum / near.max(1.0));
            let known = match self.film.pixels[i].samples() {
                0 | 1 => 0.0,
                samples => samples as f32,
            };
            (known * self.variances[i] + NEIGHBOURS * near) / (known + NEIGHBOURS)
        })?;
        let variances = in_rows.map(count, |i| {
            let mut most = 0.0f32;
            in_rows.around(i, count, |j| most = most.max(alone[j]));
            alone[i].max(most / AHEAD)
        })?;
        let sum: f64 = variances.iter().map(|variance| f64::from(variance.sqrt())).sum();
        let mean = sum / variances.len().max(1) as f64;
        // Where nothing differs, all pixels are alike.
        let evenly = if mean > 0.0 { mean * EVENLY / (1.0 - EVENLY) } else { 1.0 };
        Some(Worth { variances, evenly, mean })
    }

    /// Traces every pixel with about `side` × `side` samples. Returns false if stopped.
    pub fn pilot(&mut self, studio: &Studio, plan: &Plan, side: u32, clock: &dyn Clock) -> bool {
        let side = in_reach(side);
        let parts = self.parts();
        (0..parts).all(|part| {
            let aim = |canvas: &Self, i| (canvas.side(i) < side).then_some(side);
            self.trace(studio, plan, (part, parts), &aim, clock)
        })
    }

    /// Makes one pass over the film, as fine as time permits. Returns false if stopped or if nothing is
    /// left to do.
    pub fn pass(&mut self, studio: &Studio, plan: &Plan, worth: &Worth, time: Until) -> bool {
        let prices = self.prices(worth);
        let parts = self.parts();
        let before = self.counters.camera;
        // Samples in difficult pixels take longer than earlier ones, whose pace is therefore discounted.
        self.pace = Pace { seconds: self.pace.seconds / 16.0, samples: self.pace.samples / 16.0 };
        for part in 0..parts {
            let left = (time.until - time.clock.wall()) / (parts - part) as f64;
            let samples = left / self.pace.a_sample() * parts as f64 / self.pixels() as f64;
            let Some(fineness) = finest(&prices, samples) else { break };
            let aim = |canvas: &Self, i| {
                let (side, now) = (worth.side(i, fineness), canvas.side(i));
                is_anew(now, side).then_some(side)
            };
            if !self.trace(studio, plan, (part, parts), &aim, time.clock) {
                return false;
            }
        }
        self.counters.camera > before
    }

    /// Returns each level of fineness with the average number of samples per pixel that a pass takes.
    fn prices(&self, worth: &Worth) -> Vec<(f64, f64)> {
        // Odd, so that it walks through all columns.
        let step = (self.pixels() / PRICED) | 1;
        let mut fineness = (0..-COARSEST).fold(1.0, |fineness, _| fineness / LEVEL);
        let levels = (0..LEVELS).map(|_| {
            fineness *= LEVEL;
            let (mut samples, mut pixels) = (0u64, 0u64);
            for i in (0..self.pixels()).step_by(step) {
                let side = worth.side(i, fineness);
                pixels += 1;
                if is_anew(self.side(i), side) {
                    samples += u64::from(side * side);
                }
            }
            (fineness, samples as f64 / pixels.max(1) as f64)
        });
        levels.collect()
    }

    fn parts(&self) -> usize {
        PARTS.max(self.pixels().div_ceil(MOST_IN_PART))
    }

    /// Traces the pixels of one part for which `aim` returns a side. Returns false if stopped.
    fn trace(
        &mut self,
        studio: &Studio,
        plan: &Plan,
        (part, parts): (usize, usize),
        aim: &dyn Fn(&Self, usize) -> Option<u32>,
        clock: &dyn Clock,
    ) -> bool {
        let began = clock.wall();
        let region = self.film.frame.region;
        let list: Vec<(usize, u32)> = Spread::new(self.pixels())
            .part(part, parts)
            .filter_map(|i| Some((i, aim(self, i)?)))
            .collect();
        let aims: Vec<Aim> = list
            .iter()
            .map(|&(i, side)| Aim { place: place(region, i), side, seed: None })
            .collect();
        if aims.is_empty() {
            return !studio.watch.should_stop();
        }
        let (seen, counters) = studio.seen(plan, &aims);
        self.counters += counters;
        let mut is_whole = true;
        for ((i, side), seen) in list.into_iter().zip(seen) {
            let Some(Seen { mean, opacity, deviation }) = seen else {
                is_whole = false;
                continue;
            };
            self.film.pixels[i] = Pixel::new(mean, side * side).with_opacity(opacity);
            self.variances[i] = variance(mean, deviation, self.film.assumed_gamma);
        }
        self.pace.seconds += clock.wall() - began;
        self.pace.samples += counters.camera as f64;
        is_whole
    }
}

/// Whether each pixel has the maximum number of samples.
pub fn is_finest(film: &Film) -> bool {
    film.samples().all(|samples| samples == MOST_SIDE * MOST_SIDE)
}

fn is_anew(now: u32, side: u32) -> bool {
    side > now && ANEW.1 * side >= ANEW.0 * now
}

/// Rounds a side near the maximum to the largest from which retracing the pixel still pays, or to the
/// maximum.
fn in_reach(side: u32) -> u32 {
    let last = MOST_SIDE * ANEW.1 / ANEW.0;
    match side {
        _ if side <= last => side,
        _ if side < (last + MOST_SIDE) / 2 => last,
        _ => MOST_SIDE,
    }
}

/// Returns the first level that takes as many `samples` per pixel, or the last; any excess is saved in the
/// next parts. `None` if there is no time at all.
fn finest(prices: &[(f64, f64)], samples: f64) -> Option<f64> {
    if samples <= 0.0 {
        return None;
    }
    let enough = prices.iter().find(|&&(_, price)| price >= samples);
    enough.or(prices.last()).map(|&(fineness, _)| fineness)
}

/// Returns the variance in linear light, as used for measuring errors, given the mean of samples in the
/// working space and their standard deviation. Above white it is 0.
fn variance(mean: Rgb, deviation: [f64; 3], gamma: Gamma) -> f32 {
    let shown = |c: f64| gamma.linear(c).min(1.0);
    let parts = mean.components().into_iter().zip(deviation);
    let spread = parts.map(|(mean, off)| (shown(mean + off) - shown(mean - off)) / 2.0);
    spread.map(|off| off * off).sum::<f64>() as f32
}

/// Returns the pixel at index `i` of a film of this region.
pub fn place(region: Region, i: usize) -> (u32, u32) {
    let width = region.width as usize;
    (region.x + (i % width) as u32, region.y + (i / width) as u32)
}

/// Indices of a film's pixels, in an order such that every prefix is spread over the film.
pub struct Spread {
    count: usize,
    runs: usize,
    step: usize,
}

impl Spread {
    pub fn new(count: usize) -> Self {
        let runs = count.div_ceil(RUN);
        // By the golden ratio, in a step that has no divisor in common with their number.
        let golden = (0.618 * runs as f64).round() as usize;
        let step = (golden.max(1)..).find(|&step| divisor(step, runs) == 1).unwrap_or(1);
        Self { count, runs, step }
    }

    /// Returns the k-th of `parts` parts.
    pub fn part(self, k: usize, parts: usize) -> impl Iterator<Item = usize> {
        let Self { count, runs, step } = self;
        let (from, to) = (runs * k / parts, runs * (k + 1) / parts);
        (from..to).flat_map(move |number| {
            let run = (number as u128 * step as u128 % runs as u128) as usize;
            run * RUN..((run + 1) * RUN).min(count)
        })
    }
}

/// Returns the greatest common divisor.
fn divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { divisor(b, a % b) }
}

/// Computes a value for each pixel on several threads.
struct Rows<'a> {
    width: usize,
    threads: Option<usize>,
    watch: &'a dyn Watch,
}

impl Rows<'_> {
    /// Returns `None` if stopped.
    fn map<T: Copy + Default + Send>(
        &self,
        count: usize,
        of: impl Fn(usize) -> T + Sync,
    ) -> Option<Vec<T>> {
        let mut values = vec![T::default(); count];
        // Few pixels are done before a thread has begun.
        let threads = self.threads.unwrap_or(1).min(count / LEAST_OF_THREAD).max(1);
        let rows = (count / self.width).div_ceil(threads).max(1);
        let band = |first: usize, values: &mut [T]| {
            values.chunks_mut(self.width).enumerate().all(|(row, values)| {
                let first = first + row * self.width;
                values.iter_mut().enumerate().for_each(|(i, value)| *value = of(first + i));
                (row + 1) % ROWS != 0 || !self.watch.should_stop()
            })
        };
        let bands = values.chunks_mut(rows * self.width).enumerate();
        let is_whole = thread::scope(|scope| {
            let bands = bands.map(|(number, values)| (number * rows * self.width, values));
            let mut bands: Vec<_> = bands.collect();
            let own = if bands.is_empty() { None } else { Some(bands.remove(0)) };
            let others: Vec<_> = bands
                .into_iter()
                .map(|(first, values)| scope.spawn(move || band(first, values)))
                .collect();
            let own = own.is_none_or(|(first, values)| band(first, values));
            others.into_iter().fold(own, |all, other| other.join().unwrap_or(false) && all)
        });
        is_whole.then_some(values)
    }

    /// Visits the up to eight neighbours of a pixel.
    fn around(&self, i: usize, count: usize, mut each: impl FnMut(usize)) {
        let (row, column) = (i / self.width, i % self.width);
        let last = count / self.width;
        for y in row.saturating_sub(1)..(row + 2).min(last) {
            for x in column.saturating_sub(1)..(column + 2).min(self.width) {
                if (x, y) != (column, row) {
                    each(y * self.width + x);
                }
            }
        }
    }
}
