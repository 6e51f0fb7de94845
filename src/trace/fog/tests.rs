//! Fog against POV-Ray 3.7's numbers, and its laws.

use super::*;
use crate::math::random::{Random, tries};
use crate::math::{UnitVector, Vector};
use crate::noise::{NoiseGenerator, Turbulence};

/// What POV-Ray 3.7 shows of rgb <0.9, 0.5, 0.2> behind random fogs. Each line: a ray's start, direction and
/// length; a fog's colour with filter and transmit, and its distance; whether it is ground fog, `fog_offset`,
/// `fog_alt`, `up`; whether it is stirred, `turbulence`, `turb_depth`, `octaves`, `lambda`, `omega`,
/// `noise_generator`; the colour seen.
const MEASURED: &str = include_str!("measured.txt");

fn uniform(distance: f64) -> Fog {
    let (color, tint) = (Rgb::new(0.3, 0.5, 0.7), Rgb::WHITE);
    Fog { color, tint, least: 0.0, distance, ground: None, churn: None }
}

fn ground(offset: f64, alt: f64) -> Ground {
    Ground { up: UnitVector::Y, offset, alt }
}

/// Returns the veil of fogs on a ray, which all instructions find alike.
fn alone(fogs: &[Fog], origin: Vector, direction: Vector, length: f64) -> Veil {
    let ray = Ray { origin, direction };
    let [first, second] = Instructions::all().map(|with| veil(fogs, with, &ray, length));
    assert_eq!(first, second);
    first
}

/// Returns the mean density over a ray.
fn density(ground: &Ground, origin: Vector, direction: Vector, length: f64) -> f64 {
    let rays = Rays::new([Ray { origin, direction }].iter());
    let mut row = [0.0; ROW];
    dispatch!(Instructions::best().level(), simd => {
        let way = Way { ray: rays.four(simd, 0), length: all(simd, length), lanes: 1 };
        store(way.density(simd, ground), &mut row, 0);
    });
    row[0]
}

#[test]
fn fog_is_as_dense_as_pov_ray_shows_it() {
    let behind = Rgb::new(0.9, 0.5, 0.2);
    let lines = MEASURED.lines().inspect(|line| {
        let numbers: Vec<f64> =
            line.split(' ').map(|number| number.parse().expect("a number")).collect();
        let vector = |at: usize| Vector::new(numbers[at], numbers[at + 1], numbers[at + 2]);
        let color = Rgb::new(numbers[7], numbers[8], numbers[9]);
        let filter = numbers[10];
        let up = UnitVector::from_direction(vector(16));
        let ground = up.filter(|_| numbers[13] == 1.0).map(|up| Ground {
            up,
            offset: numbers[14],
            alt: numbers[15],
        });
        let noise = match numbers[27] {
            1.0 => NoiseGenerator::Plateaus,
            2.0 => NoiseGenerator::RangeCorrected,
            _ => NoiseGenerator::Perlin,
        };
        let churn = Churn {
            scale: vector(20),
            depth: numbers[23],
            turbulence: Turbulence::new(numbers[25], numbers[26], numbers[24]),
            noise,
        };
        let fog = Fog {
            color,
            tint: color.map(|c| 1.0 - filter + filter * c),
            least: numbers[11],
            distance: numbers[12],
            ground,
            churn: (numbers[19] == 1.0).then_some(churn),
        };
        let Veil { through, added } = alone(&[fog], vector(0), vector(3), numbers[6]);
        let seen = (behind * through + added).components();
        for (place, seen) in seen.into_iter().enumerate() {
            let theirs = numbers[28 + place];
            assert!((seen - theirs).abs() < 2e-5, "{line}: {seen} {theirs}");
        }
    });
    assert_eq!(lines.count(), 48);
}

