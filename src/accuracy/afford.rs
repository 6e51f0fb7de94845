//! The finest reference there is time for.
//!
//! **In:** pixels in an order that any first part of is spread over the picture, and a time to be done
//! by. **Out:** a reference of a first part of them. **Invariant:** pixels are given up before
//! samples, and depth last; what was given up can be read from the reference: its pixels, samples
//! and depth.

use super::measure::Clock;
use super::reference::{Reference, Studio};
use crate::plan::{Plan, PlanOptions, plan};
use crate::trace::Watch;
use crate::world::Origins;

/// Fewer pixels than this say nothing of a picture.
pub const LEAST: usize = 30;
/// Fewer pixels than this are not worth many samples each.
const FEW: usize = 256;
/// Of the time there is: what a first look all the way may take, and each one less deep.
const FOR_ALL_THE_WAY: f64 = 1.0 / 3.0;
const FOR_LESS: f64 = 1.0 / 6.0;
/// Of the time that is left then: what the prediction may be wrong by.
const PREDICTED: f64 = 0.85;

/// Asks to stop when the time is up.
pub struct Deadline<'a> {
    pub clock: &'a dyn Clock,
    /// As the clock shows.
    pub until: f64,
    pub watch: &'a dyn Watch,
}

impl Watch for Deadline<'_> {
    fn progress(&self, _: usize, _: usize) {}

    fn built(&self) {
        self.watch.built();
    }

    fn should_stop(&self) -> bool {
        self.clock.wall() >= self.until || self.watch.should_stop()
    }
}

/// How deep a reference may look.
pub struct Depths<'a> {
    pub origins: &'a Origins,
    /// Everything at its dearest.
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
    /// What a sample took, in seconds.
    pub a_sample: f64,
}

/// The finest reference of the first pixels of `list` that is done when the clock shows `until`, of
/// no more than `samples` a pixel. `None` where not even one is that looks one surface deep.
pub fn reference(
    studio: &Studio,
    depths: &Depths,
    list: &[(u32, u32)],
    seed: u64,
    (clock, until): (&dyn Clock, f64),
    samples: u32,
) -> Option<Affordable> {
    let rough = deepest(studio, depths, &list[..list.len().min(LEAST)], seed, (clock, until))?;
    let left = until - clock.wall();
    let affordable = (PREDICTED * left / rough.a_sample).max(0.0);
    let most = Reference::finest_within(samples as usize);
    // Pixels first, and samples where even few pixels are too many.
    let enough = |step| affordable / f64::from(Reference::samples_at(step));
    let step = (0..=most).rev().find(|&step| enough(step) >= FEW.min(list.len()) as f64);
    let (step, pixels) = match step {
        Some(step) => (step, enough(step).min(list.len() as f64) as usize),
        None => (Reference::ROUGH, enough(Reference::ROUGH) as usize),
    };
    if pixels <= rough.reference.pixels() && step <= rough.reference.step() {
        return Some(rough);
    }
    let in_time = Deadline { clock, until, watch: studio.watch };
    let studio = Studio { watch: &in_time, ..*studio };
    let finer = Reference::first(&studio, &rough.plan, &list[..pixels], seed, step);
    // Nothing is lost where it was stopped: the pixels that were done are a list's first.
    if finer.pixels() < rough.reference.pixels() {
        return Some(rough);
    }
    Some(Affordable { reference: finer, ..rough })
}

/// A rough reference of a few pixels, as deep as there is time for: all the way, or where that takes
/// too long, from one surface on as much deeper each time as there can be time for if every path
/// forks at each.
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
    let (mut depth, mut found) = (1, None);
    while let Some((affordable, took)) = look(depth, allowed) {
        found = Some(affordable);
        let doublings = if took > 0.0 { (allowed / took).max(1.0).log2() } else { 1.0 };
        // A look all the way has failed already.
        let deeper = depth.saturating_add(doublings as u32).min(most.saturating_sub(1));
        if deeper <= depth {
            break;
        }
        depth = deeper;
    }
    found
}
