//! `texture`, and the default texture of `#default`.

mod bare;
mod map;
mod part;
mod pattern;

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Step, Texture, TextureId, TextureKind};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::Place;
use super::pattern::OpenPattern;
use bare::Bare;
use pattern::Written;

/// A texture during reading.
pub(super) struct OpenTexture {
    texture: Texture,
    pattern: OpenPattern,
    written: Written,
}

impl OpenTexture {
    /// Goes on from a declared texture.
    fn inherit(&mut self, texture: Texture) {
        let (pattern, steps) = match &texture.kind {
            TextureKind::Blend { pattern, steps, .. } => (Some(&**pattern), &steps[..]),
            TextureKind::Plain { .. } | TextureKind::Layers(_) => (None, &[][..]),
        };
        self.pattern.inherit(pattern, steps);
        let uv_mapping = self.texture.uv_mapping || texture.uv_mapping;
        self.texture = Texture { uv_mapping, ..texture };
    }

    /// Moves the parts that are there already by the transforms so far, which move none that follows.
    fn move_parts(&mut self) {
        let Self { texture, pattern, .. } = self;
        if matches!(texture.kind, TextureKind::Blend { .. }) || pattern.chosen.is_some() {
            return;
        }
        let since = std::mem::take(&mut pattern.steps);
        texture.transforms.extend(since.iter().filter_map(|step| match step {
            Step::Transform(id) => Some(*id),
            Step::Warp(_) => None,
        }));
    }

    fn close(self) -> Texture {
        let Self { mut texture, pattern: open, mut written } = self;
        let entries = match (written.entries.take(), &texture.kind) {
            (None, TextureKind::Blend { entries, .. }) => Some(entries.clone()),
            (entries, _) => entries,
        };
        if let (Some(pattern), Some(entries)) = (open.close(), entries) {
            // The transforms of a declared pattern are inside of its own.
            let own = texture.transforms.into_iter().map(Step::Transform);
            let inherited = open.inherited_steps;
            let mut steps = open.steps[..inherited].to_vec();
            steps.extend(own);
            steps.extend(&open.steps[inherited..]);
            let kind = TextureKind::Blend { pattern: Box::new(pattern), steps, entries };
            return Texture { kind, transforms: Vec::new(), uv_mapping: false };
        }
        texture.transforms.extend(open.steps.iter().filter_map(|step| match step {
            Step::Transform(id) => Some(*id),
            Step::Warp(_) => None,
        }));
        texture
    }
}

