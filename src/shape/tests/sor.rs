//! Surfaces of revolution against twice the digits.

use super::outline::{assert_same_both_ways, goes_along, number, one, ray_through};
use super::placed::{
    assert_crossed_where_it_is, assert_first_found_up_to_a_limit, assert_left_into_the_open,
    greater, placed, ray_at_placed,
};
use super::*;
use crate::math::random::tries_in;
use crate::shape::exact::Triple;
use crate::shape::local::Local;
use crate::shape::seen::Seen;
use crate::shape::sor::Segment;

fn inside(body: &Body, [x, y, z]: Triple) -> Double {
    let Body::Sor(sor) = body else { panic!("{body:?}") };
    let segments = sor.segments();
    let number = segments.partition_point(|segment| segment.high < z.0);
    let Segment { low, high, squares } = segments[number.min(segments.len() - 1)];
    let t = (z - Double::of(low)) / (Double::of(high) - Double::of(low));
    let mut points = squares.map(Double::of).to_vec();
    while points.len() > 1 {
        points = points.windows(2).map(|pair| (one() - t) * pair[0] + t * pair[1]).collect();
    }
    let slope = body.height(0, Vector::new(x.0, y.0, z.0)).gradient.length();
    let round = (x * x + y * y - points[0]) / Double::of(slope.max(f64::MIN_POSITIVE));
    let last = segments[segments.len() - 1].high;
    greater(round, greater(z - Double::of(last), Double::of(segments[0].low) - z))
}

pub(super) fn any_sor(random: &mut Random) -> Sor {
    let count = 2 + random.below(4);
    let mut heights: Vec<f64> = (0..count).map(|_| number(random, -1.0, 1.0)).collect();
    heights.extend([-1.0, 1.0]);
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    let radii: Vec<f64> = heights.iter().map(|_| number(random, 0.0, 0.6)).collect();
    let slopes: Vec<f64> = heights.iter().map(|_| number(random, -0.6, 0.6)).collect();
    let segment = |i: usize| {
        let (low, high) = (heights[i], heights[i + 1]);
        let third = (high - low) / 3.0;
        let (first, last) = (radii[i] * radii[i], radii[i + 1] * radii[i + 1]);
        let squares = [first, first + third * slopes[i], last - third * slopes[i + 1], last];
        Segment { low, high, squares }
    };
    let segments = (0..heights.len() - 1).map(segment).collect();
    Sor::new(segments, random.below(4) == 0).expect("segments")
}

#[test]
fn a_sor_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(95);
    let mut crossed = 0;
    for _ in 0..tries_in(30) {
        let body = Body::Sor(any_sor(&mut random));
        let placed = placed(&mut random, body);
        for _ in 0..4 {
            let ray = ray_at_placed(&mut random, &placed);
            crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
            assert_left_into_the_open(&mut random, &placed, &ray, inside);
            assert_first_found_up_to_a_limit(&mut random, &placed, &ray);
        }
    }
    assert!(crossed > tries_in(30), "{crossed}");
}

#[test]
fn a_sor_is_crossed_where_a_ray_is_level_upright_grazes_it_or_meets_its_axis() {
    let mut random = Random(96);
    let mut crossed = 0;
    for _ in 0..tries_in(30) {
        let body = any_sor(&mut random);
        let segment = body.segments()[random.below(body.segments().len())];
        let z = [segment.low, segment.high, random.number(-1.0, 1.0)][random.below(3)];
        let around = random.direction().get().with_z(0.0).normalize_or(Vector::X);
        let x = body.radius(z) * (1.0 + [0.0, random.size(-17.0, 0.0)][random.below(2)]);
        let off = random.direction().get() * [0.0, random.size(-17.0, 0.0)][random.below(2)];
        let (place, aside) = (around * x + Vector::Z * z, around.cross(Vector::Z));
        let (through, way) = match random.below(5) {
            0 => (place, aside + off),
            1 => (place, random.direction().get().with_z(0.0) + off),
            2 => (place, Vector::Z + off),
            3 => (Vector::Z * z + off, random.direction().get()),
            _ => (place, random.direction().get()),
        };
        let placed = placed(&mut random, Body::Sor(body));
        let Some((ray, near)) = ray_through(&mut random, &placed, through, way) else { continue };
        if goes_along(&placed, &ray, inside) {
            assert_eq!(placed.crossings(&ray).len() % 2, 0);
            continue;
        }
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        // From afar, a place on an edge may lie beyond it, by as much as the line is blurred.
        if near {
            assert_left_into_the_open(&mut random, &placed, &ray, inside);
        }
    }
    assert!(crossed > tries_in(100), "{crossed}");
}

/// Some lines are nearly level, and some pass right beside the widest place.
#[test]
fn crossings_with_a_sor_that_are_isolated_are_those_that_are_stepped_to() {
    let mut random = Random(98);
    let mut told = 0;
    for turn in 0..tries_in(40) {
        let sor = any_sor(&mut random);
        let body = sor.clone();
        let widest = sor.segments().iter().map(|one| one.low).fold(-1.0, |widest: f64, z| {
            if sor.radius(z) > sor.radius(widest) { z } else { widest }
        });
        let placed = placed(&mut random, Body::Sor(body));
        let around = random.direction().get().with_z(0.0).normalize_or(Vector::X);
        let beside = 1.0 + random.size(-6.0, -1.0);
        let place = around * sor.radius(widest) * beside + Vector::Z * widest;
        let level = around.cross(Vector::Z) + Vector::Z * random.size(-8.0, -2.0);
        let ray = match turn % 2 {
            0 => ray_at_placed(&mut random, &placed),
            _ => match ray_through(&mut random, &placed, place, level) {
                Some((ray, _)) => ray,
                None => continue,
            },
        };
        let seen = Seen::new(&placed, &ray, 0.0);
        told += assert_same_both_ways(&sor.both_ways(&seen.line));
    }
    assert!(told > tries_in(80), "{told}");
}
