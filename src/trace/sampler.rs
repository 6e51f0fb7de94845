//! Places of a pixel's samples: numbered, not drawn, so that more samples continue those that are there.
//!
//! **In:** a pixel, and the number of a sample. **Out:** where it lies in the pixel. **Invariant:** nothing else
//! decides it. Number 0 lies in the pixel's centre. The first 2ᵏ samples, and each 2ᵏ that follow them, have exactly
//! one in each part of the pixel that is a 2ⁱ-th as wide and a 2ᵏ⁻ⁱ-th as high.
//!
//! **Source:** I. Sobol', "On the distribution of points in a cube and the approximate evaluation of integrals",
//! USSR Comput. Math. Math. Phys. 7(4), 1967, for the digits of the first two dimensions; A. Owen, "Randomly permuted
//! (t,m,s)-nets and (t,s)-sequences", 1995, for flipping a digit by those before it; B. Burley, "Practical hash-based
//! Owen scrambling", JCGT 9(4), 2020, for the hash.

use crate::math::random::Random;

/// Digits of a place, and how many of them are flipped alike in all pixels.
const DIGITS: u32 = 32;
const KNOWN: u32 = 6;

/// Bit 2ⁿ + d says whether digit n is flipped behind the n digits d, the last of them most significant. These flips put
/// sample 0 into the centre. All others are found by annealing: the error of the first 4, 8,
/// 16, 32 and 64 samples of pixels that are crossed by an edge is smallest, a tenth below that of random flips.
const FLIPS: [u64; 2] = [0x3b5d_8812_67e4_38e2, 0xf285_9c76_e3a8_b4a2];

/// The first digits after they are flipped.
const FLIPPED: [[u8; 1 << KNOWN]; 2] = [flipped(FLIPS[0]), flipped(FLIPS[1])];

const fn flipped(flips: u64) -> [u8; 1 << KNOWN] {
    let mut all = [0; 1 << KNOWN];
    let mut digits = 0;
    while digits < all.len() {
        let mut place = 0;
        while place < KNOWN {
            let before = 1 << place | digits & ((1 << place) - 1);
            all[digits] |= ((digits >> place & 1) as u8 ^ (flips >> before & 1) as u8) << place;
            place += 1;
        }
        digits += 1;
    }
    all
}

/// The samples of a pixel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sampler {
    seeds: [u32; 2],
}

impl Sampler {
    pub fn of((x, y): (u32, u32)) -> Self {
        let bits = Random::of(0, u64::from(x) << 32 | u64::from(y)).bits();
        Self { seeds: [bits as u32, (bits >> 32) as u32] }
    }

    /// Returns the place of sample `number`, 0 … 1 from the pixel's left and from its top: whole multiples of 2⁻³².
    #[inline(always)]
    pub fn offset(&self, number: u32) -> (f64, f64) {
        let [right, down] = self.place(number);
        let share = |place: u32| f64::from(place) / (1u64 << DIGITS) as f64;
        (share(right), share(down))
    }

    #[inline(always)]
    fn place(&self, number: u32) -> [u32; 2] {
        let digits = [number, second_dimension(number)];
        std::array::from_fn(|i| {
            let first = FLIPPED[i][digits[i] as usize % FLIPPED[i].len()];
            // Those of sample 0 stay 0.
            let others = hashed(digits[i], self.seeds[i]) ^ hashed(0, self.seeds[i]);
            (u32::from(first) | others >> KNOWN << KNOWN).reverse_bits()
        })
    }
}

/// Returns the digits of the second dimension of Sobol's sequence in reverse, as the bits of a number; those of the first
/// are the number's own.
#[inline(always)]
fn second_dimension(number: u32) -> u32 {
    // Their matrix is Pascal's triangle modulo 2, the product of one sparse matrix for each power of two.
    let digits = number ^ number >> 1 & 0x5555_5555;
    let digits = digits ^ digits >> 2 & 0x3333_3333;
    let digits = digits ^ digits >> 4 & 0x0f0f_0f0f;
    let digits = digits ^ digits >> 8 & 0x00ff_00ff;
    digits ^ digits >> 16
}

/// Flips each digit by a hash of those before it.
#[inline(always)]
fn hashed(digits: u32, seed: u32) -> u32 {
    // A product with an even number depends, in each bit, on those below it.
    [0x6c50_b47c, 0xb82f_1e52, 0xc7af_e638, 0x8d22_f6e6]
        .into_iter()
        .fold(digits.wrapping_add(seed), |digits, factor: u32| digits ^ digits.wrapping_mul(factor))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIXELS: [(u32, u32); 4] = [(0, 0), (1, 0), (319, 200), (999_999, 12_345)];

    #[test]
    fn each_first_power_of_two_and_each_that_follows_is_a_net() {
        for sampler in PIXELS.map(Sampler::of) {
            let places: Vec<_> = (0..4096).map(|number| sampler.place(number)).collect();
            for k in 1..=12 {
                for net in places.chunks(1 << k) {
                    for i in 0..=k {
                        let mut parts = vec![false; 1 << k];
                        for &[right, down] in net {
                            let (column, row) =
                                (u64::from(right) >> (32 - i), u64::from(down) >> (32 - (k - i)));
                            let part = &mut parts[(row << i | column) as usize];
                            assert!(!std::mem::replace(part, true), "two of 2^{k} in one part");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn sample_0_is_the_centre_and_pixels_share_the_first_digits_alone() {
        let places = |number| PIXELS.map(|pixel| Sampler::of(pixel).place(number));
        assert_eq!(Sampler::of((7, 9)).offset(0), (0.5, 0.5));
        for number in 1..1024 {
            let first = places(number).map(|place| place.map(|share| share >> (DIGITS - KNOWN)));
            assert!(first.iter().all(|digits| *digits == first[0]), "{number}");
            assert_ne!(places(number)[0], places(number)[1], "{number}");
        }
    }

    #[test]
    fn the_digits_are_those_of_sobols_sequence() {
        // Points 0 to 7 of the first two dimensions, in eighths.
        let second = [0, 4, 6, 2, 5, 1, 3, 7];
        let eighths = |digits: u32| digits.reverse_bits() >> 29;
        assert_eq!(std::array::from_fn(|n| eighths(n as u32)), [0, 4, 2, 6, 1, 5, 3, 7]);
        assert_eq!(std::array::from_fn(|n| eighths(second_dimension(n as u32))), second);
    }
}
