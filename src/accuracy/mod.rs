//! The same World under many Plans: what each setting costs and what it buys.
//!
//! **In:** a [`World`], the knobs to try, a budget of seconds. **Out:** a [`Report`]. **Invariant:**
//! pixels, samples and intervals are drawn from seeds, so errors are the same on every run that has
//! time for the same reference; only seconds differ. Nothing here prints or reads disks.

mod afford;
mod alike;
mod answer;
mod audit;
mod choose;
mod easel;
mod forecast;
mod front;
pub mod json;
mod knob;
mod measure;
mod promise;
mod reference;
mod refine;
mod sentence;
mod spend;
mod statistics;
pub mod svg;
pub mod table;
mod trial;

pub use afford::LEAST as LEAST_PIXELS;
pub use front::{Order, Verdict};
pub use knob::{KNOBS, Knob, Need};
pub use measure::{Clock, Span, Times};
pub use promise::{Audit, Kept, Step, TooSmall, keep};
pub use spend::{First, Spent, spend};
pub use statistics::{Estimate, Metric};

use crate::plan::{Frame, PlanOptions, Region, plan};
use crate::trace::{Counters, TraceOptions, Watch};
use crate::world::{Origins, World};
use afford::Depths;
use alike::Alike;
use front::Point;
use measure::Elapsing;
use reference::{Geometries, Reference, Studio};
use trial::{Bench, Candidate, Picture, Trial};

/// What is asked.
#[derive(Debug, Clone, Copy)]
pub struct Options<'a> {
    pub frame: Frame,
    pub knobs: &'a [Knob],
    pub metric: Metric,
    /// Seconds by the wall clock.
    pub budget: f64,
    /// Of the audited pixels and the reference's samples.
    pub seed: u64,
    pub trace: TraceOptions,
}

/// How far runs may lie apart, of the shortest, where no row has enough to tell.
const UNKNOWN: f64 = 1.0;
/// Seconds of tracing below which it is not told whether the machine was busy.
const LEAST_TO_TELL: f64 = 0.5;

/// Why there is no report.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unmeasured {
    Stopped,
    /// The scene's own picture takes about `own` seconds or more, which is too much of the budget; about
    /// `enough` are enough for something beside it.
    TooShort { own: f64, enough: f64 },
}

/// What the settings cost and buy.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    pub frame: Frame,
    pub metric: Metric,
    pub seed: u64,
    pub audited: usize,
    pub cut: Cut,
    /// Of each audited pixel.
    pub reference_samples: u32,
    /// The reference's own error, in each of [`Metric::ALL`].
    pub floors: [f64; 3],
    pub knobs: Vec<Tried>,
    /// What the caller wants said of knobs that do nothing here.
    pub idle: Vec<String>,
    /// The first is the picture as `render` makes it.
    pub rows: Vec<Row>,
}

/// What had to be given up to keep the budget, settings aside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cut {
    /// How many pixels were to be audited.
    pub pixels: Option<usize>,
    /// How few samples of each the reference has.
    pub samples: Option<u32>,
    /// How deep the reference looks, and how deep it was to.
    pub depth: Option<(u32, u32)>,
}

/// A knob, and what came of turning it.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    pub name: &'static str,
    /// Its coarsest setting, and its finest.
    pub ends: [String; 2],
    /// From cheap to dear. Those that are the same work at every audited pixel share a row.
    pub settings: Vec<Setting>,
    /// Those that change no audited pixel, and were not timed.
    pub vain: Vec<String>,
    /// What did not fit into the budget.
    pub left_out: Vec<String>,
    /// What it bought, or that it buys nothing here.
    pub sentence: String,
}

/// Settings that share a row.
pub struct Line<'a> {
    /// `5`, or of several the coarsest and the finest: `10 … 250`.
    pub label: String,
    /// One of them is the scene's own.
    pub is_own: bool,
    pub first: &'a Setting,
}

impl Tried {
    /// From cheap to dear; those that share a row are one line.
    pub fn lines(&self) -> impl Iterator<Item = Line<'_>> {
        self.settings.chunk_by(|a, b| a.row == b.row).filter_map(|same| {
            let (first, last) = (same.first()?, same.last()?);
            let label = match same.len() {
                1 => first.label.clone(),
                _ => format!("{} … {}", first.label, last.label),
            };
            Some(Line { label, is_own: same.iter().any(|setting| setting.is_own), first })
        })
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    pub label: String,
    pub flag: String,
    /// The scene's own, or `render`'s.
    pub is_own: bool,
    /// Which of the rows.
    pub row: usize,
    /// Among the settings of its knob.
    pub verdict: Verdict,
}

