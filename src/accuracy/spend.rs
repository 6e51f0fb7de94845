//! Renders pictures within a promised time.
//!
//! **In:** a World, and the deadline of its picture. **Out:** the best picture possible in that time, and
//! what is known of its error. **Invariant:** the deadline is kept even if it is too short for the scene's
//! own settings; an error is reported only against a reference as deep as the scene.

use super::affordable_reference::{Deadline, Depths, LEAST};
use super::draw::{Truth, Urn};
use super::first_samples::{Begun, begin};
use super::measure::Clock;
use super::proof::Audit;
use super::reference::{Geometries, Studio};
use super::refine::{Canvas, Pace, is_finest};
use super::render_settings::Easel;
use super::{Options, Quiet};
use crate::film::Film;
use crate::plan::{Effect, Plan, PlanOptions, plan};
use crate::trace::{Traced, Watch};
use crate::world::{Origins, World};

/// Fraction of the total time for the audit, and the fraction if fewer than `FEW` pixels were done by then;
/// the rest is for samples. A tenth fewer samples increase the error by 8 %.
const FOR_AUDIT: f64 = 0.1;
const FOR_FEW: f64 = 0.14;
const FEW: usize = 200;
/// Fraction of the total time that the first pass leaves at least, so that the error of a complete picture
/// is known.
const KEPT: f64 = 0.05;
/// Fraction of the audit time for a first block of pixels at full depth.
const FOR_ALL_THE_WAY: f64 = 0.25;
/// Fraction of the time for more samples that is used before the audit. The rest is used afterwards, guided
/// by those samples and together with time that the audit did not need.
const BEFORE_AUDIT: f64 = 0.95;
/// Factor by which the same work may take longer the second time.
const SLACK: f64 = 1.2;

/// A picture with a promised time.
#[derive(Debug, Clone, PartialEq)]
pub struct Spent {
    /// Incomplete if even the first pass did not fit. Its film contains the number of samples of each
    /// pixel.
    pub traced: Traced,
    /// Flags with which all of it but `rest` was rendered, without the number of samples.
    pub flags: String,
    /// Whether those are cheaper than the scene's own settings, which would not have fit.
    pub is_less: bool,
    /// Number of pixels for which even those were too expensive, and the flags of these pixels: the
    /// cheapest.
    pub rest: usize,
    /// The cheapest flags.
    pub least: String,
    /// Whether each pixel has the maximum number of samples, so that more time would change nothing.
    pub is_finest: bool,
    /// `None` if there was no time to trace pixels as deep as the scene does.
    pub audit: Option<Audit>,
}

/// Result of the first pass.
#[derive(Debug, Clone, Copy)]
pub struct First<'a> {
    /// The film so far.
    pub film: &'a Film,
    /// Average number of processors it had.
    pub processors: f64,
}

/// Renders as well as possible before the clock reaches the time returned by `until`, and audits the
/// picture in the rest of it. `until` is called twice: when the bounding volume hierarchy is built, and
/// with the result of the first pass.
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
    // Suppresses the progress of individual parts.
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
        rest: rest.len(),
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
    let pace = Pace { seconds: wall, samples: film.pixels.len() as f64 };
    let mut spending = Spending {
        studio,
        depths: Depths { origins, deepest: easel.deepest },
        own: easel.own,
        plan: plan(world, origins, &settings),
        canvas: Canvas::new(film, &rest, counters, pace),
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
    /// In seconds.
    all: f64,
    /// Deadline in clock time.
    until: f64,
}

impl Spending<'_> {
    /// Adds samples, computes the reference of the audit, adds samples again, and returns the audit.
    fn spend(&mut self) -> Option<Audit> {
        let now = self.clock.wall();
        let for_audit = (FOR_AUDIT * self.all).min(self.until - now);
        let for_samples = self.until - for_audit - now;
        self.sample(now + BEFORE_AUDIT * for_samples, self.until - for_audit);
        // If the picture cannot be refined further, all of the remaining time is for the audit.
        let for_audit = match is_finest(&self.canvas.film) {
            true => self.until - self.clock.wall(),
            false => for_audit,
        };
        let truth = self.truth(for_audit);
        // Computing the audit at the end takes as long as it does now.
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
        self.sample(until, until);
        let left = until - self.clock.wall();
        let more = match is_finest(&self.canvas.film) && left > 2.0 * for_audit {
            true => self.truth(left),
            false => None,
        };
        let truth = more.or(truth);
        audit(&truth, &self.canvas.film)
    }

    /// Makes passes of more samples, as fine as can be finished when the clock reaches `until`; `latest`
    /// stops them.
    fn sample(&mut self, until: f64, latest: f64) {
        let watch = &Deadline { clock: self.clock, until: latest, watch: self.studio.watch };
        let studio = Studio { watch, ..self.studio };
        let Self { canvas, clock, plan, .. } = self;
        while let Some(expected) = canvas.expected(&studio) {
            if !canvas.pass(&studio, plan, &expected, (*clock, until)) {
                return;
            }
        }
    }

    /// Computes the reference of drawn pixels, with every knob at its most expensive, or else with the
    /// scene's own limits on depth and weight.
    fn truth(&mut self, for_audit: f64) -> Option<Found> {
        let Self { studio, canvas, clock, options, .. } = self;
        let began = clock.wall();
        let most = began + for_audit.max((FOR_FEW * self.all).min(self.until - began));
        let stopped = Deadline { clock: *clock, until: most, watch: studio.watch };
        let expected = canvas.expected(&Studio { watch: &stopped, ..*studio })?;
        let enough = |known: usize| if known < FEW { most } else { began + for_audit };
        let all_the_way = |known: usize| match known {
            0 => began + FOR_ALL_THE_WAY * for_audit,
            _ => enough(known),
        };
        let Depths { origins, deepest } = self.depths;
        let all = plan(studio.world, origins, &deepest);
        let PlanOptions { depth, adc_bailout, .. } = self.own;
        let own = plan(studio.world, origins, &PlanOptions { depth, adc_bailout, ..deepest });
        // If no ray continues from a surface, depth makes no difference.
        let most = (all.max_trace_level, all.adc_bailout);
        let looks: &[(Plan, &dyn Fn(usize) -> f64)] = match goes_on(&own) {
            true => &[(all, &all_the_way), (own, &enough)],
            false => &[(all, &enough)],
        };
        let mut found = None;
        for (plan, until) in looks {
            let mut urn = Urn::new(canvas, &expected, options.seed);
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

/// Reference of drawn pixels, and the limits on its depth and weight, if any, as in [`Audit`].
struct Found {
    truth: Truth,
    depth: Option<u32>,
    adc_bailout: Option<f64>,
}

/// Whether surfaces send rays on, so that the picture depends on the depth.
fn goes_on(plan: &Plan) -> bool {
    plan.simulates(Effect::Reflection) || plan.simulates(Effect::Transparency)
}
