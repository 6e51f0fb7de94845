//! The sizes and values of an array as other languages write them: `array[2, 2]`, `array[3] [1, 2, 3]`,
//! `array[3] (1, 2, 3)`, `array[3] = { 1, 2, 3 }`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::Word;

impl Reader<'_> {
    /// `array[2, 2]`: all sizes of an array in one pair of brackets.
    pub(super) fn sizes_by_comma(&mut self, meant: &mut Vec<Token>) -> bool {
        let of_array = meant.last().is_some_and(|last| last.kind == TokenKind::Word(Word::Array));
        let Some(close) = self.closed(0, Bracket::Square).filter(|_| of_array) else {
            return false;
        };
        // A number or a name, and a comma, in turn.
        let is_one = |at: usize| match at % 2 == 1 {
            true => matches!(self.kind(at), Some(TokenKind::Number | TokenKind::Name)),
            false => self.is(at, Mark::Comma),
        };
        if close < 4 || close % 2 == 1 || !(1..close).all(is_one) {
            return false;
        }
        let commas = || (2..close).step_by(2);
        let sizes: String =
            (1..close).step_by(2).map(|at| format!("[{}]", self.slice(at))).collect();
        let message = "each dimension of an array has brackets of its own";
        let told = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(self.span(2, 2), "expected `]` here")
            .help(format!("write `array{sizes}`"));
        let gap = |at: usize| Span { end: self.span(at + 1, at + 1).start, ..self.span(at, at) };
        let told = commas().fold(told, |told, at| told.fix(gap(at), "]["));
        self.diagnostics.push(told);
        for (at, token) in self.tokens[self.at..=self.at + close].iter().enumerate() {
            let square = |bracket: fn(Bracket) -> Mark| Token {
                kind: TokenKind::Mark(bracket(Bracket::Square)),
                ..*token
            };
            match at > 0 && at < close && at % 2 == 0 {
                true => meant.extend([square(Mark::Close), square(Mark::Open)]),
                false => meant.push(*token),
            }
        }
        self.at += close + 1;
        true
    }

    /// `array[4] [1, 2, 3, 4]`, `array[2] (1, 2)`: the values of an array in other brackets.
    pub(super) fn array_list(&mut self, bracket: Bracket, meant: &mut Vec<Token>) -> bool {
        let square = |open: bool| match open {
            true => TokenKind::Mark(Mark::Open(Bracket::Square)),
            false => TokenKind::Mark(Mark::Close(Bracket::Square)),
        };
        let of_array = matches!(meant[..], [.., array, open, _, close]
            if array.kind == TokenKind::Word(Word::Array)
                && open.kind == square(true)
                && close.kind == square(false));
        let Some(close) = self.closed(0, bracket).filter(|_| of_array) else {
            return false;
        };
        // Those of a second dimension have no commas.
        if !(1..close).any(|ahead| self.is(ahead, Mark::Comma)) {
            return false;
        }
        let (first, last) = (self.span(0, 0), self.span(close, close));
        let message = "the values of an array stand between `{` and `}`";
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(first, "expected `{`")
                .also(last, "and `}`")
                .help("write `array[3] { 1, 2, 3 }`")
                .fix(first, "{")
                .fix(last, "}"),
        );
        self.in_braces(close, meant);
        true
    }

    /// `array[3] = { 1, 2, 3 }`: a sign before the values of an array.
    pub(super) fn values_behind_sign(&mut self, meant: &[Token]) -> bool {
        let square = |bracket: fn(Bracket) -> Mark| TokenKind::Mark(bracket(Bracket::Square));
        let sizes = meant.iter().rev().take_while(|token| {
            matches!(token.kind, TokenKind::Number | TokenKind::Name)
                || token.kind == square(Mark::Open)
                || token.kind == square(Mark::Close)
        });
        let count = sizes.count();
        let array = meant.len().checked_sub(count + 1).and_then(|at| meant.get(at));
        let of_array = array.is_some_and(|array| array.kind == TokenKind::Word(Word::Array));
        if !of_array || count < 3 || !self.is(1, Mark::Open(Bracket::Brace)) {
            return false;
        }
        let span = self.span(0, 0);
        let message = "an array takes its values right after its size";
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(span, "expected `{` here")
                .help("leave this `=` out: `array[3] { 1, 2, 3 }`")
                .fix(Span { end: self.span(1, 1).start, ..span }, ""),
        );
        self.at += 1;
        true
    }
}
