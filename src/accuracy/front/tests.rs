//! The order, held against what it says of itself.

use super::*;
use crate::math::random::{Random, long};

/// As much work as `cost` says, and an error that is sure.
fn point(cost: f64, cpu: &[f64], error: f64) -> Point {
    let counters = Counters { camera: (cost * 1e6) as u64, ..Counters::default() };
    let sure = Estimate { value: error, low: error, high: error };
    Point {
        work: (counters, 1.0),
        cost,
        cpu: Span::of(cpu),
        doubt: 0.0,
        error: sure,
        resamples: vec![error; 4],
        resolution: 0.0,
    }
}

/// The same, of an error that is not.
fn unsure(cost: f64, (low, value, high): (f64, f64, f64), resamples: [f64; 4]) -> Point {
    let error = Estimate { value, low, high };
    Point { error, resamples: resamples.to_vec(), ..point(cost, &[cost], value) }
}

fn verdicts(points: &[Point]) -> Vec<Verdict> {
    Order::of(points.to_vec()).verdicts(&(0..points.len()).collect::<Vec<_>>())
}

/// Anything: twins, near misses, clocks that contradict the counters, errors that cross.
fn anything(random: &mut Random) -> Order {
    let count = 2 + random.below(7);
    let runs = [1, 2, 5, 9][random.below(4)];
    let noise = [0.0, 0.02, 0.3][random.below(3)];
    let resolution = [0.0, 0.0, 0.15][random.below(3)];
    let mut points: Vec<Point> = Vec::new();
    for _ in 0..count {
        let cost = [1.0, 1.0, 1.02, 1.1, 1.5, 2.0][random.below(6)];
        let truth = cost * [1.0, 1.0, 1.0, 0.7, 1.4, 1.0, 1.0, 0.0][random.below(8)];
        let run = |_| truth * (1.0 + random.number(0.0, noise));
        let cpu: Vec<f64> = (0..runs).map(run).collect();
        let value = [0.1, 0.1, 0.1005, 0.2, 0.3][random.below(5)];
        let spread = [0.0, 0.0, 0.01, 0.15][random.below(4)];
        let mut new = point(cost, &cpu, value);
        new.resamples = (0..3).map(|_| value + random.number(-spread, spread)).collect();
        let low = value - random.number(0.0, 0.8 * spread);
        new.error = Estimate { value, low, high: value + random.number(0.0, 0.8 * spread) };
        new.resolution = resolution;
        new.doubt = [0.0, 0.0, 0.1][random.below(3)];
        if random.below(3) == 0 {
            new.work.0.shadow = random.below(2) as u64;
        }
        if let Some(twin) = points.iter().find(|other| other.work == new.work) {
            (new.cpu, new.doubt) = (twin.cpu, twin.doubt);
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
                    follows(&|a, b| order.is_no_worse(a, b));
                    chains += usize::from(order.dominates(a, b) && order.dominates(b, c));
                }
            }
        }
    }
    assert!(pairs > 5000 && chains > 1000, "{pairs} {chains}");
}

