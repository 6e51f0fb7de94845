//! Tables of values measured on POV-Ray 3.7, for tests.

use super::{Kind, Sample, Setting};
use crate::math::Vector;
use crate::noise::{NoiseGenerator, Turbulence};

/// Returns the rows of a table, after its `#` lines.
pub(super) fn rows<const N: usize>(table: &str) -> Vec<[f64; N]> {
    let number = |text: &str| text.parse().expect("a number");
    let row = |line: &str| line.split(' ').map(number).collect::<Vec<f64>>();
    let lines = table.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| row(line).try_into().expect("as many numbers as each row has")).collect()
}

/// Asserts that a value is the measured one to a relative error of `tolerance`.
pub(super) fn assert_close(value: f64, measured: f64, tolerance: f64, what: &dyn std::fmt::Debug) {
    let off = (value - measured).abs();
    assert!(off <= tolerance * measured.abs().max(1.0), "{what:?}: {value} {measured}");
}

/// Asserts the values of a pattern under each noise generator; columns: a point, then a value for each.
pub(super) fn noises_are_those_measured(kind: Option<Kind>, table: &str) {
    let kind = kind.expect("a pattern");
    let rows = rows(table);
    assert!(rows.len() >= 30);
    for [x, y, z, one, two, three] in rows {
        let point = Vector::new(x, y, z);
        for (place, measured) in [one, two, three].into_iter().enumerate() {
            let setting = Setting { noise: generator(place as f64 + 1.0), ..Setting::default() };
            let sample = Sample { point, error: Vector::ZERO, setting: &setting };
            let value = kind.measured(&sample).value;
            assert_close(value, measured, 1e-14, &(kind, setting.noise, point));
        }
    }
}

/// Asserts the values of a pattern in the default setting; columns: a point and the value.
pub(super) fn values_are_those_measured(kind: Option<Kind>, table: &str, tolerance: f64) {
    let kind = kind.expect("a pattern");
    let rows = rows(table);
    assert!(rows.len() >= 30);
    for [x, y, z, measured] in rows {
        let point = Vector::new(x, y, z);
        let sample = Sample { point, error: Vector::ZERO, setting: &Setting::default() };
        assert_close(kind.measured(&sample).value, measured, tolerance, &(kind, point));
    }
}

/// Returns the setting of columns: the noise generator, lambda, omega, octaves, the amount of turbulence.
pub(super) fn setting([noise, lambda, omega, octaves, x, y, z]: [f64; 7]) -> Setting {
    Setting {
        noise: generator(noise),
        turbulence: Turbulence::new(lambda, omega, octaves),
        amount: Vector::new(x, y, z),
        ..Setting::default()
    }
}

fn generator(number: f64) -> NoiseGenerator {
    let all = [NoiseGenerator::Plateaus, NoiseGenerator::RangeCorrected, NoiseGenerator::Perlin];
    all[number as usize - 1]
}

/// Asserts the values of a pattern with turbulence; columns: those of [`setting`], a point, the value.
pub(super) fn turbulent_values_are_those_measured(kind: Option<Kind>, table: &str) {
    let kind = kind.expect("a pattern");
    let rows = rows(table);
    assert!(rows.len() >= 30);
    for [noise, lambda, omega, octaves, a, b, c, x, y, z, measured] in rows {
        let setting = setting([noise, lambda, omega, octaves, a, b, c]);
        assert_value(kind, Vector::new(x, y, z), &setting, measured, 1e-13);
    }
}

/// Asserts the values of a spiral; columns: the number of arms, then as with turbulence.
pub(super) fn spiral_values_are_those_measured(kind: impl Fn(f64) -> Kind, table: &str) {
    let rows = rows(table);
    assert!(rows.len() >= 30);
    for [arms, noise, lambda, omega, octaves, a, b, c, x, y, z, measured] in rows {
        let setting = setting([noise, lambda, omega, octaves, a, b, c]);
        let kind = kind(arms).canonical();
        let point = Vector::new(x, y, z);
        let point = point + setting.amount * setting.turbulence.vector(point);
        // Near the x axis POV-Ray's angles are less exact.
        assert_value(kind, point, &setting, measured, 1e-9);
    }
}

fn assert_value(kind: Kind, point: Vector, setting: &Setting, measured: f64, tolerance: f64) {
    let value = kind.measured(&Sample { point, error: Vector::ZERO, setting }).value;
    assert_close(value, measured, tolerance, &(kind, setting, point));
}

/// Asserts the values of ten waves; columns: frequency, phase, a point, the value.
pub(super) fn waves_are_those_measured(kind: Option<Kind>, table: &str) {
    let kind = kind.expect("a pattern");
    let rows = rows(table);
    assert!(rows.len() >= 30);
    for [frequency, phase, x, y, z, measured] in rows {
        let setting = Setting { frequency, phase, ..Setting::default() };
        assert_value(kind, Vector::new(x, y, z), &setting, measured, 1e-14);
    }
}
