//! Reads a vector of literals, such as `<1, -2.5, 0>`, in one step: most of a large text is these.

use super::ast::{Argument, ExpressionKind, UnaryOperator};
use super::compact::is_triple;
use super::nest::Nest;
use super::token::{Mark, Token, TokenKind};
use crate::source::Span;
use crate::vocabulary::Dialect;

/// Returns the number of tokens of the vector at the start, from its `<` to its `>`, if there is one, of only
/// literals with their signs.
pub(super) fn literal_vector(tokens: &[Token]) -> Option<usize> {
    let kind = |at: usize| tokens.get(at).map(|token| token.kind);
    let mark = |at: usize, mark: Mark| kind(at) == Some(TokenKind::Mark(mark));
    let mut at = 0;
    while mark(at, if at == 0 { Mark::Less } else { Mark::Comma }) {
        at += if mark(at + 1, Mark::Minus) || mark(at + 1, Mark::Plus) { 2 } else { 1 };
        if kind(at) != Some(TokenKind::Number) {
            return None;
        }
        at += 1;
    }
    (at > 0 && mark(at, Mark::Greater)).then_some(at + 1)
}

impl Nest<'_> {
    /// Adds the vector of literals that opens at the token reached, and goes to its `>`. Returns `false`, with
    /// nothing added, if it is none.
    pub(super) fn add_literal_vector(&mut self, open: Span) -> bool {
        let tokens = &self.tokens[self.at..];
        // It may be in a run of vectors, which is one token.
        let is_reached = tokens.first().is_some_and(|token| token.start == open.start);
        let Some(length) = literal_vector(tokens).filter(|_| is_reached && !self.ends_early) else {
            return false;
        };
        let whole = Span { end: self.span(tokens[length - 1]).end, ..open };
        if is_triple(&tokens[..length], self.text) && self.add_triple(whole) {
            self.at += length - 1;
            return true;
        }
        let (expressions, arguments) = (self.ast.expressions.len(), self.arguments.len());
        let mut sign = None;
        for &token in &tokens[1..length - 1] {
            let span = self.span(token);
            match token.kind {
                TokenKind::Mark(Mark::Plus) => sign = Some((UnaryOperator::Plus, span)),
                TokenKind::Mark(Mark::Minus) => sign = Some((UnaryOperator::Minus, span)),
                TokenKind::Mark(_) => {}
                _ => {
                    let number = self.slice(span).parse().unwrap_or(f64::NAN);
                    // A number that is too large is reported on use, if a `.pov` uses it.
                    if !number.is_finite() && (number.is_nan() || self.dialect != Dialect::Pov) {
                        self.ast.expressions.truncate(expressions);
                        self.arguments.truncate(arguments);
                        return false;
                    }
                    let mut id = self.add(ExpressionKind::Number(number), span);
                    if let Some((operator, start)) = sign.take() {
                        id = self.add(ExpressionKind::Unary(operator, id), start.to(span));
                    }
                    self.arguments.push(Argument::Expression(id));
                }
            }
        }
        let close = self.span(tokens[length - 1]);
        let components = self.take_arguments(arguments);
        self.operand(ExpressionKind::Vector(components), open.to(close), false);
        self.at += length - 1;
        true
    }
}