/// One picture: all settings as the scene has them, but one.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// `depth 3`; `*` for the first.
    pub name: String,
    /// Of all rows that are the same work: their runs are runs of each.
    pub times: Times,
    /// Of the whole picture.
    pub counters: Counters,
    /// The unit cost of a ray in this row's arithmetic, in rays of the camera.
    pub factor: f64,
    /// In each of [`Metric::ALL`].
    pub errors: [Estimate; 3],
    /// Among all rows.
    pub verdict: Verdict,
    /// The audited pixels' colours, linear and clamped.
    pub colors: Vec<[f64; 3]>,
    /// Of the metric asked.
    pub resamples: Vec<f64>,
}

impl Report {
    /// As it is shown.
    pub fn error(&self, row: usize) -> Estimate {
        self.shown(self.metric, row)
    }

    /// An error with what can be said of it: below what the reference resolves, nothing but that it
    /// lies between 0 and there, or where its own interval ends if that is further.
    pub fn shown(&self, metric: Metric, row: usize) -> Estimate {
        let (error, resolution) = (self.rows[row].errors[metric as usize], self.resolution(metric));
        match error.value < resolution {
            true => Estimate { value: resolution, low: 0.0, high: error.high.max(resolution) },
            false => error,
        }
    }

    /// Errors below this cannot be told from the reference's own.
    pub fn resolution(&self, metric: Metric) -> f64 {
        4.0 * self.floors[metric as usize]
    }

    pub fn is_resolved(&self, metric: Metric, row: usize) -> bool {
        self.rows[row].errors[metric as usize].value >= self.resolution(metric)
    }

    /// What the rows cost, counted.
    pub fn cost(&self, row: usize) -> f64 {
        self.rows[row].factor * knob::cost(&self.rows[row].counters)
    }

    /// The fewest runs of a row, and the most.
    pub fn runs(&self) -> (usize, usize) {
        let runs = || self.rows.iter().map(|row| row.times.cpu.len());
        (runs().min().unwrap_or(0), runs().max().unwrap_or(0))
    }

    /// The part of its threads' time that tracing had, all runs together: much less than 1 where the
    /// machine had other things to do. 1 where runs are too short to tell.
    pub fn share_of_time(&self, threads: usize) -> f64 {
        let total = |of: fn(&Times) -> &[f64]| -> f64 {
            self.rows.iter().flat_map(|row| of(&row.times)).sum()
        };
        let (cpu, wall) = (total(|times| &times.cpu), total(|times| &times.wall));
        let whole = wall * threads.max(1) as f64;
        if wall >= LEAST_TO_TELL { (cpu / whole).min(1.0) } else { 1.0 }
    }

    /// The flag that makes a row's picture; none for that of the scene's own settings.
    pub fn flag(&self, row: usize) -> Option<&str> {
        let mut settings = self.knobs.iter().flat_map(|knob| &knob.settings);
        settings.find(|setting| setting.row == row && row > 0).map(|setting| setting.flag.as_str())
    }

    /// Puts settings in order and says what they are worth.
    fn judge(&mut self) {
        let order = self.order();
        let all: Vec<usize> = (0..self.rows.len()).collect();
        for (row, verdict) in self.rows.iter_mut().zip(order.verdicts(&all)) {
            row.verdict = verdict;
        }
        for tried in &mut self.knobs {
            // Of rows of the same cost the first goes before here, too: so no two point at each other.
            let mut rows: Vec<usize> = tried.settings.iter().map(|setting| setting.row).collect();
            rows.sort_unstable();
            rows.dedup();
            let verdicts = order.verdicts(&rows);
            let sorted = order.from_cheap_to_dear(&rows);
            let place = |row| sorted.iter().position(|&other| other == row);
            for setting in &mut tried.settings {
                let own = rows.iter().zip(&verdicts).find(|(row, _)| **row == setting.row);
                setting.verdict = own.map_or(Verdict::Front, |(_, verdict)| *verdict);
            }
            tried.settings.sort_by_key(|setting| place(setting.row));
        }
        for knob in 0..self.knobs.len() {
            self.knobs[knob].sentence = sentence::of(self, &order, &self.knobs[knob]);
        }
    }

