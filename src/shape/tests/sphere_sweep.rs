//! Swept spheres against twice the digits.

use super::placed::{
    assert_crossed_where_it_is, assert_left_into_the_open, far_off, placed, ray_at_placed,
};
use super::*;
use crate::shape::exact::Triple;
use crate::shape::local::Local;
use crate::shape::sphere_sweep::Segment;
use crate::shape::{Body, SphereSweep};

fn inside(body: &Body, point: Triple) -> Double {
    let Body::SphereSweep(sweep) = body else { panic!("{body:?}") };
    sweep.exactly(point)
}

fn straight(a: Vector, b: Vector, radii: [f64; 2]) -> Segment {
    let zero = Vector::ZERO;
    Segment { centre: [a, b - a, zero, zero], radius: [radii[0], radii[1] - radii[0], 0.0, 0.0] }
}

/// A B-spline, as it comes from four control points.
fn curved(points: [Vector; 4], radii: [f64; 4]) -> Segment {
    let [a, b, c, d] = points;
    let [p, q, r, s] = radii;
    Segment {
        centre: [
            (a + b * 4.0 + c) / 6.0,
            (c - a) / 2.0,
            (a - b * 2.0 + c) / 2.0,
            (d - c * 3.0 + b * 3.0 - a) / 6.0,
        ],
        radius: [
            (p + q * 4.0 + r) / 6.0,
            (r - p) / 2.0,
            (p - q * 2.0 + r) / 2.0,
            (s - r * 3.0 + q * 3.0 - p) / 6.0,
        ],
    }
}

fn any_sweep(random: &mut Random) -> SphereSweep {
    let radius = |random: &mut Random| match random.below(3) {
        0 => 0.2,
        1 => random.size(-3.0, -0.5),
        _ => random.number(0.02, 0.4),
    };
    let count = 1 + random.below(4);
    let same = random.below(3) == 0;
    let wide = radius(random);
    let next = |random: &mut Random| (random.point(0.8), if same { wide } else { radius(random) });
    let all: Vec<(Vector, f64)> = (0..count + 3).map(|_| next(random)).collect();
    let is_straight = random.below(2) == 0;
    let segments = (0..count).map(|i| {
        let at = |k: usize| all[i + k];
        if is_straight {
            straight(at(0).0, at(1).0, [at(0).1, at(1).1])
        } else {
            curved([0, 1, 2, 3].map(|k| at(k).0), [0, 1, 2, 3].map(|k| at(k).1))
        }
    });
    SphereSweep::new(segments.collect()).expect("a segment or more")
}

#[test]
fn a_sweep_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(76);
    let mut crossed = 0;
    for _ in 0..tries_in(200) {
        let body = any_sweep(&mut random);
        let placed = placed(&mut random, Body::SphereSweep(body));
        for _ in 0..4 {
            let ray = ray_at_placed(&mut random, &placed);
            crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
            assert_left_into_the_open(&mut random, &placed, &ray, inside);
        }
    }
    assert!(crossed > tries_in(200), "{crossed}");
}

#[test]
fn a_sweep_is_crossed_where_a_ray_grazes_it_or_goes_along_it() {
    let mut random = Random(77);
    let mut crossed = 0;
    for _ in 0..tries_in(100) {
        let (from, to) = (random.point(0.5), random.point(0.5));
        let wide = random.number(0.05, 0.4);
        let radii = [wide, [wide, random.number(0.0, 0.4)][random.below(2)]];
        let Some(sweep) = SphereSweep::new(vec![straight(from, to, radii)]) else { panic!() };
        let placed = placed(&mut random, Body::SphereSweep(sweep));
        let Some(axis) = UnitVector::from_direction(to - from) else { continue };
        let axis = axis.get();
        let aside = axis.cross(random.direction().get()).normalize_or(Vector::X);
        let off = [0.0, random.size(-17.0, 0.0), -random.size(-17.0, 0.0)][random.below(3)];
        let (through, along) = match random.below(4) {
            0 => (from + aside * (wide * (1.0 + off)), axis),
            1 => (from + aside * (wide * (1.0 + off)), axis.cross(aside)),
            2 => (from, axis),
            _ => (from + axis * off, aside),
        };
        let far = far_off(&mut random, &placed);
        let [a, b] = [through - along * far, through].map(|p| placed.placement.world_point(p));
        let direction = UnitVector::from_direction(b - a).unwrap_or(UnitVector::Z).get();
        let ray = Ray { origin: a, direction };
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        assert_left_into_the_open(&mut random, &placed, &ray, inside);
    }
    assert!(crossed > tries_in(100) / 2, "{crossed}");
}

#[test]
fn a_sweep_lies_within_its_extent_and_its_reach() {
    let mut random = Random(78);
    for _ in 0..tries_in(100) {
        let sweep = any_sweep(&mut random);
        let along = random.direction().get();
        let (least, most) = sweep.extent(along);
        let mut best = f64::NEG_INFINITY;
        for _ in 0..300 {
            let point = random.point(1.5);
            if sweep.contains(point) {
                let place = point.dot(along);
                best = best.max(place);
                assert!(least <= place && place <= most, "{point} {along} {sweep:?}");
                assert!(point.length() <= sweep.reach(), "{point} {sweep:?}");
            }
        }
    }
}
