//! `spiral2 <arms>`: a spiral like that of `spiral1`, crossed with rings around the z axis.

use super::parameter::parameters;
use super::spiral::{bounds, error, place, whole_arms};
use super::turbulent::is_still;
use super::{Measured, NEAR, Pattern, Sample, Setting, WaveKind};
use crate::math::Vector;
use crate::math::interval::Interval;

parameters! {
    /// The sum of two triangle waves: one of `spiral1`, and one of the distance from the z axis; 0 … 2.
    ///
    /// **Source:** POV-Ray manual, section 3.4.7.1.26 "Spiral2 Pattern"; the formula was found by experiment
    /// on POV-Ray 3.7.
    pub struct Spiral2 {
        after arms: f64 = 1.0, "the number of arms";
    }
}

impl Pattern for Spiral2 {
    const WAVE: WaveKind = WaveKind::Triangle;
    const RANGE: Interval = Interval { low: 0.0, high: 2.0 };

    fn canonical(self) -> Self {
        Self { arms: whole_arms(self.arms) }
    }

    fn is_exact(&self, setting: &Setting) -> bool {
        !is_still(setting)
    }

    /// The angle jumps by a whole turn, which the wave does not show: so there is no seam.
    #[inline]
    fn value(&self, sample: &Sample) -> f64 {
        let place = place(self.arms, &Sample { error: Vector::ZERO, ..*sample });
        triangle(place.along) + triangle(place.radius)
    }

    /// Each wave changes twice as fast as its argument.
    #[inline]
    fn measured(&self, sample: &Sample) -> Measured {
        Measured { value: self.value(sample), error: 4.0 * error(self.arms, sample) }
    }

    /// Returns the value in any case: it has no seams.
    #[inline]
    fn value_off_seams(&self, sample: &Sample) -> Option<Measured> {
        Some(self.measured(&Sample { error: Vector::splat(0.25 * NEAR), ..*sample }))
    }

    fn bounds(&self, point: Vector, reach: Vector, setting: &Setting) -> Interval {
        let [radius, along] = bounds(self.arms, point, reach, setting);
        // Sums and waves are rounded.
        let sum = triangle_bounds(radius) + triangle_bounds(along);
        Interval { low: (sum.low - 1e-15).max(0.0), high: (sum.high + 1e-15).min(2.0) }
    }
}

/// A wave from 0 at every integer to 1 halfway between.
#[inline]
fn triangle(x: f64) -> f64 {
    let fraction = x - x.floor();
    1.0 - (1.0 - 2.0 * fraction).abs()
}

fn triangle_bounds(x: Interval) -> Interval {
    const RANGE: Interval = Interval { low: 0.0, high: 1.0 };
    // Beyond, adjacent numbers are too far apart to tell halves.
    if !(x.high - x.low < 0.5 && x.low.abs().max(x.high.abs()) < 1e12) {
        return RANGE;
    }
    let ends = Interval::between(triangle(x.low), triangle(x.high));
    let (low, high) = ((2.0 * x.low).floor(), (2.0 * x.high).floor());
    if low == high {
        return ends;
    }
    match high * 0.5 == (high * 0.5).floor() {
        true => Interval { low: 0.0, high: ends.high },
        false => Interval { low: ends.low, high: 1.0 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Kind;
    use crate::pattern::measured::spiral_values_are_those_measured;

    #[test]
    fn values_are_those_of_pov_ray() {
        let kind = |arms| Kind::Spiral2(Spiral2 { arms });
        spiral_values_are_those_measured(kind, include_str!("measured/spiral2.txt"));
    }
}
