//! Numbers with more in them than digits: `0.1O`, `2.445(7)`, `1.#INF`, and `2pi`, where a `*` is missing.

use super::Reader;
use super::template::STAND_IN;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::vocabulary::Role;

/// `IND` of `1.#IND`, `INF00` of `1.#INF00`: what some programs in C print for what is no number.
pub(in crate::syntax) fn is_no_number(word: &str) -> bool {
    ["IND", "INF", "QNAN", "SNAN"].contains(&word.trim_end_matches(char::is_numeric))
}

impl Reader<'_> {
    /// `. 5`: a blank in a number.
    pub(super) fn parted_number(&mut self, meant: &mut Vec<Token>) -> bool {
        let digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
        let behind = meant.last().map_or(0, |last| last.end);
        let parted = self.kind(1) == Some(TokenKind::Number)
            && !self.touches(1)
            && digits(self.slice(1))
            && behind < self.tokens[self.at].start;
        if !parted {
            return false;
        }
        let span = self.span(0, 1);
        let right = format!("0.{}", self.slice(1));
        if self.text.get(span.range()).is_none_or(|text| text.contains(['\n', '\r'])) {
            return false;
        }
        self.diagnostics.push(
            Diagnostic::new(Code::MalformedNumber, "a number has no blank in it")
                .at(span, "expected the digits right behind the point")
                .help(format!("write `{right}`"))
                .fix(span, right),
        );
        meant.push(Token { kind: STAND_IN, start: span.start, end: span.end });
        self.at += 2;
        true
    }

    /// `½`.
    pub(super) fn vulgar_fraction(&mut self, meant: &mut Vec<Token>) -> bool {
        let value = match self.slice(0) {
            "½" => "0.5",
            "¼" => "0.25",
            "¾" => "0.75",
            "⅓" => "(1/3)",
            "⅔" => "(2/3)",
            "⅛" => "0.125",
            _ => return false,
        };
        let span = self.span(0, 0);
        let message = format!("the character `{}` is no number of the language", self.slice(0));
        self.diagnostics.push(
            Diagnostic::new(Code::UnexpectedCharacter, message)
                .at(span, "expected digits")
                .help(format!("write `{value}`"))
                .fix(span, value),
        );
        meant.push(Token { kind: STAND_IN, start: span.start, end: span.end });
        self.at += 1;
        true
    }

    /// `3..5`, `3 .. 5`: from one to the other, as other languages have it.
    pub(super) fn range_of_dots(&mut self, meant: &mut Vec<Token>) -> bool {
        let ends = self.slice(0).ends_with('.');
        let dot = |ahead: usize| self.is(ahead, Mark::Dot);
        let starts = |kind| matches!(kind, Some(TokenKind::Number | TokenKind::Name));
        // `3..5` comes as `3.` and `.5`, and `3 .. 5` as two points.
        let (dots, behind) = if ends && self.touches(1) {
            let joined = self.kind(1) == Some(TokenKind::Number) && self.slice(1).starts_with('.');
            match joined {
                true => (None, 1),
                false if dot(1) && starts(self.kind(2)) => (Some(1), 2),
                false => return false,
            }
        } else if dot(1) && dot(2) && self.touches(2) && starts(self.kind(3)) {
            (Some(2), 3)
        } else if dot(1)
            && self.kind(2) == Some(TokenKind::Number)
            && self.touches(2)
            && self.slice(2).starts_with('.')
        {
            (None, 2)
        } else {
            return false;
        };
        if behind == 1 && self.two_points(meant) {
            return true;
        }
        let (from, to) = (self.span(0, 0), self.span(behind, behind));
        let end = if dots.is_none() { to.start + 1 } else { self.span(behind - 1, behind - 1).end };
        let start = from.end - u32::from(ends);
        let signs = Span { start, end, ..from };
        let text = self.text.get(signs.range()).unwrap_or("").trim().to_owned();
        let gap = if self.text.get(end as usize..=end as usize) == Some(" ") { "," } else { ", " };
        self.diagnostics.push(
            Diagnostic::new(
                Code::UnexpectedCharacter,
                format!("`{text}` is no sign of the language"),
            )
            .at(signs, "two values are parted by a comma")
            .help("replace it with `,`")
            .fix(signs, gap),
        );
        let comma = Token { kind: TokenKind::Mark(Mark::Comma), start, end };
        let last = self.tokens[self.at + behind];
        meant.push(Token { end: start, ..self.tokens[self.at] });
        meant.push(comma);
        meant.push(Token { start: last.start + u32::from(dots.is_none()), ..last });
        self.at += behind + 1;
        true
    }

    /// `<0, 0..5, 0>`: outside of a directive's head, two points are one too many.
    fn two_points(&mut self, meant: &mut Vec<Token>) -> bool {
        // `#range (0..5)`
        let near = &meant[meant.len().saturating_sub(2)..];
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let (whole, part) = (self.slice(0).trim_end_matches('.'), self.slice(1));
        let part = part.trim_start_matches('.');
        if near.iter().any(|token| matches!(token.kind, TokenKind::Directive(_)))
            || !digits(whole)
            || !digits(part)
        {
            return false;
        }
        let span = self.span(0, 1);
        let number = format!("{whole}.{part}");
        let text = self.text.get(span.range()).unwrap_or("");
        self.diagnostics.push(
            Diagnostic::new(Code::MalformedNumber, format!("`{text}` is not a number"))
                .at(span, "two points stand in it")
                .help(format!("did you mean `{number}`?"))
                .fix(span, number),
        );
        meant.push(Token { kind: STAND_IN, start: span.start, end: span.end });
        self.at += 2;
        true
    }

    /// `0.1O`, `1O.5`, `l0`: letters that look like digits.
    pub(super) fn letter_in_number(&mut self, meant: &mut [Token]) -> bool {
        let Some(number) = self.number_before(meant) else { return false };
        let alike = |text: &str| text.chars().all(|c| "OoIl".contains(c) || c.is_ascii_digit());
        if !alike(self.slice(0)) {
            return false;
        }
        let goes_on = self.kind(1) == Some(TokenKind::Number)
            && self.touches(1)
            && self.slice(1).starts_with('.');
        let span = Span { start: number.start, ..self.span(0, usize::from(goes_on)) };
        let text = self.text.get(span.range()).unwrap_or("").to_owned();
        let digits = text.replace(['O', 'o'], "0").replace(['I', 'l'], "1");
        if digits.parse::<f64>().is_err() {
            return false;
        }
        let letter = text.chars().find(|c| "OoIl".contains(*c)).unwrap_or('O');
        let digit = if "Oo".contains(letter) { '0' } else { '1' };
        let message = format!("`{text}` is not a number");
        let label =
            format!("the letter `{letter}` stands in it: did you mean the digit `{digit}`?");
        self.diagnostics.push(
            Diagnostic::new(Code::MalformedNumber, message)
                .at(self.span(0, 0), label)
                .help(format!("write `{digits}`"))
                .fix(span, digits),
        );
        if let Some(number) = meant.last_mut() {
            (number.kind, number.end) = (STAND_IN, span.end);
        }
        self.at += 1 + usize::from(goes_on);
        true
    }

    /// `1.2 e-1`: a blank within a number.
    pub(super) fn parted_exponent(&mut self, meant: &mut [Token]) -> bool {
        let Some(number) = meant.last().filter(|last| last.kind == TokenKind::Number) else {
            return false;
        };
        let (start, end) = (number.start, number.end);
        let is_exponent = matches!(self.slice(0), "e" | "E")
            && (self.is(1, Mark::Minus) || self.is(1, Mark::Plus))
            && self.kind(2) == Some(TokenKind::Number)
            && self.touches(1)
            && self.touches(2)
            && self.slice(2).bytes().all(|byte| byte.is_ascii_digit());
        if !is_exponent || self.has_declared(self.slice(0)) {
            return false;
        }
        let span = Span { start, ..self.span(0, 2) };
        let text = self.text.get(span.range()).unwrap_or("").to_owned();
        let number: String = text.split_whitespace().collect();
        if number.parse::<f64>().is_err() || text.contains(['\n', '\r', '/']) {
            return false;
        }
        let gap = Span { start: end, end: self.tokens[self.at].start, ..span };
        self.diagnostics.push(
            Diagnostic::new(Code::MalformedNumber, format!("`{text}` is not a number"))
                .at(span, "no blank stands in a number")
                .help(format!("write `{number}`"))
                .fix(gap, ""),
        );
        if let Some(number) = meant.last_mut() {
            (number.kind, number.end) = (STAND_IN, span.end);
        }
        self.at += 3;
        true
    }

    /// `*****`, as Fortran writes a number that is longer than its place.
    pub(super) fn number_without_room(&mut self, meant: &mut Vec<Token>) -> bool {
        let mut last = 0;
        while self.is(last + 1, Mark::Star) && self.touches(last + 1) {
            last += 1;
        }
        let wanted = match meant.last().map(|token| token.kind) {
            Some(TokenKind::Mark(mark)) => {
                matches!(mark, Mark::Comma | Mark::Less | Mark::Minus | Mark::Open(_))
            }
            Some(TokenKind::Word(word)) => word.role() == Role::Statement,
            _ => false,
        };
        if last < 2 || !wanted {
            return false;
        }
        let span = self.span(0, last);
        let message = format!("`{}` is not a number", self.text.get(span.range()).unwrap_or(""));
        self.diagnostics.push(
            Diagnostic::new(Code::MalformedNumber, message)
                .at(span, "it stands where the program that wrote this had no room for the number")
                .help("give that program more columns, and let it write this file again"),
        );
        meant.push(Token { kind: STAND_IN, end: span.end, ..self.tokens[self.at] });
        self.at += last + 1;
        true
    }

    /// `-1.#IND`, `1.#INF`, as some programs in C print what is no number.
    pub(super) fn number_of_c(&mut self, meant: &mut [Token]) -> bool {
        let Some(number) = self.number_before(meant) else { return false };
        let word = self.slice(0).trim_start_matches('#');
        if !is_no_number(word) {
            return false;
        }
        let span = Span { start: number.start, ..self.span(0, 0) };
        let text = self.text.get(span.range()).unwrap_or("");
        let what = if word.starts_with("INF") { "infinity" } else { "no number at all" };
        self.diagnostics.push(
            Diagnostic::new(Code::MalformedNumber, format!("`{text}` is not a number"))
                .at(span, format!("the program that wrote this had {what} here"))
                .help("let that program write this file again, with a number"),
        );
        if let Some(number) = meant.last_mut() {
            (number.kind, number.end) = (STAND_IN, span.end);
        }
        self.at += 1;
        true
    }

    /// `np.float64(0.75)`, as a program in Python prints one of its numbers.
    pub(super) fn number_of_python(&mut self, meant: &mut Vec<Token>) -> bool {
        let is_call = matches!(self.slice(0), "np" | "numpy")
            && self.is(1, Mark::Dot)
            && self.kind(2) == Some(TokenKind::Name)
            && ["float", "int", "uint"].iter().any(|kind| self.slice(2).starts_with(kind))
            && self.is(3, Mark::Open(Bracket::Round));
        let Some(close) = self.closed(3, Bracket::Round).filter(|_| is_call) else { return false };
        let inside = Span {
            start: self.span(3, 3).end,
            end: self.span(close, close).start,
            ..self.span(0, 0)
        };
        let (opening, closing) = (self.span(0, 3), self.span(close, close));
        let number = self.text.get(inside.range()).unwrap_or("").trim().to_owned();
        if number.parse::<f64>().is_err() {
            return false;
        }
        let whole = self.span(0, close);
        let text = self.text.get(whole.range()).unwrap_or("").to_owned();
        self.diagnostics.push(
            Diagnostic::new(Code::ForeignWord, format!("`{text}` is a number as Python prints it"))
                .at(whole, "expected the number alone")
                .help(format!("write `{number}`"))
                .fix(opening, "")
                .fix(closing, ""),
        );
        let number = &self.tokens[self.at + 4..self.at + close];
        let is_plain = |token: &Token| {
            matches!(token.kind, TokenKind::Number | TokenKind::Mark(Mark::Minus | Mark::Plus))
        };
        match number.iter().all(is_plain) {
            true => meant.extend(number),
            false => meant.push(Token { kind: STAND_IN, end: whole.end, ..self.tokens[self.at] }),
        }
        self.at += close + 1;
        true
    }

    /// `0.25D+00`, `1.0D0`, as Fortran writes an exponent. The number before it stays as it is: nothing is drawn.
    pub(super) fn exponent_of_fortran(&mut self, meant: &[Token]) -> bool {
        let Some(number) = self.number_before(meant) else { return false };
        let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        let name = self.slice(0).to_owned();
        let Some(power) = name.strip_prefix(['D', 'd']).filter(|power| digits(power)) else {
            return false;
        };
        let signed = (self.is(1, Mark::Minus) || self.is(1, Mark::Plus))
            && self.touches(1)
            && self.kind(2) == Some(TokenKind::Number)
            && self.touches(2)
            && digits(self.slice(2));
        if power.is_empty() && !signed {
            return false;
        }
        let last = if power.is_empty() { 2 } else { 0 };
        let (span, all) = (self.span(0, 0), self.span(0, last));
        let mantissa = self.text.get(number.start as usize..number.end as usize).unwrap_or("");
        let written = self.text.get(all.range()).unwrap_or("");
        let right = format!("{mantissa}e{}", &written[1..]);
        let message = format!("`{name}` is no exponent");
        self.diagnostics.push(
            Diagnostic::new(Code::MalformedNumber, message)
                .at(
                    Span { start: number.start, ..span },
                    format!("an exponent is written with `e`: `{right}`"),
                )
                .fix(span, format!("e{power}")),
        );
        self.at += last + 1;
        true
    }

    /// `2.445(7)`: the last digit's uncertainty, as crystallographers write it.
    pub(super) fn uncertain_number(&mut self, meant: &[Token]) -> bool {
        let Some(number) = self.number_before(meant) else { return false };
        let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        let fits = self.kind(1) == Some(TokenKind::Number)
            && digits(self.slice(1))
            && self.is(2, Mark::Close(Bracket::Round))
            && self.touches(1)
            && self.touches(2);
        if !fits {
            return false;
        }
        let plain = self.text.get(number.start as usize..number.end as usize).unwrap_or("");
        let plain = plain.to_owned();
        let behind = self.span(0, 2);
        let text = self.text.get(behind.range()).unwrap_or("");
        let message = format!("`{plain}{text}` is not a number");
        self.diagnostics.push(
            Diagnostic::new(Code::MalformedNumber, message)
                .at(
                    Span { start: number.start, ..behind },
                    "the uncertainty of a number is not written",
                )
                .help(format!("write `{plain}`"))
                .fix(behind, ""),
        );
        self.at += 3;
        true
    }

    /// `2pi`, `90y`, `2R`, `2sin(a)`: a number and what it multiplies.
    pub(super) fn times(&mut self, meant: &mut Vec<Token>) -> bool {
        let Some(number) = self.number_before(meant) else { return false };
        let fits = match self.kind(0) {
            Some(TokenKind::Word(word)) => word.role() != Role::Statement,
            Some(TokenKind::Name) => self.has_declared(self.slice(0)),
            _ => false,
        };
        if !fits {
            return false;
        }
        let left = self.text.get(number.start as usize..number.end as usize).unwrap_or("");
        let (left, right) = (left.to_owned(), self.slice(0).to_owned());
        let span = self.span(0, 0);
        let between = Span { end: span.start, ..span };
        let message = format!("a `*` is missing between `{left}` and `{right}`");
        self.diagnostics.push(
            Diagnostic::new(Code::ExpectedExpression, message)
                .at(Span { start: number.start, ..span }, "a number, and what it multiplies")
                .help(format!("write `{left}*{right}`"))
                .fix(between, "*"),
        );
        let star = TokenKind::Mark(Mark::Star);
        meant.push(Token { kind: star, start: number.end, end: number.end });
        meant.push(self.tokens[self.at]);
        self.at += 1;
        true
    }

    /// Whether a name is declared in this text before here.
    pub(super) fn has_declared(&self, name: &str) -> bool {
        self.tokens[..self.at].windows(2).any(|pair| {
            let text = self.text.get(pair[1].start as usize..pair[1].end as usize);
            let head = matches!(pair[0].kind, TokenKind::Directive(Head::Declare | Head::Local));
            head && text == Some(name)
        })
    }
}
