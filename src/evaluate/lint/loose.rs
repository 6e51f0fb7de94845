//! Macro results of which an adjacent operator would take only a part: `2*Next(3)` where the macro leaves
//! `a+1`.
//!
//! POV-Ray substitutes the macro's text for the call, so this is `2*a + 1` there and in a `.pov`
//! (`continuation.rs`). In a `.scene` a call is one value, as if in parentheses.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{
    BinaryOperator, Callee, ExpressionId, ExpressionKind, ItemKind, Rank, UnaryOperator,
};

use crate::vocabulary::Dialect;

use super::super::scope::MacroId;
use super::super::value::Value;
use super::super::{Evaluator, Here};

/// The side of an operator on which a call is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::evaluate) enum Side {
    Left,
    Right,
}

impl Evaluator<'_> {
    /// Warns if `id`, an operand of `operator`, is a call of a macro that leaves an operation of its own.
    pub(in crate::evaluate) fn lint_loose_operand(
        &mut self,
        here: &Here,
        operator: BinaryOperator,
        side: Side,
        id: ExpressionId,
    ) {
        let Some((left, place)) = self.left_bare(here, id) else { return };
        let regroups = match left.rank() == operator.rank() {
            // a − (b + c) is not a − b + c; a + (b − c) is.
            true => {
                side == Side::Right
                    && matches!(operator, BinaryOperator::Subtract | BinaryOperator::Divide)
            }
            false => left.rank() < operator.rank(),
        };
        if regroups {
            self.tell_loose(here, operator.symbol(), id, place);
        }
    }

    /// As [`Self::lint_loose_operand`], for the operand of a sign.
    pub(in crate::evaluate) fn lint_loose_sign(
        &mut self,
        here: &Here,
        sign: UnaryOperator,
        id: ExpressionId,
    ) {
        let symbol = match sign {
            UnaryOperator::Plus => return,
            UnaryOperator::Minus => "-",
            UnaryOperator::Not => "!",
        };
        if let Some((left, place)) = self.left_bare(here, id)
            && (sign == UnaryOperator::Not || left.rank() == Rank::Sum)
        {
            self.tell_loose(here, symbol, id, place);
        }
    }

    /// Returns whether an operand is a macro that may leave an operation; warns if that is split.
    pub(in crate::evaluate) fn holds_bare_operation(
        &mut self,
        here: &Here,
        id: ExpressionId,
    ) -> bool {
        let (mut first, mut holds) = (id, false);
        while let ExpressionKind::Binary(operator, left, right) = here.unit.expression(first).kind {
            for (side, operand) in [(Side::Left, left), (Side::Right, right)] {
                if self.leaves_operation(here, operand).is_some() {
                    holds = true;
                    self.lint_loose_operand(here, operator, side, operand);
                }
            }
            // Recursion is as deep as there are ranks.
            holds |= self.holds_bare_operation(here, right);
            first = left;
        }
        holds
    }

    /// Returns the called macro if, in a `.pov`, it may leave more than one operand.
    pub(in crate::evaluate) fn leaves_operation(
        &self,
        here: &Here,
        id: ExpressionId,
    ) -> Option<MacroId> {
        let ExpressionKind::Call(Callee::Name(name, _), _) = here.unit.expression(id).kind else {
            return None;
        };
        let Some(Value::Macro(called)) = self.scopes.look(here.symbol(name)) else { return None };
        let (unit, body) = self.macros[called.0 as usize].parts()?;
        let leaves = match unit.ast.items(body).last()?.kind {
            ItemKind::Expression(left) => {
                matches!(unit.expression(left).kind, ExpressionKind::Binary(..))
            }
            // Items left by a branch.
            ItemKind::Directive(_) => true,
            _ => false,
        };
        (leaves && self.options.dialect == Dialect::Pov).then_some(*called)
    }

    /// Returns the operation that a called macro leaves without parentheses, and its span.
    fn left_bare(&self, here: &Here, id: ExpressionId) -> Option<(BinaryOperator, Span)> {
        let ExpressionKind::Call(Callee::Name(name, _), _) = here.unit.expression(id).kind else {
            return None;
        };
        let Some(Value::Macro(called)) = self.scopes.look(here.symbol(name)) else { return None };
        let (unit, body) = self.macros[called.0 as usize].parts()?;
        let last = unit.ast.items(body).last()?;
        let ItemKind::Expression(left) = last.kind else { return None };
        match unit.expression(left).kind {
            ExpressionKind::Binary(operator, ..) => Some((operator, last.span)),
            _ => None,
        }
    }

    fn tell_loose(&mut self, here: &Here, symbol: &str, call: ExpressionId, left: Span) {
        let call = here.unit.expression(call).span;
        let text = self.sources.text(left).to_owned();
        let message = format!("`{symbol}` stands beside a macro that leaves an operation");
        let label = match self.options.dialect {
            Dialect::Scene => {
                format!("taken as one value, where POV-Ray puts the text `{text}` here")
            }
            Dialect::Pov => format!("the text `{text}` is read here, as in POV-Ray"),
        };
        let diagnostic = Diagnostic::new(Code::LooseOperation, message)
            .at(call, label)
            .also(left, "what the macro leaves")
            .help(format!("say which is meant: write `({text})` in the macro"))
            .fix(left, format!("({text})"));
        self.report(here, diagnostic);
    }
}
