//! `texture`, and the default texture of `#default`.

mod bare;
mod pattern;

use crate::scene::{Texture, TextureId};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::value::{Poison, Value};
use super::super::{Evaluator, Outcome, Reported};
use super::Place;
use bare::Bare;
use pattern::Written;

impl Evaluator<'_> {
    /// Reads `texture { [Name] … }`, starting from the default texture.
    pub(super) fn texture(&mut self, token: &Token) -> Outcome<TextureId> {
        let texture = self.one_texture(token);
        // Several in a row are layers, which are unsupported.
        while let Some(Token { kind: TokenKind::Word(Word::Texture), .. }) = self.peek_on()
            && let Some(next) = self.next()
        {
            // Each is read for its own mistakes.
            let outer = self.poison.take();
            let _: Outcome<Texture> = self.one_texture(&next);
            self.poison = outer;
            self.set_poison(Poison::new(Word::Texture, next.here.site(next.span)));
        }
        Ok(self.add_texture(texture?))
    }

    /// As [`Self::texture`], where textures that follow are not layers of it.
    pub(super) fn one_texture(&mut self, token: &Token) -> Outcome<Texture> {
        let mut texture = self.scene.textures[self.default_texture.index()].clone();
        self.block(token, Word::Texture, |evaluator| {
            let mut failed = false;
            let (mut written, mut bare) = (Written::default(), Bare::default());
            while let Some(token) = evaluator.next() {
                let item = evaluator.texture_item(&token, &mut texture, (&mut written, &mut bare));
                failed |= item == Err(Reported);
            }
            failed |= evaluator.close_bare(&mut texture, &mut bare) == Err(Reported);
            failed |= evaluator.whole_texture(&written) == Err(Reported);
            if failed { Err(Reported) } else { Ok(texture) }
        })
    }

    pub(super) fn add_texture(&mut self, texture: Texture) -> TextureId {
        let lists = 2 * size_of_val(&texture.transforms[..]);
        self.stored += (size_of::<Texture>() + lists) as u64;
        self.scene.textures.push(texture);
        TextureId(self.scene.textures.len() as u32 - 1)
    }

    fn texture_item(
        &mut self,
        token: &Token,
        texture: &mut Texture,
        (written, bare): (&mut Written, &mut Bare),
    ) -> Outcome<()> {
        if let Some(transform) = self.transform_from(token) {
            texture.transforms.push(transform?);
            return Ok(());
        }
        if self.bare_item(token, texture, bare).is_some() {
            return Ok(());
        }
        self.close_bare(texture, bare)?;
        if let TokenKind::Word(word) = token.kind
            && let Some(outcome) = self.patterned_item(token, word, written)
        {
            return outcome;
        }
        match token.kind {
            TokenKind::Word(Word::Pigment) => {
                let site = token.here.site(token.span);
                if let Some(first) = written.painted.replace(site)
                    && first.expansion == site.expansion
                    && self.begins_with_color()
                {
                    self.lint_replaced(token, first, "texture");
                }
                texture.pigment = self.pigment_from(token, texture.pigment)?
            }
            TokenKind::Word(Word::Finish) => {
                texture.finish = self.finish_from(token, texture.finish)?
            }
            TokenKind::Expression(id) => match self.declared(token, id) {
                Some(Value::Broken) => {
                    self.broken_of_place(token, id, Place::TEXTURE);
                    return Err(Reported);
                }
                Some(Value::Texture(id)) => *texture = self.scene.textures[id.index()].clone(),
                // As in POV-Ray, their keywords are optional here.
                Some(Value::Pigment(id)) => texture.pigment = id,
                Some(Value::Finish(id)) => texture.finish = id,
                Some(Value::Poison(poison)) => {
                    self.is_of_place(token, poison, Place::TEXTURE);
                    self.set_poison(poison);
                }
                _ => {
                    self.unexpected(token, Place::TEXTURE);
                    return Err(Reported);
                }
            },
            _ => {
                if let Some(outcome) = self.inert(token, Place::TEXTURE) {
                    return outcome;
                }
                let poisoned = self.poison.is_some();
                self.unexpected(token, Place::TEXTURE);
                let harmless = matches!(token.kind, TokenKind::Comma | TokenKind::Semicolon);
                if !harmless && !poisoned && self.poison.is_none() {
                    return Err(Reported);
                }
            }
        }
        Ok(())
    }

    /// Reads the items of `#default { … }`, which apply to objects without a texture.
    pub(in crate::evaluate) fn default_items(&mut self) {
        let outer = self.poison.take();
        while let Some(token) = self.next() {
            let finishes = self.scene.finishes.len();
            let changed = match token.kind {
                TokenKind::Word(Word::Texture) => {
                    let texture = self.texture(&token);
                    self.forget_words_of_finishes(finishes);
                    texture
                }
                TokenKind::Word(Word::Pigment) => {
                    let mut texture = self.scene.textures[self.default_texture.index()].clone();
                    self.pigment(&token).map(|pigment| {
                        texture.pigment = pigment;
                        self.add_texture(texture)
                    })
                }
                TokenKind::Word(Word::Finish) => {
                    let mut texture = self.scene.textures[self.default_texture.index()].clone();
                    let finish = self.finish(&token);
                    self.forget_words_of_finishes(finishes);
                    finish.map(|finish| {
                        texture.finish = finish;
                        self.add_texture(texture)
                    })
                }
                _ => {
                    self.unexpected(&token, Place::DEFAULT);
                    continue;
                }
            };
            if let Ok(texture) = changed {
                self.default_texture = texture;
            }
        }
        let poison = std::mem::replace(&mut self.poison, outer);
        if let Some(poison) = poison {
            let Reported = self.not_supported(poison, None);
        }
    }
}
