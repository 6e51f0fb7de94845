//! Pseudorandom numbers, for the choice of pixels and the positions of samples.
//!
//! **Invariant:** the same seed yields the same numbers on every machine.

#[cfg(test)]
mod draw;
#[cfg(test)]
pub(crate) use draw::{long, tries, tries_in};

use super::Vector;

/// A small pseudorandom generator.
///
/// **Source:** G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014
/// (SplitMix64).
#[derive(Debug, Clone)]
pub(crate) struct Random(pub u64);

impl Random {
    /// Returns an independent generator for one of many users of a seed.
    pub fn of(seed: u64, thing: u64) -> Self {
        Self(Self(seed ^ Self(thing).bits()).bits())
    }

    /// Returns the generator of what happens at a point, for one of many users of a seed, which is numbered by `things`.
    pub fn at(seed: u64, point: Vector, things: [u64; 2]) -> Self {
        // Zero has no sign.
        let place = point.to_array().map(|coordinate| (coordinate + 0.0).to_bits());
        let things = place.into_iter().chain(things);
        Self(things.fold(seed, |seed, thing| Self::of(seed, thing).bits()))
    }

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

    /// Returns a number between `low` and `high`.
    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }
}
