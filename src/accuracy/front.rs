//! Which settings are worth their cost: a partial order, and what it says of each.
//!
//! **Invariant:** [`Order::dominates`] is a strict partial order by construction: cost is ordered by
//! one number, within a stretch by runs that stand clear of each other, and error by the product order
//! over shared resamples; each is transitive, and so are they together. What is not proven is never
//! taken for equal: equal is only what was the same work, or the same error to the last bit.

use super::Span;
use crate::trace::Counters;

/// From so many runs on the clock is heard.
pub const ENOUGH_RUNS: usize = 5;
/// Less than this is no reason to pay more.
const WORTH: f64 = 1.01;

/// A setting as the order sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// What was counted, and the unit cost of the arithmetic: alike for settings that are the same work.
    pub work: (Counters, f64),
    /// The counted work in rays of the camera.
    pub cost: f64,
    /// CPU seconds of each run.
    pub cpu: Vec<f64>,
    /// The error as measured, then that of the resamples, which all points share.
    pub errors: Vec<f64>,
    /// Whatever is below cannot be told from nothing: of an error measured there, all that is known is
    /// that it lies between. The same for all points.
    pub resolution: f64,
}

impl Point {
    /// Where each of its errors lies.
    fn bounds(&self) -> impl Iterator<Item = (f64, f64)> {
        let resolved = self.errors.first().is_some_and(|&error| error >= self.resolution);
        self.errors.iter().map(move |error| {
            let most = error.max(self.resolution);
            (if resolved { most } else { 0.0 }, most)
        })
    }
}

/// How many times as dear something is, and who says so.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Saving {
    /// The counters, times unit costs.
    Work(f64),
    /// Runs that stand clear of each other.
    Time(f64),
}

/// What is to be said of a setting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// Every cheaper setting is proven to be worse.
    Front,
    /// Another is no dearer and no worse, and one of both it is better: this one costs `saving`
    /// times as much (nothing where both cost the same), and that one has `error` times the error.
    Dominated { by: usize, saving: Option<Saving>, error: f64 },
    /// A cheaper one is not proven to be worse.
    Unproven { over: usize, saving: Saving },
    /// Neither in cost nor in error can it be told from this one.
    Tied { with: usize },
}

/// Points in order of cost and of error.
pub struct Order {
    points: Vec<Point>,
    /// Of each point: whatever lies in an earlier stretch is cheaper. Inside one the clock decides,
    /// if it can.
    stretches: Vec<usize>,
    /// The least CPU seconds of all runs that were the same work.
    seconds: Vec<f64>,
    /// Seconds further apart than this factor are; infinite before there are enough runs.
    clear: f64,
}

impl Order {
    pub fn of(points: Vec<Point>) -> Self {
        let pooled = |point: &Point| {
            let same = points.iter().filter(|other| other.work == point.work);
            Span::of(&same.flat_map(|other| other.cpu.iter().copied()).collect::<Vec<_>>())
        };
        let spans: Vec<Span> = points.iter().map(pooled).collect();
        let heard = points.iter().all(|point| point.cpu.len() >= ENOUGH_RUNS);
        let spread = |span: &Span| span.median / span.min;
        let clear = match heard && spans.iter().all(|span| span.min > 0.0) {
            true => spans.iter().map(spread).fold(1.0, f64::max),
            false => f64::INFINITY,
        };
        let seconds = spans.iter().map(|span| span.min).collect();
        let mut order = Self { stretches: vec![0; points.len()], points, seconds, clear };
        order.part();
        order
    }

    /// Counted work orders the points; from the first to the last of those that the clock proves
    /// to be the other way round, they are one stretch.
    fn part(&mut self) {
        let mut by_cost: Vec<usize> = (0..self.points.len()).collect();
        by_cost.sort_by(|&a, &b| self.points[a].cost.total_cmp(&self.points[b].cost));
        let (mut reach, mut stretch) = (0, 0);
        for (place, &i) in by_cost.iter().enumerate() {
            let before = place.checked_sub(1).map(|before| self.points[by_cost[before]].cost);
            if place > reach && before.is_some_and(|before| before < self.points[i].cost) {
                stretch += 1;
            }
            let contradicts = by_cost.iter().rposition(|&other| self.runs_faster(other, i));
            reach = reach.max(place).max(contradicts.unwrap_or(0));
            self.stretches[i] = stretch;
        }
    }

    fn runs_faster(&self, a: usize, b: usize) -> bool {
        self.seconds[a] * self.clear < self.seconds[b]
    }