    /// Which rows are cheaper, which better.
    pub fn order(&self) -> Order {
        let times = || self.rows.iter().map(|row| &row.times);
        let apart = times().filter_map(Times::apart).fold(None, |most: Option<f64>, apart| {
            Some(most.map_or(apart, |most| most.max(apart)))
        });
        let point = |row: usize| {
            let this = &self.rows[row];
            Point {
                doubt: match this.times.apart() {
                    Some(_) => 0.0,
                    None => apart.unwrap_or(UNKNOWN),
                },
                work: (this.counters, this.factor),
                cost: self.cost(row),
                cpu: Span::of(&this.times.cpu),
                error: this.errors[self.metric as usize],
                resamples: this.resamples.clone(),
                resolution: self.resolution(self.metric),
            }
        };
        Order::of((0..self.rows.len()).map(point).collect())
    }

    /// Of a count of the whole picture.
    pub fn a_pixel(&self, count: f64) -> f64 {
        let Region { width, height, .. } = self.frame.region;
        count / (f64::from(width) * f64::from(height))
    }
}

/// Every knob at its dearest, antialiasing aside: what the reference is traced with.
fn dearest(own: PlanOptions, knobs: &[Knob]) -> PlanOptions {
    let mut options = own;
    for knob in knobs {
        let all = knob.with((knob.get)(&own));
        all.last().into_iter().for_each(|&setting| (knob.set)(&mut options, setting));
    }
    options
}

/// What `render` does with this scene when it is told nothing, each knob spelt out.
fn own(world: &World, frame: Frame) -> PlanOptions {
    PlanOptions {
        depth: Some(world.settings.max_trace_level),
        adc_bailout: Some(world.settings.adc_bailout),
        ..PlanOptions::new(frame)
    }
}

/// The knobs whose effect the scene calls for, at least with every knob at its dearest.
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

/// For each knob that the scene does not call for, one sentence that says so and why.
pub fn idle(world: &World, origins: &Origins, frame: Frame, knobs: &[Knob]) -> Vec<String> {
    let called = called_for(world, origins, own(world, frame), knobs);
    let is_idle = |knob: &&Knob| called.iter().all(|called| called.name != knob.name);
    let say = |knob: &Knob| format!("{} does nothing here: {}", knob.name, knob.idle);
    knobs.iter().filter(is_idle).map(say).collect()
}

/// A setting of a knob, and the candidate that has it.
struct Turned<'a> {
    knob: &'a Knob,
    setting: f64,
    candidate: usize,
}

/// The scene's own settings and each other that the knobs have, one turned at a time; and every knob's, from
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

/// Which of a knob's settings have a row, and which have none.
fn tried(turned: &[Turned], pictures: &[Picture], alike: &Alike) -> Tried {
    let label = |turned: &Turned| (turned.knob.label)(turned.setting);
    let ends = [turned.first(), turned.last()].map(|end| end.map(label).unwrap_or_default());
    let name = turned.first().map_or("", |turned| turned.knob.name);
    let mut tried =
        Tried { name, ends, settings: Vec::new(), vain: Vec::new(), left_out: Vec::new(), sentence: String::new() };
    for this in turned {
        let timed = alike.timed(this.candidate);
        let row = pictures.iter().position(|picture| picture.candidate == timed);
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

/// Tries every setting of every knob that there is time for, the others as the scene has them.
///
/// # Errors
/// When it is stopped, or the budget is too short to measure anything.
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

    let knobs = turned.iter().map(|turned| tried(turned, &pictures, &alike)).collect();
    let rows = pictures.into_iter().map(|Picture { candidate, times, counters, colors }| {
        let off = audit::by_place(&list, reference.deviations(&colors));
        Row {
            name: candidates[candidate].name.clone(),
            times,
            counters,
            factor: candidates[candidate].factor,
            errors: Metric::ALL.map(|metric| metric.estimate(&off)),
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

/// Passes on the wish to stop, and not how far one of many parts has come.
struct Quiet<'a>(&'a dyn Watch);

impl Watch for Quiet<'_> {
    fn progress(&self, _: usize, _: usize) {}

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
