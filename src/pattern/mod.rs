//! Patterns: a point to a number; one file, one pattern.
//!
//! **Invariant:** knows only `math`; closed enum, matched exhaustively. What errors cannot tell from
//! a seam is on it: so a seam that falls on a row of pixels is one colour all along, however the
//! points of the row were rounded.

pub mod checker;
pub mod gradient;
pub mod noise;

use crate::math::Vector;

/// A number for every point of space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pattern {
    Checker,
    /// `direction`: as written in a Scene (any length but zero), of length 1 in a World.
    Gradient {
        direction: Vector,
    },
}

/// A number, and how far off it may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    pub value: f64,
    pub error: f64,
}

impl Pattern {
    /// The pattern's value, 0 … 1, at `point` (in texture space), which may be off by `error` along
    /// each axis.
    #[inline]
    pub fn value(&self, point: Vector, error: Vector) -> Measured {
        match self {
            Self::Checker => Measured { value: checker::value(point, error), error: 0.0 },
            Self::Gradient { direction } => gradient::value(*direction, point, error),
        }
    }
}

/// A coordinate as a lattice of whole numbers sees it: one that its error does not tell from a
/// whole number is that number.
#[inline]
fn settled(coordinate: f64, error: f64) -> f64 {
    let whole = coordinate.round();
    if (coordinate - whole).abs() <= error { whole } else { coordinate }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
