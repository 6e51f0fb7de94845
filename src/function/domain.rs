//! Domain of a function: where it is certainly NaN because of a root, a logarithm or a similar operation.
//!
//! **In:** a function. **Out:** the operands that must be in range for its result to be a number.
//! **Invariant:** only operands that the result always depends on; those that a choice, a comparison, a
//! minimum or a maximum may discard are excluded.

use super::Outside;
use super::operation::{Binary, Unary};
use super::tape::{Function, Register, Step};
use crate::math::interval::Interval;

/// An operand, and the interval that it must be in.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Needed {
    operand: Function,
    within: Interval,
}

impl Needed {
    /// Returns whether the operand is certainly out of range for all arguments in these intervals.
    pub fn is_missed(&self, arguments: &[Interval], outside: &impl Outside) -> bool {
        let Interval { low, high } = self.operand.run().at(arguments, outside);
        high < self.within.low || self.within.high < low
    }
}

/// Returns all conditions for a function's result to be a number.
pub(super) fn needed(function: &Function) -> Vec<Needed> {
    let mut found = Vec::new();
    // Registers that the result is no number without.
    let mut strict: Vec<Register> = vec![function.result];
    for (at, step) in outermost(&function.steps).into_iter().rev() {
        let to = match *step {
            Step::Unary { to, .. } | Step::Binary { to, .. } => to,
            Step::Choose { to, .. } | Step::Ask { to, .. } => to,
            Step::Repeat(repeat) => repeat.to,
        };
        let Some(place) = strict.iter().position(|register| *register == to) else { continue };
        strict.swap_remove(place);
        let mut need = |operand: Register, within: Interval| {
            let steps = function.steps[..at].to_vec();
            let operand = Function { steps, result: operand, ..function.clone() };
            found.push(Needed { operand, within });
        };
        match *step {
            Step::Unary { operation, a, .. } => {
                if let Some(within) = domain(operation) {
                    need(a, within);
                }
                strict.extend((operation != Unary::Not).then_some(a));
            }
            Step::Binary { operation: Binary::Pow, a, b, .. } => {
                let first = function.parameters;
                let constant =
                    b.checked_sub(first).and_then(|b| function.constants.get(b as usize));
                // 1 to any power is 1, and any number to the power of 0.
                if constant.is_some_and(|exponent| exponent.is_finite() && exponent.fract() != 0.0)
                {
                    need(a, Interval { low: 0.0, high: f64::INFINITY });
                    strict.push(a);
                }
            }
            Step::Binary { operation, a, b, .. } => {
                let is_strict = matches!(
                    operation,
                    Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide
                );
                strict.extend([a, b].into_iter().filter(|_| is_strict));
            }
            Step::Choose { .. } | Step::Ask { .. } | Step::Repeat(_) => {}
        }
    }
    found
}

/// The steps outside of loops, each with its index.
fn outermost(steps: &[Step]) -> Vec<(usize, &Step)> {
    let (mut all, mut at) = (Vec::new(), 0);
    while let Some(step) = steps.get(at) {
        all.push((at, step));
        at += 1;
        if let Step::Repeat(repeat) = step {
            at += repeat.body as usize;
        }
    }
    all
}

/// The interval in which an operation yields a number; `None` if it does so everywhere.
fn domain(operation: Unary) -> Option<Interval> {
    match operation {
        Unary::Sqrt | Unary::Ln | Unary::Log => Some(Interval { low: 0.0, high: f64::INFINITY }),
        Unary::Asin | Unary::Acos | Unary::Atanh => Some(Interval { low: -1.0, high: 1.0 }),
        Unary::Acosh => Some(Interval { low: 1.0, high: f64::INFINITY }),
        Unary::Negate
        | Unary::Not
        | Unary::Abs
        | Unary::Floor
        | Unary::Ceil
        | Unary::Int
        | Unary::Square
        | Unary::Exp
        | Unary::Sin
        | Unary::Cos
        | Unary::Tan
        | Unary::Atan
        | Unary::Sinh
        | Unary::Cosh
        | Unary::Tanh
        | Unary::Asinh => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::function::{Ask, Builder, Closed, Node};

    /// What a function calls that calls nothing.
    #[derive(Debug, Clone, PartialEq)]
    enum Nothing {}

    impl Ask for Nothing {
        fn value(&self, _: &[f64]) -> f64 {
            match *self {}
        }

        fn bounds(&self, _: &[Interval]) -> Interval {
            match *self {}
        }
    }

    /// A function of x.
    fn closed(make: impl FnOnce(&mut Builder) -> Node) -> Closed<Nothing> {
        let mut builder = Builder::new(1).expect("few arguments");
        let result = make(&mut builder);
        Closed::new(builder.finish(result), |_| None).expect("nothing is asked")
    }

    #[test]
    fn where_a_function_is_said_to_be_no_number_it_is_none_and_beside_it_may_be_one() {
        let built = "few operations";
        let x = |builder: &Builder| builder.parameter(0).expect("x");
        let root = closed(|b| {
            let root = b.unary(Unary::Sqrt, x(b)).expect(built);
            b.binary(Binary::Add, root, x(b)).expect(built)
        });
        let arc = closed(|b| b.unary(Unary::Asin, x(b)).expect(built));
        let power = closed(|b| {
            let half = b.constant(0.5).expect(built);
            b.binary(Binary::Pow, x(b), half).expect(built)
        });
        // A minimum may pass over what is no number.
        let least = closed(|b| {
            let root = b.unary(Unary::Sqrt, x(b)).expect(built);
            b.binary(Binary::Min, root, x(b)).expect(built)
        });
        let over = |low, high| [Interval { low, high }];
        let cases = [(&root, 0.0), (&power, 0.0), (&arc, -1.0)];
        for (function, from) in cases {
            assert!(function.is_undefined(&over(from - 2.0, from - 0.1)));
            assert!(!function.is_undefined(&over(from - 2.0, from)));
            assert!(!function.is_undefined(&over(from, 1.0)));
            let value: f64 = function.function().run().at(&[from - 1.0], function);
            assert!(value.is_nan(), "{value}");
        }
        assert!(!least.is_undefined(&over(-2.0, -1.0)));
    }
}
