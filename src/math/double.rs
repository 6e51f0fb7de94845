//! Double-double numbers: unevaluated sums of two `f64`, with about 106 bits.
//!
//! **In/Out:** plain values. **Invariant:** `high` is the sum rounded to `f64`, and `low` is the rest, so
//! [`Double::round`] rounds once. Results that fit in 106 bits (dyadic numbers, small integers) are exact;
//! others have a relative error of at most 2⁻¹⁰² (for products and quotients, above 2⁻⁹⁰⁰; for sums, relative
//! to the larger term). An overflow yields a value that is not finite, never a wrong one.
//!
//! **Source:** Joldes, Muller, Popescu, "Tight and rigorous error bounds for basic building blocks of
//! double-word arithmetic", ACM TOMS 44 (2017): algorithms 6, 12, 17.

use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::LazyLock;

use super::Vector;
use super::elementary::fmod;

/// A real number with about 32 decimal digits.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Double {
    high: f64,
    low: f64,
}

/// Returns a + b and its rounding error, exactly.
fn two_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    let b_part = high - a;
    Double { high, low: (a - (high - b_part)) + (b - b_part) }
}

/// [`two_sum`] for |a| ≥ |b|.
fn fast_two_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    Double { high, low: b - (high - a) }
}

/// Returns a · b and its rounding error, exactly (barring underflow).
fn two_product(a: f64, b: f64) -> Double {
    let high = a * b;
    Double { high, low: a.mul_add(b, -high) }
}

impl Double {
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };
    pub const ONE: Self = Self { high: 1.0, low: 0.0 };
    /// π / 180, which converts degrees to radians.
    const RADIANS_PER_DEGREE: Self =
        Self { high: 0.017453292519943295, low: 2.9486522708701687e-19 };

    /// Returns the nearest `f64`; a zero is always positive.
    #[inline]
    pub fn round(self) -> f64 {
        self.high + 0.0
    }

    #[inline]
    pub fn is_zero(self) -> bool {
        self.high == 0.0
    }

    #[inline]
    pub fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }

    #[inline]
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// Returns the square root; zero for a negative number.
    pub fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::ZERO;
        }
        let root = self.high.sqrt();
        let rest = self - two_product(root, root);
        fast_two_sum(root, rest.high / (2.0 * root))
    }

    /// Multiplies by a power of two; exact unless it overflows or underflows.
    #[inline]
    pub fn times_power_of_two(self, power: f64) -> Self {
        Self { high: self.high * power, low: self.low * power }
    }
}

impl From<f64> for Double {
    #[inline]
    fn from(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }
}

impl Neg for Double {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for Double {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let high = two_sum(self.high, other.high);
        let low = two_sum(self.low, other.low);
        let sum = fast_two_sum(high.high, high.low + low.high);
        fast_two_sum(sum.high, low.low + sum.low)
    }
}

impl Sub for Double {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let product = two_product(self.high, other.high);
        let cross =
            self.low.mul_add(other.high, self.high.mul_add(other.low, self.low * other.low));
        fast_two_sum(product.high, product.low + cross)
    }
}

impl Div for Double {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        fast_two_sum(first, second) + Self::from(rest.high / other.high)
    }
}

