//! The report: what each setting of each knob costs and buys, and what is to be said of it.
//!
//! **Out:** rows, and the lines of each knob that point to them. **Invariant:** the first row is the picture
//! as `render` makes it; verdicts and sentences follow from the numbers alone.

use super::front::Point;
use super::statistics::{Estimate, Metric};
use super::{Order, Span, Times, Verdict, knob, sentence};
use crate::plan::{Frame, Region};
use crate::trace::Counters;

/// How far runs may lie apart, of the shortest, where no row has enough to tell.
const UNKNOWN: f64 = 1.0;
/// Seconds of tracing below which it is not told whether the machine was busy.
const LEAST_TO_TELL: f64 = 0.5;

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
    pub(super) fn judge(&mut self) {
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
