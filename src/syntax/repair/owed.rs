//! Handles closers that were already added before their own follows, and those of another statement or
//! directive.

use super::{Open, Repair};
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::balance::{Opener, ends_line};
use crate::syntax::token::{Bracket, Head, Mark, TokenKind};

impl Repair<'_> {
    pub(super) fn owe(&mut self, bracket: Bracket, at: usize) {
        self.owed[bracket as usize] += 1;
        self.owed_since[bracket as usize] = at;
    }

    /// Returns whether the closer at `at` is the one that was added: only a `}` may follow in another
    /// statement.
    pub(super) fn is_owed(&self, bracket: Bracket, at: usize) -> bool {
        let index = bracket as usize;
        let [from, to] = [self.owed_since[index], at].map(|at| self.tokens[at].start as usize);
        let between = self.text.get(from..to).unwrap_or("");
        self.owed[index] > 0 && (bracket == Bracket::Brace || !between.contains(';'))
    }

    /// `#macro M(A) … }`: reports a brace in place of the `#end` of a directive.
    pub(super) fn ends_directive(&mut self, bracket: Bracket, at: usize) -> bool {
        let Some(top) = self.open.last() else { return false };
        let (directive, place) = (top.token, self.layout.place(at));
        let is_meant = bracket == Bracket::Brace
            && self.surplus[Bracket::Brace as usize] < 0
            && top.opener == Opener::Directive
            && !self.ended.contains(&directive)
            && place.first
            && place.indent == top.indent;
        if !is_meant {
            return false;
        }
        self.surplus[Bracket::Brace as usize] += 1;
        self.dropped[at] = true;
        self.inserted.push((at, TokenKind::Directive(Head::End)));
        if let Some(top) = self.open.pop() {
            self.forget_outsides_since(&top);
        }
        let shown = self.shown(directive);
        let message = format!("the body of {shown} ends with `#end`, not with `}}`");
        let diagnostic = Diagnostic::new(Code::MissingEnd, message)
            .at(self.span(at), "expected `#end`")
            .also(self.span(directive), "it begins here")
            .help("replace it with `#end`")
            .fix(self.span(at), "#end");
        self.tell(diagnostic);
        true
    }

    /// Returns whether the `(` or `[` on top ended with its statement: the closer belongs to another.
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
