//! Numbers, directions and places drawn at random or from what is hard; the same ones every time.

use lucarne::math::elementary::pow;
use lucarne::math::{UnitVector, Vector};

/// Steele, Lea and Flood's SplitMix64.
pub struct Dice(pub u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    pub fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// 10^U(low, high).
    pub fn size(&mut self, low: f64, high: f64) -> f64 {
        pow(10.0, self.between(low, high))
    }

    /// A power of two, 2^low … 2^high.
    pub fn power_of_two(&mut self, low: i32, high: i32) -> f64 {
        let exponent = low + self.below((high - low + 1) as usize) as i32;
        f64::from_bits(((1023 + exponent) as u64) << 52)
    }

    pub fn point(&mut self, reach: f64) -> Vector {
        Vector::from_array([0; 3].map(|_| self.between(-reach, reach)))
    }

    pub fn direction(&mut self) -> Vector {
        loop {
            let v = self.point(1.0);
            if v.length_squared() <= 1.0
                && let Some(unit) = UnitVector::from_direction(v)
            {
                return unit.get();
            }
        }
    }

    /// Of length 1, its components drawn from `parts` before; any but zero.
    pub fn structured(&mut self, parts: &[f64]) -> Vector {
        loop {
            let v = Vector::from_array([0; 3].map(|_| self.one_of(parts)));
            if let Some(unit) = UnitVector::from_direction(v) {
                return unit.get();
            }
        }
    }
}

/// How many rays a property is tried on: 10,000, or so many times as many as `LUCARNE_LONG` says
/// (1000 for ten millions).
pub fn rays() -> usize {
    10_000 * std::env::var("LUCARNE_LONG").ok().and_then(|n| n.parse().ok()).unwrap_or(1)
}
