//! Pictures of a promised time.
//!
//! **In:** a World, and when its picture must be done. **Out:** the best picture there is time for, and
//! what is known of its error. **Invariant:** it is done in time, also where that is too short for the
//! scene's own settings; and an error is told only against what looks as deep as the scene does.

use super::afford::{Deadline, Depths, LEAST};
use super::begin::{Begun, begin};
use super::draw::{Truth, Urn};
use super::easel::Easel;
use super::measure::Clock;
use super::proof::Audit;
use super::reference::{Geometries, Studio};
use super::refine::{Canvas, MOST_SIDE, Pace, Until, is_finest};
use super::{Options, Quiet};
use crate::film::Film;
use crate::plan::{Effect, Plan, PlanOptions, plan};
use crate::trace::{Traced, Watch};
use crate::world::{Origins, World};

/// Of all the time: what finding the error may take, and what it may take where there are fewer than
/// so many pixels by then: what samples have left. Ten pixels of a hundred fewer samples make an error 8 % larger.
const FOR_AUDIT: f64 = 0.1;
const FOR_FEW: f64 = 0.14;
const FEW: usize = 200;
/// Of all the time: what the first pass leaves at least, so that a whole picture's error is known.
const KEPT: f64 = 0.05;
/// Of the time for the audit: what a first block of pixels may take that looks all the way.
const FOR_ALL_THE_WAY: f64 = 0.25;
/// Of the time for more samples: what is spent before the audit. What is left is spent with what those
/// samples have shown, and with what the audit did not need. Pixels traced anew lose the samples they had:
/// with 0.8, and 16 for [`PILOT`], errors were a fifth larger than with nearly all and 64.
const BEFORE_AUDIT: f64 = 0.95;
/// Of the samples there is time for: one of so many goes to every pixel alike, to learn which need more.
const PILOT: f64 = 64.0;
/// How much longer the same may take the second time.
const SLACK: f64 = 1.2;

/// A picture whose time was promised.
#[derive(Debug, Clone, PartialEq)]
pub struct Spent {
    /// Not complete when even the first pass did not fit. Its film says how many samples each pixel has.
    pub traced: Traced,
    /// The flags that all of it was made with but `rest`, the number of samples aside.
    pub flags: String,
    /// Those are less than the scene's own, which would not have fit.
    pub is_less: bool,
    /// How many pixels even they were too much for, and the flags of those: the cheapest.
    pub rest: usize,
    pub least: String,
    /// Each pixel has the most samples there are: more time would change nothing.
    pub is_finest: bool,
    /// None when there was no time to look at pixels as deep as the scene does.
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
/// `until` is asked twice: once the tree of boxes stands, and then with what the first pass made.
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
    let studio = Studio { world, geometry: &geometry, options: options.trace, watch: &quiet };
    studio.geometry(&plan(world, origins, &easel.own));
    let whole = until(None);
    let first_by = whole - KEPT * (whole - began);
    let begun = begin(&studio, origins, &easel, options.seed, (clock, first_by));
    let Begun { traced, settings, least, is_less, rest, took: (cpu, wall) } = begun;
    let mut spent = Spent {
        traced,
        flags: easel.flags_of_rays(&settings),
        is_less,
        rest,
        least: easel.flags_of_rays(&least),
        is_finest: false,
        audit: None,
    };
    if !spent.traced.complete {
        return spent;
    }
    let processors = if wall > 0.0 { cpu / wall } else { 1.0 };
    let until = until(Some(First { film: &spent.traced.film, processors }));
    let Traced { film, counters, .. } = spent.traced;
    let pace = Pace { seconds: wall, samples: film.samples.len() as f64 };
    let mut spending = Spending {
        studio,
        depths: Depths { origins, deepest: easel.deepest },
        own: easel.own,
        plan: plan(world, origins, &settings),
        canvas: Canvas::new(film, counters, pace),
        options,
        clock,
        all: until - began,
        until,
    };
    spent.audit = spending.spend();
    let Canvas { film, counters, .. } = spending.canvas;
    spent.is_finest = is_finest(&film);
    spent.traced = Traced { film, counters, complete: true };
    spent
}

struct Spending<'a> {
    studio: Studio<'a>,
    depths: Depths<'a>,
    own: PlanOptions,
    plan: Plan,
    canvas: Canvas,
    options: &'a Options<'a>,
    clock: &'a dyn Clock,
    /// Seconds.
    all: f64,
    /// As the clock shows.
    until: f64,
}

