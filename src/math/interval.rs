//! Closed intervals: what a calculation can come to when its inputs lie between two numbers.
//!
//! **Invariant:** the exact result for every choice of numbers in the operands lies in the result;
//! so does the rounded one. Sums, products and roots are correctly rounded, so one step outward
//! holds them; the functions of [`super::elementary`] err by less than one unit in the last place,
//! and get two steps. What may be undefined for some choice (a root of a negative number) is
//! [`Interval::EVERYTHING`], and no other interval stands for what may be not a number.
//!
//! **Source:** R. E. Moore, R. B. Kearfott, M. J. Cloud, *Introduction to Interval Analysis*, 2009.

use std::f64::consts::PI;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::elementary;

/// Steps outward for a function that is not correctly rounded.
const SLACK: usize = 2;

/// Beyond so many radians, multiples of π are not told apart well enough to place a crest.
const FAR: f64 = 1e6;

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
    pub fn between(a: f64, b: f64) -> Self {
        if a.is_nan() || b.is_nan() {
            Self::EVERYTHING
        } else {
            Self { low: a.min(b), high: a.max(b) }
        }
    }

    /// One number.
    pub fn point(value: f64) -> Self {
        Self::between(value, value)
    }

    /// One number, if it is no more than that.
    pub fn single(self) -> Option<f64> {
        (self.low == self.high).then_some(self.low)
    }

    pub fn contains(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// The least interval that holds both.
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Of two that are numbers throughout.
    pub fn min(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.min(other.high) }
    }

    /// Of two that are numbers throughout.
    pub fn max(self, other: Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.max(other.high) }
    }

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
    pub fn square(self) -> Self {
        let Self { low, high } = self.abs();
        Self { low: (low * low).next_down().max(0.0), high: (high * high).next_up() }
    }

    pub fn sqrt(self) -> Self {
        if self.low < 0.0 {
            return Self::EVERYTHING;
        }
        Self { low: self.low.sqrt().next_down().max(0.0), high: self.high.sqrt().next_up() }
    }

    /// The image under a function that never falls and is exact (`floor`, `trunc`).
    pub fn rising_exactly(self, f: impl Fn(f64) -> f64) -> Self {
        Self::between(f(self.low), f(self.high))
    }

    /// The image under a function that never falls.
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

    pub fn is_finite(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    fn hull_of(values: [f64; 4]) -> Self {
        if values.iter().any(|value| value.is_nan()) {
            return Self::EVERYTHING;
        }
        let low = values.into_iter().fold(f64::INFINITY, f64::min);
        Self { low, high: values.into_iter().fold(f64::NEG_INFINITY, f64::max) }
    }

    fn widened(self, steps: usize) -> Self {
        let mut wide = self;
        for _ in 0..steps {
            wide = Self { low: wide.low.next_down(), high: wide.high.next_up() };
        }
        wide
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

    fn outward(low: f64, high: f64) -> Self {
        if low.is_nan() || high.is_nan() {
            return Self::EVERYTHING;
        }
        Self { low: low.next_down(), high: high.next_up() }
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::sum(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::sum(self.low - other.high, self.high - other.low)
    }
}

impl Mul for Interval {
    type Output = Self;
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
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// Tries a function on numbers drawn from drawn intervals.
    fn holds(
        name: &str,
        interval: impl Fn(Interval, Interval) -> Interval,
        exact: impl Fn(f64, f64) -> f64,
    ) {
        let mut narrow = 0;
        for seed in 0..2_000 {
            let mut draw = Random::of(seed, 1);
            let drawn = |draw: &mut Random| {
                let scale = elementary::pow(10.0, draw.number(-3.0, 2.0));
                let low = draw.number(-1.0, 1.0) * scale;
                let width = if draw.below(4) == 0 { 0.0 } else { draw.number(0.0, 0.5) * scale };
                Interval { low, high: low + width }
            };
            let (a, b) = (drawn(&mut draw), drawn(&mut draw));
            let result = interval(a, b);
            narrow += usize::from(result.is_finite());
            for k in 0..24 {
                let within = |i: Interval, draw: &mut Random| match k {
                    0 => i.low,
                    1 => i.high,
                    _ => draw.number(i.low, i.high).clamp(i.low, i.high),
                };
                let (x, y) = (within(a, &mut draw), within(b, &mut draw));
                let value = exact(x, y);
                assert!(
                    value.is_nan() && result == Interval::EVERYTHING || result.contains(value),
                    "{name}({x:e}, {y:e}) = {value:e} outside {result:?} of {a:?}, {b:?}"
                );
            }
        }
        assert!(narrow > 400, "{name} gave {narrow} finite intervals of 2,000");
    }

    #[test]
    fn every_value_lies_in_the_interval_of_its_operation() {
        holds("+", |a, b| a + b, |a, b| a + b);
        holds("-", |a, b| a - b, |a, b| a - b);
        holds("*", |a, b| a * b, |a, b| a * b);
        holds("/", |a, b| a / b, |a, b| a / b);
        holds("abs", |a, _| a.abs(), |a, _| a.abs());
        holds("square", |a, _| a.square(), |a, _| a * a);
        holds("sqrt", |a, _| a.sqrt(), |a, _| a.sqrt());
        holds("sin", |a, _| Interval::sin(a), |a, _| elementary::sin(a));
        holds("cos", |a, _| Interval::cos(a), |a, _| elementary::cos(a));
        holds("tan", |a, _| Interval::tan(a), |a, _| elementary::tan(a));
        holds("atan2", Interval::atan2, elementary::atan2);
        holds("pow", Interval::pow, elementary::pow);
        holds("cube", |a, _| a.pow(Interval::point(3.0)), |a, _| elementary::pow(a, 3.0));
        holds("fmod", |a, _| a.fmod(Interval::point(0.75)), |a, _| elementary::fmod(a, 0.75));
        holds("cosh", |a, _| Interval::cosh(a), |a, _| elementary::cosh(a));
    }

    #[test]
    fn a_sum_of_squares_has_a_root_wherever_it_is() {
        for high in [0.0, 1e-300, 0.25] {
            let side = Interval { low: -0.0, high };
            let zero = Interval::point(0.0);
            let squares: [fn(Interval) -> Interval; 3] =
                [Interval::square, |side| side.pow(Interval::point(2.0)), |side| side * side];
            for square in squares {
                let length = (square(side) + square(zero) + square(zero)).sqrt();
                assert!(
                    length.low == 0.0 && length.high <= high * (1.0 + 1e-14) + 1e-150,
                    "{length:?}"
                );
            }
            let less = -side - zero;
            assert!(less.high == 0.0, "{less:?}");
        }
    }

    #[test]
    fn a_wave_is_cut_where_it_does_not_reach_its_crest() {
        let sin = |low, high| Interval::sin(Interval { low, high });
        let quarter = sin(0.1, 1.0);
        assert!(quarter.low > 0.09 && quarter.high < 0.85, "{quarter:?}");
        assert_eq!(sin(1.0, 2.0).high, 1.0);
        assert_eq!(Interval::cos(Interval { low: 3.0, high: 3.3 }).low, -1.0);
    }

    #[test]
    fn what_may_be_undefined_may_be_everything() {
        assert_eq!(Interval { low: -1.0, high: 4.0 }.sqrt(), Interval::EVERYTHING);
        assert_eq!(Interval::point(1.0) / Interval { low: -1.0, high: 1.0 }, Interval::EVERYTHING);
    }
}
