//! Maps without their brackets: `color_map { 0 rgb 0, 1 rgb 1 }`, `{ (0, rgb 0) }`, `{ [0: rgb 0] }`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::{Family, Word};

impl Reader<'_> {
    /// The entries of a map whose brace has just opened, all at once.
    pub(super) fn map(&mut self, meant: &mut Vec<Token>) -> bool {
        let inside = self.inside.last();
        if !inside.is_some_and(|inside| inside.opens(Word::ColorMap))
            || !matches!(
                meant.last().map(|token| token.kind),
                Some(TokenKind::Mark(Mark::Open(Bracket::Brace)))
            )
        {
            return false;
        }
        let first = self.at;
        let mut at = 0;
        let mut fixes: Vec<(Span, &str)> = Vec::new();
        let mut tokens: Vec<Token> = Vec::new();
        let bracket = |token: Token, mark| Token { kind: TokenKind::Mark(mark), ..token };
        while !self.is(at, Mark::Close(Bracket::Brace)) {
            let Some((start, end)) = self.entry(at) else { return false };
            let round = start > at;
            let gap = |fixes: &mut Vec<_>, from: usize, to: usize| {
                fixes.push((self.span(from, to), ""));
            };
            let (open, close) = (self.span(at, at), self.span(end - 1, end - 1));
            match round {
                true => fixes.extend([(open, "["), (self.span(end, end), "]")]),
                false => {
                    fixes.push((Span { end: open.start, ..open }, "["));
                    fixes.push((close.after(), "]"));
                }
            }
            tokens.push(bracket(self.tokens[first + at], Mark::Open(Bracket::Square)));
            for ahead in start..end {
                match self.kind(ahead) {
                    Some(TokenKind::Mark(Mark::Colon)) => gap(&mut fixes, ahead, ahead),
                    _ => tokens.push(self.tokens[first + ahead]),
                }
            }
            tokens.push(bracket(self.tokens[first + end - 1], Mark::Close(Bracket::Square)));
            at = if round { end + 1 } else { end };
            if matches!(self.kind(at), Some(TokenKind::Mark(Mark::Comma | Mark::Semicolon))) {
                match fixes.last_mut().filter(|_| !round && self.touches(at)) {
                    // The bracket stands where the comma stood.
                    Some(last) => last.0.end = self.span(at, at).end,
                    None => gap(&mut fixes, at, at),
                }
                at += 1;
            }
        }
        if at == 0 {
            return false;
        }
        let diagnostic = Diagnostic::new(
            Code::ExpectedExpression,
            "each entry of a `color_map` stands in square brackets",
        )
        .at(self.span(0, 0), "expected `[` before this")
        .help("write `color_map { [0 rgb 0] [1 rgb 1] }`");
        let diagnostic =
            fixes.into_iter().fold(diagnostic, |told, (span, text)| told.fix(span, text));
        self.diagnostics.push(diagnostic);
        meant.extend(tokens);
        self.at += at;
        true
    }

    /// From where to where the number and the colour of an entry go.
    fn entry(&self, at: usize) -> Option<(usize, usize)> {
        if self.is(at, Mark::Open(Bracket::Round)) {
            return Some((at + 1, self.closed(at, Bracket::Round)?));
        }
        if self.kind(at) != Some(TokenKind::Number) {
            return None;
        }
        let mut end = at + 1;
        if matches!(self.kind(end), Some(TokenKind::Mark(Mark::Comma | Mark::Colon))) {
            end += 1;
        }
        while matches!(self.kind(end), Some(TokenKind::Word(word)) if word.family() == Family::Color)
        {
            end += 1;
        }
        match self.kind(end)? {
            TokenKind::Number | TokenKind::Name | TokenKind::Triple => Some((at, end + 1)),
            TokenKind::Mark(Mark::Less) => {
                // A colour has five parts at most.
                let close = (end..end + 24).find(|&ahead| self.is(ahead, Mark::Greater))?;
                Some((at, close + 1))
            }
            _ => None,
        }
    }

    /// `[0: rgb 0]`.
    pub(super) fn colon_in_entry(&mut self, meant: &[Token]) -> bool {
        let [.., map, entry] = self.inside.as_mut_slice() else { return false };
        let number = meant.last().is_some_and(|token| token.kind == TokenKind::Number);
        if !number || !map.opens(Word::ColorMap) || !entry.is(Bracket::Square) {
            return false;
        }
        let token = self.tokens[self.at];
        let span = Span::new(self.file, token.start as usize, token.end as usize);
        match &mut map.told {
            Some(told) => {
                told.fixes.push(crate::diagnostic::Fix { span, text: String::new() });
            }
            told @ None => {
                let message = "the number and the colour of an entry stand side by side";
                let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
                    .at(span, "expected the colour right here")
                    .help("write `[0 rgb 0]`")
                    .fix(span, "");
                *told = Some(diagnostic);
            }
        }
        self.at += 1;
        true
    }
}
