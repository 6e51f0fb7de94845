//! Constructs that POV-Ray 3.7 parses differently from how they look, in a `.pov` (both measured).
//!
//! * `scale V.x`: where a vector is expected, a number that begins with a component of `V` replaces x only; y
//!   and z remain those of `V`. In parentheses it is a number like any other.
//! * `sphere { P (R) }`: a name that holds a number, a vector or a colour, and another value in parentheses.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::syntax::ast::{
    Argument, Ast, BinaryOperator, Callee, ExpressionId, ExpressionKind, UnaryOperator,
};
use crate::vocabulary::Dialect;

use super::stream::{Token, TokenKind};
use super::value::Value;
use super::{Evaluator, Here, Outcome};

impl Evaluator<'_> {
    /// Returns the vector that a number beginning with a component denotes where a vector is expected; `None`
    /// for anything else.
    pub(super) fn vector_of_component(
        &mut self,
        here: &Here,
        id: ExpressionId,
    ) -> Option<Outcome<Vector>> {
        let (name, whole) = self.picked_from(here, id)?;
        let [_, y, z] = whole.to_array();
        let value = match self.expression(here, id) {
            Ok(value) => value,
            Err(reported) => return Some(Err(reported)),
        };
        let Value::Number(x) = value else { return value.as_vector3().map(Ok) };
        let vector = Vector::new(x, y, z);
        if vector != Vector::splat(x) {
            let span = here.unit.expression(id).span;
            let text = self.sources.text(span).to_owned();
            let message = format!("`{text}` is read as <{x}, {y}, {z}> where a vector is wanted");
            let diagnostic = Diagnostic::new(Code::LooseOperation, message)
                .at(span, format!("POV-Ray takes y and z from `{name}`"))
                .help(format!("in parentheses it is a number: `({text})`"));
            self.report(here, diagnostic);
        }
        Some(Ok(vector))
    }

    /// Returns the value of an argument, which may have to be a vector.
    pub(super) fn argument_of_call(
        &mut self,
        here: &Here,
        id: ExpressionId,
        wants_vector: bool,
    ) -> Outcome<Value> {
        match wants_vector.then(|| self.vector_of_component(here, id)).flatten() {
            Some(vector) => vector.map(Value::vector3),
            None => self.operand(here, id),
        }
    }

    /// Returns the text and value of the vector whose component an expression begins with.
    fn picked_from(&mut self, here: &Here, id: ExpressionId) -> Option<(String, Vector)> {
        if self.options.dialect == Dialect::Scene {
            return None;
        }
        let mut leftmost = id;
        let whole = loop {
            match here.unit.expression(leftmost).kind {
                ExpressionKind::Binary(
                    BinaryOperator::Add
                    | BinaryOperator::Subtract
                    | BinaryOperator::Multiply
                    | BinaryOperator::Divide,
                    left,
                    _,
                ) => leftmost = left,
                ExpressionKind::Unary(_, operand) => leftmost = operand,
                ExpressionKind::Component(of, _) => break of,
                _ => return None,
            }
        };
        let expression = here.unit.expression(whole);
        let value = match expression.kind {
            ExpressionKind::Name(name) => self.scopes.look(here.symbol(name))?.clone(),
            // A call may have other effects when it is evaluated again.
            ExpressionKind::Index(..) | ExpressionKind::Vector(_) | ExpressionKind::Triple(_)
                if is_without_calls(&here.unit.ast, whole) =>
            {
                self.expression(here, whole).ok()?
            }
            _ => return None,
        };
        let numbers = match value {
            Value::Color(color) => color.rgb.components().to_vec(),
            value => value.numbers()?.as_slice().to_vec(),
        };
        let part = |place: usize| numbers.get(place).copied().unwrap_or(0.0);
        let name = self.sources.text(expression.span).to_owned();
        Some((name, Vector::new(part(0), part(1), part(2))))
    }

    /// Returns the values of a call: two if [`Self::value_before_group`] finds two.
    pub(super) fn values_of_call(&mut self, here: &Here, id: ExpressionId) -> Outcome<Vec<Value>> {
        match self.value_before_group(here, id) {
            Some((Token { kind: TokenKind::Literal(value), .. }, group)) => {
                Ok(vec![*value, self.expression(here, group)?])
            }
            _ => Ok(vec![self.expression(here, id)?]),
        }
    }

    /// Returns two values for a call of a name that holds a value that cannot be called: that value and the
    /// one in parentheses after it.
    pub(super) fn value_before_group(
        &self,
        here: &Here,
        id: ExpressionId,
    ) -> Option<(Token, ExpressionId)> {
        if self.options.dialect == Dialect::Scene {
            return None;
        }
        // `box { -S (S) }`.
        let (call, sign) = match here.unit.expression(id).kind {
            ExpressionKind::Unary(UnaryOperator::Minus, call) => (call, -1.0),
            ExpressionKind::Unary(UnaryOperator::Plus, call) => (call, 1.0),
            _ => (id, 1.0),
        };
        let ExpressionKind::Call(Callee::Name(name, span), arguments) =
            here.unit.expression(call).kind
        else {
            return None;
        };
        let [Argument::Expression(group)] = *here.unit.ast.arguments(arguments) else {
            return None;
        };
        let value = self.scopes.look(here.symbol(name))?;
        let value = match value {
            Value::Number(number) => Value::Number(sign * number),
            Value::Vector(numbers) => Value::Vector(numbers.map(|number| sign * number)),
            Value::Color(_) if sign > 0.0 => value.clone(),
            _ => return None,
        };
        let kind = TokenKind::Literal(Box::new(value));
        Some((Token { kind, span, here: here.clone() }, group))
    }
}

/// Whether an expression consists of names, numbers and operators alone.
fn is_without_calls(ast: &Ast, id: ExpressionId) -> bool {
    let mut open = vec![id];
    while let Some(id) = open.pop() {
        match ast.expression(id).kind {
            ExpressionKind::Number(_)
            | ExpressionKind::Triple(_)
            | ExpressionKind::Name(_)
            | ExpressionKind::Word(_) => {}
            ExpressionKind::Unary(_, a)
            | ExpressionKind::Group(a)
            | ExpressionKind::Component(a, _) => open.push(a),
            ExpressionKind::Binary(_, a, b) | ExpressionKind::Index(a, b) => open.extend([a, b]),
            ExpressionKind::Vector(arguments) => {
                for argument in ast.arguments(arguments) {
                    let Argument::Expression(part) = *argument else { return false };
                    open.push(part);
                }
            }
            _ => return false,
        }
    }
    true
}
