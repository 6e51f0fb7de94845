//! Superellipsoids against twice the digits.

use super::placed::{assert_crossed_where_it_is, assert_left_where_it_is, placed, ray_at_placed};
use super::*;
use crate::shape::exact::Triple;
use crate::shape::local::Local;
use crate::shape::{Body, Superellipsoid};

/// The gauge, less 1.
fn inside(body: &Body, point: Triple) -> Double {
    let Body::Superellipsoid(body) = body else { panic!("{body:?}") };
    body.exactly(point)
}

fn convex(random: &mut Random) -> Superellipsoid {
    let mut exponent = || match random.below(4) {
        0 => random.size(-12.0, 0.0),
        1 => [0.01, 0.1, 0.5, 1.0, 2.0][random.below(5)],
        _ => random.number(0.0, 2.0).max(1e-3),
    };
    Superellipsoid::new(exponent(), exponent())
}

fn hollow(random: &mut Random) -> Superellipsoid {
    let mut exponent = || match random.below(3) {
        0 => random.number(2.0, 6.0),
        1 => [2.5, 3.0, 4.0][random.below(3)],
        _ => random.number(0.05, 4.0),
    };
    Superellipsoid::new(exponent(), exponent())
}

#[test]
fn a_superellipsoid_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(64);
    let mut crossed = 0;
    for _ in 0..tries_in(20) {
        let body = convex(&mut random);
        let placed = placed(&mut random, Body::Superellipsoid(body));
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        assert_left_where_it_is(&mut random, &placed, &ray, inside);
    }
    assert!(crossed > tries_in(40), "{crossed}");
}

#[test]
fn a_hollowed_superellipsoid_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(65);
    let mut crossed = 0;
    for _ in 0..tries_in(20) {
        let body = hollow(&mut random);
        let placed = placed(&mut random, Body::Superellipsoid(body));
        for _ in 0..4 {
            let ray = ray_at_placed(&mut random, &placed);
            crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        }
    }
    assert!(crossed > tries_in(20), "{crossed}");
}

#[test]
fn a_superellipsoid_of_exponents_to_100_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(66);
    let mut crossed = 0;
    for _ in 0..tries_in(50) {
        let mut exponent = || random.size(-2.0, 2.0);
        let body = Superellipsoid::new(exponent(), exponent());
        let placed = placed(&mut random, Body::Superellipsoid(body));
        for _ in 0..4 {
            let ray = ray_at_placed(&mut random, &placed);
            crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        }
    }
    assert!(crossed > tries_in(50), "{crossed}");
}

#[test]
fn of_exponents_1_it_is_a_sphere() {
    let mut random = Random(66);
    let ball = Superellipsoid::new(1.0, 1.0);
    for _ in 0..tries_in(20) {
        let placed = placed(&mut random, Body::Superellipsoid(ball));
        let ray = ray_at_placed(&mut random, &placed);
        let exactly =
            |_: &Body, [x, y, z]: Triple| (x * x + y * y + z * z).sqrt() - Double::of(1.0);
        assert_crossed_where_it_is(&mut random, &placed, &ray, exactly);
    }
}

#[test]
fn of_very_small_exponents_it_is_a_box() {
    let mut random = Random(67);
    for exponent in [1e-6, 1e-30, 1e-300, f64::MIN_POSITIVE, 5e-324] {
        for _ in 0..tries_in(40) {
            let cube = Superellipsoid::new(exponent, exponent);
            let placed = placed(&mut random, Body::Superellipsoid(cube));
            let ray = ray_at_placed(&mut random, &placed);
            let exactly = |_: &Body, [x, y, z]: Triple| {
                let greatest = [y, z]
                    .into_iter()
                    .fold(x.abs(), |most, c| if (c.abs() - most).0 > 0.0 { c.abs() } else { most });
                greatest - Double::of(1.0)
            };
            if exponent < 1e-20 {
                assert_crossed_where_it_is(&mut random, &placed, &ray, exactly);
            }
            assert!(placed.crossings(&ray).len().is_multiple_of(2));
        }
    }
}

#[test]
fn it_reaches_as_far_as_its_extent_says_and_no_farther_than_its_reach() {
    let mut random = Random(68);
    for turn in 0..tries_in(40) {
        let body = if turn % 2 == 0 { convex(&mut random) } else { hollow(&mut random) };
        let along = random.direction().get();
        let (_, most) = body.extent(along);
        let mut best = 0.0_f64;
        let mut far = 0.0_f64;
        for step in 0..2000 {
            let out = if step < 400 {
                random.structured_direction().get()
            } else {
                random.direction().get()
            };
            let point = out / (body.height(0, out).value + 1.0);
            best = best.max(point.dot(along));
            far = far.max(point.length());
        }
        assert!(best <= most * (1.0 + 1e-12), "{best} {most} {body:?}");
        assert!(best > 0.85 * most, "{best} {most} {body:?} {along}");
        assert!(far <= body.reach() && far > 0.85 * body.reach(), "{far} {body:?}");
    }
}
