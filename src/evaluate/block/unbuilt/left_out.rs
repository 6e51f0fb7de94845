//! Effects of a `.pov` that are omitted with a warning; everything else renders as written.

use crate::diagnostic::{Code, Diagnostic};
use crate::vocabulary::Word;

use super::super::super::stream::{Token, TokenKind};
use super::super::super::{Evaluator, Outcome};
use super::super::Place;
use super::super::range::Range;

impl Evaluator<'_> {
    /// Reads `radiosity { importance n }` of an object: its relative number of samples.
    pub(in super::super) fn importance(&mut self, token: &Token) -> Outcome<()> {
        self.block(token, Word::Radiosity, |evaluator| {
            while let Some(item) = evaluator.next() {
                match item.kind {
                    TokenKind::Word(Word::Importance) => {
                        let range = &Range::POSITIVE;
                        if evaluator.number_in(&item, Word::Importance, range)? != 1.0 {
                            evaluator.not_simulated(&item);
                        }
                    }
                    _ => evaluator.unexpected(&item, Place::RADIOSITY),
                }
            }
            Ok(())
        })
    }

    fn not_simulated(&mut self, token: &Token) {
        let what = self.describe(token);
        let diagnostic =
            Diagnostic::new(Code::NotSupportedYet, format!("{what} is not simulated yet"))
                .at(token.span, "the scene is rendered without it");
        self.report(&token.here, diagnostic.as_warning());
    }
}
