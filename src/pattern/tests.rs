use super::*;
use crate::math::random::{Random, tries};

#[test]
fn what_an_error_cannot_tell_from_a_seam_is_on_it() {
    for (coordinate, error, seen) in [
        (1.999_999, 0.0, 1.999_999),
        (1.999_999, 1e-7, 1.999_999),
        (1.999_999, 1e-5, 2.0),
        (2.000_001, 1e-5, 2.0),
        (-3.000_001, 1e-5, -3.0),
        (2.0, 0.0, 2.0),
        (0.4, f64::INFINITY, 0.0),
    ] {
        assert_eq!(settled(coordinate, error), seen, "{coordinate} {error}");
    }
    assert!(settled(f64::NAN, 1.0).is_nan());
}

#[test]
fn off_the_seams_no_small_error_changes_a_value() {
    let mut random = Random(5);
    let mut seen = [0; 2];
    let setting = Setting::default();
    for _ in 0..tries() {
        let reach = [1.0, 3.0, 1e6][random.below(3)];
        let mut point = random.point(reach);
        for axis in 0..3 {
            let whole = point[axis].round();
            point[axis] = match random.below(4) {
                0 => whole,
                1 => whole + random.number(-2.0, 2.0) * NEAR,
                _ => point[axis],
            };
        }
        let direction = [random.direction(), random.structured_direction()][random.below(2)];
        let gradient = Kind::Gradient(Gradient { direction: direction.get() });
        for (place, kind) in [Kind::Checker(Checker {}), gradient].into_iter().enumerate() {
            let sample = |error| Sample { point, error, setting: &setting };
            let Some(told) = kind.value_off_seams(&sample(Vector::ZERO)) else { continue };
            seen[place] += 1;
            for error in [0.0, 1e-12, NEAR * 0.249] {
                let measured = kind.measured(&sample(Vector::splat(error)));
                assert_eq!(measured.value, told.value, "{kind:?} {point} {error}");
                assert!(measured.error <= told.error, "{kind:?} {point} {measured:?}");
            }
        }
    }
    assert!(seen.iter().all(|&seen| seen > tries() / 2), "{seen:?}");
}

/// Parameters of every size, wild ones included.
fn wild(random: &mut Random) -> f64 {
    match random.below(6) {
        0 => 0.0,
        1 => random.number(-3.0, 3.0),
        2 => random.number(-1.0, 1.0) * 1e-300,
        3 => random.number(-1.0, 1.0) * 1e300,
        4 => random.number(-30.0, 30.0).round(),
        _ => random.number(-1.0, 1.0) * 1e9,
    }
}

#[test]
fn values_are_finite_for_all_points_and_parameters() {
    let mut random = Random(11);
    let all = Kind::all();
    for turn in 0..tries() {
        let mut kind = all[turn % all.len()];
        for (place, parameter) in kind.parameters().iter().enumerate() {
            if random.below(3) == 0 {
                continue;
            }
            kind.set(
                place,
                match parameter.default {
                    Argument::Number(_) => Argument::Number(wild(&mut random)),
                    Argument::Numbers(_) => {
                        Argument::Numbers([wild(&mut random), wild(&mut random)])
                    }
                    Argument::Vector(_) => {
                        Argument::Vector(Vector::from_array([(); 3].map(|()| wild(&mut random))))
                    }
                    Argument::Switch(_) => Argument::Switch(random.below(2) == 1),
                },
            );
        }
        kind = kind.canonical();
        let point = Vector::from_array([(); 3].map(|()| wild(&mut random)));
        let amount = Vector::splat([0.0, random.number(-2.0, 2.0)][random.below(2)]);
        let noise =
            [NoiseGenerator::Plateaus, NoiseGenerator::RangeCorrected, NoiseGenerator::Perlin]
                [random.below(3)];
        let setting = Setting { noise, amount, ..Setting::default() };
        let error = Vector::splat([0.0, 1e-9, 1.0][random.below(3)]);
        let value = kind.measured(&Sample { point, error, setting: &setting }).value;
        assert!(value.is_finite(), "{kind:?} at {point} is {value}");
        let bounds = kind.bounds(point, error, &setting);
        let value = kind.measured(&Sample { point, error: Vector::ZERO, setting: &setting }).value;
        assert!(bounds.contains(value), "{kind:?} at {point}: {value} in {bounds:?}");
    }
}
