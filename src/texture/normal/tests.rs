//! Bumps of normals: the formulas measured on POV-Ray 3.7, and laws.

use super::blend::{average, between};
use super::slope_map::{Entry, height};
use super::*;
use crate::math::random::{Random, tries};
use crate::math::{Matrix, Vector, elementary, placement::Map};
use crate::noise::{NoiseGenerator, noise, vector_noise};
use crate::pattern::{Argument, Kind, Setting, Wave};
use crate::texture::image::conversion::{Encoding, Purpose};
use crate::texture::picture::{Picture, Samples};
use crate::texture::space::{Nowhere, Start, Step};

const GENERATOR: NoiseGenerator = NoiseGenerator::RangeCorrected;

/// The map into the space of all patterns measured: the inverse of `scale <1.3, .7, 2> rotate <20, 30, 40>`.
const TO_PATTERN: Matrix = Matrix::from_cols(
    Vector::new(0.510_318_421_668_414_2, -0.675_744_940_629_087_4, 0.289_884_732_794_715_66),
    Vector::new(0.428_207_999_404_938, 1.185_384_950_842_044_6, 0.020_004_378_274_070_93),
    Vector::new(-0.384_615_384_615_384_6, 0.423_140_189_608_605_5, 0.406_898_840_674_686_9),
);

fn turn(matrix: Matrix) -> Turn {
    Turn::of(&Map::new(Vector::ZERO, matrix))
}

fn space() -> Space {
    let steps = vec![Step::Map(Map::new(Vector::ZERO, TO_PATTERN))];
    Space { start: Start::Outer, steps }
}

/// A pattern of these parameters.
fn kind(word: &str, parameters: &[f64]) -> Kind {
    let mut kind = Kind::of_word(word).expect("a pattern");
    for (place, number) in parameters.iter().enumerate() {
        kind.set(place, Argument::Number(*number));
    }
    kind.canonical()
}

/// Bumps of a pattern, as a scene has them.
fn bumps(kind: Kind, amount: f64, setting: Setting) -> Bumps {
    let wave = Wave::new(kind.wave(), kind.frequency(), 0.0);
    let pattern = Pattern { source: Source::Kind(kind), setting, wave };
    let (accuracy, slopes, keeps_depth) = (bump::ACCURACY, Vec::new(), false);
    Bumps { space: space(), pattern, amount, accuracy, slopes, keeps_depth }
}

/// The image of three by three pixels that was measured, without interpolation.
fn image() -> Arc<ImageMap> {
    let samples = Samples::Eight(vec![207, 60, 222, 40, 8, 100, 193, 72, 166]);
    let (encoding, is_multiplied) = (Encoding::Plain, false);
    let picture = Picture { width: 3, height: 3, channels: 1, samples, encoding, is_multiplied };
    Arc::new(ImageMap::new(Arc::new(picture), Purpose::Values, None, None))
}

fn bozo(point: Vector) -> f64 {
    noise(GENERATOR, point)
}

