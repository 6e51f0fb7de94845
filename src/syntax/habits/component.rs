//! The components of a vector as they are written elsewhere: `<<1, 2, 3>`, `<x=1, y=2, z=3>`.

use super::Reader;
use super::vector::LONGEST_VECTOR;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::token::{Mark, Token, TokenKind};
use crate::vocabulary::{Role, Word};

impl Reader<'_> {
    /// `<<1, 2, 3>`: an angle too many, where the vector is no component of another.
    pub(super) fn doubled_angle(&mut self) -> bool {
        if !self.is(1, Mark::Less) || !self.touches(1) {
            return false;
        }
        let is_plain = |kind: TokenKind| match kind {
            TokenKind::Number | TokenKind::Name => true,
            TokenKind::Mark(mark) => matches!(mark, Mark::Comma | Mark::Minus | Mark::Dot),
            _ => false,
        };
        let plain = (2..LONGEST_VECTOR).find(|&ahead| !self.kind(ahead).is_some_and(is_plain));
        let Some(close) = plain.filter(|&close| self.is(close, Mark::Greater)) else {
            return false;
        };
        // What goes on is a component, or closes the outer one.
        let goes_on = match self.kind(close + 1) {
            Some(TokenKind::Mark(mark)) => !matches!(mark, Mark::Close(_) | Mark::Semicolon),
            Some(TokenKind::Word(word)) => word.role() != Role::Statement,
            _ => true,
        };
        if goes_on {
            return false;
        }
        let span = self.span(0, 0);
        let vector = self.text.get(self.span(1, close).range()).unwrap_or("");
        self.diagnostics.push(
            Diagnostic::new(Code::UnclosedBlock, "this `<` is one too many")
                .at(span, "it opens a vector that is never closed")
                .help(format!("write `{vector}`"))
                .fix(span, ""),
        );
        self.at += 1;
        true
    }

    /// `<x=0, y=1, z=-5>`: components with their names.
    pub(super) fn named_components(&mut self, meant: &mut Vec<Token>) -> bool {
        let is_name = |reader: &Self, ahead: usize| {
            let name = matches!(
                reader.kind(ahead),
                Some(TokenKind::Word(
                    Word::X | Word::Y | Word::Z | Word::Red | Word::Green | Word::Blue
                ))
            );
            let sign = reader.is(ahead + 1, Mark::Equal) || reader.is(ahead + 1, Mark::Colon);
            name && sign
        };
        let opens = meant.last().is_some_and(|last| last.kind == TokenKind::Mark(Mark::Less));
        if !opens || !is_name(self, 0) {
            return false;
        }
        let (mut names, mut kept, mut ahead) = (Vec::new(), Vec::new(), 0);
        while !self.is(ahead, Mark::Greater) {
            let begins = ahead == 0 || self.is(ahead - 1, Mark::Comma);
            if begins && is_name(self, ahead) {
                names.push(ahead);
                ahead += 2;
                continue;
            }
            let is_value = match self.kind(ahead) {
                Some(TokenKind::Number | TokenKind::Name) => true,
                Some(TokenKind::Word(word)) => word.role() != Role::Statement,
                Some(TokenKind::Mark(mark)) => {
                    !matches!(mark, Mark::Less | Mark::Semicolon | Mark::Equal)
                }
                _ => false,
            };
            if !is_value || ahead > 3 * LONGEST_VECTOR {
                return false;
            }
            kept.push(self.tokens[self.at + ahead]);
            ahead += 1;
        }
        // One alone may be a comparison.
        if names.len() < 2 {
            return false;
        }
        let message = "the components of a vector stand without names";
        let mut told = Diagnostic::new(Code::UnexpectedCharacter, message)
            .at(self.span(0, 1), "leave this out")
            .help("their order says which is which: `<x, y, z>`");
        for name in names {
            let end = self.tokens[self.at + name + 2].start;
            told = told.fix(Span { end, ..self.span(name, name) }, "");
        }
        self.diagnostics.push(told);
        meant.append(&mut kept);
        self.at += ahead;
        true
    }
}
