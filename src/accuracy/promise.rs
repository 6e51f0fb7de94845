//! Pictures with a promise: an error not exceeded, or a time.
//!
//! **Invariant:** the error reported is found on pixels that had no part in the choice of settings.
//! [`keep`] reads a clock to say how long it will take, and for nothing else: the same picture and the
//! same numbers on every run.

use super::afford::{self, Deadline, Depths, LEAST};
use super::choose::{Choice, Tuning};
use super::knob::{Knob, cost};
use super::measure::{Clock, Timer};
use super::reference::{Geometries, Reference, Studio, colors_of};
use super::statistics::{Estimate, Metric};
use super::{Options, Quiet, called_for, dearest, own};
use super::{audit, refine};
use crate::film::Film;
use crate::plan::{Antialias, PlanOptions, plan};
use crate::trace::{TraceOptions, Traced, Watch};
use crate::world::{Origins, World};

/// Part of the promised error that is aimed at: room for what chance does to the audit.
const AIM: f64 = 0.9;
/// Of the time that is left after the first pass: for trying settings out, and for the audit.
const FOR_TUNING: f64 = 0.1;
const FOR_AUDIT: f64 = 0.15;
/// Of all the time: what is kept for the audit, and what it may take beyond the end where the first pass
/// left none.
const KEPT_FOR_AUDIT: f64 = 0.04;
/// Of the time to render in: what the prediction may be wrong by.
const PREDICTED: f64 = 0.85;

/// What fresh pixels say of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Audit {
    pub metric: Metric,
    pub error: Estimate,
    /// Four times the reference's own error: what is below cannot be told from it.
    pub resolution: f64,
    pub pixels: usize,
    /// How deep the reference looked, where that was not as deep as can be: of what lies deeper nothing
    /// is known.
    pub depth: Option<u32>,
}

impl Audit {
    /// Its interval ends below `most`, and all that a reference can see was looked at.
    pub fn proves(&self, most: f64) -> bool {
        self.error.high <= most && self.depth.is_none()
    }
}

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
}

/// A picture whose time was promised.
#[derive(Debug, Clone, PartialEq)]
pub struct Spent {
    /// Not complete when even the first pass did not fit. Its film says how many samples each pixel has.
    pub traced: Traced,
    /// The flags that the first pass was made with: one ray a pixel.
    pub first: String,
    /// Those that pixels were traced anew with, where they are others, the number of samples aside.
    pub then: Option<String>,
    /// How many pixels were traced anew.
    pub refined: usize,
    /// None when no time was left for it.
    pub audit: Option<Audit>,
}

/// The picture has too few pixels to choose by some and audit by others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooSmall;

/// About how many there are of each kind where the picture has enough.
const WANTED: u32 = 2048;

/// What [`keep`] does next.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// Choosing settings, on a few pixels.
    Choosing,
    /// Finding out what so many pixels look like, by so many samples of each, in about so many seconds.
    Learning { pixels: usize, samples: u32, seconds: f64 },
    /// Trying settings on these pixels.
    Trying,
    /// Rendering with the settings of these flags, which will take about so many seconds: what the same
    /// work took on a few pixels.
    Rendering { flags: String, seconds: f64 },
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
    let sets = audit::sets(options.frame.region, WANTED, 3, options.seed);
    if sets.iter().any(|set| set.len() < LEAST) {
        return Err(TooSmall);
    }
    Ok(kept((world, origins), (options, promise), &sets, clock, watch, tell))
}

