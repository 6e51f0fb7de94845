//! Measures what each setting of a render costs, and how much error it removes: renders a World under many Plans.
//!
//! **In:** a [`World`], the knobs to try, a budget in seconds. **Out:** a [`Report`]. **Invariant:**
//! pixels, samples and intervals are drawn from seeds, so errors are the same on every run that has time
//! for the same reference; only seconds differ. Nothing here prints or accesses disks.

mod affordable_reference;
mod answer;
mod audit;
mod choose;
mod draw;
mod equal_settings;
mod first_samples;
mod forecast;
mod front;
mod glare;
pub mod json;
mod knob;
mod ladder;
mod measure;
mod promise;
mod proof;
mod reference;
mod refine;
mod render_settings;
mod report;
mod sentence;
mod spend;
mod statistics;
pub mod svg;
pub mod table;
mod trial;

pub use affordable_reference::LEAST as LEAST_PIXELS;
pub(crate) use front::Order;
pub use front::Verdict;
pub use glare::glare;
pub use knob::{KNOBS, Knob, Need, share};
pub use measure::{Clock, Span, Times};
pub use promise::{Kept, Step, TooSmall, keep};
pub use proof::Audit;
pub use refine::BYTES_PER_PIXEL;
pub use report::{Cut, Line, Report, Row, Setting, Tried};
pub use spend::{First, Spent, spend};
pub use statistics::{Estimate, Metric};

use crate::plan::{Frame, PlanOptions, plan};
use crate::trace::{TraceOptions, Watch};
use crate::world::{Origins, World};
use affordable_reference::Depths;
use equal_settings::Alike;
use measure::Elapsing;
use reference::{Geometries, Reference, Studio};
use trial::{Bench, Candidate, Picture, Trial};

/// Options of a measurement.
#[derive(Debug, Clone, Copy)]
pub struct Options<'a> {
    /// The picture.
    pub frame: Frame,
    /// The knobs to try: [`KNOBS`], or some of them.
    pub knobs: &'a [Knob],
    /// How errors are measured.
    pub metric: Metric,
    /// In wall-clock seconds.
    pub budget: f64,
    /// Seed for the audited pixels and the samples of the reference.
    pub seed: u64,
    /// As [`PlanOptions::alpha`].
    pub alpha: bool,
    /// How pictures are traced.
    pub trace: TraceOptions,
}

impl Options<'_> {
    /// Returns the defaults of `lucarne accuracy`, on one thread.
    pub fn new(frame: Frame) -> Self {
        Self {
            frame,
            knobs: KNOBS,
            metric: Metric::default(),
            budget: 60.0,
            seed: 1,
            alpha: false,
            trace: TraceOptions::on_threads(1),
        }
    }
}

/// Reason why there is no report.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unmeasured {
    /// The watch stopped it.
    Stopped,
    /// The scene's own picture takes about `own` seconds or more, which is too much of the budget. About
    /// `enough` seconds would allow at least one more picture.
    TooShort {
        /// In seconds.
        own: f64,
        /// In seconds.
        enough: f64,
    },
}

/// Returns the options for tracing the reference: every knob at its most expensive, unless it has another setting
/// for that. The samples of pixels are the reference's own.
fn dearest(own: PlanOptions, knobs: &[Knob]) -> PlanOptions {
    let mut options = own;
    for knob in knobs {
        let all = knob.with((knob.get)(&own));
        let setting = knob.reference.or(all.last().copied());
        setting.into_iter().for_each(|setting| (knob.set)(&mut options, setting));
    }
    options
}

/// Returns the default options of `render` for this scene, with each knob set explicitly.
fn own(world: &World, frame: Frame) -> PlanOptions {
    PlanOptions {
        depth: Some(world.settings.max_trace_level),
        adc_bailout: Some(world.settings.adc_bailout),
        julia_iterations: world.julia_iterations(),
        ..PlanOptions::new(frame)
    }
}

