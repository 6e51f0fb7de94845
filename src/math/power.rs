//! Powers of non-negative numbers, by multiplications and square roots where possible.

use super::elementary::{cbrt, pow};

/// The largest exponent computed by multiplications.
const MOST: u8 = 16;

const TWO_THIRDS: f64 = 2.0 / 3.0;

/// The function x ↦ xᵖ for x ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Power {
    /// Takes the square root `roots` times, then raises it to an integer of at most 16, then inverts it if
    /// `inverse`.
    Products {
        times: u8,
        roots: u8,
        inverse: bool,
    },
    /// The square of the cube root, or its inverse: of 2/3 itself, which the exponent rounds.
    TwoThirds {
        inverse: bool,
    },
    Other(f64),
}

impl Power {
    pub fn new(exponent: f64) -> Self {
        let (size, inverse) = (exponent.abs(), exponent < 0.0);
        let whole = |size: f64| size == size.trunc() && size <= MOST.into();
        match size {
            0.125 => Self::Products { times: 1, roots: 3, inverse },
            0.25 => Self::Products { times: 1, roots: 2, inverse },
            0.5 => Self::Products { times: 1, roots: 1, inverse },
            1.5 => Self::Products { times: 3, roots: 1, inverse },
            TWO_THIRDS => Self::TwoThirds { inverse },
            _ if whole(size) => Self::Products { times: size as u8, roots: 0, inverse },
            _ => Self::Other(exponent),
        }
    }

    /// Returns xᵖ.
    ///
    /// **Error:** for exponents up to 16, at most |p| + 5 roundings (k factors are rounded k − 1 times, the
    /// root inside each of three once); for others, that of [`pow`].
    pub fn of(self, x: f64) -> f64 {
        match self {
            Self::Products { times, roots, inverse } => {
                let root = (0..roots).fold(x, |x, _| x.sqrt());
                let product = products(root, times.into());
                if inverse { 1.0 / product } else { product }
            }
            Self::TwoThirds { inverse } => {
                let root = cbrt(x);
                if inverse { 1.0 / (root * root) } else { root * root }
            }
            Self::Other(exponent) => pow(x, exponent),
        }
    }
}

/// Returns `base ^ exponent` for `base` ≥ 0, for an exponent that is used only once.
///
/// An integer exponent up to 1,024 uses repeated squaring, with at most 2 roundings per bit, each doubled by
/// the subsequent squarings, so the relative error is below 2 · exponent · 2⁻⁵³; others cost a call of `pow`.
#[inline(never)]
pub fn power(base: f64, exponent: f64) -> f64 {
    let whole = exponent as u32;
    if f64::from(whole) != exponent || whole > 1024 {
        return pow(base, exponent);
    }
    products(base, whole)
}

/// xⁿ by repeated squaring.
#[inline(always)]
fn products(x: f64, times: u32) -> f64 {
    let (mut all, mut square, mut left) = (1.0, x, times);
    while left > 0 {
        if left & 1 == 1 {
            all *= square;
        }
        square *= square;
        left >>= 1;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    #[test]
    fn a_power_is_that_of_the_library_to_its_roundings() {
        let mut random = Random(31);
        let fractions = [0.125, 0.25, 0.5, 1.5, 0.3, 7.5, 17.0];
        for _ in 0..tries() {
            let size = match random.below(2) {
                0 => random.below(20) as f64,
                _ => fractions[random.below(fractions.len())],
            };
            let exponent = if random.below(2) == 0 { size } else { -size };
            let x = random.size(-9.0, 9.0);
            let (found, expected) = (Power::new(exponent).of(x), pow(x, exponent));
            // The library's own is off by 2 roundings at most.
            let most = (size + 5.0 + 2.0) * 0.5 * f64::EPSILON * expected;
            assert!((found - expected).abs() <= most, "{x}^{exponent}: {found} {expected}");
        }
    }

    #[test]
    fn the_cube_of_two_thirds_is_the_square() {
        let mut random = Random(32);
        let power = Power::new(TWO_THIRDS);
        assert!(matches!(power, Power::TwoThirds { inverse: false }));
        for _ in 0..tries() {
            let x = random.size(-9.0, 9.0);
            let (cube, square) = (products(power.of(x), 3), x * x);
            assert!((cube - square).abs() <= 8.0 * f64::EPSILON * square, "{x}");
            let one = power.of(x) * Power::new(-TWO_THIRDS).of(x);
            assert!((one - 1.0).abs() <= 2.0 * f64::EPSILON, "{x}");
        }
    }

    #[test]
    fn of_0_it_is_what_the_library_makes_of_it() {
        for exponent in [-3.0, -0.5, 0.0, 0.125, 0.7, 1.0, 16.0, 17.0] {
            assert_eq!(Power::new(exponent).of(0.0), pow(0.0, exponent), "{exponent}");
        }
    }

    #[test]
    fn whole_powers_agree_with_pow_within_their_bound() {
        for exponent in [0.0, 1.0, 2.0, 3.0, 7.0, 40.0, 60.0, 255.0, 1023.0, 1024.0] {
            for step in 0..=100 {
                let base = f64::from(step) / 100.0;
                let (fast, slow) = (power(base, exponent), pow(base, exponent));
                let bound = (2.0 * exponent + 1.0) * f64::EPSILON / 2.0 * slow;
                assert!((fast - slow).abs() <= bound.max(f64::MIN_POSITIVE), "{base}^{exponent}");
            }
        }
    }

    #[test]
    fn other_powers_are_pow() {
        assert_eq!(power(0.5, 1.5), pow(0.5, 1.5));
        assert_eq!(power(0.5, -2.0), 4.0);
        assert_eq!(power(0.9, 5000.0), pow(0.9, 5000.0));
    }
}
