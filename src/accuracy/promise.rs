//! Renders pictures with a promised error.
//!
//! **Invariant:** the reported error is measured on pixels that were not used to choose the settings. A
//! clock is read only to announce how long a step takes, so the picture and the numbers are reproducible.

use std::cell::Cell;

use super::affordable_reference::{self, Depths, LEAST};
use super::audit;
use super::choose::{Choice, Tuning};
use super::knob::cost;
use super::measure::Clock;
use super::proof::{Audit, audited, expected};
use super::reference::{Geometries, Reference, Studio};
use super::render_settings::Easel;
use super::statistics::{Estimate, Metric};
use super::{Options, Quiet};
use crate::plan::{Antialias, Plan, PlanOptions, plan};
use crate::trace::{self, Counters, Sampling, TraceOptions, Traced, Watch};
use crate::world::{Origins, World};

/// Fraction of the promised error to aim for; leaves room for the randomness of the audit.
const AIM: f64 = 0.9;
/// Approximate number of pixels of each kind, if the picture has enough.
pub const WANTED: u32 = 2048;
/// Number of pixels used to estimate the time per sample.
const TIMED: usize = 256;
/// Maximum number of rays for the pixels of one kind, at the most expensive setting. If that is exceeded,
/// fewer pixels are used, but at least `LEAST_KEPT`.
const MOST_RAYS: f64 = 4e9;
const LEAST_KEPT: usize = 256;
/// Samples per pixel that a picture is assumed to have: it costs at least as much as the coarsest reference
/// of all pixels of one kind, unless that leaves fewer pixels than are enough for a proof.
const PICTURE: f64 = 9.0;
const ENOUGH: f64 = 512.0;
/// Factor by which the noise of a reference falls from one step to the next; and the factor by which the
/// forecast noise of the finest must exceed a promise for the attempt to be skipped. (Samples stratified in
/// two dimensions reduce it by a factor of 0.6 at edges and 0.5 in smooth regions.)
const FALLS: f64 = 0.6;
const SURELY: f64 = 2.0;
/// Fraction of the promised error that need not be distinguished from 0.
const SMALL: f64 = 0.25;
/// Samples per pixel from which taking more of them costs more than trying the most expensive settings.
const DEAREST: u32 = 1000;

/// A picture with a promised error.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    /// The picture.
    pub traced: Traced,
    /// Flags of `render` that reproduce the picture.
    pub flags: String,
    /// `None` if interrupted.
    pub audit: Option<Audit>,
    /// Whether a second picture had to be rendered.
    pub refined: bool,
    /// Whether no knob has a finer setting.
    pub is_dearest: bool,
}

/// The picture has too few pixels for separate sets for choosing and auditing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooSmall;

/// Next step of [`keep`]. Seconds are estimates.
#[derive(Debug, Clone, PartialEq)]
// The fields are explained with their variants.
#[allow(missing_docs)]
pub enum Step {
    /// Choosing settings on a few pixels.
    Choosing,
    /// Computing a reference of `pixels` pixels with `samples` samples each.
    Learning { pixels: usize, samples: u32, seconds: f64 },
    /// Trying the settings of this knob on these pixels; takes at most `seconds`.
    Trying { knob: &'static str, seconds: f64 },
    /// Not even the most expensive settings are known to keep the promise: their error, measured on
    /// `pixels` pixels, is `error`, and errors below `resolution` cannot be distinguished from 0.
    Unreachable { error: Estimate, resolution: f64, pixels: usize },
    /// Rendering with the settings of these flags, then computing a reference for the audit.
    Rendering { flags: String, seconds: f64, audit: f64 },
    /// Choosing better settings, because the first picture did not prove the promise.
    Refining(Audit),
}

/// Renders with the cheapest settings whose error is at most `promise`, and audits the picture. `None` if
/// stopped before the picture was begun. `options.budget` is not used. `tell` is called for each step;
/// `watch` receives its progress.
pub fn keep(
    world: &World,
    origins: &Origins,
    options: &Options,
    promise: f64,
    clock: &dyn Clock,
    (watch, tell): (&dyn Watch, &dyn Fn(Step)),
) -> Result<Option<Kept>, TooSmall> {
    let mut sets = audit::sets(options.frame.region, WANTED, 4, options.seed);
    if sets[3].len() >= WANTED as usize {
        sets[3].clear();
    }
    if sets[..3].iter().any(|set| set.len() < LEAST) {
        return Err(TooSmall);
    }
    tell(Step::Choosing);
    let geometry = Geometries::default();
    let quiet = Quiet(watch);
    // What is counted is what settings cost.
    let counted = TraceOptions { count_work: true, ..options.trace };
    let studio = Studio { world, geometry: &geometry, options: counted, watch: &quiet };
    let easel = Easel::new(world, origins, options);
    let search =
        Search::new(studio, origins, &easel, (options, promise), (clock, watch, tell), sets);
    Ok(search.and_then(|search| search.kept()))
}

/// Work done for measurements.
#[derive(Debug, Clone, Copy, Default)]
struct Effort {
    seconds: f64,
    samples: f64,
    cost: f64,
}

struct Search<'a> {
    studio: Studio<'a>,
    origins: &'a Origins,
    easel: &'a Easel<'a>,
    options: &'a Options<'a>,
    promise: f64,
    /// Plan for tracing the reference.
    deep: Plan,
    depth: u32,
    /// Depth of that plan, if reduced from the maximum.
    cut: Option<u32>,
    /// Pixels to choose by, to audit by, and to audit a second picture by. The fourth set, for small
    /// pictures, holds the remaining pixels, which serve for the latter, too.
    sets: Vec<Vec<(u32, u32)>>,
    effort: Cell<Effort>,
    clock: &'a dyn Clock,
    watch: &'a dyn Watch,
    tell: &'a dyn Fn(Step),
}

