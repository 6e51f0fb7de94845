//! About how long each setting's picture will take, before it is made.
//!
//! **In:** settings, pixels spread over the picture, a time to be done by. **Out:** a [`Forecast`].
//! **Invariant:** settings are compared by what was counted at the same pixels, so what else the machine
//! does changes no order; seconds are those of the pictures made so far, for as much work.

use std::cmp::Ordering;

use super::afford::Deadline;
use super::knob::cost;
use super::measure::{Clock, Span};
use super::reference::Studio;
use super::trial::{Candidate, Picture};
use crate::plan::{Antialias, Plan};
use crate::trace::{Counters, Pixels, Sampling};

/// Pixels that are looked at: enough to tell dear from cheap.
const PIXELS: usize = 64;
/// How many times more pixels are looked at next, where it was told too soon: before this part of the time
/// there is.
const MORE: usize = 4;
const ENOUGH: f64 = 0.25;
/// Of all audited pixels of a small picture.
const FEWEST: usize = 16;
/// Of the time that is left: what looking at one setting may take.
const FOR_ONE: f64 = 0.25;

/// What a few pixels say of each candidate.
pub struct Forecast {
    /// In rays of the camera for those pixels; infinite where it is not known, for want of time.
    costs: Vec<f64>,
    pub looks: Vec<Option<Look>>,
}

/// The colours of some pixels under a setting, and what was counted.
pub type Look = (Vec<[f64; 3]>, Counters);

/// About how many seconds a candidate's picture takes by the clock on the wall, from one ray of each of a few
/// pixels and the samples that its antialiasing gives them: known at once, and too low rather than too high.
pub fn at_once(
    studio: &Studio,
    candidate: &Candidate,
    list: &[(u32, u32)],
    (clock, until): (&dyn Clock, f64),
) -> f64 {
    let region = candidate.plan.frame.region;
    let pixels = region.pixels();
    // The tree of boxes is no part of it.
    studio.geometry(&candidate.plan);
    let half = (until - clock.wall()).max(0.0) / 2.0;
    let look = |antialias: Antialias, few: usize, until: f64| {
        let began = clock.wall();
        let in_time = Deadline { clock, until, watch: studio.watch };
        let studio = Studio { watch: &in_time, ..*studio };
        let plan = Plan { antialias, ..candidate.plan.clone() };
        let Pixels { radiance, counters } = studio.pixels(&plan, &list[..few], Sampling::Planned);
        // Of those that are not done the others tell.
        let done = radiance.iter().flatten().count().max(1) as f64;
        ((clock.wall() - began) / done, counters.camera as f64 / done)
    };
    // More and more, until what they take is something that a clock can tell, beside all that it takes to
    // begin.
    let (began, mut few) = (clock.wall(), PIXELS.min(list.len()));
    let (mut a_sample, _) = look(Antialias::Off, few, began + half);
    while few < list.len() && clock.wall() - began < ENOUGH * half {
        few = (MORE * few).min(list.len());
        (a_sample, _) = look(Antialias::Off, few, began + half);
    }
    let samples = match candidate.plan.antialias {
        Antialias::Off => 1.0,
        Antialias::Grid(n) => f64::from(n) * f64::from(n),
        Antialias::Adaptive { threshold, grid } => {
            // A pixel by itself asks its neighbours, too, which in a picture have been asked.
            let rays = |threshold| {
                let adaptive = Antialias::Adaptive { threshold, grid };
                look(adaptive, PIXELS.min(few), clock.wall() + half).1
            };
            1.0 + (rays(threshold) - rays(f64::INFINITY)).max(0.0)
        }
    };
    a_sample * samples * pixels
}

/// Looks at a few pixels under each setting, those first that cost least at least.
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
    /// From cheap to dear; what is not known last, by what it costs at least.
    pub fn compare(&self, candidates: &[Candidate], a: usize, b: usize) -> Ordering {
        let least = |number: usize| candidates[number].least;
        self.costs[a].total_cmp(&self.costs[b]).then(least(a).total_cmp(&least(b)))
    }

    /// What a candidate's picture will take by the clock on the wall, from those of others.
    pub fn seconds(&self, number: usize, pictures: &[Picture]) -> f64 {
        self.costs[number] * self.a_unit(pictures)
    }

    /// A candidate's picture was not done after so many seconds.
    pub fn is_at_least(&mut self, number: usize, seconds: f64, pictures: &[Picture]) {
        let a_unit = self.a_unit(pictures);
        if a_unit > 0.0 && self.costs[number].is_finite() {
            self.costs[number] = self.costs[number].max(seconds / a_unit);
        }
    }

    /// Seconds for each unit of cost.
    fn a_unit(&self, pictures: &[Picture]) -> f64 {
        let known = || pictures.iter().filter(|picture| self.costs[picture.candidate].is_finite());
        let seconds: f64 = known().map(|picture| Span::of(&picture.times.wall).median).sum();
        let cost: f64 = known().map(|picture| self.costs[picture.candidate]).sum();
        if cost > 0.0 { seconds / cost } else { 0.0 }
    }
}
