//! What the pixels really look like, as closely as one cares to know, and how closely that is.
//!
//! **Invariant:** made of two halves that share no sample; half their difference is the reference's
//! own error, and is reported.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::statistics::{Deviation, Metric};
use crate::color::{Gamma, Rgb};
use crate::film::Film;
use crate::geometry::Geometry;
use crate::plan::{Arithmetic, Plan};
use crate::trace::{
    self, Aim, Counters, Pixels, Sampling, Seen, TraceOptions, Traced, Watch, pixels, seen,
    trace_in,
};
use crate::world::World;

/// Samples along the side of a pixel, a half: from [`Reference::COARSEST`] on each has about twice the
/// samples of the last.
const SIDES: [u32; 8] = [2, 8, 11, 16, 23, 32, 45, 64];

/// A list is looked at in so many blocks, the two halves of one after those of the other: where it is
/// stopped, no more than a block is lost.
const BLOCKS: usize = 16;
/// Pixels of a block at least: enough for many threads.
const LEAST_BLOCK: usize = 64;

/// A colour as errors are measured: linear, clamped to 0 … 1.
pub fn clamped(radiance: Rgb, assumed_gamma: Gamma) -> [f64; 3] {
    radiance.components().map(|c| assumed_gamma.linear(c).min(1.0))
}

/// The colours of some pixels of a film, as errors are measured.
pub fn colors_of(film: &Film, list: &[(u32, u32)]) -> Vec<[f64; 3]> {
    let radiance = |&(x, y): &(u32, u32)| film.radiance[film.index(x, y)];
    list.iter().map(|place| clamped(radiance(place), film.assumed_gamma)).collect()
}

/// The same World in each arithmetic, each made when it is first asked for.
#[derive(Default)]
pub struct Geometries {
    made: Mutex<Vec<(Arithmetic, Arc<Geometry>)>>,
}

/// What is traced, and with what.
#[derive(Clone, Copy)]
pub struct Studio<'a> {
    pub world: &'a World,
    pub geometry: &'a Geometries,
    pub options: TraceOptions,
    pub watch: &'a dyn Watch,
}

impl Studio<'_> {
    /// Made now if it is not yet.
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

    /// The whole picture under a Plan.
    pub fn picture(&self, plan: &Plan, watch: &dyn Watch) -> Traced {
        trace_in(self.world, &self.geometry(plan), plan, &self.options, watch)
    }

    /// Some pixels under a Plan.
    pub fn pixels(&self, plan: &Plan, list: &[(u32, u32)], sampling: Sampling) -> Pixels {
        let geometry = self.geometry(plan);
        pixels(self.world, &geometry, plan, list, sampling, &self.options, self.watch)
    }

    /// Some pixels under a Plan, each by as many samples as it says.
    pub fn seen(&self, plan: &Plan, aims: &[Aim]) -> (Vec<Option<Seen>>, Counters) {
        seen(self.world, &self.geometry(plan), plan, aims, &self.options, self.watch)
    }

    /// The colours of the first pixels of a list: of all of them, unless it was stopped.
    pub fn first_colors(
        &self,
        plan: &Plan,
        list: &[(u32, u32)],
        sampling: Sampling,
    ) -> (Vec<[f64; 3]>, Counters) {
        let Pixels { radiance, counters } = self.pixels(plan, list, sampling);
        let gamma = self.world.settings.assumed_gamma;
        (radiance.into_iter().map_while(|c| Some(clamped(c?, gamma))).collect(), counters)
    }

    /// The colours of some pixels under a Plan, and the work they were. `None` when stopped.
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

/// Passes on how far a part has come as so much of the whole.
struct Part<'a> {
    watch: &'a dyn Watch,
    /// What was done before this part.
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
    /// Which of [`SIDES`].
    step: usize,
    seed: u64,
    pub counters: Counters,
}

/// What sums of samples are rounded by, of a colour's full scale.
pub const ROUNDING: f64 = 4096.0 * f64::EPSILON;

impl Reference {
    /// The step of a reference that says little of a pixel, and something of many: for want of time.
    pub const ROUGH: usize = 0;
    /// The step of the coarsest that settings are chosen by.
    pub const COARSEST: usize = 1;
    /// The last step that `samples` a pixel are enough for, or the rough one.
    pub fn finest_within(samples: usize) -> usize {
        SIDES.iter().rposition(|&side| 2 * side as usize * side as usize <= samples).unwrap_or(0)
    }

    /// Samples of each pixel at a step.
    pub fn samples_at(step: usize) -> u32 {
        let side = SIDES[step.min(SIDES.len() - 1)];
        2 * side * side
    }

    /// The reference of a step; `None` when stopped. `plan` says how deep; its antialiasing is not used.
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

    /// As [`Reference::new`], of those pixels of the list that were done when it was stopped, from the
    /// first on.
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

    /// Of twice the samples; `Some(false)` where it is as fine as it gets.
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

    /// Its own error is no more than what sums are rounded by: more samples make it no less.
    pub fn is_exact(&self) -> bool {
        self.halves[0].iter().zip(&self.halves[1]).all(|(a, b)| is_rounding(a, b))
    }

    /// As far as it can tell, these are the pixels' colours.
    pub fn has(&self, colors: &[[f64; 3]]) -> bool {
        self.is_exact() && self.halves[0].iter().zip(colors).all(|(a, color)| is_rounding(a, color))
    }

    /// How many pixels.
    pub fn pixels(&self) -> usize {
        self.halves[0].len()
    }

    pub fn step(&self) -> usize {
        self.step
    }

    /// Samples of each pixel.
    pub fn samples(&self) -> u32 {
        Self::samples_at(self.step)
    }

    /// How far `colors` are from it, pixel by pixel.
    pub fn deviations(&self, colors: &[[f64; 3]]) -> Vec<Deviation> {
        let halves = self.halves[0].iter().zip(&self.halves[1]);
        let of = |(color, (a, b)): (&[f64; 3], (&[f64; 3], &[f64; 3]))| Deviation {
            off: std::array::from_fn(|i| color[i] - (a[i] + b[i]) / 2.0),
            noise: std::array::from_fn(|i| (a[i] - b[i]) / 2.0),
        };
        colors.iter().zip(halves).map(of).collect()
    }

    /// Its own error: by chance, and at least by rounding, which no number of samples makes less.
    pub fn floor(&self, metric: Metric) -> f64 {
        let rounding = match metric {
            Metric::Rmse | Metric::P99 => ROUNDING,
            Metric::Bad => 0.0,
        };
        metric.floor(&self.deviations(&self.halves[0])).max(rounding)
    }

    /// Both, as one list after the other.
    pub fn and(mut self, other: Self) -> Self {
        let [a, b] = other.halves;
        self.halves[0].extend(a);
        self.halves[1].extend(b);
        self.step = self.step.min(other.step);
        self.counters += other.counters;
        self
    }
}
