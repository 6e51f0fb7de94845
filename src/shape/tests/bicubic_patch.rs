//! Bézier patches against exact arithmetic, at their edges and tips, and along them.

use super::placed::{
    assert_crossed_where_it_is, assert_first_found_up_to_a_limit, at_the_origin, blur, local_at,
    placed, ray_at_placed,
};
use super::*;
use crate::shape::exact::Triple;
use crate::shape::local::{Local, LocalRay, Met};

/// z over the square from −0.75 to 0.75 as a polynomial: what the corners are is exact.
fn hill(random: &mut Random) -> BicubicPatch {
    let steepness = [0.0, 1.0, random.size(-9.0, 0.0)][random.below(3)];
    BicubicPatch::new(std::array::from_fn(|i| {
        let place = |i: usize| (i as f64 - 1.5) * 0.5;
        Vector::new(place(i % 4), place(i / 4), random.number(-0.5, 0.5) * steepness)
    }))
}

fn place_in(patch: &BicubicPatch, [x, y, z]: Triple) -> (Double, Double, Double) {
    let place = |x: Double| (x + Double::of(0.75)) / Double::of(1.5);
    let (u, v) = (place(x), place(y));
    let weights = |t: Double| {
        let (r, three) = (Double::of(1.0) - t, Double::of(3.0));
        [r * r * r, three * r * r * t, three * r * t * t, t * t * t]
    };
    let (across, down) = (weights(u), weights(v));
    let mut height = Double::of(0.0);
    for (i, point) in patch.points().iter().enumerate() {
        height = height + Double::of(point.z) * across[i % 4] * down[i / 4];
    }
    (u, v, z - height)
}

fn over_hill(body: &Body, point: Triple) -> Double {
    let Body::BicubicPatch(patch) = body else { panic!("{body:?}") };
    // Its normal is v × u, which points down.
    -place_in(patch, point).2
}

#[test]
fn a_patch_is_met_where_exact_arithmetic_meets_it_and_as_often() {
    let mut random = Random(93);
    let (mut met, mut looked) = (0, 0);
    for _ in 0..tries() {
        let patch = hill(&mut random);
        let placed = placed(&mut random, Body::BicubicPatch(patch));
        let ray = ray_at_placed(&mut random, &placed);
        met += assert_crossed_where_it_is(&mut random, &placed, &ray, over_hill);
        assert_first_found_up_to_a_limit(&mut random, &placed, &ray);
        // Of the line's part above and below the square, each hand of each crossing is told by the ones
        // before.
        let all = placed.crossings(&ray);
        let (start, step) = (
            placed.placement.local_point(ray.origin),
            placed.placement.local_direction(ray.direction),
        );
        let chord = |start: f64, step: f64| {
            let (a, b) = ((-0.75 - start) / step, (0.75 - start) / step);
            (a.min(b), a.max(b))
        };
        let ((a, b), (c, d)) = (chord(start.x, step.x), chord(start.y, step.y));
        let (first, last) = (a.max(c), b.min(d));
        if first >= last || !last.is_finite() || !first.is_finite() {
            continue;
        }
        let height = |t: f64| over_hill(&placed.body, local_at(&placed, &ray, t, 0.0)).0;
        let off = blur(&placed, &ray);
        let clear = |t: f64| all.iter().all(|met| (met.t - t).abs() > met.error);
        let begin = first + (last - first) * 1e-9;
        // What goes along the surface is not told.
        if height(begin).abs() <= off.sqrt() || !clear(begin) {
            continue;
        }
        let count = |t: f64| all.iter().filter(|met| begin < met.t && met.t < t).count();
        for _ in 0..8 {
            let t = begin + (last - begin) * random.number(0.0, 1.0);
            if height(t).abs() > off.sqrt() && clear(t) {
                let turned = (height(t) < 0.0) != (height(begin) < 0.0);
                assert_eq!(count(t) % 2 == 1, turned, "{t} {all:?} {placed:?} {ray:?}");
                looked += 1;
            }
        }
    }
    assert!(met > tries() / 4 && looked > tries() / 4, "{met} {looked}");
}

fn any_patch(random: &mut Random) -> BicubicPatch {
    let tip = random.direction().get();
    let has_tip = random.below(3) == 0;
    BicubicPatch::new(std::array::from_fn(|i| {
        let flat = Vector::new((i % 4) as f64 - 1.5, (i / 4) as f64 - 1.5, 0.0) * 0.5;
        if has_tip && i < 4 { tip } else { flat + random.direction().get() * 0.4 }
    }))
}

