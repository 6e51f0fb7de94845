//! Functions of numbers: a flat tape of operations, made once, run on points, batches and intervals.
//!
//! **In:** calls to [`Builder`], one for each operation, operands first.
//! **Out:** a [`Function`]; its [`Run`] over `f64`, [`Batch`] or
//! [`Interval`] allocates nothing for each point.
//! **Invariant:** all three say the same: a batch gives the bits of its points, and a value that is
//! a number lies within the bounds of any box around its point. A tape has no operation that does
//! not reach its result, none twice, and none inside a loop that does not need its counter.
//!
//! What is not arithmetic (noise, a pattern, another object of the scene) stands outside: the tape
//! names it by a number, and whoever runs it brings an [`Outside`] that answers.

mod build;
mod closed;
mod domain;
mod noise;
mod number;
mod operation;
mod slope;
mod tape;

use crate::math::interval::Interval;

pub use build::{Builder, DEEPEST_LOOP, Loop, MOST_ARGUMENTS, MOST_OPERATIONS, Node, TooLong};
pub use closed::{Asked, Closed};
pub use noise::NoiseFunction;
pub use number::{Batch, LANES, Number};
pub use operation::{Binary, Unary};
pub use slope::Sloped;
pub use tape::{Function, Run};

/// Which of the things that a function may ask is meant; its owner knows what the number says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct OutsideId(pub u32);

/// What a function asks that is no arithmetic.
pub trait Outside {
    /// Its value at some arguments, as many as the function was built with.
    fn value(&self, id: OutsideId, arguments: &[f64]) -> f64;

    /// An interval that holds its value wherever the arguments lie within theirs.
    fn bounds(&self, _: OutsideId, _: &[Interval]) -> Interval {
        Interval::EVERYTHING
    }

    /// The same, with bounds on its slopes along some ways, from those of the arguments.
    fn sloped<const N: usize>(&self, id: OutsideId, arguments: &[Sloped<N>]) -> Sloped<N> {
        let mut values = [Interval::point(0.0); MOST_ARGUMENTS];
        for (value, argument) in values.iter_mut().zip(arguments) {
            *value = argument.value;
        }
        let value = self.bounds(id, &values[..arguments.len().min(MOST_ARGUMENTS)]);
        Sloped::anyhow(value, arguments.iter().all(Sloped::is_level))
    }
}

/// Nothing stands outside: for functions that are arithmetic throughout.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nothing;

impl Outside for Nothing {
    fn value(&self, _: OutsideId, _: &[f64]) -> f64 {
        f64::NAN
    }
}

#[cfg(test)]
mod tests;
