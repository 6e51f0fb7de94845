//! Pictures of a promised time.
//!
//! **In:** a World, and when its picture must be done. **Out:** the best picture there is time for, and
//! what is known of its error. **Invariant:** it is done in time, also where that is too short for the
//! scene's own settings.

use super::afford::{self, Deadline, Depths, FEW, LEAST, Wanted};
use super::audit;
use super::choose::Tuning;
use super::easel::Easel;
use super::knob::{Knob, cost};
use super::measure::{Clock, Timer};
use super::promise::{Audit, WANTED, audited};
use super::reference::{Geometries, Reference, Studio, colors_of};
use super::refine;
use super::statistics::Metric;
use super::{Options, Quiet};
use crate::film::Film;
use crate::math::elementary::pow;
use crate::plan::{Antialias, Plan, PlanOptions, plan};
use crate::trace::{Sampling, TraceOptions, Traced, Watch};
use crate::world::{Origins, World};

/// Of the time there is: what the first pass may be predicted to take. Of its pixels one of so many is
/// looked at to predict it.
const FOR_FIRST: f64 = 0.6;
const ONE_OF: u32 = 50;
/// Of the time for the first pass: what is kept for the cheapest settings, if others take too long.
const FOR_REST: f64 = 0.25;
/// Of the time that is left after the first pass: for trying settings out, and for the audit.
const FOR_TUNING: f64 = 0.1;
const FOR_AUDIT: f64 = 0.15;
/// Of all the time: what is kept for the audit, and what it may take beyond the end where the first pass
/// left none.
const KEPT_FOR_AUDIT: f64 = 0.04;
/// Of the time to render in: what the prediction may be wrong by.
const PREDICTED: f64 = 0.85;
/// How much longer the same may take the second time.
const SLACK: f64 = 1.2;
/// The error falls with this power of the number of samples: see [`refine`].
const BY_SAMPLES: f64 = 0.75;

/// A picture whose time was promised.
#[derive(Debug, Clone, PartialEq)]
pub struct Spent {
    /// Not complete when even the first pass did not fit. Its film says how many samples each pixel has.
    pub traced: Traced,
    /// The flags that the first pass was made with: one ray a pixel.
    pub first: String,
    /// Those are less than the scene's own, which would not have fit.
    pub is_less: bool,
    /// How many pixels even they were too much for, and the flags of those: the cheapest.
    pub rest: usize,
    pub least: String,
    /// Those that pixels were traced anew with, where they are others, the number of samples aside.
    pub then: Option<String>,
    /// How many pixels were traced anew.
    pub refined: usize,
    /// Each pixel has the most samples there are: more time would change nothing.
    pub is_finest: bool,
    /// None when no time was left for it.
    pub audit: Option<Audit>,
}

/// What the first pass made.
#[derive(Debug, Clone, Copy)]
pub struct First<'a> {
    pub film: &'a Film,
    /// How many processors it had, on the mean.
    pub processors: f64,
}

