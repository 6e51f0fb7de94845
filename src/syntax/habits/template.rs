//! Places that a program should have filled, `${radius}`, `{{ radius }}` and `%f`, and numbers that are more
//! than digits: `50%`, `1.5f`, `10cm`.

use super::Reader;
use super::part::Inside;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::{Family, Role, Word};

/// What other languages and tools write behind a number, and what is said of it.
const SUFFIXES: &[(&[&str], &str)] = &[
    (&["f", "F", "h", "L", "u", "lf"], "the kind of a number is not written"),
    (&["px", "pt", "em", "mm", "cm", "m", "km", "in", "ft"], "lengths have no unit"),
    (&["deg"], "angles are in degrees, and have no unit"),
    (&["s", "ms", "kg", "W", "lm"], "numbers have no unit"),
];

/// The number 1: a value that fits nearly everywhere. Nothing is drawn after a mistake.
pub(super) const STAND_IN: TokenKind = TokenKind::Word(Word::Yes);

impl Reader<'_> {
    /// `${radius}`, `$radius`, `{{ radius }}`, `%f`, `%.3f`.
    pub(super) fn template(&mut self, meant: &mut Vec<Token>) -> bool {
        let used = match self.slice(0) {
            "$" if self.kind(1) == Some(TokenKind::Name) && self.touches(1) => Some(1),
            "$" if self.touches(1) => self.closed(1, Bracket::Brace),
            "{" if self.is(1, Mark::Open(Bracket::Brace)) && self.is_in_value(meant) => self
                .closed(1, Bracket::Brace)
                .filter(|&close| self.is(close + 1, Mark::Close(Bracket::Brace)))
                .map(|close| close + 1),
            "{" if matches!(self.kind(1), Some(TokenKind::Name | TokenKind::Word(_)))
                && self.touches(1)
                && self.touches(2)
                && self.is_in_value(meant) =>
            {
                self.closed(0, Bracket::Brace).filter(|&close| {
                    (2..close).all(|ahead| {
                        let named = matches!(
                            self.kind(ahead),
                            Some(
                                TokenKind::Name
                                    | TokenKind::Word(_)
                                    | TokenKind::Number
                                    | TokenKind::Mark(Mark::Dot | Mark::Colon)
                            )
                        );
                        named && self.touches(ahead)
                    })
                })
            }
            "%" => self.conversion(),
            _ => None,
        };
        let Some(last) = used.filter(|&last| self.at + last < self.tokens.len()) else {
            return false;
        };
        let span = self.span(0, last);
        let text = self.text.get(span.range()).unwrap_or("").to_owned();
        if text.contains(['\n', '\r']) {
            return false;
        }
        let message = format!("`{text}` is a place in a template that was not filled");
        let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(span, "expected a value")
            .help("the program that wrote this file should have put one here");
        self.diagnostics.push(diagnostic);
        // `Tex_%d`: of the name only a part is there.
        let start = self.tokens[self.at].start;
        let name = meant.pop_if(|name| name.kind == TokenKind::Name && name.end == start);
        let start = name.map_or(start, |name| name.start);
        meant.push(Token { kind: STAND_IN, start, end: span.end });
        self.at += last + 1;
        true
    }

    /// Whether a value is wanted, and no row of an array can stand here: behind an operator, or in a vector or the
    /// parts of an object.
    fn is_in_value(&self, meant: &[Token]) -> bool {
        let marks = meant.iter().rev().map_while(|token| match token.kind {
            TokenKind::Mark(Mark::Open(Bracket::Brace) | Mark::Close(Bracket::Brace)) => None,
            kind => Some(kind),
        });
        match meant.last().map(|token| token.kind) {
            Some(TokenKind::Mark(
                Mark::Less | Mark::Plus | Mark::Minus | Mark::Star | Mark::Slash | Mark::Equal,
            )) => true,
            Some(TokenKind::Mark(Mark::Comma)) => {
                let in_vector = marks
                    .take_while(|kind| *kind != TokenKind::Mark(Mark::Greater))
                    .any(|kind| kind == TokenKind::Mark(Mark::Less));
                in_vector || self.inside.last().is_some_and(Inside::has_word)
            }
            kind => wants_a_value(kind),
        }
    }

    /// Where `%f`, `%3d`, `%.3f` ends.
    fn conversion(&self) -> Option<usize> {
        let letter = |ahead: usize| {
            self.touches(ahead)
                && self.kind(ahead) == Some(TokenKind::Name)
                && ["d", "f", "g", "e", "i", "s", "lf"].contains(&self.slice(ahead))
        };
        let number = self.kind(1) == Some(TokenKind::Number) && self.touches(1);
        let after_value = self.at.checked_sub(1).is_some_and(|before| {
            self.tokens[before].end == self.tokens[self.at].start
                && self.tokens[before].kind == TokenKind::Number
        });
        match number {
            _ if after_value => None,
            true => letter(2).then_some(2),
            false => letter(1).then_some(1),
        }
    }

    /// `50%`: a part of a hundred.
    pub(super) fn percent(&mut self, meant: &mut [Token]) -> bool {
        let Some(number) = self.number_before(meant).filter(|_| self.slice(0) == "%") else {
            return false;
        };
        let span = Span { start: number.start, ..self.span(0, 0) };
        // `[0% Red]`
        let in_entry = self.inside.last().is_some_and(|inside| inside.is(Bracket::Square));
        let is_name = self.kind(1) == Some(TokenKind::Name);
        let goes_on = !(in_entry && is_name && self.touches(0))
            && matches!(
                self.kind(1),
                Some(
                    TokenKind::Number
                        | TokenKind::Name
                        | TokenKind::Mark(Mark::Open(Bracket::Round) | Mark::Minus)
                )
            );
        let text = self.text.get(number.start as usize..number.end as usize).unwrap_or("");
        let Some(value) = text.parse::<f64>().ok().filter(|_| !goes_on) else { return false };
        let part = format!("{}", value / 100.0);
        let message = format!("`{text}%` is not a number of the language");
        let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(span, "percent have no sign")
            .help(format!("write the part of 1: `{part}`"))
            .fix(span, part);
        self.diagnostics.push(diagnostic);
        if let Some(number) = meant.last_mut() {
            number.kind = STAND_IN;
        }
        self.at += 1;
        true
    }

    /// `1.5f`, `10cm`.
    pub(super) fn suffix(&mut self, meant: &[Token]) -> bool {
        let Some(number) = self.number_before(meant) else { return false };
        let name = self.slice(0).to_owned();
        let Some((_, why)) = SUFFIXES.iter().find(|(list, _)| list.contains(&name.as_str())) else {
            return false;
        };
        let text = self.text.get(number.start as usize..number.end as usize).unwrap_or("");
        let diagnostic =
            Diagnostic::new(Code::MalformedNumber, format!("`{text}{name}` is not a number"))
                .at(Span { start: number.start, ..self.span(0, 0) }, *why)
                .help(format!("write `{text}`"))
                .fix(self.span(0, 0), "");
        self.diagnostics.push(diagnostic);
        self.at += 1;
        true
    }

    /// The number that this token touches.
    pub(super) fn number_before(&self, meant: &[Token]) -> Option<Token> {
        let here = self.tokens[self.at].start;
        let last = meant.last().copied()?;
        (last.kind == TokenKind::Number && last.end == here).then_some(last)
    }
}

/// Whether what stands before makes a value likely, and a block not.
fn wants_a_value(before: Option<TokenKind>) -> bool {
    match before {
        Some(TokenKind::Mark(mark)) => {
            matches!(mark, Mark::Comma | Mark::Less | Mark::Equal | Mark::Open(Bracket::Round))
        }
        Some(TokenKind::Word(word)) => {
            word.role() == Role::Statement
                && matches!(word.family(), Family::Transform | Family::Color | Family::FinishItem)
                && !matches!(word, Word::TransformWord | Word::Reflection)
        }
        _ => false,
    }
}
