//! Vectors around other brackets: where an angle tells where these end.

use super::{LONGEST_VECTOR, Open, Repair};
use crate::syntax::balance::Opener;
use crate::syntax::token::{Bracket, Mark, TokenKind};
use crate::vocabulary::Word;

/// How many tokens of a vector that holds formulas are looked at.
const LONGEST_FORMULA: usize = 64;

impl Repair<'_> {
    /// The `<` of a vector of plain values that reaches up to token `at`.
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

    /// `<0, sin(A>;`: a parenthesis within a vector ends before that does. `place` for every other closer.
    pub(super) fn before_angle(&self, open: &Open, place: usize) -> usize {
        let is = |at: usize, mark| {
            self.tokens.get(at).is_some_and(|token| token.kind == TokenKind::Mark(mark))
        };
        let closes = open.opener == Opener::Bracket(Bracket::Round)
            && place.checked_sub(1).is_some_and(|before| is(before, Mark::Greater));
        let mut vectors = 0;
        let opens = self.tokens[..open.token].iter().rev().take(LONGEST_FORMULA);
        let within = opens
            .take_while(|token| !matches!(token.kind, TokenKind::Mark(Mark::Semicolon)))
            .any(|token| {
                vectors += match token.kind {
                    TokenKind::Mark(Mark::Less) => 1,
                    TokenKind::Mark(Mark::Greater) => -1,
                    _ => 0,
                };
                vectors > 0
            });
        if closes && within { place - 1 } else { place }
    }
}