/// Renders as well as can be before the clock shows what `until` says, and audits in what is left of it.
/// `until` is asked twice: before the first pass, and then with what that made.
pub fn spend(
    world: &World,
    origins: &Origins,
    options: &Options,
    until: &dyn Fn(Option<First>) -> f64,
    clock: &dyn Clock,
    watch: &dyn Watch,
) -> Spent {
    let began = clock.wall();
    let easel = Easel::new(world, origins, options);
    let geometry = Geometries::default();
    // Many parts, none of which is the whole.
    let quiet = Quiet(watch);
    let late = |until| Deadline { clock, until, watch: &quiet };
    let in_time = late(until(None));
    // Counting takes no time worth the name, and what is counted is what settings cost.
    let counted = TraceOptions { count_work: true, ..options.trace };
    let studio = Studio { world, geometry: &geometry, options: counted, watch: &in_time };
    let own = PlanOptions { antialias: Antialias::Off, ..easel.own };
    let least = least(&easel, own);
    let time = (clock, in_time.until);
    let off = affordable(&studio, origins, &easel, options.seed, (least, own), time);
    // Where that was a mistake, the cheapest settings have what is left.
    let kept = if off == least { 0.0 } else { FOR_REST };
    let most = late(in_time.until - kept * (in_time.until - clock.wall()));
    let timer = Timer::new(clock, &most);
    let mut first = studio.picture(&plan(world, origins, &off), &timer);
    let mut rest = 0;
    if !first.complete && off != least {
        rest = complete(&studio, &plan(world, origins, &least), &mut first);
    }
    let (cpu, took) = timer.read();
    let mut spent = Spent {
        traced: first,
        first: easel.flags_of_rays(&off),
        is_less: off != own,
        rest,
        least: easel.flags_of_rays(&least),
        then: None,
        refined: 0,
        is_finest: false,
        audit: None,
    };
    if !spent.traced.complete {
        return spent;
    }
    let processors = if took > 0.0 { cpu / took } else { 1.0 };
    let until = until(Some(First { film: &spent.traced.film, processors }));
    let kept = KEPT_FOR_AUDIT * (until - began).max(0.0);
    let left = until - clock.wall();
    let pixels = spent.traced.film.radiance.len() as f64;
    let a_unit = took / cost(&spent.traced.counters);
    let mut sets = audit::sets(options.frame.region, WANTED, 2, options.seed).into_iter();
    let mut next = || audit::shuffled(sets.next().unwrap_or_default(), options.seed);
    let (tuning, fresh) = (next(), next());
    let depths = Depths { origins, deepest: easel.deepest };

    // The truth of the fresh pixels is found first: then all the time that is left is the picture's.
    let known_by = clock.wall() + (FOR_AUDIT * left).max(kept);
    let in_time = late(known_by);
    let auditor = Studio { watch: &in_time, ..studio };
    let metric = options.metric;
    let error = |reference: &Reference| {
        let colors = colors_of(&spent.traced.film, &fresh[..reference.pixels()]);
        metric.of(&reference.deviations(&colors))
    };
    // The final picture is better than this, as far as samples make it so.
    let better = pow(1.0 + left.max(0.0) / took.max(f64::MIN_POSITIVE), BY_SAMPLES);
    let wanted = Wanted {
        samples: Reference::samples_at(usize::MAX),
        few: LEAST,
        rough: metric == Metric::Rmse,
        too_coarse: &|known| 4.0 * known.floor(metric) * better / error(known),
    };
    let time = (clock, known_by);
    let truth = afford::resolving(&auditor, &depths, &fresh, options.seed, time, &wanted);

    // At the end it takes as long to find the error as it does now.
    let began = clock.wall();
    let audit = |traced: &Traced| {
        truth.as_ref().map(|known| {
            let list = &fresh[..known.reference.pixels()];
            let deep = known.plan.max_trace_level;
            let depth = (deep < depths.most()).then_some(deep);
            Audit { depth, ..audited(traced, list, &known.reference, metric) }
        })
    };
    audit(&spent.traced);
    let until = until - SLACK * (clock.wall() - began);
    let in_time = late(until);
    let studio = Studio { watch: &in_time, ..studio };

    let tuned = clock.wall() + FOR_TUNING * left;
    let wanted = Wanted {
        samples: Reference::samples_at(Reference::COARSEST),
        few: FEW,
        rough: metric == Metric::Rmse,
        too_coarse: &|_| 0.0,
    };
    let known = afford::resolving(&studio, &depths, &tuning, options.seed, (clock, tuned), &wanted);
    // Where nothing is known of anything better, the scene's own; or what fits.
    let scenes = if spent.is_less { off } else { easel.own };
    let choice = known.and_then(|known| {
        let list = &tuning[..known.reference.pixels()];
        let knobs = &easel.knobs;
        let mut tuning =
            Tuning::new(studio, origins, (list, &known.reference), metric, knobs, scenes);
        tuning.no_deeper_than(known.plan.max_trace_level);
        tuning.in_time((clock, clock.wall() + FOR_TUNING * left));
        tuning.best(PREDICTED * (until - clock.wall()) / (a_unit * pixels))
    });
    let chosen = choice.map_or(scenes, |choice| choice.options);
    let then = PlanOptions { antialias: Antialias::Off, ..chosen };
    let refiner = Studio { options: options.trace, ..studio };
    let then_plan = plan(world, origins, &then);
    let anew = easel.dearer(&off, &then);
    let refined = refine::refine(&refiner, &then_plan, anew, &mut spent.traced.film);
    spent.traced.counters += refined.counters;
    spent.then = (then != off).then(|| easel.flags_of_rays(&then));
    spent.refined = refined.pixels;
    spent.is_finest = refined.is_finest;
    spent.audit = audit(&spent.traced);
    spent
}

