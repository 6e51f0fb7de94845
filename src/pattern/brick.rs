//! `brick`: a wall of bricks with mortar between them.

use super::lattice::{cell, remainder};
use super::parameter::parameters;
use super::{Pattern, Sample};
use crate::math::Vector;
use crate::math::finite::single;
use crate::math::interval::Interval;

parameters! {
    /// 0 in the mortar, 1 in a brick. A brick with its mortar is a cell of a lattice; the mortar is at the upper
    /// end of the cell along each axis. Every other row of bricks, from the first above the origin on, is moved
    /// by half a brick along z, the others along x.
    ///
    /// **Source:** POV-Ray manual, section "Brick Pattern"; measured on POV-Ray 3.7, which has the mortar in
    /// single precision.
    pub struct Brick {
        "brick_size" size: Vector = Vector::new(8.0, 3.0, 4.5), "the size of a brick with its mortar";
        "mortar" mortar: f64 = 0.5, "the width of the mortar";
    }
}

impl Pattern for Brick {
    const COLORS: &[(f64, [f64; 3])] = &[(0.0, [0.5; 3]), (1.0, [0.6, 0.15, 0.15])];
    const LIST: Option<usize> = Some(2);
    const HAS_SEAMS: bool = true;
    const RANGE: Interval = Interval { low: 0.0, high: 1.0 };

    /// Rounds the mortar to single precision.
    fn canonical(self) -> Self {
        Self { mortar: single(self.mortar), ..self }
    }

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        // The division rounds, too.
        let error = sample.error + sample.point.abs() * (4.0 * f64::EPSILON);
        let (at, error) = (sample.point / self.size, error / self.size.abs());
        let mortar = Vector::splat(self.mortar) / self.size;
        // A brick without size is all mortar.
        if !at.is_finite() || !mortar.is_finite() {
            return 0.0;
        }
        let in_brick = |at: f64, error: f64, mortar: f64| {
            let end = cell(at, error) + (1.0 - mortar);
            end - at > error + end.abs() * f64::EPSILON
        };
        // Inside a brick this is its row, for mortar of either sign.
        let row = cell(at.y + mortar.y, error.y);
        let (along_x, along_z) = if remainder(row, 2) == 0 { (0.0, 0.5) } else { (0.5, 0.0) };
        f64::from(
            in_brick(at.y, error.y, mortar.y)
                && in_brick(at.x + along_x, error.x, mortar.x)
                && in_brick(at.z + along_z, error.z, mortar.z),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Setting;
    use crate::pattern::measured::{assert_close, rows};

    #[test]
    fn values_are_those_of_pov_ray() {
        let rows = rows(include_str!("measured/brick.txt"));
        assert!(rows.len() > 60);
        for [sx, sy, sz, mortar, x, y, z, measured] in rows {
            let brick = Brick { size: Vector::new(sx, sy, sz), mortar }.canonical();
            let (point, setting) = (Vector::new(x, y, z), Setting::default());
            let value = brick.value(&Sample { point, error: Vector::ZERO, setting: &setting });
            assert_close(value, measured, 0.0, &(brick, point));
        }
    }

    #[test]
    fn a_brick_contains_its_lower_sides_and_not_its_upper_ones() {
        let setting = Setting::default();
        let value = |x, error| {
            let (point, error) = (Vector::new(x, 1.0, 1.0), Vector::splat(error));
            Brick::default().value(&Sample { point, error, setting: &setting })
        };
        for error in [0.0, 1e-12] {
            for off in [-0.9, 0.0, 0.9] {
                assert_eq!(value(16.0 + off * error, error), 1.0);
                assert_eq!(value(15.5 + off * error, error), 0.0);
            }
            assert_eq!(value(15.5 - 2e-12, error), 1.0);
            assert_eq!(value(16.0 - 2e-12, error), 0.0);
        }
    }

    #[test]
    fn bricks_of_a_tenth_have_their_seams_at_tenths() {
        let (brick, setting) =
            (Brick { size: Vector::splat(0.1), mortar: 0.0 }, Setting::default());
        let cell_of = |x: f64| super::cell(x / 0.1, x * (4.0 * f64::EPSILON) / 0.1);
        for i in 0..100 {
            // 0.1·i is rounded, down or up.
            assert_eq!(cell_of(0.1 * f64::from(i)), f64::from(i));
        }
        let sample = Sample { point: Vector::splat(0.3), error: Vector::ZERO, setting: &setting };
        assert_eq!(brick.value(&sample), 1.0);
    }
}