/// Of the numbers that a table shows, none may speak against what stands beside them.
#[test]
fn a_verdict_claims_nothing_that_the_numbers_do_not_show() {
    let mut random = Random(12);
    let mut seen = [0; 4];
    for _ in 0..3000 * long() {
        let order = anything(&mut random);
        let all: Vec<usize> = (0..order.points.len()).collect();
        let verdicts = order.verdicts(&all);
        for (i, verdict) in verdicts.iter().enumerate() {
            let point = |of: usize| &order.points[of];
            let shown = |of: usize| point(of).error.value.max(point(of).resolution);
            let cheaper = |a: usize, b: usize| {
                let (a, b) = (point(a), point(b));
                let surely = (1.0 + a.doubt) * (1.0 + b.doubt);
                let times = if a.cost < b.cost { 1.0 } else { SURELY };
                a.cpu.min > 0.0 && times * surely * a.cpu.median < b.cpu.min
            };
            let quicker = |a: usize, b: usize| order.is_quicker(a, b) && order.gains(a, b);
            let place = match *verdict {
                Verdict::Front => {
                    let cheaper = all.iter().filter(|&&other| order.is_cheaper(other, i));
                    assert!(cheaper.clone().all(|&other| order.gains(i, other)));
                    assert!(cheaper.clone().all(|&other| shown(i) < shown(other)));
                    assert!(!all.iter().any(|&other| quicker(other, i)));
                    0
                }
                Verdict::Dominated { by, times, error } => {
                    assert!(cheaper(by, i) || order.is_same_work(by, i));
                    assert!(times.is_none_or(|times| times > 1.0));
                    assert_eq!(times.is_none(), order.is_same_work(by, i));
                    assert!(error <= 1.0 && shown(by) <= shown(i));
                    // Of what is not resolved, no less is claimed than can be.
                    let by_most =
                        shown(by).max(match point(by).error.value < point(by).resolution {
                            true => point(by).error.high,
                            false => 0.0,
                        });
                    assert!(error == 1.0 || error >= by_most / point(i).shown());
                    assert!(point(by).error.low <= point(i).error.high.max(shown(i)));
                    // Two that are not resolved are not compared.
                    let resolved = point(i).error.value >= point(i).resolution;
                    assert!(resolved || order.has_same_errors(by, i));
                    assert!(!matches!(verdicts[by], Verdict::Dominated { .. }));
                    1
                }
                Verdict::Unproven { over, times } => {
                    assert!(cheaper(over, i) || quicker(over, i));
                    assert!(!order.gains(i, over) && times > 1.0);
                    // Where the intervals have nothing in common it would be proven.
                    let high = point(i).error.high.max(point(i).resolution);
                    let resolved = point(over).error.value >= point(over).resolution;
                    assert!(!resolved || high * WORTH >= point(over).error.low);
                    2
                }
                Verdict::Tied { with } => {
                    assert!(!cheaper(with, i) && !cheaper(i, with));
                    assert!(!order.gains(with, i) && !order.gains(i, with) && with != i);
                    3
                }
            };
            seen[place] += 1;
        }
        // Nothing lies left of and below all that is not dominated.
        for &i in &all {
            let point = |of: usize| &order.points[of];
            let beats = |other: &&usize| {
                let (a, b) = (point(**other), point(i));
                a.cpu.min <= b.cpu.min && a.error.value <= b.error.value
            };
            let stands = |other: &usize| !matches!(verdicts[*other], Verdict::Dominated { .. });
            assert!(all.iter().filter(beats).any(stands));
        }
    }
    assert!(seen.iter().all(|&times| times > 200), "{seen:?}");
}

#[test]
fn the_front_goes_down_as_cost_goes_up() {
    let points = [(1.0, 0.5), (4.0, 0.1), (2.0, 0.2), (8.0, 0.2)];
    let verdicts = verdicts(&points.map(|(cost, error)| point(cost, &[cost], error)));
    assert_eq!(verdicts[..3], [Verdict::Front; 3]);
    // Of those that dominate it, the cheapest.
    let times = Some(4.0);
    assert_eq!(verdicts[3], Verdict::Dominated { by: 2, times, error: 1.0 });
}

#[test]
fn the_same_work_is_tied_or_the_worse_of_two() {
    let mut points = [point(1.0, &[3.0; 9], 0.5), point(1.0, &[3.0; 9], 0.5)];
    assert_eq!(verdicts(&points), [Verdict::Front, Verdict::Tied { with: 0 }]);
    // As much work, but for less error.
    points[1] = point(1.0, &[3.0; 9], 0.4);
    let dominated = Verdict::Dominated { by: 1, times: None, error: 0.8 };
    assert_eq!(verdicts(&points), [dominated, Verdict::Front]);
}

#[test]
fn where_counters_and_clock_disagree_nothing_is_cheaper() {
    let second =
        |cpu: &[f64]| verdicts(&[point(1.0, &[1.0, 1.1, 1.3], 0.5), point(1.2, cpu, 0.5)])[1];
    let dominated = |times| Verdict::Dominated { by: 0, times: Some(times), error: 1.0 };
    assert_eq!(second(&[1.2, 1.2, 1.5]), dominated(1.2 / 1.1));
    // Its shortest run is no longer than the other's middle one, or shorter than all.
    assert_eq!(second(&[1.1, 1.2, 1.5]), Verdict::Tied { with: 0 });
    assert_eq!(second(&[0.8, 0.9, 0.9]), Verdict::Tied { with: 0 });
    // How far the runs of others lie apart is nothing to these two.
    let noisy = point(9.0, &[9.0, 30.0, 90.0], 0.1);
    let points = [point(1.0, &[1.0, 1.1], 0.5), point(1.2, &[1.2, 1.3], 0.5), noisy];
    assert_eq!(verdicts(&points)[1], dominated(1.25 / 1.05));
    // A clock that does not see a run cannot say how many times as long another is.
    assert_eq!(
        verdicts(&[point(1.0, &[0.0], 0.5), point(2.0, &[0.1], 0.5)])[1],
        Verdict::Tied { with: 0 }
    );
}

