//! Bumps of normals: the formulas measured on POV-Ray 3.7, and laws.

use std::f64::consts::TAU;

use super::*;
use crate::math::random::{Random, tries};
use crate::math::{Matrix, UnitVector, Vector, elementary};
use crate::noise::{NoiseGenerator, noise, vector_noise};

const GENERATOR: NoiseGenerator = NoiseGenerator::RangeCorrected;

/// The map into the space of all patterns measured: the inverse of `scale <1.3, .7, 2> rotate <20, 30, 40>`.
const TO_PATTERN: Matrix = Matrix::from_cols(
    Vector::new(0.510_318_421_668_414_2, -0.675_744_940_629_087_4, 0.289_884_732_794_715_66),
    Vector::new(0.428_207_999_404_938, 1.185_384_950_842_044_6, 0.020_004_378_274_070_93),
    Vector::new(-0.384_615_384_615_384_6, 0.423_140_189_608_605_5, 0.406_898_840_674_686_9),
);

/// The first ten centres of ripples and waves, with the frequencies of the latter.
fn centres() -> impl Iterator<Item = (Vector, f64)> {
    let drawn = [29789, 31130, 13866, 22914, 22255, 32159, 25328, 12801, 7198, 5194];
    drawn.into_iter().enumerate().map(|(i, drawn)| {
        let noise = vector_noise(Vector::X * i as f64);
        (noise / noise.length(), 0.01 + f64::from(drawn) / 32_767.0)
    })
}

fn wave(frequency: f64, phase: f64) -> impl Fn(f64) -> f64 {
    move |distance| elementary::sin(TAU * (distance * frequency + phase))
}

fn bozo(point: Vector) -> f64 {
    noise(GENERATOR, point)
}

/// Height of the image of three by three pixels that was measured, without interpolation.
fn image(point: Vector, right: f64, up: f64) -> f64 {
    const PIXELS: [[f64; 3]; 3] = [[207.0, 60.0, 222.0], [40.0, 8.0, 100.0], [193.0, 72.0, 166.0]];
    let index = |place: f64| place.floor().rem_euclid(3.0) as usize;
    let row = index(3.0 - (3.0 * point.y + up));
    PIXELS[row][index(3.0 * point.x + right)] / 255.0
}

