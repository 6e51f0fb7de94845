//! Bounds with slopes: the range of a value over a box, and of its derivatives along some directions.
//!
//! **Invariant:** if both ends of a step along a direction lie in the box, the value changes by the length of
//! the step times some number in that direction's `slopes`. So a kink has the slopes of both sides, and a
//! value that may jump or be undefined has [`Interval::EVERYTHING`].
//!
//! **Source:** F. Clarke, *Optimization and Nonsmooth Analysis* (1983), section 2.3, for the rules at kinks;
//! L. Rall, *Automatic Differentiation* (1981), for the others.

use super::number::{Number, Turn};
use super::operation::{Binary, Unary};
use super::{Outside, OutsideId};
use crate::math::interval::Interval;

/// The range of a value, and of its slope along each of `N` directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sloped<const N: usize> {
    pub value: Interval,
    pub slopes: [Interval; N],
}

const LEVEL: Interval = Interval { low: 0.0, high: 0.0 };
const ONE: Interval = Interval { low: 1.0, high: 1.0 };

/// Product of a steepness and a slope; a constant has slope 0, however steep the operation.
#[inline]
fn times(steepness: Interval, slope: Interval) -> Interval {
    if slope == LEVEL || steepness == LEVEL { LEVEL } else { steepness * slope }
}

#[inline]
fn plus(a: Interval, b: Interval) -> Interval {
    match (a == LEVEL, b == LEVEL) {
        (true, _) => b,
        (_, true) => a,
        _ => a + b,
    }
}

/// 0 where a step function is constant.
fn of_steps(value: Interval) -> Interval {
    if value.single().is_some() { LEVEL } else { Interval::EVERYTHING }
}

impl<const N: usize> Sloped<N> {
    /// Chain rule for one argument.
    #[inline]
    pub fn follow(value: Interval, steepness: Interval, a: &Self) -> Self {
        let known = value != Interval::EVERYTHING;
        let steepness = if known { steepness } else { Interval::EVERYTHING };
        let mut slopes = a.slopes;
        for slope in &mut slopes {
            *slope = times(steepness, *slope);
        }
        Self { value, slopes }
    }

    /// Chain rule for two arguments, each with its own steepness.
    #[inline]
    pub(super) fn follow_both(
        value: Interval,
        (first, a): (Interval, &Self),
        (second, b): (Interval, &Self),
    ) -> Self {
        let known = value != Interval::EVERYTHING;
        let steepness = |s: Interval| if known { s } else { Interval::EVERYTHING };
        let (first, second) = (steepness(first), steepness(second));
        let mut slopes = a.slopes;
        for (slope, other) in slopes.iter_mut().zip(&b.slopes) {
            *slope = plus(times(first, *slope), times(second, *other));
        }
        Self { value, slopes }
    }

    /// Chain rule for a function of a point, with its steepness along each axis.
    #[inline]
    pub fn follow_point(value: Interval, steepness: [Interval; 3], point: &[Self; 3]) -> Self {
        let known = value != Interval::EVERYTHING;
        let mut slopes = [LEVEL; N];
        for (coordinate, steepness) in point.iter().zip(steepness) {
            let steepness = if known { steepness } else { Interval::EVERYTHING };
            for (slope, step) in slopes.iter_mut().zip(&coordinate.slopes) {
                *slope = plus(*slope, times(steepness, *step));
            }
        }
        Self { value, slopes }
    }

    /// Returns the ranges of the slopes of either.
    pub fn hull(&self, other: &Self) -> [Interval; N] {
        std::array::from_fn(|at| self.slopes[at].hull(other.slopes[at]))
    }

    /// Returns whether it is constant along every direction.
    pub fn is_level(&self) -> bool {
        self.slopes.iter().all(|slope| *slope == LEVEL)
    }

    /// Returns a value whose slopes are unknown, unless it is constant (`level`).
    pub fn anyhow(value: Interval, level: bool) -> Self {
        let slope = if level { LEVEL } else { Interval::EVERYTHING };
        Self { value, slopes: [slope; N] }
    }
}

/// Derivative of an operation over an interval; its values there are `value`.
fn steepness(operation: Unary, a: Interval, value: Interval) -> Interval {
    let two = Interval::point(2.0);
    match operation {
        Unary::Negate => -ONE,
        Unary::Not | Unary::Floor | Unary::Ceil | Unary::Int => of_steps(value),
        Unary::Abs => Interval {
            low: if a.low >= 0.0 { 1.0 } else { -1.0 },
            high: if a.high <= 0.0 { -1.0 } else { 1.0 },
        },
        Unary::Square => two * a,
        Unary::Sqrt if value.low > 0.0 => Interval::point(0.5) / value,
        // At 0 it has no greatest slope.
        Unary::Sqrt => {
            let least = (0.5 / value.high).next_down().max(0.0);
            Interval { low: if least.is_nan() { 0.0 } else { least }, high: f64::INFINITY }
        }
        Unary::Exp => value,
        Unary::Ln => ONE / a,
        Unary::Log => {
            ONE / (a * Interval::point(10.0).monotone_within(
                1.0,
                11.0,
                crate::math::elementary::log,
            ))
        }
        Unary::Sin => Interval::cos(a),
        Unary::Cos => -Interval::sin(a),
        Unary::Tan | Unary::Tanh if value == Interval::EVERYTHING => value,
        Unary::Tan => ONE + value.square(),
        Unary::Asin => ONE / (ONE - a.square()).sqrt(),
        Unary::Acos => -(ONE / (ONE - a.square()).sqrt()),
        Unary::Atan => ONE / (ONE + a.square()),
        Unary::Sinh => Interval::cosh(a),
        Unary::Cosh => Unary::Sinh.bounds(a),
        Unary::Tanh => ONE - value.square(),
        Unary::Asinh => ONE / (ONE + a.square()).sqrt(),
        Unary::Acosh => ONE / (a.square() - ONE).sqrt(),
        Unary::Atanh => ONE / (ONE - a.square()),
    }
}

