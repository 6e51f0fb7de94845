//! `magnet <type> julia <c>, <iterations>`: the Julia set of a magnet's renormalization, in the x-y plane.

use super::Pattern;
use super::magnet_mandel::{canonical_kind, magnet};
use super::orbit::{Complex, Reading, canonical_iterations};
use super::parameter::parameters;
use super::{Sample, Setting};
use crate::math::Vector;
use crate::math::finite::finite;
use crate::math::interval::Interval;

parameters! {
    /// Follows the map of `magnet` from z = x + iy. The value is as for [`Mandel`](super::Mandel).
    ///
    /// **Source:** POV-Ray manual, section "Fractal Pattern".
    pub struct MagnetJulia {
        after kind: f64 = 1.0, "the type, 1 or 2";
        after c: Vector = Vector::ZERO, "the complex number c, as <re, im>";
        after iterations: f64 = 10.0, "the number of iterations";
        "exterior" exterior: [f64; 2] = [1.0, 1.0], "the value outside, by type and factor";
        "interior" interior: [f64; 2] = [0.0, 1.0], "the value inside, by type and factor";
    }
}

impl MagnetJulia {
    fn reading(&self) -> Reading {
        Reading { exterior: self.exterior, interior: self.interior }
    }
}

impl Pattern for MagnetJulia {
    const COST: &str = "its iterations a point";

    fn canonical(self) -> Self {
        let Reading { exterior, interior } = self.reading().canonical();
        let iterations = canonical_iterations(self.iterations);
        let c = Vector::new(finite(self.c.x), finite(self.c.y), 0.0);
        Self { kind: canonical_kind(self.kind), c, iterations, exterior, interior }
    }

    fn value(&self, sample: &Sample) -> f64 {
        let start = Complex::new(sample.point.x, sample.point.y);
        let c = Complex::new(self.c.x, self.c.y);
        let orbit = magnet(self.kind, start, c, start.norm_squared(), self.iterations);
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
        let rows = rows(include_str!("measured/magnet_julia.txt"));
        assert!(rows.len() > 40);
        for [kind, re, im, iterations, outer, a, inner, b, x, y, measured] in rows {
            let c = Vector::new(re, im, 0.0);
            let pattern =
                MagnetJulia { kind, c, iterations, exterior: [outer, a], interior: [inner, b] }
                    .canonical();
            let point = Vector::new(x, y, 3.0);
            let setting = Setting::default();
            let value = pattern.value(&Sample { point, error: Vector::ZERO, setting: &setting });
            assert_close(value, measured, 1e-9, &(pattern, point));
        }
    }
}
