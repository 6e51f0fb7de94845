//! `julia <c>, <iterations>`: the Julia set of z → zᵖ + c in the x-y plane.

use super::Pattern;
use super::mandel::{canonical_exponent, powers};
use super::orbit::{Complex, Reading, canonical_iterations};
use super::parameter::parameters;
use super::{Sample, Setting};
use crate::math::Vector;
use crate::math::finite::finite;
use crate::math::interval::Interval;

parameters! {
    /// Follows z → zᵖ + c from the point x + iy until |z| > 2. The value is as for [`Mandel`](super::Mandel).
    ///
    /// **Source:** POV-Ray manual, section "Fractal Pattern".
    pub struct Julia {
        after c: Vector = Vector::ZERO, "the complex number c, as <re, im>";
        after iterations: f64 = 10.0, "the number of iterations";
        "exponent" exponent: f64 = 2.0, "the exponent of z";
        "exterior" exterior: [f64; 2] = [1.0, 1.0], "the value outside, by type and factor";
        "interior" interior: [f64; 2] = [0.0, 1.0], "the value inside, by type and factor";
    }
}

impl Julia {
    fn reading(&self) -> Reading {
        Reading { exterior: self.exterior, interior: self.interior }
    }
}

impl Pattern for Julia {
    const COST: &str = "its iterations a point";

    fn canonical(self) -> Self {
        let Reading { exterior, interior } = self.reading().canonical();
        let iterations = canonical_iterations(self.iterations);
        let c = Vector::new(finite(self.c.x), finite(self.c.y), 0.0);
        Self { c, iterations, exponent: canonical_exponent(self.exponent), exterior, interior }
    }

    fn value(&self, sample: &Sample) -> f64 {
        let start = Complex::new(sample.point.x, sample.point.y);
        let c = Complex::new(self.c.x, self.c.y);
        let orbit = powers(start, c, self.exponent, self.iterations);
        self.reading().value(&orbit, self.iterations)
    }

    fn bounds(&self, _point: Vector, _reach: Vector, _setting: &Setting) -> Interval {
        self.reading().range()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::measured::{assert_close, rows};

    #[test]
    fn values_are_those_of_pov_ray() {
        let rows = rows(include_str!("measured/julia.txt"));
        assert!(rows.len() > 40);
        for [re, im, iterations, exponent, outer, a, inner, b, x, y, measured] in rows {
            let c = Vector::new(re, im, 0.0);
            let kind =
                Julia { c, iterations, exponent, exterior: [outer, a], interior: [inner, b] }
                    .canonical();
            let point = Vector::new(x, y, 3.0);
            let setting = Setting::default();
            let value = kind.value(&Sample { point, error: Vector::ZERO, setting: &setting });
            assert_close(value, measured, 1e-9, &(kind, point));
        }
    }
}
