//! Cylinders against twice the digits.

use super::placed::{
    assert_crossed_where_it_is, assert_left_where_it_is, greater, placed, ray_at_placed, square,
};
use super::*;
use crate::shape::exact::Triple;

fn inside(_: &Body, [x, y, z]: Triple) -> Double {
    let one = Double::of(1.0);
    greater((square(x) + square(y)).sqrt() - one, z.abs() - one)
}

#[test]
fn a_cylinder_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(51);
    let mut crossed = 0;
    for _ in 0..tries() {
        let body = Body::Cylinder(Cylinder { open: random.below(4) == 0 });
        let placed = placed(&mut random, body);
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        assert_left_where_it_is(&mut random, &placed, &ray, inside);
    }
    assert!(crossed > tries() / 2, "{crossed}");
}
