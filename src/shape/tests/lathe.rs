//! Lathes against twice the digits.

use super::outline::{
    along_outline, assert_same_both_ways, goes_along, in_a_line, is_clear, loop_of, number, planar,
    ray_through,
};
use super::placed::{
    assert_crossed_where_it_is, assert_first_found_up_to_a_limit, assert_inside_where_it_says,
    assert_left_into_the_open, placed, ray_at_placed,
};
use super::*;
use crate::math::random::tries_in;
use crate::shape::curve::{Piece, Point};
use crate::shape::exact::Triple;
use crate::shape::local::{Crossings, Local, LocalRay, Met};
use crate::shape::seen::Seen;

fn inside(body: &Body, [x, y, z]: Triple) -> Double {
    let Body::Lathe(lathe) = body else { panic!("{body:?}") };
    planar(lathe.outline(), [(x * x + y * y).sqrt(), z])
}

pub(super) fn any_lathe(random: &mut Random) -> Lathe {
    loop {
        let count = 2 + random.below(5);
        let least = [0.0, random.number(0.0, 0.5)][random.below(2)];
        let mut points: Vec<Point> = (0..count)
            .map(|_| [number(random, least, 0.7).max(least), 0.7 * number(random, -1.0, 1.0)])
            .collect();
        match random.below(3) {
            0 => {}
            1 => points[0][0] = 0.0,
            _ => (points[0][0], points[count - 1][0]) = (0.0, 0.0),
        }
        // A line there and back encloses nothing.
        if points.windows(3).any(|p| p[0] == p[2] || p[0] == p[1] || p[1] == p[2]) {
            continue;
        }
        let degree = 1 + random.below(3);
        let mut pieces = loop_of(random, &points, degree);
        // A line there and back encloses nothing.
        if random.below(3) > 0 || (degree == 1 && in_a_line(&points)) {
            pieces.pop();
        }
        if let Some(lathe) = Lathe::new([pieces]) {
            return lathe;
        }
    }
}

#[test]
fn a_lathe_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(93);
    let mut crossed = 0;
    for _ in 0..tries_in(30) {
        let body = Body::Lathe(any_lathe(&mut random));
        let placed = placed(&mut random, body);
        for _ in 0..3 {
            let ray = ray_at_placed(&mut random, &placed);
            crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
            if is_clear(&placed, &ray, false) {
                assert_left_into_the_open(&mut random, &placed, &ray, inside);
            }
        }
    }
    assert!(crossed > tries_in(30), "{crossed}");
}

#[test]
fn a_lathe_is_crossed_where_a_ray_is_level_upright_grazes_it_or_meets_its_axis() {
    let mut random = Random(94);
    let mut crossed = 0;
    for _ in 0..tries_in(30) {
        let body = any_lathe(&mut random);
        let ([x, z], [a, b]) = along_outline(&mut random, body.outline());
        let around = random.direction().get().with_z(0.0).normalize_or(Vector::X);
        let place = around * x + Vector::Z * z;
        let aside = around.cross(Vector::Z);
        let off = random.direction().get() * [0.0, random.size(-17.0, 0.0)][random.below(2)];
        let tangent = around * a + Vector::Z * b;
        let slant = [0.0, 1.0, -random.size(-17.0, 1.0), random.size(-17.0, 1.0)][random.below(4)];
        let (through, way) = match random.below(6) {
            // In the tangent plane.
            0 => (place, tangent + aside * slant),
            1 => (place, aside + tangent * slant),
            // Level, upright, or nearly so.
            2 => (place, random.direction().get().with_z(0.0) + off),
            3 => (place, Vector::Z + off),
            // Through the axis.
            4 => (Vector::Z * z + off, random.direction().get()),
            _ => (place, random.direction().get()),
        };
        let placed = placed(&mut random, Body::Lathe(body));
        let Some((ray, near)) = ray_through(&mut random, &placed, through, way) else { continue };
        if goes_along(&placed, &ray, inside) {
            assert_eq!(placed.crossings(&ray).len() % 2, 0);
            continue;
        }
        // Where walls touch, what is between them may be too little to be told.
        if !is_clear(&placed, &ray, true) {
            assert_inside_where_it_says(&mut random, &placed, &ray, inside);
            continue;
        }
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        // From afar, a place on an edge may lie beyond it, by as much as the line is blurred.
        if near && is_clear(&placed, &ray, false) {
            assert_left_into_the_open(&mut random, &placed, &ray, inside);
        }
    }
    assert!(crossed > tries_in(100), "{crossed}");
}

#[test]
fn a_level_line_that_only_touches_a_tip_of_a_lathe_misses_it() {
    let tip = Piece::line([0.3, -0.7], [0.0, 0.7]);
    let dimple = Piece::line([0.3, 0.9], [0.0, 0.7]);
    for pieces in [vec![tip], vec![dimple]] {
        let lathe = Lathe::new([pieces]).expect("a cone");
        for way in [Vector::X, Vector::new(0.6, 0.8, 0.0)] {
            let mut found = Crossings::new();
            lathe.crossings(&LocalRay::exact(Vector::Z * 0.7, way), &mut found);
            assert!(found.is_empty(), "{found:?}");
        }
    }
}

