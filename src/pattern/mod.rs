//! Patterns: a point to a number; one file, one pattern.
//!
//! **Invariant:** knows only `math`; closed enum, matched exhaustively.

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

impl Pattern {
    /// The pattern's value at `point` (in texture space), 0 … 1.
    #[inline]
    pub fn value(&self, point: Vector) -> f64 {
        match self {
            Self::Checker => checker::value(point),
            Self::Gradient { direction } => gradient::value(*direction, point),
        }
    }
}