#[test]
fn where_the_clock_is_beyond_doubt_counters_that_are_nearly_alike_do_not_matter() {
    // Of a scene of glass: more was counted of the first, which is faster and better.
    let second = |cpu: &[f64]| {
        verdicts(&[point(36.5, &[0.072, 0.073, 0.0735], 0.0486), point(35.75, cpu, 0.197)])[1]
    };
    let Verdict::Dominated { by: 0, times: Some(times), error } = second(&[0.0887, 0.089, 0.09])
    else {
        panic!("it is dominated")
    };
    assert!((times - 0.089 / 0.073).abs() < 1e-12 && (error - 0.0486 / 0.197).abs() < 1e-12);
    // Not beyond doubt, and yet nothing to call the front.
    assert!(matches!(second(&[0.0787, 0.079, 0.08]), Verdict::Unproven { over: 0, .. }));
}

#[test]
fn a_single_run_is_as_uncertain_as_the_runs_of_others_lie_apart() {
    let second = |doubt: f64, seconds: f64| {
        let mut points = [point(1.0, &[1.0], 0.5), point(1.2, &[seconds], 0.5)];
        points.iter_mut().for_each(|point| point.doubt = doubt);
        verdicts(&points)[1]
    };
    assert_eq!(second(0.05, 1.007), Verdict::Tied { with: 0 });
    assert_eq!(second(0.05, 1.1), Verdict::Tied { with: 0 });
    assert!(matches!(second(0.05, 1.2), Verdict::Dominated { by: 0, .. }));
}

#[test]
fn a_gain_that_is_not_proven_is_not_on_the_front_and_no_proof_against_it() {
    // Of the resamples one is worse, and the intervals have something in common.
    let second =
        |bounds, resamples| verdicts(&[point(1.0, &[1.0], 0.5), unsure(2.0, bounds, resamples)])[1];
    let unproven = Verdict::Unproven { over: 0, times: 2.0 };
    assert_eq!(second((0.4, 0.45, 0.52), [0.44, 0.51, 0.45, 0.46]), unproven);
    // A gain below a hundredth is none.
    assert_eq!(second((0.497, 0.498, 0.499), [0.498; 4]), unproven);
    let dominated = second((0.4, 0.55, 0.6), [0.5, 0.6, 0.52, 0.5]);
    assert!(
        matches!(dominated, Verdict::Dominated { by: 0, .. }),
        "no gain at all for twice the work"
    );
}

#[test]
fn intervals_with_nothing_in_common_prove_a_gain_whatever_a_single_resample_says() {
    let of_first = unsure(1.0, (0.4, 0.45, 0.5), [0.3, 0.41, 0.45, 0.5]);
    let second = |high| {
        verdicts(&[of_first.clone(), unsure(2.0, (0.3, 0.35, high), [0.7, 0.3, 0.35, 0.4])])[1]
    };
    assert_eq!(second(0.39), Verdict::Front);
    assert_eq!(second(0.41), Verdict::Unproven { over: 0, times: 2.0 });
}

#[test]
fn of_two_errors_below_the_floor_nothing_is_said() {
    let points = [(1.0, 0.5), (2.0, 0.02), (4.0, 0.01), (8.0, 0.06), (16.0, 0.01)];
    let mut points = points.map(|(cost, error)| point(cost, &[cost], error));
    points.iter_mut().for_each(|point| point.resolution = 0.05);
    // As much work as the one before, and the same picture.
    points[4] = points[2].clone();
    let verdicts = verdicts(&points);
    assert_eq!(verdicts[..2], [Verdict::Front; 2]);
    assert_eq!(verdicts[2], Verdict::Unproven { over: 1, times: 2.0 });
    assert!(matches!(verdicts[3], Verdict::Dominated { by: 1, .. }), "{verdicts:?}");
    assert_eq!(verdicts[4], Verdict::Tied { with: 2 });
}
