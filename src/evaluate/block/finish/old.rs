//! Items of a finish that belong to an old version of the language: `reflection_exponent`,
//! `refraction` and `caustics`.

use crate::color::Rgb;
use crate::evaluate::block::finish::OpenFinish;
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::{Evaluator, Outcome};
use crate::scene::{ClassicFinish, Finish, Reflection};
use crate::syntax::ast::ExpressionKind;
use crate::vocabulary::Word;

impl Evaluator<'_> {
    /// Reads a literal number that is `crand`, in a texture of the oldest versions.
    pub(in crate::evaluate::block) fn bare_crand(&mut self, token: &Token, open: &mut OpenFinish) {
        let TokenKind::Expression(id) = token.kind else { return };
        let ExpressionKind::Number(number) = token.here.unit.expression(id).kind else { return };
        if let Finish::Classic(classic) = &mut open.finish {
            classic.crand = number;
            open.written.classic.get_or_insert((Word::Crand, token.span));
        }
    }

    /// Reads `reflection_exponent`, before or after the `reflection`, `refraction` or `caustics`.
    pub(super) fn old_item(
        &mut self,
        token: &Token,
        word: Word,
        finish: &mut ClassicFinish,
    ) -> Outcome<()> {
        match word {
            Word::ReflectionExponent => {
                let exponent = self.exponent(token)?;
                let black = Reflection {
                    maximum: Rgb::BLACK,
                    minimum: Rgb::BLACK,
                    falloff: 1.0,
                    fresnel: false,
                    exponent,
                    metallic: 0.0,
                };
                finish.reflection.get_or_insert(black).exponent = exponent;
            }
            Word::Caustics => {
                finish.caustics = Some(self.number_after(token, "a number")?.value);
            }
            _ => finish.refraction = self.number_after(token, "a number")?.value,
        }
        Ok(())
    }
}
