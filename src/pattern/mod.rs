//! Patterns, which map a point to a number; one file for each pattern.
//!
//! **Invariant:** depends only on `math`; the enum is closed and matched exhaustively. A point that its error
//! cannot separate from a seam is on the seam: so a seam that coincides with a row of pixels has one colour
//! throughout, however the points of the row are rounded.

pub mod checker;
pub mod gradient;

use crate::math::Vector;
use crate::math::interval::Interval;

/// A function that maps every point of space to a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pattern {
    Checker,
    /// `direction`: as written in a `Scene` (any length but zero), of length 1 in a `World`.
    Gradient {
        direction: Vector,
    },
}

/// A number with its error bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    pub value: f64,
    pub error: f64,
}

/// Distance from a seam, in cells, within which a point's own error matters; all other errors must only be
/// less than a quarter of this.
pub const NEAR: f64 = 1.0 / 256.0;

impl Pattern {
    /// Returns the pattern's value, 0 … 1, at `point` (in texture space), whose error along each axis is
    /// `error`.
    #[inline]
    pub fn value(&self, point: Vector, error: Vector) -> Measured {
        match self {
            Self::Checker => Measured { value: checker::value(point, error), error: 0.0 },
            Self::Gradient { direction } => gradient::value(*direction, point, error),
        }
    }

    /// Returns the range of values within `reach` of `point` along each axis.
    pub fn bounds(&self, point: Vector, reach: Vector) -> Interval {
        match self {
            Self::Checker => checker::bounds(point, reach),
            Self::Gradient { direction } => gradient::bounds(*direction, point, reach),
        }
    }

    /// Returns [`Pattern::value`] for any error less than [`NEAR`] / 4 along each axis; `None` if the error
    /// may matter. The returned error is an upper bound. Coordinates must be below 2⁴⁰.
    #[inline]
    pub fn value_off_seams(&self, point: Vector) -> Option<Measured> {
        match self {
            Self::Checker => Some(Measured { value: checker::value_off_seams(point)?, error: 0.0 }),
            Self::Gradient { direction } => {
                Some(Measured { value: gradient::value_off_seams(*direction, point)?, error: NEAR })
            }
        }
    }
}

/// Rounds a coordinate to an integer if its error cannot separate it from that integer.
#[inline]
fn settled(coordinate: f64, error: f64) -> f64 {
    let whole = coordinate.round();
    if (coordinate - whole).abs() <= error { whole } else { coordinate }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    #[test]
    fn what_an_error_cannot_tell_from_a_seam_is_on_it() {
        for (coordinate, error, seen) in [
            (1.999_999, 0.0, 1.999_999),
            (1.999_999, 1e-7, 1.999_999),
            (1.999_999, 1e-5, 2.0),
            (2.000_001, 1e-5, 2.0),
            (-3.000_001, 1e-5, -3.0),
            (2.0, 0.0, 2.0),
            (0.4, f64::INFINITY, 0.0),
        ] {
            assert_eq!(settled(coordinate, error), seen, "{coordinate} {error}");
        }
        assert!(settled(f64::NAN, 1.0).is_nan());
    }

    #[test]
    fn off_the_seams_no_small_error_changes_a_value() {
        let mut random = Random(5);
        let mut seen = [0; 2];
        for _ in 0..tries() {
            let reach = [1.0, 3.0, 1e6][random.below(3)];
            let mut point = random.point(reach);
            for axis in 0..3 {
                let whole = point[axis].round();
                point[axis] = match random.below(4) {
                    0 => whole,
                    1 => whole + random.number(-2.0, 2.0) * NEAR,
                    _ => point[axis],
                };
            }
            let direction = [random.direction(), random.structured_direction()][random.below(2)];
            let gradient = Pattern::Gradient { direction: direction.get() };
            for (kind, pattern) in [Pattern::Checker, gradient].into_iter().enumerate() {
                let Some(told) = pattern.value_off_seams(point) else { continue };
                seen[kind] += 1;
                for error in [0.0, 1e-12, NEAR * 0.249] {
                    let measured = pattern.value(point, Vector::splat(error));
                    assert_eq!(measured.value, told.value, "{pattern:?} {point} {error}");
                    assert!(measured.error <= told.error, "{pattern:?} {point} {measured:?}");
                }
            }
        }
        assert!(seen.iter().all(|&seen| seen > tries() / 2), "{seen:?}");
        for odd in [f64::NAN, f64::INFINITY] {
            assert_eq!(Pattern::Checker.value_off_seams(Vector::X * odd), None);
        }
    }
}
