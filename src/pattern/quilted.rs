//! `quilted`: unit cubes with a smooth hollow at their centres.

use super::parameter::parameters;
use super::{Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::finite::single;
use crate::math::interval::Interval;

parameters! {
    /// 0 at the centre of each cell of the unit lattice, and continuous across the sides. With r the distance
    /// from the centre, and s the sum of the absolute coordinates relative to it, the value is
    /// 2/√3 · s · r · (c0·(1 − r)² + c1·r·(1 − r) + r²/3), without its sign. It may exceed 1.
    ///
    /// **Source:** POV-Ray manual, section "Quilted Pattern"; the formula fitted to values of POV-Ray 3.7,
    /// which has the controls in single precision, and 1/√3 to nine digits.
    pub struct Quilted {
        "control0" inner: f64 = 1.0, "the slope of the curve at the centre of a cell";
        "control1" outer: f64 = 1.0, "the slope of the curve at the corners of a cell";
    }
}

/// 1/√3, as POV-Ray 3.7 has it.
const ROOT: f64 = 0.577_350_269;

impl Pattern for Quilted {
    const FREQUENCY: f64 = 0.0;
    const RANGE: Interval = Interval { low: 0.0, high: f64::INFINITY };

    /// Rounds the controls to single precision.
    fn canonical(self) -> Self {
        Self { inner: single(self.inner), outer: single(self.outer) }
    }

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        let point = sample.point;
        let offset = point - point.floor() - Vector::splat(0.5);
        let sum = offset.abs().element_sum();
        let r = offset.length();
        let rest = 1.0 - r;
        let curve = self.inner * rest * rest + self.outer * r * rest + r * r / 3.0;
        (2.0 * ROOT * sum * r * curve).abs()
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let value = self.value(&Sample { point, error: Vector::ZERO, setting });
        // s ≤ 3/2, r ≤ √3/2 and their slopes √3 and 1; the curve's parts are at most 1, ¼ and ¼, with slopes of
        // at most 2, 1 and 0.6.
        let (inner, outer) = (self.inner.abs(), self.outer.abs());
        let most = 2.0 * ROOT * 1.5 * 0.867 * (inner + 0.25 * outer + 0.25);
        let slope = 2.0 * ROOT * (1.5 + 0.867 * 1.733) * (inner + 0.25 * outer + 0.25)
            + 2.0 * ROOT * 1.5 * 0.867 * (2.0 * inner + outer + 0.6);
        // More than the rounding errors of coordinates and values.
        let rounded = 1e-15 * (point.abs().max_element() + 8.0);
        let far = slope * (reach.length() + rounded);
        Interval { low: (value - far).max(0.0), high: (value + far).min(most * 1.001) }
    }

    /// Returns a vector away from the middle of the cell. Its length is r · 2/√3 (1 at a corner), r being the
    /// distance, times a cubic Bézier curve over r from 0 through the controls to 1.
    ///
    /// **Source:** POV-Ray manual, section "Quilted Pattern"; the curve is measured on POV-Ray 3.7.
    fn displacement(&self, _normal: Vector, sample: &Sample) -> Option<Vector> {
        let offset = sample.point - sample.point.floor() - Vector::splat(0.5);
        let (r, rest) = (offset.length(), 1.0 - offset.length());
        let curve = r * (3.0 * rest * (self.inner * rest + self.outer * r) + r * r);
        Some(offset * (curve * 1.154_700_538_379_251_7))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::measured::{assert_close, rows};

    #[test]
    fn values_are_those_of_pov_ray() {
        let rows = rows(include_str!("measured/quilted.txt"));
        assert!(rows.len() > 40);
        for [inner, outer, x, y, z, measured] in rows {
            let quilted = Quilted { inner, outer }.canonical();
            let (point, setting) = (Vector::new(x, y, z), Setting::default());
            let value = quilted.value(&Sample { point, error: Vector::ZERO, setting: &setting });
            assert_close(value, measured, 1e-14, &(quilted, point));
        }
    }
}
