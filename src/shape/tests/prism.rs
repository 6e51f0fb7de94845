//! Prisms against twice the digits.

use super::lathe::any_lathe;
use super::outline::{
    along_outline, any_outline, assert_same_both_ways, goes_along, is_clear, one, planar,
    ray_through,
};
use super::placed::{
    assert_crossed_where_it_is, assert_first_found_up_to_a_limit, assert_inside_where_it_says,
    assert_left_into_the_open, blur, greater, placed, ray_at_placed, stand,
};
use super::sor::any_sor;
use super::*;
use crate::math::random::tries_in;
use crate::shape::Superellipsoid;
use crate::shape::curve::{Outline, Piece};
use crate::shape::exact::Triple;
use crate::shape::local::{Crossings, Height, Local, Met};
use crate::shape::seen::Seen;
use crate::shape::slab::NUDGE;

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

/// Corners on a grid, so that much is in line with much.
fn on_a_grid(random: &mut Random) -> Outline {
    let grid = [-0.5, -0.25, 0.0, 0.25, 0.5];
    let corners: Vec<[f64; 2]> =
        (0..3 + random.below(4)).map(|_| [0; 2].map(|_| grid[random.below(grid.len())])).collect();
    let closed = corners.iter().cycle().take(corners.len() + 1);
    let closed: Vec<[f64; 2]> = closed.copied().collect();
    let mut outline = Outline::default();
    outline.add(closed.windows(2).map(|pair| Piece::line(pair[0], pair[1])));
    outline
}

/// A line in the plane of a wall: through a place of it, or beside it; along its lines, or across.
fn in_a_wall(random: &mut Random, prism: &Prism) -> Option<(Vector, Vector)> {
    let piece = prism.outline.pieces.get(random.below(prism.outline.pieces.len().max(1)))?;
    let ([a, b], [c, d]) = (piece.first(), piece.last());
    let (along, share) = ([-1.0, 0.0, 0.5, 1.0][random.below(4)], random.below(5) as f64 / 4.0);
    let up = [-1.0, 0.0, 1.0][random.below(3)];
    let across = Vector::new(c - a, d - b, 0.0);
    let (corner, line) = match prism.conic {
        true => (Vector::ZERO, Vector::new(a, b, 1.0) + across * share),
        false => (Vector::new(a, b, 0.0) + across * share, Vector::Z),
    };
    let through = corner + line * [0.0, 0.5, 0.75, 1.0][random.below(4)];
    let way = UnitVector::from_direction(line * up + across * along)?.get();
    Some((through, way))
}

/// The line a little to the side that all are taken to be on.
fn moved(ray: &Ray, far: f64) -> Ray {
    Ray { origin: ray.origin + NUDGE * far, direction: ray.direction }
}

/// Without parts that are nothing, and ways that are none between parts.
fn without_nothings(all: Crossings) -> Crossings {
    let mut kept = Crossings::new();
    for met in all {
        match kept.last() {
            Some(last) if met.t - last.t < 1e-5 => drop(kept.pop()),
            _ => kept.push(met),
        }
    }
    kept
}

#[test]
fn a_line_in_a_wall_is_crossed_as_one_a_little_to_its_side() {
    let mut random = Random(95);
    let mut held = 0;
    for _ in 0..tries_in(20) {
        let conic = random.below(2) == 0;
        let heights = match conic {
            true => [[0.0, 1.0], [0.5, 1.0], [-1.0, 1.0]][random.below(3)],
            false => [-1.0, 1.0],
        };
        let prism = Prism { outline: on_a_grid(&mut random), conic, heights, open: false };
        let Some((through, way)) = in_a_wall(&mut random, &prism) else { continue };
        // What lies in an end as well is not asked of walls alone.
        if way.z == 0.0 && heights.contains(&through.z) {
            continue;
        }
        let matrix = [Matrix::IDENTITY, random.matrix()][random.below(2)];
        let placement = Placement {
            centre: random.point(3.0) * random.below(2) as f64,
            world_from_local: matrix,
            local_from_world: matrix.inverse(),
        };
        let body = std::sync::Arc::new(Body::Prism(prism));
        let placed = stand(body, placement);
        let origin = placement.world_point(through - way * [0.0, 3.0, 8.0][random.below(3)]);
        let Some(direction) = UnitVector::from_direction(matrix * way) else { continue };
        let ray = Ray { origin, direction: direction.get() };
        let beside = |far: f64| placed.crossings(&moved(&ray, far));
        let is_same = |one: &Crossings, other: &Crossings| {
            let near = |a: &Met, b: &Met| a.t == b.t || (a.t - b.t).abs() <= 1e-3;
            one.len() == other.len() && one.iter().zip(other).all(|(a, b)| near(a, b))
        };
        let (near, far) = (beside(1e-7), beside(1e-6));
        // What is so short depends on how far beside it is.
        let is_short = |pair: &[Met]| pair[1].t - pair[0].t < 0.03;
        if [&near, &far].iter().any(|met| met.windows(2).any(is_short)) || !is_same(&near, &far) {
            continue;
        }
        let found = without_nothings(placed.crossings(&ray));
        assert!(is_same(&found, &near), "{ray:?} {found:?} {near:?} {placed:?}");
        for met in found.iter().filter(|met| met.t.is_finite()) {
            let off = placed.surface(&ray, met.t, met.leaving).point - ray.origin;
            let across = off - ray.direction * off.dot(ray.direction);
            assert!(across.length() < 1e-4, "{ray:?} {met:?} {across:?} {placed:?}");
        }
        held += usize::from(!is_same(&near, &beside(-1e-7)));
    }
    assert!(held > tries_in(200), "{held}");
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

#[test]
fn crossings_with_a_prism_that_are_isolated_are_those_that_are_walked_to() {
    let mut random = Random(98);
    let mut told = 0;
    for _ in 0..tries_in(10) {
        let prism = any_prism(&mut random);
        let placed = placed(&mut random, Body::Prism(prism.clone()));
        for _ in 0..4 {
            let ray = ray_at_placed(&mut random, &placed);
            let seen = Seen::new(&placed, &ray, 0.0);
            told += assert_same_both_ways(&prism.both_ways(&seen.line));
            assert_first_found_up_to_a_limit(&mut random, &placed, &ray);
        }
    }
    assert!(told > 2 * tries_in(10), "{told}");
}
