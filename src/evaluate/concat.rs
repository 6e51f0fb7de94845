//! Strings joined with `+`, as in other languages: `"frame " + N + ".png"`.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{BinaryOperator, ExpressionId, ExpressionKind};

use super::value::Value;
use super::{Evaluator, Here};

impl Evaluator<'_> {
    /// Reports the sum at `sum`, one of whose `operands` is a string, and suggests one `concat` of everything
    /// that is added.
    pub(super) fn joined_strings(
        &self,
        here: &Here,
        sum: Span,
        operands: [Span; 2],
    ) -> Option<Diagnostic> {
        let between = Span { start: operands[0].end, end: operands[1].start, ..sum };
        let sign = between.start + self.sources.text(between).find('+')? as u32;
        let sign = Span { start: sign, end: sign + 1, ..sum };
        let ast = &here.unit.ast;
        let adds = |id: ExpressionId| match ast.expression(id).kind {
            ExpressionKind::Binary(BinaryOperator::Add, left, right) => Some((left, right)),
            _ => None,
        };
        // The whole sum, including the operators that follow.
        let whole = (0..ast.expressions.len() as u32)
            .map(ExpressionId)
            .filter(|id| adds(*id).is_some() && ast.expression(*id).span.start == sum.start)
            .max_by_key(|id| ast.expression(*id).span.end)?;
        let mut parts = Vec::new();
        let mut rest = whole;
        while let Some((left, right)) = adds(rest) {
            parts.push(right);
            rest = left;
        }
        parts.push(rest);
        let joined: Vec<String> =
            parts.into_iter().rev().map(|part| self.as_string(here, part)).collect();
        let joined = format!("concat({})", joined.join(", "));
        let message = "`+` works on numbers, vectors and colours, not on a string";
        Some(
            Diagnostic::new(Code::WrongType, message)
                .at(sign, "strings are not added")
                .help("strings are joined by `concat(a, b)`")
                .help(format!("write `{joined}`"))
                .fix(ast.expression(whole).span, joined),
        )
    }

    /// Returns an operand as an argument of `concat`: a number needs a `str`.
    fn as_string(&self, here: &Here, part: ExpressionId) -> String {
        let expression = here.unit.expression(part);
        let text = self.sources.text(expression.span);
        let number = match expression.kind {
            ExpressionKind::Number(_) => true,
            ExpressionKind::Name(name) => {
                matches!(self.scopes.look(here.symbol(name)), Some(Value::Number(_)))
            }
            _ => false,
        };
        if number { format!("str({text}, 0, -1)") } else { text.to_owned() }
    }
}