fn kept(
    (world, origins): (&World, &Origins),
    (options, promise): (&Options, f64),
    sets: &[Vec<(u32, u32)>],
    clock: &dyn Clock,
    watch: &dyn Watch,
    tell: &dyn Fn(Step),
) -> Option<Kept> {
    tell(Step::Choosing);
    let geometry = Geometries::default();
    let quiet = Quiet(watch);
    // What is counted is what settings cost.
    let counted = TraceOptions { count_work: true, ..options.trace };
    let studio = Studio { world, geometry: &geometry, options: counted, watch: &quiet };
    let easel = Easel::new(world, origins, options);
    let metric = options.metric;
    let depths = Depths { origins, deepest: easel.deepest };
    let few = audit::shuffled(sets[0].clone(), options.seed);
    let own_depth = easel.own.depth.unwrap_or(1);
    let depth = afford::counted_depth(&studio, &depths, &few, options.seed, own_depth)?;
    let deep = depths.plan(&studio, depth);
    let cut = (depth < depths.most()).then_some(depth);
    let few = &few[..few.len().min(LEAST)];
    let began = clock.wall();
    let rough = Reference::new(&studio, &deep, few, options.seed, Reference::ROUGH)?;
    let a_sample = (clock.wall() - began) / f64::from(rough.samples()) / few.len() as f64;
    // Until its own error is below a quarter of that, or it is as fine as it gets.
    let resolved = |mut known: Option<Reference>, list: &[(u32, u32)], error: f64| {
        loop {
            let step = match &known {
                None => Reference::COARSEST,
                Some(known) if 4.0 * known.floor(metric) <= error || known.is_finest() => break,
                Some(known) => known.step() + 1,
            };
            let (pixels, samples) = (list.len(), Reference::samples_at(step));
            let seconds = a_sample * f64::from(samples) * pixels as f64;
            tell(Step::Learning { pixels, samples, seconds });
            match &mut known {
                None => known = Some(Reference::new(&studio, &deep, list, options.seed, step)?),
                Some(known) => _ = known.double(&studio, &deep, list)?,
            }
        }
        known
    };
    let truth = |list: &[(u32, u32)]| resolved(None, list, promise);
    let choose =
        |list: &[(u32, u32)], reference: &Reference, aims: &[f64], not: Option<&Choice>| {
            tell(Step::Trying);
            let mut tuning =
                Tuning::new(studio, origins, (list, reference), metric, &easel.knobs, easel.own);
            tuning.no_deeper_than(depth);
            tuning.tell = Some(watch);
            let mut choice = tuning.cheapest(aims[0])?;
            for &aim in &aims[1..] {
                if not.is_some_and(|not| not.options == choice.options) {
                    choice = tuning.cheapest(aim)?;
                }
            }
            Some(choice)
        };
    let mut kept = Kept {
        traced: Traced::unbegun(options.frame, world.settings.assumed_gamma),
        flags: String::new(),
        audit: None,
        refined: false,
    };
    let region = options.frame.region;
    let pixels = f64::from(region.width) * f64::from(region.height);
    let began = clock.wall();
    let reference = truth(&sets[0])?;
    // Of a unit of cost, by all threads together.
    let a_unit = (clock.wall() - began) / cost(&reference.counters);
    let asked = Studio { options: options.trace, ..studio };
    let mut render = |choice: &Choice, list: &[(u32, u32)], reference: Reference| {
        kept.flags = easel.flags(&choice.options);
        let seconds = a_unit * choice.cost * pixels;
        tell(Step::Rendering { flags: kept.flags.clone(), seconds });
        kept.audit = None;
        kept.traced = asked.picture(&plan(world, origins, &choice.options), watch);
        if !kept.traced.complete {
            return None;
        }
        let error = audited(&kept.traced, list, &reference, metric).error.value;
        let reference = resolved(Some(reference), list, error)?;
        let audit = audited(&kept.traced, list, &reference, metric);
        kept.audit = Some(Audit { depth: cut, ..audit });
        Some((audit, reference))
    };

    let choice = choose(&sets[0], &reference, &[AIM * promise], None)?;
    let fresh = truth(&sets[1])?;
    let Some((audit, fresh)) = render(&choice, &sets[1], fresh) else { return Some(kept) };
    // A better picture proves no more where the reference does not look all the way.
    if audit.error.high <= promise {
        return Some(kept);
    }
    tell(Step::Refining(audit));
    // By how much it failed is how much lower to aim; what audited it now helps to choose.
    let aim = AIM * promise * (promise / audit.error.high);
    let both: Vec<_> = sets[0].iter().chain(&sets[1]).copied().collect();
    let aims = [AIM * aim, 0.7 * aim, 0.5 * aim, 0.3 * aim];
    let better = choose(&both, &reference.and(fresh), &aims, Some(&choice))?;
    // There is nothing better: the same picture would prove no more.
    if better.options == choice.options {
        return Some(kept);
    }
    let choice = better;
    let fresh = truth(&sets[2])?;
    render(&choice, &sets[2], fresh);
    kept.refined = true;
    Some(kept)
}

