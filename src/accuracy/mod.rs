//! The same World under many Plans: what each setting costs and what it buys.
//!
//! **In:** a [`World`], the knobs to try, a budget of seconds. **Out:** a [`Report`]. **Invariant:**
//! pixels, samples and intervals are drawn from seeds, so errors are the same on every run that has
//! time for the same reference; only seconds differ. Nothing here prints or reads disks.

mod audit;
mod choose;
mod front;
pub mod json;
mod knob;
mod measure;
mod promise;
mod reference;
mod sentence;
mod statistics;
pub mod svg;
pub mod table;

pub use front::{ENOUGH_RUNS, Order, Saving, Verdict};
pub use knob::{KNOBS, Knob};
pub use measure::{Clock, Span, Times};
pub use promise::{Audit, Kept, Spent, Step, TooSmall, keep, spend};
pub use statistics::{Estimate, Metric};

use crate::plan::{Frame, Plan, PlanOptions, Region, plan};
use crate::trace::{Counters, Sampling, TraceOptions, Watch};
use crate::world::{Origins, World};
use front::Point;
use measure::Elapsing;
use reference::{Geometries, Reference, Studio};

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

/// Of the budget: what a reference may take, and what one round of runs may.
const FOR_REFERENCE: f64 = 0.35;
const FOR_A_ROUND: f64 = 0.3;
/// The most runs of each picture.
const MOST_ROUNDS: usize = 9;

/// What the settings cost and buy.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    pub frame: Frame,
    pub metric: Metric,
    pub seed: u64,
    pub audited: usize,
    /// Of each audited pixel.
    pub reference_samples: u32,
    /// The reference's own error, in each of [`Metric::ALL`].
    pub floors: [f64; 3],
    pub runs: usize,
    pub knobs: Vec<Tried>,
    /// The first is the picture as `render` makes it.
    pub rows: Vec<Row>,
}

