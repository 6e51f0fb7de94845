//! The operations of functions, on numbers and on intervals.
//!
//! **Source:** manual, sections 3.3.1.8 ("User-Defined Functions") and 3.3.1.5 ("Float Functions").
//! Comparisons are exact here and yield 1 or 0 (checked against POV-Ray: `1 = 1 + 1e-12` is false in a
//! function and true outside of one). Undefined results are NaN.

use crate::math::elementary;
use crate::math::interval::Interval;

/// An operation on one number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Unary {
    Negate,
    Not,
    Abs,
    Floor,
    Ceil,
    /// Rounds toward zero.
    Int,
    Square,
    Sqrt,
    Exp,
    /// The natural logarithm.
    Ln,
    /// The logarithm to base 10.
    Log,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
}

/// An operation on two numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Less,
    LessOrEqual,
    Equal,
    NotEqual,
    And,
    Or,
    Min,
    Max,
    /// The remainder, with the sign of the dividend.
    Mod,
    Pow,
    /// `atan2(y, x)`.
    Atan2,
}

fn truth(value: bool) -> f64 {
    f64::from(u8::from(value))
}

impl Unary {
    #[inline]
    pub fn of(self, a: f64) -> f64 {
        match self {
            Self::Negate => -a,
            Self::Not => truth(a == 0.0),
            Self::Abs => a.abs(),
            Self::Floor => a.floor(),
            Self::Ceil => a.ceil(),
            Self::Int => a.trunc(),
            Self::Square => a * a,
            Self::Sqrt => a.sqrt(),
            Self::Exp => elementary::exp(a),
            Self::Ln => elementary::log(a),
            Self::Log => elementary::log10(a),
            Self::Sin => elementary::sin(a),
            Self::Cos => elementary::cos(a),
            Self::Tan => elementary::tan(a),
            Self::Asin => elementary::asin(a),
            Self::Acos => elementary::acos(a),
            Self::Atan => elementary::atan(a),
            Self::Sinh => elementary::sinh(a),
            Self::Cosh => elementary::cosh(a),
            Self::Tanh => elementary::tanh(a),
            Self::Asinh => elementary::asinh(a),
            Self::Acosh => elementary::acosh(a),
            Self::Atanh => elementary::atanh(a),
        }
    }

    /// Returns an interval that contains [`Self::of`] for every number in `a`.
    #[inline]
    pub fn bounds(self, a: Interval) -> Interval {
        const INFINITY: f64 = f64::INFINITY;
        match self {
            Self::Not => match a.single() {
                Some(value) => Interval::point(truth(value == 0.0)),
                None if a.contains(0.0) => Interval::UNDECIDED,
                None => Interval::point(0.0),
            },
            _ if a == Interval::EVERYTHING => a,
            Self::Negate => -a,
            Self::Abs => a.abs(),
            Self::Floor => a.rising_exactly(f64::floor),
            Self::Ceil => a.rising_exactly(f64::ceil),
            Self::Int => a.rising_exactly(f64::trunc),
            Self::Square => a.square(),
            Self::Sqrt => a.sqrt(),
            Self::Exp => a.rising(elementary::exp).max(Interval::point(0.0)),
            Self::Ln => a.monotone_within(0.0, INFINITY, elementary::log),
            Self::Log => a.monotone_within(0.0, INFINITY, elementary::log10),
            Self::Sin => Interval::sin(a),
            Self::Cos => Interval::cos(a),
            Self::Tan => Interval::tan(a),
            Self::Asin => a.monotone_within(-1.0, 1.0, elementary::asin),
            Self::Acos => a.monotone_within(-1.0, 1.0, elementary::acos),
            Self::Atan => a.rising(elementary::atan),
            Self::Sinh => a.rising(elementary::sinh),
            Self::Cosh => Interval::cosh(a),
            Self::Tanh => a.rising(elementary::tanh),
            Self::Asinh => a.rising(elementary::asinh),
            Self::Acosh => a.monotone_within(1.0, INFINITY, elementary::acosh),
            Self::Atanh => a.monotone_within(-1.0, 1.0, elementary::atanh),
        }
    }
}

impl Binary {
    #[inline]
    pub fn of(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            Self::Less => truth(a < b),
            Self::LessOrEqual => truth(a <= b),
            Self::Equal => truth(a == b),
            Self::NotEqual => truth(a != b),
            Self::And => truth(a != 0.0 && b != 0.0),
            Self::Or => truth(a != 0.0 || b != 0.0),
            Self::Min => {
                if a < b {
                    a
                } else {
                    b
                }
            }
            // What is no number counts as the smaller one where it comes second, as in POV-Ray 3.7 (measured):
            // `max(0.4, sqrt(-1))` is 0.4.
            Self::Max => {
                if a < b {
                    b
                } else {
                    a
                }
            }
            Self::Mod => elementary::fmod(a, b),
            Self::Pow => elementary::pow(a, b),
            Self::Atan2 => elementary::atan2(a, b),
        }
    }

    /// Returns an interval that contains [`Self::of`] for every pair of numbers from `a` and `b`.
    #[inline]
    pub fn bounds(self, a: Interval, b: Interval) -> Interval {
        let decided = |always: bool, never: bool| match (always, never) {
            (true, _) => Interval::point(1.0),
            (_, true) => Interval::point(0.0),
            _ => Interval::UNDECIDED,
        };
        let apart = a.high < b.low || b.high < a.low;
        let same = a.single().is_some() && a.single() == b.single();
        let (a_true, b_true) = (!a.contains(0.0), !b.contains(0.0));
        let (a_false, b_false) = (a.single() == Some(0.0), b.single() == Some(0.0));
        match self {
            Self::Less => decided(a.high < b.low, a.low >= b.high),
            Self::LessOrEqual => decided(a.high <= b.low, a.low > b.high),
            Self::Equal => decided(same, apart),
            Self::NotEqual => decided(apart, same),
            Self::And => decided(a_true && b_true, a_false || b_false),
            Self::Or => decided(a_true || b_true, a_false && b_false),
            _ if a == Interval::EVERYTHING || b == Interval::EVERYTHING => Interval::EVERYTHING,
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            Self::Min => a.min(b),
            Self::Max => a.max(b),
            Self::Mod => a.fmod(b),
            Self::Pow => a.pow(b),
            Self::Atan2 => Interval::atan2(a, b),
        }
    }

    /// Returns whether the operands may be swapped.
    pub(super) fn commutes(self) -> bool {
        match self {
            Self::Add | Self::Multiply | Self::Equal | Self::NotEqual | Self::And | Self::Or => {
                true
            }
            Self::Subtract
            | Self::Divide
            | Self::Less
            | Self::LessOrEqual
            | Self::Min
            | Self::Max
            | Self::Mod
            | Self::Pow
            | Self::Atan2 => false,
        }
    }
}