/// Returns the sine and cosine of an angle in degrees.
///
/// Exact where they are 0, ±½ or ±1; equal in magnitude at odd multiples of 45°; elsewhere within 2⁻¹⁰⁰. The
/// angle is reduced to −45° … 45°, which is exact in `f64`; then the Taylor series is summed from its
/// smallest term. Not finite for an angle that is not finite.
pub fn sin_cos_degrees(degrees: f64) -> (Double, Double) {
    let turn = fmod(degrees, 360.0);
    let quarter = (turn / 90.0).round();
    let rest = turn - quarter * 90.0;
    let half = Double::from(0.5);
    let (sine, cosine) = if rest.abs() == 30.0 {
        (if rest < 0.0 { -half } else { half }, Double::from(0.75).sqrt())
    } else if rest.abs() == 45.0 {
        let root = half.sqrt();
        (if rest < 0.0 { -root } else { root }, root)
    } else {
        let x = Double::from(rest) * Double::RADIANS_PER_DEGREE;
        let [sine, cosine] = &*SERIES;
        (x * alternating(sine, x * x), alternating(cosine, x * x))
    };
    match (quarter as i64).rem_euclid(4) {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// Sums (−square)ᵏ · termₖ, from the smallest.
fn alternating(terms: &[Double; TERMS], square: Double) -> Double {
    let [first @ .., last] = terms;
    first.iter().rev().fold(*last, |sum, &term| term - square * sum)
}

/// Number of terms; the rest is less than 2⁻¹¹⁰ for an argument below π/4.
const TERMS: usize = 14;

/// 1/(2k + 1)! and 1/(2k)!: for the sine divided by its argument, and for the cosine.
static SERIES: LazyLock<[[Double; TERMS]; 2]> = LazyLock::new(|| {
    let terms = |start: f64| {
        let mut term = Double::ONE;
        std::array::from_fn(|k| {
            let n = 2.0 * k as f64 + start;
            term = if k == 0 { term } else { term / Double::from(n * (n - 1.0)) };
            term
        })
    };
    [terms(1.0), terms(0.0)]
});

/// A vector of [`Double`]s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DoubleVector {
    pub x: Double,
    pub y: Double,
    pub z: Double,
}

impl DoubleVector {
    pub const ZERO: Self = Self::new(Double::ZERO, Double::ZERO, Double::ZERO);

    #[inline]
    pub const fn new(x: Double, y: Double, z: Double) -> Self {
        Self { x, y, z }
    }

    pub fn axis(index: usize) -> Self {
        let component = |i| if i == index { Double::ONE } else { Double::ZERO };
        Self::new(component(0), component(1), component(2))
    }

    #[inline]
    pub fn components(self) -> [Double; 3] {
        [self.x, self.y, self.z]
    }

    /// Rounds each component once.
    pub fn round(self) -> Vector {
        Vector::new(self.x.round(), self.y.round(), self.z.round())
    }

    pub fn map(self, f: impl Fn(Double) -> Double) -> Self {
        Self::new(f(self.x), f(self.y), f(self.z))
    }

    pub fn dot(self, other: Self) -> Double {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    pub fn is_finite(self) -> bool {
        self.components().iter().all(|c| c.is_finite())
    }

    pub fn is_zero(self) -> bool {
        self.components().iter().all(|c| c.is_zero())
    }

    /// Returns the largest absolute component, rounded.
    pub fn largest(self) -> f64 {
        self.round().abs().max_element()
    }

    /// Returns the length; exact along an axis; never overflows or underflows.
    pub fn length(self) -> Double {
        let (v, size) = self.near_one();
        v.length_near_one().times_power_of_two(size)
    }

    /// Returns the unit vector in this direction; `None` for zero.
    pub fn normalized(self) -> Option<Self> {
        let (v, _) = self.near_one();
        let length = v.length_near_one();
        (!length.is_zero()).then(|| v.map(|c| c / length))
    }

    /// Returns the vector divided by a power of two, so that it is near 1, and that power.
    fn near_one(self) -> (Self, f64) {
        let size = power_of_two_near(self.largest());
        (self.map(|c| c.times_power_of_two(1.0 / size)), size)
    }

    fn length_near_one(self) -> Double {
        self.on_axis().unwrap_or_else(|| self.dot(self).sqrt())
    }

    /// Absolute value of the only component that is not zero, if there is only one.
    fn on_axis(self) -> Option<Double> {
        let mut parts = self.components().into_iter().filter(|c| !c.is_zero());
        match (parts.next(), parts.next()) {
            (Some(part), None) => Some(part.abs()),
            _ => None,
        }
    }
}

/// Returns 2 to the `exponent`, clamped to normal numbers.
pub fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent.clamp(-1022, 1023)) as u64) << 52)
}

/// Returns the largest power of two not above `value`, within the range where its inverse is also one.
pub fn power_of_two_near(value: f64) -> f64 {
    let exponent = (value.to_bits() >> 52) & 0x7ff;
    f64::from_bits(exponent.clamp(2, 2044) << 52)
}

