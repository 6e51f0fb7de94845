//! Which settings are worth their cost: a partial order, and what it says of each.
//!
//! **Invariant:** one setting is cheaper than another when its counted cost is less and, in the seconds,
//! its middle run is shorter than the other's shortest (of a row with too few runs, by more than those of
//! others lie apart); or when it is shorter by more than counted costs are off. So no verdict goes against a column that the
//! reader sees, and [`Order::dominates`] is a strict partial order by construction: a number, an interval
//! order and a product order over shared resamples are transitive, and so are they together; and what is
//! shorter by much than what is not longer is shorter by much. What is
//! not proven is never taken for equal: equal is only what was the same work, or the same error to the
//! last bit.

use super::Span;
use super::statistics::Estimate;
use crate::trace::Counters;

/// Less than this is no reason to pay more.
const WORTH: f64 = 1.01;
/// Of two settings, how much longer the dearer takes where counted costs may be wrong and the clock is not:
/// those are off by up to 9 % within a scene.
const SURELY: f64 = 1.15;

/// A setting as the order sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// What was counted, and the unit cost of the arithmetic: alike for settings that are the same work.
    pub work: (Counters, f64),
    /// The counted work in rays of the camera.
    pub cost: f64,
    /// CPU seconds; those that are the same work share their runs.
    pub cpu: Span,
    /// How far those may be off, as a part of them: nothing where there are runs enough, elsewhere as far
    /// as the runs of others lie apart.
    pub doubt: f64,
    /// The error as measured, with its 95 % interval.
    pub error: Estimate,
    /// That of the resamples, which all points share.
    pub resamples: Vec<f64>,
    /// Whatever is below cannot be told from nothing: of an error measured there, all that is known is
    /// that it lies between. The same for all points.
    pub resolution: f64,
}

impl Point {
    /// Where each of its errors lies: of the one measured, and of every resample, which counts no
    /// further than the interval goes.
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
    /// The error that is printed: where it cannot be told from nothing, the most that it can be.
    fn shown(&self) -> f64 {
        match self.error.value < self.resolution {
            true => self.error.high.max(self.resolution),
            false => self.error.value,
        }
    }

    /// By the clock, so many times: what is surely longer than the other takes less than this.
    fn is_quicker(&self, than: &Self, times: f64) -> bool {
        // A clock too coarse to see a run says nothing of it.
        let surely = (1.0 + self.doubt) * (1.0 + than.doubt) * times;
        0.0 < self.cpu.min && surely * self.cpu.median < than.cpu.min
    }
}

/// What is to be said of a setting; how many times as long as another it takes is of the middle runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// Every cheaper setting is proven to be worse.
    Front,
    /// Another is no dearer and no worse, and one of both it is better: this one takes `times` as
    /// long (nothing where both are the same work), and that one has `error` times the error.
    Dominated { by: usize, times: Option<f64>, error: f64 },
    /// A cheaper one, or one that is quicker by the clock alone and better, is not proven to be worse.
    Unproven { over: usize, times: f64 },
    /// Neither in cost nor in error can it be told from this one.
    Tied { with: usize },
}

/// Points in order of cost and of error.
pub struct Order {
    points: Vec<Point>,
    /// Which point gains over which: each resample of each pair is looked at once.
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

    /// By what was counted, and by the clock; or by the clock beyond doubt.
    pub fn is_cheaper(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.points[a], &self.points[b]);
        a.cost < b.cost && a.is_quicker(b, 1.0) || a.is_quicker(b, SURELY)
    }

    /// By the clock alone.
    pub fn is_quicker(&self, a: usize, b: usize) -> bool {
        self.points[a].is_quicker(&self.points[b], 1.0)
    }

    /// How many times as long as `a`, if it is dearer, `b` takes.
    pub fn times(&self, a: usize, b: usize) -> Option<f64> {
        self.is_cheaper(a, b).then(|| self.longer(a, b))
    }

    fn longer(&self, a: usize, b: usize) -> f64 {
        self.points[b].cpu.median / self.points[a].cpu.median
    }

    /// Of each error the most that the one's can be, against the least that the other's can be.
    fn each_error(&self, a: usize, b: usize, holds: impl Fn(f64, f64) -> bool) -> bool {
        let pairs = self.points[a].bounds().zip(self.points[b].bounds());
        pairs.into_iter().all(|((_, most), (least, _))| holds(most, least))
    }

    fn has_same_errors(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.points[a], &self.points[b]);
        a.error == b.error && a.resamples == b.resamples
    }

    /// In no resample is its error the larger.
    fn is_no_worse(&self, a: usize, b: usize) -> bool {
        self.has_same_errors(a, b) || self.each_error(a, b, |a, b| a <= b)
    }

    /// In every resample its error is the smaller: among as many pairs as a report has, less than all
    /// of a thousand would be seen by chance. Always where the intervals have nothing in common.
    fn is_better(&self, a: usize, b: usize) -> bool {
        self.each_error(a, b, |a, b| a < b)
    }

    /// Its error is proven to be the smaller by more than a hundredth.
    pub fn gains(&self, a: usize, over: usize) -> bool {
        self.gains[a][over]
    }

    /// No dearer, no worse, and one of both it is better.
    pub fn dominates(&self, a: usize, b: usize) -> bool {
        self.dominates[a][b]
    }

    /// The points of a list by counted cost; of the same cost, as they came.
    pub fn from_cheap_to_dear(&self, list: &[usize]) -> Vec<usize> {
        let mut sorted = list.to_vec();
        sorted.sort_by(|&a, &b| self.points[a].cost.total_cmp(&self.points[b].cost));
        sorted
    }

    /// A verdict for each point of a list, among these alone.
    pub fn verdicts(&self, list: &[usize]) -> Vec<Verdict> {
        let sorted = self.from_cheap_to_dear(list);
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
