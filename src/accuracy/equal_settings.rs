//! Finds settings that produce the same picture before any of them is timed.
//!
//! **In:** the results of a few pixels for each setting, and all audited pixels. **Out:** [`Alike`].
//! **Invariant:** two settings are alike if, at every audited pixel, their rays are the same one by one,
//! and so the colors are identical to the last bit. A knob is vain if none of its settings changes an
//! audited pixel, whatever the rays.

use super::affordable_reference::Deadline;
use super::forecast::{Forecast, Look};
use super::measure::Clock;
use super::reference::Studio;
use super::trial::Candidate;
use crate::trace::Sampling;

/// Fraction of the remaining time for evaluating one setting.
const FOR_ONE: f64 = 0.25;

/// Candidates that need not be timed.
pub struct Alike {
    /// For each candidate, another one that does the same work, if any.
    twin: Vec<Option<usize>>,
    /// Whether each candidate belongs to a knob that changes nothing.
    vain: Vec<bool>,
}

impl Alike {
    /// Returns the candidate that is timed in place of this one.
    pub fn timed(&self, candidate: usize) -> usize {
        self.twin[candidate].unwrap_or(candidate)
    }

    /// Whether the candidate changes no audited pixel and is not timed.
    pub fn is_vain(&self, candidate: usize) -> bool {
        self.vain[candidate]
    }

    /// Whether the candidate has a picture of its own.
    pub fn is_timed(&self, candidate: usize) -> bool {
        self.twin[candidate].is_none() && !self.vain[candidate]
    }
}

/// Compares the audited pixels under those settings that a few pixels do not distinguish. `knobs` lists
/// each knob's candidates from coarse to fine; the first of all is the scene's own. `is_exact` says that
/// the scene's own picture has no error: then finer settings have none either and are skipped.
pub fn alike(
    studio: &Studio,
    candidates: &[Candidate],
    knobs: &[Vec<usize>],
    forecast: &Forecast,
    list: &[(u32, u32)],
    is_exact: bool,
    (clock, until): (&dyn Clock, f64),
) -> Alike {
    let mut alike =
        Alike { twin: vec![None; candidates.len()], vain: vec![false; candidates.len()] };
    let look = |candidate: usize| -> Option<Look> {
        let now = clock.wall();
        let end = now + FOR_ONE * (until - now).max(0.0);
        let in_time = Deadline { clock, until: end, watch: studio.watch };
        let studio = Studio { watch: &in_time, ..*studio };
        studio.colors(&candidates[candidate].plan, list, Sampling::Planned)
    };
    let few = &forecast.looks;
    let (Some(few_own), Some(own)) = (&few[0], look(0)) else { return alike };
    for knob in knobs {
        let mut seen = vec![(0, own.clone())];
        let mut finer = false;
        for &candidate in knob {
            finer |= candidate == 0;
            if candidate == 0 {
                continue;
            }
            let Some(mine) = few[candidate].as_ref() else {
                alike.vain[candidate] = is_exact && finer;
                continue;
            };
            let arithmetic = |of: usize| candidates[of].plan.arithmetic();
            let same = |&other: &usize| {
                other != candidate
                    && few[other].as_ref() == Some(mine)
                    && arithmetic(other) == arithmetic(candidate)
            };
            let may_be_twin = knob.iter().any(same);
            if is_exact && finer && !may_be_twin {
                alike.vain[candidate] = true;
            } else if may_be_twin || mine.0 == few_own.0 {
                let Some(mine) = look(candidate) else { continue };
                let is_mine = |(of, look): &&(usize, Look)| same(of) && *look == mine;
                match seen.iter().find(is_mine) {
                    Some(&(twin, _)) => alike.twin[candidate] = Some(twin),
                    None => alike.vain[candidate] = mine.0 == own.0,
                }
                seen.push((candidate, mine));
            }
        }
        // Where one setting changes something, each has its price.
        let changes = |&candidate: &usize| {
            candidate != 0 && !alike.vain[candidate] && alike.twin[candidate] != Some(0)
        };
        if knob.iter().any(changes) {
            knob.iter().for_each(|&candidate| alike.vain[candidate] = false);
        }
    }
    alike
}
