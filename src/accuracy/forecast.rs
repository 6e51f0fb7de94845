//! Forecasts how long the picture of each setting takes, before rendering it.
//!
//! **In:** settings, pixels spread over the picture, a deadline. **Out:** a [`Forecast`]. **Invariant:**
//! settings are compared by counts at the same pixels, so the load of the machine does not change their
//! order; seconds are extrapolated from the pictures rendered so far, in proportion to the work.

use std::cmp::Ordering;

use super::affordable_reference::Deadline;
use super::knob::cost;
use super::measure::{Clock, Span};
use super::reference::Studio;
use super::trial::{Candidate, Picture};
use crate::plan::{Antialias, Plan};
use crate::trace::{Counters, Sampling, aims};

/// Number of pixels traced, enough to distinguish expensive from cheap settings.
const PIXELS: usize = 64;
/// Factor by which the number of pixels grows if the trial was too short, that is, took less than this
/// fraction of the available time.
const MORE: usize = 4;
const ENOUGH: f64 = 0.25;
/// Minimum number of pixels, for small pictures.
const FEWEST: usize = 16;
/// Fraction of the remaining time for evaluating one setting.
const FOR_ONE: f64 = 0.25;

/// Results of a few pixels for each candidate.
pub struct Forecast {
    /// In camera rays for those pixels; infinite if unknown for lack of time.
    costs: Vec<f64>,
    pub looks: Vec<Option<Look>>,
}

/// Colors of some pixels under a setting, and the counters.
pub type Look = (Vec<[f64; 3]>, Counters);

/// Estimates how many wall-clock seconds a candidate's picture takes, from one ray for each of a few pixels
/// and the samples that its antialiasing gives them. Available at once; too low rather than too high.
pub fn at_once(
    studio: &Studio,
    candidate: &Candidate,
    list: &[(u32, u32)],
    (clock, until): (&dyn Clock, f64),
) -> f64 {
    let region = candidate.plan.frame.region;
    let pixels = region.pixels();
    // Builds the bounding volume hierarchy first, so that it is not timed.
    studio.geometry(&candidate.plan);
    let half = (until - clock.wall()).max(0.0) / 2.0;
    let look = |antialias: Antialias, few: usize, until: f64| {
        let began = clock.wall();
        let in_time = Deadline { clock, until, watch: studio.watch };
        let studio = Studio { watch: &in_time, ..*studio };
        let plan = Plan { antialias, ..candidate.plan.clone() };
        let (seen, counters) = studio.pixels(&plan, &aims(&list[..few], Sampling::Planned));
        // Unfinished pixels are estimated from the finished ones.
        let done = seen.iter().flatten().count().max(1) as f64;
        ((clock.wall() - began) / done, counters.camera as f64 / done)
    };
    // Adds pixels until their time is measurable and exceeds the startup cost.
    let (began, mut few) = (clock.wall(), PIXELS.min(list.len()));
    let (mut a_sample, _) = look(Antialias::Off, few, began + half);
    while few < list.len() && clock.wall() - began < ENOUGH * half {
        few = (MORE * few).min(list.len());
        (a_sample, _) = look(Antialias::Off, few, began + half);
    }
    let samples = match candidate.plan.antialias {
        Antialias::Off => 1.0,
        Antialias::Grid(n) => f64::from(n) * f64::from(n),
        adaptive @ Antialias::Adaptive { .. } => {
            look(adaptive, PIXELS.min(few), clock.wall() + half).1.max(1.0)
        }
    };
    a_sample * samples * pixels
}

/// Evaluates a few pixels under each setting, in order of the settings' minimum costs.
pub fn forecast(
    studio: &Studio,
    candidates: &[Candidate],
    list: &[(u32, u32)],
    (clock, until): (&dyn Clock, f64),
) -> Forecast {
    let few = &list[..PIXELS.min(list.len() / FEWEST).max(FEWEST).min(list.len())];
    let mut costs = vec![f64::INFINITY; candidates.len()];
    let mut looks = vec![None; candidates.len()];
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    order.sort_by(|&a, &b| candidates[a].least.total_cmp(&candidates[b].least));
    for number in order {
        let candidate = &candidates[number];
        let now = clock.wall();
        let end = now + FOR_ONE * (until - now).max(0.0);
        let in_time = Deadline { clock, until: end, watch: studio.watch };
        let studio = Studio { watch: &in_time, ..*studio };
        looks[number] = studio.colors(&candidate.plan, few, Sampling::Planned);
        if let Some((_, counters)) = &looks[number] {
            costs[number] = candidate.factor * cost(counters);
        }
    }
    Forecast { costs, looks }
}

impl Forecast {
    /// Orders candidates from cheap to expensive; those with unknown costs come last, in order of their
    /// minimum costs.
    pub fn compare(&self, candidates: &[Candidate], a: usize, b: usize) -> Ordering {
        let least = |number: usize| candidates[number].least;
        self.costs[a].total_cmp(&self.costs[b]).then(least(a).total_cmp(&least(b)))
    }

    /// Forecasts the wall-clock seconds for a candidate's picture from those of other pictures.
    pub fn seconds(&self, number: usize, pictures: &[Picture]) -> f64 {
        self.costs[number] * self.a_unit(pictures)
    }

    /// Records that a candidate's picture was not finished after `seconds`.
    pub fn is_at_least(&mut self, number: usize, seconds: f64, pictures: &[Picture]) {
        let a_unit = self.a_unit(pictures);
        if a_unit > 0.0 && self.costs[number].is_finite() {
            self.costs[number] = self.costs[number].max(seconds / a_unit);
        }
    }

    /// Returns the seconds per unit of cost.
    fn a_unit(&self, pictures: &[Picture]) -> f64 {
        let known = || pictures.iter().filter(|picture| self.costs[picture.candidate].is_finite());
        let seconds: f64 = known().map(|picture| Span::of(&picture.times.wall).median).sum();
        let cost: f64 = known().map(|picture| self.costs[picture.candidate]).sum();
        if cost > 0.0 { seconds / cost } else { 0.0 }
    }
}
