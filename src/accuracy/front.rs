//! Which settings are worth their time: the proven front.
//!
//! **Invariant:** an order is claimed only where it is proven: of times, beyond what runs of the same
//! picture differ by; of errors, by the interval of their difference on the same pixels.

use super::statistics::{difference, interval};

/// A setting as the front sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The least CPU seconds.
    pub time: f64,
    /// Times closer than this are one.
    pub spread: f64,
    /// Not below what the reference can resolve.
    pub error: f64,
    /// [`super::Metric::resampled`] of the same pixels for all points; none when below the floor.
    pub resamples: Vec<f64>,
}

/// What is to be said of a setting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// Every faster setting is proven to be worse.
    Front,
    /// Another is as good and proven faster, or as fast and proven better: `time` times as fast,
    /// and of `error` times the error.
    Dominated { by: usize, time: f64, error: f64 },
    /// Neither: it cannot be told from this one.
    Tied { with: usize },
}

impl Point {
    fn is_faster(&self, other: &Self) -> bool {
        self.time + self.spread.max(other.spread) < other.time
    }

    /// Its error is proven to be the smaller, by more than a hundredth: less is no reason to wait.
    fn is_better(&self, other: &Self) -> bool {
        let margin = other.error / 100.0;
        match (self.resamples.is_empty(), other.resamples.is_empty()) {
            (_, true) => false,
            // What cannot be resolved is at most what can be.
            (true, false) => interval(&other.resamples).0 > self.error + margin,
            (false, false) => difference(&other.resamples, &self.resamples).0 > margin,
        }
    }

    fn dominates(&self, other: &Self) -> bool {
        let faster = self.is_faster(other) && self.error <= other.error && !other.is_better(self);
        faster || (!other.is_faster(self) && self.is_better(other))
    }
}

/// A verdict for each point.
pub fn verdicts(points: &[Point]) -> Vec<Verdict> {
    // By time; those that cannot be told apart by it stay as they came, from cheap to dear.
    let mut order: Vec<usize> = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        let slower = order.iter().position(|&other| point.is_faster(&points[other]));
        order.insert(slower.unwrap_or(order.len()), i);
    }
    let mut verdicts = vec![Verdict::Front; points.len()];
    for (place, &i) in order.iter().enumerate() {
        let point = &points[i];
        let rivals = order.iter().filter(|&&other| other != i);
        // The fastest of those that dominate it.
        if let Some(&by) = rivals.clone().find(|&&other| points[other].dominates(point)) {
            let ratio = |a: f64, b: f64| if b > 0.0 { a / b } else { 1.0 };
            let time = ratio(point.time, points[by].time);
            verdicts[i] =
                Verdict::Dominated { by, time, error: ratio(points[by].error, point.error) };
            continue;
        }
        let mut before = order[..place].iter().rev();
        let unbeaten = |&&other: &&usize| {
            verdicts[other] == Verdict::Front && !point.is_better(&points[other])
        };
        if let Some(&with) = before.find(unbeaten) {
            verdicts[i] = Verdict::Tied { with };
        }
    }
    verdicts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of sure errors.
    fn points(of: &[(f64, f64)]) -> Vec<Point> {
        let point =
            |&(time, error)| Point { time, spread: 0.1, error, resamples: vec![error; 100] };
        of.iter().map(point).collect()
    }

    #[test]
    fn the_front_goes_down_as_time_goes_up() {
        let verdicts = verdicts(&points(&[(1.0, 0.5), (4.0, 0.1), (2.0, 0.2), (8.0, 0.2)]));
        assert_eq!(verdicts[..3], [Verdict::Front; 3]);
        assert_eq!(verdicts[3], Verdict::Dominated { by: 2, time: 4.0, error: 1.0 });
    }

    #[test]
    fn equals_are_tied_and_the_first_stands_for_them() {
        let verdicts = verdicts(&points(&[(1.0, 0.5), (1.02, 0.5), (1.05, 0.5)]));
        assert_eq!(
            verdicts,
            [Verdict::Front, Verdict::Tied { with: 0 }, Verdict::Tied { with: 0 }]
        );
    }

    #[test]
    fn what_is_as_fast_and_better_dominates() {
        let verdicts = verdicts(&points(&[(1.0, 0.5), (1.05, 0.25)]));
        assert_eq!(verdicts[1], Verdict::Front);
        let Verdict::Dominated { by: 1, time, error } = verdicts[0] else { panic!("{verdicts:?}") };
        assert!((time - 1.0 / 1.05).abs() < 1e-12 && error == 0.5);
    }

    #[test]
    fn a_gain_that_is_not_proven_is_a_tie() {
        let mut points = points(&[(1.0, 0.5), (2.0, 0.45)]);
        // The difference is −0.05 … 0.15.
        points[1].resamples = (0..100).map(|i| 0.35 + 0.002 * f64::from(i)).collect();
        assert_eq!(verdicts(&points)[1], Verdict::Tied { with: 0 });
        points[1].error = 0.55;
        let Verdict::Dominated { by: 0, time: 2.0, .. } = verdicts(&points)[1] else {
            panic!("no gain at all for twice the time")
        };
    }

    #[test]
    fn below_the_floor_nothing_is_ranked_by_error() {
        let mut points = points(&[(1.0, 0.5), (2.0, 0.01), (4.0, 0.01)]);
        points[1].resamples.clear();
        points[2].resamples.clear();
        let verdicts = verdicts(&points);
        assert_eq!(verdicts[1], Verdict::Front);
        assert_eq!(verdicts[2], Verdict::Dominated { by: 1, time: 2.0, error: 1.0 });
    }
}
