//! Computes the true colors of pixels to a chosen accuracy, with an estimate of that accuracy.
//!
//! **Invariant:** a reference consists of two halves that share no sample. Half their difference is the
//! reference's own error, and is reported.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::statistics::{Deviation, Metric};
use crate::color::{Gamma, Rgb};
use crate::film::Film;
use crate::geometry::Geometry;
use crate::plan::{Arithmetic, Plan};
use crate::trace::{
    self, Aim, Counters, Sampling, Seen, TraceOptions, Traced, Watch, aims, pixels, trace_in,
};
use crate::world::World;

/// Samples along the side of a pixel, for each half. From [`Reference::COARSEST`] on, each step has about
/// twice the samples of the previous one.
const SIDES: [u32; 7] = [2, 11, 16, 23, 32, 45, 64];

/// Number of blocks into which a list is divided. Both halves of a block are traced before the next block,
/// so that at most one block is lost when stopped.
const BLOCKS: usize = 16;
/// Minimum number of pixels per block; enough for many threads.
const LEAST_BLOCK: usize = 64;

/// Returns a color as used for measuring errors: linear, clamped to 0 … 1.
pub fn clamped(radiance: Rgb, assumed_gamma: Gamma) -> [f64; 3] {
    radiance.components().map(|c| assumed_gamma.linear(c).min(1.0))
}

/// Returns the colors of some pixels of a film, as used for measuring errors.
pub fn colors_of(film: &Film, list: &[(u32, u32)]) -> Vec<[f64; 3]> {
    let radiance = |&(x, y): &(u32, u32)| film.radiance(film.index(x, y));
    list.iter().map(|place| clamped(radiance(place), film.assumed_gamma)).collect()
}

/// The World prepared for each arithmetic, created on first use.
#[derive(Default)]
pub struct Geometries {
    made: Mutex<Vec<(Arithmetic, Arc<Geometry>)>>,
}

/// What is traced, and the resources for tracing it.
#[derive(Clone, Copy)]
pub struct Studio<'a> {
    pub world: &'a World,
    pub geometry: &'a Geometries,
    pub options: TraceOptions,
    pub watch: &'a dyn Watch,
}

impl Studio<'_> {
    /// Returns the geometry for a plan, creating it if needed.
    pub fn geometry(&self, plan: &Plan) -> Arc<Geometry> {
        let mut made = self.geometry.made.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, geometry)) = made.iter().find(|(made, _)| *made == plan.arithmetic()) {
            return geometry.clone();
        }
        let geometry = Arc::new(trace::geometry(self.world, plan, &self.options));
        self.watch.built();
        made.push((plan.arithmetic(), geometry.clone()));
        geometry
    }

    /// Traces the entire picture.
    pub fn picture(&self, plan: &Plan, watch: &dyn Watch) -> Traced {
        trace_in(self.world, &self.geometry(plan), plan, &self.options, watch)
    }

    /// Traces some pixels.
    pub fn pixels(&self, plan: &Plan, aims: &[Aim]) -> (Vec<Option<Seen>>, Counters) {
        pixels(self.world, &self.geometry(plan), plan, aims, &self.options, self.watch)
    }

    /// Returns the colors of the first pixels of a list: all of them, unless stopped.
    pub fn first_colors(
        &self,
        plan: &Plan,
        list: &[(u32, u32)],
        sampling: Sampling,
    ) -> (Vec<[f64; 3]>, Counters) {
        let (seen, counters) = self.pixels(plan, &aims(list, sampling));
        let gamma = self.world.settings.assumed_gamma;
        (
            seen.into_iter().map_while(|seen| Some(clamped(seen?.mean.radiance, gamma))).collect(),
            counters,
        )
    }

    /// Returns the colors of some pixels, and the work they took. `None` if stopped.
    pub fn colors(
        &self,
        plan: &Plan,
        list: &[(u32, u32)],
        sampling: Sampling,
    ) -> Option<(Vec<[f64; 3]>, Counters)> {
        let (colors, counters) = self.first_colors(plan, list, sampling);
        (colors.len() == list.len()).then_some((colors, counters))
    }
}

/// Forwards the progress of a part as progress of the total.
struct Part<'a> {
    watch: &'a dyn Watch,
    /// Work done before this part.
    before: AtomicUsize,
    all: usize,
}

impl Watch for Part<'_> {
    fn progress(&self, done: usize, _: usize) {
        self.watch.progress(self.before.load(Ordering::Relaxed) + done, self.all);
    }

    fn built(&self) {
        self.watch.built();
    }

    fn should_stop(&self) -> bool {
        self.watch.should_stop()
    }
}

fn is_rounding(a: &[f64; 3], b: &[f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= ROUNDING)
}

/// Two independent estimates of each pixel of a list.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    halves: [Vec<[f64; 3]>; 2],
    /// Index into [`SIDES`].
    step: usize,
    seed: u64,
    pub counters: Counters,
}

/// Rounding error of a film's colors, relative to full scale: half of `f32::EPSILON` of each, and up to four times
/// that in linear light.
pub const ROUNDING: f64 = 2.0 * f32::EPSILON as f64;

