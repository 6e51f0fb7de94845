//! `gradient <direction>`: the distance along a direction; above 1, its fractional part.

use super::parameter::parameters;
use super::{Measured, NEAR, Pattern, Sample, Setting, settled};
use crate::math::interval::Interval;
use crate::math::{UnitVector, Vector};

parameters! {
    /// The value is `direction · point`, for a `direction` of length 1; above 1, its fractional part. At 1 it
    /// is 1: so the top of a box as high as its gradient has the last colour. Negative values stay as they are,
    /// so a frequency below 0 or with a fraction counts from the origin.
    ///
    /// **Source:** POV-Ray manual, section "Gradient"; the values at 1 and below 0 measured on POV-Ray 3.7.
    pub struct Gradient {
        after direction: Vector = Vector::X, "the gradient's direction";
    }
}

impl Pattern for Gradient {
    const HAS_SEAMS: bool = true;
    const RANGE: Interval = Interval { low: f64::MIN, high: 1.0 };

    /// Only the direction of a gradient matters, not its length (checked on POV-Ray 3.7: `gradient 2*x` is
    /// `gradient x`).
    fn canonical(self) -> Self {
        let unit = UnitVector::from_direction(self.direction);
        Self { direction: unit.map_or(Vector::ZERO, UnitVector::get) }
    }

    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        self.measured(sample).value
    }

    #[inline]
    fn measured(&self, sample: &Sample) -> Measured {
        let Sample { point, error, .. } = *sample;
        // The direction and the sum are rounded, too.
        let error = self.direction.abs().dot(error + point.abs() * (4.0 * f64::EPSILON));
        let along = settled(self.direction.dot(point), error);
        Measured { value: folded(along).max(f64::MIN), error }
    }

    /// Returns the value if it is not within [`NEAR`] of its jump.
    #[inline]
    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        let along = self.direction.dot(sample.point);
        let fraction = along - along.floor();
        let is_off = fraction > NEAR && fraction < 1.0 - NEAR;
        is_off.then_some(Measured { value: folded(along), error: NEAR })
    }

    fn bounds(&self, point: Vector, reach: Vector, _setting: &Setting) -> Interval {
        let along = self.direction.dot(point);
        let far = self.direction.abs().dot(reach + point.abs() * (4.0 * f64::EPSILON));
        let (low, high) = ((along - far).next_down(), (along + far).next_up());
        match low.floor() == high.floor() || high <= 1.0 {
            true => Interval { low: folded(low), high: folded(high) },
            false => Interval { low: low.min(0.0), ..Self::RANGE },
        }
    }
}

#[inline]
fn folded(along: f64) -> f64 {
    if along > 1.0 { along - along.floor() } else { along }
}

#[cfg(test)]
mod tests {
    use super::super::{Wave, WaveKind};
    use super::*;

    fn value(direction: Vector, point: Vector, error: Vector) -> Measured {
        Gradient { direction }.measured(&Sample { point, error, setting: &Setting::default() })
    }

    #[test]
    fn it_rises_from_zero_to_one_in_each_unit() {
        let y = Vector::Y;
        let value = |direction, point| value(direction, point, Vector::ZERO).value;
        assert_eq!(value(y, Vector::new(9.0, 0.25, 7.0)), 0.25);
        assert_eq!(value(y, Vector::new(0.0, 3.0, 0.0)), 0.0);
        assert_eq!(value(y, Vector::new(0.0, 1.0, 0.0)), 1.0);
    }

    /// Measured on POV-Ray 3.7: `gradient y frequency -1.349` at y.
    #[test]
    fn below_zero_a_frequency_counts_from_the_origin() {
        let wave = Wave::new(WaveKind::Ramp, -1.349, 0.0);
        let measured = [
            (-1.99, 0.684490),
            (-1.24, 0.672750),
            (-0.99, 0.335500),
            (-0.24, 0.323760),
            (0.51, 0.312010),
            (1.26, 0.649260),
            (2.01, 0.986510),
        ];
        for (y, expected) in measured {
            let raw = value(Vector::Y, Vector::new(0.0, y, 0.0), Vector::ZERO).value;
            assert!((wave.value(raw) - expected).abs() < 1e-5, "{y}");
        }
    }

    #[test]
    fn where_it_may_have_jumped_back_it_has() {
        let slanted = Vector::new(0.6, 0.8, 0.0);
        for off in [-1e-13, 0.0, 1e-13] {
            let seen = value(slanted, slanted * (3.0 + off), Vector::splat(1e-12));
            assert_eq!(seen.value, 0.0, "{off}");
            assert!(seen.error > 1e-12 && seen.error < 2e-12);
        }
        assert!(value(slanted, slanted * (3.0 - 1e-11), Vector::splat(1e-12)).value > 0.9);
    }
}