impl Spending<'_> {
    /// More samples, the audit's truth, and more samples again; then what the audit says.
    fn spend(&mut self) -> Option<Audit> {
        let now = self.clock.wall();
        let for_audit = (FOR_AUDIT * self.all).min(self.until - now);
        let for_samples = self.until - for_audit - now;
        self.sample(now + BEFORE_AUDIT * for_samples, self.until - for_audit, true);
        // Where there is nothing else to be bought, all of the time is for the error.
        let for_audit = match is_finest(&self.canvas.film) {
            true => self.until - self.clock.wall(),
            false => for_audit,
        };
        let truth = self.truth(for_audit);
        // At the end it takes as long to find the error as it does now.
        let metric = self.options.metric;
        let began = self.clock.wall();
        let audit = |found: &Option<Found>, film: &Film| {
            let Found { truth, depth, adc_bailout } = found.as_ref()?;
            let (depth, adc_bailout) = (*depth, *adc_bailout);
            Some(Audit { depth, adc_bailout, ..truth.audit(film, metric) })
        };
        audit(&truth, &self.canvas.film);
        let took = self.clock.wall() - began;
        let until = self.until - SLACK * took;
        self.sample(until, until, false);
        let left = until - self.clock.wall();
        let more = match is_finest(&self.canvas.film) && left > 2.0 * for_audit {
            true => self.truth(left),
            false => None,
        };
        let truth = more.or(truth);
        audit(&truth, &self.canvas.film)
    }

    /// Passes of more samples, so fine that they are done when the clock shows `until`; `latest` stops
    /// them.
    fn sample(&mut self, until: f64, latest: f64, is_first: bool) {
        let watch = &Deadline { clock: self.clock, until: latest, watch: self.studio.watch };
        let studio = Studio { watch, ..self.studio };
        let Self { canvas, clock, plan, .. } = self;
        if is_first {
            let samples =
                (until - clock.wall()) / canvas.pace().a_sample() / canvas.pixels() as f64;
            let side = ((samples / PILOT).max(0.0).sqrt() as u32).min(MOST_SIDE);
            if side > 1 && !canvas.pilot(&studio, plan, side, *clock) {
                return;
            }
        }
        loop {
            let Some(worth) = canvas.worth(&studio) else { return };
            let time = Until { clock: *clock, until };
            if !canvas.pass(&studio, plan, &worth, time) || is_first || is_finest(&canvas.film) {
                return;
            }
        }
    }

    /// What drawn pixels really look like: with every knob at its dearest, or else with rays that go on as far
    /// as the scene has them.
    fn truth(&mut self, for_audit: f64) -> Option<Found> {
        let Self { studio, canvas, clock, options, .. } = self;
        let began = clock.wall();
        let most = began + for_audit.max((FOR_FEW * self.all).min(self.until - began));
        let stopped = Deadline { clock: *clock, until: most, watch: studio.watch };
        let worth = canvas.worth(&Studio { watch: &stopped, ..*studio })?;
        let enough = |known: usize| if known < FEW { most } else { began + for_audit };
        let all_the_way = |known: usize| match known {
            0 => began + FOR_ALL_THE_WAY * for_audit,
            _ => enough(known),
        };
        let Depths { origins, deepest } = self.depths;
        let all = plan(studio.world, origins, &deepest);
        let PlanOptions { depth, adc_bailout, .. } = self.own;
        let own = plan(studio.world, origins, &PlanOptions { depth, adc_bailout, ..deepest });
        // Where no ray goes on from what it meets, one look is as deep as another.
        let most = (all.max_trace_level, all.adc_bailout);
        let looks: &[(Plan, &dyn Fn(usize) -> f64)] = match goes_on(&own) {
            true => &[(all, &all_the_way), (own, &enough)],
            false => &[(all, &enough)],
        };
        let mut found = None;
        for (plan, until) in looks {
            let mut urn = Urn::new(canvas, &worth, options.seed);
            let asked = (options.metric, options.seed);
            let truth = Truth::find(studio, plan, &mut urn, asked, (*clock, until));
            if truth.pixels() >= LEAST {
                let (depth, adc_bailout) = (plan.max_trace_level, plan.adc_bailout);
                found = Some(Found {
                    truth,
                    depth: (depth < most.0).then_some(depth),
                    adc_bailout: (adc_bailout > most.1).then_some(adc_bailout),
                });
                break;
            }
        }
        let found = found?;
        canvas.counters += found.truth.counters;
        Some(found)
    }
}

/// What pixels really look like, and how far rays were followed where that was not all the way: as
/// [`Audit`] has them.
struct Found {
    truth: Truth,
    depth: Option<u32>,
    adc_bailout: Option<f64>,
}

/// Surfaces send rays on: what is seen depends on how deep one looks.
fn goes_on(plan: &Plan) -> bool {
    plan.simulates(Effect::Reflection) || plan.simulates(Effect::Transparency)
}