/// Renders as well as can be before the clock shows what `until` says, and audits in what is left of it.
/// `until` is asked twice: before the first pass, and with the film of that.
pub fn spend(
    world: &World,
    origins: &Origins,
    options: &Options,
    until: &dyn Fn(Option<&Film>) -> f64,
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
    let off = PlanOptions { antialias: Antialias::Off, ..easel.own };
    let timer = Timer::new(clock, &in_time);
    let first = studio.picture(&plan(world, origins, &off), &timer);
    let took = timer.read().1;
    let mut spent = Spent {
        traced: first,
        first: easel.flags_of_rays(&off),
        then: None,
        refined: 0,
        audit: None,
    };
    if !spent.traced.complete {
        return spent;
    }
    let until = until(Some(&spent.traced.film));
    let kept = KEPT_FOR_AUDIT * (until - began).max(0.0);
    let in_time = late(until);
    let studio = Studio { watch: &in_time, ..studio };
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
    let fine = Reference::samples_at(usize::MAX);
    let truth = afford::reference(&auditor, &depths, &fresh, options.seed, (clock, known_by), fine);

    let tuned = clock.wall() + FOR_TUNING * left;
    let samples = Reference::samples_at(Reference::COARSEST);
    let known = afford::reference(&studio, &depths, &tuning, options.seed, (clock, tuned), samples);
    let choice = known.and_then(|known| {
        let list = &tuning[..known.reference.pixels()];
        let (knobs, metric) = (&easel.knobs, options.metric);
        let own = easel.own;
        let mut tuning = Tuning::new(studio, origins, (list, &known.reference), metric, knobs, own);
        tuning.no_deeper_than(known.plan.max_trace_level);
        tuning.in_time((clock, clock.wall() + FOR_TUNING * left));
        tuning.best(PREDICTED * (until - clock.wall()) / (a_unit * pixels))
    });
    // Where nothing is known of anything better, the scene's own.
    let chosen = choice.map_or(easel.own, |choice| choice.options);
    let then = PlanOptions { antialias: Antialias::Off, ..chosen };
    let refiner = Studio { options: options.trace, ..studio };
    let then_plan = plan(world, origins, &then);
    let anew = easel.dearer(&off, &then);
    let refined = refine::refine(&refiner, &then_plan, anew, &mut spent.traced.film);
    spent.traced.counters += refined.counters;
    spent.then = (then != off).then(|| easel.flags_of_rays(&then));
    spent.refined = refined.pixels;

    spent.audit = truth.map(|known| {
        let list = &fresh[..known.reference.pixels()];
        let audit = audited(&spent.traced, list, &known.reference, options.metric);
        let deep = known.plan.max_trace_level;
        Audit { depth: (deep < depths.most()).then_some(deep), ..audit }
    });
    spent
}

/// The plans a picture is made and judged by.
struct Easel<'a> {
    own: PlanOptions,
    deepest: PlanOptions,
    knobs: Vec<&'a Knob>,
}

impl<'a> Easel<'a> {
    fn new(world: &World, origins: &Origins, options: &Options<'a>) -> Self {
        let own = own(world, options.frame);
        let deepest = dearest(own, options.knobs);
        Self { own, deepest, knobs: called_for(world, origins, own, options.knobs) }
    }

    fn flags(&self, options: &PlanOptions) -> String {
        let flags = self.knobs.iter().map(|knob| (knob.flag)((knob.get)(options)));
        flags.collect::<Vec<_>>().join(" ")
    }

    /// The same without the knob that the first pass and what follows it turn themselves.
    fn flags_of_rays(&self, options: &PlanOptions) -> String {
        let knobs = self.knobs.iter().filter(|knob| knob.name != "antialias");
        let flags = knobs.map(|knob| (knob.flag)((knob.get)(options)));
        flags.collect::<Vec<_>>().join(" ")
    }

    /// Whether a knob stands dearer in the second than in the first.
    fn dearer(&self, than: &PlanOptions, options: &PlanOptions) -> bool {
        self.knobs.iter().any(|knob| {
            let settings = knob.with((knob.get)(than));
            let place = |of| settings.iter().position(|&setting| setting == (knob.get)(of));
            place(options) > place(than)
        })
    }
}

fn audited(traced: &Traced, list: &[(u32, u32)], reference: &Reference, metric: Metric) -> Audit {
    let colors = colors_of(&traced.film, list);
    Audit {
        metric,
        error: metric.estimate(&audit::by_place(list, reference.deviations(&colors))),
        resolution: 4.0 * reference.floor(metric),
        pixels: list.len(),
        depth: None,
    }
}
