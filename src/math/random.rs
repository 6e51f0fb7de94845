//! Numbers, directions and maps drawn at random, for tests.
//!
//! **Invariant:** the same from one seed on every machine.

use super::{Matrix, UnitVector, Vector, elementary};

/// A small generator of numbers (SplitMix64): the same scenes on every machine.
pub(crate) struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    /// Between `low` and `high`.
    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// 10^U(low, high).
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

    /// One of the 26 directions of faces, edges and corners, its zeros of either sign.
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

/// How many times as much to test: `LUCARNE_LONG=100 cargo test --release`.
pub(crate) fn long() -> usize {
    std::env::var("LUCARNE_LONG").ok().and_then(|times| times.parse().ok()).unwrap_or(1)
}
