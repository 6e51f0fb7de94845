//! Laws that hold for all patterns, at ordinary points and parameters.

use super::*;
use crate::math::random::{Random, tries};
use crate::math::wide::{ROW, numbers};

const GENERATORS: [NoiseGenerator; 3] =
    [NoiseGenerator::Plateaus, NoiseGenerator::RangeCorrected, NoiseGenerator::Perlin];

/// A pattern with numbers near those that scenes use.
fn usual(random: &mut Random, turn: usize) -> Kind {
    let all = Kind::all();
    let mut kind = all[turn % all.len()];
    for (place, parameter) in kind.parameters().iter().enumerate() {
        if let Argument::Number(_) = parameter.default {
            kind.set(place, Argument::Number(random.number(-5.0, 5.0)));
        }
    }
    kind.canonical()
}

fn setting(random: &mut Random) -> Setting {
    let amount = random.point(1.0) * f64::from(random.below(2) as u32);
    let (frequency, phase) = (random.number(-3.0, 3.0), random.number(-1.0, 1.0));
    let (noise, waves) = (GENERATORS[random.below(3)], 1 + random.below(20));
    Setting { noise, amount, frequency, phase, waves, ..Setting::default() }
}

#[test]
fn bounds_contain_the_values_of_a_box() {
    let mut random = Random(21);
    for turn in 0..tries() {
        let kind = usual(&mut random, turn);
        let setting = setting(&mut random);
        let far = [1.0, 5.0, 1e5][random.below(3)];
        let point = random.point(far);
        let size = random.size(-9.0, 0.5);
        let reach = random.point(size).abs();
        let bounds = kind.bounds(point, reach, &setting);
        for _ in 0..6 {
            let point = point + random.point(1.0) * reach;
            let sample = Sample { point, error: Vector::ZERO, setting: &setting };
            let value = kind.measured(&sample).value;
            assert!(bounds.contains(value), "{kind:?} {setting:?} {point}: {value} {bounds:?}");
        }
    }
}

/// Neighbours, some in one cell of a lattice and some not, at places that a mask has bits for.
fn row(random: &mut Random) -> (Rows, u32) {
    let mut points = Rows::ZERO;
    let (far, size) = ([1.0, 30.0, 1e5, 1e17][random.below(4)], random.size(-3.0, 1.0));
    let corner = random.point(far);
    for number in 0..ROW {
        points.set(number, corner + random.point(size));
    }
    (points, 1 + random.below(0xffff) as u32)
}

#[test]
fn values_side_by_side_have_the_bits_of_each_alone() {
    let mut random = Random(24);
    for turn in 0..tries() {
        let kind = usual(&mut random, turn);
        let setting = setting(&mut random);
        if !kind.is_exact(&setting) {
            continue;
        }
        let ((points, mask), mut values) = (row(&mut random), [f64::NAN; ROW]);
        kind.values(&points, mask, &setting, &mut values);
        for number in numbers(mask) {
            let point = points.at(number);
            let error = Vector::splat([0.0, 1e-12, NEAR * 0.249][random.below(3)]);
            let sample = Sample { point, error, setting: &setting };
            let Measured { value, error } = kind.measured(&sample);
            assert_eq!(error, 0.0, "{kind:?} {setting:?} {point}");
            assert_eq!(values[number].to_bits(), value.to_bits(), "{kind:?} {setting:?} {point}");
            let near = kind.value_off_seams(&sample);
            assert!(near.is_some_and(|near| near == Measured { value, error }), "{kind:?} {point}");
        }
    }
}

#[test]
fn displacements_side_by_side_have_the_bits_of_each_alone() {
    let mut random = Random(26);
    for turn in 0..tries() {
        let kind = usual(&mut random, turn);
        let setting = setting(&mut random);
        let ((points, mask), (normals, _)) = (row(&mut random), row(&mut random));
        let mut vectors = Rows::ZERO;
        let are_there = kind.displacements(&normals, &points, mask, &setting, &mut vectors);
        for number in numbers(mask) {
            let sample =
                Sample { point: points.at(number), error: Vector::ZERO, setting: &setting };
            let alone = kind.displacement(normals.at(number), &sample);
            assert_eq!(alone.is_some(), are_there);
            if let Some(alone) = alone {
                let (told, alone) = (vectors.at(number).to_array(), alone.to_array());
                assert_eq!(told.map(f64::to_bits), alone.map(f64::to_bits), "{kind:?}");
            }
        }
    }
}

#[test]
fn points_that_warps_move_side_by_side_have_the_bits_of_each_alone() {
    let mut random = Random(25);
    for turn in 0..tries() {
        let mut warp = Warp::all()[turn % Warp::all().len()];
        for (place, parameter) in warp.parameters().iter().enumerate() {
            if let Argument::Vector(_) = parameter.default {
                warp.set(place, Argument::Vector(random.point(2.0)));
            }
        }
        let warp = warp.canonical();
        let (points, mask) = row(&mut random);
        let mut moved = Rows(points.0);
        warp.points(&mut moved, mask);
        for number in numbers(mask) {
            let alone = warp.point(points.at(number)).to_array();
            assert_eq!(moved.at(number).to_array().map(f64::to_bits), alone.map(f64::to_bits));
        }
    }
}

#[test]
fn off_the_seams_of_any_pattern_no_small_error_changes_a_value() {
    let mut random = Random(22);
    for turn in 0..tries() {
        let kind = usual(&mut random, turn);
        let setting = setting(&mut random);
        let far = [1.0, 30.0][random.below(2)];
        let mut point = random.point(far);
        for axis in 0..3 {
            if random.below(3) == 0 {
                point[axis] = point[axis].round() + random.number(-2.0, 2.0) * NEAR;
            }
        }
        let sample = |error| Sample { point, error: Vector::splat(error), setting: &setting };
        let Some(told) = kind.value_off_seams(&sample(0.0)) else { continue };
        for error in [0.0, 1e-12, NEAR * 0.249] {
            let measured = kind.measured(&sample(error));
            assert_eq!(measured.value, told.value, "{kind:?} {setting:?} {point} {error}");
            assert!(measured.error <= told.error, "{kind:?} {point} {measured:?} {told:?}");
        }
    }
}

#[test]
fn a_point_as_wrong_as_its_error_changes_a_value_by_no_more_than_the_error_says() {
    let mut random = Random(23);
    for turn in 0..tries() {
        let kind = usual(&mut random, turn);
        if kind.list().is_some() {
            continue;
        }
        let setting = Setting { amount: Vector::ZERO, ..setting(&mut random) };
        let (point, error) = (random.point(5.0), random.size(-12.0, -2.0));
        let value = |point| {
            kind.measured(&Sample { point, error: Vector::splat(error), setting: &setting })
        };
        let (here, there) = (value(point), value(point + random.point(error)));
        let is_known = here.error > 0.0;
        // Twice: a point near a seam has the value of the seam, which may be as far off again.
        let change = (here.value - there.value).abs();
        let is_jump = kind.has_seams() && change > 0.2;
        assert!(!is_known || is_jump || change <= 2.0 * here.error, "{kind:?} {point} {error}");
    }
}
