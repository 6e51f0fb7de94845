//! Names with points or signs in them, as other languages have them: `$t`, `mesh.position.x = 2;`, `Material.001`.

use super::Reader;
use super::template::STAND_IN;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::token::{Mark, Token, TokenKind};
use crate::vocabulary::Word;

impl Reader<'_> {
    /// `Material.001`, as Blender names a copy.
    pub(super) fn numbered_name(&mut self, meant: &mut Vec<Token>) -> bool {
        let is_number = self.kind(1) == Some(TokenKind::Number) && self.touches(1);
        let is_copy =
            |number: &str| number.len() == 3 && number.bytes().all(|b| b.is_ascii_digit());
        if !is_number
            || !self.slice(0).starts_with(|c: char| c.is_ascii_alphabetic())
            || !self.slice(1).strip_prefix('.').is_some_and(is_copy)
        {
            return false;
        }
        let whole = self.span(0, 1);
        let (name, number) = (self.slice(0).to_owned(), self.slice(1)[1..].to_owned());
        let told = Diagnostic::new(
            Code::UnexpectedCharacter,
            format!("`{name}.{number}` is no name: a name has no point"),
        )
        .at(whole, "names are made of letters, digits and `_`")
        .help(format!("write `{name}_{number}`, here and where it is declared"));
        self.diagnostics.push(told);
        meant.push(self.tokens[self.at]);
        self.at += 2;
        true
    }

    /// `.TRUE.`, as Fortran has it.
    pub(super) fn truth_of_fortran(&mut self, meant: &mut Vec<Token>) -> bool {
        let dotted = matches!(self.kind(1), Some(TokenKind::Name | TokenKind::Word(_)))
            && self.touches(1)
            && self.is(2, Mark::Dot)
            && self.touches(2);
        if !dotted {
            return false;
        }
        let word = match self.slice(1).to_ascii_lowercase().as_str() {
            "true" => Word::True,
            "false" => Word::False,
            _ => return false,
        };
        let (span, ours) = (self.span(0, 2), word.name());
        let text = self.text.get(span.range()).unwrap_or("");
        self.diagnostics.push(
            Diagnostic::new(Code::ForeignWord, format!("`{text}` is written `{ours}`"))
                .at(span, "a word of another language")
                .help(format!("replace it with `{ours}`"))
                .fix(span, ours),
        );
        meant.push(Token { kind: TokenKind::Word(word), start: span.start, end: span.end });
        self.at += 3;
        true
    }

    /// `color.brown`, a colour as the member of a list of them.
    pub(super) fn color_by_dot(&mut self, meant: &mut Vec<Token>) -> bool {
        let dot = self.tokens[self.at];
        let of_color = meant.last().is_some_and(|last| {
            matches!(last.kind, TokenKind::Word(Word::Color)) && last.end == dot.start
        });
        let named =
            matches!(self.kind(1), Some(TokenKind::Name | TokenKind::Word(_))) && self.touches(1);
        if !of_color || !named {
            return false;
        }
        let name = self.slice(1).to_owned();
        let mut capital = name.clone();
        if let Some(first) = capital.get_mut(..1) {
            first.make_ascii_uppercase();
        }
        let span = self.span(0, 1);
        self.diagnostics.push(
            Diagnostic::new(
                Code::UnexpectedCharacter,
                format!("a colour is a declared name: there is no `color.{name}`"),
            )
            .at(span, "expected a name or `rgb`")
            .help(format!("write `color {capital}`, with `#include \"colors.inc\"`")),
        );
        meant.push(Token { kind: STAND_IN, start: span.start, end: span.end });
        self.at += 2;
        true
    }

    /// `$t`, as OpenSCAD has it.
    pub(super) fn time_with_sign(&mut self, meant: &mut Vec<Token>) -> bool {
        let is_time = self.slice(0) == "$"
            && matches!(self.kind(1), Some(TokenKind::Name | TokenKind::Word(_)))
            && self.touches(1)
            && matches!(self.slice(1), "t" | "time" | "T");
        if is_time && !self.is(2, Mark::Equal) {
            let span = self.span(0, 1);
            let told = Diagnostic::new(Code::ForeignWord, "the time of an animation is `clock`")
                .at(span, "a name of another language")
                .help("replace it with `clock`")
                .fix(span, "clock");
            self.diagnostics.push(told);
            meant.push(Token {
                kind: TokenKind::Word(Word::Clock),
                start: span.start,
                end: span.end,
            });
            self.at += 2;
            return true;
        }
        false
    }

    /// `mesh.position.x = 2;`, a statement.
    pub(super) fn member(&mut self, meant: &[Token]) -> bool {
        let first = self.tokens[self.at];
        let behind = meant.last().map_or(0, |last| last.end as usize);
        let gap = self.text.get(behind..first.start as usize).unwrap_or("");
        if !self.inside.is_empty() || !(meant.is_empty() || gap.contains('\n')) {
            return false;
        }
        let is_name = |kind| matches!(kind, Some(TokenKind::Name | TokenKind::Word(_)));
        let mut ahead = 1;
        while self.is(ahead, Mark::Dot) && self.touches(ahead) && is_name(self.kind(ahead + 1)) {
            ahead += 2;
        }
        if ahead == 1 || !self.is(ahead, Mark::Equal) {
            return false;
        }
        let whole = self.span(0, ahead - 1);
        let text = self.text.get(whole.range()).unwrap_or("").to_owned();
        let told = Diagnostic::new(
            Code::UnexpectedCharacter,
            format!("`{text}` cannot be given a value"),
        )
        .at(whole, "nothing is changed from outside once it is made")
        .help("an object is moved and turned in its own block: `translate`, `rotate`, `scale`")
        .help("a vector is declared whole: `#declare V = <1, 2, 3>;`");
        self.diagnostics.push(told);
        let end = self.line_end(ahead);
        self.at += if self.is(end, Mark::Semicolon) { end + 1 } else { end };
        true
    }
}
