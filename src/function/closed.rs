//! Closed functions: a function together with everything it calls, independent of its environment.

use super::domain::{Needed, needed};
use super::rounded::Rounded;
use super::slope::Sloped;
use super::tape::{Function, Step};
use super::{Outside, OutsideId};
use crate::math::interval::Interval;

/// Something that a function calls, in self-contained form.
pub trait Ask: Clone + PartialEq + std::fmt::Debug {
    fn value(&self, arguments: &[f64]) -> f64;

    /// Returns an interval that contains the value for all arguments in these intervals.
    fn bounds(&self, arguments: &[Interval]) -> Interval;

    /// Returns whether its slopes are known.
    fn has_slopes(&self) -> bool {
        true
    }

    /// Returns the bounds with bounds on the slopes, as [`Outside::sloped`] does.
    fn sloped<const N: usize>(&self, arguments: &[Sloped<N>]) -> Sloped<N> {
        let values: Vec<_> = arguments.iter().map(|argument| argument.value).collect();
        Sloped::anyhow(self.bounds(&values), arguments.iter().all(Sloped::is_level))
    }

    /// Returns the bounds with the error of a computed number, as [`Outside::rounded`] does.
    fn rounded(&self, arguments: &[Rounded]) -> Rounded {
        let values: Vec<_> = arguments.iter().map(|argument| argument.value).collect();
        Rounded::anyhow(self.bounds(&values))
    }
}

/// A function that contains everything it calls.
#[derive(Debug, Clone, PartialEq)]
pub struct Closed<A> {
    function: Function,
    asked: Vec<A>,
    needed: Vec<Needed>,
}

impl<A: Ask> Closed<A> {
    /// Returns the number of operations; those inside a loop count once.
    pub fn operations(&self) -> usize {
        self.function.operations()
    }

    /// Closes a function; `None` if `asked` does not know something that the function calls.
    pub fn new(
        mut function: Function,
        mut asked: impl FnMut(OutsideId) -> Option<A>,
    ) -> Option<Self> {
        let mut all: Vec<(OutsideId, A)> = Vec::new();
        for step in &mut function.steps {
            if let Step::Ask { id, .. } = step {
                let known = all.iter().position(|(other, _)| other == id);
                let place = match known {
                    Some(place) => place,
                    None => {
                        all.push((*id, asked(*id)?));
                        all.len() - 1
                    }
                };
                *id = OutsideId(place as u32);
            }
        }
        let needed = needed(&function);
        Some(Self { function, asked: all.into_iter().map(|(_, asked)| asked).collect(), needed })
    }

    /// Returns whether it is certainly NaN for all arguments in these intervals.
    pub fn is_undefined(&self, arguments: &[Interval]) -> bool {
        self.needed.iter().any(|needed| needed.is_missed(arguments, self))
    }

    /// Returns whether the slopes of all that it calls are known.
    pub fn has_slopes(&self) -> bool {
        self.asked.iter().all(Ask::has_slopes)
    }

    pub fn function(&self) -> &Function {
        &self.function
    }

    /// Returns the value for the arguments; missing ones are 0.
    pub fn at(&self, arguments: &[f64]) -> f64 {
        self.function.run().at(arguments, self)
    }
}

impl<A: Ask> Outside for Closed<A> {
    fn value(&self, id: OutsideId, arguments: &[f64]) -> f64 {
        self.asked.get(id.0 as usize).map_or(f64::NAN, |asked| asked.value(arguments))
    }

    fn bounds(&self, id: OutsideId, arguments: &[Interval]) -> Interval {
        let asked = self.asked.get(id.0 as usize);
        asked.map_or(Interval::EVERYTHING, |asked| asked.bounds(arguments))
    }

    fn sloped<const N: usize>(&self, id: OutsideId, arguments: &[Sloped<N>]) -> Sloped<N> {
        match self.asked.get(id.0 as usize) {
            Some(asked) => asked.sloped(arguments),
            None => Sloped::anyhow(Interval::EVERYTHING, false),
        }
    }

    fn rounded(&self, id: OutsideId, arguments: &[Rounded]) -> Rounded {
        match self.asked.get(id.0 as usize) {
            Some(asked) => asked.rounded(arguments),
            None => Rounded::anyhow(Interval::EVERYTHING),
        }
    }
}
