//! Rainbows against POV-Ray 3.7's numbers, and their laws.

use super::*;
use crate::math::UnitVector;
use crate::math::elementary::{RADIANS_PER_DEGREE, cos, sin};
use crate::math::random::Random;
use crate::trace::fog::SKY;

/// What POV-Ray 3.7 shows of rgb <0.9, 0.5, 0.2> behind random rainbows. Each line: a ray's direction and length; a
/// rainbow's `direction`, `angle`, `width`, `distance`, `up`, `arc_angle` and `falloff_angle`, where −1 is none; the
/// colour seen; the entries of the map: position, red, green, blue, filter, transmit.
const MEASURED: &str = include_str!("measured.txt");

fn unit(vector: Vector) -> UnitVector {
    UnitVector::from_direction(vector).unwrap_or(UnitVector::Z)
}

/// A rainbow around z from 10 to 30 degrees.
fn band(colors: &[(f64, Color)]) -> Rainbow {
    Rainbow {
        direction: UnitVector::Z,
        up: UnitVector::Y,
        inner: 10.0 * RADIANS_PER_DEGREE,
        width: 20.0 * RADIANS_PER_DEGREE,
        distance: 5.0,
        colors: colors.to_vec(),
        jitter: 0.0,
        arc: 180.0,
        fade: 180.0,
    }
}

fn color(red: f64, green: f64, blue: f64, filter: f64, transmit: f64) -> Color {
    Color { rgb: Rgb::new(red, green, blue), filter, transmit }
}

fn seen(rainbows: &[Rainbow], behind: Rgb, direction: Vector, length: f64) -> Rgb {
    match veil(rainbows, Vector::ZERO, unit(direction).get(), length) {
        Some(Veil { through, added }) => behind * through + added,
        None => behind,
    }
}

fn assert_near(ours: Rgb, theirs: [f64; 3], case: &str) {
    // A picture shows nothing below 0.
    let ours = ours.components().map(|component| component.max(0.0));
    assert!(ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() < 2e-5), "{case}: {ours:?}");
}

#[test]
fn rainbows_are_as_pov_ray_shows_them() {
    let lines = MEASURED.lines().inspect(|line| {
        let numbers: Vec<f64> =
            line.split(' ').map(|number| number.parse().expect("a number")).collect();
        let vector = |at: usize| Vector::new(numbers[at], numbers[at + 1], numbers[at + 2]);
        let axis = unit(vector(4));
        let half = |angle: f64| if angle < 0.0 { 180.0 } else { 0.5 * angle * RADIANS_PER_DEGREE };
        let entries = numbers[18..].chunks(6).map(|e| (e[0], color(e[1], e[2], e[3], e[4], e[5])));
        let rainbow = Rainbow {
            direction: axis,
            up: unit(vector(10) - axis.get() * axis.get().dot(vector(10))),
            inner: (numbers[7] - 0.5 * numbers[8]) * RADIANS_PER_DEGREE,
            width: numbers[8] * RADIANS_PER_DEGREE,
            distance: numbers[9],
            colors: entries.collect(),
            arc: half(numbers[13]),
            fade: half(numbers[14]),
            ..band(&[])
        };
        let shown = seen(&[rainbow], Rgb::new(0.9, 0.5, 0.2), vector(0), numbers[3]);
        assert_near(shown, [numbers[15], numbers[16], numbers[17]], line);
    });
    assert_eq!(lines.count(), 48);
}

