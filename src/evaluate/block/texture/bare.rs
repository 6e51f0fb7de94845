//! Textures of versions before 3.0, in which the items of pigment, normal and finish appear without blocks.
//!
//! **In:** an item of a `texture`, in a `.pov` of such a version. **Out:** the pigment, the normal and
//! the finish formed by such items.
//!
//! **Source:** the output of POV-Ray 3.7, compared with that of the same items in their blocks.

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::finish::OpenFinish;
use crate::evaluate::block::normal::OpenNormal;
use crate::evaluate::block::pigment::OpenPigment;
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Outcome};
use crate::scene::Texture;
use crate::syntax::ast::ExpressionKind;
use crate::vocabulary::{Dialect, Family, Word};

use super::OpenTexture;

/// The version from which a texture accepts only blocks.
const BLOCKS_SINCE: f64 = 3.0;

/// The parts of a texture whose items appear directly in it, during reading.
#[derive(Default)]
pub(super) struct Bare {
    pigment: Option<OpenPigment>,
    /// With the item that began it.
    normal: Option<(OpenNormal, Token)>,
    finish: Option<OpenFinish>,
}

impl Evaluator<'_> {
    /// Reads an item that later versions accept only in a block of the texture; `None` for other items.
    pub(super) fn bare_item(
        &mut self,
        token: &Token,
        whole: &mut OpenTexture,
        bare: &mut Bare,
    ) -> Option<()> {
        if self.options.dialect != Dialect::Pov || !self.is_before(BLOCKS_SINCE) {
            return None;
        }
        let block = self.block_of(token)?;
        // A scene of that time is full of them: only the first is reported.
        if !std::mem::replace(&mut self.has_bare_textures, true) {
            let name = self.sources.text(token.span);
            let message = format!("`{name}` has no meaning in `texture` since version 3.0");
            let read = match block {
                Word::Crand => "it is read as a finish's `crand`".to_owned(),
                _ => format!("it is read as in `{} {{ … }}`", block.name()),
            };
            let diagnostic = Diagnostic::new(Code::UnknownWord, message)
                .at(token.span, read)
                .help("write the words of a texture in `pigment`, `normal` and `finish`");
            let _: Outcome<()> = self.opinion(&token.here, diagnostic);
        }
        whole.move_parts();
        self.settle(&mut whole.texture);
        let texture = &whole.texture;
        match block {
            Word::Pigment => {
                let open = bare.pigment.take();
                let mut open =
                    open.unwrap_or_else(|| self.open_pigment(token, texture.kind.first_pigment()));
                open.begin_anew();
                self.item_of_pigment(token, &mut open);
                bare.pigment = Some(open);
            }
            Word::Finish => {
                let open = bare.finish.take();
                let mut open =
                    open.unwrap_or_else(|| self.open_finish(token, texture.kind.first_finish()));
                self.item_of_finish(token, &mut open);
                bare.finish = Some(open);
            }
            Word::Crand => {
                let open = bare.finish.take();
                let mut open =
                    open.unwrap_or_else(|| self.open_finish(token, texture.kind.first_finish()));
                self.bare_crand(token, &mut open);
                bare.finish = Some(open);
            }
            _ => {
                let (mut open, opener) = bare.normal.take().unwrap_or_else(|| {
                    (self.open_normal(token, texture.kind.first_normal()), token.clone())
                });
                self.item_of_normal(token, &mut open);
                bare.normal = Some((open, opener));
            }
        }
        Some(())
    }

    /// Assigns the parts read so far to the texture. A transform moves those and none that follow.
    pub(super) fn close_bare(&mut self, texture: &mut Texture, bare: &mut Bare) -> Outcome<()> {
        let pigment = bare.pigment.take().map(|open| self.close_pigment(open)).transpose();
        let finish = bare.finish.take().map(|open| self.close_finish(open)).transpose();
        let normal = bare.normal.take();
        let normal =
            normal.map(|(open, opener)| self.close_normal(&opener, open, true)).transpose();
        if let Some(finish) = finish? {
            texture.set_finish(finish);
        }
        if let Some(normal) = normal? {
            texture.set_normal(normal);
        }
        if let Some(pigment) = pigment? {
            texture.set_pigment(pigment);
        }
        Ok(())
    }

    /// Returns the block to which an item of a texture belongs; `crand` for a number, which is its value.
    fn block_of(&mut self, token: &Token) -> Option<Word> {
        match token.kind {
            TokenKind::Word(word) => match word {
                Word::Bumps | Word::Dents | Word::Ripples | Word::Waves | Word::Wrinkles => {
                    Some(Word::Normal)
                }
                Word::BumpMap | Word::NormalMap => Some(Word::Normal),
                Word::ColorMap | Word::ImageMap | Word::QuickColor => Some(Word::Pigment),
                Word::Ior => Some(Word::Finish),
                // The pattern of the pigment has none in such a texture (measured).
                Word::Frequency | Word::Phase => Some(Word::Normal),
                // Of whole textures.
                Word::Tiles | Word::Tile2 => None,
                Word::Checker if self.is_before_texture() => None,
                _ => match word.family() {
                    Family::Color | Family::Pattern | Family::PatternItem => Some(Word::Pigment),
                    Family::FinishItem => Some(Word::Finish),
                    _ => None,
                },
            },
            TokenKind::Expression(id) => {
                if let ExpressionKind::Number(number) = token.here.unit.expression(id).kind {
                    return (number != 0.0).then_some(Word::Crand);
                }
                let value = self.named(&token.here, id)?;
                matches!(value, Value::Color(_) | Value::Vector(_)).then_some(Word::Pigment)
            }
            _ => None,
        }
    }

    fn is_before_texture(&mut self) -> bool {
        matches!(self.peek(), Some(Token { kind: TokenKind::Word(Word::Texture), .. }))
    }
}
