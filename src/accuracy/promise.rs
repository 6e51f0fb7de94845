//! Pictures of a promised error.
//!
//! **Invariant:** the error reported is found on pixels that had no part in the choice of settings. A
//! clock is read to say how long it will take, and for nothing else: the same picture and the same
//! numbers on every run.

use std::cell::Cell;

use super::afford::{self, Depths, LEAST};
use super::audit;
use super::choose::{Choice, Tuning};
use super::easel::Easel;
use super::knob::cost;
use super::measure::Clock;
use super::proof::{Audit, audited, expected};
use super::reference::{Geometries, Reference, Studio};
use super::statistics::{Estimate, Metric};
use super::{Options, Quiet};
use crate::plan::{Antialias, Plan, PlanOptions, plan};
use crate::trace::{Counters, Sampling, TraceOptions, Traced, Watch};
use crate::world::{Origins, World};

/// Part of the promised error that is aimed at: room for what chance does to the audit.
const AIM: f64 = 0.9;
/// About how many pixels there are of each kind where the picture has enough.
pub const WANTED: u32 = 2048;
/// Pixels that tell about how long a sample takes.
const TIMED: usize = 256;
/// The most rays that samples of the pixels of one kind may send, each as the dearest setting has it;
/// where those are too many, fewer pixels are looked at, and at least so many.
const MOST_RAYS: f64 = 4e9;
const LEAST_KEPT: usize = 256;
/// Samples of each pixel that a picture is taken to have: it costs as much as the coarsest reference of all of
/// the pixels of one kind, or more. Where that leaves fewer pixels than are enough to prove by, it does not.
const PICTURE: f64 = 9.0;
const ENOUGH: f64 = 512.0;
/// What the noise of a reference falls by from one step to the next; and how far beyond a promise the noise of
/// the finest would have to lie for it not to be made. (Samples stratified in two dimensions lessen it by .6
/// where they find edges, by .5 where all is smooth.)
const FALLS: f64 = 0.6;
const SURELY: f64 = 2.0;
/// Of the promised error: what need not be told from nothing.
const SMALL: f64 = 0.25;
/// Samples of a pixel from which on more of them are dearer than to try the dearest settings.
const DEAREST: u32 = 1000;

/// A picture whose error was promised.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    pub traced: Traced,
    /// The flags of `render` that make the same picture.
    pub flags: String,
    /// None when it was interrupted.
    pub audit: Option<Audit>,
    /// A second picture had to be made.
    pub refined: bool,
    /// No setting of any knob is finer.
    pub is_dearest: bool,
}

/// The picture has too few pixels to choose by some and audit by others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooSmall;

/// What [`keep`] does next. Seconds are about those that will pass.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// Choosing settings, on a few pixels.
    Choosing,
    /// Finding out what so many pixels look like, by so many samples of each.
    Learning { pixels: usize, samples: u32, seconds: f64 },
    /// Trying the settings of this knob on these pixels, which takes no longer.
    Trying { knob: &'static str, seconds: f64 },
    /// Not even the dearest settings are known to keep the promise: so many pixels say that their error is
    /// this, and what is below `resolution` cannot be told.
    Unreachable { error: Estimate, resolution: f64, pixels: usize },
    /// Rendering with the settings of these flags, and then finding out more of what pixels look like.
    Rendering { flags: String, seconds: f64, audit: f64 },
    /// Choosing better ones: the first picture did not prove the promise.
    Refining(Audit),
}

/// Renders with the cheapest settings whose error is at most `promise`, and audits. `None` when
/// stopped before the picture was begun; `options.budget` is not used. `tell` hears of each step; `watch`
/// how far it has come.
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

/// What was traced to find things out.
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
    /// What the reference is traced with, and how deep that is.
    deep: Plan,
    depth: u32,
    /// That depth, where it is not as deep as can be.
    cut: Option<u32>,
    /// To choose by, to audit by, and to audit a second picture by; the fourth, of a small picture, is what is
    /// left for that, too.
    sets: Vec<Vec<(u32, u32)>>,
    effort: Cell<Effort>,
    clock: &'a dyn Clock,
    watch: &'a dyn Watch,
    tell: &'a dyn Fn(Step),
}

impl<'a> Search<'a> {
    /// Finds out how deep the reference can look. `None` when stopped.
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
        let depth = afford::counted_depth(&studio, &depths, &few, options.seed, own_depth)?;
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
        let plain = studio.pixels(&plan(studio.world, origins, &plain), few, Sampling::Planned);
        let picture =
            PICTURE * cost(&plain.counters) / few.len() as f64 * options.frame.region.pixels();
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

    /// A finer reference than `known`, or the coarsest. `None` when stopped.
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

    /// Not even the finest reference will tell so small an error from its own. (Of shares nothing is
    /// foretold.)
    fn is_hopeless(&self, known: &Reference) -> bool {
        let metric = self.options.metric;
        let steps = Reference::finest_within(usize::MAX) - known.step();
        let finest = (0..steps).fold(known.floor(metric), |floor, _| FALLS * floor);
        metric != Metric::Bad && 4.0 * finest > SURELY * self.promise
    }

    /// Until its own error is below a quarter of that, or it is as fine as it gets.
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

    /// Seconds that [`Search::resolved`] will take, if noise falls as [`FALLS`] has it.
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
        // Of what lies deeper than the reference looks that cannot tell the error.
        let own = PlanOptions { depth: own.depth.map(|depth| depth.min(self.depth)), ..*own };
        let known = (list, reference);
        let mut tuning =
            Tuning::new(self.studio, self.origins, known, self.options.metric, knobs, own);
        tuning.no_deeper_than(self.depth);
        tuning
    }

    /// A reference to choose by; with the dearest settings, where even those are known not to keep the
    /// promise.
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

    /// The first of what `keeps` that does not lead to settings that are known to fail, or the last.
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
            // What these pixels could not tell, others need not.
            goal = choice.error.value.max(resolution).max(promise);
            let (error, pixels) = (choice.error, tuned.len());
            (self.tell)(Step::Unreachable { error, resolution, pixels });
        }
        // No better picture follows the dearest: the pixels for its audit tell of this one, too.
        let spare: &[_] = if is_dearest { &again } else { &[] };
        let list: Vec<_> = audited.iter().chain(spare).copied().collect();
        let fresh = self.resolved(None, &list, goal)?;
        let (first, fresh) = self.rendered(&choice, &list, (fresh, goal), is_dearest);
        // A better picture proves no more where the reference does not look all the way, nor does the
        // same one.
        let (Some(audit), Some(fresh)) = (first.audit, fresh) else { return Some(first) };
        if audit.shows(promise) || is_dearest {
            return Some(first);
        }
        (self.tell)(Step::Refining(audit));
        // What audited it now helps to choose.
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
        // There is nothing better: the same picture would prove no more.
        if better.options == choice.options {
            return Some(first);
        }
        let is_dearest = self.tuning(&both, &reference).is_dearest(&better.options);
        let fresh = self.resolved(None, &again, promise)?;
        let (second, _) = self.rendered(&better, &again, (fresh, promise), is_dearest);
        Some(Kept { refined: true, ..second })
    }

    /// A picture, and what the pixels of a list, whose truth is known to within `goal`, say of it.
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
        // What no reference can tell is not asked of one.
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