    pub fn is_same_work(&self, a: usize, b: usize) -> bool {
        self.points[a].work == self.points[b].work
    }

    pub fn is_cheaper(&self, a: usize, b: usize) -> bool {
        let (of_a, of_b) = (self.stretches[a], self.stretches[b]);
        of_a < of_b || (of_a == of_b && self.runs_faster(a, b))
    }

    /// How many times as dear as `a`, if it is dearer, `b` is.
    pub fn saving(&self, a: usize, b: usize) -> Option<Saving> {
        let work = Saving::Work(self.points[b].cost / self.points[a].cost);
        let time = Saving::Time(self.seconds[b] / self.seconds[a]);
        self.is_cheaper(a, b).then_some(if self.runs_faster(a, b) { time } else { work })
    }

    /// Of each error the most that the one's can be, against the least that the other's can be.
    fn each_error(&self, a: usize, b: usize, holds: impl Fn(f64, f64) -> bool) -> bool {
        let pairs = self.points[a].bounds().zip(self.points[b].bounds());
        pairs.into_iter().all(|((_, most), (least, _))| holds(most, least))
    }

    fn has_same_errors(&self, a: usize, b: usize) -> bool {
        self.points[a].errors == self.points[b].errors
    }

    /// In no resample is its error the larger.
    fn is_no_worse(&self, a: usize, b: usize) -> bool {
        self.has_same_errors(a, b) || self.each_error(a, b, |a, b| a <= b)
    }

    /// In every resample its error is the smaller: among as many pairs as a report has, less than all
    /// of a thousand would be seen by chance.
    fn is_better(&self, a: usize, b: usize) -> bool {
        self.each_error(a, b, |a, b| a < b)
    }

    /// Its error is proven to be the smaller by more than a hundredth.
    pub fn gains(&self, a: usize, over: usize) -> bool {
        self.each_error(a, over, |a, over| a * WORTH < over)
    }

    /// No dearer, no worse, and one of both it is better.
    pub fn dominates(&self, a: usize, b: usize) -> bool {
        let cheaper = self.is_cheaper(a, b);
        (cheaper || self.is_same_work(a, b))
            && self.is_no_worse(a, b)
            && (cheaper || self.is_better(a, b))
    }

