//! `reflection` in a finish.

use crate::color::Rgb;
use crate::evaluate::block::pieces::{WrittenColor, without_light};
use crate::evaluate::block::{Given, Place};
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::{Evaluator, Outcome};
use crate::scene::Reflection;
use crate::source::Site;
use crate::vocabulary::Word;

impl Evaluator<'_> {
    /// `reflection 0.5`, `reflection rgb <…>` or `reflection { [min,] max … }`. What a finish had
    /// `before` says how its reflection behaves until it is said again, as in POV-Ray. Beside it, what can
    /// be taken out for it to be black, where less than all of it is enough.
    pub(super) fn reflection(
        &mut self,
        token: &Token,
        before: Option<Reflection>,
    ) -> Outcome<(Reflection, Option<Vec<Site>>)> {
        let plain = |color: Rgb| {
            let (falloff, exponent, metallic) =
                before.as_ref().map_or((1.0, 1.0, 0.0), |r| (r.falloff, r.exponent, r.metallic));
            let fresnel = before.as_ref().is_some_and(|r| r.fresnel);
            Reflection { minimum: color, maximum: color, falloff, fresnel, exponent, metallic }
        };
        if !matches!(self.peek(), Some(Token { kind: TokenKind::Block(_), .. })) {
            let given = self.written_intensity_after(token)?.value;
            return Ok((plain(given.color().rgb), given.without(|color| color.rgb.is_black())));
        }
        let opener = token.clone();
        self.block(token, Word::Reflection, |evaluator| {
            let light = |given: &Given<WrittenColor>| given.clone().with(given.value.color().rgb);
            let (least, first) = evaluator.end_of_reflection(&opener)?;
            let mut reflection = plain(least.value.color().rgb);
            evaluator.skip_commas();
            let both = evaluator.at_color();
            let mut pieces = least.value.without(|color| color.rgb.is_black());
            if both {
                let (most, second) = evaluator.end_of_reflection(&opener)?;
                evaluator.lint_reflection_order(&light(&least), &light(&most));
                reflection.maximum = most.value.color().rgb;
                pieces = without_light([(&least.value, first), (&most.value, second)]);
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
            Ok((reflection, pieces))
        })
    }

    /// How much is reflected at one end of the angles; all of it as a piece.
    fn end_of_reflection(&mut self, opener: &Token) -> Outcome<(Given<WrittenColor>, Site)> {
        self.skip_commas();
        let first = self.peek().cloned();
        let given = self.written_intensity_after(opener)?;
        let item = self.whole(first.as_ref().unwrap_or(opener));
        Ok((given, item))
    }
}
