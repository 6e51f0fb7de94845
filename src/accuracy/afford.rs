//! The finest reference there is time for.
//!
//! **In:** pixels in an order that any first part of is spread over the picture, and a time to be done
//! by. **Out:** a reference of a first part of them. **Invariant:** it looks as deep as can be, if need
//! be at few pixels and with few samples; its pixels, its samples and the depth of its plan tell what
//! was given up.

use super::measure::Clock;
use super::reference::{Reference, Studio};
use crate::plan::{Plan, PlanOptions, plan};
use crate::trace::Watch;
use crate::world::Origins;

/// Fewer pixels than this say nothing of a picture.
pub const LEAST: usize = 30;
/// Fewer pixels than this are not worth many samples each.
const FEW: usize = 128;
/// Of the time there is: what a first look all the way may take, and each one less deep.
const FOR_ALL_THE_WAY: f64 = 1.0 / 3.0;
const FOR_LESS: f64 = 1.0 / 6.0;
/// Of the time that is left then: what the prediction may be wrong by.
const PREDICTED: f64 = 0.85;
/// Where no clock is read: the most rays, of all kinds, that a sample of a reference may send as a rule.
const MOST_RAYS: f64 = 2048.0;

/// Asks to stop when the time is up.
pub struct Deadline<'a> {
    pub clock: &'a dyn Clock,
    /// As the clock shows.
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
    let enough = |step| {
        let pixels = affordable / f64::from(Reference::samples_at(step));
        (pixels as usize).min(list.len())
    };
    // All pixels, then more samples of each; where even few pixels are too many, fewer samples.
    let coarse = enough(Reference::COARSEST);
    let (step, pixels) = match coarse >= FEW.min(list.len()) {
        true => {
            let each = (affordable / coarse.max(1) as f64).min(f64::from(samples));
            (Reference::finest_within(each as usize).max(Reference::COARSEST), coarse)
        }
        false => (Reference::ROUGH, enough(Reference::ROUGH)),
    };
    if pixels <= rough.reference.pixels() && step <= rough.reference.step() {
        return Some(rough);
    }
    let in_time = Deadline { clock, until, watch: studio.watch };
    let studio = Studio { watch: &in_time, ..*studio };
    // Where the prediction was too careful, the time ends the list.
    let first = |step| Reference::first(&studio, &rough.plan, list, seed, step);
    let mut finer = first(step);
    // Nothing is lost where it was stopped: the pixels that were done are a list's first.
    if finer.pixels() < rough.reference.pixels() {
        return Some(rough);
    }
    while finer.pixels() == list.len()
        && finer.step() < Reference::finest_within(samples as usize)
        && clock.wall() < until
    {
        let better = first(finer.step() + 1);
        let all = better.pixels() == list.len();
        finer.first_from(better);
        if !all {
            break;
        }
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
        // A look all the way has failed already.
        let deeper = (depth + doublings(took, allowed)).min(most.saturating_sub(1));
        if deeper <= depth {
            break;
        }
        depth = deeper;
    }
    found
}

/// How deep a reference may look whose samples send no more than [`MOST_RAYS`] as a rule, and at least
/// as deep as `own`: counted, so the same on every run. `None` when stopped.
pub fn counted_depth(
    studio: &Studio,
    depths: &Depths,
    list: &[(u32, u32)],
    seed: u64,
    own: u32,
) -> Option<u32> {
    let few = &list[..list.len().min(LEAST)];
    let (mut depth, mut found) = (1, 1);
    while depth <= depths.most() {
        let plan = depths.plan(studio, depth);
        let reference = Reference::new(studio, &plan, few, seed, Reference::ROUGH)?;
        let samples = f64::from(reference.samples()) * few.len() as f64;
        let rays = reference.counters.rays() as f64 / samples;
        if rays > MOST_RAYS {
            break;
        }
        found = depth;
        let deeper = depth + doublings(rays, MOST_RAYS).max(1);
        depth = if depth < depths.most() { deeper.min(depths.most()) } else { deeper };
    }
    Some(found.max(own).min(depths.most()))
}

/// How much deeper one can look for `allowed` than for `took`, if every path forks at each surface.
fn doublings(took: f64, allowed: f64) -> u32 {
    let ratio = if took > 0.0 { allowed / took } else { 2.0 };
    std::iter::successors(Some(2.0), |power| Some(power * 2.0))
        .take_while(|&power: &f64| power <= ratio)
        .take(64)
        .count() as u32
}