#[test]
fn several_fogs_let_through_the_product_and_add_the_sum() {
    // Distances 3 and 5 at distance 2, as POV-Ray 3.7 shows them.
    let with = |distance, color, tint, least| Fog { color, tint, least, ..uniform(distance) };
    let first = with(3.0, Rgb::new(0.5, 1.0, 0.2), Rgb::new(0.7, 1.0, 0.52), 0.6);
    let second = with(5.0, Rgb::new(0.0, 0.3, 1.0), Rgb::new(0.7, 0.79, 1.0), 0.9);
    for fogs in [[first, second], [second, first]] {
        let Veil { through, added } = alone(&fogs, Vector::ZERO, Vector::Z, 2.0);
        let seen = (Rgb::new(1.0, 0.3, 0.5) * through + added).components();
        let theirs = [0.464_607, 0.557_977, 0.320_394];
        assert!(seen.iter().zip(theirs).all(|(a, b)| (a - b).abs() < 2e-5), "{seen:?}");
    }
}

#[test]
fn a_ray_in_two_parts_passes_as_much_fog_as_in_one() {
    let mut random = Random(11);
    for _ in 0..tries() {
        let fog = Fog {
            ground: Some(ground(0.0, random.size(-6.0, 6.0))),
            ..uniform(random.size(-3.0, 6.0))
        };
        let direction = random.direction().get();
        let start = random.point(1.0) * random.size(-3.0, 6.0);
        let (one, two) = (random.size(-3.0, 6.0), random.size(-3.0, 6.0));
        let depth = |start, length| {
            let density = fog.ground.map_or(1.0, |g| density(&g, start, direction, length));
            density * length / fog.distance
        };
        let all = depth(start, one + two);
        let parts = depth(start, one) + depth(start + direction * one, two);
        // The heights of both parts are rounded.
        let off = 1e-15 * (start.length() + one + two) / fog.distance;
        assert!((all - parts).abs() <= 1e-9 * all + off, "{fog:?} {all} {parts}");
    }
}

#[test]
fn a_nearly_level_ray_has_the_density_of_its_height() {
    // 1e-9 … 1e9 long, and so steep that the heights of its ends differ in the last bits only, if at all.
    for exponent in -9..=9 {
        let length = crate::math::elementary::pow(10.0, f64::from(exponent));
        for slope in [0.0, 1e-300, 1e-30, -1e-22, 1e-17 / length, -1e-17 / length] {
            let direction = Vector::new(1.0, slope, 0.0);
            for height in [1e-9, 0.5, 1.0, 30.0, 1e9] {
                let density = density(&ground(0.0, 2.0), Vector::Y * height, direction, length);
                let u = height / 2.0;
                let exact = 1.0 / (1.0 + u * u);
                assert!((density / exact - 1.0).abs() < 1e-7, "{length} {slope} {height}");
            }
        }
    }
}

#[test]
fn a_ray_far_above_the_fog_keeps_its_digits() {
    // From height a to b the integral is tan⁻¹((b − a)/(1 + ab)); a difference of two arc tangents near π/2 would
    // have no digit left.
    for height in [1e5, 1e8, 1e12, 1e30] {
        let density = density(&ground(0.0, 1.0), Vector::Y * height, Vector::Y, height);
        let exact = 0.5 / height / height;
        assert!((density / exact - 1.0).abs() < 1e-9, "{height}: {density:e}");
    }
}

#[test]
fn fog_without_an_alt_ends_at_its_offset() {
    let sharp = ground(1.0, Ground::SHARP);
    let between = |from: f64, to: f64| {
        density(&sharp, Vector::Y * from, Vector::Y * (to - from).signum(), (to - from).abs())
    };
    assert_eq!(between(-3.0, 0.5), 1.0);
    assert_eq!(between(-1.0, 3.0), 0.5);
    assert_eq!(between(3.0, -1.0), 0.5);
    assert!(between(1.5, 3.0) < 1e-50);
    assert_eq!(density(&sharp, Vector::Y, Vector::X, 5.0), 1.0);
}

#[test]
fn the_sky_is_veiled_whole_by_any_fog_of_a_scene() {
    let Veil { through, added } = alone(&[uniform(1e8)], Vector::ZERO, Vector::Z, SKY);
    assert!(through.largest() < 1e-80 && added == uniform(1.0).color);
    let clear = Fog { least: 0.25, ..uniform(1.0) };
    assert_eq!(alone(&[clear], Vector::ZERO, Vector::Z, SKY).through, Rgb::gray(0.25));
}

