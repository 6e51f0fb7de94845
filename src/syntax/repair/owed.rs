//! Closers that were added although their own may still come, and those of another statement.

use super::{Open, Repair};
use crate::syntax::balance::{Opener, ends_line};
use crate::syntax::token::{Bracket, Mark, TokenKind};

impl Repair<'_> {
    pub(super) fn owe(&mut self, bracket: Bracket, at: usize) {
        self.owed[bracket as usize] += 1;
        self.owed_since[bracket as usize] = at;
    }

    /// Whether the closer at `at` is the one that was added: none but a `}` comes in another statement.
    pub(super) fn is_owed(&self, bracket: Bracket, at: usize) -> bool {
        let index = bracket as usize;
        let [from, to] = [self.owed_since[index], at].map(|at| self.tokens[at].start as usize);
        let between = self.text.get(from..to).unwrap_or("");
        self.owed[index] > 0 && (bracket == Bracket::Brace || !between.contains(';'))
    }

    /// Whether the `(` or `[` on top ended with its statement: what closes it now is another's.
    pub(super) fn is_of_another(&self, top: &Open) -> bool {
        top.opener != Opener::Bracket(Bracket::Brace)
            && top.outside.is_some_and(|outside| {
                let inside = &self.tokens[top.token..outside.token];
                self.tokens[outside.token].kind == TokenKind::Mark(Mark::Semicolon)
                    && !inside.iter().any(|one| matches!(one.kind, TokenKind::Directive(_)))
                    && ends_line(self.tokens, outside.token, self.text)
            })
    }
}
