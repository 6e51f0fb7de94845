//! Keywords that do not affect the image: they are read, the kinds of their arguments are checked, and they
//! are discarded.
//!
//! **In:** a word that the vocabulary calls inert. **Out:** only the mistakes in it. **Invariant:** neither
//! its contents nor poison in them reach the scene.

use crate::diagnostic::{Code, Diagnostic};
use crate::vocabulary::{Dialect, Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome};
use super::Place;

impl Evaluator<'_> {
    /// Reads an inert keyword and its arguments; `None` if `token` is not one that is valid here.
    pub(super) fn inert(&mut self, token: &Token, place: Place) -> Option<Outcome<()>> {
        let TokenKind::Word(word) = token.kind else { return None };
        if !word.is_inert() || !place.holds(word) {
            return None;
        }
        let outer = self.poison.take();
        let outcome = self.inert_arguments(token, word);
        let poison = std::mem::replace(&mut self.poison, outer);
        Some(if poison.is_some() { Ok(()) } else { outcome })
    }

    fn inert_arguments(&mut self, token: &Token, word: Word) -> Outcome<()> {
        match word {
            Word::BoundedBy => self.bounds(token),
            Word::QuickColor => self.color_after(token, "a colour").map(drop),
            Word::Charset => {
                let known = [Word::Ascii, Word::Utf8, Word::Sys];
                let given = known.into_iter().find(|word| self.take_word(*word).is_some());
                if let Some(word) = given {
                    self.is_ascii = word == Word::Ascii;
                    return Ok(());
                }
                let is_value =
                    matches!(self.peek(), Some(Token { kind: TokenKind::Expression(_), .. }));
                let next = if is_value { self.next() } else { None };
                let at = token.span.after();
                Err(self.expected("`ascii`, `utf8` or `sys`", next.as_ref(), (&token.here, at)))
            }
            Word::AllIntersections => Ok(()),
            Word::Evaluate => {
                let wanted = ["a least slope", "a factor", "an attenuation"];
                wanted.iter().try_for_each(|wanted| self.number_after(token, wanted).map(drop))
            }
            Word::Precompute => {
                self.number_after(token, "a depth")?;
                self.skip_values();
                Ok(())
            }
            Word::Hierarchy
            | Word::SplitUnion
            | Word::Sturm
            | Word::NoRadiosity
            | Word::HfGray16 => self.optional_flag(token).map(drop),
            _ => {
                let given = self.number_after(token, "a number")?;
                self.within_bounds(&given, word);
                Ok(())
            }
        }
    }

    /// Reads a colour beside the pigment of an object, which POV-Ray 3.7 ignores (measured): `sphere { 0, 1
    /// color Red }`.
    pub(super) fn quick_color(&mut self, token: &Token) -> Option<Outcome<()>> {
        let is_color = match token.kind {
            TokenKind::Word(word) => word.family() == Family::Color,
            TokenKind::Expression(id) => {
                matches!(self.named(&token.here, id), Some(Value::Color(_)))
            }
            _ => false,
        };
        if self.options.dialect == Dialect::Scene || !is_color || self.peeked.is_some() {
            return None;
        }
        self.peeked = Some(token.clone());
        let color = match self.color_after(token, "a colour") {
            Ok(color) => color,
            Err(reported) => return Some(Err(reported)),
        };
        let message = "a colour stands in an object, outside of its pigment";
        let diagnostic = Diagnostic::new(Code::ExtraPart, message)
            .at(color.span, "it has no effect")
            .help("the colour of an object stands in its pigment: `pigment { color … }`");
        Some(self.opinion(&token.here, diagnostic))
    }
}