#[test]
fn fog_of_a_negative_distance_brightens_as_in_pov_ray() {
    let fog = Fog { color: Rgb::BLACK, ..uniform(-3.0) };
    let seen = |fog: Fog, length| alone(&[fog], Vector::ZERO, Vector::Z, length).through.red * 0.1;
    assert!((seen(fog, 2.0) - 0.194_77).abs() < 1e-5);
    let stirred = |omega| {
        let turbulence = Turbulence::new(2.0, omega, 6.0);
        let (scale, noise) = (Vector::ONE, NoiseGenerator::RangeCorrected);
        Fog { churn: Some(Churn { scale, depth: 0.5, turbulence, noise }), ..fog }
    };
    assert!((seen(stirred(0.5), 2.0) - 0.099).abs() < 1e-5);
    assert!((seen(stirred(3.0), 2.0) - 0.053_16).abs() < 1e-5);
    assert_eq!(seen(fog, SKY), 0.0);
}

#[test]
fn no_numbers_break_it() {
    let mut random = Random(12);
    let sizes = [0.0, 1e-300, 1e-60, 1e-9, 1.0, 1e9, 1e60, 1e300];
    let mut size = || {
        let size = sizes[random.below(sizes.len())];
        if random.below(2) == 0 { size } else { -size }
    };
    for turn in 0..20_000 {
        let mut vector = || Vector::new(size(), size(), size());
        let (start, aim, up, scale) = (vector(), vector(), vector(), vector());
        let unit = |v| UnitVector::from_direction(v).unwrap_or(UnitVector::Y);
        let or_one = |number: f64| if number == 0.0 { 1.0 } else { number };
        let alt = or_one(size());
        let alt = alt.signum() * alt.abs().max(Ground::SHARP);
        let distance = or_one(size());
        let fog = Fog {
            least: size().abs(),
            distance: distance.signum() * distance.abs().max(1e-10),
            ground: (turn % 4 != 0).then_some(Ground { up: unit(up), offset: size(), alt }),
            churn: (turn % 2 == 0).then_some(Churn {
                scale,
                depth: or_one(size()),
                turbulence: Turbulence::new(size(), size(), size()),
                noise: NoiseGenerator::RangeCorrected,
            }),
            ..uniform(1.0)
        };
        let length = size().abs();
        let Veil { through, added } = alone(&[fog, fog], start, unit(aim).get(), length);
        assert!(through.is_finite() && added.is_finite(), "{fog:?} {start} {length}");
    }
}

#[test]
fn rays_side_by_side_have_the_veils_of_each_alone() {
    let mut random = Random(13);
    for _ in 0..tries() {
        let stirred = Churn {
            scale: Vector::new(0.3, 1.0, 2.0),
            depth: random.number(-1.0, 2.0),
            turbulence: Turbulence::new(2.0, 0.5, 6.0),
            noise: NoiseGenerator::RangeCorrected,
        };
        let distance = random.size(-2.0, 3.0) * [-1.0, 1.0][random.below(2)];
        let low = Fog {
            ground: Some(ground(random.number(-2.0, 2.0), random.size(-2.0, 2.0))),
            churn: Some(stirred),
            ..uniform(distance)
        };
        let fogs = [low, uniform(random.size(-1.0, 3.0))];
        let list: [Ray; ROW] = std::array::from_fn(|_| Ray {
            origin: random.point(3.0),
            direction: random.direction().get(),
        });
        let lengths = std::array::from_fn(|_| random.size(-3.0, 6.0));
        let mask = random.bits() as u32 & 0xffff;
        let mut veils = [Veil::NONE; ROW];
        add(&fogs, Instructions::best(), (&Rays::new(list.iter()), mask), &lengths, &mut veils);
        for number in 0..ROW {
            let Ray { origin, direction } = list[number];
            let expected = match mask >> number & 1 {
                1 => alone(&fogs, origin, direction, lengths[number]),
                _ => Veil::NONE,
            };
            assert_eq!(veils[number], expected);
        }
    }
}
