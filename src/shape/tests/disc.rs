//! Discs against twice the digits: where their planes are crossed, and where they are seen.

use super::placed::{
    assert_crossed_where_it_is, assert_left_where_it_is, blur, local_at, placed, ray_at_placed,
    square,
};
use super::*;

#[test]
fn a_disc_is_crossed_where_exact_arithmetic_crosses_its_plane_and_seen_where_it_is() {
    let mut random = Random(54);
    let (mut crossed, mut seen) = (0, 0);
    for _ in 0..tries() {
        let hole = [0.0, random.number(0.0, 1.0)][random.below(2)];
        let placed = placed(&mut random, Body::Disc(Disc { hole }));
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, |_, [_, _, z]| z);
        assert_left_where_it_is(&mut random, &placed, &ray, |_, [_, _, z]| z);
        for met in placed.crossings(&ray) {
            let [x, y, _] = local_at(&placed, &ray, met.t, 0.0);
            let distance = (square(x) + square(y)).sqrt().0;
            let speed = placed.placement.local_direction(ray.direction).length();
            let error = met.error * speed + blur(&placed, &ray);
            seen += usize::from(met.is_seen());
            if (distance - 1.0).abs() > error && (distance - hole).abs() > error {
                assert_eq!(met.is_seen(), hole < distance && distance < 1.0, "{placed:?} {ray:?}");
            }
        }
    }
    assert!(crossed > tries() / 2 && seen > tries() / 40, "{crossed} {seen}");
}
