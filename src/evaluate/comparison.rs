//! Comparison of numbers: the tolerance within which two are equal, and which are true.
//!
//! **Invariant:** exactly one of `a = b` and `a != b` holds; `a <= b` holds if and only if
//! `a < b` or `a = b`.

use crate::vocabulary::Dialect;

/// Tolerance within which numbers are equal: absolute in a `.pov`, relative to the larger one in a `.scene`.
/// In a `.pov`, also the largest number that is false.
const TOLERANCE: f64 = 1e-10;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// As POV-Ray: an absolute tolerance of 1e-10 in any unit, so that `#while (I)` ends when `I` is counted
    /// down by tenths.
    ///
    /// **Source:** measured: `0.9999e-10 = 0` and `!0.9999e-10` are 1; for 1.0001e-10 both are 0. NaN equals
    /// every number, and is false.
    Absolute,
    /// A tolerance of 1e-10 relative to the larger number, and only zero is false, so that small scenes can
    /// distinguish their numbers.
    Relative,
}

impl Comparison {
    pub fn of(dialect: Dialect) -> Self {
        match dialect {
            Dialect::Pov => Self::Absolute,
            Dialect::Scene => Self::Relative,
        }
    }

    /// Returns whether two numbers count as equal: `0.1 + 0.2 = 0.3` holds.
    pub fn same(self, a: f64, b: f64) -> bool {
        match self {
            Self::Absolute => {
                let apart = (a - b).abs();
                apart <= TOLERANCE || apart.is_nan()
            }
            Self::Relative => (a - b).abs() <= TOLERANCE * a.abs().max(b.abs()),
        }
    }

    pub fn is_true(self, number: f64) -> bool {
        match self {
            Self::Absolute => number.abs() > TOLERANCE,
            Self::Relative => number != 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_small_scenes_are_told_apart_and_those_of_pov_ray_are_not() {
        assert!(!Comparison::Relative.same(1e-12, 2e-12) && Comparison::Relative.is_true(1e-11));
        assert!(Comparison::Absolute.same(1e-12, 2e-12) && !Comparison::Absolute.is_true(1e-11));
        for comparison in [Comparison::Relative, Comparison::Absolute] {
            assert!(comparison.same(0.1 + 0.2, 0.3) && !comparison.same(1.0, 1.0 + 1e-9));
        }
    }
}
