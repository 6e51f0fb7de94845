//! Prisms, lathes and surfaces of revolution against twice the digits.

use super::placed::{
    Inside, assert_crossed_where_it_is, assert_left_into_the_open, blur, greater, local_at, placed,
    ray_at_placed,
};
use super::*;
use crate::math::random::tries_in;
use crate::shape::body::{Local, Met};
use crate::shape::curve::{Outline, Piece, Point};
use crate::shape::exact::Triple;
use crate::shape::sor::Segment;
use crate::shape::{Body, Lathe, Placed, Prism, Sor};

fn one() -> Double {
    Double::of(1.0)
}

/// A coordinate of a piece at u, and its speed there.
fn coordinate(piece: &Piece, axis: usize, u: Double) -> (Double, Double) {
    let mut points: Vec<Double> = piece.points().iter().map(|p| Double::of(p[axis])).collect();
    while points.len() > 2 {
        points = points.windows(2).map(|pair| (one() - u) * pair[0] + u * pair[1]).collect();
    }
    let degree = Double::of((piece.points().len() - 1) as f64);
    ((one() - u) * points[0] + u * points[1], degree * (points[1] - points[0]))
}

/// Negative inside of an outline; the size is about the distance.
fn planar(outline: &Outline, [x, y]: [Double; 2]) -> Double {
    let mut odd = false;
    let mut distance = f64::INFINITY;
    for piece in &outline.pieces {
        let ([a, b], _) = piece.nearest([x.0, y.0]);
        distance = distance.min(((a - x.0) * (a - x.0) + (b - y.0) * (b - y.0)).sqrt());
        let above = |end: Point| (Double::of(end[1]) - y).0 > 0.0;
        if above(piece.first()) == above(piece.last()) {
            continue;
        }
        let mut u = Double::of(piece.meets(1, y.0));
        for _ in 0..24 {
            let (at, speed) = coordinate(piece, 1, u);
            let step = (y - at) / speed;
            if step.0.abs() < 1e-6 {
                u = u + step;
            }
        }
        odd ^= (coordinate(piece, 0, u).0 - x).0 > 0.0;
    }
    Double::of(if odd { -distance } else { distance })
}