    /// The points of a list from cheap to dear; of what cannot be told apart, by counted cost, or as
    /// it came.
    pub fn from_cheap_to_dear(&self, list: &[usize]) -> Vec<usize> {
        let (mut left, mut sorted) = (list.to_vec(), Vec::with_capacity(list.len()));
        left.sort_by(|&a, &b| self.points[a].cost.total_cmp(&self.points[b].cost));
        while !left.is_empty() {
            let is_next = |&i: &usize| !left.iter().any(|&other| self.is_cheaper(other, i));
            let next = left.iter().position(is_next).unwrap_or(0);
            sorted.push(left.remove(next));
        }
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
            let shown = |of: usize| self.points[of].errors[0].max(self.points[of].resolution);
            let error = if shown(i) > 0.0 { shown(by) / shown(i) } else { 1.0 };
            return Verdict::Dominated { by, saving: self.saving(by, i), error };
        }
        let mut rivals = sorted.iter().filter(|&&other| other != i && !self.gains(i, other));
        let cheaper = |&&other: &&usize| self.is_cheaper(other, i);
        if let Some(&over) = rivals.clone().filter(cheaper).find(undominated)
            && let Some(saving) = self.saving(over, i)
        {
            return Verdict::Unproven { over, saving };
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
mod tests {
    use super::*;
    use crate::math::random::{Random, long};

    /// As much work as `cost` says.
    fn point(cost: f64, cpu: &[f64], error: f64) -> Point {
        let counters = Counters { camera: (cost * 1e6) as u64, ..Counters::default() };
        Point {
            work: (counters, 1.0),
            cost,
            cpu: cpu.to_vec(),
            errors: vec![error; 5],
            resolution: 0.0,
        }
    }

    /// Points of sure errors, by one run each.
    fn verdicts(of: &[(f64, f64)]) -> Vec<Verdict> {
        let points = of.iter().map(|&(cost, error)| point(cost, &[cost], error)).collect();
        Order::of(points).verdicts(&(0..of.len()).collect::<Vec<_>>())
    }

    /// Anything: twins, near misses, clocks that contradict the counters, errors that cross.
    fn anything(random: &mut Random) -> Order {
        let count = 2 + random.below(7);
        let runs = [1, 3, ENOUGH_RUNS, 9][random.below(4)];
        let noise = [0.0, 0.02, 0.3][random.below(3)];
        let resolution = [0.0, 0.0, 0.15][random.below(3)];
        let mut points: Vec<Point> = Vec::new();
        for _ in 0..count {
            let cost = [1.0, 1.0, 1.02, 1.1, 1.5, 2.0][random.below(6)];
            let truth = cost * [1.0, 1.0, 0.7, 1.4][random.below(4)];
            let run = |_| truth * (1.0 + random.number(0.0, noise));
            let cpu: Vec<f64> = (0..runs).map(run).collect();
            let error = [0.1, 0.1, 0.1005, 0.2, 0.3][random.below(5)];
            let spread = [0.0, 0.0, 0.01, 0.15][random.below(4)];
            let draw = |_| error + random.number(0.0, spread);
            let mut new = point(cost, &cpu, error);
            new.errors = (0..4).map(draw).collect();
            new.resolution = resolution;
            if random.below(3) == 0 {
                new.work.0.shadow = random.below(2) as u64;
            }
            points.push(new);
        }
        Order::of(points)
    }

    #[test]
    fn domination_is_irreflexive_antisymmetric_and_transitive() {
        let mut random = Random(11);
        let (mut pairs, mut chains) = (0, 0);
        for _ in 0..3000 * long() {
            let order = anything(&mut random);
            let all = 0..order.points.len();
            for a in all.clone() {
                assert!(!order.dominates(a, a) && !order.is_cheaper(a, a) && !order.gains(a, a));
                for b in all.clone() {
                    assert!(!order.dominates(a, b) || !order.dominates(b, a));
                    assert!(!order.is_cheaper(a, b) || !order.is_cheaper(b, a));
                    pairs += usize::from(order.dominates(a, b));
                    for c in all.clone() {
                        let follows = |is: &dyn Fn(usize, usize) -> bool| {
                            assert!(!is(a, b) || !is(b, c) || is(a, c), "{:?}", order.points);
                        };
                        follows(&|a, b| order.dominates(a, b));
                        follows(&|a, b| order.is_cheaper(a, b));
                        follows(&|a, b| order.is_cheaper(a, b) || order.is_same_work(a, b));
                        follows(&|a, b| order.gains(a, b));
                        chains += usize::from(order.dominates(a, b) && order.dominates(b, c));
                    }
                }
            }
        }
        assert!(pairs > 5000 && chains > 1000, "{pairs} {chains}");
    }

    #[test]
    fn a_verdict_claims_nothing_that_the_numbers_do_not_show() {
        let mut random = Random(12);
        let mut seen = [0; 4];
        for _ in 0..3000 * long() {
            let order = anything(&mut random);
            let all: Vec<usize> = (0..order.points.len()).collect();
            let verdicts = order.verdicts(&all);
            for (i, verdict) in verdicts.iter().enumerate() {
                let errors = |of: usize| &order.points[of].errors;
                let no_dearer = |a: usize| order.is_cheaper(a, i) || order.is_same_work(a, i);
                let place = match *verdict {
                    Verdict::Front => {
                        let cheaper = all.iter().filter(|&&other| order.is_cheaper(other, i));
                        assert!(cheaper.clone().all(|&other| order.gains(i, other)));
                        0
                    }
                    Verdict::Dominated { by, saving, error } => {
                        assert!(no_dearer(by) && error <= 1.0);
                        let floor = order.points[i].resolution;
                        let most = |of: usize| errors(of).iter().map(|error| error.max(floor));
                        assert!(most(by).zip(most(i)).all(|(a, b)| a <= b));
                        // Two that are not resolved are not compared.
                        assert!(errors(i)[0] >= floor || errors(i) == errors(by));
                        assert!(!matches!(verdicts[by], Verdict::Dominated { .. }));
                        assert_eq!(saving.is_none(), order.is_same_work(by, i));
                        1
                    }
                    Verdict::Unproven { over, saving } => {
                        assert!(order.is_cheaper(over, i) && !order.gains(i, over));
                        assert!(matches!(saving, Saving::Work(r) | Saving::Time(r) if r > 1.0));
                        2
                    }
                    Verdict::Tied { with } => {
                        assert!(!order.is_cheaper(with, i) && !order.is_cheaper(i, with));
                        assert!(!order.gains(with, i) && !order.gains(i, with) && with != i);
                        3
                    }
                };
                seen[place] += 1;
            }
        }
        assert!(seen.iter().all(|&times| times > 200), "{seen:?}");
    }

    #[test]
    fn the_front_goes_down_as_cost_goes_up() {
        let verdicts = verdicts(&[(1.0, 0.5), (4.0, 0.1), (2.0, 0.2), (8.0, 0.2)]);
        assert_eq!(verdicts[..3], [Verdict::Front; 3]);
        // Of those that dominate it, the cheapest.
        let saving = Some(Saving::Work(4.0));
        assert_eq!(verdicts[3], Verdict::Dominated { by: 2, saving, error: 1.0 });
    }

    #[test]
    fn the_same_work_is_tied_whatever_the_clock_says_of_it() {
        let mut points = vec![point(1.0, &[3.0; 9], 0.5), point(1.0, &[1.0; 9], 0.5)];
        let tied = [Verdict::Front, Verdict::Tied { with: 0 }];
        assert_eq!(Order::of(points.clone()).verdicts(&[0, 1]), tied);
        // As much work, but for less error.
        points[1].errors = vec![0.4; 5];
        let saving = None;
        let dominated = Verdict::Dominated { by: 1, saving, error: 0.8 };
        assert_eq!(Order::of(points).verdicts(&[0, 1]), [dominated, Verdict::Front]);
    }

    #[test]
    fn few_runs_prove_nothing_against_the_counters_and_many_do_where_they_are_clear() {
        let cheaper = |runs: usize, noise: f64| {
            let run = |seconds: f64, i: usize| seconds * (1.0 + noise * (i % 2) as f64);
            let cpu = |seconds| (0..runs).map(|i| run(seconds, i)).collect::<Vec<_>>();
            // Counted in the order 0 1 2 3, timed in the order 2 0 1 3.
            let points = [(1.0, 1.2), (2.0, 1.3), (3.0, 1.0), (4.0, 4.0)];
            let points = points.map(|(cost, seconds)| point(cost, &cpu(seconds), 0.5));
            let order = Order::of(points.to_vec());
            let verdicts = order.verdicts(&[0, 1, 2, 3]);
            assert_eq!(verdicts.iter().filter(|&&v| v == Verdict::Front).count(), 1);
            (order.from_cheap_to_dear(&[0, 1, 2, 3]), verdicts[1])
        };
        let by = |by, saving| Verdict::Dominated { by, saving: Some(saving), error: 1.0 };
        assert_eq!(cheaper(ENOUGH_RUNS - 1, 0.0), (vec![0, 1, 2, 3], by(0, Saving::Work(2.0))));
        assert_eq!(cheaper(ENOUGH_RUNS, 0.0), (vec![2, 0, 1, 3], by(2, Saving::Time(1.3))));
        // Runs differ by more than what they would prove.
        assert_eq!(cheaper(8, 0.8), (vec![0, 1, 2, 3], by(0, Saving::Work(2.0))));
    }

    #[test]
    fn a_gain_that_is_not_proven_is_not_on_the_front_and_no_proof_against_it() {
        let mut points = vec![point(1.0, &[1.0], 0.5), point(2.0, &[2.0], 0.45)];
        // Of the resamples one is worse.
        points[1].errors = vec![0.45, 0.44, 0.51, 0.45, 0.46];
        let saving = Saving::Work(2.0);
        let unproven = Verdict::Unproven { over: 0, saving };
        assert_eq!(Order::of(points.clone()).verdicts(&[0, 1]), [Verdict::Front, unproven]);
        // A gain below a hundredth is none.
        points[1].errors = vec![0.498; 5];
        assert_eq!(Order::of(points.clone()).verdicts(&[0, 1])[1], unproven);
        points[1].errors = vec![0.55, 0.5, 0.6, 0.52, 0.5];
        let Verdict::Dominated { by: 0, .. } = Order::of(points).verdicts(&[0, 1])[1] else {
            panic!("no gain at all for twice the work")
        };
    }

    #[test]
    fn of_two_errors_below_the_floor_nothing_is_said() {
        let points = [(1.0, 0.5), (2.0, 0.02), (4.0, 0.01), (8.0, 0.06), (16.0, 0.01)];
        let mut points = points.map(|(cost, error)| point(cost, &[cost], error));
        points.iter_mut().for_each(|point| point.resolution = 0.05);
        // As much work as the one before, and the same picture.
        points[4] = points[2].clone();
        let verdicts = Order::of(points.to_vec()).verdicts(&[0, 1, 2, 3, 4]);
        assert_eq!(verdicts[..2], [Verdict::Front; 2]);
        assert_eq!(verdicts[2], Verdict::Unproven { over: 1, saving: Saving::Work(2.0) });
        assert!(matches!(verdicts[3], Verdict::Dominated { by: 1, .. }), "{verdicts:?}");
        assert_eq!(verdicts[4], Verdict::Tied { with: 2 });
    }
}
