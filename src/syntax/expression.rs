//! Builds expressions by precedence climbing on explicit stacks.
//!
//! **In:** operands and operators in written order, for the innermost open bracket. **Out:** nodes in
//! [`Ast::expressions`](super::ast::Ast), children first. **Source:** POV-Ray 3.7 manual, section 3.3.1.5.3
//! "Operators"; that `&` and `|` have equal precedence, and that `?:` is right-associative, was measured.

use super::ast::{BinaryOperator, Expression, ExpressionId, ExpressionKind, Rank, UnaryOperator};
use super::token::Mark;
use crate::source::Span;

/// Operands and operators of all unfinished expressions; each bracket uses the part above its own base.
#[derive(Default)]
pub(super) struct Stacks {
    pub operands: Vec<ExpressionId>,
    pub operators: Vec<Operator>,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Operator {
    pub kind: OperatorKind,
    pub span: Span,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OperatorKind {
    Unary(UnaryOperator),
    Binary(BinaryOperator),
    /// `?`, with its `:` not yet reached.
    Question,
    /// `? … :`, with its last operand not yet reached.
    Conditional,
}

impl OperatorKind {
    fn rank(self) -> Rank {
        match self {
            OperatorKind::Unary(_) => Rank::Unary,
            OperatorKind::Binary(operator) => operator.rank(),
            OperatorKind::Question | OperatorKind::Conditional => Rank::Conditional,
        }
    }
}

/// Returns the binary operator of a mark, and whether a sum may contain it.
pub(super) fn binary(mark: Mark) -> Option<(BinaryOperator, bool)> {
    use BinaryOperator as B;
    Some(match mark {
        Mark::Plus => (B::Add, true),
        Mark::Minus => (B::Subtract, true),
        Mark::Star => (B::Multiply, true),
        Mark::Slash => (B::Divide, true),
        Mark::Less => (B::Less, false),
        Mark::LessOrEqual => (B::LessOrEqual, false),
        Mark::Equal => (B::Equal, false),
        Mark::NotEqual => (B::NotEqual, false),
        Mark::GreaterOrEqual => (B::GreaterOrEqual, false),
        Mark::Greater => (B::Greater, false),
        Mark::And => (B::And, false),
        Mark::Or => (B::Or, false),
        Mark::Open(_)
        | Mark::Close(_)
        | Mark::Comma
        | Mark::Semicolon
        | Mark::Dot
        | Mark::Not
        | Mark::Question
        | Mark::Colon => return None,
    })
}

impl Stacks {
    /// Adds an operator after an operand: first, all operators before it that bind at least as tightly are
    /// reduced to one operand.
    pub fn operator(&mut self, base: usize, arena: &mut Vec<Expression>, operator: Operator) {
        let rank = operator.kind.rank();
        while let Some(top) = self.operators[base..].last() {
            // `a ? b : c ? d : e` is `a ? b : (c ? d : e)`.
            let before = top.kind.rank() > rank
                || (top.kind.rank() == rank && rank != Rank::Conditional && rank != Rank::Unary);
            if !before {
                break;
            }
            self.reduce(arena);
        }
        self.operators.push(operator);
    }

    /// Adds a `:`. Returns `false` if no `?` waits for it.
    pub fn colon(&mut self, base: usize, arena: &mut Vec<Expression>) -> bool {
        let waits = |operator: &Operator| operator.kind == OperatorKind::Question;
        let Some(question) = self.operators[base..].iter().rposition(waits) else {
            return false;
        };
        while self.operators.len() > base + question + 1 {
            self.reduce(arena);
        }
        self.operators[base + question].kind = OperatorKind::Conditional;
        true
    }

    /// Returns the `?` above `base` that still waits for its `:`.
    pub fn open_question(&self, base: usize) -> Option<Span> {
        let waits = |operator: &&Operator| operator.kind == OperatorKind::Question;
        self.operators[base..].iter().rfind(waits).map(|operator| operator.span)
    }

    /// Reduces everything above `base` to one node and removes it. `None` if there is nothing.
    pub fn finish(&mut self, base: usize, arena: &mut Vec<Expression>) -> Option<ExpressionId> {
        while self.operators.len() > base {
            self.reduce(arena);
        }
        self.operands.pop()
    }

    /// Applies the last operator to the last operands.
    fn reduce(&mut self, arena: &mut Vec<Expression>) {
        let Some(operator) = self.operators.pop() else { return };
        let span = |id: ExpressionId| arena[id.0 as usize].span;
        let Some(last) = self.operands.pop() else { return };
        let node = match operator.kind {
            OperatorKind::Unary(unary) => Expression {
                kind: ExpressionKind::Unary(unary, last),
                span: operator.span.to(span(last)),
            },
            OperatorKind::Binary(binary) => {
                let Some(first) = self.operands.pop() else { return };
                Expression {
                    kind: ExpressionKind::Binary(binary, first, last),
                    span: span(first).to(span(last)),
                }
            }
            OperatorKind::Conditional | OperatorKind::Question => {
                let Some(second) = self.operands.pop() else { return };
                let Some(first) = self.operands.pop() else { return };
                Expression {
                    kind: ExpressionKind::Conditional(first, second, last),
                    span: span(first).to(span(last)),
                }
            }
        };
        arena.push(node);
        self.operands.push(ExpressionId(arena.len() as u32 - 1));
    }
}