/// Returns the knobs that affect the scene, at least with every knob at its most expensive.
fn called_for<'a>(
    world: &World,
    origins: &Origins,
    own: PlanOptions,
    knobs: &'a [Knob],
) -> Vec<&'a Knob> {
    let full = plan(world, origins, &dearest(own, knobs));
    let called = |knob: &&Knob| knob.needs.is_met(world, &full);
    knobs.iter().filter(called).collect()
}

/// Returns a sentence with the reason for each knob that does not affect the scene.
pub fn idle(world: &World, origins: &Origins, frame: Frame, knobs: &[Knob]) -> Vec<String> {
    let called = called_for(world, origins, own(world, frame), knobs);
    let is_idle = |knob: &&Knob| called.iter().all(|called| called.name != knob.name);
    let say = |knob: &Knob| format!("{} does nothing here: {}", knob.name, knob.idle);
    knobs.iter().filter(is_idle).map(say).collect()
}

/// A setting of a knob, and the candidate with that setting.
struct Turned<'a> {
    knob: &'a Knob,
    setting: f64,
    candidate: usize,
}

/// Returns the scene's own settings and those with one knob changed, and the settings of each knob from
/// coarse to fine.
fn candidates<'a>(
    world: &World,
    origins: &Origins,
    own: PlanOptions,
    knobs: &[&'a Knob],
) -> (Vec<Candidate>, Vec<Vec<Turned<'a>>>) {
    let factor = |options: &PlanOptions| {
        knobs.iter().map(|knob| (knob.factor)((knob.get)(options))).product::<f64>()
    };
    let candidate = |name: String, least: f64, options: &PlanOptions| Candidate {
        name,
        plan: plan(world, origins, options),
        least,
        factor: factor(options),
    };
    let mut candidates = vec![candidate("*".to_owned(), 1.0, &own)];
    let of_knob = |&knob: &&'a Knob| {
        let mine = (knob.get)(&own);
        let mut turn = |setting: f64| {
            if setting == mine {
                return Turned { knob, setting, candidate: 0 };
            }
            let mut options = own;
            (knob.set)(&mut options, setting);
            let name = format!("{} {}", knob.name, (knob.label)(setting));
            candidates.push(candidate(name, (knob.least)(setting), &options));
            Turned { knob, setting, candidate: candidates.len() - 1 }
        };
        knob.with(mine).into_iter().map(&mut turn).collect()
    };
    let turned = knobs.iter().map(of_knob).collect();
    (candidates, turned)
}

/// Returns which settings of a knob have a row, and which have none.
fn tried(
    turned: &[Turned],
    pictures: &[Picture],
    alike: &Alike,
    is_same: &dyn Fn(&Picture, &Picture) -> bool,
) -> Tried {
    let label = |turned: &Turned| (turned.knob.label)(turned.setting);
    let ends = [turned.first(), turned.last()].map(|end| end.map(label).unwrap_or_default());
    let name = turned.first().map_or("", |turned| turned.knob.name);
    let mut tried = Tried {
        name,
        ends,
        settings: Vec::new(),
        vain: Vec::new(),
        left_out: Vec::new(),
        sentence: String::new(),
    };
    for this in turned {
        let timed = alike.timed(this.candidate);
        let made = pictures.iter().find(|picture| picture.candidate == timed);
        // Settings found to be the same after rendering share a row, too.
        let row = made.and_then(|made| pictures.iter().position(|other| is_same(made, other)));
        match row {
            Some(row) => tried.settings.push(Setting {
                label: label(this),
                flag: (this.knob.flag)(this.setting),
                is_own: this.candidate == 0,
                row,
                verdict: Verdict::Front,
            }),
            None if alike.is_vain(this.candidate) => tried.vain.push(label(this)),
            None => tried.left_out.push(label(this)),
        }
    }
    tried
}

