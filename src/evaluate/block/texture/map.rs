//! Maps of textures: `texture_map`, `material_map` and the old `tiles`.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::blend_map::Entry;
use crate::evaluate::block::pattern::{OpenPattern, kind_of};
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Outcome};
use crate::scene::{Source, TextureId};
use crate::vocabulary::{Family, Word};

use super::pattern::Written;

impl Evaluator<'_> {
    /// Reads `texture_map { [value texture] … }`.
    pub(super) fn texture_map(
        &mut self,
        token: &Token,
        open: &OpenPattern,
        written: &mut Written,
    ) -> Outcome<()> {
        let average = open.close().is_some_and(|pattern| pattern.source == Source::Average);
        let entries = self.entries_of(token, Word::TextureMap, average)?.into_iter();
        let texture = |(value, entry)| match entry {
            Entry::Texture(id) => Some((value, id)),
            _ => None,
        };
        written.entries = Some(entries.filter_map(texture).collect());
        Ok(())
    }

    /// Reads `tiles { texture { … } tile2 texture { … } }`, the old form of a `checker` of textures: the second is
    /// where that has its first (measured on POV-Ray 3.7).
    pub(super) fn tiles(
        &mut self,
        token: &Token,
        open: &mut OpenPattern,
        written: &mut Written,
    ) -> Outcome<()> {
        let textures = self.block(token, Word::Tiles, |evaluator| {
            let mut textures = Vec::new();
            while let Some(token) = evaluator.next() {
                match token.kind {
                    TokenKind::Word(Word::Texture) => {
                        let texture = evaluator.one_texture(&token)?;
                        textures.push(evaluator.add_texture(texture));
                    }
                    TokenKind::Word(Word::Tile2) | TokenKind::Comma => {}
                    _ => {
                        let wanted = "`texture { … }` or `tile2`";
                        let at = (&token.here, token.span);
                        return Err(evaluator.expected(wanted, Some(&token), at));
                    }
                }
            }
            Ok(textures)
        })?;
        let mut textures = textures;
        textures.resize(2, self.default_texture);
        textures.reverse();
        let entries = textures.into_iter().enumerate();
        written.entries = Some(entries.map(|(at, id)| (at as f64, id)).collect());
        written.parts = true;
        if let Some(kind) = kind_of(Word::Checker) {
            open.choose(Source::Kind(kind), self.whole(token));
        }
        Ok(())
    }

    /// Reads the items of a texture up to the end of an entry.
    pub(in crate::evaluate::block) fn texture_of_entry(&mut self) -> Outcome<TextureId> {
        self.color_for_texture()?;
        let texture = self.texture_of_items()?;
        Ok(self.add_texture(texture))
    }

    /// Reads `material_map { "picture" … texture { … } … }`.
    pub(super) fn material_map(
        &mut self,
        token: &Token,
        open: &mut OpenPattern,
        written: &mut Written,
    ) -> Outcome<()> {
        let (mut image, textures) = self.image_of_textures(token)?;
        image.source = crate::texture::image::Source::Material;
        let entries = textures.into_iter().enumerate();
        written.entries = Some(entries.map(|(at, id)| (at as f64, id)).collect());
        written.parts = true;
        open.choose(Source::Material(Arc::new(image)), self.whole(token));
        Ok(())
    }

    /// Reports a colour in a `texture_map`, where a texture is expected: `[0.5 color Red]`.
    fn color_for_texture(&mut self) -> Outcome<()> {
        self.skip_commas();
        let Some(first) = self.peek().cloned() else { return Ok(()) };
        let is_color = match first.kind {
            TokenKind::Word(word) => word.family() == Family::Color,
            TokenKind::Expression(id) => {
                matches!(self.named(&first.here, id), Some(Value::Color(_)))
            }
            _ => false,
        };
        if !is_color {
            return Ok(());
        }
        let outer = self.poison.take();
        let read: Outcome<()> = self.color_after(&first, "a colour").map(drop);
        self.poison = outer;
        read?;
        let whole = self.whole(&first);
        let text = self.sources.text(whole.span).to_owned();
        let right = format!("pigment {{ {text} }}");
        let message = "an entry of a `texture_map` is a texture, and no colour";
        let diagnostic = Diagnostic::new(Code::WrongType, message)
            .at(whole.span, "expected a texture, or what is in one")
            .help(format!("write `{right}`"))
            .fix(whole.span, right);
        Err(self.report(&first.here, diagnostic))
    }
}