/// Each knob at its cheapest, where the scene's `own` settings are dearer.
fn least(easel: &Easel, own: PlanOptions) -> PlanOptions {
    let mut options = own;
    for knob in turned(easel) {
        let settings = knob.with((knob.get)(&own));
        let place = |of| settings.iter().position(|&setting| setting == of);
        if place(knob.cheapest()) < place((knob.get)(&own)) {
            (knob.set)(&mut options, knob.cheapest());
        }
    }
    options
}

/// The knobs that the first pass may turn.
fn turned<'a>(easel: &'a Easel) -> impl Iterator<Item = &'a Knob> {
    easel.knobs.iter().copied().filter(|knob| knob.name != "antialias")
}

/// Traces the pixels that were left undone; returns how many there are.
fn complete(studio: &Studio, plan: &Plan, traced: &mut Traced) -> usize {
    let film = &mut traced.film;
    let undone = (0..film.samples.len()).filter(|&i| film.samples[i] == 0).collect();
    let undone = refine::spread(undone);
    let places: Vec<_> = undone.iter().map(|&i| refine::place(film.frame.region, i)).collect();
    let seen = studio.pixels(plan, &places, Sampling::Planned);
    traced.counters += seen.counters;
    traced.complete = true;
    for (&i, radiance) in undone.iter().zip(seen.radiance) {
        match radiance {
            Some(radiance) => (film.radiance[i], film.samples[i]) = (radiance, 1),
            None => traced.complete = false,
        }
    }
    undone.len()
}

/// The settings of the first pass: the scene's `own`; where a few pixels say that those will not fit, each
/// knob in turn as far toward them as will, and the rest at their `least`.
fn affordable(
    studio: &Studio,
    origins: &Origins,
    easel: &Easel,
    seed: u64,
    (least, own): (PlanOptions, PlanOptions),
    (clock, until): (&dyn Clock, f64),
) -> PlanOptions {
    let region = own.frame.region;
    let pixels = region.width.saturating_mul(region.height);
    let few = (pixels / ONE_OF).max(LEAST as u32);
    let list = audit::sets(region, few, 1, seed).remove(0);
    let share = list.len() as f64 / f64::from(pixels);
    let fits = |options: &PlanOptions| {
        let plan = plan(studio.world, origins, options);
        studio.geometry(&plan);
        // What else the machine does may stand between: then the second look is short enough.
        (0..2).any(|_| {
            let now = clock.wall();
            let watch = &Deadline {
                clock,
                until: now + FOR_FIRST * share * (until - now),
                watch: studio.watch,
            };
            let seen = Studio { watch, ..*studio }.pixels(&plan, &list, Sampling::Planned);
            seen.radiance.iter().all(Option::is_some)
        })
    };
    if least == own || fits(&own) {
        return own;
    }
    let mut options = least;
    for knob in turned(easel) {
        let all = knob.with((knob.get)(&own));
        let place = |of| all.iter().position(|&setting| setting == of).unwrap_or(0);
        let (from, to) = (place((knob.get)(&options)), place((knob.get)(&own)));
        for &setting in all.iter().take(to + 1).skip(from + 1) {
            let mut dearer = options;
            (knob.set)(&mut dearer, setting);
            if !fits(&dearer) {
                break;
            }
            options = dearer;
        }
    }
    options
}