/// Tries each setting of each knob, as far as time permits, with the other knobs as in the scene.
///
/// # Errors
///
/// If stopped, or if the budget is too short to measure anything.
///
/// ```
/// use lucarne::accuracy::{Options, accuracy};
/// use lucarne::{plan::Frame, road::{self, Road}, source::NoFiles, trace::Unwatched};
///
/// let mut road = Road::new(&NoFiles, road::Options::default());
/// let (world, origins) = road.compile("a.scene", "plane { z, 0 pigment { checker rgb 0 rgb 1 } finish { ambient 1 } }
///     camera { location <3, 2, 5> look_at 0 }");
/// let start = std::time::Instant::now();
/// let clock = || start.elapsed().as_secs_f64();
/// let options = Options { budget: 20.0, ..Options::new(Frame::whole(16, 12)) };
/// let report = accuracy(&world, &origins, &options, &clock, &Unwatched).expect("enough time");
/// assert!(report.knobs.iter().any(|knob| knob.name == "antialias"));
/// println!("{}", report.error(0).value); // Of the picture that `render` makes: the root mean square.
/// ```
pub fn accuracy(
    world: &World,
    origins: &Origins,
    options: &Options,
    clock: &dyn Clock,
    watch: &dyn Watch,
) -> Result<Report, Unmeasured> {
    let began = clock.wall();
    let own = own(world, options.frame);
    let called = called_for(world, origins, own, options.knobs);
    let geometry = Geometries::default();
    let elapsing = Elapsing { clock, began, budget: options.budget, watch };
    // All alike, so that their times compare.
    let counted = TraceOptions { count_work: true, ..options.trace };
    let studio = Studio { world, geometry: &geometry, options: counted, watch: &elapsing };
    let list = audit::sets(options.frame.region, audit::WANTED, 1, options.seed).remove(0);
    let list = audit::shuffled(list, options.seed);
    watch.built();

    let (candidates, turned) = candidates(world, origins, own, &called);
    let numbers = |turned: &Vec<Turned>| turned.iter().map(|turned| turned.candidate).collect();
    let knobs: Vec<Vec<usize>> = turned.iter().map(numbers).collect();
    let depths = Depths { origins, deepest: dearest(own, options.knobs) };
    let most_depth = depths.most();
    let bench = Bench { studio, depths, options, clock, until: began + options.budget };
    let Trial { reference, depth, pictures, alike } = bench.run(&candidates, &knobs, &list)?;

    let is_same = |a: &Picture, b: &Picture| {
        let factor = |picture: &Picture| candidates[picture.candidate].factor;
        a.counters == b.counters && factor(a) == factor(b) && a.colors == b.colors
    };
    let tried = |turned: &Vec<Turned>| tried(turned, &pictures, &alike, &is_same);
    let knobs = turned.iter().map(tried).collect();
    let rows = pictures.into_iter().map(|Picture { candidate, times, counters, colors }| {
        let off = audit::by_place(&list, reference.deviations(&colors));
        Row {
            name: candidates[candidate].name.clone(),
            times,
            counters,
            factor: candidates[candidate].factor,
            errors: Metric::ALL.map(|metric| metric.estimate(&off, options.frame.region.pixels())),
            verdict: Verdict::Front,
            resamples: options.metric.resampled(&off),
            colors,
        }
    });
    let mut report = Report {
        frame: options.frame,
        metric: options.metric,
        seed: options.seed,
        audited: reference.pixels(),
        cut: Cut {
            pixels: (reference.pixels() < list.len()).then_some(list.len()),
            samples: (reference.samples() < Reference::samples_at(Reference::COARSEST))
                .then_some(reference.samples()),
            depth: (depth < most_depth).then_some((depth, most_depth)),
        },
        reference_samples: reference.samples(),
        floors: Metric::ALL.map(|metric| reference.floor(metric)),
        rows: rows.collect(),
        knobs,
        idle: Vec::new(),
    };
    report.judge();
    Ok(report)
}

/// Forwards stop requests, but not the progress of one of many parts.
struct Quiet<'a>(&'a dyn Watch);

impl Watch for Quiet<'_> {
    fn progress(&self, _: usize, _: usize) {}

    fn built(&self) {
        self.0.built();
    }

    fn should_stop(&self) -> bool {
        self.0.should_stop()
    }
}

#[cfg(test)]
mod budget_tests;
#[cfg(test)]
mod promise_tests;
#[cfg(test)]
mod tests;
