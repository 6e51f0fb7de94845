//! Cones against twice the digits, at their tips and along their sides.

use super::placed::{
    assert_crossed_where_it_is, assert_left_where_it_is, greater, placed, ray_at_placed, square,
};
use super::*;
use crate::shape::exact::Triple;

fn inside(body: &Body, [x, y, z]: Triple) -> Double {
    let Body::Cone(Cone { cap, .. }) = body else { panic!("{body:?}") };
    let (one, cap) = (Double::of(1.0), Double::of(*cap));
    let width = cap + (one - cap) * (one - z) * Double::of(0.5);
    greater((square(x) + square(y)).sqrt() - width.abs(), z.abs() - one)
}

#[test]
fn a_cone_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(52);
    let mut crossed = 0;
    for _ in 0..tries() {
        let cap = match random.below(5) {
            0 => 0.0,
            1 => random.size(-9.0, 0.0),
            2 => 1.0 - random.size(-15.0, 0.0),
            _ => random.number(0.0, 1.0),
        };
        let body = Body::Cone(Cone { cap: cap.min(1.0 - EPS), open: random.below(4) == 0 });
        let placed = placed(&mut random, body);
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        assert_left_where_it_is(&mut random, &placed, &ray, inside);
    }
    assert!(crossed > tries() / 2, "{crossed}");
}

#[test]
fn a_cone_is_crossed_at_its_tip_and_along_its_sides() {
    let mut random = Random(53);
    let mut crossed = 0;
    for _ in 0..tries() {
        let cap = [0.0, 0.5, -0.25, -1.0, -random.size(-9.0, 0.0)][random.below(5)];
        let placed = placed(&mut random, Body::Cone(Cone { cap, open: false }));
        // Toward the tip, or nearly; along a line on its side, or nearly.
        let tip = Vector::Z * ((1.0 + cap) / (1.0 - cap));
        let rim = random.direction().get().with_z(0.0).normalize_or(Vector::X) - Vector::Z;
        let off = random.direction().get() * [0.0, random.size(-17.0, -1.0)][random.below(2)];
        // On the sides of both cones at once, rounding tells neither.
        let (from, to) = match random.below(if cap < 0.0 { 1 } else { 2 }) {
            0 => (random.direction().get() * 3.0, tip + off),
            _ => (rim + (rim - tip) * 0.5 + off, tip),
        };
        let [from, to] = [from, to].map(|local| placed.placement.world_point(local));
        let direction = UnitVector::from_direction(to - from).unwrap_or(UnitVector::Z).get();
        let ray = Ray { origin: from, direction };
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
    }
    assert!(crossed > tries() / 2, "{crossed}");
}
