//! Patterned textures, whose parts are textures in a `texture_map` or after the pattern.
//!
//! **In:** the pattern items of a `texture`, and items beside them. **Out:** the pattern and its textures, and
//! the mistakes in them.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.7.3 "Texture Maps", and what the program refuses.

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::pattern::OpenPattern;
use crate::evaluate::block::pigment::colors_of;
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Outcome, Reported};
use crate::scene::TextureId;
use crate::source::{Site, Span};
use crate::vocabulary::{Family, Word};

/// The mutually exclusive items of one block.
#[derive(Default)]
pub(super) struct Written {
    /// The pattern, and the token that began it.
    pattern: Option<(Word, Token)>,
    /// The first `pigment`, `normal` or `finish`.
    plain: Option<(Word, Site)>,
    /// The last `pigment`.
    pub(super) painted: Option<Site>,
    /// Whether its map, or the textures after it, were present.
    pub(super) parts: bool,
    /// The textures of its map, or after it.
    pub(super) entries: Option<Vec<(f64, TextureId)>>,
    /// A mistake has been reported: further ones count as the same.
    told: bool,
}

impl Evaluator<'_> {
    /// Reads an item that is a pattern, or is beside one; `None` for an item of any texture.
    pub(super) fn patterned_item(
        &mut self,
        token: &Token,
        word: Word,
        open: &mut OpenPattern,
        written: &mut Written,
    ) -> Option<Outcome<()>> {
        match word {
            Word::ImageMap | Word::BumpMap => Some(self.picture_in_texture(token, word)),
            Word::Tiles => Some(self.tiles(token, open, written)),
            Word::Object => {
                let read = self.object_pattern(token, |evaluator, _| {
                    evaluator.list_of_textures(token, (word, 2), written);
                    Ok(())
                });
                Some(read.map(|(source, ())| open.choose(source, self.whole(token))))
            }
            Word::MaterialMap => Some(self.material_map(token, open, written)),
            // `cubic` is first of all a shape.
            _ if word.family() == Family::Pattern || word == Word::Cubic => {
                Some(self.pattern_of_textures(token, word, open, written))
            }
            Word::ColorMap | Word::PigmentMap | Word::NormalMap | Word::SlopeMap => {
                let pattern = written.pattern.clone()?;
                Some(self.map_of_no_textures(token, word, &pattern, written))
            }
            Word::TextureMap => {
                written.parts = true;
                let (pattern, opener) = written.pattern.clone()?;
                match colors_of(pattern) {
                    Some(count) => {
                        Some(self.map_of_list(token, (pattern, count), &opener, written))
                    }
                    None => Some(self.texture_map(token, open, written)),
                }
            }
            Word::Pigment | Word::Normal | Word::Finish => {
                let site = token.here.site(token.span);
                let Some((pattern, opener)) = written.pattern.clone() else {
                    written.plain.get_or_insert((word, site));
                    return None;
                };
                Some(self.plain_behind_pattern(token, word, (pattern, &opener), written))
            }
            _ => None,
        }
    }

    /// Checks that a pattern of textures has textures.
    pub(super) fn whole_texture(&mut self, written: &Written) -> Outcome<()> {
        let Some((pattern, opener)) = &written.pattern else { return Ok(()) };
        if written.parts || written.told || colors_of(*pattern).is_some() {
            return Ok(());
        }
        let name = pattern.name();
        let message = format!("a texture of the pattern `{name}` lacks its `texture_map`");
        let diagnostic = Diagnostic::new(Code::MissingPart, message)
            .at(opener.span, "a pattern of textures: which?")
            .help(format!(
                "a pattern of colours stands in a pigment: `pigment {{ {name} … color_map {{ … }} }}`"
            ));
        Err(self.report(&opener.here, diagnostic))
    }

    fn pattern_of_textures(
        &mut self,
        token: &Token,
        pattern: Word,
        open: &mut OpenPattern,
        written: &mut Written,
    ) -> Outcome<()> {
        let name = pattern.name();
        let before = written.plain.filter(|_| !written.told);
        if let Some((word, site)) = before {
            written.told = true;
            let other = word.name();
            let message =
                format!("the pattern `{name}` stands beside a `{other}` in its `texture`");
            let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                .at(token.span, "a pattern here is one of whole textures")
                .also(site.span, format!("with a `{other}` the texture is a plain one"))
                .help(format!("a pattern of colours stands within `pigment {{ {name} … }}`"));
            self.report(&token.here, diagnostic);
        }
        written.pattern = Some((pattern, token.clone()));
        let source = self.pattern_source(token, pattern);
        let site = self.whole(token);
        if let Some(count) = colors_of(pattern) {
            self.list_of_textures(token, (pattern, count), written);
        }
        if let Some(source) = source {
            open.choose(source?, site);
            self.only_in_normals(token, pattern)?;
        }
        if before.is_some() { Err(Reported) } else { Ok(()) }
    }

    /// Reads `brick texture { … }, texture { … }`.
    fn list_of_textures(
        &mut self,
        token: &Token,
        (pattern, count): (Word, usize),
        written: &mut Written,
    ) {
        let mut textures = Vec::new();
        for _ in 0..count {
            self.skip_commas();
            let Some(next) = self.next_texture() else { break };
            written.parts = true;
            if let Ok(texture) = self.one_texture(&next) {
                textures.push(self.add_texture(texture));
            }
        }
        let black = self.default_texture;
        textures.resize(count, black);
        let entries = textures.into_iter().enumerate();
        written.entries = Some(entries.map(|(at, id)| (at as f64, id)).collect());
        let name = pattern.name();
        let told = match self.peek().cloned() {
            Some(extra) if matches!(extra.kind, TokenKind::Word(Word::Texture)) => {
                let message = format!("`{name}` takes {count} textures, and here is one more");
                Diagnostic::new(Code::ExtraPart, message)
                    .at(extra.span, "one texture too many")
                    .also(token.span, "for this")
                    .help("leave it out")
            }
            Some(color) if self.at_color() => {
                let message = format!("`{name}` in a `texture` takes textures, and no colours");
                Diagnostic::new(Code::WrongType, message)
                    .at(color.span, "expected `texture { … }`")
                    .also(token.span, "for this")
                    .help(format!("of colours: `pigment {{ {name} … }}`"))
            }
            Some(_) | None => return,
        };
        written.told = told.code == Code::WrongType;
        self.report(&token.here, told);
        // Further ones are the same mistake.
        loop {
            self.skip_commas();
            if let Some(extra) = self.next_texture() {
                let _: Outcome<_> = self.one_texture(&extra);
            } else if !self.at_color() || self.color_after(token, "a colour").is_err() {
                return;
            }
        }
    }

    fn next_texture(&mut self) -> Option<Token> {
        let is_texture =
            matches!(self.peek().map(|next| &next.kind), Some(TokenKind::Word(Word::Texture)));
        if is_texture { self.next() } else { None }
    }

    /// Reports a pattern's colours without a pigment around both: `texture { granite color_map { … } }`.
    fn map_of_no_textures(
        &mut self,
        token: &Token,
        map: Word,
        (pattern, opener): &(Word, Token),
        written: &mut Written,
    ) -> Outcome<()> {
        self.skip_arguments(map);
        if std::mem::replace(&mut written.told, true) {
            return Err(Reported);
        }
        let whole = self.whole(token).span;
        let (name, map_name) = (pattern.name(), map.name());
        let message = format!("`{map_name}` cannot stand in `texture`");
        let diagnostic = Diagnostic::new(Code::MisplacedBlock, message)
            .also(opener.span, "here this is a pattern of textures");
        let diagnostic = if self.names_textures(whole) {
            diagnostic
                .at(token.span, "the map of a pattern of textures is a `texture_map`")
                .help("replace it with `texture_map`")
                .fix(token.span, "texture_map")
        } else {
            let outer = if map == Word::NormalMap || map == Word::SlopeMap {
                Word::Normal.name()
            } else {
                Word::Pigment.name()
            };
            let diagnostic = diagnostic
                .at(token.span, format!("it belongs in `{outer} {{ … }}`"))
                .help(format!("write `{outer} {{ {name} … {map_name} {{ … }} }}` around both"));
            match opener.span.file == whole.file && opener.span.end <= whole.start {
                true => diagnostic
                    .fix(Span { end: opener.span.start, ..opener.span }, format!("{outer} {{ "))
                    .fix(whole.after(), " }"),
                false => diagnostic,
            }
        };
        Err(self.report(&token.here, diagnostic))
    }

    /// Returns whether a text names a declared texture.
    fn names_textures(&self, span: Span) -> bool {
        let is_texture = |name: &str| {
            let value = self.scopes.symbol(name).and_then(|symbol| self.scopes.look(symbol));
            match value {
                Some(Value::Texture(_)) => true,
                Some(Value::Poison(poison)) => poison.of == Some(Word::Texture),
                _ => false,
            }
        };
        let text = self.sources.text(span);
        text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(is_texture)
    }

    /// Reports a map for a pattern that takes a list of textures: `brick texture_map { … }`.
    fn map_of_list(
        &mut self,
        token: &Token,
        (pattern, count): (Word, usize),
        opener: &Token,
        written: &mut Written,
    ) -> Outcome<()> {
        self.skip_arguments(Word::TextureMap);
        if std::mem::replace(&mut written.told, true) {
            return Err(Reported);
        }
        let name = pattern.name();
        let message = format!("`{name}` takes {count} textures, and no `texture_map`");
        let diagnostic = Diagnostic::new(Code::ExtraPart, message)
            .at(token.span, format!("its values are {count}, with nothing between them"))
            .also(opener.span, "the pattern")
            .help(format!(
                "write the textures behind it: `{name} texture {{ … }}, texture {{ … }}`"
            ));
        Err(self.report(&token.here, diagnostic))
    }

    /// Reports `texture { gradient y pigment { … } }`.
    fn plain_behind_pattern(
        &mut self,
        token: &Token,
        word: Word,
        (pattern, opener): (Word, &Token),
        written: &mut Written,
    ) -> Outcome<()> {
        if std::mem::replace(&mut written.told, true) {
            self.pass_part(token, word);
            return Err(Reported);
        }
        Err(self.part_of_pattern(token, word, (pattern.name(), opener.span)))
    }

    /// Reports a `pigment`, `normal` or `finish` for a pattern of textures, at `opener`.
    pub(super) fn part_of_pattern(
        &mut self,
        token: &Token,
        word: Word,
        (pattern, opener): (&str, Span),
    ) -> Reported {
        self.pass_part(token, word);
        let part = word.name();
        let message = format!("a texture of the pattern `{pattern}` has no `{part}` of its own");
        let diagnostic = Diagnostic::new(Code::ExtraPart, message)
            .at(token.span, "expected textures for the pattern")
            .also(opener, "here this is a pattern of textures")
            .help(format!(
                "colours: `pigment {{ {pattern} color_map {{ … }} }}`; textures: `{pattern} texture_map {{ … }}`"
            ));
        self.report(&token.here, diagnostic)
    }

    /// Reads a part for its mistakes.
    fn pass_part(&mut self, token: &Token, word: Word) {
        let outer = self.poison.take();
        match word {
            Word::Pigment => drop(self.pigment(token)),
            Word::Normal => drop(self.normal(token)),
            _ => drop(self.finish(token)),
        }
        self.poison = outer;
    }

    /// Reports an image in a texture: `texture { image_map { … } }`.
    fn picture_in_texture(&mut self, token: &Token, word: Word) -> Outcome<()> {
        let _: Outcome<_> = self.image(token, word);
        let whole = self.whole(token).span;
        let home = if word == Word::BumpMap { Word::Normal.name() } else { Word::Pigment.name() };
        let name = word.name();
        let diagnostic =
            Diagnostic::new(Code::MisplacedBlock, format!("`{name}` cannot stand in `texture`"))
                .at(token.span, format!("it belongs in `{home} {{ … }}`"))
                .help(format!("write `{home} {{ {name} {{ … }} }}`"))
                .fix(Span { end: whole.start, ..whole }, format!("{home} {{ "))
                .fix(whole.after(), " }");
        Err(self.report(&token.here, diagnostic))
    }
}