fn prism(body: &Body, [x, y, z]: Triple) -> Double {
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

fn lathe(body: &Body, [x, y, z]: Triple) -> Double {
    let Body::Lathe(lathe) = body else { panic!("{body:?}") };
    planar(lathe.outline(), [(x * x + y * y).sqrt(), z])
}

fn sor(body: &Body, [x, y, z]: Triple) -> Double {
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

/// Numbers that meet: few digits, or many.
fn number(random: &mut Random, low: f64, high: f64) -> f64 {
    let any = random.number(low, high);
    if random.below(2) == 0 { any } else { (any * 8.0).round() / 8.0 }
}

/// Pieces of a degree through points, which closes.
fn loop_of(random: &mut Random, points: &[Point], degree: usize) -> Vec<Piece> {
    let count = points.len();
    let lean = |random: &mut Random, at: Point| {
        let size = [0.0, 0.2, 0.6][random.below(3)];
        at.map(|c| (c + size * random.number(-1.0, 1.0)).clamp(-0.9, 0.9))
    };
    let piece = |i: usize, random: &mut Random| {
        let (from, to) = (points[i], points[(i + 1) % count]);
        let between: Vec<Point> = (1..degree).map(|_| lean(random, from)).collect();
        let mut all = vec![from];
        all.extend(between);
        all.push(to);
        Piece::bezier(&all).expect("two to four points")
    };
    (0..count).map(|i| piece(i, random)).collect()
}

fn in_a_line(points: &[Point]) -> bool {
    let [a, b] = points[0];
    let turn = |p: &[Point]| (p[0][0] - a) * (p[1][1] - b) - (p[0][1] - b) * (p[1][0] - a);
    points.windows(2).all(|pair| turn(pair).abs() < 1e-12)
}

fn any_outline(random: &mut Random) -> Outline {
    let mut outline = Outline::default();
    while outline.pieces.is_empty() {
        for _ in 0..1 + random.below(2) {
            let size = [0.9, 0.5, random.size(-6.0, 0.0) * 0.5][random.below(3)];
            let centre = [0.0; 2].map(|_| random.number(-1.0, 1.0) * (0.9 - size).max(0.0));
            let count = 3 + random.below(4);
            let point = |random: &mut Random| {
                let p = [0.0; 2].map(|_| 0.7 * size * number(random, -1.0, 1.0));
                [centre[0] + p[0], centre[1] + p[1]]
            };
            let points: Vec<Point> = (0..count).map(|_| point(random)).collect();
            let degree = 1 + random.below(3);
            if degree == 1 && in_a_line(&points) {
                continue;
            }
            let pieces = loop_of(random, &points, degree);
            outline.add(pieces);
        }
    }
    outline
}

fn any_prism(random: &mut Random) -> Prism {
    let conic = random.below(2) == 0;
    let heights = match (conic, random.below(3)) {
        (false, _) => [-1.0, 1.0],
        (true, 0) => [0.0, 1.0],
        (true, 1) => [-random.number(0.0, 1.0), 1.0],
        (true, _) => [random.number(0.1, 0.9), 1.0],
    };
    Prism { outline: any_outline(random), conic, heights, open: random.below(4) == 0 }
}

/// A line through a joint or another place of an outline, along its tangent, or nearly.
fn along_outline(random: &mut Random, outline: &Outline) -> (Point, Point) {
    let piece = outline.pieces[random.below(outline.pieces.len())];
    let u = [0.0, 1.0, random.number(0.0, 1.0)][random.below(3)];
    let (at, speed) = piece.at(u);
    let off = [0.0, random.size(-17.0, -1.0)][random.below(2)];
    let way = if random.below(2) == 0 { speed } else { [1.0, 0.0] };
    (at.map(|c| c + off * random.number(-1.0, 1.0)), way)
}

/// From near or far, through a local point; and whether from near.
fn ray_through(
    random: &mut Random,
    placed: &Placed,
    through: Vector,
    way: Vector,
) -> Option<(Ray, bool)> {
    let way = UnitVector::from_direction(way)?.get();
    let far = [3.0, random.size(0.0, 6.0)][random.below(2)];
    let [from, to] = [through - way * far, through].map(|p| placed.placement.world_point(p));
    let ray = Ray { origin: from, direction: UnitVector::from_direction(to - from)?.get() };
    Some((ray, far <= 3.0))
}

/// Where it is crossed, only one wall is there, or two at their joint: not those of an outline that touches
/// itself.
fn is_clear(placed: &Placed, ray: &Ray) -> bool {
    let clear = |outline: &Outline, place: Point| {
        let near = |i: &usize| {
            let ([a, b], _) = outline.pieces[*i].nearest(place);
            (a - place[0]).abs().max((b - place[1]).abs()) < 1e-9
        };
        (0..outline.pieces.len()).filter(near).count() <= 1
    };
    placed.crossings(ray).iter().all(|met| {
        let [x, y, z] = local_at(placed, ray, met.t, 0.0).map(|c| c.0);
        match &*placed.body {
            Body::Prism(Prism { outline, conic, .. }) => {
                let scale = if *conic { z } else { 1.0 };
                clear(outline, [x / scale, y / scale])
            }
            Body::Lathe(lathe) => clear(lathe.outline(), [(x * x + y * y).sqrt(), z]),
            _ => true,
        }
    })
}

/// On a part of its way, rounding does not tell on which side of the surface it is.
fn goes_along(placed: &Placed, ray: &Ray, inside: Inside) -> bool {
    let near = placed.placement.local_point(ray.origin);
    let step = placed.placement.local_direction(ray.direction);
    let middle = -near.dot(step) / step.length_squared();
    let off = 16.0 * blur(placed, ray);
    let is_near = |i: &i32| {
        let t = middle + f64::from(*i) / 50.0 / step.length();
        inside(&placed.body, local_at(placed, ray, t, 0.0)).0.abs() <= off
    };
    // A crossing that is told is far off the surface soon after, and was so before.
    let untold = |met: &Met| {
        let height = |more: f64| inside(&placed.body, local_at(placed, ray, met.t, more)).0.abs();
        height(64.0 * met.error) <= off || height(-64.0 * met.error) <= off
    };
    (-75..=75).filter(is_near).count() >= 2 || placed.crossings(ray).iter().any(untold)
}

#[test]
fn a_prism_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(91);
    let mut crossed = 0;
    for _ in 0..tries_in(100) {
        let body = Body::Prism(any_prism(&mut random));
        let placed = placed(&mut random, body);
        for _ in 0..3 {
            let ray = ray_at_placed(&mut random, &placed);
            crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, prism);
            if is_clear(&placed, &ray) {
                assert_left_into_the_open(&mut random, &placed, &ray, prism);
            }
        }
    }
    assert!(crossed > tries_in(100), "{crossed}");
}

#[test]
fn a_prism_is_crossed_where_a_ray_meets_its_edges_goes_along_its_walls_or_through_its_tip() {
    let mut random = Random(92);
    let mut crossed = 0;
    for _ in 0..tries_in(100) {
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
        if goes_along(&placed, &ray, prism) {
            assert_eq!(placed.crossings(&ray).len() % 2, 0);
            continue;
        }
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, prism);
        // From afar, a place on an edge may lie beyond it, by as much as the line is blurred.
        if near {
            if is_clear(&placed, &ray) {
                assert_left_into_the_open(&mut random, &placed, &ray, prism);
            }
        }
    }
    assert!(crossed > tries_in(1000), "{crossed}");
}

