//! Where polynomial surfaces end, against surfaces whose ends are known.

use std::cmp::Ordering;

use super::algebraic::{Terms, product, squares, surface, torus};
use super::*;
use crate::math::terms::exponents;
use crate::shape::algebraic::Algebraic;
use crate::shape::local::Local;

const AXES: [Vector; 3] = [Vector::X, Vector::Y, Vector::Z];
const ENDLESS: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

/// Each side holds the surface, and is off by no more than this share of its width.
fn assert_ends(surface: &Algebraic, exact: [(f64, f64); 3], share: f64) {
    for (along, (low, high)) in AXES.into_iter().zip(exact) {
        for found in [surface.extent(along), surface.nearest_extent(along)] {
            let off = (low - found.0).max(found.1 - high) / (high - low);
            assert!(found.0 <= low && high <= found.1, "{along} {found:?} {exact:?}");
            assert!(off <= share, "{along} {found:?} {exact:?}");
        }
    }
}

fn even(size: f64) -> (f64, f64) {
    (-size, size)
}

fn negated(terms: &Terms) -> Terms {
    terms.iter().map(|(term, powers)| (-term, *powers)).collect()
}

/// Σ axⁿ over the three axes − 1.
fn rounded_box(power: usize, [a, b, c]: [f64; 3]) -> Terms {
    vec![(a, [power, 0, 0]), (b, [0, power, 0]), (c, [0, 0, power]), (-1.0, [0, 0, 0])]
}

#[test]
fn a_quartic_torus_ends_where_it_does() {
    for minor in [0.05, 0.35, 0.9, 1.4] {
        let all = [even(1.0 + minor), even(minor), even(1.0 + minor)];
        let torus = surface(4, &torus(1.0, minor));
        assert_ends(&torus, all, if minor < 0.1 { 0.2 } else { 0.025 });
        let reach = torus.reach();
        assert!((1.0 + minor..1.25 * (1.0 + minor)).contains(&reach), "{minor}: {reach}");
    }
}

#[test]
fn rounded_boxes_of_many_degrees_end_where_they_do() {
    for power in [4, 6, 8, 12] {
        let weights = [1.0, 1.3, 0.8];
        let exact = weights.map(|a| even(crate::math::elementary::pow(a, -1.0 / power as f64)));
        let terms = rounded_box(power, weights);
        let container = if power == 12 { 13 } else { power };
        assert_ends(&surface(container, &terms), exact, 0.025);
        let far = surface(container, &terms).reach();
        assert!(
            far <= 1.05 * exact.map(|(_, high)| high * high).iter().sum::<f64>().sqrt(),
            "{far}"
        );
    }
}

#[test]
fn a_surface_around_a_place_far_off_and_one_of_several_sheets_end_where_they_do() {
    let ball = |x: f64, radius: f64| {
        let mut terms = squares(1.0, 1.0, 1.0, x * x - radius * radius);
        terms.push((-2.0 * x, [1, 0, 0]));
        terms
    };
    // Two that are apart, one in the other, and a point.
    let pairs = [
        (ball(100.0, 1.0), ball(102.5, 0.5), [(99.0, 103.0), even(1.0), even(1.0)]),
        (ball(-0.5, 2.0), ball(0.0, 0.25), [(-2.5, 1.5), even(2.0), even(2.0)]),
        (ball(-3.0, 1.0), ball(3.0, 0.0), [(-4.0, 3.0), even(1.0), even(1.0)]),
    ];
    for (a, b, exact) in pairs {
        assert_ends(&surface(4, &product(&a, &b)), exact, 0.025);
    }
}

#[test]
fn what_is_outside_of_a_bounded_hole_has_its_surface_in_a_box_and_no_ball_around_it() {
    let hole = surface(4, &negated(&torus(1.0, 0.35)));
    assert_ends(&hole, [even(1.35), even(0.35), even(1.35)], 0.025);
    assert_eq!(hole.reach(), f64::INFINITY);
    assert!(hole.contains(Vector::X * 9.0) && !hole.contains(Vector::X));
}

#[test]
fn a_surface_that_is_nowhere_or_a_point_is_about_one_point() {
    let mut nowhere = rounded_box(4, [1.0; 3]);
    nowhere[3].0 = 1.0;
    for terms in [nowhere.clone(), negated(&nowhere), rounded_box(4, [1.0; 3])[..3].to_vec()] {
        for along in AXES {
            let (low, high) = surface(4, &terms).extent(along);
            assert!((-1e-3..=0.0).contains(&low) && (0.0..=1e-3).contains(&high), "{terms:?}");
        }
    }
}

