//! `wood`: cylinders around z, like the rings of a tree.

use std::f64::consts::TAU;

use super::parameter::parameters;
use super::turbulent::{is_still, planar};
use super::{Measured, NEAR, Pattern, Sample, Setting, WaveKind, sides};
use crate::math::Vector;
use crate::math::elementary::sin;
use crate::math::finite::length;
use crate::math::interval::Interval;

parameters! {
    /// The distance from the z axis. The block's turbulence moves the point along x and y, by 1 at most: by
    /// the sine of 2π times the amount times the turbulent coordinate.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.30 "Wood Pattern"; turbulence measured on POV-Ray 3.7.
    pub struct Wood {}
}

impl Pattern for Wood {
    const COLORS: &[(f64, [f64; 3])] = &[
        (0.0, [0.666, 0.312, 0.2]),
        (0.6, [0.666, 0.312, 0.2]),
        (0.6, [0.4, 0.1333, 0.066]),
        (1.0, [0.4, 0.1333, 0.066]),
    ];
    const WAVE: WaveKind = WaveKind::Triangle;
    const APPLIES_TURBULENCE: bool = true;
    const RANGE: Interval = Interval { low: 0.0, high: f64::INFINITY };

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        let Sample { point, setting, .. } = *sample;
        let mut moved = Vector::new(point.x, point.y, 0.0);
        if !is_still(setting) {
            let [x, y] = planar(setting, point);
            let wave = |coordinate: f64, amount: f64| {
                let angle = coordinate * amount * TAU;
                if angle.is_finite() { sin(angle) } else { 0.0 }
            };
            moved.x += wave(point.x + x, setting.amount.x);
            moved.y += wave(point.y + y, setting.amount.y);
        }
        length(moved)
    }

    #[inline]
    fn measured(&self, sample: &Sample) -> Measured {
        let value = self.value(sample);
        let error = match is_still(sample.setting) {
            true => sample.error.x + sample.error.y + value * (2.0 * f64::EPSILON),
            false => 0.0,
        };
        Measured { value, error }
    }

    /// Returns the value in any case: it has no seams.
    #[inline]
    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        Some(self.measured(&Sample { error: Vector::splat(0.25 * NEAR), ..*sample }))
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let sides = sides(point, reach);
        let noise = match is_still(setting) {
            true => [Interval::point(0.0); 3],
            false => setting.turbulence.vector_bounds(sides),
        };
        let axis = |i: usize| match setting.amount[i] == 0.0 {
            true => sides[i],
            false => {
                let turns = (sides[i] + noise[i]) * Interval::point(setting.amount[i]);
                sides[i] + Interval::sin(turns * Interval::point(TAU))
            }
        };
        let distance = (axis(0).square() + axis(1).square()).sqrt();
        // Where squares overflow or lose digits, the value is more exact than this.
        match distance.high < 1e100 && distance.low > 1e-100 {
            true => distance,
            false if distance.high < 1e100 => {
                Interval { low: 0.0, high: distance.high.max(2e-100) }
            }
            false => Self::RANGE,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::pattern::Kind;
    use crate::pattern::measured::turbulent_values_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        let table = include_str!("measured/wood.txt");
        turbulent_values_are_those_measured(Kind::of_word("wood"), table);
    }
}
