//! Pairs brackets inside vectors, using the angle brackets to find their ends.

use super::{LONGEST_VECTOR, Open, Repair};
use crate::syntax::balance::Opener;
use crate::syntax::token::{Bracket, Mark, TokenKind};
use crate::vocabulary::{Role, Word};

/// The most tokens of a vector with formulas that are searched.
const LONGEST_FORMULA: usize = 64;

impl Repair<'_> {
    /// Returns the `<` of a vector of plain values that reaches up to token `at`.
    pub(super) fn vector_before(&self, at: usize) -> Option<usize> {
        let before = self.tokens[..at].iter().rev().take(LONGEST_VECTOR);
        let values = before.take_while(|token| match token.kind {
            TokenKind::Number | TokenKind::Name | TokenKind::Word(Word::Pi) => true,
            TokenKind::Mark(mark) => {
                matches!(mark, Mark::Comma | Mark::Dot | Mark::Minus | Mark::Star | Mark::Slash)
            }
            _ => false,
        });
        let open = at.checked_sub(values.count() + 1)?;
        let opens = self.tokens[open].kind == TokenKind::Mark(Mark::Less);
        (opens && open + 1 < at).then_some(open)
    }

    /// Returns the position for the closer of a parenthesis within a vector: `<0, sin(A>;` ends before the
    /// vector does, and a parenthesis of a single value before a comma. Returns `place` for every other
    /// closer.
    pub(super) fn before_angle(&self, open: &Open, place: usize) -> usize {
        if open.opener != Opener::Bracket(Bracket::Round) || !self.is_within_angle(open.token) {
            return place;
        }
        let single = match open.token.checked_sub(1).map(|before| self.tokens[before].kind) {
            Some(TokenKind::Word(word)) => {
                matches!(word.role(), Role::Function { one_argument: true })
            }
            Some(TokenKind::Name) => false,
            _ => true,
        };
        let (mut parentheses, mut vectors) = (0, 0);
        let inner = self.tokens[open.token + 1..place].iter().take(LONGEST_FORMULA);
        for (at, token) in (open.token + 1..).zip(inner) {
            match token.kind {
                TokenKind::Mark(Mark::Open(Bracket::Round)) => parentheses += 1,
                TokenKind::Mark(Mark::Close(Bracket::Round)) => parentheses -= 1,
                TokenKind::Mark(Mark::Less) => vectors += 1,
                TokenKind::Mark(Mark::Comma) if single && parentheses == 0 && vectors == 0 => {
                    return at;
                }
                TokenKind::Mark(Mark::Greater) if parentheses == 0 && vectors > 0 => vectors -= 1,
                TokenKind::Mark(Mark::Greater) if parentheses == 0 && !self.compares_at(at) => {
                    return at;
                }
                _ => {}
            }
        }
        place
    }

    /// Returns whether a value follows the `>`, which is then a comparison and not the end of a vector.
    fn compares_at(&self, angle: usize) -> bool {
        match self.tokens.get(angle + 1).map(|token| token.kind) {
            Some(TokenKind::Number | TokenKind::Name | TokenKind::String) => true,
            Some(TokenKind::Word(word)) => word.role() != Role::Statement,
            Some(TokenKind::Mark(mark)) => {
                matches!(mark, Mark::Minus | Mark::Less | Mark::Not | Mark::Open(Bracket::Round))
            }
            _ => false,
        }
    }

    /// Returns whether a `<` before this token is still open.
    fn is_within_angle(&self, at: usize) -> bool {
        let mut vectors = 0;
        let before = self.tokens[..at].iter().rev().take(LONGEST_FORMULA);
        before.take_while(|token| !matches!(token.kind, TokenKind::Mark(Mark::Semicolon))).any(
            |token| {
                vectors += match token.kind {
                    TokenKind::Mark(Mark::Less) => 1,
                    TokenKind::Mark(Mark::Greater) => -1,
                    _ => 0,
                };
                vectors > 0
            },
        )
    }
}