/// Returns a number that can be subtracted from every number in the range without rounding: the middle, if no
/// number is more than twice another, else 0.
///
/// **Source:** Sterbenz' lemma (J.-M. Muller et al., *Handbook of Floating-Point Arithmetic*, 2nd ed., lemma
/// 4.1).
pub fn exact_middle((low, high): (f64, f64)) -> f64 {
    let (least, most) = (low.abs().min(high.abs()), low.abs().max(high.abs()));
    let is_beside_0 = (low > 0.0) == (high > 0.0) && most <= 2.0 * least;
    if is_beside_0 { 0.5 * low + 0.5 * high } else { 0.0 }
}

impl From<Vector> for DoubleVector {
    fn from(v: Vector) -> Self {
        Self::new(v.x.into(), v.y.into(), v.z.into())
    }
}

impl Neg for DoubleVector {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(|c| -c)
    }
}

impl Add for DoubleVector {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl Sub for DoubleVector {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl Mul<Double> for DoubleVector {
    type Output = Self;
    fn mul(self, factor: Double) -> Self {
        self.map(|c| c * factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance(a: Double, b: Double) -> f64 {
        (a - b).abs().round()
    }

    #[test]
    fn products_and_sums_of_two_f64_are_exact() {
        let (a, b) = (Double::from(1.0 + f64::EPSILON), Double::from(1.0 - f64::EPSILON));
        // (1 + e)(1 − e) = 1 − e²
        let square = Double::from(f64::EPSILON * f64::EPSILON);
        assert_eq!(a * b, Double::ONE - square);
        assert_eq!(Double::from(1e16) + Double::ONE - Double::from(1e16), Double::ONE);
    }

    #[test]
    fn dividing_and_taking_roots_undo_multiplying() {
        let mut x = Double::from(0.7390851332151607);
        for _ in 0..200 {
            x = x * Double::from(1.37) + Double::from(0.1);
            assert!(distance(x * x / x, x) <= x.round() * 1e-30);
            assert!(distance((x * x).sqrt(), x) <= x.round() * 1e-30);
        }
        assert_eq!(Double::from(27.0) / Double::from(9.0), Double::from(3.0));
        assert_eq!(Double::from(49.0).sqrt(), Double::from(7.0));
    }

    #[test]
    fn sines_are_exact_at_multiples_of_thirty_degrees_that_are_rational() {
        let value = |s: f64| Double::from(s);
        for turn in [-720.0, 0.0, 360.0, 3.6e9] {
            for (degrees, sine) in [(0.0, 0.0), (30.0, 0.5), (90.0, 1.0), (150.0, 0.5)] {
                assert_eq!(sin_cos_degrees(turn + degrees).0, value(sine));
                assert_eq!(sin_cos_degrees(turn + degrees + 180.0).0, value(-sine));
                assert_eq!(sin_cos_degrees(turn + degrees - 90.0).1, value(sine));
            }
        }
    }

    #[test]
    fn sines_obey_the_law_of_pythagoras_and_the_law_of_the_triple_angle() {
        for i in 0..2000 {
            let degrees = f64::from(i) * 0.734375 - 700.0;
            let (s, c) = sin_cos_degrees(degrees);
            assert!(distance(s * s + c * c, Double::ONE) < 1e-30, "{degrees}");
            let (s3, _) = sin_cos_degrees(3.0 * degrees);
            let triple = s * (Double::from(3.0) - Double::from(4.0) * s * s);
            assert!(distance(s3, triple) < 1e-29, "{degrees}: {s3:?} {triple:?}");
            assert!(
                (s.round() - super::super::elementary::sin_cos_degrees(degrees).0).abs() < 4e-16
            );
        }
    }

    #[test]
    fn lengths_survive_any_size() {
        for size in [1e-300, 1e-200, 1.0, 1e200, 1e300] {
            let v = DoubleVector::from(Vector::new(3.0, 4.0, 0.0)) * Double::from(size);
            assert!((v.length().round() / (5.0 * size) - 1.0).abs() < 1e-15, "{size}");
        }
    }

    #[test]
    fn an_overflow_is_never_finite() {
        assert!(!(Double::from(1e300) * Double::from(1e300)).is_finite());
        assert!(!(Double::from(1e308) + Double::from(1e308)).is_finite());
        assert!(!(Double::ONE / Double::ZERO).is_finite());
    }
}
