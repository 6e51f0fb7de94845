//! `agate`: bands across z, bent by turbulence of their own.

use std::f64::consts::TAU;

use super::parameter::parameters;
use super::{Pattern, Sample, Setting, sides};
use crate::math::Vector;
use crate::math::elementary::{pow, sin};
use crate::math::finite::{finite, single};
use crate::math::interval::Interval;
use crate::math::wide::{ROW, Row, Rows, numbers};

parameters! {
    /// A wave along z, shifted by turbulence with the octaves, lambda and omega of the block, 0 … 1. The
    /// turbulence of the block displaces points as usual.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.1 "Agate Pattern"; the formula was found by experiment on
    /// POV-Ray 3.7.
    pub struct Agate {
        "agate_turb" turbulence: f64 = 1.0, "the amount of its own turbulence";
    }
}

impl Pattern for Agate {
    const COST: &str = "noise of several octaves a point";
    const COLORS: &[(f64, [f64; 3])] = &[
        (0.0, [1.0; 3]),
        (0.5, [0.95, 0.75, 0.5]),
        (0.5, [0.9, 0.7, 0.5]),
        (0.6, [0.9, 0.7, 0.4]),
        (0.6, [1.0, 0.7, 0.4]),
        (1.0, [0.6, 0.3, 0.0]),
    ];
    /// The amount is in single precision.
    fn canonical(self) -> Self {
        Self { turbulence: single(self.turbulence) }
    }

    fn value(&self, sample: &Sample) -> f64 {
        let Sample { point, setting, .. } = *sample;
        match self.turbulence == 0.0 {
            true => self.band(point, 0.0),
            false => self.band(point, setting.turbulence.number(setting.noise, point)),
        }
    }

    fn values(&self, points: &Rows, mask: u32, setting: &Setting, values: &mut Row) {
        *values = [0.0; ROW];
        if self.turbulence != 0.0 {
            setting.turbulence.numbers(setting.noise, points, mask, values);
        }
        for number in numbers(mask) {
            values[number] = self.band(points.at(number), values[number]);
        }
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let sides = sides(point, reach);
        let shift = match self.turbulence == 0.0 {
            true => Interval::point(0.0),
            false => {
                setting.turbulence.number_bounds(setting.noise, sides)
                    * Interval::point(self.turbulence)
            }
        };
        let turns = sides[2] * Interval::point(1.1) + shift * Interval::point(1.3);
        let angle = turns * Interval::point(TAU);
        if !angle.is_finite() {
            return Self::RANGE;
        }
        let Interval { low, high } = Interval::sin(angle).rising(height);
        Interval { low: low.max(0.0), high: high.min(1.0) }
    }
}

impl Agate {
    /// Returns the value at a point, given its turbulence.
    fn band(&self, point: Vector, turbulence: f64) -> f64 {
        let shift = self.turbulence * finite(turbulence);
        height(sin(finite(TAU * (1.1 * point.z + 1.3 * shift))))
    }
}

/// Returns the value for a sine.
fn height(sine: f64) -> f64 {
    pow(((1.0 + sine) / 2.0).clamp(0.0, 1.0), 0.77)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vector;
    use crate::pattern::measured::{assert_close, rows, setting};

    #[test]
    fn values_are_those_of_pov_ray() {
        let rows = rows(include_str!("measured/agate.txt"));
        assert!(rows.len() >= 30);
        for [noise, lambda, omega, octaves, turbulence, x, y, z, measured] in rows {
            let setting = setting([noise, lambda, omega, octaves, 0.0, 0.0, 0.0]);
            let agate = Agate { turbulence }.canonical();
            let point = Vector::new(x, y, z);
            let value = agate.value(&Sample { point, error: Vector::ZERO, setting: &setting });
            assert_close(value, measured, 1e-11, &(agate, setting, point));
        }
    }
}
