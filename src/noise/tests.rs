use std::f64::consts::TAU;

use super::*;
use crate::math::elementary;
use crate::math::random::{Random, tries, tries_in};

const GENERATORS: [NoiseGenerator; 3] =
    [NoiseGenerator::Plateaus, NoiseGenerator::RangeCorrected, NoiseGenerator::Perlin];

/// The rows of a table of measured numbers.
fn rows<const N: usize>(table: &str) -> Vec<[f64; N]> {
    let number = |text: &str| text.parse().expect("a number");
    let row = |line: &str| line.split(' ').map(number).collect::<Vec<f64>>();
    let lines = table.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| row(line).try_into().expect("as many numbers as each row has")).collect()
}

#[test]
fn noise_is_that_of_pov_ray() {
    let rows = rows(include_str!("measured.txt"));
    assert!(rows.len() > 80);
    for [x, y, z, one, two, three, a, b, c] in rows {
        let point = Vector::new(x, y, z);
        for (generator, measured) in GENERATORS.into_iter().zip([one, two, three]) {
            let value = noise(generator, point);
            assert!((value - measured).abs() < 4e-15, "{generator:?} {point}: {value} {measured}");
        }
        let vector = vector_noise(point);
        assert!((vector - Vector::new(a, b, c)).abs().max_element() < 4e-15, "{point}: {vector}");
    }
}

/// How `agate` turns turbulence into its value is not in the manual: this fits all that was measured.
#[test]
fn turbulence_as_a_number_is_that_inside_agate() {
    let rows = rows(include_str!("agate.txt"));
    assert!(rows.len() >= 48);
    for [generator, lambda, omega, octaves, x, y, z, measured] in rows {
        let generator = GENERATORS[generator as usize - 1];
        let number =
            Turbulence::new(lambda, omega, octaves).number(generator, Vector::new(x, y, z));
        let wave = elementary::sin(TAU * (1.1 * z + 1.3 * number));
        let value = elementary::pow((wave + 1.0) / 2.0, 0.77);
        assert!((value - measured).abs() < 1e-12, "{generator:?} {x} {y} {z}: {value} {measured}");
    }
}

/// Points where a path could differ: any, on lattice planes, next to them, and nearly too far for the near path.
fn point_of_any_kind(random: &mut Random) -> Vector {
    Vector::from_array([(); 3].map(|()| {
        let near = random.number(-1.0, 1.0) * [1.0, 50.0, 1e6, 1e15][random.below(4)];
        [near, near.round(), near.round().next_down(), near.round().next_up(), -0.0]
            [random.below(5)]
    }))
}

#[test]
fn noise_has_the_same_bits_for_all_instructions() {
    let mut random = Random(4);
    for _ in 0..tries() {
        let point = point_of_any_kind(&mut random);
        let [narrow, wide]: [[f64; 4]; 2] = Instructions::all().map(
            |instructions| dispatch!(instructions.level(), simd => triple(simd, point).into()),
        );
        assert_eq!(narrow.map(f64::to_bits), wide.map(f64::to_bits), "{point}");
        for generator in GENERATORS {
            let [narrow, wide] = Instructions::all().map(|instructions| {
                dispatch!(instructions.level(), simd => noise_by(simd, generator, point)).to_bits()
            });
            assert_eq!(narrow, wide, "{generator:?} {point}");
        }
    }
}

#[test]
fn four_points_have_the_bits_of_each_alone_for_all_instructions() {
    let mut random = Random(7);
    let mut shared = 0;
    for _ in 0..tries() {
        let mut points = Rows::ZERO;
        let (first, size) = (point_of_any_kind(&mut random), random.size(-9.0, 0.5));
        for number in 0..LANES {
            let apart = if random.below(9) == 0 { point_of_any_kind(&mut random) } else { first };
            points.set(number, apart + random.point(size));
        }
        let lanes = 1 + random.below(15) as u32;
        for instructions in Instructions::all() {
            let (noise, triples) = dispatch!(instructions.level(), simd => {
                let points = WideVector::of(simd, &points, 0);
                let noise = GENERATORS
                    .map(|generator| noise_of_four(simd, generator, points, lanes).into());
                let WideVector([x, y, z]) = four::triples_of_four(simd, points, lanes);
                (noise, [x.into(), y.into(), z.into()])
            });
            let (noise, triples): ([[f64; 4]; 3], [[f64; 4]; 3]) = (noise, triples);
            for lane in numbers(lanes) {
                let point = points.at(lane);
                shared += usize::from((point - first).abs().max_element() < 0.01);
                for (generator, noise) in GENERATORS.into_iter().zip(noise) {
                    let alone = super::noise(generator, point);
                    assert_eq!(noise[lane].to_bits(), alone.to_bits(), "{generator:?} {point}");
                }
                let alone = vector_noise(point).to_array();
                assert_eq!(triples.map(|c| c[lane].to_bits()), alone.map(f64::to_bits), "{point}");
            }
        }
    }
    assert!(shared > tries(), "{shared}");
}

