//! Powers of a cosine.

use crate::math::elementary::pow;

/// `base ^ exponent` for `base` ≥ 0.
///
/// A whole exponent up to 1,024 is raised by repeated squaring: at most 2 roundings a bit and
/// each is doubled by the squarings after it, so the relative error is below
/// 2 · exponent · 2⁻⁵³; others cost a call of `pow`.
#[inline(never)]
pub(super) fn power(base: f64, exponent: f64) -> f64 {
    let whole = exponent as u32;
    if f64::from(whole) != exponent || whole > 1024 {
        return pow(base, exponent);
    }
    let (mut result, mut square, mut rest) = (1.0, base, whole);
    while rest > 0 {
        if rest & 1 == 1 {
            result *= square;
        }
        square *= square;
        rest >>= 1;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

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