/// The normal of a case of the table.
fn perturbed(case: &str, p: Vector, normal: Vector, rest: &[f64]) -> Vector {
    let in_world = TO_PATTERN.inverse() * p;
    let of = |node: Normal| node.perturbed(normal, None, &Nowhere::exact(in_world));
    let by = |word: &str, parameters: &[f64], amount: f64| {
        bumps(kind(word, parameters), amount, Setting::default())
    };
    let plain = |word: &str, amount: f64| of(Normal::Bumps(by(word, &[], amount)));
    let waved = |word: &str, frequency: f64, phase: f64| {
        let setting = Setting { frequency, phase, ..Setting::default() };
        of(Normal::Bumps(bumps(kind(word, &[]), 0.6, setting)))
    };
    let frame = Frame::new(turn(TO_PATTERN), false);
    let bump = |size: f64, value: &dyn Fn(Vector) -> f64| {
        bump::displacement(p, bump::ACCURACY, |points| points.map(value)) * size
    };
    // An entry of a map, in the space of the map.
    let entry = |v: Vector| Frame::new(Turn::NONE, false).entry(frame_normal(normal), |_| v);
    let mapped = |blend: Vector| frame::unit(frame.entry(normal, |n| blend - n), normal);
    match case {
        "bozo" => plain("bozo", 0.7),
        "bozo_keep" => of(Normal::Bumps(Bumps { keeps_depth: true, ..by("bozo", &[], 0.7) })),
        "accuracy" => of(Normal::Bumps(Bumps { accuracy: 0.3, ..by("bozo", &[], 0.7) })),
        "function" => {
            let function = |p: Vector| {
                0.5 + 0.4 * elementary::sin(3.0 * p.x) * elementary::cos(2.0 * p.y + p.z)
            };
            frame::unit(frame.entry(normal, |_| bump(2.0, &function)), normal)
        }
        "slope_map" => {
            let entry = |[value, height, slope]: [f64; 3]| Entry { value, height, slope };
            let slopes = [[0.2, 0.3, 2.0], [0.45, 0.9, -1.0], [0.45, 0.2, 1.0], [0.7, 0.1, 3.0]];
            let slopes = slopes.map(entry).to_vec();
            of(Normal::Bumps(Bumps { slopes, ..by("bozo", &[], 0.7) }))
        }
        "bumps" => plain("bumps", 0.6),
        "bumps_keep" => of(Normal::Bumps(Bumps { keeps_depth: true, ..by("bumps", &[], 0.6) })),
        "dents" => plain("dents", 2.0),
        "dents_1" => {
            let noise = NoiseGenerator::Plateaus;
            let setting = Setting { noise, ..Setting::default() };
            of(Normal::Bumps(bumps(kind("dents", &[]), 2.0, setting)))
        }
        "wrinkles" => plain("wrinkles", 0.4),
        "ripples" => waved("ripples", 2.0, 0.3),
        "waves" => waved("waves", 1.5, -0.2),
        "quilted" => of(Normal::Bumps(by("quilted", &[0.3, 1.2], 0.8))),
        // Their amount has no effect.
        "facets_coords" => of(Normal::Bumps(by("facets", &[0.8], 0.0))),
        "facets_size" => of(Normal::Bumps(by("facets", &[0.0, 0.4], 3.0))),
        "map" => {
            let fraction = ((rest[0] - 0.2) / 0.6).clamp(0.0, 1.0);
            let (from, to) = (entry(vector_noise(p) * 0.6), entry(bump(0.7, &bozo)));
            mapped(between(from, to, fraction, frame_normal(normal)))
        }
        "average" => {
            let inner =
                |bumps: Bumps| Arc::new(Normal::Bumps(Bumps { space: Space::default(), ..bumps }));
            let entries =
                vec![(1.0, inner(by("bumps", &[], 0.6))), (3.0, inner(by("bozo", &[], 0.7)))];
            of(Normal::Average { space: space(), entries, keeps_depth: false })
        }
        "average_keep" => {
            let half = Frame::new(turn(Matrix::from_diagonal(Vector::splat(0.5))), true);
            let kept = half.entry(frame_normal(normal), |_| vector_noise(p * 0.5) * 1.2);
            let entries = [(1.0, entry(vector_noise(p) * 0.6)), (2.0, kept)];
            mapped(average(entries, frame_normal(normal)))
        }
        "bump_map" => {
            let (space, image) = (space(), image());
            of(Normal::Image { space, image, amount: 0.7, keeps_depth: false })
        }
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
        assert!((seen.length() - 1.0).abs() < 1e-14, "{case} {p}: {seen}");
        assert!((seen - measured).abs().max_element() < 1e-5, "{case} {p}: {seen} {measured}");
        count += 1;
    }
    assert!(count > 150);
}

#[test]
fn scaling_keeps_angles_unless_the_depth_is_kept() {
    let lean = |scale: f64, keeps_depth| {
        let smaller = turn(Matrix::from_diagonal(Vector::splat(1.0 / scale)));
        let slope = bump::displacement(Vector::ZERO, bump::ACCURACY, |points| points.map(|p| p.x));
        let normal = Frame::new(smaller, keeps_depth).entry(Vector::Z, |_| slope);
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
        let words = ["bozo", "wrinkles", "ripples", "waves", "quilted", "facets"];
        let word = words[random.below(words.len())];
        let setting = Setting { frequency: size, phase: accuracy, ..Setting::default() };
        let steps = vec![Step::Map(Map::new(Vector::ZERO, matrix))];
        let bumps = Bumps {
            space: Space { start: Start::Outer, steps },
            accuracy,
            keeps_depth: random.below(2) == 1,
            ..bumps(kind(word, &[]), size, setting)
        };
        let seen = Normal::Bumps(bumps).perturbed(normal, None, &Nowhere::exact(p));
        assert!((seen.length() - 1.0).abs() < 1e-14, "{word} {matrix} {p} {size}: {seen}");
        let blend = average([(size, seen), (accuracy, normal)], normal);
        assert!((blend.length() - 1.0).abs() < 1e-14, "{size} {accuracy}: {blend}");
    }
}
