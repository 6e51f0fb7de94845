//! Roots of polynomials, kinks and jumps: each is found, and in order.

use super::*;
use crate::math::random::{Random, tries};

const FINE: Fineness = Fineness { resolution: 1e-3, least: 1e-14 };

/// The changes of sign of a function in an interval.
fn changes(
    function: &impl Fn(Interval) -> Bounds,
    from: f64,
    to: f64,
    fineness: Fineness,
) -> Changes {
    let mut search = Search::new(function, fineness);
    search.through(from, to);
    search.found
}

/// The product of x − r over the roots, in interval arithmetic.
fn polynomial(roots: &[f64]) -> impl Fn(Interval) -> Bounds {
    move |x| {
        let (mut value, mut slope) = (Interval::point(1.0), Interval::point(0.0));
        for root in roots {
            let factor = x - Interval::point(*root);
            slope = slope * factor + value;
            value = value * factor;
        }
        Bounds { value, slope }
    }
}

#[test]
fn every_root_of_a_polynomial_is_found_and_in_order() {
    let mut random = Random(3);
    for _ in 0..tries() {
        let mut roots = [(); 5].map(|()| random.number(-1.0, 1.0));
        // Two of them near each other.
        roots[1] = roots[0] + random.size(-5.0, -1.0);
        roots.sort_by(f64::total_cmp);
        let changes = changes(&polynomial(&roots), -2.0, 3.0, FINE);
        assert_eq!(changes.all.len(), 5, "{roots:?} {changes:?}");
        for (change, root) in changes.all.iter().zip(roots) {
            assert!(change.before < root && root < change.after, "{roots:?} {changes:?}");
        }
        assert!(changes.all.iter().enumerate().all(|(i, c)| c.rising == (i % 2 == 0)));
    }
}

#[test]
fn where_slopes_are_known_every_root_is_found_by_fewer_bounds() {
    let (mut random, looks) = (Random(4), std::cell::Cell::new(0));
    let mut counts = [0, 0];
    for _ in 0..tries() {
        let roots = [(); 3].map(|()| random.number(-1.0, 1.0));
        let function = polynomial(&roots);
        let counted = |x: Interval| {
            looks.set(looks.get() + u32::from(x.single().is_none()));
            function(x)
        };
        let slope = function(Interval { low: -2.0, high: 2.0 }).slope;
        for (count, slope) in counts.iter_mut().zip([Interval::EVERYTHING, slope]) {
            looks.set(0);
            let mut search = Search::new(counted, FINE);
            search.begin(-2.0, 2.0, slope);
            while search.goes_on() {}
            assert_eq!(search.found().all.len(), 3, "{roots:?} {slope:?}");
            *count += looks.get();
        }
    }
    assert!(counts[1] < counts[0], "{counts:?}");
}

#[test]
fn who_wants_one_change_looks_no_farther() {
    let looks = std::cell::Cell::new(0);
    let roots = polynomial(&[-0.9, 0.1, 0.100_01, 0.100_02, 0.9]);
    let counted = |x: Interval| {
        looks.set(looks.get() + 1);
        roots(x)
    };
    let mut search = Search::new(counted, FINE);
    search.begin(-2.0, 3.0, Interval::EVERYTHING);
    assert!(search.goes_on());
    let first = looks.get();
    assert_eq!(search.found().all.len(), 1);
    while search.goes_on() {}
    let roots = polynomial(&[-0.9, 0.1, 0.100_01, 0.100_02, 0.9]);
    assert_eq!(search.found(), &changes(&roots, -2.0, 3.0, FINE));
    assert!(3 * first < looks.get(), "{first} {}", looks.get());
}

#[test]
fn the_last_place_of_certain_sign_is_the_end_of_what_was_searched() {
    // Flat, and then falling: from its root on the slope alone tells the sign.
    let ramp = |x: Interval| Bounds {
        value: Interval::point(0.5) - x.max(Interval::point(0.0)),
        slope: Interval { low: if x.high > 0.0 { -1.0 } else { 0.0 }, high: 0.0 },
    };
    let found = changes(&ramp, -1.0, 1.0, FINE);
    assert_eq!((found.all.len(), found.last), (1, Some((1.0, true))), "{found:?}");
}

#[test]
fn what_touches_zero_and_does_not_pass_it_changes_no_sign() {
    let touching = |x: Interval| Bounds {
        value: (x - Interval::point(0.3)).square(),
        slope: Interval::point(2.0) * (x - Interval::point(0.3)),
    };
    assert!(changes(&touching, -1.0, 1.0, FINE).all.is_empty());
}

#[test]
fn where_a_distance_is_0_throughout_few_looks_are_enough() {
    let zero = Interval::point(0.0);
    let looks = std::cell::Cell::new(0);
    // From what lies between −1 and 1.
    let distance = |x: Interval| {
        looks.set(looks.get() + 1);
        let beyond = (x.abs() - Interval::point(1.0)).max(zero);
        let length = (beyond.square() + zero.square()).sqrt();
        let slope = match (x.low >= 1.0, x.high <= -1.0) {
            (true, _) => Interval::point(1.0),
            (_, true) => Interval::point(-1.0),
            _ => Interval::EVERYTHING,
        };
        Bounds { value: length - Interval::point(0.5), slope }
    };
    let found = changes(&distance, -2.0, 2.1, FINE);
    assert_eq!(found.all.len(), 2, "{found:?}");
    assert!(looks.get() < 100, "{}", looks.get());
}

#[test]
fn a_jump_is_found_as_exactly_as_numbers_go() {
    let step = |x: Interval| {
        let at = |x: f64| if x < 0.123_456 { -1.0 } else { 1.0 };
        let value = Interval { low: at(x.low), high: at(x.high) };
        let slope =
            if value.single().is_some() { Interval::point(0.0) } else { Interval::EVERYTHING };
        Bounds { value, slope }
    };
    let found = changes(&step, -1.0, 1.0, FINE);
    let [change] = found.all[..] else { panic!("{found:?}") };
    assert!(change.rising && change.before < 0.123_456 && change.after >= 0.123_456);
    assert!(change.after - change.before < 1e-13);
}
