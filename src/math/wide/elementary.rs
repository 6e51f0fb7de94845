//! Elementary functions of numbers side by side.
//!
//! **Error:** at most 2 units in the last place, for numbers of any size. They are not those of
//! [`math::elementary`](crate::math::elementary), whose steps depend on the number.

use super::*;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, LOG2_E};

/// ln 2 in two parts. The last bits of the first are 0, so its product with a whole number below 2¹¹ is exact.
const LN_2: [f64; 2] = [0.693_147_180_559_890_3, 5.497_923_018_708_371e-14];

/// 1.5 · 2⁵²: the last bits of what is added to it are those of a whole number.
const LAST_BITS_WHOLE: f64 = 6_755_399_441_055_744.0;

/// Taylor's series of eˣ: 1/13!, 1/12! … 1/2!. For |x| ≤ ln 2 / 2 the rest is below 5·10⁻¹⁸.
const EXP: [f64; 12] = [
    1.0 / 6_227_020_800.0,
    1.0 / 479_001_600.0,
    1.0 / 39_916_800.0,
    1.0 / 3_628_800.0,
    1.0 / 362_880.0,
    1.0 / 40_320.0,
    1.0 / 5_040.0,
    1.0 / 720.0,
    1.0 / 120.0,
    1.0 / 24.0,
    1.0 / 6.0,
    0.5,
];

/// Returns eˣ; 0 below −708, where it is hardly a normal number.
#[inline(always)]
pub(crate) fn exp<S: Simd>(simd: S, x: Wide<S>) -> Wide<S> {
    let n = (x * all(simd, LOG2_E)).round_ties_even();
    let r = x - n * all(simd, LN_2[0]) - n * all(simd, LN_2[1]);
    let series = polynomial(simd, r, &EXP);
    let mantissa = all(simd, 1.0) + (r + r * r * series);
    // The last bits of this sum are n − 1, biased as an exponent is. 2ⁿ itself may be beyond the greatest number.
    let biased = n + all(simd, LAST_BITS_WHOLE + 1022.0);
    let power: Wide<S> = (biased.bitcast::<WideBits<S>>() << 52).bitcast();
    let result = mantissa * power * all(simd, 2.0);
    let result = x.simd_gt(all(simd, 710.0)).select(all(simd, f64::INFINITY), result);
    x.simd_lt(all(simd, -708.0)).select(all(simd, 0.0), result)
}

/// tan⁻¹ t = t + t·z·P(z), z = t², for |t| ≤ tan π/8: the coefficients of P, the highest first. The error is below
/// 2·10⁻¹⁸·t.
const ATAN: [f64; 11] = [
    -0.017_922_274_788_465_21,
    0.038_078_315_434_092_25,
    -0.050_398_452_322_074_2,
    0.058_480_088_388_859_14,
    -0.066_631_203_708_450_67,
    0.076_920_616_357_198_46,
    -0.090_908_978_363_538_49,
    0.111_111_107_861_338_32,
    -0.142_857_142_802_484_13,
    0.199_999_999_999_540_82,
    -0.333_333_333_333_332,
];

/// What π/2 and π/4 are more than their doubles.
const REST_OF_PI_2: f64 = 6.123_233_995_736_766e-17;
const REST_OF_PI_4: f64 = 3.061_616_997_868_383e-17;

/// Returns tan⁻¹ x.
#[inline(always)]
pub(crate) fn atan<S: Simd>(simd: S, x: Wide<S>) -> Wide<S> {
    let number = |number| all(simd, number);
    let a = x.abs();
    let one = number(1.0);
    // tan 3π/8 and tan π/8: beyond them, tan⁻¹ a is π/2 − tan⁻¹ 1/a and π/4 + tan⁻¹ (a − 1)/(a + 1).
    let steep = a.simd_gt(number(2.414_213_562_373_095));
    let middle = a.simd_gt(number(0.414_213_562_373_095_03));
    let above = steep.select(-one, middle.select(a - one, a));
    let below = steep.select(a, middle.select(a + one, one));
    let t = above / below;
    let z = t * t;
    let zero = number(0.0);
    let base = steep.select(number(FRAC_PI_2), middle.select(number(FRAC_PI_4), zero));
    let rest = steep.select(number(REST_OF_PI_2), middle.select(number(REST_OF_PI_4), zero));
    let angle = base + (t + (t * z * polynomial(simd, z, &ATAN) + rest));
    angle.copysign(x)
}