impl Reference {
    /// Step of a reference that is inaccurate per pixel but usable over many pixels, for lack of time.
    pub const ROUGH: usize = 0;
    /// Coarsest step by which settings are chosen.
    pub const COARSEST: usize = 1;
    /// Returns the last step that needs at most `samples` samples per pixel, or the rough one.
    pub fn finest_within(samples: usize) -> usize {
        SIDES.iter().rposition(|&side| 2 * side as usize * side as usize <= samples).unwrap_or(0)
    }

    /// Returns the samples per pixel at a step.
    pub fn samples_at(step: usize) -> u32 {
        let side = SIDES[step.min(SIDES.len() - 1)];
        2 * side * side
    }

    /// Computes the reference of a step; `None` if stopped. `plan` sets the depth; its antialiasing is
    /// ignored.
    pub fn new(
        studio: &Studio,
        plan: &Plan,
        list: &[(u32, u32)],
        seed: u64,
        step: usize,
    ) -> Option<Self> {
        let first = Self::first(studio, plan, list, seed, step);
        (first.pixels() == list.len()).then_some(first)
    }

    /// Like [`Reference::new`], for the first pixels of the list that were finished before it was stopped.
    pub fn first(
        studio: &Studio,
        plan: &Plan,
        list: &[(u32, u32)],
        seed: u64,
        step: usize,
    ) -> Self {
        let step = step.min(SIDES.len() - 1);
        let mut reference =
            Self { halves: Default::default(), step, seed, counters: Counters::default() };
        let part = Part { watch: studio.watch, before: AtomicUsize::new(0), all: 2 * list.len() };
        let studio = &Studio { watch: &part, ..*studio };
        let block = list.len().div_ceil(BLOCKS).max(LEAST_BLOCK);
        for pixels in list.chunks(block) {
            let mut half = |number: u64| {
                let (steps, step_seed) = (2 * SIDES.len() as u64 - 2, 2 * step as u64 + number);
                let seed = seed.wrapping_mul(steps).wrapping_add(step_seed).wrapping_sub(2);
                let sampling = Sampling::Jittered { side: SIDES[step], seed };
                let (colors, work) = studio.first_colors(plan, pixels, sampling);
                part.before.fetch_add(pixels.len(), Ordering::Relaxed);
                reference.counters += work;
                colors
            };
            let (mut a, mut b) = (half(0), half(1));
            let done = a.len().min(b.len());
            a.truncate(done);
            b.truncate(done);
            reference.halves[0].extend(a);
            reference.halves[1].extend(b);
            if done < pixels.len() {
                break;
            }
        }
        reference
    }

    /// Doubles the samples. Returns `Some(false)` if the reference is already as fine as possible, `None`
    /// if stopped.
    pub fn double(&mut self, studio: &Studio, plan: &Plan, list: &[(u32, u32)]) -> Option<bool> {
        if self.is_finest() || self.is_exact() {
            return Some(false);
        }
        let finer = Self::new(studio, plan, list, self.seed, self.step + 1)?;
        let before = self.counters;
        *self = finer;
        self.counters += before;
        Some(true)
    }

    pub fn is_finest(&self) -> bool {
        self.step + 1 == SIDES.len()
    }

    /// Whether its own error is at most the rounding error of sums, which more samples do not reduce.
    pub fn is_exact(&self) -> bool {
        self.halves[0].iter().zip(&self.halves[1]).all(|(a, b)| is_rounding(a, b))
    }

    /// Whether `colors` equal the reference within its own accuracy.
    pub fn has(&self, colors: &[[f64; 3]]) -> bool {
        self.is_exact() && self.halves[0].iter().zip(colors).all(|(a, color)| is_rounding(a, color))
    }

    /// Returns the number of pixels.
    pub fn pixels(&self) -> usize {
        self.halves[0].len()
    }

    pub fn step(&self) -> usize {
        self.step
    }

    /// Returns the samples per pixel.
    pub fn samples(&self) -> u32 {
        Self::samples_at(self.step)
    }

    /// Returns the deviation of `colors` from the reference, pixel by pixel.
    pub fn deviations(&self, colors: &[[f64; 3]]) -> Vec<Deviation> {
        let halves = self.halves[0].iter().zip(&self.halves[1]);
        let of = |(color, (a, b)): (&[f64; 3], (&[f64; 3], &[f64; 3]))| Deviation {
            off: std::array::from_fn(|i| color[i] - (a[i] + b[i]) / 2.0),
            noise: std::array::from_fn(|i| (a[i] - b[i]) / 2.0),
        };
        colors.iter().zip(halves).map(of).collect()
    }

    /// Rounds a side near the maximum to the largest from which retracing the pixel still pays, or to the
    /// maximum.
    pub fn floor(&self, metric: Metric) -> f64 {
        let rounding = match metric {
            Metric::Rmse | Metric::P99 => ROUNDING,
            Metric::Bad => 0.0,
        };
        metric.floor(&self.deviations(&self.halves[0])).max(rounding)
    }

    /// Concatenates two references.
    pub fn and(mut self, other: Self) -> Self {
        let [a, b] = other.halves;
        self.halves[0].extend(a);
        self.halves[1].extend(b);
        self.step = self.step.min(other.step);
        self.counters += other.counters;
        self
    }
}
