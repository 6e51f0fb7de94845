//! Number types that a tape can run on: single points, batches of points, or intervals.

use super::operation::{Binary, Unary};
use super::{Outside, OutsideId};
use crate::math::interval::Interval;

/// A number, or a value that represents several numbers at once.
pub trait Number: Copy {
    fn constant(value: f64) -> Self;
    fn unary(operation: Unary, a: Self) -> Self;
    fn binary(operation: Binary, a: Self, b: Self) -> Self;
    /// Returns `then` if the condition is not zero, else `otherwise`.
    fn choose(condition: Self, then: Self, otherwise: Self) -> Self;
    fn ask(outside: &impl Outside, id: OutsideId, arguments: &[Self]) -> Self;
    /// Decides what a loop does next at this counter.
    fn turn(counter: Self, last: Self) -> Turn<Self>;
}

/// What a loop does next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turn<N> {
    /// Another iteration, which counts if this condition is not zero.
    Again(N),
    Done,
    /// Whether the counter has passed the end is uncertain.
    Unknown,
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    #[inline]
    fn unary(operation: Unary, a: Self) -> Self {
        operation.of(a)
    }

    #[inline]
    fn binary(operation: Binary, a: Self, b: Self) -> Self {
        operation.of(a, b)
    }

    #[inline]
    fn choose(condition: Self, then: Self, otherwise: Self) -> Self {
        if condition != 0.0 { then } else { otherwise }
    }

    fn ask(outside: &impl Outside, id: OutsideId, arguments: &[Self]) -> Self {
        outside.value(id, arguments)
    }

    fn turn(counter: Self, last: Self) -> Turn<Self> {
        if counter <= last { Turn::Again(1.0) } else { Turn::Done }
    }
}

/// Number of points in a batch: two cache lines, four of the widest registers.
pub const LANES: usize = 16;

/// The numbers of [`LANES`] points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Batch(pub [f64; LANES]);

impl Batch {
    #[inline]
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }

    #[inline]
    fn pair(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut result = self;
        for (a, b) in result.0.iter_mut().zip(other.0) {
            *a = f(*a, b);
        }
        result
    }
}

impl Number for Batch {
    fn constant(value: f64) -> Self {
        Self([value; LANES])
    }

    /// Cheap operations have a loop of their own, which vectorises; for the others, selecting the operation
    /// per lane is affordable.
    #[inline]
    fn unary(operation: Unary, a: Self) -> Self {
        match operation {
            Unary::Negate => a.each(|a| Unary::Negate.of(a)),
            Unary::Abs => a.each(|a| Unary::Abs.of(a)),
            Unary::Square => a.each(|a| Unary::Square.of(a)),
            Unary::Sqrt => a.each(|a| Unary::Sqrt.of(a)),
            dear => a.each(|a| dear.of(a)),
        }
    }

    #[inline]
    fn binary(operation: Binary, a: Self, b: Self) -> Self {
        match operation {
            Binary::Add => a.pair(b, |a, b| Binary::Add.of(a, b)),
            Binary::Subtract => a.pair(b, |a, b| Binary::Subtract.of(a, b)),
            Binary::Multiply => a.pair(b, |a, b| Binary::Multiply.of(a, b)),
            Binary::Divide => a.pair(b, |a, b| Binary::Divide.of(a, b)),
            Binary::Min => a.pair(b, |a, b| Binary::Min.of(a, b)),
            Binary::Max => a.pair(b, |a, b| Binary::Max.of(a, b)),
            Binary::Less => a.pair(b, |a, b| Binary::Less.of(a, b)),
            dear => a.pair(b, |a, b| dear.of(a, b)),
        }
    }

    #[inline]
    fn choose(condition: Self, then: Self, otherwise: Self) -> Self {
        let mut result = otherwise;
        for lane in 0..LANES {
            result.0[lane] = f64::choose(condition.0[lane], then.0[lane], otherwise.0[lane]);
        }
        result
    }

    fn ask(outside: &impl Outside, id: OutsideId, arguments: &[Self]) -> Self {
        let mut result = Self::constant(0.0);
        let mut of_lane = [0.0; super::build::MOST_ARGUMENTS];
        for lane in 0..LANES {
            for (to, argument) in of_lane.iter_mut().zip(arguments) {
                *to = argument.0[lane];
            }
            result.0[lane] = outside.value(id, &of_lane[..arguments.len()]);
        }
        result
    }

    fn turn(counter: Self, last: Self) -> Turn<Self> {
        let again = Self::binary(Binary::LessOrEqual, counter, last);
        if again.0.contains(&1.0) { Turn::Again(again) } else { Turn::Done }
    }
}

impl Number for Interval {
    #[inline]
    fn constant(value: f64) -> Self {
        Self::point(value)
    }

    #[inline]
    fn unary(operation: Unary, a: Self) -> Self {
        operation.bounds(a)
    }

    #[inline]
    fn binary(operation: Binary, a: Self, b: Self) -> Self {
        operation.bounds(a, b)
    }

    fn choose(condition: Self, then: Self, otherwise: Self) -> Self {
        match condition.single() {
            Some(0.0) => otherwise,
            _ if !condition.contains(0.0) => then,
            _ => then.hull(otherwise),
        }
    }

    fn ask(outside: &impl Outside, id: OutsideId, arguments: &[Self]) -> Self {
        outside.bounds(id, arguments)
    }

    fn turn(counter: Self, last: Self) -> Turn<Self> {
        if counter.high <= last.low {
            Turn::Again(Self::point(1.0))
        } else if counter.low > last.high {
            Turn::Done
        } else {
            Turn::Unknown
        }
    }
}