impl Evaluator<'_> {
    /// Reads `texture { [Name] … }`, starting from the default texture; several in a row are layers.
    pub(super) fn texture(&mut self, token: &Token) -> Outcome<TextureId> {
        self.layers_of(Word::Texture, token)
    }

    /// As [`Self::texture`], for blocks that `word` opens.
    pub(super) fn layers_of(&mut self, word: Word, token: &Token) -> Outcome<TextureId> {
        let first = self.one_texture(token).map(|texture| self.add_texture(texture));
        let mut layers = vec![first];
        while let Some(Token { kind: TokenKind::Word(next), .. }) = self.peek_on()
            && *next == word
            && let Some(next) = self.next()
        {
            // Each is read for its own mistakes.
            let outer = self.poison.take();
            let layer = self.one_texture(&next);
            let inner = std::mem::replace(&mut self.poison, outer);
            inner.into_iter().for_each(|poison| self.set_poison(poison));
            layers.push(layer.map(|texture| self.add_texture(texture)));
        }
        let layers = layers.into_iter().collect::<Outcome<Vec<_>>>()?;
        match layers[..] {
            [only] => Ok(only),
            _ => {
                let kind = TextureKind::Layers(layers);
                Ok(self.add_texture(Texture { kind, transforms: Vec::new(), uv_mapping: false }))
            }
        }
    }

    /// As [`Self::texture`], where textures that follow are not layers of it.
    pub(super) fn one_texture(&mut self, token: &Token) -> Outcome<Texture> {
        self.block(token, Word::Texture, Self::texture_of_items)
    }

    /// Reads the items of a texture, up to the end of its block or entry.
    pub(super) fn texture_of_items(&mut self) -> Outcome<Texture> {
        let mut open = OpenTexture {
            texture: self.scene.textures[self.default_texture.index()].clone(),
            pattern: OpenPattern::new(self.noise, self.waves),
            written: Written::default(),
        };
        let (mut failed, mut bare) = (false, Bare::default());
        while let Some(token) = self.next() {
            failed |= self.texture_item(&token, &mut open, &mut bare) == Err(Reported);
        }
        failed |= self.close_bare(&mut open.texture, &mut bare) == Err(Reported);
        failed |= self.whole_texture(&open.written) == Err(Reported);
        if failed { Err(Reported) } else { Ok(open.close()) }
    }

    /// Returns a texture whose points are the surface's own coordinates.
    ///
    /// **Source:** measured on POV-Ray 3.7: `uv_mapping` before the texture of an object is as in each of its
    /// layers.
    pub(super) fn mapped(&mut self, id: TextureId) -> TextureId {
        let mut texture = self.scene.textures[id.index()].clone();
        texture.uv_mapping = true;
        match &mut texture.kind {
            TextureKind::Plain { .. } => {}
            TextureKind::Blend { pattern, .. } => pattern.modifiers.uv_mapping = true,
            TextureKind::Layers(layers) => {
                for layer in layers {
                    // Layers have none of their own.
                    let mut mapped = self.scene.textures[layer.index()].clone();
                    mapped.uv_mapping = true;
                    *layer = self.add_texture(mapped);
                }
            }
        }
        self.add_texture(texture)
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
        open: &mut OpenTexture,
        bare: &mut Bare,
    ) -> Outcome<()> {
        if let Some(transform) = self.transform_from(token) {
            self.close_bare(&mut open.texture, bare)?;
            open.pattern.steps.push(Step::Transform(transform?));
            return Ok(());
        }
        if self.bare_item(token, open, bare).is_some() {
            return Ok(());
        }
        self.close_bare(&mut open.texture, bare)?;
        if let TokenKind::Word(Word::UvMapping) = token.kind {
            open.texture.uv_mapping = true;
            open.pattern.modifiers.uv_mapping = true;
            return Ok(());
        }
        if let TokenKind::Word(word) = token.kind
            && let Some(outcome) =
                self.patterned_item(token, word, &mut open.pattern, &mut open.written)
        {
            return outcome;
        }
        if open.pattern.close().is_some()
            && let Some(read) = self.pattern_item(token, &mut open.pattern)
        {
            return read;
        }
        open.move_parts();
        let OpenTexture { texture, written, .. } = open;
        if let TokenKind::Word(word @ (Word::Pigment | Word::Normal | Word::Finish)) = token.kind
            && let Some(pattern) = self.top_pattern(texture)
        {
            return Err(self.part_of_pattern(token, word, pattern));
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
                let top = self.top_of(texture);
                let pigment = self.pigment_from(token, top.kind.first_pigment())?;
                self.change_top(texture, |top| top.set_pigment(pigment));
            }
            TokenKind::Word(Word::Normal) => {
                let top = self.top_of(texture);
                let normal = self.normal_from(token, top.kind.first_normal())?;
                self.change_top(texture, |top| top.set_normal(normal));
            }
            TokenKind::Word(Word::Finish) => {
                let top = self.top_of(texture);
                let finish = self.finish_from(token, top.kind.first_finish())?;
                self.change_top(texture, |top| top.set_finish(finish));
            }
            TokenKind::Expression(id) => match self.declared_item(token, id, Place::TEXTURE) {
                Err(read) => return read,
                Ok(Some(Value::Texture(id))) => {
                    let texture = self.scene.textures[id.index()].clone();
                    open.inherit(texture);
                }
                // As in POV-Ray, their keywords are optional here.
                Ok(Some(Value::Pigment(id))) => self.change_top(texture, |top| top.set_pigment(id)),
                Ok(Some(Value::Normal(id))) => self.change_top(texture, |top| top.set_normal(id)),
                Ok(Some(Value::Finish(id))) => self.change_top(texture, |top| top.set_finish(id)),
                Ok(_) => return self.other_item(token, Place::TEXTURE),
            },
            _ => return self.other_item(token, Place::TEXTURE),
        }
        Ok(())
    }

    /// Reports a default texture that is a pattern of textures.
    fn is_plain_default(&mut self, token: &Token, texture: &Texture) -> Outcome<()> {
        let Some((name, span)) = self.top_pattern(texture) else { return Ok(()) };
        let message = format!("the default texture is of the pattern `{name}`");
        let diagnostic = Diagnostic::new(Code::ExtraPart, message)
            .at(token.span, "other textures start from its pigment, normal and finish")
            .also(span, "the pattern")
            .help("declare it, and name it in the objects: `texture { Name }`");
        Err(self.report(&token.here, diagnostic))
    }

    /// Reads the items of `#default { … }`, which apply to objects without a texture.
    pub(in crate::evaluate) fn default_items(&mut self) {
        let outer = self.poison.take();
        while let Some(token) = self.next() {
            let finishes = self.scene.finishes.len();
            let mut texture = self.scene.textures[self.default_texture.index()].clone();
            let read = match token.kind {
                // Of several, POV-Ray uses the last (measured).
                TokenKind::Word(Word::Texture) => self.one_texture(&token).and_then(|read| {
                    texture = read;
                    self.is_plain_default(&token, &texture)
                }),
                TokenKind::Word(Word::Pigment) => {
                    self.pigment(&token).map(|pigment| texture.set_pigment(pigment))
                }
                TokenKind::Word(Word::Normal) => {
                    self.normal(&token).map(|normal| texture.set_normal(normal))
                }
                TokenKind::Word(Word::Finish) => {
                    self.finish(&token).map(|finish| texture.set_finish(finish))
                }
                _ => {
                    self.unexpected(&token, Place::DEFAULT);
                    continue;
                }
            };
            self.forget_words_of_finishes(finishes);
            if read.is_ok() {
                self.default_texture = self.add_texture(texture);
            }
        }
        let poison = std::mem::replace(&mut self.poison, outer);
        if let Some(poison) = poison {
            let Reported = self.not_supported(poison, None);
        }
    }
}
