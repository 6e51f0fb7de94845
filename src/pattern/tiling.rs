//! `tiling <number>`: one of 24 periodic tilings of the x-z plane, with bevelled tiles.

mod plans;

use super::parameter::parameters;
use super::tile::Place;
use super::{Measured, NEAR, Pattern, Sample, Setting};
use crate::math::Vector;
use crate::math::interval::Interval;
use plans::{Plan, plan};

parameters! {
    /// For `n` kinds of tiles, numbered from 0, the value is (kind + bevel) / n; the bevel rises from 0
    /// inside a tile to 1 on its border, over the same distance in all tiles of a tiling.
    ///
    /// **Source:** POV-Ray manual, section "Tiling Pattern"; the tilings are those of POV-Ray 3.7 (measured).
    pub struct Tiling {
        after number: f64 = 1.0, "the number of the tiling";
    }
}

impl Tiling {
    fn plan(&self) -> &'static Plan {
        plan(self.number as usize)
    }
}

impl Pattern for Tiling {
    const HAS_SEAMS: bool = true;

    fn canonical(self) -> Self {
        // In this order NaN becomes 1.
        Self { number: self.number.max(1.0).min(plans::COUNT as f64).trunc() }
    }

    fn value(&self, sample: &Sample) -> f64 {
        self.measured(sample).value
    }

    fn measured(&self, sample: &Sample) -> Measured {
        let plan = self.plan();
        let Sample { point, error, .. } = *sample;
        let error = error.x + error.z;
        let place = plan.lattice.place([point.x, point.z], error);
        let is_flat = place.depth >= plan.width + error;
        let error = if is_flat { 0.0 } else { error * plan.slope() };
        Measured { value: plan.value(place), error }
    }

    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        let plan = self.plan();
        let place = plan.lattice.place([sample.point.x, sample.point.z], 0.0);
        let measured = || Measured { value: plan.value(place), error: NEAR * plan.slope() };
        (place.depth > NEAR).then(measured)
    }

    fn bounds(&self, point: Vector, reach: Vector, _setting: &Setting) -> Interval {
        let plan = self.plan();
        let far = (point.x.abs() + point.z.abs() + 4.0) * (16.0 * f64::EPSILON);
        let reach = reach.x + reach.z + far;
        let place = plan.lattice.place([point.x, point.z], 0.0);
        if place.depth > reach {
            let value = |depth| plan.value(Place { depth, ..place });
            Interval { low: value(place.depth + reach), high: value(place.depth - reach) }
        } else {
            Self::RANGE
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};
    use crate::pattern::measured::{assert_close, rows};

    fn value(number: f64, point: Vector, error: f64) -> Measured {
        let setting = Setting::default();
        Tiling { number }.measured(&Sample {
            point,
            error: Vector::splat(error),
            setting: &setting,
        })
    }

    #[test]
    fn values_are_those_of_pov_ray() {
        let rows = rows(include_str!("measured/tiling.txt"));
        assert!(rows.len() > 200);
        for [number, x, z, measured] in rows {
            let point = Vector::new(x, 3.0, z);
            assert_close(value(number, point, 0.0).value, measured, 1e-10, &(number, point));
        }
    }

    #[test]
    fn each_point_is_in_a_tile_and_its_bounds_hold_around_it() {
        let mut random = Random(3);
        let setting = Setting::default();
        for turn in 0..tries() {
            let number = (turn % plans::COUNT + 1) as f64;
            let point = random.point(20.0);
            let place = plan(number as usize).lattice.place([point.x, point.z], 0.0);
            assert!(place.depth >= 0.0, "{number} {point}: {place:?}");
            let reach = random.size(-4.0, 0.0);
            let bounds = Tiling { number }.bounds(point, Vector::splat(reach), &setting);
            let near = point + random.point(reach);
            assert!(bounds.contains(value(number, near, 0.0).value), "{number} {near}");
        }
    }

    #[test]
    fn off_the_seams_no_small_error_changes_a_value() {
        let mut random = Random(4);
        let setting = Setting::default();
        for turn in 0..tries() {
            let number = (turn % plans::COUNT + 1) as f64;
            let point = random.point(20.0);
            let sample = Sample { point, error: Vector::ZERO, setting: &setting };
            let Some(told) = (Tiling { number }).value_off_seams(&sample) else { continue };
            for error in [0.0, 1e-12, NEAR * 0.249] {
                let measured = value(number, point, error);
                assert_eq!(measured.value, told.value, "{number} {point} {error}");
                assert!(measured.error <= told.error);
            }
        }
    }
}