fn any_lathe(random: &mut Random) -> Lathe {
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
    for _ in 0..tries_in(100) {
        let body = Body::Lathe(any_lathe(&mut random));
        let placed = placed(&mut random, body);
        for _ in 0..3 {
            let ray = ray_at_placed(&mut random, &placed);
            crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, lathe);
            if is_clear(&placed, &ray) {
                assert_left_into_the_open(&mut random, &placed, &ray, lathe);
            }
        }
    }
    assert!(crossed > tries_in(100), "{crossed}");
}

#[test]
fn a_lathe_is_crossed_where_a_ray_is_level_upright_grazes_it_or_meets_its_axis() {
    let mut random = Random(94);
    let mut crossed = 0;
    for _ in 0..tries_in(100) {
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
        if goes_along(&placed, &ray, lathe) {
            assert_eq!(placed.crossings(&ray).len() % 2, 0);
            continue;
        }
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, lathe);
        // From afar, a place on an edge may lie beyond it, by as much as the line is blurred.
        if near {
            if is_clear(&placed, &ray) {
                assert_left_into_the_open(&mut random, &placed, &ray, lathe);
            }
        }
    }
    assert!(crossed > tries_in(1000), "{crossed}");
}

fn any_sor(random: &mut Random) -> Sor {
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
    for _ in 0..tries_in(100) {
        let body = Body::Sor(any_sor(&mut random));
        let placed = placed(&mut random, body);
        for _ in 0..4 {
            let ray = ray_at_placed(&mut random, &placed);
            crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, sor);
            assert_left_into_the_open(&mut random, &placed, &ray, sor);
        }
    }
    assert!(crossed > tries_in(100), "{crossed}");
}

#[test]
fn a_sor_is_crossed_where_a_ray_is_level_upright_grazes_it_or_meets_its_axis() {
    let mut random = Random(96);
    let mut crossed = 0;
    for _ in 0..tries_in(50) {
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
        if goes_along(&placed, &ray, sor) {
            assert_eq!(placed.crossings(&ray).len() % 2, 0);
            continue;
        }
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, sor);
        // From afar, a place on an edge may lie beyond it, by as much as the line is blurred.
        if near {
            assert_left_into_the_open(&mut random, &placed, &ray, sor);
        }
    }
    assert!(crossed > tries_in(1000), "{crossed}");
}

/// Straight walls, a conic one among them, a lathe and a sor are as wide as the points on them.
#[test]
fn bodies_of_outlines_reach_as_far_as_their_surface_and_hardly_farther() {
    let mut random = Random(97);
    for _ in 0..tries_in(1000) {
        let bodies = [
            Body::Prism(any_prism(&mut random)),
            Body::Lathe(any_lathe(&mut random)),
            Body::Sor(any_sor(&mut random)),
        ];
        for body in bodies {
            let along = random.direction().get();
            let (low, high) = body.extent(along);
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            let mut hold = |place: Vector| {
                least = least.min(along.dot(place));
                most = most.max(along.dot(place));
                assert!(place.length() <= body.reach() * (1.0 + 4.0 * EPS), "{place} {body:?}");
            };
            let out = Vector::new(along.x, along.y, 0.0).normalize_or(Vector::X);
            for i in 0..=256 {
                let u = f64::from(i) / 256.0;
                match &body {
                    Body::Prism(prism) => {
                        for piece in &prism.outline.pieces {
                            let [x, y] = piece.at(u).0;
                            for z in prism.heights {
                                let scale = if prism.conic { z } else { 1.0 };
                                hold(Vector::new(x * scale, y * scale, z));
                            }
                        }
                    }
                    Body::Lathe(lathe) => {
                        for piece in lathe.outline().pieces.iter().filter(|piece| piece.seen) {
                            let [x, z] = piece.at(u).0;
                            hold(out * x + Vector::Z * z);
                            hold(-out * x + Vector::Z * z);
                        }
                    }
                    Body::Sor(sor) => {
                        let z = 2.0 * u - 1.0;
                        hold(out * sor.radius(z) + Vector::Z * z);
                        hold(-out * sor.radius(z) + Vector::Z * z);
                    }
                    _ => {}
                }
            }
            assert!(low <= least + 4.0 * EPS && most <= high + 4.0 * EPS, "{along} {body:?}");
            let loose = if matches!(body, Body::Sor(_)) { 0.1 } else { 1e-2 };
            assert!(least - low < loose && high - most < loose, "{along} {body:?}");
        }
    }
}