impl<const N: usize> Number for Sloped<N> {
    fn constant(value: f64) -> Self {
        // What is no number may stand for what is not known.
        Self::anyhow(Interval::point(value), !value.is_nan())
    }

    #[inline]
    fn unary(operation: Unary, a: Self) -> Self {
        let value = operation.bounds(a.value);
        if a.is_level() {
            return Self { value, slopes: [LEVEL; N] };
        }
        Self::follow(value, steepness(operation, a.value, value), &a)
    }

    #[inline]
    fn binary(operation: Binary, a: Self, b: Self) -> Self {
        let value = operation.bounds(a.value, b.value);
        if a.is_level() && b.is_level() {
            return Self { value, slopes: [LEVEL; N] };
        }
        let both = |first, second| Self::follow_both(value, (first, &a), (second, &b));
        match operation {
            Binary::Add => both(ONE, ONE),
            Binary::Subtract => both(ONE, -ONE),
            Binary::Multiply if b.is_level() => Self::follow(value, b.value, &a),
            Binary::Multiply => both(b.value, a.value),
            Binary::Divide => both(ONE / b.value, -(value / b.value)),
            Binary::Less
            | Binary::LessOrEqual
            | Binary::Equal
            | Binary::NotEqual
            | Binary::And
            | Binary::Or => Self { value, slopes: [of_steps(value); N] },
            Binary::Min | Binary::Max if value == Interval::EVERYTHING => {
                Self::anyhow(value, false)
            }
            Binary::Min if a.value.high < b.value.low => a,
            Binary::Min if b.value.high < a.value.low => b,
            Binary::Max if a.value.low > b.value.high => a,
            Binary::Max if b.value.low > a.value.high => b,
            Binary::Min | Binary::Max => Self { value, slopes: a.hull(&b) },
            Binary::Mod if b.is_level() && is_one_period(a.value, b.value) => {
                Self { value, slopes: a.slopes }
            }
            Binary::Mod => Self::anyhow(value, false),
            Binary::Pow if b.value.single().is_some() && b.is_level() => {
                Self::follow(value, steepness_of_power(a.value, b.value), &a)
            }
            Binary::Pow => both(b.value * (value / a.value), value * Unary::Ln.bounds(a.value)),
            // Across the cut it jumps.
            Binary::Atan2 if b.value.low <= 0.0 && a.value.contains(0.0) => {
                Self::anyhow(value, false)
            }
            Binary::Atan2 => {
                let square = a.value.square() + b.value.square();
                both(b.value / square, -(a.value / square))
            }
        }
    }

    fn choose(condition: Self, then: Self, otherwise: Self) -> Self {
        match condition.value.single() {
            Some(0.0) => otherwise,
            _ if !condition.value.contains(0.0) => then,
            _ => Self::anyhow(
                then.value.hull(otherwise.value),
                condition.is_level() && then.is_level() && otherwise.is_level(),
            ),
        }
    }

    fn ask(outside: &impl Outside, id: OutsideId, arguments: &[Self]) -> Self {
        outside.sloped(id, arguments)
    }

    fn turn(counter: Self, last: Self) -> Turn<Self> {
        match Interval::turn(counter.value, last.value) {
            Turn::Again(counts) => Turn::Again(Self { value: counts, slopes: [LEVEL; N] }),
            Turn::Done => Turn::Done,
            Turn::Unknown => Turn::Unknown,
        }
    }
}

/// Range of n·aⁿ⁻¹; n is a single number, but n − 1 is an interval if it is not exact.
fn steepness_of_power(a: Interval, n: Interval) -> Interval {
    let less = n - ONE;
    let less = match n.single().map(|n| n - 1.0) {
        Some(whole) if whole.fract() == 0.0 && whole.abs() < 1e15 => Interval::point(whole),
        _ => less,
    };
    n * a.pow(less)
}

/// Whether the remainder of an entire interval is the interval less a constant.
fn is_one_period(a: Interval, by: Interval) -> bool {
    let Some(by) = by.single().map(f64::abs).filter(|by| *by > 0.0 && by.is_finite()) else {
        return false;
    };
    let turn = |value: f64| value.trunc();
    let (low, high) = (a.low / by, a.high / by);
    let first = turn(low.next_down());
    first.abs() < 1e15 && [low.next_up(), high.next_down(), high.next_up()].map(turn) == [first; 3]
}
