//! The random numbers of `crand`, the grain of a finish.
//!
//! **Invariant:** they are numbered by what they are for, not drawn in an order. So a picture does
//! not depend on threads or tiles.

use crate::math::Vector;
use crate::math::random::Random;

/// Begins the numbers of grain.
const SEED: u64 = 0x6372_616e_6400_0000;

/// Returns the random number of a light at a point of a surface, uniform in 0 … 1; `part` is the place of its
/// finish in the texture.
pub(super) fn random(point: Vector, light: usize, part: u32) -> f64 {
    Random::at(SEED, point, [light as u64, u64::from(part)]).number(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lights_and_parts_have_numbers_of_their_own_that_are_spread_evenly() {
        let numbers = (0..4096).map(|i| {
            let point = Vector::new(f64::from(i % 64) / 8.0, f64::from(i / 64) / 8.0, 0.0);
            random(point, 0, 0)
        });
        let mut tenths = [0; 10];
        numbers.for_each(|number| tenths[(number * 10.0) as usize] += 1);
        assert!(tenths.iter().all(|count| (330..490).contains(count)), "{tenths:?}");
        let of = |light, part| random(Vector::ONE, light, part);
        assert!(of(0, 0) != of(1, 0) && of(0, 0) != of(0, 1));
        assert_eq!(random(Vector::ZERO, 0, 0), random(-Vector::ZERO, 0, 0));
    }
}
