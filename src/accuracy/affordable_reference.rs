//! Computes the best reference that fits the available time.
//!
//! **In:** pixels in an order such that every prefix is spread over the picture, and a deadline. **Out:** a
//! reference of a prefix of these pixels. **Invariant:** depth has priority, at the cost of pixels and
//! samples; the reference's pixels, samples and plan depth show what was given up.

use super::measure::Clock;
use super::reference::{Reference, Studio};
use crate::plan::{Plan, PlanOptions, plan};
use crate::trace::{Limited, Watch};
use crate::world::Origins;

/// Minimum number of pixels to judge a picture by.
pub const LEAST: usize = 30;
/// Minimum number of pixels that are, as a rule, worth many samples each.
pub const FEW: usize = 128;
/// Fractions of the available time: for a first trial at full depth, and for each trial at lower depth.
const FOR_ALL_THE_WAY: f64 = 1.0 / 3.0;
const FOR_LESS: f64 = 1.0 / 12.0;
/// Maximum number of trials that may turn out to be too deep.
const LOOKS_TOO_DEEP: u32 = 3;
/// Fraction of the remaining time to plan with; the rest covers errors of the prediction.
const PREDICTED: f64 = 0.85;
/// Without a clock: maximum number of rays, of all kinds, that a sample of a reference may send on average;
/// and the maximum up to the scene's own depth.
const MOST_RAYS: f64 = 2048.0;
const MOST_OWN_RAYS: f64 = 8.0 * MOST_RAYS;
/// Step count per pixel that accounts for checks whether to stop between parts of a list.
const STEPS_A_PIXEL: f64 = 256.0;

/// Requests a stop at the deadline.
pub struct Deadline<'a> {
    pub clock: &'a dyn Clock,
    /// Deadline in clock time.
    pub until: f64,
    pub watch: &'a dyn Watch,
}

impl Watch for Deadline<'_> {
    fn progress(&self, done: usize, total: usize) {
        self.watch.progress(done, total);
    }

    fn built(&self) {
        self.watch.built();
    }

    fn should_stop(&self) -> bool {
        self.clock.wall() >= self.until || self.watch.should_stop()
    }
}

/// Depths that a reference may have.
pub struct Depths<'a> {
    pub origins: &'a Origins,
    /// Settings with every knob at its most expensive.
    pub deepest: PlanOptions,
}

impl Depths<'_> {
    pub fn plan(&self, studio: &Studio, depth: u32) -> Plan {
        let options = PlanOptions { depth: Some(depth), ..self.deepest };
        plan(studio.world, self.origins, &options)
    }

    pub fn most(&self) -> u32 {
        self.deepest.depth.unwrap_or(u32::MAX)
    }
}

/// A reference of the first pixels of a list.
pub struct Affordable {
    pub reference: Reference,
    pub plan: Plan,
    /// Seconds per sample.
    pub a_sample: f64,
}

/// Returns a coarsest-step reference of as many of the first pixels of `list` as fit before `until`, or a
/// rough one if those would be too few. `None` if there is not even time for one at depth 1.
pub fn reference(
    studio: &Studio,
    depths: &Depths,
    list: &[(u32, u32)],
    seed: u64,
    (clock, until): (&dyn Clock, f64),
) -> Option<Affordable> {
    let rough = deepest(studio, depths, &list[..list.len().min(LEAST)], seed, (clock, until))?;
    let in_time = Deadline { clock, until, watch: studio.watch };
    let studio = Studio { watch: &in_time, ..*studio };
    let reference = finest(&studio, &rough, list, seed, (clock, until));
    Some(Affordable { reference, ..rough })
}

/// Like [`reference`], after a rough trial.
fn finest(
    studio: &Studio,
    rough: &Affordable,
    list: &[(u32, u32)],
    seed: u64,
    (clock, until): (&dyn Clock, f64),
) -> Reference {
    let first =
        |pixels: usize, step| Reference::first(studio, &rough.plan, &list[..pixels], seed, step);
    let affordable = |step| {
        let samples = PREDICTED * (until - clock.wall()).max(0.0) / rough.a_sample;
        ((samples / f64::from(Reference::samples_at(step))) as usize).min(list.len())
    };

    // If even few pixels are too many, uses fewer samples. If stopped, the finished pixels are a prefix of
    // the list and can still be used.
    let roughly = || {
        let more = first(affordable(Reference::ROUGH), Reference::ROUGH);
        let is_more = more.pixels() > rough.reference.pixels();
        if is_more { more } else { rough.reference.clone() }
    };
    let (few, many) = (FEW.min(list.len()), affordable(Reference::COARSEST));
    if many < few {
        return roughly();
    }
    let known = first(many, Reference::COARSEST);
    if known.pixels() < few {
        return roughly();
    }
    // Adds more pixels if the prediction was too cautious.
    let done = known.pixels();
    let more = if done < many { 0 } else { affordable(Reference::COARSEST) };
    let rest = &list[done..(done + more).min(list.len())];
    known.and(Reference::first(studio, &rough.plan, rest, seed, Reference::COARSEST))
}

