//! Decides which settings are worth their cost: a partial order, and the verdict on each setting.
//!
//! **Invariant:** a setting is cheaper than another if its counted cost is less and its median run time is
//! shorter than the other's shortest (for a row with too few runs, by more than the spread of the other
//! rows); or if it is faster by more than the error of counted costs. So no verdict contradicts a column of
//! the table, and [`Order::dominates`] is a strict partial order by construction: a number, an interval
//! order and a product order over shared resamples are transitive, and so is their combination; and a
//! setting that is much faster than one that is not slower is itself much faster. Unproven differences are
//! never taken for equality: only identical work, or errors identical to the last bit, are equal.

use super::Span;
use super::statistics::Estimate;
use crate::trace::Counters;

/// Ratio of errors below which a difference is not worth paying for.
const WORTH: f64 = 1.01;
/// Ratio of run times above which a setting is slower whatever the counted costs; these are off by up to 9
/// % within a scene.
const SURELY: f64 = 1.15;

/// A setting, as used for ordering.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Counters, and the factor by which the settings change the cost of every ray; equal for settings
    /// that do the same work.
    pub work: (Counters, f64),
    /// Counted work in camera rays.
    pub cost: f64,
    /// CPU seconds; settings that do the same work share their runs.
    pub cpu: Span,
    /// Relative uncertainty of those: 0 with enough runs, otherwise the spread of the runs of other
    /// settings.
    pub doubt: f64,
    /// Measured error with its 95 % interval.
    pub error: Estimate,
    /// Errors of the resamples, which are shared by all points.
    pub resamples: Vec<f64>,
    /// Errors below this cannot be distinguished from 0. The same for all points.
    pub resolution: f64,
}

impl Point {
    /// Returns the bounds of each error: of the measured one, and of every resample, limited to the
    /// interval.
    fn bounds(&self) -> impl Iterator<Item = (f64, f64)> {
        let Estimate { value, low, high } = self.error;
        let inside = move |&resample: &f64| resample.max(low).min(high);
        std::iter::once(value).chain(self.resamples.iter().map(inside)).map(move |error| {
            let most = error.max(self.resolution);
            (if value >= self.resolution { most } else { 0.0 }, most)
        })
    }
}

impl Point {
    /// Returns the error to print: if it cannot be distinguished from 0, its upper bound.
    fn shown(&self) -> f64 {
        match self.error.value < self.resolution {
            true => self.error.high.max(self.resolution),
            false => self.error.value,
        }
    }

    /// Whether this point is faster than `than` by the clock, by the factor `times`.
    fn is_quicker(&self, than: &Self, times: f64) -> bool {
        // A clock too coarse to see a run says nothing of it.
        let surely = (1.0 + self.doubt) * (1.0 + than.doubt) * times;
        0.0 < self.cpu.min && surely * self.cpu.median < than.cpu.min
    }
}

/// Verdict on a setting. Time ratios are those of the median runs.
#[derive(Debug, Clone, Copy, PartialEq)]
// The fields are explained with their variants.
#[allow(missing_docs)]
pub enum Verdict {
    /// Every cheaper setting is proven to be worse.
    Front,
    /// Another setting is no more expensive and no worse, and better in one of these. This one takes
    /// `times` as long (`None` if both do the same work), and the other has `error` times its error.
    Dominated { by: usize, times: Option<f64>, error: f64 },
    /// A cheaper setting, or one that is faster by the clock alone and better, is not proven to be worse.
    Unproven { over: usize, times: f64 },
    /// Not distinguishable from another setting in cost or in error.
    Tied { with: usize },
}

/// Partial order of points by cost and error.
pub struct Order {
    points: Vec<Point>,
    /// Which point gains over which, so that the resamples of each pair are compared only once.
    gains: Vec<Vec<bool>>,
    dominates: Vec<Vec<bool>>,
}

impl Order {
    pub fn of(points: Vec<Point>) -> Self {
        let mut order = Self { points, gains: Vec::new(), dominates: Vec::new() };
        let all = || 0..order.points.len();
        let pairs = |is: &dyn Fn(usize, usize) -> bool| -> Vec<Vec<bool>> {
            all().map(|a| all().map(|b| is(a, b)).collect()).collect()
        };
        let gains = pairs(&|a, over| order.each_error(a, over, |a, over| a * WORTH < over));
        let dominates = pairs(&|a, b| {
            let cheaper = order.is_cheaper(a, b);
            (cheaper || order.is_same_work(a, b))
                && order.is_no_worse(a, b)
                && (cheaper || order.is_better(a, b))
        });
        (order.gains, order.dominates) = (gains, dominates);
        order
    }