/// Two ways to sum the same, each rounded in its own order.
#[test]
fn noise_is_the_first_of_the_vector_around_one_half() {
    let mut random = Random(5);
    for _ in 0..tries() {
        let point = point_of_any_kind(&mut random);
        let expected = (vector_noise(point).x + 0.5).clamp(0.0, 1.0);
        let value = noise(NoiseGenerator::Plateaus, point);
        assert!((value - expected).abs() < 4e-15, "{point}: {value} {expected}");
    }
}

#[test]
fn layers_of_turbulence_have_the_bits_of_their_noise() {
    let mut random = Random(6);
    for _ in 0..tries() {
        let [lambda, omega] = [2.0, 0.5];
        let octaves = random.number(1.0, 11.0);
        let turbulence = Turbulence::new(lambda, omega, octaves);
        let point = point_of_any_kind(&mut random);
        let (mut sum, mut finer, mut weight) = (Vector::ZERO, 1.0, 1.0);
        for _ in 0..(octaves.min(10.0) as u8) {
            sum += vector_noise(point * finer) * weight;
            (finer, weight) = (finer * lambda, weight * omega);
        }
        assert_eq!(
            turbulence.vector(point).to_array().map(f64::to_bits),
            sum.to_array().map(f64::to_bits)
        );
    }
}

#[test]
fn noise_repeats_every_4096_units_along_each_axis() {
    let mut random = Random(1);
    for _ in 0..tries_in(3) {
        // Whole multiples of 2⁻²⁰ stay exact when moved.
        let point = (random.point(4096.0) * 1_048_576.0).floor() / 1_048_576.0;
        for axis in [Vector::X, Vector::Y, Vector::Z] {
            let moved = point + axis * 4096.0 * (random.below(100) as f64 - 50.0);
            assert_eq!(vector_noise(moved), vector_noise(point));
            for generator in GENERATORS {
                assert_eq!(noise(generator, moved), noise(generator, point));
            }
        }
    }
}

#[test]
fn noise_is_continuous_across_cells() {
    let mut random = Random(2);
    for _ in 0..tries() {
        let mut before = random.point(50.0);
        let axis = random.below(3);
        before[axis] = before[axis].floor();
        let mut after = before;
        before[axis] -= 1e-6;
        after[axis] += 1e-6;
        assert!((vector_noise(after) - vector_noise(before)).abs().max_element() < 1e-5);
        for generator in GENERATORS {
            assert!((noise(generator, after) - noise(generator, before)).abs() < 1e-5);
        }
    }
    for point in [Vector::ZERO, Vector::new(3.0, -7.0, 1000.0)] {
        let just_below = point - Vector::splat(1e-15);
        assert!((vector_noise(just_below) - vector_noise(point)).length() < 1e-12);
    }
}

#[test]
fn noise_fills_its_range_around_its_middle() {
    // The greatest of fewer is too often smaller.
    let count = 10 * tries();
    let mut random = Random(3);
    let points: Vec<Vector> = (0..count).map(|_| random.point(2000.0)).collect();
    for (generator, spread) in GENERATORS.into_iter().zip([0.24, 0.12, 0.15]) {
        let values = || points.iter().map(|point| noise(generator, *point));
        let mean = values().sum::<f64>() / count as f64;
        let variance = values().map(|v| (v - mean) * (v - mean)).sum::<f64>() / count as f64;
        assert!((mean - 0.5).abs() < 0.02, "{generator:?}: mean {mean}");
        assert!((variance.sqrt() - spread).abs() < 0.02, "{generator:?}: {}", variance.sqrt());
        assert!(values().all(|v| (0.0..=1.0).contains(&v)));
    }
    let greatest = points.iter().map(|p| vector_noise(*p).abs().max_element()).fold(0.0, f64::max);
    assert!((0.9..1.1).contains(&greatest), "{greatest}");
}

#[test]
fn every_point_has_noise_within_its_range() {
    let mut strange = vec![f64::INFINITY, f64::NAN, f64::MAX, 5e-324, 1e-310, 2.5, -0.0, 1e9, 1e15];
    strange.extend([31, 32, 52, 53, 62, 63, 64].map(|power| elementary::pow(2.0, power.into())));
    strange.extend(strange.clone().iter().map(|n| -n));
    for &x in &strange {
        for &y in &strange {
            for &z in &strange {
                let point = Vector::new(x, y, z);
                assert!(vector_noise(point).abs().max_element() <= 2.0, "{point}");
                for generator in GENERATORS {
                    assert!((0.0..=1.0).contains(&noise(generator, point)), "{point}");
                    let layers = Turbulence::default().number(generator, point);
                    assert!(layers.abs() < 4.0, "{point}");
                }
                assert!(Turbulence::default().vector(point).abs().max_element() < 4.0, "{point}");
            }
        }
    }
}

