//! `magnet <type> mandel <iterations>`: the Mandelbrot set of a magnet's renormalization, in the x-y plane.

use super::Pattern;
use super::orbit::{Complex, Orbit, Reading, canonical_iterations};
use super::parameter::parameters;
use super::{Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// Follows the map of `magnet` from z = 0 for c = x + iy. The value is as for [`Mandel`](super::Mandel).
    ///
    /// **Source:** POV-Ray manual, section "Fractal Pattern".
    pub struct MagnetMandel {
        after kind: f64 = 1.0, "the type, 1 or 2";
        after iterations: f64 = 10.0, "the number of iterations";
        "exterior" exterior: [f64; 2] = [1.0, 1.0], "the value outside, by type and factor";
        "interior" interior: [f64; 2] = [0.0, 1.0], "the value inside, by type and factor";
    }
}

impl MagnetMandel {
    fn reading(&self) -> Reading {
        Reading { exterior: self.exterior, interior: self.interior }
    }
}

impl Pattern for MagnetMandel {
    const COST: &str = "its iterations a point";

    fn canonical(self) -> Self {
        let Reading { exterior, interior } = self.reading().canonical();
        let iterations = canonical_iterations(self.iterations);
        Self { kind: canonical_kind(self.kind), iterations, exterior, interior }
    }

    fn value(&self, sample: &Sample) -> f64 {
        let c = Complex::new(sample.point.x, sample.point.y);
        let start = Complex::new(0.0, 0.0);
        let orbit = magnet(self.kind, start, c, f64::INFINITY, self.iterations);
        self.reading().value(&orbit, self.iterations)
    }

    fn bounds(&self, _point: Vector, _reach: Vector, _setting: &Setting) -> Interval {
        self.reading().range()
    }
}

/// Truncates a type; one that does not exist becomes 1.
pub(super) fn canonical_kind(kind: f64) -> f64 {
    if kind.trunc() == 2.0 { 2.0 } else { 1.0 }
}

/// Returns the orbit of `start` until |z| > 100 or |z − 1| < 0.01, for type 1 of
///
/// ```text
/// z → ((z² + c − 1) / (2z + c − 2))²
/// ```
///
/// and for type 2 of
///
/// ```text
/// z → ((z³ + 3(c − 1)z + (c − 1)(c − 2)) / (3z² + 3(c − 2)z + (c − 1)(c − 2) + 1))²
/// ```
///
/// `least` is an upper bound of the squared absolute values. The orbit ends inside where the divisor is 0, as
/// in POV-Ray 3.7.
///
/// **Source:** H.-O. Peitgen, P. H. Richter, *The Beauty of Fractals*, 1986; limits measured on POV-Ray 3.7.
#[inline]
pub(super) fn magnet(kind: f64, start: Complex, c: Complex, least: f64, iterations: f64) -> Orbit {
    let (less_1, less_2) = (c.plus_real(-1.0), c.plus_real(-2.0));
    let product = less_1.times(less_2);
    let leaves = |z: Complex, squared: f64| {
        // An overflow counts as having left, too.
        let stays = squared <= 1e4 && z.plus_real(-1.0).norm_squared() >= 1e-4;
        !stays
    };
    let iterations = iterations as u32;
    if kind == 1.0 {
        let step = |z: Complex| {
            let quotient = z.squared().plus(less_1).over(z.scaled(2.0).plus(less_2))?;
            Some(quotient.squared())
        };
        Orbit::follow(start, least, iterations, step, leaves)
    } else {
        let (three_1, three_2) = (less_1.scaled(3.0), less_2.scaled(3.0));
        let step = |z: Complex| {
            let squared = z.squared();
            let above = squared.times(z).plus(three_1.times(z)).plus(product);
            let below = squared.scaled(3.0).plus(three_2.times(z)).plus(product).plus_real(1.0);
            Some(above.over(below)?.squared())
        };
        Orbit::follow(start, least, iterations, step, leaves)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::measured::{assert_close, rows};

    #[test]
    fn values_are_those_of_pov_ray() {
        let rows = rows(include_str!("measured/magnet_mandel.txt"));
        assert!(rows.len() > 40);
        for [kind, iterations, outer, a, inner, b, x, y, measured] in rows {
            let pattern =
                MagnetMandel { kind, iterations, exterior: [outer, a], interior: [inner, b] }
                    .canonical();
            let point = Vector::new(x, y, 3.0);
            let setting = Setting::default();
            let value = pattern.value(&Sample { point, error: Vector::ZERO, setting: &setting });
            assert_close(value, measured, 1e-9, &(pattern, point));
        }
    }

    #[test]
    fn a_divisor_of_zero_ends_an_orbit_inside() {
        let sample = Sample {
            point: Vector::new(2.0, 0.0, 0.0),
            error: Vector::ZERO,
            setting: &Setting::default(),
        };
        assert_eq!(MagnetMandel::default().value(&sample), 1.0);
    }
}
