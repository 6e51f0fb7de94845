//! `pattern { … }`: a pattern alone, as used in a function.

use crate::color::Color;
use crate::diagnostic::{Code, Diagnostic};
use crate::pattern::Pattern;
use crate::scene::{ColorMap, Pigment, PigmentId, PigmentKind};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};
use super::Place;

impl Evaluator<'_> {
    /// Reads `pattern { … }`, after its keyword, as a pigment whose red is the pattern's value.
    pub(in crate::evaluate) fn pattern_block(&mut self, token: &Token) -> Outcome<PigmentId> {
        let (mut found, mut transforms) = (None, Vec::new());
        let told = self.reports;
        self.block(token, Word::Pattern, |evaluator| {
            while let Some(token) = evaluator.next() {
                if let Some(transform) = evaluator.transform_from(&token) {
                    transforms.push(transform?);
                    continue;
                }
                match token.kind {
                    TokenKind::Word(Word::Checker) => found = Some(Pattern::Checker),
                    TokenKind::Word(Word::Gradient) => {
                        let given =
                            evaluator.any_direction_after(&token, "the gradient's direction")?;
                        found = Some(Pattern::Gradient { direction: given.value });
                    }
                    _ => match evaluator.inert(&token, Place::PATTERN) {
                        Some(outcome) => outcome?,
                        None => evaluator.unexpected(&token, Place::PATTERN),
                    },
                }
            }
            Ok(())
        })?;
        let site = token.here.site(token.span);
        let Some(pattern) = found else {
            if self.poison.is_some() || self.reports > told {
                return Err(Reported);
            }
            let diagnostic = Diagnostic::new(Code::MissingPart, "this `pattern` names none")
                .at(site.span, "expected a pattern, as `gradient x`");
            return Err(self.report(&token.here, diagnostic));
        };
        let map = ColorMap(vec![(0.0, Color::BLACK), (1.0, Color::WHITE)]);
        let kind = PigmentKind::Patterned { pattern, map };
        Ok(self.add_pigment(Pigment { kind, transforms, site, clear: vec![], pattern: vec![] }))
    }
}
