//! Closed intervals: what a calculation can come to when its inputs lie between two numbers.
//!
//! **Invariant:** the exact result for every choice of numbers in the operands lies in the result;
//! so does the rounded one. Sums, products and roots are correctly rounded, so one step outward
//! holds them (or up to two, which are sooner taken); the functions of [`super::elementary`] err by
//! less than one unit in the last place, and get two steps. What may be undefined for some choice (a root
//! of a negative number) is [`Interval::EVERYTHING`], and no other interval stands for what may be not a
//! number.
//!
//! **Source:** R. E. Moore, R. B. Kearfott, M. J. Cloud, *Introduction to Interval Analysis*, 2009.

use std::f64::consts::PI;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::elementary;

/// Steps outward for a function that is not correctly rounded.
const SLACK: usize = 2;

/// Beyond so many radians, multiples of π are not told apart well enough to place a crest.
const FAR: f64 = 1e6;

/// What is no wider, of a wave, is not worth two values.
const NARROW: f64 = 1e-11;

/// What π and a division by it round off, of a radian.
const TURN: f64 = 1e-15;

/// Whole numbers up to it are exact, and so are their neighbours' quotients.
const WHOLE: f64 = 1e15;

/// All numbers from `low` to `high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    pub low: f64,
    pub high: f64,
}

impl Interval {
    pub const EVERYTHING: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    /// What a comparison comes to while both answers are possible.
    pub const UNDECIDED: Self = Self { low: 0.0, high: 1.0 };

    /// The numbers between two, in either order.
    #[inline]
    pub fn between(a: f64, b: f64) -> Self {
        if a.is_nan() || b.is_nan() {
            Self::EVERYTHING
        } else {
            Self { low: a.min(b), high: a.max(b) }
        }
    }

    /// One number.
    #[inline]
    pub fn point(value: f64) -> Self {
        Self::between(value, value)
    }

    /// One number, if it is no more than that.
    #[inline]
    pub fn single(self) -> Option<f64> {
        (self.low == self.high).then_some(self.low)
    }

    #[inline]
    pub fn contains(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// The least interval that holds both.
    #[inline]
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Of two that are numbers throughout.
    #[inline]
    pub fn min(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.min(other.high) }
    }

    /// Of two that are numbers throughout.
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

    /// x·x, which [`Mul`] takes for a product of strangers.
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

    /// The image under a function that never falls and is exact (`floor`, `trunc`).
    #[inline]
    pub fn rising_exactly(self, f: impl Fn(f64) -> f64) -> Self {
        let low = f(self.low);
        Self::between(low, if self.low == self.high { low } else { f(self.high) })
    }

    /// The image under a function that never falls.
    #[inline]
    pub fn rising(self, f: impl Fn(f64) -> f64) -> Self {
        self.rising_exactly(f).widened(SLACK)
    }

    /// The image under a function that never rises.
    pub fn falling(self, f: impl Fn(f64) -> f64) -> Self {
        self.rising(f)
    }

    /// The image under a function that rises or falls throughout, where it is defined on all of
    /// `low ..= high`.
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

    /// A wave of −1 to 1 and period 2π whose crests lie at `crest`·π and whole turns from there.
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

    /// `atan2(self, x)`.
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

    /// `pow(self, exponent)`.
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

    /// The power of what is not less than 0 is not either.
    fn as_signed_as(self, base: Self) -> Self {
        Self { low: if base.low >= 0.0 { self.low.max(0.0) } else { self.low }, ..self }
    }

    /// The remainder with the sign of the dividend.
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

    /// Of sums as they are rounded: each has the sign of what was meant, so that a sum of squares is never
    /// less than 0, and has a root.
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

    /// At least so many steps to the next number outward, by a sum and not by bits: ε·|x| is no less than
    /// one.
    #[inline]
    fn stepped(low: f64, high: f64, steps: usize) -> Self {
        let step = |x: f64| x.abs() * (f64::EPSILON * steps as f64) + f64::MIN_POSITIVE;
        let wide = Self { low: low - step(low), high: high + step(high) };
        if wide.low <= wide.high { wide } else { Self::stepped_by_bits(low, high, steps) }
    }

    /// Of two points whose sum is a number: what counts, or goes by steps, stays whole.
    ///
    /// **Source:** D. Knuth, "The Art of Computer Programming" 2, section 4.2.2, theorem B: the error of a sum.
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

    /// For what is infinite, or no number.
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
