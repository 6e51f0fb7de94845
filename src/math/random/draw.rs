//! Random sizes, directions and matrices, and the number of test cases.

use super::Random;
use crate::math::{Matrix, UnitVector, Vector, elementary};

impl Random {
    /// Returns 10^x, x uniform from `low` to `high`.
    pub fn size(&mut self, low: f64, high: f64) -> f64 {
        elementary::pow(10.0, self.number(low, high))
    }

    pub fn point(&mut self, reach: f64) -> Vector {
        Vector::from_array([0; 3].map(|_| self.number(-reach, reach)))
    }

    pub fn direction(&mut self) -> UnitVector {
        loop {
            let v = self.point(1.0);
            if v.length_squared() <= 1.0
                && let Some(unit) = UnitVector::from_direction(v)
            {
                return unit;
            }
        }
    }

    /// Returns one of the 26 directions of a cube's faces, edges and corners, with zeros of either sign.
    pub fn structured_direction(&mut self) -> UnitVector {
        loop {
            let v = Vector::from_array([0; 3].map(|_| [-1.0, -0.0, 0.0, 1.0][self.below(4)]));
            if let Some(unit) = UnitVector::from_direction(v) {
                return unit;
            }
        }
    }

    pub fn matrix(&mut self) -> Matrix {
        loop {
            let m = Matrix::from_cols(self.point(1.0), self.point(1.0), self.point(1.0));
            if m.determinant().abs() > 0.05 {
                return m;
            }
        }
    }
}

/// Number of cases on which a property is tested: 10,000, and ten million with `LUCARNE_LONG=1000 cargo test
/// --release`.
pub(crate) fn tries() -> usize {
    10_000 * long()
}

/// Number of cases in each of `worlds` worlds.
pub(crate) fn tries_in(worlds: usize) -> usize {
    tries().div_ceil(worlds)
}

/// Multiplier for the number of test cases.
pub(crate) fn long() -> usize {
    std::env::var("LUCARNE_LONG").ok().and_then(|times| times.parse().ok()).unwrap_or(1)
}
