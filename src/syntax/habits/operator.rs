//! Operators that other languages have, and this one calls: `a^2`, `a ** 2`, `a % b`.

use super::Reader;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::{Role, Word};

/// How many tokens of a condition between two values are looked at.
const LONGEST_CONDITION: usize = 16;

impl Reader<'_> {
    /// `a^2`, `a ** 2`, `a % 2`: what is called instead, with the values on both sides where they are plain.
    pub(super) fn operator(&mut self, meant: &mut Vec<Token>) -> bool {
        let double = self.is(0, Mark::Star) && self.is(1, Mark::Star) && self.touches(1);
        let (function, what, length) = match self.slice(0) {
            "^" => ("pow", "a power", 1),
            "%" => ("mod", "a remainder", 1),
            _ if double => ("pow", "a power", 2),
            _ => return false,
        };
        let begins_a_value = |kind| {
            matches!(
                kind,
                Some(
                    TokenKind::Name
                        | TokenKind::Number
                        | TokenKind::Word(_)
                        | TokenKind::Mark(Mark::Open(Bracket::Round) | Mark::Minus)
                )
            )
        };
        if !meant.last().is_some_and(ends_a_value) || !begins_a_value(self.kind(length)) {
            return false;
        }
        let span = self.span(0, length - 1);
        let message = match double {
            true => "`**` is not an operator of the language".to_owned(),
            false => format!("the character `{}` has no meaning here", self.slice(0)),
        };
        let told = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(span, "an operator of another language")
            .help(format!("{what} is written `{function}(a, b)`"));
        let sides = self.before(meant, function).zip(self.behind(length));
        let told = match sides {
            Some((before, behind)) => {
                let text = |span: Span| self.text.get(span.range()).unwrap_or("");
                let right = format!("{function}({}, {})", text(before), text(behind));
                told.help(format!("write `{right}`")).fix(before.to(behind), right)
            }
            None => told,
        };
        self.diagnostics.push(told);
        // An operator, so that what stands on both sides is read.
        let kind = TokenKind::Mark(Mark::Star);
        meant.push(Token { kind, end: span.end, ..self.tokens[self.at] });
        self.at += length;
        true
    }

    /// `0.2 if A < 0 else 0.7`, as Python chooses between two values.
    pub(super) fn choice_behind(&mut self, meant: &mut [Token]) -> bool {
        let is_value = meant.last().is_some_and(ends_a_value) && !self.inside.is_empty();
        let otherwise = (1..LONGEST_CONDITION)
            .find(|&at| self.kind(at) == Some(TokenKind::Word(Word::Else)))
            .filter(|&at| {
                !(1..=at + 1).any(|at| self.kind(at).is_none() || self.breaks_before(at))
            });
        let Some(otherwise) = otherwise.filter(|_| is_value) else { return false };
        let sides = self.before(meant, "pow").zip(self.behind(otherwise + 1));
        let Some((left, right)) = sides.filter(|_| otherwise > 1) else { return false };
        let text = |span: Span| self.text.get(span.range()).unwrap_or("").to_owned();
        let condition = text(self.span(1, otherwise - 1));
        let ours = format!("({condition} ? {} : {})", text(left), text(right));
        let whole = left.to(right);
        self.diagnostics.push(
            Diagnostic::new(
                Code::UnexpectedCharacter,
                "one of two values is chosen by `?` and `:`",
            )
            .at(self.span(0, 0), "a choice of another language")
            .help(format!("write `{ours}`"))
            .fix(whole, ours),
        );
        // The left value stands for the choice.
        while self.tokens.get(self.at).is_some_and(|token| token.start < right.end) {
            self.at += 1;
        }
        true
    }

    /// `rgb <0, 1, 0 transmit 0.5>`: what belongs behind the vector.
    pub(super) fn clear_in_vector(&mut self, meant: &mut Vec<Token>) -> bool {
        let is_over = self.kind(1) == Some(TokenKind::Number) && self.is(2, Mark::Greater);
        let in_vector =
            meant.iter().rev().take(LONGEST_CONDITION).find_map(|token| match token.kind {
                TokenKind::Mark(Mark::Less) => Some(true),
                TokenKind::Mark(Mark::Greater | Mark::Open(_)) | TokenKind::Word(_) => Some(false),
                _ => None,
            });
        if !is_over || in_vector != Some(true) {
            return false;
        }
        let last = meant.last().map_or(0, |last| last.end);
        let (word, part) = (self.slice(0).to_owned(), self.span(0, 1));
        let (gap, closer) = (Span { start: last, end: last, ..part }, self.span(2, 2));
        let text = self.text.get(part.range()).unwrap_or("").to_owned();
        self.diagnostics.push(
            Diagnostic::new(
                Code::UnexpectedCharacter,
                format!("`{word}` stands behind the vector"),
            )
            .at(self.span(0, 0), "expected `>` before this")
            .help(format!("write `> {text}`"))
            .fix(gap, ">")
            .fix(closer, ""),
        );
        meant.push(Token { kind: TokenKind::Mark(Mark::Greater), start: last, end: last });
        meant.extend([self.tokens[self.at], self.tokens[self.at + 1]]);
        self.at += 3;
        true
    }

    /// The one value that ends what was read, where it is plain, and all that the operator would take.
    fn before(&self, meant: &[Token], function: &str) -> Option<Span> {
        let last = meant.last()?;
        let mut first = meant.len() - 1;
        if last.kind == TokenKind::Mark(Mark::Close(Bracket::Round)) {
            let mut depth = 0usize;
            first = meant.iter().rposition(|token| {
                match token.kind {
                    TokenKind::Mark(Mark::Close(Bracket::Round)) => depth += 1,
                    TokenKind::Mark(Mark::Open(Bracket::Round)) => depth = depth.saturating_sub(1),
                    _ => {}
                }
                depth == 0
            })?;
            let calls = first.checked_sub(1).is_some_and(|at| {
                let is_word = matches!(meant[at].kind, TokenKind::Word(word) if matches!(word.role(), Role::Function { .. }));
                meant[at].end == meant[first].start && (is_word || meant[at].kind == TokenKind::Name)
            });
            first -= usize::from(calls);
        }
        let outer = first.checked_sub(1).map(|at| meant[at].kind);
        let is_part = match outer {
            Some(TokenKind::Mark(Mark::Dot)) => true,
            // `a * b % c` takes both.
            Some(TokenKind::Mark(Mark::Star | Mark::Slash)) => function == "mod",
            _ => false,
        };
        let span = Span::new(self.file, meant[first].start as usize, last.end as usize);
        (!is_part).then_some(span)
    }

    /// The one value that begins at `ahead`, where it is plain.
    fn behind(&self, ahead: usize) -> Option<Span> {
        let first = if self.is(ahead, Mark::Minus) { ahead + 1 } else { ahead };
        let is_value = match self.kind(first)? {
            TokenKind::Name | TokenKind::Number => true,
            TokenKind::Word(word) => !matches!(word.role(), Role::Statement),
            TokenKind::Mark(Mark::Open(Bracket::Round)) => true,
            _ => false,
        };
        let opener = if self.is(first, Mark::Open(Bracket::Round)) { first } else { first + 1 };
        let last = self.closed(opener, Bracket::Round).unwrap_or(first);
        let is_over = last < opener && self.is(opener, Mark::Open(Bracket::Round))
            || self.is(last + 1, Mark::Dot)
            || self.is(last + 1, Mark::Star) && self.is(last + 2, Mark::Star)
            || self.tokens.len() > self.at + last + 1 && self.slice(last + 1) == "^";
        (is_value && !is_over).then(|| self.span(ahead, last))
    }
}

fn ends_a_value(token: &Token) -> bool {
    matches!(
        token.kind,
        TokenKind::Name
            | TokenKind::Number
            | TokenKind::Word(_)
            | TokenKind::Mark(Mark::Close(Bracket::Round))
    )
}
