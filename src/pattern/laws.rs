//! Laws that hold for all patterns, at ordinary points and parameters.

use super::*;
use crate::math::random::{Random, tries};

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
