//! Conditions as other languages write them: `#if A > 3`, `#if (A = 1) & (B = 2)`, `#if (A) then`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};

impl Reader<'_> {
    /// `#if A > 3`: a condition without its parentheses.
    pub(super) fn condition(&mut self, head: Head, meant: &mut Vec<Token>) -> bool {
        if self.is(1, Mark::Open(Bracket::Round)) {
            return self.condition_in_parts(head, meant);
        }
        let mut end = self.line_end(1);
        while end > 1 && (self.is(end - 1, Mark::Colon) || self.slice(end - 1) == "then") {
            end -= 1;
        }
        if end == 1 {
            return false;
        }
        let word = head.word();
        let what = match head {
            Head::Ifdef | Head::Ifndef => "name",
            Head::Switch | Head::Case => "value",
            _ => "condition",
        };
        let span = self.span(1, end - 1);
        let before = Span { end: span.start, ..span };
        let message = format!("`#{word}` takes its {what} in parentheses");
        let diagnostic = Diagnostic::new(Code::ExpectedExpression, message)
            .at(span, "expected `(` before this and `)` after it")
            .help(format!("write `#{word} ({})`", self.text.get(span.range()).unwrap_or("…")))
            .fix(before, "(");
        let mut diagnostic = diagnostic.fix(span.after(), ")");
        let after = self.line_end(end);
        if after > end {
            // `then`, `:`
            let rest = self.span(end, after - 1);
            diagnostic = diagnostic.fix(Span { start: span.end, ..rest }, "");
            let (second, third) = (diagnostic.fixes.len() - 2, diagnostic.fixes.len() - 1);
            diagnostic.fixes[third].text = ")".to_owned();
            diagnostic.fixes.remove(second);
        }
        self.diagnostics.push(diagnostic);
        let place = self.tokens[self.at];
        let mark = |mark| Token { kind: TokenKind::Mark(mark), ..place };
        meant.extend([place, mark(Mark::Open(Bracket::Round))]);
        meant.extend(&self.tokens[self.at + 1..self.at + end]);
        meant.push(mark(Mark::Close(Bracket::Round)));
        self.at += after;
        true
    }

    /// `#if (A = 1) & (B = 2)`: no one pair of parentheses holds all of it.
    fn condition_in_parts(&mut self, head: Head, meant: &mut Vec<Token>) -> bool {
        let Some(close) = self.closed(1, Bracket::Round) else { return false };
        let goes_on = match self.kind(close + 1) {
            Some(TokenKind::Mark(mark)) => matches!(
                mark,
                Mark::And | Mark::Or | Mark::Equal | Mark::NotEqual | Mark::LessOrEqual
            ),
            _ => false,
        };
        let end = self.line_end(close + 1);
        if !goes_on || end == close + 1 {
            return false;
        }
        let (word, span) = (head.word(), self.span(1, end - 1));
        let text = self.text.get(span.range()).unwrap_or("…");
        let message = format!("the whole condition of `#{word}` stands in one pair of parentheses");
        self.diagnostics.push(
            Diagnostic::new(Code::ExpectedExpression, message)
                .at(self.span(close + 1, close + 1), "the condition has ended before this")
                .help(format!("write `#{word} ({text})`"))
                .fix(Span { end: span.start, ..span }, "(")
                .fix(span.after(), ")"),
        );
        let place = self.tokens[self.at];
        let mark = |mark| Token { kind: TokenKind::Mark(mark), ..place };
        meant.extend([place, mark(Mark::Open(Bracket::Round))]);
        meant.extend(&self.tokens[self.at + 1..self.at + end]);
        meant.push(mark(Mark::Close(Bracket::Round)));
        self.at += end;
        true
    }

    /// `if A > 3`: both the `#` and the parentheses are missing; one message.
    pub(super) fn bare_condition(
        &mut self,
        head: Head,
        diagnostic: Diagnostic,
        meant: &mut Vec<Token>,
    ) -> bool {
        let end = self.line_end(1);
        let place = self.tokens[self.at];
        let mark = |mark| Token { kind: TokenKind::Mark(mark), ..place };
        meant.push(Token { kind: TokenKind::Directive(head), ..place });
        if end > 1 {
            let span = self.span(1, end - 1);
            let before = Span { end: span.start, ..span };
            self.diagnostics.push(diagnostic.fix(before, "(").fix(span.after(), ")"));
            meant.push(mark(Mark::Open(Bracket::Round)));
            meant.extend(&self.tokens[self.at + 1..self.at + end]);
            meant.push(mark(Mark::Close(Bracket::Round)));
        } else {
            self.diagnostics.push(diagnostic);
        }
        self.at += end;
        true
    }

    /// `#if (A) then`, `#while (A):`, `#for (I, 0, 3) do`, `#macro Ball(P):`.
    pub(super) fn then(&mut self, head: Head, meant: &mut Vec<Token>) -> bool {
        let open = if head == Head::Macro { 2 } else { 1 };
        let Some(close) = self.closed(open, Bracket::Round) else { return false };
        let is_joint = |at: usize| {
            matches!(self.kind(at), Some(TokenKind::Name))
                && matches!(self.slice(at), "then" | "do" | "begin")
        };
        if close > 3 && self.slice_is(close - 1, "then") {
            let span = self.span(close - 1, close - 1);
            let before = self.span(close - 2, close - 2);
            let diagnostic =
                Diagnostic::new(Code::UnexpectedCharacter, "no `then` stands in a condition")
                    .at(span, "a sign of another language")
                    .help("the body begins right after the parenthesis")
                    .fix(Span { start: before.end, ..span }, "");
            self.diagnostics.push(diagnostic);
            self.dropped.insert(self.at + close - 1, false);
            self.take(meant);
            return true;
        }
        if !(self.is(close + 1, Mark::Colon) || is_joint(close + 1)) {
            return false;
        }
        let (span, condition) = (self.span(close + 1, close + 1), self.span(close, close));
        let text = self.slice(close + 1).to_owned();
        let what = match head {
            Head::Macro => "the parameters of a macro",
            Head::For => "the head of a loop",
            _ => "a condition",
        };
        let message = format!("no `{text}` stands after {what}");
        let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(span, "a sign of another language")
            .help("the body begins right after the parenthesis")
            .fix(Span { start: condition.end, ..span }, "");
        self.diagnostics.push(diagnostic);
        self.dropped.insert(self.at + close + 1, false);
        self.take(meant);
        true
    }
}
