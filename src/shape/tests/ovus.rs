//! Eggs against twice the digits.

use super::placed::{
    assert_crossed_where_it_is, assert_left_where_it_is, far_off, placed, ray_at_placed,
};
use super::*;
use crate::math::double;
use crate::shape::exact::Triple;
use crate::shape::local::Local;
use crate::shape::{Body, Ovus};

fn inside(body: &Body, point: Triple) -> Double {
    let Body::Ovus(ovus) = body else { panic!("{body:?}") };
    ovus.exactly(point)
}

/// From one ball to another, with either nearly hidden in the other.
fn any_ovus(random: &mut Random) -> Ovus {
    let share = match random.below(5) {
        0 => random.size(-12.0, 0.0),
        1 => 2.0 - random.size(-12.0, 0.0),
        2 => [0.5, 1.0, 1.5][random.below(3)],
        _ => random.number(0.0, 2.0),
    };
    let size = random.size(-12.0, 12.0);
    Ovus::new(double::Double::from(size), double::Double::from(size * share))
}

#[test]
fn an_ovus_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(61);
    let mut crossed = 0;
    for _ in 0..tries() {
        let body = Body::Ovus(any_ovus(&mut random));
        let placed = placed(&mut random, body);
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        assert_left_where_it_is(&mut random, &placed, &ray, inside);
    }
    assert!(crossed > tries() / 2, "{crossed}");
}

#[test]
fn an_ovus_is_crossed_where_a_ray_grazes_it() {
    let mut random = Random(62);
    let mut crossed = 0;
    for _ in 0..tries() {
        let ovus = any_ovus(&mut random);
        let placed = placed(&mut random, Body::Ovus(ovus));
        // A point of the surface: where it reaches farthest along a direction, or nearly.
        let out = random.direction().get();
        let (_, most) = ovus.extent(out);
        let mut point = out * most;
        for _ in 0..200 {
            let there = ovus.height(0, point);
            point -= there.gradient * there.value;
        }
        let normal = ovus.height(0, point).gradient;
        let off = [0.0, random.size(-17.0, 0.0), -random.size(-17.0, 0.0)][random.below(3)];
        let along = normal.cross(random.direction().get()).normalize_or(Vector::X);
        let far = far_off(&mut random, &placed);
        let world = |local: Vector| placed.placement.world_point(local);
        let (from, to) = (world(point + normal * off - along * far), world(point + normal * off));
        let direction = UnitVector::from_direction(to - from).unwrap_or(UnitVector::Z).get();
        let ray = Ray { origin: from, direction };
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        assert_left_where_it_is(&mut random, &placed, &ray, inside);
    }
    assert!(crossed > tries() / 3, "{crossed}");
}

#[test]
fn an_ovus_reaches_as_far_as_its_extent_says() {
    let mut random = Random(63);
    for _ in 0..tries() {
        let ovus = any_ovus(&mut random);
        let along = random.direction().get();
        let (_, most) = ovus.extent(along);
        // The farthest point is where the normal goes along: climb there.
        let mut best = f64::NEG_INFINITY;
        let mut point = along;
        for _ in 0..400 {
            let there = ovus.height(0, point);
            let on = point - there.gradient * there.value;
            best = best.max(on.dot(along));
            point = on + along * 0.2;
        }
        assert!(best <= most + 16.0 * EPS && best > most - 1e-3, "{best} {most} {ovus:?}");
    }
}

#[test]
fn an_ovus_has_the_numbers_of_pov_ray() {
    // Hits of `trace` on `ovus { 1, 0.5 }` and `ovus { 1, 1.5 }`, along −x.
    let cases = [
        (0.5, [(-0.16740000, 0.98588906), (0.24885, 0.97259163), (1.28947500, 0.42179533)]),
        (1.5, [(-0.70852500, 0.70568571), (-0.41715, 0.95349873), (2.20522500, 0.89299087)]),
    ];
    for (top, hits) in cases {
        let ovus = Ovus::new(double::Double::ONE, double::Double::from(top));
        let size = 1.0 + 0.5 * top;
        for (y, x) in hits {
            let point = Vector::new(x, 0.0, y - 0.5 * top) / size;
            let off = ovus.height(0, point).value;
            assert!(off.abs() < 1e-8, "{off:e} at {x}, {y} of {ovus:?}");
        }
    }
}
