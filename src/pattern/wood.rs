//! `wood`: cylinders around z, like the rings of a tree.

use std::f64::consts::TAU;

use super::parameter::parameters;
use super::turbulent::{in_plane, is_still, planar};
use super::{Measured, NEAR, Pattern, Sample, Setting, WaveKind, sides};
use crate::math::Vector;
use crate::math::elementary::sin;
use crate::math::finite::length;
use crate::math::interval::Interval;
use crate::math::wide::{Row, Rows, numbers};

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

    fn is_exact(&self, setting: &Setting) -> bool {
        !is_still(setting)
    }

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        let Sample { point, setting, .. } = *sample;
        match is_still(setting) {
            true => ring(point),
            false => bent(point, planar(setting, point), setting.amount),
        }
    }

    fn values(&self, points: &Rows, mask: u32, setting: &Setting, values: &mut Row) {
        if is_still(setting) {
            for number in numbers(mask) {
                values[number] = ring(points.at(number));
            }
            return;
        }
        let mut noise = Rows::ZERO;
        setting.turbulence.vectors(points, mask, &mut noise);
        for number in numbers(mask) {
            values[number] = bent(points.at(number), in_plane(noise.at(number)), setting.amount);
        }
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

/// Returns the distance from the axis.
fn ring(point: Vector) -> f64 {
    length(Vector { z: 0.0, ..point })
}

/// Returns the distance from the axis of a point that turbulence moves.
fn bent(point: Vector, [x, y]: [f64; 2], amount: Vector) -> f64 {
    let wave = |coordinate: f64, amount: f64| {
        let angle = coordinate * amount * TAU;
        if angle.is_finite() { sin(angle) } else { 0.0 }
    };
    let moved_x = point.x + wave(point.x + x, amount.x);
    ring(Vector { x: moved_x, y: point.y + wave(point.y + y, amount.y), ..point })
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