#[test]
fn large_coordinates_are_reduced_without_loss() {
    // What POV-Ray cannot hold in 32 bits still lies on the lattice that repeats.
    for large in [elementary::pow(2.0, 31.0), elementary::pow(2.0, 40.0)] {
        let near = Vector::new(0.25, 0.5, 0.75);
        assert_eq!(vector_noise(near + Vector::splat(large)), vector_noise(near));
        assert_eq!(vector_noise(near - Vector::splat(large)), vector_noise(near));
    }
}

#[test]
fn layers_of_turbulence_are_counted_from_one_to_ten() {
    let point = Vector::new(0.3, 0.6, 0.9);
    let layers = |octaves: f64| Turbulence::new(2.0, 0.5, octaves).vector(point);
    assert_eq!(layers(1.0), vector_noise(point));
    assert_eq!(layers(2.9), vector_noise(point) + vector_noise(2.0 * point) * 0.5);
    for few in [0.0, 0.99, -5.0, f64::NEG_INFINITY, f64::NAN] {
        assert_eq!(layers(few), layers(1.0));
    }
    assert_ne!(layers(9.0), layers(10.0));
    for many in [10.5, 11.0, 1e300, f64::INFINITY] {
        assert_eq!(layers(many), layers(10.0));
    }
}

#[test]
fn wild_turbulence_without_end_is_still_finite_where_its_layers_fade() {
    for lambda in [1e300, -1e300, 1e-300, f64::INFINITY] {
        let vector = Turbulence::new(lambda, 0.5, 10.0).vector(Vector::new(0.0, 1e-30, -1e300));
        assert!(vector.abs().max_element() < 4.0, "{lambda}: {vector}");
    }
}

#[test]
fn no_corners_of_a_cell_make_noise_steeper_than_is_said() {
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let mut steepest = 0.0_f64;
    for at in 0..16 * 16 * 16 {
        let place = [at / 256, at / 16 % 16, at % 16].map(|i| f64::from(i) / 15.0);
        for axis in 0..3 {
            // Each corner adds the most that it may.
            let corner = |corner: usize| {
                let side = |axis: usize| corner >> axis & 1;
                let offset = |axis: usize| place[axis] - side(axis) as f64;
                let weight = |axis: usize| match side(axis) {
                    0 => 1.0 - smooth(place[axis]),
                    _ => smooth(place[axis]),
                };
                let rise =
                    6.0 * place[axis] * (1.0 - place[axis]) * (2.0 * side(axis) as f64 - 1.0);
                let across = weight((axis + 1) % 3) * weight((axis + 2) % 3);
                let slope = |row: &table::CornerRow| {
                    let [value, x, y, z] = row.0;
                    let there = value + x * offset(0) + y * offset(1) + z * offset(2);
                    across * (rise * there + weight(axis) * row.0[1 + axis])
                };
                ROWS.iter().map(slope).fold(0.0, f64::max)
            };
            steepest = steepest.max((0..8).map(corner).sum());
        }
    }
    assert!((3.7..3.95).contains(&steepest), "{steepest}");
}

#[test]
fn noise_changes_no_faster_than_the_slopes_of_a_box_around_it() {
    let mut narrow = 0;
    for seed in 0..4_000 {
        let mut draw = Random::of(seed, 6);
        let generator =
            [NoiseGenerator::Plateaus, NoiseGenerator::RangeCorrected, NoiseGenerator::Perlin]
                [draw.below(3)];
        let width = [1e-3, 0.02, 0.3][draw.below(3)];
        let boxed =
            [(); 3].map(|()| draw.number(-9.0, 9.0)).map(|low| Interval { low, high: low + width });
        let (_, slopes) = bounds_and_slopes(generator, boxed);
        narrow += usize::from(slopes.iter().all(|slope| slope.high - slope.low < 1.0));
        for _ in 0..8 {
            let axis = draw.below(3);
            let from = Vector::from_array(boxed.map(|i| draw.number(i.low, i.high)));
            let mut to = from;
            to[axis] = draw.number(boxed[axis].low, boxed[axis].high);
            let step = to[axis] - from[axis];
            let slope = (noise(generator, to) - noise(generator, from)) / step;
            let (Interval { low, high }, off) = (slopes[axis], 2e-8 / step.abs());
            assert!(
                low - off <= slope && slope <= high + off,
                "{generator:?} {slope} not in {low} … {high}, {boxed:?}"
            );
        }
    }
    assert!(narrow > 1_000, "{narrow}");
}