    pub fn is_same_work(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.points[a], &self.points[b]);
        a.work == b.work && a.cost == b.cost && a.cpu == b.cpu && a.doubt == b.doubt
    }

    /// Whether `a` is cheaper than `b`, by counts and by the clock, or by the clock beyond doubt.
    pub fn is_cheaper(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.points[a], &self.points[b]);
        a.cost < b.cost && a.is_quicker(b, 1.0) || a.is_quicker(b, SURELY)
    }

    /// Whether `a` is cheaper than `b` by the clock alone.
    pub fn is_quicker(&self, a: usize, b: usize) -> bool {
        self.points[a].is_quicker(&self.points[b], 1.0)
    }

    /// Returns how many times as long as `a` `b` takes, if it is more expensive.
    pub fn times(&self, a: usize, b: usize) -> Option<f64> {
        self.is_cheaper(a, b).then(|| self.longer(a, b))
    }

    fn longer(&self, a: usize, b: usize) -> f64 {
        self.points[b].cpu.median / self.points[a].cpu.median
    }

    /// Whether `holds` is true for each error, given the upper bound of `a` and the lower bound of `b`.
    fn each_error(&self, a: usize, b: usize, holds: impl Fn(f64, f64) -> bool) -> bool {
        let pairs = self.points[a].bounds().zip(self.points[b].bounds());
        pairs.into_iter().all(|((_, most), (least, _))| holds(most, least))
    }

    fn has_same_errors(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.points[a], &self.points[b]);
        a.error == b.error && a.resamples == b.resamples
    }

    /// Whether the error of `a` is not larger in any resample.
    fn is_no_worse(&self, a: usize, b: usize) -> bool {
        self.has_same_errors(a, b) || self.each_error(a, b, |a, b| a <= b)
    }

    /// Whether the error of `a` is smaller in every resample, or the intervals are disjoint. With as many
    /// pairs as a report has, smaller errors in nearly all of a thousand resamples would occur by chance.
    fn is_better(&self, a: usize, b: usize) -> bool {
        self.each_error(a, b, |a, b| a < b)
    }

    /// Whether the error of `a` is proven to be smaller by more than a hundredth.
    pub fn gains(&self, a: usize, over: usize) -> bool {
        self.gains[a][over]
    }

    /// Whether `a` is no more expensive and no worse than `b`, and better in one of these.
    pub fn dominates(&self, a: usize, b: usize) -> bool {
        self.dominates[a][b]
    }

    /// Sorts the points of a list by counted cost; equal costs keep their order.
    pub fn by_cost(&self, list: &[usize]) -> Vec<usize> {
        let mut sorted = list.to_vec();
        sorted.sort_by(|&a, &b| self.points[a].cost.total_cmp(&self.points[b].cost));
        sorted
    }

    /// Returns a verdict for each point of a list, considering only this list.
    pub fn verdicts(&self, list: &[usize]) -> Vec<Verdict> {
        let sorted = self.by_cost(list);
        list.iter().map(|&i| self.verdict(i, &sorted)).collect()
    }

    fn verdict(&self, i: usize, sorted: &[usize]) -> Verdict {
        let undominated = |&&a: &&usize| !sorted.iter().any(|&b| self.dominates(b, a));
        let before = || sorted.iter().take_while(|&&other| other != i);
        let is_twin =
            |&&other: &&usize| self.is_same_work(other, i) && self.has_same_errors(other, i);
        if let Some(&with) = before().find(is_twin) {
            return Verdict::Tied { with };
        }
        let best = sorted.iter().filter(|&&other| self.dominates(other, i)).find(undominated);
        if let Some(&by) = best {
            let shown = |of: usize| self.points[of].shown();
            let error = if shown(i) > 0.0 { (shown(by) / shown(i)).min(1.0) } else { 1.0 };
            return Verdict::Dominated { by, times: self.times(by, i), error };
        }
        let mut rivals = sorted.iter().filter(|&&other| other != i && !self.gains(i, other));
        let cheaper = |&&other: &&usize| {
            self.is_cheaper(other, i) || self.is_quicker(other, i) && self.gains(other, i)
        };
        if let Some(&over) = rivals.clone().filter(cheaper).find(undominated) {
            return Verdict::Unproven { over, times: self.longer(over, i) };
        }
        let as_good = |&&other: &&usize| {
            !self.is_cheaper(i, other)
                && !self.is_cheaper(other, i)
                && !self.gains(other, i)
                && before().any(|&earlier| earlier == other)
        };
        match rivals.find(|other| as_good(other) && undominated(other)) {
            Some(&with) => Verdict::Tied { with },
            None => Verdict::Front,
        }
    }
}

#[cfg(test)]
mod tests;
