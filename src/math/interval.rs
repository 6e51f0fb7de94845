//! Interval arithmetic on closed intervals.
//!
//! **Invariant:** the result contains the exact and the rounded result for every choice of numbers in the
//! operands. Sums, products and roots are correctly rounded, so widening by one step is enough (up to two are
//! used where that is faster); the functions of [`super::elementary`] err by less than one unit in the last
//! place, and get two steps. A result that may be undefined for some choice (a root of a negative number) is
//! [`Interval::EVERYTHING`]; no other interval represents a result that may be NaN.
//!
//! **Source:** R. E. Moore, R. B. Kearfott, M. J. Cloud, *Introduction to Interval Analysis*, 2009.

use std::f64::consts::PI;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::elementary;

/// Outward steps for a function that is not correctly rounded.
const SLACK: usize = 2;

/// Argument in radians beyond which multiples of π are too inaccurate to locate a crest.
const FAR: f64 = 1e6;

/// Width up to which a wave is evaluated only once.
const NARROW: f64 = 1e-11;

/// Error, in radians per radian, from rounding π and dividing by it.
const TURN: f64 = 1e-15;

/// Integers up to this value are exact, and so are the quotients of adjacent ones.
const WHOLE: f64 = 1e15;

/// All numbers from `low` to `high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    pub low: f64,
    pub high: f64,
}

impl Interval {
    pub const EVERYTHING: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    /// Result of a comparison that may be true or false.
    pub const UNDECIDED: Self = Self { low: 0.0, high: 1.0 };

    /// Returns the interval between two numbers in either order.
    #[inline]
    pub fn between(a: f64, b: f64) -> Self {
        if a.is_nan() || b.is_nan() {
            Self::EVERYTHING
        } else {
            Self { low: a.min(b), high: a.max(b) }
        }
    }

    /// Returns the interval of a single number.
    #[inline]
    pub fn point(value: f64) -> Self {
        Self::between(value, value)
    }

    /// Returns the number, if the interval has only one.
    #[inline]
    pub fn single(self) -> Option<f64> {
        (self.low == self.high).then_some(self.low)
    }

    #[inline]
    pub fn contains(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// Returns the smallest interval that contains both.
    #[inline]
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Returns the range of the minimum; neither operand may contain NaN.
    #[inline]
    pub fn min(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.min(other.high) }
    }

