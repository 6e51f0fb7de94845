//! `reflection` in a finish.

use crate::color::Rgb;
use crate::evaluate::block::Place;
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::{Evaluator, Outcome};
use crate::scene::Reflection;
use crate::vocabulary::Word;

impl Evaluator<'_> {
    /// `reflection 0.5`, `reflection rgb <…>` or `reflection { [min,] max … }`. What a finish had
    /// `before` says how its reflection behaves until it is said again, as in POV-Ray.
    pub(super) fn reflection(
        &mut self,
        token: &Token,
        before: Option<Reflection>,
    ) -> Outcome<Reflection> {
        let plain = |color: Rgb| {
            let (falloff, exponent, metallic) =
                before.as_ref().map_or((1.0, 1.0, 0.0), |r| (r.falloff, r.exponent, r.metallic));
            let fresnel = before.as_ref().is_some_and(|r| r.fresnel);
            Reflection { minimum: color, maximum: color, falloff, fresnel, exponent, metallic }
        };
        if !matches!(self.peek(), Some(Token { kind: TokenKind::Block(_), .. })) {
            return Ok(plain(self.intensity_after(token)?.value));
        }
        let opener = token.clone();
        self.block(token, Word::Reflection, |evaluator| {
            let least = evaluator.intensity_after(&opener)?;
            let mut reflection = plain(least.value);
            evaluator.skip_commas();
            let both = evaluator.at_color();
            if both {
                let most = evaluator.intensity_after(&opener)?;
                evaluator.lint_reflection_order(&least, &most);
                reflection.maximum = most.value;
            }
            while let Some(token) = evaluator.next() {
                match token.kind {
                    TokenKind::Word(Word::Falloff) => {
                        reflection.falloff = evaluator.at_least_zero(&token, Word::Falloff)?;
                    }
                    TokenKind::Word(Word::Exponent) => {
                        reflection.exponent = evaluator.more_than_zero(&token, Word::Exponent)?;
                    }
                    TokenKind::Word(Word::Metallic) => {
                        reflection.metallic = evaluator.optional_number(&token, 1.0)?;
                    }
                    TokenKind::Word(Word::Fresnel) => {
                        reflection.fresnel = evaluator.optional_flag(&token)?;
                    }
                    _ => evaluator.unexpected(&token, Place::REFLECTION),
                }
            }
            // With one colour only, nothing is the least (measured on POV-Ray 3.7).
            if reflection.fresnel && !both {
                reflection.minimum = Rgb::BLACK;
            }
            Ok(reflection)
        })
    }
}