/// The normal of a case of the table.
fn perturbed(case: &str, p: Vector, normal: Vector, rest: &[f64]) -> Vector {
    let keeps_depth = matches!(case, "bozo_keep" | "bumps_keep");
    let frame = Frame::new(TO_PATTERN, keeps_depth);
    let sloped = |point| {
        let entry = |[value, height, slope]: [f64; 3]| Entry { value, height, slope };
        let entries = [[0.2, 0.3, 2.0], [0.45, 0.9, -1.0], [0.45, 0.2, 1.0], [0.7, 0.1, 3.0]];
        height(&entries.map(entry), bozo(point))
    };
    let function =
        |p: Vector| 0.5 + 0.4 * elementary::sin(3.0 * p.x) * elementary::cos(2.0 * p.y + p.z);
    let bump = |size: f64, value: &dyn Fn(Vector) -> f64| {
        bump::displacement(p, bump::ACCURACY, value) * size
    };
    let flat = |displacement: Vector| frame.perturbed(normal, |_| displacement);
    // An entry of a map, in the space of the map.
    let entry = |v: Vector| Frame::new(Matrix::IDENTITY, false).entry(frame_normal(normal), |_| v);
    let mapped = |blend: Vector| frame.perturbed(normal, |n| blend - n);
    let rows = || centres().map(|(centre, _)| centre);
    match case {
        "bozo" | "bozo_keep" => flat(bump(0.7, &bozo)),
        "accuracy" => flat(bump::displacement(p, 0.3, bozo) * 0.7),
        "function" => bump::perturbed(normal, p, &TO_PATTERN, 2.0, bump::ACCURACY, function),
        "slope_map" => flat(bump(0.7, &sloped)),
        "bumps" | "bumps_keep" => flat(bumps::displacement(p) * 0.6),
        "dents" => flat(dents::displacement(GENERATOR, p) * 2.0),
        "dents_1" => flat(dents::displacement(NoiseGenerator::Plateaus, p) * 2.0),
        "wrinkles" => flat(wrinkles::displacement(p) * 0.4),
        "ripples" => flat(ripples::displacement(p, rows(), wave(2.0, 0.3)) * 0.6),
        "waves" => flat(waves::displacement(p, centres(), wave(1.5, -0.2)) * 0.6),
        "quilted" => flat(quilted::displacement([0.3, 1.2], p) * 0.8),
        "facets_coords" => {
            let seed = |_| Vector::from_slice(rest);
            frame.perturbed(normal, |n| facets::displacement(0.8, n, p, seed))
        }
        "facets_size" => {
            frame.perturbed(normal, |n| facets::replaced(0.4, n, |_| Vector::from_slice(rest)) - n)
        }
        "map" => {
            let fraction = ((rest[0] - 0.2) / 0.6).clamp(0.0, 1.0);
            let (from, to) = (entry(vector_noise(p) * 0.6), entry(bump(0.7, &bozo)));
            mapped(between(from, to, fraction, frame_normal(normal)))
        }
        "average" => {
            let entries = [(1.0, entry(vector_noise(p) * 0.6)), (3.0, entry(bump(0.7, &bozo)))];
            mapped(average(entries, frame_normal(normal)))
        }
        "average_keep" => {
            let half = Frame::new(Matrix::from_diagonal(Vector::splat(0.5)), true);
            let kept = half.entry(frame_normal(normal), |_| vector_noise(p * 0.5) * 1.2);
            let entries = [(1.0, entry(vector_noise(p) * 0.6)), (2.0, kept)];
            mapped(average(entries, frame_normal(normal)))
        }
        "bump_map" => frame.perturbed(normal, |n| {
            bump_map::displacement(n, |right, up| image(p, right, up)) * 0.7
        }),
        _ => panic!("an unknown case: {case}"),
    }
}

/// The normal in the space of the pattern.
fn frame_normal(normal: Vector) -> Vector {
    let inner = TO_PATTERN.inverse().transpose() * normal;
    inner / inner.length()
}

#[test]
fn normals_are_those_of_pov_ray() {
    let mut count = 0;
    for line in include_str!("measured.txt").lines().filter(|line| !line.starts_with('#')) {
        let (case, numbers) = line.split_once(' ').expect("a case and its numbers");
        let numbers: Vec<f64> =
            numbers.split(' ').map(|number| number.parse().expect("a number")).collect();
        let [p, normal, measured] =
            [0, 3, 6].map(|from| Vector::from_slice(&numbers[from..from + 3]));
        let seen = perturbed(case, p, normal, &numbers[9..]);
        assert!((seen.length() - 1.0).abs() < 1e-15, "{case} {p}: {seen}");
        assert!((seen - measured).abs().max_element() < 1e-5, "{case} {p}: {seen} {measured}");
        count += 1;
    }
    assert!(count > 150);
}

#[test]
fn scaling_keeps_angles_unless_the_depth_is_kept() {
    let lean = |scale: f64, keeps_depth| {
        let frame = Frame::new(Matrix::from_diagonal(Vector::splat(1.0 / scale)), keeps_depth);
        let slope = |p| bump::displacement(p, bump::ACCURACY, |p: Vector| p.x);
        let normal = frame.perturbed(Vector::Z, |_| slope(Vector::ZERO));
        normal.x / normal.z
    };
    for (scale, keeps_depth, expected) in [
        (1.0, false, 1.0),
        (10.0, false, 1.0),
        (0.5, false, 1.0),
        (10.0, true, 0.1),
        (0.5, true, 2.0),
    ] {
        let seen = lean(scale, keeps_depth) / (-2.0 / 15.0);
        assert!((seen - expected).abs() < 1e-12, "{scale} {keeps_depth}: {seen}");
    }
}