/// The crossings of a line aimed at a place of the patch include one there.
#[test]
fn a_line_through_a_place_of_a_patch_meets_it_there_even_on_its_edges_and_tips() {
    let mut random = Random(94);
    let (mut aslant, lines) = (0, 5);
    for _ in 0..tries_in(4 * lines) {
        let patch = any_patch(&mut random);
        let placed = at_the_origin(placed(&mut random, Body::BicubicPatch(patch)));
        for _ in 0..lines {
            aslant += usize::from(is_met_at_a_place_of_it(&mut random, &placed));
        }
    }
    assert!(aslant > tries() / 8, "{aslant}");
}

/// `false` where the line is too much along the surface to be sure to meet it.
fn is_met_at_a_place_of_it(random: &mut Random, placed: &Placed) -> bool {
    let Body::BicubicPatch(patch) = &*placed.body else { panic!() };
    let place = |random: &mut Random| [0.0, 1.0, 0.5, random.number(0.0, 1.0)][random.below(4)];
    let (u, v) = (place(random), place(random));
    let (point, normal) = patch.at(u, v);
    let target = placed.placement.world_point(point);
    let origin = placed.placement.world_point(random.direction().get() * random.size(0.5, 9.0));
    let Some(direction) = UnitVector::from_direction(target - origin) else { return false };
    let ray = Ray { origin, direction: direction.get() };
    let local = placed.placement.local_direction(ray.direction).normalize();
    // A line along the surface may miss it: one at the angle θ is within θ² of a tangent.
    let grazing = (256.0 * blur(placed, &ray)).sqrt().max(1e-4);
    if local.dot(normal).abs() < grazing {
        return false;
    }
    let t = (target - origin).length();
    let all = placed.crossings(&ray);
    let near = |met: &Met| (met.t - t).abs() <= met.error + 8.0 * EPS * t;
    let met = all.iter().find(|met| near(met));
    let met = met.unwrap_or_else(|| panic!("{t} {all:?} {placed:?} {ray:?} {u} {v}"));
    // And the surface there is the patch's.
    let surface = placed.surface(&ray, met.t, met.leaving);
    let off = placed.placement.local_point(surface.point) - point;
    let allowed = 1e-9 + 1e3 * blur(placed, &ray);
    assert!(off.dot(normal).abs() < allowed, "{off} {placed:?} {ray:?}");
    true
}

#[test]
fn the_bounds_of_a_patch_are_tight_and_hold_it() {
    let mut random = Random(95);
    for _ in 0..tries() / 20 {
        let patch = any_patch(&mut random);
        let along = random.direction().get();
        let (low, high) = patch.extent(along);
        let mut most = f64::NEG_INFINITY;
        for i in 0..=64 {
            for j in 0..=64 {
                let (point, _) = patch.at(f64::from(i) / 64.0, f64::from(j) / 64.0);
                assert!(low <= point.dot(along) && point.dot(along) <= high, "{patch:?}");
                most = most.max(point.dot(along));
            }
        }
        assert!(high - most < 0.01, "{high} {most} {patch:?}");
    }
}

/// Steps of halving that a line takes which lies in the surface, or touches it along a curve.
#[test]
fn a_line_along_a_patch_ends() {
    let flat = |f: fn(f64, f64) -> f64| {
        BicubicPatch::new(std::array::from_fn(|i| {
            let (x, y) = ((i % 4) as f64 - 1.5, (i / 4) as f64 - 1.5);
            Vector::new(x, y, f(x, y)) * 0.5
        }))
    };
    let ray = |direction: Vector| LocalRay {
        nearest: Vector::ZERO,
        direction: direction.normalize(),
        blur: 1e-15,
        turn: 1e-15,
        tolerance: 0.0,
        in_world: None,
    };
    for patch in [flat(|_, _| 0.0), flat(|x, y| x * y), flat(|x, _| x * x), flat(|x, _| x * x * x)]
    {
        for direction in [Vector::X, Vector::Y, Vector::new(1.0, 1e-9, 0.0), Vector::ONE] {
            let mut found = Default::default();
            patch.crossings(&ray(direction), &mut found);
            assert!(found.len() <= 9, "{found:?}");
        }
    }
}
