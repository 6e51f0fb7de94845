//! Texts against twice the digits: letters apart, one over the other, and flat.

use super::outline::{any_outline, is_clear, planar};
use super::placed::{
    assert_crossed_where_it_is, assert_first_found_up_to_a_limit, assert_left_into_the_open, blur,
    greater, local_at, placed, ray_at_placed,
};
use super::*;
use crate::math::random::tries_in;
use crate::shape::curve::{Outline, Piece};
use crate::shape::exact::Triple;

/// Negative inside of the letter that a point is farthest within, or nearest to.
fn within(body: &Body, place: [Double; 2]) -> Double {
    let Body::Text(text) = body else { panic!("{body:?}") };
    let all = text.outlines().map(|outline| planar(outline, place));
    all.reduce(|a, b| -greater(-a, -b)).expect("a letter or more")
}

fn inside(body: &Body, [x, y, z]: Triple) -> Double {
    greater(z.abs() - Double::of(1.0), within(body, [x, y]))
}

/// An outline of about `size` around a place.
fn letter(random: &mut Random, size: f64, [x, y]: [f64; 2]) -> Outline {
    let mut moved = Outline::default();
    let outline = any_outline(random);
    for run in &outline.runs {
        let pieces = outline.pieces[run.from..run.to].iter().map(|piece| {
            let points = piece.points().iter().map(|[a, b]| [x + a * size, y + b * size]);
            Piece::bezier(&points.collect::<Vec<_>>()).expect("two to four points")
        });
        moved.add(pieces);
    }
    moved
}

/// One to four letters, side by side where they are to be apart.
fn any_letters(random: &mut Random, are_apart: bool) -> Vec<Outline> {
    let count = 1 + random.below(4);
    let (step, size) = (1.0 / count as f64, 0.5 / count as f64);
    let place = |i: usize, random: &mut Random| match are_apart {
        true => ([step * (i as f64 + 0.5) - 0.5, 0.0], size),
        false => ([0.0; 2].map(|_| random.number(-0.2, 0.2)), 0.3),
    };
    (0..count)
        .map(|i| {
            let (at, size) = place(i, random);
            letter(random, size, at)
        })
        .collect()
}

#[test]
fn a_text_is_crossed_where_exact_arithmetic_is_inside_of_any_letter() {
    let mut random = Random(98);
    let (mut crossed, mut again) = (0, 0);
    for _ in 0..tries_in(60) {
        let are_apart = random.below(2) == 0;
        let letters = any_letters(&mut random, are_apart);
        let body = Body::Text(Text::new(letters, false).expect("letters"));
        let placed = placed(&mut random, body);
        for _ in 0..3 {
            let ray = ray_at_placed(&mut random, &placed);
            let count = assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
            crossed += count;
            again += usize::from(count > 2);
            assert_first_found_up_to_a_limit(&mut random, &placed, &ray);
            // Where letters overlap, the surface of one may lie within another.
            if are_apart && is_clear(&placed, &ray, false) {
                assert_left_into_the_open(&mut random, &placed, &ray, inside);
            }
        }
    }
    assert!(crossed > tries_in(300) && again > tries_in(6000), "{crossed} {again}");
}

#[test]
fn a_flat_text_is_met_where_exact_arithmetic_is_inside_of_any_letter() {
    let mut random = Random(99);
    let (mut met, mut missed) = (0, 0);
    for _ in 0..tries_in(20) {
        let are_apart = random.below(2) == 0;
        let letters = any_letters(&mut random, are_apart);
        let placed = placed(&mut random, Body::Text(Text::new(letters, true).expect("letters")));
        let ray = ray_at_placed(&mut random, &placed);
        met += assert_crossed_where_it_is(&mut random, &placed, &ray, |_, [_, _, z]| z);
        let start = placed.placement.local_point(ray.origin);
        let step = placed.placement.local_direction(ray.direction);
        let t = -start.z / step.z;
        if !t.is_finite() {
            continue;
        }
        let [x, y, _] = local_at(&placed, &ray, t, 0.0);
        let height = within(&placed.body, [x, y]).0;
        let off = 64.0 * blur(&placed, &ray) * step.length() / step.z.abs();
        if height.abs() > off {
            let found = placed.crossings(&ray);
            assert_eq!(found.len(), usize::from(height < 0.0), "{found:?} {placed:?} {ray:?}");
            missed += usize::from(height > 0.0);
        }
    }
    assert!(met > tries_in(2000) && missed > tries_in(100), "{met} {missed}");
}
