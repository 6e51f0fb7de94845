//! A calculation that goes on behind a directive: `(0 #for (I, 1, 3) + I*I #end)`, `function { x #if (A) * 2 #end }`.
//!
//! **Invariant:** as in POV-Ray, which reads the words that a directive leaves as if they stood there; but what
//! would take only the last operand of what stands before (`1 + 2 #if (A) * 3 #end`) is told, and not read.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{
    BinaryOperator, ExpressionId, ExpressionKind, ItemKind, Items, Rank, UnaryOperator,
};

use super::formula::{Formula, operation_of};
use super::stream::TokenKind;
use super::value::{self, Value};
use super::{Evaluator, Here, Outcome, Reported};
use crate::function::Node;

/// How what goes on begins.
struct Joint {
    operator: BinaryOperator,
    /// A sign, which is an operand's, too; else what stands before is missing.
    is_sign: bool,
}

/// Whether an expression goes on with what stands before it.
fn joint(here: &Here, id: ExpressionId) -> Option<Joint> {
    let (mut first, mut operator) = (id, None);
    while let ExpressionKind::Binary(operation, left, _) = here.unit.expression(first).kind {
        (first, operator) = (left, Some(operation));
    }
    match here.unit.expression(first).kind {
        ExpressionKind::Joint => operator.map(|operator| Joint { operator, is_sign: false }),
        ExpressionKind::Unary(UnaryOperator::Plus, _) => {
            Some(Joint { operator: BinaryOperator::Add, is_sign: true })
        }
        ExpressionKind::Unary(UnaryOperator::Minus, _) => {
            Some(Joint { operator: BinaryOperator::Subtract, is_sign: true })
        }
        _ => None,
    }
}

/// How tightly all of an expression holds together.
fn rank(here: &Here, id: ExpressionId) -> Rank {
    match here.unit.expression(id).kind {
        ExpressionKind::Binary(operator, ..) => operator.rank(),
        ExpressionKind::Conditional(..) => Rank::Conditional,
        _ => Rank::Unary,
    }
}

pub(super) fn holds_directive(here: &Here, items: Items) -> bool {
    let items = here.unit.ast.items(items);
    items.iter().any(|item| matches!(item.kind, ItemKind::Directive(_)))
}

impl Evaluator<'_> {
    /// The value of the current items up to the next comma: one, or what several come to that go on with each
    /// other.
    pub(super) fn joined_value(&mut self, here: &Here, span: Span) -> Outcome<Value> {
        let first = match self.peek() {
            Some(token) => match token.kind {
                TokenKind::Expression(id) => Some((token.here.clone(), id)),
                _ => None,
            },
            None => None,
        };
        let mut value = self.value_or(here, span)?;
        let Some((first_here, id)) = first else { return Ok(value) };
        let mut before = rank(&first_here, id);
        while let Some((here, id, joint)) = self.next_joint() {
            before = self.fits(&here, id, &joint, before)?;
            value = match joint.is_sign {
                false => self.sum_with(&here, id, Ok(value))?,
                true => {
                    let more = self.expression(&here, id)?;
                    if let Some(poison) =
                        [&value, &more].into_iter().find(|v| matches!(v, Value::Poison(_)))
                    {
                        return Ok(poison.clone());
                    }
                    let sum = value::binary(BinaryOperator::Add, &value, &more, self.comparison());
                    let span = here.unit.expression(id).span;
                    sum.map_err(|_| self.wrong_type(&here, span, "a value to go on with", &more))?
                }
            };
        }
        Ok(value)
    }

    /// The same of a formula, whose first expression came to `node`.
    pub(super) fn joined_node(
        &mut self,
        here: &Here,
        formula: &mut Formula,
        first: ExpressionId,
        mut node: Node,
    ) -> Outcome<Node> {
        let mut before = rank(here, first);
        while let Some((here, id, joint)) = self.next_joint() {
            before = self.fits(&here, id, &joint, before)?;
            node = match joint.is_sign {
                false => {
                    formula.before = Some(node);
                    self.node(&here, formula, id)?
                }
                true => {
                    let more = self.node(&here, formula, id)?;
                    let (operation, left, right) = operation_of(BinaryOperator::Add, node, more);
                    let built = formula.builder.binary(operation, left, right);
                    self.built(&here, here.unit.expression(id).span, built)?
                }
            };
        }
        Ok(node)
    }

    /// An operator without what stands before it.
    pub(super) fn nothing_before(&mut self, here: &Here, before: Span) -> Reported {
        let span = Span { end: before.end + 1, ..before };
        let message = format!("expected a value before `{}`", self.sources.text(span));
        let diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
            .at(span, "this operator stands between two values");
        self.report(here, diagnostic)
    }

    fn next_joint(&mut self) -> Option<(Here, ExpressionId, Joint)> {
        let token = self.peek()?;
        let TokenKind::Expression(id) = token.kind else { return None };
        let here = token.here.clone();
        let joint = joint(&here, id)?;
        self.next();
        Some((here, id, joint))
    }

    /// How tightly what stands before and what goes on hold together; not, where an operator would take a part
    /// of the one alone.
    fn fits(
        &mut self,
        here: &Here,
        id: ExpressionId,
        joint: &Joint,
        before: Rank,
    ) -> Outcome<Rank> {
        let whole = rank(here, id);
        let taken = joint.operator.rank();
        if taken <= before && (!joint.is_sign || whole >= Rank::Sum) {
            return Ok(if joint.is_sign { Rank::Sum } else { whole });
        }
        let symbol = joint.operator.symbol();
        let message =
            format!("`{symbol}` behind a directive would take a part of what stands before it");
        let diagnostic = Diagnostic::new(Code::NotSupportedYet, message)
            .at(here.unit.expression(id).span, "this goes on behind a directive")
            .help("put what stands before the directive in parentheses, or name it by a `#local`");
        let _: Reported = self.report(here, diagnostic);
        Err(Reported)
    }
}