impl<'a> Search<'a> {
    /// Determines how deep the reference can be. `None` if stopped.
    fn new(
        studio: Studio<'a>,
        origins: &'a Origins,
        easel: &'a Easel<'a>,
        (options, promise): (&'a Options<'a>, f64),
        (clock, watch, tell): (&'a dyn Clock, &'a dyn Watch, &'a dyn Fn(Step)),
        mut sets: Vec<Vec<(u32, u32)>>,
    ) -> Option<Self> {
        let depths = Depths { origins, deepest: easel.deepest };
        let few = audit::shuffled(sets[0].clone(), options.seed);
        let own_depth = easel.own.depth.unwrap_or(1);
        let depth =
            affordable_reference::counted_depth(&studio, &depths, &few, options.seed, own_depth)?;
        let deep = depths.plan(&studio, depth);
        let cut = (depth < depths.most()).then_some(depth);
        let few = &few[..few.len().min(TIMED)];
        let began = clock.wall();
        let rough = Reference::new(&studio, &deep, few, options.seed, Reference::ROUGH)?;
        let effort = Cell::default();
        let samples = f64::from(rough.samples()) * few.len() as f64;
        add(&effort, clock.wall() - began, samples, &rough.counters);
        let a_sample = rough.counters.rays() as f64 / samples;
        let plain = PlanOptions { antialias: Antialias::Off, ..easel.own };
        let aims = trace::aims(few, Sampling::Planned);
        let (_, plain) = studio.pixels(&plan(studio.world, origins, &plain), &aims);
        let picture = PICTURE * cost(&plain) / few.len() as f64 * options.frame.region.pixels();
        let coarsest = f64::from(Reference::samples_at(Reference::COARSEST));
        let worth = picture / (coarsest * cost(&rough.counters) / samples);
        let most = (MOST_RAYS / (a_sample * f64::from(DEAREST))).min(worth.max(ENOUGH));
        let most = (most as usize).max(LEAST_KEPT);
        for set in sets.iter_mut().filter(|set| set.len() > most) {
            *set = audit::shuffled(std::mem::take(set), options.seed);
            set.truncate(most);
        }
        Some(Self {
            studio,
            origins,
            easel,
            options,
            promise,
            deep,
            depth,
            cut,
            sets,
            effort,
            clock,
            watch,
            tell,
        })
    }

    fn a_sample(&self) -> f64 {
        let Effort { seconds, samples, .. } = self.effort.get();
        seconds / samples.max(1.0)
    }

    /// Returns a reference finer than `known`, or the coarsest. `None` if stopped.
    fn finer(&self, known: Option<Reference>, list: &[(u32, u32)]) -> Option<Reference> {
        let step = known.as_ref().map_or(Reference::COARSEST, |known| known.step() + 1);
        let (pixels, samples) = (list.len(), Reference::samples_at(step));
        let all = f64::from(samples) * pixels as f64;
        (self.tell)(Step::Learning { pixels, samples, seconds: self.a_sample() * all });
        let began = self.clock.wall();
        let told = Studio { watch: self.watch, ..self.studio };
        let finer = Reference::new(&told, &self.deep, list, self.options.seed, step)?;
        add(&self.effort, self.clock.wall() - began, all, &finer.counters);
        Some(finer)
    }

    fn is_enough(&self, known: &Reference, error: f64) -> bool {
        let resolution = 4.0 * known.floor(self.options.metric);
        resolution <= error.max(SMALL * self.promise) || known.is_finest() || known.is_exact()
    }

    /// Whether not even the finest reference will resolve so small an error. (Not predicted for
    /// [`Metric::Bad`].)
    fn is_hopeless(&self, known: &Reference) -> bool {
        let metric = self.options.metric;
        let steps = Reference::finest_within(usize::MAX) - known.step();
        let finest = (0..steps).fold(known.floor(metric), |floor, _| FALLS * floor);
        metric != Metric::Bad && 4.0 * finest > SURELY * self.promise
    }

    /// Refines a reference until its own error is below a quarter of `error`, or it is as fine as possible.
    fn resolved(
        &self,
        mut known: Option<Reference>,
        list: &[(u32, u32)],
        error: f64,
    ) -> Option<Reference> {
        while known.as_ref().is_none_or(|known| !self.is_enough(known, error)) {
            known = Some(self.finer(known, list)?);
        }
        known
    }

    /// Returns the seconds that [`Search::resolved`] will take if noise falls as given by [`FALLS`].
    fn to_resolve(&self, known: &Reference, error: f64) -> f64 {
        let (mut floor, mut step, mut samples) =
            (known.floor(self.options.metric), known.step(), 0.0);
        let error = error.max(SMALL * self.promise);
        while 4.0 * floor > error
            && !known.is_exact()
            && step < Reference::finest_within(usize::MAX)
        {
            step += 1;
            samples += f64::from(Reference::samples_at(step));
            floor *= FALLS;
        }
        samples * known.pixels() as f64 * self.a_sample()
    }

    fn tuning<'b>(&'b self, list: &'b [(u32, u32)], reference: &'b Reference) -> Tuning<'b> {
        let Easel { own, knobs, .. } = self.easel;
        // The reference cannot measure errors at greater depths than its own.
        let own = PlanOptions { depth: own.depth.map(|depth| depth.min(self.depth)), ..*own };
        let known = (list, reference);
        let mut tuning =
            Tuning::new(self.studio, self.origins, known, self.options.metric, knobs, own);
        tuning.no_deeper_than(self.depth);
        tuning
    }

    /// Returns a reference to choose by, and the most expensive settings if even those are known not to
    /// keep the promise.
    fn learned(&self) -> Option<(Reference, Option<Choice>)> {
        let list = &self.sets[0];
        let mut known = self.finer(None, list)?;
        while !self.is_enough(&known, self.promise) {
            if known.samples() >= DEAREST {
                let dearest = self.tuning(list, &known).dearest()?;
                if dearest.error.low > self.promise || self.is_hopeless(&known) {
                    return Some((known, Some(dearest)));
                }
            }
            known = self.finer(Some(known), list)?;
        }
        Some((known, None))
    }

    /// Returns the first choice that satisfies `keeps` and does not lead to settings known to fail, or the
    /// last one.
    fn chosen(
        &self,
        list: &[(u32, u32)],
        reference: &Reference,
        keeps: &[&dyn Fn(&Estimate) -> bool],
        not: Option<&Choice>,
    ) -> Option<Choice> {
        let tell = |knob: &'static str, samples: f64| {
            let seconds = samples * list.len() as f64 * self.a_sample();
            (self.tell)(Step::Trying { knob, seconds });
        };
        let mut tuning = self.tuning(list, reference);
        tuning.watch = Some(self.watch);
        tuning.tell = Some(&tell);
        let mut choice = None;
        for keeps in keeps {
            let found = tuning.cheapest(keeps)?;
            let is_new = not.is_none_or(|not| not.options != found.options);
            choice = Some(found);
            if is_new {
                break;
            }
        }
        choice
    }

    fn kept(&self) -> Option<Kept> {
        let [tuned, audited, again, rest] = &self.sets[..] else { return None };
        let again: Vec<_> = again.iter().chain(rest).copied().collect();
        let promise = self.promise;
        let (reference, unreachable) = self.learned()?;
        let choice = match unreachable {
            Some(choice) => choice,
            None => {
                let tells = 4.0 * reference.floor(self.options.metric) <= promise;
                let keeps = |error: &Estimate| tells && error.high <= AIM * promise;
                self.chosen(tuned, &reference, &[&keeps], None)?
            }
        };
        let is_dearest = self.tuning(tuned, &reference).is_dearest(&choice.options);
        let mut goal = promise;
        let resolution = 4.0 * reference.floor(self.options.metric);
        if is_dearest && choice.error.high.max(resolution) > promise {
            // The audit need not resolve more than these pixels could.
            goal = choice.error.value.max(resolution).max(promise);
            let (error, pixels) = (choice.error, tuned.len());
            (self.tell)(Step::Unreachable { error, resolution, pixels });
        }
        // The most expensive settings are not followed by better ones, so the pixels for a second audit are
        // added to this one.
        let spare: &[_] = if is_dearest { &again } else { &[] };
        let list: Vec<_> = audited.iter().chain(spare).copied().collect();
        let fresh = self.resolved(None, &list, goal)?;
        let (first, fresh) = self.rendered(&choice, &list, (fresh, goal), is_dearest);
        // A better picture would prove nothing more if the reference is limited in depth, nor would the
        // same picture.
        let (Some(audit), Some(fresh)) = (first.audit, fresh) else { return Some(first) };
        if audit.shows(promise) || is_dearest {
            return Some(first);
        }
        (self.tell)(Step::Refining(audit));
        // The audited pixels are now used to choose settings.
        let both: Vec<_> = tuned.iter().chain(audited).copied().collect();
        let reference = reference.and(fresh);
        let tells = 4.0 * reference.floor(self.options.metric) <= promise;
        let expected = |error: &Estimate| match tells {
            true => expected(error, both.len(), again.len()),
            false => f64::INFINITY,
        };
        let keeps: [&dyn Fn(&Estimate) -> bool; 4] = [
            &|error| expected(error) <= promise,
            &|error| expected(error) <= 0.7 * promise,
            &|error| expected(error) <= 0.5 * promise,
            &|error| expected(error) <= 0.3 * promise,
        ];
        let better = self.chosen(&both, &reference, &keeps, Some(&choice))?;
        // No better settings exist, and the same picture would prove nothing more.
        if better.options == choice.options {
            return Some(first);
        }
        let is_dearest = self.tuning(&both, &reference).is_dearest(&better.options);
        let fresh = self.resolved(None, &again, promise)?;
        let (second, _) = self.rendered(&better, &again, (fresh, promise), is_dearest);
        Some(Kept { refined: true, ..second })
    }

    /// Renders a picture and audits it on the pixels of a list, with a reference accurate to within `goal`.
    fn rendered(
        &self,
        choice: &Choice,
        list: &[(u32, u32)],
        (reference, goal): (Reference, f64),
        is_dearest: bool,
    ) -> (Kept, Option<Reference>) {
        let flags = self.easel.flags(&choice.options);
        let pixels = self.options.frame.region.pixels();
        let Effort { seconds, cost, .. } = self.effort.get();
        // The goal is limited to what a reference can resolve.
        let least = if goal > self.promise { goal } else { 0.0 };
        let error = choice.error.value.max(least);
        (self.tell)(Step::Rendering {
            flags: flags.clone(),
            seconds: seconds / cost.max(1.0) * choice.cost * pixels,
            audit: self.to_resolve(&reference, error),
        });
        let asked = Studio { options: self.options.trace, ..self.studio };
        let plan = plan(self.studio.world, self.origins, &choice.options);
        let traced = asked.picture(&plan, self.watch);
        let mut kept = Kept { traced, flags, audit: None, refined: false, is_dearest };
        if !kept.traced.complete {
            return (kept, None);
        }
        let metric = self.options.metric;
        let error = audited(&kept.traced, list, &reference, metric).error.value.max(least);
        let reference = self.resolved(Some(reference), list, error);
        kept.audit = reference.as_ref().map(|reference| {
            let audit = audited(&kept.traced, list, reference, metric);
            Audit { depth: self.cut, ..audit }
        });
        (kept, reference)
    }
}

fn add(effort: &Cell<Effort>, seconds: f64, samples: f64, counters: &Counters) {
    let before = effort.get();
    effort.set(Effort {
        seconds: before.seconds + seconds,
        samples: before.samples + samples,
        cost: before.cost + cost(counters),
    });
}