#[test]
fn a_slope_map_jumps_where_entries_coincide() {
    let map = |entries: &[[f64; 2]], value| {
        let entry = |&[value, height]: &[f64; 2]| Entry { value, height, slope: 0.0 };
        height(&entries.iter().map(entry).collect::<Vec<_>>(), value)
    };
    let jump = [[0.0, 0.0], [0.5, 1.0], [0.5, 3.0], [1.0, 6.0]];
    for (value, expected) in [(-1.0, 0.0), (0.25, 0.5), (0.5, 1.0), (0.75, 4.5), (1.0, 6.0)] {
        assert_eq!(map(&jump, value), expected, "{value}");
    }
    assert_eq!(map(&[[0.5, 1.0], [0.5, 3.0]], 0.5), 3.0);
    assert_eq!(map(&[[0.5, 1.0], [0.5, 3.0], [0.5, 7.0], [1.0, 9.0]], 0.5), 1.0);
    assert_eq!(map(&[], 0.5), 0.5);
}

#[test]
fn perturbed_normals_are_finite_with_length_one() {
    let mut random = Random(3);
    let wild = |random: &mut Random| match random.below(5) {
        0 => 0.0,
        1 => random.number(-1.0, 1.0) * 1e-300,
        2 => random.number(-1.0, 1.0) * 1e300,
        _ => random.number(-3.0, 3.0),
    };
    for _ in 0..tries() {
        let normal = random.direction().get();
        let mut matrix = random.matrix();
        if random.below(3) == 0 {
            matrix *= wild(&mut random);
        }
        let p = Vector::from_array([(); 3].map(|()| wild(&mut random)));
        let (size, accuracy) = (wild(&mut random), wild(&mut random));
        let frame = Frame::new(matrix, random.below(2) == 1);
        let displacement = match random.below(7) {
            0 => bump::displacement(p, accuracy, bozo),
            1 => wrinkles::displacement(p),
            2 => {
                ripples::displacement(p, centres().map(|(centre, _)| centre), wave(size, accuracy))
            }
            3 => waves::displacement(p, centres(), wave(1.0, accuracy)),
            4 => quilted::displacement([size, accuracy], p),
            5 => facets::displacement(accuracy, normal, p, |p| p),
            _ => facets::replaced(accuracy, normal, |p| p) - normal,
        };
        let seen = frame.perturbed(normal, |_| displacement * size);
        assert!((seen.length() - 1.0).abs() < 1e-14, "{matrix} {p} {size} {accuracy}: {seen}");
        let blend = average([(size, seen), (accuracy, normal)], normal);
        assert!((blend.length() - 1.0).abs() < 1e-14, "{size} {accuracy}: {blend}");
    }
}

#[test]
fn a_reflected_ray_leaves_the_surface() {
    let mut random = Random(4);
    for _ in 0..tries() {
        let (mut smooth, perturbed) = (random.direction().get(), random.direction().get());
        let direction = random.direction().get();
        if direction.dot(smooth) > 0.0 {
            smooth = -smooth;
        }
        let reflected = ray::reflected(direction, perturbed, smooth);
        assert!(reflected.dot(smooth) >= -1e-15, "{direction} {perturbed} {smooth}");
        assert!((reflected.length() - 1.0).abs() < 1e-14);
        assert!(direction.dot(ray::refracting(direction, perturbed)) <= 0.0);
    }
}

#[test]
fn a_mirrored_ray_below_the_surface_is_mirrored_there() {
    // Measured on POV-Ray 3.7: a plane tilted by <15, 25, 0> with bumps of size 2, seen along z.
    let smooth = UnitVector::from_direction(Vector::new(-0.408_217_9, 0.258_819_05, -0.875_426_1));
    let smooth = smooth.map_or(Vector::Z, UnitVector::get);
    for (perturbed, measured) in [
        (Vector::new(-0.869_95, -0.082_78, -0.486_14), Vector::new(-0.957_81, -0.009_46, 0.287_14)),
        (Vector::new(-0.584_69, 0.657_2, -0.475_64), Vector::new(-0.630_05, 0.672_01, 0.389_14)),
    ] {
        let seen = ray::reflected(Vector::Z, perturbed, smooth);
        assert!((seen - measured).abs().max_element() < 5e-5, "{seen} {measured}");
    }
}