/// Returns a polynomial, the highest coefficient first.
#[inline(always)]
fn polynomial<S: Simd, const N: usize>(simd: S, x: Wide<S>, coefficients: &[f64; N]) -> Wide<S> {
    let mut sum = all(simd, coefficients[0]);
    for &coefficient in &coefficients[1..] {
        sum = sum * x + all(simd, coefficient);
    }
    sum
}

/// Limits numbers to finite ones; NaN counts as 0.
#[inline(always)]
pub(crate) fn finite<S: Simd>(simd: S, x: Wide<S>) -> Wide<S> {
    x.simd_eq(x).select(within(simd, x, f64::MAX), all(simd, 0.0))
}

/// Limits numbers, which are not NaN, to −`most` … `most`.
#[inline(always)]
pub(crate) fn within<S: Simd>(simd: S, x: Wide<S>, most: f64) -> Wide<S> {
    let (low, high) = (all(simd, -most), all(simd, most));
    let x = x.simd_gt(high).select(high, x);
    x.simd_lt(low).select(low, x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::elementary;
    use crate::math::random::{Random, tries};

    /// The values of a function at numbers, which each set of instructions has alike.
    macro_rules! values {
        ($function:ident, $numbers:expr) => {{
            let [first, second] = Instructions::all().map(|instructions| {
                let mut values: Row = [0.0; ROW];
                dispatch!(instructions.level(), simd => {
                    for group in 0..GROUPS {
                        store($function(simd, four(simd, $numbers, group)), &mut values, group);
                    }
                });
                values
            });
            assert_eq!(first.map(f64::to_bits), second.map(f64::to_bits), "{:?}", $numbers);
            first
        }};
    }

    /// How many units in the last place of `exact` a value is off.
    fn units(value: f64, exact: f64) -> f64 {
        (value - exact).abs() / (exact.abs() * f64::EPSILON)
    }

    #[test]
    fn powers_of_e_are_right_to_the_last_place() {
        let mut random = Random(1);
        for _ in 0..tries() {
            let least = -40.0;
            let numbers: Row = std::array::from_fn(|lane| match lane % 3 {
                0 => random.number(-708.0, 709.7),
                1 => random.number(-1.0, 1.0),
                _ => random.size(least, 2.0) * [-1.0, 1.0][random.below(2)],
            });
            for (x, value) in numbers.into_iter().zip(values!(exp, &numbers)) {
                assert!(units(value, elementary::exp(x)) <= 2.0, "{x}: {value}");
            }
        }
    }

    #[test]
    fn powers_of_e_end_in_zero_and_infinity() {
        let least = -708.0;
        let mut numbers = [0.0; ROW];
        numbers[..9].copy_from_slice(&[
            -0.0,
            least,
            -1e3,
            -f64::MAX,
            f64::NEG_INFINITY,
            709.78,
            709.79,
            f64::MAX,
            f64::INFINITY,
        ]);
        let values = values!(exp, &numbers);
        assert_eq!(values[0], 1.0);
        assert!(units(values[1], elementary::exp(least)) <= 2.0);
        assert_eq!(values[2..5], [0.0; 3]);
        assert!(units(values[5], elementary::exp(709.78)) <= 2.0);
        assert_eq!(values[6..9], [f64::INFINITY; 3]);
        numbers[0] = f64::NAN;
        assert!(values!(exp, &numbers)[0].is_nan());
    }

    #[test]
    fn arc_tangents_are_right_to_the_last_place_at_any_size() {
        let mut random = Random(2);
        for _ in 0..tries() {
            let numbers: Row = std::array::from_fn(|lane| {
                let size = if lane % 2 == 0 {
                    random.number(0.0, 3.0)
                } else {
                    random.size(-300.0, 300.0)
                };
                size * [-1.0, 1.0][random.below(2)]
            });
            for (x, value) in numbers.into_iter().zip(values!(atan, &numbers)) {
                assert!(units(value, elementary::atan(x)) <= 2.0, "{x}: {value}");
            }
        }
        let numbers = [0.0, f64::INFINITY, f64::NEG_INFINITY, 1.0];
        let numbers = std::array::from_fn(|lane| numbers[lane % 4]);
        let [zero, up, down, one, ..] = values!(atan, &numbers);
        assert_eq!([zero, up, down, one], [0.0, FRAC_PI_2, -FRAC_PI_2, FRAC_PI_4]);
    }
}
