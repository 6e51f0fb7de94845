//! Patterned textures, whose parts are textures in a `texture_map` or after the pattern.
//!
//! **In:** the pattern items of a `texture`, and items beside them. **Out:** the mistakes in them; such
//! textures are unsupported.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.7.3 "Texture Maps", and what the program refuses.

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::pigment::colors_of;
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::value::{Poison, Value};
use crate::evaluate::{Evaluator, Outcome, Reported};
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
    parts: bool,
    /// A mistake has been reported: further ones count as the same.
    told: bool,
}

impl Evaluator<'_> {
    /// Reads an item that is a pattern, or is beside one; `None` for an item of any texture.
    pub(super) fn patterned_item(
        &mut self,
        token: &Token,
        word: Word,
        written: &mut Written,
    ) -> Option<Outcome<()>> {
        match word {
            Word::ImageMap | Word::BumpMap => Some(self.picture_in_texture(token, word)),
            // A block of two textures.
            Word::Tiles | Word::Tile2 => {
                self.pass_not_built(token, word);
                self.set_poison(Poison::new(word, token.here.site(token.span)));
                Some(Ok(()))
            }
            _ if word.family() == Family::Pattern => {
                Some(self.pattern_of_textures(token, word, written))
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
                    // It belongs to its pattern.
                    None => {
                        self.pass_not_built(token, word);
                        Some(Ok(()))
                    }
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
        self.forget_pattern(*pattern);
        let name = pattern.name();
        let message = format!("a texture of the pattern `{name}` lacks its `texture_map`");
        let diagnostic = Diagnostic::new(Code::MissingPart, message)
            .at(opener.span, "a pattern of textures: which?")
            .help(format!(
                "a pattern of colours stands in a pigment: `pigment {{ {name} … color_map {{ … }} }}`"
            ));
        Err(self.report(&opener.here, diagnostic))
    }

    /// Discards the poison of a pattern that was not meant as a pattern of textures.
    fn forget_pattern(&mut self, pattern: Word) {
        self.poison = self.poison.filter(|poison| poison.word != pattern);
    }

    fn pattern_of_textures(
        &mut self,
        token: &Token,
        pattern: Word,
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
        let outer = self.poison.take();
        match colors_of(pattern).filter(|_| pattern != Word::Object) {
            Some(count) => self.list_of_textures(token, (pattern, count), written),
            None => self.pass_not_built(token, pattern),
        }
        self.poison = outer;
        if !written.told {
            self.set_poison(Poison::new(pattern, token.here.site(token.span)));
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
        for _ in 0..count {
            self.skip_commas();
            let Some(next) = self.next_texture() else { break };
            written.parts = true;
            let _: Outcome<_> = self.one_texture(&next);
        }
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
            self.forget_pattern(*pattern);
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
        let outer = self.poison.take();
        match word {
            Word::Pigment => drop(self.pigment(token)),
            Word::Finish => drop(self.finish(token)),
            _ => self.pass_not_built(token, word),
        }
        self.poison = outer;
        if std::mem::replace(&mut written.told, true) {
            return Err(Reported);
        }
        self.forget_pattern(pattern);
        let (name, other) = (pattern.name(), word.name());
        let message = format!("a texture of the pattern `{name}` has no `{other}` of its own");
        let diagnostic = Diagnostic::new(Code::ExtraPart, message)
            .at(token.span, "expected textures for the pattern")
            .also(opener.span, "here this is a pattern of textures")
            .help(format!(
                "colours: `pigment {{ {name} color_map {{ … }} }}`; textures: `{name} texture_map {{ … }}`"
            ));
        Err(self.report(&token.here, diagnostic))
    }

    /// Reports an image in a texture: `texture { image_map { … } }`.
    fn picture_in_texture(&mut self, token: &Token, word: Word) -> Outcome<()> {
        let outer = self.poison.take();
        self.pass_not_built(token, word);
        self.poison = outer;
        self.set_poison(Poison::new(word, token.here.site(token.span)));
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