#[test]
fn what_has_no_end_and_what_takes_too_long_to_tell_is_endless() {
    let constant = (-1.0, [0, 0, 0]);
    let product_of_three: Terms = vec![(1.0, [1, 1, 1]), constant];
    let bar: Terms = vec![(1.0, [4, 0, 0]), (1.0, [0, 4, 0]), constant];
    let leaning: Terms = vec![(1.0, [4, 0, 0]), (1.0, [0, 4, 0]), (-0.3, [0, 0, 4]), constant];
    let odd: Terms = vec![(1.0, [5, 0, 0]), (1.0, [0, 4, 0]), (1.0, [0, 0, 4]), constant];
    // Of a highest degree that is 0 along a line that no halves come to, or nearly so.
    let skew: Terms = vec![(1.0, [1, 0, 0]), (-0.3, [0, 1, 0])];
    let aside: Terms = vec![(1.0, [0, 0, 1]), (-0.7, [0, 1, 0])];
    let mut flat = product(&product(&skew, &skew), &product(&skew, &skew));
    flat.extend(product(&product(&aside, &aside), &product(&aside, &aside)));
    let mut nearly = flat.clone();
    flat.push(constant);
    nearly.extend([(1e-40, [0, 4, 0]), constant]);
    for (degree, terms) in
        [(3, product_of_three), (4, bar), (4, leaning), (5, odd), (4, flat), (4, nearly)]
    {
        let surface = surface(degree, &terms);
        assert_eq!(AXES.map(|along| surface.extent(along)), [ENDLESS; 3], "{terms:?}");
        assert_eq!(surface.reach(), f64::INFINITY);
    }
}

#[test]
fn what_is_inside_of_a_bounded_polynomial_lies_within_its_extents_and_its_reach() {
    let mut random = Random(84);
    let (mut inside, mut bounded) = (0, 0);
    let bodies = tries_in(200);
    for case in 0..bodies {
        let degree = [4, 4, 6, 8][case % 4];
        let all: Terms =
            exponents(degree).map(|powers| (random.number(-0.5, 0.5), powers)).collect();
        let mut terms: Terms = all.into_iter().filter(|_| random.below(3) == 0).collect();
        for axis in 0..3 {
            let mut powers = [0; 3];
            powers[axis] = degree;
            terms.push((random.number(0.5, 2.0), powers));
        }
        let surface = surface(degree, &terms);
        let reach = surface.reach();
        if reach.is_infinite() {
            continue;
        }
        bounded += 1;
        for _ in 0..100 {
            let point = random.point(1.0) * (2.0 * random.number(0.0, reach));
            if surface.height(0, point).value > 0.0 {
                continue;
            }
            inside += 1;
            let along = random.point(1.0);
            let (low, high) = surface.extent(along);
            let place = along.dot(point);
            assert!(low <= place && place <= high, "{case}: {point} {surface:?}");
            assert!(point.length() <= reach, "{case}: {point} {surface:?}");
        }
    }
    assert!(bounded > bodies / 2 && inside > bounded, "{bounded} of {bodies}, {inside}");
}

#[test]
fn each_turned_surface_is_as_wide_as_its_ball_at_most() {
    let ball = surface(4, &product(&squares(1.0, 1.0, 1.0, -1.0), &squares(1.0, 1.0, 1.0, 2.0)));
    let (low, high) = ball.extent(Vector::ONE.normalize());
    assert!(low <= -1.0 && 1.0 <= high && high - low < 2.3, "{low} {high}");
}

#[test]
fn a_quadric_without_a_surface_is_told_and_no_other() {
    let mut random = Random(211);
    for case in 0..tries() {
        let mut terms = Terms::new();
        for _ in 0..3 {
            let mut form = Terms::new();
            for powers in [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]] {
                form.push((random.number(-1.0, 1.0), powers));
            }
            terms.extend(product(&form, &form));
        }
        // The squares are all 0 in one point, and grow from there.
        let constant = random.number(-1.0, 1.0);
        terms.push((constant, [0, 0, 0]));
        let [above, below] = [&terms, &negated(&terms)].map(|terms| surface(2, terms).everywhere());
        if constant > 1e-6 {
            assert_eq!(above, Some(Ordering::Greater), "{case}: {terms:?}");
            assert_eq!(below, Some(Ordering::Less), "{case}: {terms:?}");
        } else if constant < 0.0 {
            assert_eq!([above, below], [None; 2], "{case}: {terms:?}");
        }
    }
}

#[test]
fn a_polynomial_of_even_powers_and_one_sign_has_no_surface() {
    let mut terms = rounded_box(4, [1.0, 0.0, 2.0]);
    assert_eq!(surface(4, &terms).everywhere(), None);
    terms[3].0 = 1.0;
    assert_eq!(surface(4, &terms).everywhere(), Some(Ordering::Greater));
    assert_eq!(surface(4, &negated(&terms)).everywhere(), Some(Ordering::Less));
    // A point, a line and a plane are there.
    terms[3].0 = 0.0;
    assert_eq!(surface(4, &terms).everywhere(), None);
    terms[3] = (1.0, [1, 0, 0]);
    assert_eq!(surface(4, &terms).everywhere(), None);
    let slabs = vec![(1.0, [2, 0, 0]), (1.0, [0, 0, 0])];
    assert_eq!(surface(2, &slabs).everywhere(), Some(Ordering::Greater));
    assert_eq!(surface(2, &slabs[..1].to_vec()).everywhere(), None);
}