#[test]
fn a_line_in_a_level_end_of_a_lathe_is_in_one_of_two_that_touch_there() {
    let corners: [Point; 4] = [[0.0, 0.0], [0.6, 0.0], [0.6, 0.7], [0.0, 0.7]];
    let ends = [1.0, -1.0].map(|way| {
        let at = |[x, z]: Point| [x, way * z];
        let pieces = corners.windows(2).map(|p| Piece::line(at(p[0]), at(p[1])));
        let lathe = Lathe::new([pieces.collect()]).expect("a cylinder");
        let mut found = Crossings::new();
        lathe.crossings(&LocalRay::exact(Vector::Y * 0.1, Vector::X), &mut found);
        found
    });
    let [above, below] = &ends;
    assert!(above.len() == 2 && below.is_empty(), "{ends:?}");
    let half = (0.36_f64 - 0.01).sqrt();
    assert!(above.iter().all(|met| (met.t.abs() - half).abs() <= met.error && met.error < 1e-12));
}

fn met(corners: &[Point], nearest: Vector, direction: Vector) -> Crossings {
    let pieces = corners.windows(2).map(|p| Piece::line(p[0], p[1]));
    let lathe = Lathe::new([pieces.collect()]).expect("a lathe");
    let mut found = Crossings::new();
    lathe.crossings(&LocalRay::exact(nearest, direction.normalize()), &mut found);
    found
}

#[test]
fn a_line_that_may_as_well_only_touch_an_upright_wall_of_a_lathe_misses_it() {
    let drum = [[0.0, -0.5], [1.0, -0.5], [0.75, -0.25], [0.75, 0.25], [0.0, 0.25]];
    let past = |gap: f64, slope: f64| {
        met(&drum, Vector::new(0.0, 0.75 + gap, 0.1), Vector::new(1.0, 0.0, slope)).len()
    };
    for slope in [0.0, 1e-17, 1e-9, 0.01, 0.1] {
        let gaps = [0.0, U, -U, 4.0 * U, -4.0 * U, -1e-12];
        assert_eq!(gaps.map(|gap| past(gap, slope)), [0, 0, 0, 0, 0, 2], "{slope}");
    }
}

/// As exact as elsewhere, however thin.
#[test]
fn a_level_end_of_a_lathe_is_crossed_where_a_flat_line_is_nearest_to_the_axis() {
    for half in [1e-6, 1e-9] {
        let plate = [[0.0, -half], [0.7, -half], [0.7, half], [0.0, half]];
        for gap in [0.0, 1e-3, 0.3] {
            for at in [0.0, half, -half] {
                let found = met(&plate, Vector::new(0.0, gap, at), Vector::new(1.0, 0.0, 0.01));
                let told = |met: &Met, z: f64| {
                    let meant = 1.0001_f64.sqrt() * 100.0 * (z - at);
                    (met.t - meant).abs() <= met.error && met.error < 1e-12
                };
                let [enter, leave] = &found[..] else { panic!("{found:?} {half} {gap} {at}") };
                assert!(told(enter, -half) && told(leave, half), "{found:?} {half} {gap} {at}");
            }
        }
    }
}

#[test]
fn crossings_with_a_lathe_that_are_isolated_are_those_that_are_walked_to() {
    let mut random = Random(97);
    let mut told = 0;
    for _ in 0..tries_in(10) {
        let lathe = any_lathe(&mut random);
        let placed = placed(&mut random, Body::Lathe(lathe.clone()));
        for _ in 0..4 {
            let ray = ray_at_placed(&mut random, &placed);
            let seen = Seen::new(&placed, &ray, 0.0);
            told += assert_same_both_ways(&lathe.both_ways(&seen.line));
            assert_first_found_up_to_a_limit(&mut random, &placed, &ray);
        }
    }
    assert!(told > 2 * tries_in(10), "{told}");
}

/// The control points of a piece that bends away from the axis may lie beyond the axis.
#[test]
fn a_piece_is_met_near_the_axis_though_a_control_point_lies_beyond() {
    let mut random = Random(99);
    let points = [[0.0, -0.7], [0.3, -0.2], [-0.15, 0.2], [0.75, 0.7]];
    let lathe = Lathe::new([vec![Piece::bezier(&points).expect("a cubic")]]).expect("a lathe");
    let placed = placed(&mut random, Body::Lathe(lathe.clone()));
    let (mut told, mut crossed) = (0, 0);
    for _ in 0..tries_in(10) {
        let around = random.direction().get().with_z(0.0).normalize_or(Vector::X);
        let through = around * random.number(0.0, 0.15) + Vector::Z * random.number(-0.7, 0.7);
        let way = Vector::Z + random.point(1.0) * random.size(-6.0, 0.0);
        let Some((ray, _)) = ray_through(&mut random, &placed, through, way) else { continue };
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        told += assert_same_both_ways(&lathe.both_ways(&Seen::new(&placed, &ray, 0.0).line));
    }
    assert!(told > tries_in(20) && crossed > tries_in(20), "{told} {crossed}");
}
