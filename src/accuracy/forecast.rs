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
use crate::trace::Sampling;

/// Pixels that are looked at: enough to tell dear from cheap.
const PIXELS: usize = 64;
/// Of all audited pixels of a small picture.
const FEWEST: usize = 16;
/// Of the time that is left: what looking at one setting may take.
const FOR_ONE: f64 = 0.25;

/// The cost of each candidate, in rays of the camera for those pixels; infinite where it is not known,
/// for want of time.
pub struct Forecast(Vec<f64>);

/// Looks at a few pixels under each setting, those first that cost least at least.
pub fn forecast(
    studio: &Studio,
    candidates: &[Candidate],
    list: &[(u32, u32)],
    (clock, until): (&dyn Clock, f64),
) -> Forecast {
    let few = &list[..PIXELS.min(list.len() / FEWEST).max(FEWEST).min(list.len())];
    let mut costs = vec![f64::INFINITY; candidates.len()];
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    order.sort_by(|&a, &b| candidates[a].least.total_cmp(&candidates[b].least));
    for number in order {
        let candidate = &candidates[number];
        let now = clock.wall();
        let end = now + FOR_ONE * (until - now).max(0.0);
        let in_time = Deadline { clock, until: end, watch: studio.watch };
        let studio = Studio { watch: &in_time, ..*studio };
        if let Some((_, counters)) = studio.colors(&candidate.plan, few, Sampling::Planned) {
            costs[number] = candidate.factor * cost(&counters);
        }
    }
    Forecast(costs)
}

impl Forecast {
    /// From cheap to dear; what is not known last, by what it costs at least.
    pub fn compare(&self, candidates: &[Candidate], a: usize, b: usize) -> Ordering {
        let least = |number: usize| candidates[number].least;
        self.0[a].total_cmp(&self.0[b]).then(least(a).total_cmp(&least(b)))
    }

    /// What a candidate's picture will take by the clock on the wall, from those of others.
    pub fn seconds(&self, number: usize, pictures: &[Picture]) -> f64 {
        self.0[number] * self.a_unit(pictures)
    }

    /// A candidate's picture was not done after so many seconds.
    pub fn is_at_least(&mut self, number: usize, seconds: f64, pictures: &[Picture]) {
        let a_unit = self.a_unit(pictures);
        if a_unit > 0.0 && self.0[number].is_finite() {
            self.0[number] = self.0[number].max(seconds / a_unit);
        }
    }

    /// Seconds for each unit of cost.
    fn a_unit(&self, pictures: &[Picture]) -> f64 {
        let known = || pictures.iter().filter(|picture| self.0[picture.candidate].is_finite());
        let seconds: f64 = known().map(|picture| Span::of(&picture.times.wall).median).sum();
        let cost: f64 = known().map(|picture| self.0[picture.candidate]).sum();
        if cost > 0.0 { seconds / cost } else { 0.0 }
    }
}
