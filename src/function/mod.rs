//! Functions of numbers: flat tapes of operations, built once, evaluated for points, batches and intervals.
//!
//! **In:** calls to [`Builder`], one for each operation, operands first. **Out:** a [`Function`]; its [`Run`]
//! over `f64`, [`Batch`] or `Interval` does not allocate per point. **Invariant:** all three agree: a batch
//! yields the same bits as its points, and a value that is a number lies within the bounds of any box around
//! its point. A tape contains no operation that does not affect its result, no duplicate operation, and no
//! operation inside a loop whose counter it does not need.
//!
//! Everything that is not arithmetic (noise, a pattern, another object of the scene) is external: the tape
//! refers to it by a number, and the caller supplies an [`Outside`] that evaluates it.

mod build;
mod closed;
mod domain;
mod noise;
mod number;
mod operation;
mod rounded;
mod slope;
mod tape;

use crate::math::interval::Interval;

pub use build::{Builder, DEEPEST_LOOP, Loop, MOST_ARGUMENTS, MOST_OPERATIONS, Node, TooLong};
pub use closed::{Ask, Closed};
pub use noise::NoiseFunction;
pub use number::{Batch, LANES, Number};
pub use operation::{Binary, Unary};
pub use rounded::Rounded;
pub use slope::Sloped;
pub use tape::{Function, Run};

/// Identifies something external that a function calls; its owner knows what the number refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct OutsideId(pub u32);

/// External functions that are not arithmetic.
pub trait Outside {
    /// Returns the value for the arguments, as many as the function was built with.
    fn value(&self, id: OutsideId, arguments: &[f64]) -> f64;

    /// Returns an interval that contains the value for all arguments in these intervals.
    fn bounds(&self, _: OutsideId, _: &[Interval]) -> Interval {
        Interval::EVERYTHING
    }

    /// Returns the bounds with bounds on the slopes along some directions, given those of the arguments.
    fn sloped<const N: usize>(&self, id: OutsideId, arguments: &[Sloped<N>]) -> Sloped<N> {
        let mut values = [Interval::point(0.0); MOST_ARGUMENTS];
        for (value, argument) in values.iter_mut().zip(arguments) {
            *value = argument.value;
        }
        let value = self.bounds(id, &values[..arguments.len().min(MOST_ARGUMENTS)]);
        Sloped::anyhow(value, arguments.iter().all(Sloped::is_level))
    }

    /// Returns the bounds with the error of a number computed for the arguments, given those of the arguments.
    fn rounded(&self, id: OutsideId, arguments: &[Rounded]) -> Rounded {
        let mut values = [Interval::point(0.0); MOST_ARGUMENTS];
        for (value, argument) in values.iter_mut().zip(arguments) {
            *value = argument.value;
        }
        Rounded::anyhow(self.bounds(id, &values[..arguments.len().min(MOST_ARGUMENTS)]))
    }
}

/// No external functions, for functions that are arithmetic throughout.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nothing;

impl Outside for Nothing {
    fn value(&self, _: OutsideId, _: &[f64]) -> f64 {
        f64::NAN
    }
}

#[cfg(test)]
mod tests;
