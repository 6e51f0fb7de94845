//! Report on the cost and the accuracy of each setting of each knob, with verdicts.
//!
//! **Out:** rows, and the lines of each knob that refer to them. **Invariant:** the first row is the
//! picture as `render` makes it; verdicts and sentences follow from the numbers alone.

use super::front::Point;
use super::statistics::{Estimate, Metric};
use super::{Order, Span, Times, Verdict, knob, sentence};
use crate::plan::{Frame, Region};
use crate::trace::Counters;

/// Assumed spread of runs, relative to the shortest, if no row has enough of them.
const UNKNOWN: f64 = 1.0;
/// Minimum tracing time in seconds for judging whether the machine was busy.
const LEAST_TO_TELL: f64 = 0.5;

/// Measured costs and accuracies of the settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The picture.
    pub frame: Frame,
    /// How errors are measured.
    pub metric: Metric,
    /// As [`Options::seed`](super::Options::seed).
    pub seed: u64,
    /// Number of pixels on which errors were measured.
    pub audited: usize,
    /// What was reduced to keep the budget.
    pub cut: Cut,
    /// Samples of each audited pixel.
    pub reference_samples: u32,
    /// The reference's own error, in each of [`Metric::ALL`].
    pub floors: [f64; 3],
    /// The knobs with an effect.
    pub knobs: Vec<Tried>,
    /// Sentences for the caller to print on knobs without effect.
    pub idle: Vec<String>,
    /// The first row is the picture as `render` makes it.
    pub rows: Vec<Row>,
}

/// What was reduced to keep the budget, apart from settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cut {
    /// Intended number of audited pixels, if it was reduced.
    pub pixels: Option<usize>,
    /// Samples of the reference per pixel, if reduced.
    pub samples: Option<u32>,
    /// Actual and intended depth of the reference, if reduced.
    pub depth: Option<(u32, u32)>,
}

/// A knob and the results of its settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    /// Name of the knob.
    pub name: &'static str,
    /// Coarsest and finest setting.
    pub ends: [String; 2],
    /// From cheap to expensive. Settings that do the same work at every audited pixel share a row.
    pub settings: Vec<Setting>,
    /// Settings that change no audited pixel and were not timed.
    pub vain: Vec<String>,
    /// Settings that did not fit into the budget.
    pub left_out: Vec<String>,
    /// Summary of the knob's effect, or that it has none.
    pub sentence: String,
}

/// Settings that share a row.
pub struct Line<'a> {
    /// `5`, or the coarsest and the finest of several: `10 … 250`.
    pub label: String,
    /// Whether one of them is the scene's own.
    pub is_own: bool,
    /// The cheapest of them.
    pub first: &'a Setting,
}

impl Tried {
    /// Returns lines from cheap to expensive; settings that share a row are one line.
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

/// A setting of a knob.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Name of the setting: `4×4`.
    pub label: String,
    /// Flag of `render` that selects it.
    pub flag: String,
    /// Whether it is the scene's own setting, or the default of `render`.
    pub is_own: bool,
    /// Index of its row.
    pub row: usize,
    /// Verdict among the settings of its knob.
    pub verdict: Verdict,
}

/// One picture, with all settings but one as in the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// `depth 3`; `*` for the first.
    pub name: String,
    /// Shared by all rows that do the same work: their runs count for each.
    pub times: Times,
    /// Counters of the entire picture.
    pub counters: Counters,
    /// Factor by which this row's settings change the cost of every ray.
    pub factor: f64,
    /// In each of [`Metric::ALL`].
    pub errors: [Estimate; 3],
    /// Verdict among all rows.
    pub verdict: Verdict,
    /// Colors of the audited pixels, linear and clamped.
    pub colors: Vec<[f64; 3]>,
    /// Errors of the resamples, in the requested metric.
    pub resamples: Vec<f64>,
}

impl Report {
    /// Returns the error as shown.
    pub fn error(&self, row: usize) -> Estimate {
        self.shown(self.metric, row)
    }

    /// Returns the error as far as it is known. Below the resolution of the reference, only an upper bound
    /// is: that resolution, or the end of its own interval if greater.
    pub fn shown(&self, metric: Metric, row: usize) -> Estimate {
        let (error, resolution) = (self.rows[row].errors[metric as usize], self.resolution(metric));
        match error.value < resolution {
            true => Estimate { value: resolution, low: 0.0, high: error.high.max(resolution) },
            false => error,
        }
    }

    /// Returns the bound below which errors cannot be distinguished from the reference's own.
    pub fn resolution(&self, metric: Metric) -> f64 {
        4.0 * self.floors[metric as usize]
    }

    /// Whether the error of a row can be distinguished from the reference's own.
    pub(crate) fn is_resolved(&self, metric: Metric, row: usize) -> bool {
        self.rows[row].errors[metric as usize].value >= self.resolution(metric)
    }

    /// Returns the counted cost of a row.
    pub fn cost(&self, row: usize) -> f64 {
        self.rows[row].factor * knob::cost(&self.rows[row].counters)
    }

    /// Returns the minimum and maximum number of runs per row.
    pub fn runs(&self) -> (usize, usize) {
        let runs = || self.rows.iter().map(|row| row.times.cpu.len());
        (runs().min().unwrap_or(0), runs().max().unwrap_or(0))
    }

    /// Returns the fraction of its threads' time that tracing had, over all runs: much less than 1 on a
    /// busy machine, and 1 if runs are too short to tell.
    pub(crate) fn share_of_time(&self, threads: usize) -> f64 {
        let total = |of: fn(&Times) -> &[f64]| -> f64 {
            self.rows.iter().flat_map(|row| of(&row.times)).sum()
        };
        let (cpu, wall) = (total(|times| &times.cpu), total(|times| &times.wall));
        let whole = wall * threads.max(1) as f64;
        if wall >= LEAST_TO_TELL { (cpu / whole).min(1.0) } else { 1.0 }
    }

    /// Returns the flag that produces a row's picture; `None` for the scene's own settings.
    pub fn flag(&self, row: usize) -> Option<&str> {
        let mut settings = self.knobs.iter().flat_map(|knob| &knob.settings);
        settings.find(|setting| setting.row == row && row > 0).map(|setting| setting.flag.as_str())
    }

    /// Sorts the settings and computes their verdicts.
    pub(super) fn judge(&mut self) {
        let order = self.order();
        let all: Vec<usize> = (0..self.rows.len()).collect();
        for (row, verdict) in self.rows.iter_mut().zip(order.verdicts(&all)) {
            row.verdict = verdict;
        }
        for tried in &mut self.knobs {
            // Rows of equal cost keep their order here, too, so that no two refer to each other.
            let mut rows: Vec<usize> = tried.settings.iter().map(|setting| setting.row).collect();
            rows.sort_unstable();
            rows.dedup();
            let verdicts = order.verdicts(&rows);
            let sorted = order.by_cost(&rows);
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

    /// Returns the partial order of the rows.
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

    /// Converts a count for the entire picture to one per pixel.
    pub fn a_pixel(&self, count: f64) -> f64 {
        let Region { width, height, .. } = self.frame.region;
        count / (f64::from(width) * f64::from(height))
    }
}