/// Returns a rough reference of a few pixels, as deep as time permits: full depth or, if that takes too
/// long, increasing depths from 1.
fn deepest(
    studio: &Studio,
    depths: &Depths,
    few: &[(u32, u32)],
    seed: u64,
    (clock, until): (&dyn Clock, f64),
) -> Option<Affordable> {
    if few.len() < LEAST {
        return None;
    }
    let left = until - clock.wall();
    let look = |depth: u32, allowed: f64| {
        let began = clock.wall();
        let in_time = Deadline { clock, until: began + allowed, watch: studio.watch };
        let studio = Studio { watch: &in_time, ..*studio };
        let plan = depths.plan(&studio, depth);
        let reference = Reference::new(&studio, &plan, few, seed, Reference::ROUGH)?;
        let took = clock.wall() - began;
        let samples = f64::from(reference.samples()) * few.len() as f64;
        Some((Affordable { reference, plan, a_sample: took / samples }, took))
    };
    let most = depths.most();
    if let Some((all, _)) = look(most, FOR_ALL_THE_WAY * left) {
        return Some(all);
    }
    let allowed = FOR_LESS * left;
    let (mut found, mut failed) = (None, 0);
    // Full depth has already failed.
    let mut ladder = Ladder::up_to(most.saturating_sub(1).max(1));
    let mut depth = 1;
    loop {
        let seen = look(depth, allowed);
        let reach = seen.as_ref().map(|(_, took)| doublings(*took, allowed));
        failed += u32::from(seen.is_none());
        found = seen.map(|(affordable, _)| affordable).or(found);
        let has_time = failed < LOOKS_TOO_DEEP && reach != Some(0);
        match ladder.next(depth, reach) {
            Some(next) if has_time => depth = next,
            _ => return found,
        }
    }
}

/// Returns the greatest depth at which a sample of a reference sends at most [`MOST_RAYS`] on average, or
/// [`MOST_OWN_RAYS`] up to depth `own`. Rays are counted, so the result is reproducible. `None` if stopped.
pub fn counted_depth(
    studio: &Studio,
    depths: &Depths,
    list: &[(u32, u32)],
    seed: u64,
    own: u32,
) -> Option<u32> {
    let few = &list[..list.len().min(LEAST)];
    let samples = f64::from(Reference::samples_at(Reference::ROUGH)) * few.len() as f64;
    let mut ladder = Ladder::up_to(depths.most());
    let mut depth = 1;
    loop {
        let allowed = if depth <= own { MOST_OWN_RAYS } else { MOST_RAYS };
        // Each ray and each sample takes at most one step, so exceeding this means sending more rays than
        // allowed.
        let steps = 2.0 * (allowed + 1.0) * samples + STEPS_A_PIXEL * few.len() as f64;
        let limited = Limited::to_steps(steps as u64, studio.watch);
        let plan = depths.plan(studio, depth);
        let in_steps = Studio { watch: &limited, ..*studio };
        let reference = Reference::new(&in_steps, &plan, few, seed, Reference::ROUGH);
        if reference.is_none() && studio.watch.should_stop() {
            return None;
        }
        let rays = reference.map(|reference| reference.counters.rays() as f64 / samples);
        let reach = rays.filter(|rays| *rays <= allowed).map(|rays| doublings(rays, MOST_RAYS));
        match ladder.next(depth, reach) {
            Some(next) => depth = next,
            None => return Some(ladder.found.max(1)),
        }
    }
}

/// Sequence of depths to try: increasing until one is too deep, then bisecting.
struct Ladder {
    /// Greatest depth that was completed; 0 at first.
    found: u32,
    /// Depth that was too deep, if any.
    over: Option<u32>,
    most: u32,
}

impl Ladder {
    fn up_to(most: u32) -> Self {
        Self { found: 0, over: None, most }
    }

    /// Returns the depth to try after `depth`. `reach` estimates how many more levels are possible; `None`
    /// means that `depth` was too deep.
    fn next(&mut self, depth: u32, reach: Option<u32>) -> Option<u32> {
        match reach {
            Some(_) => self.found = depth,
            None => self.over = Some(depth),
        }
        let Self { found, over, most } = *self;
        match over {
            None => {
                // If paths do not fork, each level costs less than assumed.
                let further = reach.unwrap_or(0).clamp(found / 8 + 1, found.max(1));
                (found < most).then(|| found.saturating_add(further).min(most))
            }
            Some(over) => (over - found > 1).then(|| found + (over - found) / 2),
        }
    }
}

/// Returns how much deeper a trial can go with `allowed` instead of `took`, if every path forks at each
/// surface.
fn doublings(took: f64, allowed: f64) -> u32 {
    let ratio = if took > 0.0 { allowed / took } else { 2.0 };
    std::iter::successors(Some(2.0), |power| Some(power * 2.0))
        .take_while(|&power: &f64| power <= ratio)
        .take(64)
        .count() as u32
}
