//! Fast path for expressions of plain numbers, without a [`Value`] for each operand: most of what loops
//! calculate.
//!
//! **Invariant:** an expression that does not qualify, or has no finite value, is left to `expression`, which
//! reports why.

use crate::math::Vector;
use crate::syntax::ast::{
    Argument, Arguments, Callee, ExpressionId, ExpressionKind, UnaryOperator,
};

use super::value::{self, Value};
use super::{Evaluator, Here, builtin};

/// Maximum depth of an expression of plain numbers.
const PLAIN_DEPTH: u32 = 8;

impl Evaluator<'_> {
    /// Returns the value of an expression that consists only of numbers, names of numbers and functions of
    /// one or two numbers: most of what loops calculate. Returns `None` for anything else, and if the value
    /// is not finite.
    #[inline(always)]
    pub(super) fn plain_number(&mut self, here: &Here, id: ExpressionId) -> Option<f64> {
        self.plain_operand(here, id, PLAIN_DEPTH)
    }

    #[inline(always)]
    fn plain_operand(&mut self, here: &Here, id: ExpressionId, depth: u32) -> Option<f64> {
        match here.unit.expression(id).kind {
            ExpressionKind::Number(number) => Some(number).filter(|number| number.is_finite()),
            ExpressionKind::Name(name) => self.scopes.read(here.symbol(name))?.as_number(),
            ExpressionKind::Group(_)
            | ExpressionKind::Unary(UnaryOperator::Minus, _)
            | ExpressionKind::Binary(..)
            | ExpressionKind::Call(Callee::Word(..), _)
                if depth > 0 =>
            {
                self.plain_result(here, id, depth - 1)
            }
            _ => None,
        }
    }

    fn plain_result(&mut self, here: &Here, id: ExpressionId, depth: u32) -> Option<f64> {
        match here.unit.expression(id).kind {
            ExpressionKind::Group(inner) => self.plain_operand(here, inner, depth),
            ExpressionKind::Unary(UnaryOperator::Minus, operand) => {
                self.plain_operand(here, operand, depth).map(|number| -number)
            }
            ExpressionKind::Binary(operator, left, right) => {
                let left = self.plain_operand(here, left, depth)?;
                let right = self.plain_operand(here, right, depth)?;
                value::numbers_meet(operator, left, right, self.comparison()).ok()
            }
            ExpressionKind::Call(Callee::Word(word, _), arguments) => {
                match *here.unit.ast.arguments(arguments) {
                    [Argument::Expression(id)] => {
                        let number = self.plain_operand(here, id, depth)?;
                        let value = builtin::number(word, [number])
                            .filter(|value| !self.is_cut_off(word, *value))?;
                        self.lint_trigonometry(here, word, id, number);
                        Some(value)
                    }
                    [Argument::Expression(a), Argument::Expression(b)] => {
                        let a = self.plain_operand(here, a, depth)?;
                        builtin::number(word, [a, self.plain_operand(here, b, depth)?])
                            .filter(|value| !self.is_cut_off(word, *value))
                    }
                    _ => None,
                }
            }
            _ => None,
        }
    }

    /// Returns the value of an expression that is a name of a vector of three, or is made of only two or
    /// three plain numbers.
    pub(super) fn plain_vector(&mut self, here: &Here, id: ExpressionId) -> Option<Vector> {
        match here.unit.expression(id).kind {
            ExpressionKind::Name(name) => match self.scopes.read(here.symbol(name))? {
                Value::Vector(components) => components.as_vector3(),
                _ => None,
            },
            ExpressionKind::Triple(triple) => {
                let [x, y, z] = here.unit.ast.triple(triple);
                Some(Vector::new(x, y, z))
            }
            ExpressionKind::Vector(components) => match *here.unit.ast.arguments(components) {
                [x, y] => {
                    let [x, y] = [self.plain_component(here, x)?, self.plain_component(here, y)?];
                    Some(Vector::new(x, y, 0.0))
                }
                _ => self.plain_triple(here, components),
            },
            _ => None,
        }
    }

    /// Returns a vector of three plain numbers.
    pub(super) fn plain_triple(&mut self, here: &Here, components: Arguments) -> Option<Vector> {
        let [x, y, z] = *here.unit.ast.arguments(components) else { return None };
        let mut plain = |argument| self.plain_component(here, argument);
        Some(Vector::new(plain(x)?, plain(y)?, plain(z)?))
    }

    fn plain_component(&mut self, here: &Here, argument: Argument) -> Option<f64> {
        match argument {
            Argument::Expression(id) => self.plain_number(here, id),
            Argument::Items(_) => None,
        }
    }
}
