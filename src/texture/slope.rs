//! The values of the patterns that depend on how the surface lies: `slope` and `aoi`.
//!
//! The normal is the perturbed one, in the world, of length 1 and toward the viewer. Of the object's and the
//! texture's transforms none turns the direction of a slope; those of the texture move the point of its
//! altitude. Where there is no surface, in the sky and in functions, both are 0 (measured on POV-Ray 3.7).

use crate::math::elementary::{acos, asin};
use crate::math::{UnitVector, Vector};
use std::f64::consts::PI;

/// What `slope` compares the normal with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Toward {
    Direction(Vector),
    /// `point_at`, in the world.
    Point(Vector),
}

/// The parameters of `slope`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    pub toward: Toward,
    /// The slopes that become 0 and 1.
    pub slopes: [f64; 2],
    /// The direction of the altitude; zero for none.
    pub altitude: Vector,
    /// The altitudes that become 0 and 1.
    pub altitudes: [f64; 2],
}

impl Slope {
    /// Returns the value at `point` of the pattern's space, which is `in_world` in the world: 0 … 1. Beyond, the
    /// fractional part counts, before any frequency.
    ///
    /// The slope is ½ + asin(normal · direction)/π, then made 0 … 1 over its range; the altitude, the distance
    /// along its direction, likewise. The value is their mean, weighted by the lengths of the two vectors.
    ///
    /// **Source:** POV-Ray manual, section "Slope Pattern"; measured to 1/65,535.
    pub fn value(&self, normal: Vector, point: Vector, in_world: Vector) -> f64 {
        let (toward, weight) = match self.toward {
            Toward::Direction(direction) => (direction, direction.length()),
            Toward::Point(target) => (target - in_world, 1.0),
        };
        let along = UnitVector::from_direction(toward).map_or(0.0, |unit| unit.get().dot(normal));
        let slope = within(0.5 + asin(along.clamp(-1.0, 1.0)) / PI, self.slopes);
        let Some(up) = UnitVector::from_direction(self.altitude) else { return folded(slope) };
        let height = within(up.get().dot(point), self.altitudes);
        let other = self.altitude.length();
        let mean = (weight * slope + other * height) / (weight + other);
        folded(if mean.is_finite() { mean } else { slope })
    }
}

/// Returns the fraction of a value beyond 0 … 1.
fn folded(value: f64) -> f64 {
    if (0.0..=1.0).contains(&value) { value } else { value - value.floor() }
}

/// Maps a range to 0 … 1; an empty range leaves the value as it is.
fn within(value: f64, [low, high]: [f64; 2]) -> f64 {
    let mapped = (value - low) / (high - low);
    if mapped.is_finite() { mapped } else { value }
}

/// Returns the value of `aoi`: the angle between the ray's direction, of length 1, and the normal, in half
/// turns; ½ at a grazing angle, 1 head-on.
///
/// **Source:** POV-Ray manual, section "Aoi Pattern"; measured to 1/65,535.
pub fn aoi(direction: Vector, normal: Vector) -> f64 {
    acos(direction.dot(normal).clamp(-1.0, 1.0)) / PI
}

#[cfg(test)]
mod tests {
    use super::*;

    const MEASURED: &str = include_str!("measured/slope.txt");

    #[test]
    fn slopes_are_the_ones_pov_ray_shows() {
        let plain = Slope {
            toward: Toward::Direction(Vector::new(1.0, 2.0, -0.5)),
            slopes: [0.0, 1.0],
            altitude: Vector::ZERO,
            altitudes: [0.0, 1.0],
        };
        let altitude = Vector::new(0.0, 1.0, 0.5);
        let measured = [
            plain,
            Slope { slopes: [0.2, 0.7], ..plain },
            Slope { slopes: [0.7, 0.2], ..plain },
            Slope { altitude, ..plain },
            Slope { slopes: [0.2, 0.9], altitude, altitudes: [-1.0, 1.0], ..plain },
            Slope { toward: Toward::Point(Vector::new(2.0, 1.0, -3.0)), ..plain },
            Slope {
                toward: Toward::Direction(Vector::ZERO),
                altitude,
                altitudes: [-1.0, 1.0],
                ..plain
            },
            Slope { slopes: [0.3, 0.3], ..plain },
            Slope { altitude, altitudes: [0.2, 0.2], ..plain },
        ];
        let mut compared = 0;
        for line in MEASURED.lines().filter(|line| !line.starts_with('#')) {
            let n: Vec<f64> = line.split(' ').map(|w| w.parse().expect("a number")).collect();
            let Some(slope) = measured.get(n[0] as usize) else { continue };
            let (point, normal) = (Vector::new(n[1], n[2], n[3]), Vector::new(n[4], n[5], n[6]));
            let off = slope.value(normal, point, point) - n[7];
            assert!((off - off.round()).abs() < 2e-5, "{line}");
            compared += 1;
        }
        assert!(compared > 80);
    }

    /// Measured on POV-Ray 3.7: `slope { y, 0.243, 0.523 } frequency 0.25`.
    #[test]
    fn slopes_beyond_the_range_start_again_before_their_frequency() {
        let slope = Slope {
            toward: Toward::Direction(Vector::Y),
            slopes: [0.243, 0.523],
            altitude: Vector::ZERO,
            altitudes: [0.0, 1.0],
        };
        for (at, measured) in
            [(0.05, 0.078), (0.15, 0.169), (0.3, 0.051), (0.6, 0.071), (0.9, 0.086)]
        {
            let (sine, cosine) = crate::math::elementary::sin_cos_degrees((at - 0.5) * 180.0);
            let value = slope.value(Vector::new(0.0, sine, cosine), Vector::ZERO, Vector::ZERO);
            assert!((0.25 * value - measured).abs() < 0.004, "{at} {value}");
        }
    }

    #[test]
    fn aoi_is_a_half_grazing_and_1_head_on() {
        assert_eq!(aoi(Vector::Z, Vector::Y), 0.5);
        assert_eq!(aoi(Vector::Z, -Vector::Z), 1.0);
    }

    #[test]
    fn no_numbers_break_it() {
        for size in [0.0, 1e-300, 1e300] {
            let slope = Slope {
                toward: Toward::Direction(Vector::X * size),
                slopes: [0.5, 0.5],
                altitude: Vector::Y * size,
                altitudes: [0.3, 0.3],
            };
            assert!(slope.value(Vector::Y, Vector::ONE, Vector::ONE).is_finite());
        }
    }
}