    /// Returns the range of the maximum; neither operand may contain NaN.
    #[inline]
    pub fn max(self, other: Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.max(other.high) }
    }

    #[inline]
    pub fn abs(self) -> Self {
        if self.low >= 0.0 {
            self
        } else if self.high <= 0.0 {
            -self
        } else {
            Self { low: 0.0, high: self.high.max(-self.low) }
        }
    }

    /// Returns x·x, narrower than with [`Mul`], which treats the operands as independent.
    #[inline]
    pub fn square(self) -> Self {
        let Self { low, high } = self.abs();
        let wide = Self::outward(low * low, high * high);
        Self { low: wide.low.max(0.0), ..wide }
    }

    #[inline]
    pub fn sqrt(self) -> Self {
        if self.low < 0.0 {
            return Self::EVERYTHING;
        }
        let wide = Self::outward(self.low.sqrt(), self.high.sqrt());
        Self { low: wide.low.max(0.0), ..wide }
    }

    /// Returns the image under a non-decreasing function that is exact (`floor`, `trunc`).
    #[inline]
    pub fn rising_exactly(self, f: impl Fn(f64) -> f64) -> Self {
        let low = f(self.low);
        Self::between(low, if self.low == self.high { low } else { f(self.high) })
    }

    /// Returns the image under a non-decreasing function.
    #[inline]
    pub fn rising(self, f: impl Fn(f64) -> f64) -> Self {
        self.rising_exactly(f).widened(SLACK)
    }

    /// Returns the image under a non-increasing function.
    pub fn falling(self, f: impl Fn(f64) -> f64) -> Self {
        self.rising(f)
    }

    /// Returns the image under a monotone function; everything where the function is not defined on the whole
    /// interval, which must lie in `low ..= high`.
    pub fn monotone_within(self, low: f64, high: f64, f: impl Fn(f64) -> f64) -> Self {
        if low <= self.low && self.high <= high { self.rising(f) } else { Self::EVERYTHING }
    }

    pub fn cosh(self) -> Self {
        self.abs().rising(elementary::cosh)
    }

    pub fn sin(self) -> Self {
        self.wave(elementary::sin, 0.5)
    }

    pub fn cos(self) -> Self {
        self.wave(elementary::cos, 0.0)
    }

    /// Image under a wave from −1 to 1 with period 2π and crests at `crest`·π plus multiples of 2π.
    fn wave(self, f: impl Fn(f64) -> f64, crest: f64) -> Self {
        const FULL: Interval = Interval { low: -1.0, high: 1.0 };
        let far = self.low.abs().max(self.high.abs());
        if far == f64::INFINITY {
            return Self::EVERYTHING;
        }
        if far > FAR || self.high - self.low >= 2.0 * PI {
            return FULL;
        }
        let width = self.high - self.low;
        if width <= NARROW {
            // It changes by no more than its argument.
            let middle = f(self.low + 0.5 * width);
            let wide = Self { low: middle - width, high: middle + width }.widened(SLACK);
            return Self { low: wide.low.max(-1.0), high: wide.high.min(1.0) };
        }
        let ends = self.rising(f);
        // In half turns from a crest, widened by what π and the division round off.
        let slack = TURN * (far + 4.0);
        let turns = |value: f64| value / PI - crest;
        let (first, last) = (turns(self.low) - slack, turns(self.high) + slack);
        let reaches = |parity: f64| {
            let nearest = ((first - parity) / 2.0).ceil() * 2.0 + parity;
            nearest <= last
        };
        Self {
            low: if reaches(1.0) { -1.0 } else { ends.low.max(-1.0) },
            high: if reaches(0.0) { 1.0 } else { ends.high.min(1.0) },
        }
    }

    pub fn tan(self) -> Self {
        let Self { low, high } = Self::cos(self);
        if low <= 0.0 && high >= 0.0 || self.high - self.low >= PI {
            return Self::EVERYTHING;
        }
        self.rising(elementary::tan)
    }

    /// Returns the range of `atan2(self, x)`.
    pub fn atan2(self, x: Self) -> Self {
        // Across the cut on the negative x axis the angle jumps by a turn.
        let on_cut = x.low <= 0.0 && self.contains(0.0) && self.single().is_none();
        if on_cut || !x.is_finite() || !self.is_finite() {
            return Self { low: -PI, high: PI }.widened(SLACK);
        }
        // Away from the cut the extremes lie on corners.
        let corners =
            [(self.low, x.low), (self.low, x.high), (self.high, x.low), (self.high, x.high)];
        let angles = corners.map(|(y, x)| elementary::atan2(y, x));
        Self::hull_of(angles).widened(SLACK)
    }

    /// Returns the range of `pow(self, exponent)`.
    pub fn pow(self, exponent: Self) -> Self {
        if let Some(whole) = exponent.single().filter(|n| n.fract() == 0.0 && n.abs() < WHOLE) {
            let even = whole % 2.0 == 0.0;
            if whole == 0.0 {
                return Self::point(1.0);
            }
            if whole < 0.0 && self.contains(0.0) {
                return Self::EVERYTHING;
            }
            let base = if even { self.abs() } else { self };
            return base.rising(|x| elementary::pow(x, whole)).as_signed_as(base);
        }
        let is_root_of_zero = self.low == 0.0 && exponent.low > 0.0;
        if (self.low <= 0.0 && !is_root_of_zero) || !self.is_finite() || !exponent.is_finite() {
            return Self::EVERYTHING;
        }
        // Monotone in each argument alone: the extremes lie on corners.
        let Self { low, high } = exponent;
        let corners = [(self.low, low), (self.low, high), (self.high, low), (self.high, high)];
        Self::hull_of(corners.map(|(x, n)| elementary::pow(x, n))).widened(SLACK).as_signed_as(self)
    }

    /// Clamps a power to be non-negative if its base is.
    fn as_signed_as(self, base: Self) -> Self {
        Self { low: if base.low >= 0.0 { self.low.max(0.0) } else { self.low }, ..self }
    }

    /// Returns the range of the remainder with the sign of the dividend.
    pub fn fmod(self, by: Self) -> Self {
        let by = match by.single().map(f64::abs) {
            Some(by) if by > 0.0 && by.is_finite() && self.is_finite() => by,
            _ => return Self::EVERYTHING,
        };
        // Within one period the remainder rises with the dividend.
        let (low, high) = ((self.low / by).trunc(), (self.high / by).trunc());
        if low == high && low.abs() < WHOLE && self.low * self.high >= 0.0 {
            let ends =
                Self::between(elementary::fmod(self.low, by), elementary::fmod(self.high, by));
            // A quotient that was rounded up to a whole number is told by ends out of order.
            if ends.low == elementary::fmod(self.low, by) {
                return ends;
            }
        }
        Self {
            low: if self.low < 0.0 { -by } else { 0.0 },
            high: if self.high > 0.0 { by } else { 0.0 },
        }
    }

    #[inline]
    pub fn is_finite(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    #[inline]
    fn hull_of([a, b, c, d]: [f64; 4]) -> Self {
        // Where the sum is a number, each of them is.
        if (a + b + c + d).is_nan() && [a, b, c, d].iter().any(|value| value.is_nan()) {
            return Self::EVERYTHING;
        }
        let least = |a: f64, b: f64| if a < b { a } else { b };
        let most = |a: f64, b: f64| if a > b { a } else { b };
        Self { low: least(least(a, b), least(c, d)), high: most(most(a, b), most(c, d)) }
    }

    #[inline]
    fn widened(self, steps: usize) -> Self {
        Self::stepped(self.low, self.high, steps)
    }

    /// Widens the rounded ends of a sum. A rounded sum has the sign of the exact one, so a sum of squares
    /// never becomes negative and always has a root.
    #[inline]
    fn sum(low: f64, high: f64) -> Self {
        let wide = Self::outward(low, high);
        Self {
            low: if low >= 0.0 { wide.low.max(0.0) } else { wide.low },
            high: if high <= 0.0 { wide.high.min(0.0) } else { wide.high },
        }
    }

    #[inline]
    fn outward(low: f64, high: f64) -> Self {
        Self::stepped(low, high, 1)
    }

    /// Moves both ends outward by at least `steps` representable numbers, by addition rather than bit
    /// operations: ε·|x| is at least one step.
    #[inline]
    fn stepped(low: f64, high: f64, steps: usize) -> Self {
        let step = |x: f64| x.abs() * (f64::EPSILON * steps as f64) + f64::MIN_POSITIVE;
        let wide = Self { low: low - step(low), high: high + step(high) };
        if wide.low <= wide.high { wide } else { Self::stepped_by_bits(low, high, steps) }
    }

    /// Returns the sum of two points if it is exact, so that counters and fixed steps are not widened.
    ///
    /// **Source:** D. Knuth, "The Art of Computer Programming" 2, section 4.2.2, theorem B: the error of a
    /// sum.
    #[inline]
    fn exact_sum(self, other: Self) -> Option<Self> {
        if self.low != self.high || other.low != other.high {
            return None;
        }
        let (a, b) = (self.low, other.low);
        let sum = a + b;
        let part = sum - a;
        let error = (a - (sum - part)) + (b - part);
        (error == 0.0).then_some(Self::point(sum))
    }

    /// Handles infinities and NaN.
    #[cold]
    fn stepped_by_bits(low: f64, high: f64, steps: usize) -> Self {
        if low.is_nan() || high.is_nan() {
            return Self::EVERYTHING;
        }
        let (mut low, mut high) = (low, high);
        for _ in 0..steps {
            (low, high) = (low.next_down(), high.next_up());
        }
        Self { low, high }
    }
}

impl Neg for Interval {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Add for Interval {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        match self.exact_sum(other) {
            Some(sum) => sum,
            None => Self::sum(self.low + other.low, self.high + other.high),
        }
    }
}

impl Sub for Interval {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let products = [
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ];
        let Self { low, high } = Self::hull_of(products);
        let wide = Self::outward(low, high);
        let is_positive = self.low >= 0.0 && other.low >= 0.0 && low >= 0.0;
        Self { low: if is_positive { wide.low.max(0.0) } else { wide.low }, ..wide }
    }
}

impl Div for Interval {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Self::EVERYTHING;
        }
        let quotients = [
            self.low / other.low,
            self.low / other.high,
            self.high / other.low,
            self.high / other.high,
        ];
        let Self { low, high } = Self::hull_of(quotients);
        Self::outward(low, high)
    }
}

#[cfg(test)]
mod tests;
