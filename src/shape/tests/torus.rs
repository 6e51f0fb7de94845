//! Tori against twice the digits: thick, thin, grazed, and as exact as the line.

use super::placed::{
    assert_crossed_where_it_is, assert_left_into_the_open, far_off, placed, ray_at_placed, square,
    stand,
};
use super::*;
use crate::shape::exact::Triple;
use crate::shape::local::Local;

fn inside(body: &Body, [x, y, z]: Triple) -> Double {
    let Body::Torus(Torus { major, minor }) = body else { panic!("{body:?}") };
    let off = (square(x) + square(y)).sqrt() - Double::of(*major);
    (square(off) + square(z)).sqrt() - Double::of(*minor)
}

/// Thick, thin, without a hole, and running into itself.
fn any_torus(random: &mut Random) -> Torus {
    let minor = match random.below(4) {
        0 => random.size(-4.0, 0.0) / 2.0,
        1 => [0.5, 0.2, 0.25, 0.75][random.below(4)],
        2 => random.number(0.5, 1.0),
        _ => random.number(0.0, 0.5),
    };
    Torus { major: 1.0 - minor, minor }
}

#[test]
fn a_torus_is_crossed_where_exact_arithmetic_crosses_it() {
    let mut random = Random(55);
    let mut crossed = 0;
    for _ in 0..tries() {
        let body = Body::Torus(any_torus(&mut random));
        let placed = placed(&mut random, body);
        let ray = ray_at_placed(&mut random, &placed);
        crossed += assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        assert_left_into_the_open(&mut random, &placed, &ray, inside);
    }
    assert!(crossed > tries() / 2, "{crossed}");
}

#[test]
fn a_torus_is_crossed_where_a_ray_grazes_its_tube_or_meets_its_axis() {
    let mut random = Random(56);
    let mut counts = [0; 5];
    for _ in 0..tries() {
        let torus_ = any_torus(&mut random);
        let Torus { major, minor } = torus_;
        let placed = placed(&mut random, Body::Torus(torus_));
        let around = random.direction().get().with_z(0.0).normalize_or(Vector::X);
        let slant = random.direction().get();
        let off = [0.0, random.size(-17.0, 0.0), -random.size(-17.0, 0.0)][random.below(3)];
        let (through, along) = match random.below(6) {
            // Touches the tube, from outside or in its hole.
            0 | 1 => {
                let out = (around * slant.x + Vector::Z * slant.z).normalize_or(around);
                let point = around * major + out * (minor * (1.0 + off));
                let aside = around.cross(Vector::Z);
                (point, out.cross(aside) * slant.y + aside * [1.0, 0.0, slant.z][random.below(3)])
            }
            // Through the axis, or nearly.
            2 => (Vector::Z * (slant.z * minor) + around.cross(Vector::Z) * off, slant),
            // Along it.
            3 => (around * (major + minor * slant.x), Vector::Z + around * off),
            // In the plane of the ring, as a chord of its middle, its rims.
            4 => {
                let distance = major + [0.0, minor, -minor][random.below(3)];
                (around * (distance * (1.0 + off)), around.cross(Vector::Z))
            }
            _ => (Vector::Z * (minor * (1.0 + off)), around),
        };
        let Some(along) = UnitVector::from_direction(along) else { continue };
        let far = [3.0, far_off(&mut random, &placed)][random.below(2)];
        let [from, to] =
            [through - along.get() * far, through].map(|local| placed.placement.world_point(local));
        let direction = UnitVector::from_direction(to - from).unwrap_or(UnitVector::Z).get();
        let ray = Ray { origin: from, direction };
        let count = assert_crossed_where_it_is(&mut random, &placed, &ray, inside);
        assert_left_into_the_open(&mut random, &placed, &ray, inside);
        counts[count] += 1;
    }
    let [none, one, two, three, four] = counts;
    assert!(one == 0 && three == 0, "{counts:?}");
    assert!(none.min(two).min(four) > tries() / 20, "{counts:?}");
}

#[test]
fn a_torus_is_found_as_exactly_as_the_line_is_known() {
    let mut random = Random(57);
    for _ in 0..tries() {
        let torus_ = any_torus(&mut random);
        let ray = Ray { origin: random.direction().get() * 3.0, direction: Vector::X };
        let target = random.point(1.0);
        let direction = UnitVector::from_direction(target - ray.origin).expect("apart").get();
        let ray = Ray { direction, ..ray };
        let placement = crate::math::placement::Placement {
            centre: Vector::ZERO,
            world_from_local: Matrix::IDENTITY,
            local_from_world: Matrix::IDENTITY,
        };
        let placed = stand(std::sync::Arc::new(Body::Torus(torus_)), placement);
        for met in placed.crossings(&ray) {
            let slope = placed.body.height(0, ray.at(met.t)).gradient.dot(direction).abs();
            // A tube curves by 1 / minor.
            let graze = (met.error / torus_.minor).sqrt();
            if slope > 10.0 * graze {
                assert!(met.error * slope < 200.0 * EPS, "{met:?} {slope} {placed:?} {ray:?}");
            }
        }
    }
}
