//! What prisms, lathes and surfaces of revolution share in their tests against twice the digits.

use super::lathe::any_lathe;
use super::placed::{Inside, blur, far_off, local_at};
use super::prism::any_prism;
use super::sor::any_sor;
use super::*;
use crate::math::random::tries_in;
use crate::shape::curve::{Outline, Piece, Point, Run};
use crate::shape::local::Local;
use crate::shape::{Body, Placed, Prism};

pub(super) fn one() -> Double {
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

/// Where a piece, which does not turn, is at a height between those of its ends.
fn level(piece: &Piece, height: Double) -> Double {
    let mut u = Double::of(piece.meets(1, height.0));
    for _ in 0..8 {
        let (at, speed) = coordinate(piece, 1, u);
        let step = (height - at) / speed;
        if step.0.abs() < 1e-30 {
            return u;
        }
        if step.0.abs() > 1e-3 || step.0.is_nan() {
            break;
        }
        u = u + step;
    }
    // Where it is nearly level.
    let rises = piece.last()[1] > piece.first()[1];
    let (mut low, mut high) = (Double::of(0.0), one());
    for _ in 0..106 {
        let middle = (low + high) * Double::of(0.5);
        if ((coordinate(piece, 1, middle).0 - height).0 < 0.0) == rises {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Negative inside of an outline; the size is about the distance.
pub(super) fn planar(outline: &Outline, [x, y]: [Double; 2]) -> Double {
    let mut odd = false;
    let mut distance = f64::INFINITY;
    for piece in &outline.pieces {
        let [low, high] = piece.hull();
        let beside = |axis: usize, at: f64| (low[axis] - at).max(at - high[axis]);
        if beside(0, x.0).max(beside(1, y.0)) < distance {
            let ([a, b], _) = piece.nearest([x.0, y.0]);
            distance = distance.min(((a - x.0) * (a - x.0) + (b - y.0) * (b - y.0)).sqrt());
        }
        let above = |end: Point| (Double::of(end[1]) - y).0 > 0.0;
        if above(piece.first()) == above(piece.last()) {
            continue;
        }
        odd ^= (coordinate(piece, 0, level(piece, y)).0 - x).0 > 0.0;
    }
    Double::of(if odd { -distance } else { distance })
}

/// Numbers that meet: few digits, or many.
pub(super) fn number(random: &mut Random, low: f64, high: f64) -> f64 {
    let any = random.number(low, high);
    if random.below(2) == 0 { any } else { (any * 8.0).round() / 8.0 }
}

/// Pieces of a degree through points, which closes.
pub(super) fn loop_of(random: &mut Random, points: &[Point], degree: usize) -> Vec<Piece> {
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

pub(super) fn in_a_line(points: &[Point]) -> bool {
    let [a, b] = points[0];
    let turn = |p: &[Point]| (p[0][0] - a) * (p[1][1] - b) - (p[0][1] - b) * (p[1][0] - a);
    points.windows(2).all(|pair| turn(pair).abs() < 1e-12)
}

pub(super) fn any_outline(random: &mut Random) -> Outline {
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

/// A line through a joint or another place of an outline, along its tangent, or nearly.
pub(super) fn along_outline(random: &mut Random, outline: &Outline) -> (Point, Point) {
    let piece = outline.pieces[random.below(outline.pieces.len())];
    let u = [0.0, 1.0, random.number(0.0, 1.0)][random.below(3)];
    let (at, speed) = piece.at(u);
    let off = [0.0, random.size(-17.0, -1.0)][random.below(2)];
    let way = if random.below(2) == 0 { speed } else { [1.0, 0.0] };
    (at.map(|c| c + off * random.number(-1.0, 1.0)), way)
}

/// From near or far, through a local point; and whether from near.
pub(super) fn ray_through(
    random: &mut Random,
    placed: &Placed,
    through: Vector,
    way: Vector,
) -> Option<(Ray, bool)> {
    let way = UnitVector::from_direction(way)?.get();
    let far = [3.0, far_off(random, placed)][random.below(2)];
    let [from, to] = [through - way * far, through].map(|p| placed.placement.world_point(p));
    let ray = Ray { origin: from, direction: UnitVector::from_direction(to - from)?.get() };
    Some((ray, far <= 3.0))
}

/// Where it is crossed, there is only one wall; or two at their joint, if those count as one. Not so where an
/// outline touches itself.
pub(super) fn is_clear(placed: &Placed, ray: &Ray, joints: bool) -> bool {
    let speed = placed.placement.local_direction(ray.direction).length();
    let clear = |outline: &Outline, place: Point, off: f64| {
        let near = |i: &usize| {
            let ([a, b], _) = outline.pieces[*i].nearest(place);
            (a - place[0]).abs().max((b - place[1]).abs()) < 1e-9 + off
        };
        let near: Vec<usize> = (0..outline.pieces.len()).filter(near).collect();
        let in_a_row = |Run { from, to, .. }: &Run, i: usize, j: usize| {
            let holds = |i: usize| (*from..*to).contains(&i);
            holds(i) && holds(j) && (i + 1 == j || (i == *from && j + 1 == *to))
        };
        match near[..] {
            [] | [_] => true,
            [i, j] => joints && outline.runs.iter().any(|run| in_a_row(run, i, j)),
            _ => false,
        }
    };
    placed.crossings(ray).iter().all(|met| {
        // The world's point is rounded, too.
        let rounded = placed.placement.local_from_world.abs() * ray.at(met.t).abs() * (8.0 * EPS);
        let off = 4.0 * met.error * speed + blur(placed, ray) + rounded.length();
        let [x, y, z] = local_at(placed, ray, met.t, 0.0).map(|c| c.0);
        match &*placed.body {
            Body::Prism(Prism { outline, conic, .. }) => {
                let scale = if *conic { z } else { 1.0 };
                clear(outline, [x / scale, y / scale], off / scale.abs())
            }
            Body::Lathe(lathe) => {
                // On the axis a wall meets itself.
                let x = (x * x + y * y).sqrt();
                (joints || x > 1e-9 + off) && clear(lathe.outline(), [x, z], off)
            }
            Body::Text(text) => text.outlines().all(|outline| clear(outline, [x, y], off)),
            _ => true,
        }
    })
}

/// On a part of its way, rounding does not tell on which side of the surface it is.
pub(super) fn goes_along(placed: &Placed, ray: &Ray, inside: Inside) -> bool {
    let near = placed.placement.local_point(ray.origin);
    let step = placed.placement.local_direction(ray.direction);
    let middle = -near.dot(step) / step.length_squared();
    let off = 16.0 * blur(placed, ray);
    let is_near = |i: &i32| {
        let t = middle + f64::from(*i) / 50.0 / step.length();
        inside(&placed.body, local_at(placed, ray, t, 0.0)).0.abs() <= off
    };
    (-75..=75).filter(is_near).count() >= 2
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

/// Also beside the control points of a piece, which may go on where it has turned back.
#[test]
fn a_place_is_inside_of_an_outline_where_twice_the_digits_have_it() {
    let mut random = Random(98);
    for _ in 0..tries_in(1000) {
        let outline = any_outline(&mut random);
        for _ in 0..20 {
            let piece = &outline.pieces[random.below(outline.pieces.len())];
            let [low, high] = piece.hull();
            let place = [random.number(-1.0, high[0]), random.number(low[1], high[1])];
            let told = planar(&outline, place.map(Double::of)).0;
            if told.abs() > 1e-9 {
                assert_eq!(outline.contains(place), told < 0.0, "{place:?} {outline:?}");
            }
        }
    }
}

/// Asserts that crossings which are isolated are those which are walked to, given positions and errors.
pub(super) fn assert_same_both_ways([isolated, walked]: &[Option<Vec<(f64, f64)>>; 2]) -> usize {
    let (Some(isolated), Some(walked)) = (isolated, walked) else { return 0 };
    // What is beyond any body may be there or at infinity.
    let is_near = |found: &&(f64, f64)| found.0.abs() < 2.0;
    let [isolated, walked] =
        [isolated, walked].map(|all| all.iter().filter(is_near).collect::<Vec<_>>());
    assert_eq!(isolated.len(), walked.len(), "{isolated:?} {walked:?}");
    for ((one, error), (other, room)) in isolated.iter().zip(&walked) {
        assert!((one - other).abs() <= error + room, "{isolated:?} {walked:?}");
    }
    1
}