/// A knob, and what came of turning it.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    pub name: &'static str,
    /// From cheap to dear.
    pub settings: Vec<Setting>,
    /// What would not have fitted into the budget.
    pub left_out: Vec<String>,
    /// What it bought, or that it buys nothing here.
    pub sentence: String,
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

    /// Whether there are enough runs for the clock to be heard.
    pub fn is_timed(&self) -> bool {
        self.runs >= ENOUGH_RUNS
    }

    /// Puts settings in order and says what they are worth.
    fn judge(&mut self) {
        let order = self.order();
        let all: Vec<usize> = (0..self.rows.len()).collect();
        for (row, verdict) in self.rows.iter_mut().zip(order.verdicts(&all)) {
            row.verdict = verdict;
        }
        for tried in &mut self.knobs {
            let rows: Vec<usize> = tried.settings.iter().map(|setting| setting.row).collect();
            let sorted = order.from_cheap_to_dear(&rows);
            let place = |row| sorted.iter().position(|&other| other == row);
            for (setting, verdict) in tried.settings.iter_mut().zip(order.verdicts(&rows)) {
                setting.verdict = verdict;
            }
            tried.settings.sort_by_key(|setting| place(setting.row));
        }
        for knob in 0..self.knobs.len() {
            self.knobs[knob].sentence = sentence::of(self, &order, &self.knobs[knob]);
        }
    }

    /// Which rows are cheaper, which better.
    pub fn order(&self) -> Order {
        let point = |row: usize| {
            let this = &self.rows[row];
            let value = this.errors[self.metric as usize].value;
            let errors = [&[value], &this.resamples[..]].concat();
            let resolution = self.resolution(self.metric);
            let work = (this.counters, this.factor);
            Point { work, cost: self.cost(row), cpu: this.times.cpu.clone(), errors, resolution }
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
    let called = |knob: &&Knob| knob.effects.iter().any(|&effect| full.simulates(effect));
    knobs.iter().filter(called).collect()
}

/// Tries every setting of every knob, the others as the scene has them. `None` when stopped.
pub fn accuracy(
    world: &World,
    origins: &Origins,
    options: &Options,
    clock: &dyn Clock,
    watch: &dyn Watch,
) -> Option<Report> {
    let began = clock.wall();
    let elapsed = || clock.wall() - began;
    let own = own(world, options.frame);
    let called = called_for(world, origins, own, options.knobs);
    let geometry = Geometries::new(world);
    let quiet = Elapsing { clock, began, budget: options.budget, watch };
    let studio = Studio { world, geometry: &geometry, options: options.trace, watch: &quiet };
    // All alike, so that their times compare.
    let counted = TraceOptions { count_work: true, ..options.trace };
    let region = options.frame.region;
    let list = audit::sets(region, audit::WANTED, 1, options.seed).remove(0);
    watch.built();

    // What the cheapest picture takes, and the scene's own.
    let mut cheapest = own;
    called.iter().for_each(|knob| (knob.set)(&mut cheapest, knob.cheapest()));
    let mut pilot = [Times::default(), Times::default()];
    let plans = [plan(world, origins, &cheapest), plan(world, origins, &own)];
    measure::round(world, &plans, &counted, clock, &quiet, &mut pilot)?;
    let most =
        dearest_that_fit(&called, &own, (pilot[0].wall[0], pilot[1].wall[0]), options.budget);

    let mut rows = Rows::default();
    let mut add = |name: String, options: &PlanOptions| {
        let factors = called.iter().map(|knob| (knob.factor)((knob.get)(options)));
        rows.factors.push(factors.product());
        rows.plans.push(plan(world, origins, options));
        rows.names.push(name);
        rows.names.len() - 1
    };
    add("*".to_owned(), &own);
    let mut knobs = Vec::new();
    for knob in &called {
        let mine = (knob.get)(&own);
        let mut tried = Tried {
            name: knob.name,
            settings: Vec::new(),
            left_out: Vec::new(),
            sentence: String::new(),
        };
        for setting in knob.with(mine) {
            let (label, is_own) = ((knob.label)(setting), setting == mine);
            if !is_own && (knob.least)(setting) > most {
                tried.left_out.push(label);
                continue;
            }
            let mut turned = own;
            (knob.set)(&mut turned, setting);
            let row = match is_own {
                true => 0,
                false => add(format!("{} {label}", knob.name), &turned),
            };
            let (flag, verdict) = ((knob.flag)(setting), Verdict::Front);
            tried.settings.push(Setting { label, flag, is_own, row, verdict });
        }
        knobs.push(tried);
    }

    // The audited pixels of each, and one timed run of each.
    let mut colors = Vec::new();
    for plan in &rows.plans {
        colors.push(studio.colors(plan, &list, Sampling::Planned)?.0);
    }
    let mut times = vec![Times::default(); rows.plans.len()];
    let counters = measure::round(world, &rows.plans, &counted, clock, &quiet, &mut times)?;
    let a_round = elapsed();

    // As fine a reference as is needed, or as there is time for.
    let deep = plan(world, origins, &dearest(own, options.knobs));
    let mut reference = Reference::new(&studio, &deep, &list, options.seed, Reference::COARSEST)?;
    let mut last = elapsed() - a_round;
    let until = a_round + FOR_REFERENCE * options.budget;
    loop {
        let errors = colors.iter().map(|c| options.metric.of(&reference.deviations(c)));
        let resolved = errors.filter(|&error| error > 0.0).fold(f64::INFINITY, f64::min);
        let enough = 4.0 * reference.floor(options.metric) <= resolved;
        if enough || elapsed() + 2.0 * last > until {
            break;
        }
        let before = elapsed();
        if !reference.double(&studio, &deep, &list)? {
            break;
        }
        last = elapsed() - before;
    }

    // More runs, while there is time for a whole round.
    let mut runs = 1;
    let mut round_takes = times.iter().map(|times| times.wall[0]).sum::<f64>();
    while runs < MOST_ROUNDS && elapsed() + round_takes < options.budget {
        let before = elapsed();
        measure::round(world, &rows.plans, &counted, clock, &quiet, &mut times)?;
        (runs, round_takes) = (runs + 1, elapsed() - before);
    }

    let floors = Metric::ALL.map(|metric| reference.floor(metric));
    let rows = (0..colors.len()).map(|row| {
        let off = reference.deviations(&colors[row]);
        Row {
            name: std::mem::take(&mut rows.names[row]),
            times: std::mem::take(&mut times[row]),
            counters: counters[row],
            factor: rows.factors[row],
            errors: Metric::ALL.map(|metric| metric.estimate(&off)),
            verdict: Verdict::Front,
            resamples: options.metric.resampled(&off),
            colors: std::mem::take(&mut colors[row]),
        }
    });
    let mut report = Report {
        frame: options.frame,
        metric: options.metric,
        seed: options.seed,
        audited: list.len(),
        reference_samples: reference.samples(),
        floors,
        runs,
        rows: rows.collect(),
        knobs,
    };
    report.judge();
    Some(report)
}

/// The greatest [`Knob::least`] of the settings that can be tried: one picture of each must fit
/// into [`FOR_A_ROUND`] of the budget. `takes` is what the cheapest picture and the scene's own take.
fn dearest_that_fit(knobs: &[&Knob], own: &PlanOptions, takes: (f64, f64), budget: f64) -> f64 {
    let least = |knob: &&Knob| {
        let least = knob.least;
        knob.with((knob.get)(own)).into_iter().map(least).collect::<Vec<f64>>()
    };
    let mut all: Vec<f64> = knobs.iter().flat_map(least).collect();
    all.sort_by(f64::total_cmp);
    let mut left = FOR_A_ROUND * budget;
    let fits = |least: &f64| {
        left -= if *least > 1.0 { takes.0 * least } else { takes.1 };
        // What takes no longer than the scene's own picture is always tried.
        takes.0 * *least <= takes.1 || *least <= 1.0 || left > 0.0
    };
    all.into_iter().take_while(fits).last().unwrap_or(1.0)
}

/// Pictures to try.
#[derive(Default)]
struct Rows {
    names: Vec<String>,
    plans: Vec<Plan>,
    factors: Vec<f64>,
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
mod tests;
