//! `mandel <iterations>`: the Mandelbrot set in the x-y plane, for z → zᵖ + c.

use super::Pattern;
use super::orbit::{Complex, Orbit, Reading, canonical_iterations};
use super::parameter::parameters;
use super::{Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// Follows z → zᵖ + c from z = c, the point x + iy, until |z| > 2. By default, the value is 1 for points
    /// of the set, and otherwise the number of iterations before the one that left it, divided by
    /// `iterations`.
    ///
    /// **Source:** POV-Ray manual, section "Fractal Pattern".
    pub struct Mandel {
        after iterations: f64 = 10.0, "the number of iterations";
        "exponent" exponent: f64 = 2.0, "the exponent of z";
        "exterior" exterior: [f64; 2] = [1.0, 1.0], "the value outside, by type and factor";
        "interior" interior: [f64; 2] = [0.0, 1.0], "the value inside, by type and factor";
    }
}

impl Mandel {
    fn reading(&self) -> Reading {
        Reading { exterior: self.exterior, interior: self.interior }
    }
}

impl Pattern for Mandel {
    const COST: &str = "its iterations a point";
    const COLORS: &[(f64, [f64; 3])] = &[
        (0.0, [0.0; 3]),
        (0.001, [0.0; 3]),
        (0.001, [0.0, 1.0, 1.0]),
        (0.012, [1.0, 1.0, 0.0]),
        (0.015, [1.0, 0.0, 1.0]),
        (0.1, [0.0, 1.0, 1.0]),
    ];
    fn canonical(self) -> Self {
        let Reading { exterior, interior } = self.reading().canonical();
        let iterations = canonical_iterations(self.iterations);
        Self { iterations, exponent: canonical_exponent(self.exponent), exterior, interior }
    }

    fn value(&self, sample: &Sample) -> f64 {
        let c = Complex::new(sample.point.x, sample.point.y);
        let orbit = powers(c, c, self.exponent, self.iterations);
        self.reading().value(&orbit, self.iterations)
    }

    fn bounds(&self, _point: Vector, _reach: Vector, _setting: &Setting) -> Interval {
        self.reading().range()
    }
}

/// Truncates an exponent; like POV-Ray 3.7, takes one outside of 2 … 33 for 2.
pub(super) fn canonical_exponent(exponent: f64) -> f64 {
    let whole = exponent.trunc();
    if (2.0..=33.0).contains(&whole) { whole } else { 2.0 }
}

/// Returns the orbit of `start` for z → zᵖ + c.
#[inline]
pub(super) fn powers(start: Complex, c: Complex, exponent: f64, iterations: f64) -> Orbit {
    let exponent = exponent as u32;
    // An overflow counts as having left, too.
    let leaves = |_: Complex, squared: f64| {
        let stays = squared <= 4.0;
        !stays
    };
    let least = start.norm_squared();
    let iterations = iterations as u32;
    match exponent {
        2 => Orbit::follow(start, least, iterations, |z| Some(z.squared().plus(c)), leaves),
        _ => Orbit::follow(start, least, iterations, |z| Some(z.power(exponent).plus(c)), leaves),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::measured::{assert_close, rows};

    #[test]
    fn values_are_those_of_pov_ray() {
        let rows = rows(include_str!("measured/mandel.txt"));
        assert!(rows.len() > 40);
        for [iterations, exponent, outer, a, inner, b, x, y, measured] in rows {
            let kind = Mandel { iterations, exponent, exterior: [outer, a], interior: [inner, b] }
                .canonical();
            let point = Vector::new(x, y, 3.0);
            let setting = Setting::default();
            let value = kind.value(&Sample { point, error: Vector::ZERO, setting: &setting });
            assert_close(value, measured, 1e-9, &(kind, point));
        }
    }

    #[test]
    fn points_of_the_set_take_no_longer_with_millions_of_iterations() {
        let kind = Mandel { iterations: 4e9, ..Mandel::default() }.canonical();
        let setting = Setting::default();
        for x in -20..5 {
            let point = Vector::new(f64::from(x) * 0.0371, 0.013, 0.0);
            let value = kind.value(&Sample { point, error: Vector::ZERO, setting: &setting });
            assert_eq!(value, 1.0);
        }
    }
}
