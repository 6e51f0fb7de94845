//! Prisms against twice the digits.

use super::lathe::any_lathe;
use super::outline::{along_outline, any_outline, goes_along, is_clear, one, planar, ray_through};
use super::placed::{
    assert_crossed_where_it_is, assert_inside_where_it_says, assert_left_into_the_open, blur,
    greater, placed, ray_at_placed,
};
use super::sor::any_sor;
use super::*;
use crate::math::random::tries_in;
use crate::shape::Superellipsoid;
use crate::shape::body::{Height, Local, Met};
use crate::shape::exact::Triple;

fn inside(body: &Body, [x, y, z]: Triple) -> Double {
    let Body::Prism(Prism { outline, conic, heights: [low, high], .. }) = body else {
        panic!("{body:?}")
    };
    let scale = if *conic { z } else { one() };
    let ends = greater(z - Double::of(*high), Double::of(*low) - z);
    if scale.0 == 0.0 {
        return greater(ends, Double::of(0.0));
    }
    greater(ends, planar(outline, [x / scale, y / scale]) * scale.abs())
}

pub(super) fn any_prism(random: &mut Random) -> Prism {
    let conic = random.below(2) == 0;
    let heights = match (conic, random.below(3)) {
        (false, _) => [-1.0, 1.0],
        (true, 0) => [0.0, 1.0],
        (true, 1) => [-random.number(0.0, 1.0), 1.0],
        (true, _) => [random.number(0.1, 0.9), 1.0],
    };
    Prism { outline: any_outline(random), conic, heights, open: random.below(4) == 0 }
}

#[test]
fn a_prism_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(91);
    let mut crossed = 0;
    for _ in 0..tries_in(30) {
        let body = Body::Prism(any_prism(&mut random));
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

/// Whether rounding hardly tells a line from one in a straight wall: it is taken to pass on one side of it.
fn lies_in_a_wall(placed: &Placed, ray: &Ray) -> bool {
    let Body::Prism(prism) = &*placed.body else { return false };
    let near = placed.placement.local_point(ray.origin);
    let step = placed.placement.local_direction(ray.direction).normalize();
    let off = 16.0 * blur(placed, ray);
    let is_beside = |&[x, y]: &[f64; 2]| {
        let (way, gap) = match prism.conic {
            true => (Vector::new(x, y, 1.0), -near),
            false => (Vector::Z, Vector::new(x, y, 0.0) - near),
        };
        gap.dot(step.cross(way)).abs() <= off * way.length()
    };
    let straight = prism.outline.pieces.iter().filter(|piece| piece.is_straight());
    straight.into_iter().any(|piece| piece.points().iter().all(is_beside))
}

#[test]
fn a_prism_is_crossed_where_a_ray_meets_its_edges_goes_along_its_walls_or_through_its_tip() {
    let mut random = Random(92);
    let mut crossed = 0;
    for _ in 0..tries_in(30) {
        let body = any_prism(&mut random);
        let ([x, y], [a, b]) = along_outline(&mut random, &body.outline);
        let z = [body.heights[0], body.heights[1], random.number(-1.0, 1.0)][random.below(3)];
        let scale = if body.conic { z } else { 1.0 };
        let place = Vector::new(x * scale, y * scale, z);
        let up = if body.conic { Vector::new(x, y, 1.0) } else { Vector::Z };
        let off = random.direction().get() * [0.0, random.size(-17.0, 0.0)][random.below(2)];
        let (through, way) = match random.below(4) {
            0 => (place, Vector::new(a, b, [0.0, random.number(-1.0, 1.0)][random.below(2)])),
            1 => (place, up + off),
            2 => (place, random.direction().get()),
            _ => (off, random.direction().get() * 0.5 + Vector::Z),
        };
        let placed = placed(&mut random, Body::Prism(body));
        let Some((ray, near)) = ray_through(&mut random, &placed, through, way) else { continue };
        if goes_along(&placed, &ray, inside) || lies_in_a_wall(&placed, &ray) {
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

/// Also what is not there to be seen, of which its owner may be asked.
#[test]
fn whatever_number_a_part_has_it_has_a_height() {
    let mut random = Random(94);
    for _ in 0..tries_in(10) {
        let bodies = [
            Body::Prism(any_prism(&mut random)),
            Body::Lathe(any_lathe(&mut random)),
            Body::Sor(any_sor(&mut random)),
            Body::Superellipsoid(Superellipsoid::new(0.3, 3.0)),
        ];
        for (body, part) in bodies.iter().flat_map(|body| {
            [0, 1, 2, 3, 1000, Met::UNSEEN / 2, Met::UNSEEN - 1, Met::UNSEEN]
                .map(|part| (body, part))
        }) {
            let Height { value, gradient, .. } = body.height(part, random.point(1.0));
            assert!(value.is_finite() && gradient.is_finite(), "{part} {body:?}");
        }
    }
}