#[test]
fn where_several_overlap_their_mean_shows() {
    // Along the middle of the bands, from rgb <0.3, 0.6, 0.9> at distance 3, as POV-Ray 3.7 shows it.
    let of = |only, distance| Rainbow { distance, ..band(&[(0.0, only)]) };
    let one = of(color(0.1, 0.5, 0.7, 0.5, 0.2), 5.0);
    let other = of(color(0.8, 0.2, 0.4, 0.3, 0.1), 2.0);
    let far = of(color(0.0, 0.0, 0.0, 0.0, 0.0), 1e9);
    let missed = Rainbow { inner: 0.7, ..other.clone() };
    let (behind, up) = (Rgb::new(0.3, 0.6, 0.9), Vector::new(0.0, 0.36, 1.0));
    for (rainbows, theirs) in [
        (vec![one.clone()], [0.176_334, 0.517_739, 0.776_334]),
        (vec![one.clone(), other.clone()], [0.430_823, 0.391_012, 0.629_908]),
        (vec![other.clone(), one.clone()], [0.430_823, 0.391_012, 0.629_908]),
        (vec![one.clone(), other, one.clone()], [0.345_998, 0.433_249, 0.678_721]),
        (vec![one.clone(), missed], [0.176_334, 0.517_739, 0.776_334]),
        // It counts, although nothing of it shows.
        (vec![one, far], [0.238_167, 0.558_869, 0.838_167]),
    ] {
        assert_near(seen(&rainbows, behind, up, 3.0), theirs, &format!("{}", rainbows.len()));
    }
}

#[test]
fn jitter_is_the_same_for_a_ray_and_keeps_the_mean() {
    let gray = band(&[(0.0, Color::BLACK), (1.0, Color::WHITE)]);
    let jittered = Rainbow { jitter: 0.25, ..gray };
    let ray = |i: u32| {
        let angle = (12.0 + 16.0 * f64::from(i % 64) / 63.0) * RADIANS_PER_DEGREE;
        unit(Vector::new(0.0, sin(angle), cos(angle))).get()
    };
    let at = |i: u32| {
        let start = Vector::X * f64::from(i / 64);
        veil(std::slice::from_ref(&jittered), start, ray(i), SKY).map(|veil| veil.added.red)
    };
    let values: Vec<f64> = (0..4096).filter_map(at).collect();
    assert!((0..64).all(|i| at(i) == at(i)) && at(0) != at(64));
    // Few are moved out of the band at its edges; POV-Ray 3.7 loses as many.
    assert!((3810..3920).contains(&values.len()), "{}", values.len());
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    assert!((mean - 0.5).abs() < 0.01, "{mean}");
}

#[test]
fn a_ray_at_more_than_a_right_angle_sees_none() {
    let wide = Rainbow { inner: 0.0, width: 3.0, ..band(&[(0.0, Color::WHITE)]) };
    let shows =
        |direction| veil(std::slice::from_ref(&wide), Vector::ZERO, direction, SKY).is_some();
    assert!(shows(Vector::X) && shows(unit(Vector::new(1.0, 0.0, 1e-9)).get()));
    assert!(!shows(-Vector::Z) && !shows(unit(Vector::new(1.0, 0.0, -1e-9)).get()));
}

#[test]
fn no_numbers_break_it() {
    let mut random = Random(14);
    let sizes = [0.0, 1e-300, 1e-60, 1e-9, 0.3, 1.0, 1e9, 1e60, 1e300];
    let mut size = || {
        let size = sizes[random.below(sizes.len())];
        if random.below(3) > 0 { size } else { -size }
    };
    let mut shown = 0;
    for _ in 0..20_000 {
        let mut vector = || Vector::new(size(), size(), size());
        let (start, direction, axis) = (vector(), unit(vector()).get(), unit(vector()));
        let up = unit(axis.get().cross(unit(vector()).get()));
        let mut color = || color(size(), size(), size(), size(), size());
        let colors = vec![(0.0, color()), (0.5, color()), (0.5, color())];
        let or_one = |number: f64| if number == 0.0 { 1.0 } else { number };
        let (inner, width, distance) = (size(), or_one(size()), or_one(size()));
        let (jitter, arc, fade) = (size(), size().abs(), size().abs());
        let rainbow =
            Rainbow { direction: axis, up, inner, width, distance, colors, jitter, arc, fade };
        let veil = veil(&[rainbow.clone(), rainbow.clone()], start, direction, size().abs());
        if let Some(Veil { through, added }) = veil {
            shown += 1;
            assert!(through.is_finite() && added.is_finite(), "{rainbow:?} {start} {direction}");
        }
    }
    assert!(shown > 500, "{shown}");
}
