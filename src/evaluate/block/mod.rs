//! Blocks: reading the contents of each keyword's braces, with one file for each family.
//!
//! **Invariant:** a mistake in a block costs only that block's object; the items after it are read as usual.

mod bare_object;
mod blend_map;
mod blob;
mod braces;
mod camera;
mod clip;
mod color;
mod color_map;
mod colored;
mod confused_solid;
mod counted;
mod finish;
mod fog;
mod foreign_keyword;
mod foreign_value;
mod height_field;
mod ignored_keyword;
mod image;
mod interior;
mod isosurface;
mod item;
mod item_suggestion;
mod julia_fractal;
mod light;
mod light_group;
mod matrix;
mod mesh;
mod mesh_camera;
mod misplaced;
mod missing;
mod missing_keyword;
mod misspelt;
mod modifier;
mod named;
mod normal;
mod object;
mod outline;
mod part;
mod parts;
mod pattern;
mod pigment;
mod place;
mod polynomial;
mod rainbow;
mod range;
mod rising;
mod settings;
mod sheet;
mod skip;
mod solid;
mod swapped;
mod sweep;
mod text;
mod texture;
mod trailing_item;
mod transform;
mod unbuilt;
mod unexpected;
mod unknown;

pub(super) use color::takes_transmit;
pub(super) use foreign_value::color_of_string;
pub(super) use mesh::MeshFiles;

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{ObjectId, Root};
use crate::source::Span;
use crate::syntax::ast::ExpressionKind;
use crate::vocabulary::{Dialect, Family, Role, Word};

pub(in crate::evaluate) use self::image::Pictures;
pub(in crate::evaluate) use self::pattern::Grids;
use super::stream::{Token, TokenKind};
use super::value::{Poison, Value};
use super::{Evaluator, Here, Outcome, Reported};
pub use blend_map::BlendMap;
pub use color_map::WrittenMap;
pub(in crate::evaluate) use object::Made;
pub(in crate::evaluate) use part::Given;
pub(in crate::evaluate) use place::Place;
pub(in crate::evaluate) use text::Fonts;
pub(in crate::evaluate) use unknown::Unknown;

impl Evaluator<'_> {
    /// Reads the top-level items of the scene.
    pub(super) fn scene_items(&mut self) {
        while let Some(token) = self.next() {
            self.poison = None;
            // Reported where it happened; each item is a fault boundary.
            let _: Outcome<()> = self.scene_item(&token);
        }
    }

    fn scene_item(&mut self, token: &Token) -> Outcome<()> {
        match token.kind {
            TokenKind::Word(Word::Camera) => {
                if let Value::Camera(camera) = self.camera(token)? {
                    self.stored += size_of_val(&camera.items[..]) as u64;
                    self.scene.cameras.push(camera.as_ref().clone());
                    return Ok(());
                }
                self.needs_poison()
            }
            TokenKind::Word(Word::Background) => self.background(token),
            TokenKind::Word(Word::SkySphere) => {
                if let Value::SkySphere(sky) = self.sky_sphere(token)? {
                    self.place_sky(sky.as_ref().clone());
                    return Ok(());
                }
                self.needs_poison()
            }
            TokenKind::Word(Word::Fog) => self.placed_fog(token),
            TokenKind::Word(Word::Rainbow) => self.placed_rainbow(token),
            // After another directive the `#` is optional, as in POV-Ray.
            TokenKind::Word(Word::Default)
                if self.options.dialect == Dialect::Pov
                    && matches!(self.peek(), Some(Token { kind: TokenKind::Block(_), .. })) =>
            {
                self.block(token, Word::Default, |evaluator| {
                    evaluator.default_items();
                    Ok(())
                })
            }
            TokenKind::Word(Word::GlobalSettings) => {
                let read = self.global_settings(token);
                self.needs_poison().and(read)
            }
            TokenKind::Word(Word::MaxTraceLevel | Word::MaxIntersections)
                if self.options.dialect == Dialect::Pov =>
            {
                self.lone_setting(token)
            }
            TokenKind::Word(word) if opens_object(word) => {
                match self.object(token, word)? {
                    Value::Object(object) => self.place(object, token),
                    Value::Poison(poison) => {
                        let from = poison.site.span;
                        let elsewhere =
                            from.file != token.span.file || from.start < token.span.start;
                        return Err(self.not_supported(poison, elsewhere.then_some(token.span)));
                    }
                    _ => {}
                }
                Ok(())
            }
            TokenKind::Expression(id) if self.options.dialect == Dialect::Pov => {
                if let Some(object) = self.lone_object(token, id) {
                    self.place(object, token);
                    return Ok(());
                }
                if !self.changed_object(token, id) {
                    self.unexpected(token, Place::SCENE);
                }
                self.needs_poison()
            }
            _ => {
                self.unexpected(token, Place::SCENE);
                self.needs_poison()
            }
        }
    }

    /// Reports poison at the top level of the scene.
    fn needs_poison(&mut self) -> Outcome<()> {
        match self.poison.take() {
            Some(poison) => Err(self.not_supported(poison, None)),
            None => Ok(()),
        }
    }

    fn place(&mut self, object: ObjectId, token: &Token) {
        self.note_item(object, token);
        self.scene.roots.push(Root { object, default_texture: self.default_texture });
    }

    /// Reads the next value of any kind: a right-hand side or an argument.
    pub(super) fn value_or(&mut self, here: &Here, after: Span) -> Outcome<Value> {
        let Some(token) = self.next() else {
            return Err(self.expected("a value", None, (here, after.after())));
        };
        self.value_of(&token)
    }

    pub(super) fn value_of(&mut self, token: &Token) -> Outcome<Value> {
        let outer = self.poison.take();
        let value = match &token.kind {
            TokenKind::Expression(id) => match self.misspelt_block(token, *id) {
                Some(reported) => Err(reported),
                None => match self.joined_value(token) {
                    Ok(value) => match self.copy_without_word(token, &value) {
                        Some(reported) => Err(reported),
                        None => Ok(value),
                    },
                    outcome => outcome,
                },
            },
            TokenKind::Literal(_) => self.joined_value(token),
            TokenKind::Word(word) => self.word_block(token, *word),
            TokenKind::Block(_) | TokenKind::Entry(_) if self.list_meant(token).is_some() => {
                let help = self.list_meant(token).unwrap_or_default();
                let opener = Span { end: token.span.start + 1, ..token.span };
                let diagnostic =
                    Diagnostic::new(Code::ExpectedExpression, "a list of values is an `array`")
                        .at(opener, "brackets alone make no value")
                        .help(help);
                Err(self.report(&token.here, diagnostic))
            }
            TokenKind::Block(_) if self.objects_meant(token) => Err(self.unjoined(token)),
            TokenKind::Block(_) | TokenKind::Entry(_) | TokenKind::Comma | TokenKind::Semicolon => {
                Err(self.expected("a value", Some(token), (&token.here, token.span)))
            }
        };
        let inner = self.poison.take();
        self.poison = outer;
        // Poison reports nothing by itself; it is reported where its value is needed.
        match inner {
            Some(poison) => Ok(Value::Poison(match token.kind {
                TokenKind::Word(word) => Poison { of: Some(word), ..poison },
                _ => poison,
            })),
            None => value,
        }
    }

    /// Returns the native syntax for a list such as `[1, 2, 3]` or `{ "a", "b" }`.
    fn list_meant(&self, token: &Token) -> Option<String> {
        let text = self.sources.text(token.span);
        let inside = text.get(1..text.len().checked_sub(1)?)?.trim();
        let plain = !inside.is_empty() && !inside.contains(['{', '[', '(', '\n']);
        let mut depth = 0;
        let parts = inside.split(|c| {
            depth += i32::from(c == '<') - i32::from(c == '>');
            c == ',' && depth == 0
        });
        let count = parts.count();
        let numbers = !inside.contains(['<', '"']);
        let vector = match text.starts_with('[') && numbers && (2..=5).contains(&count) {
            true => format!(", or a vector `<{inside}>`"),
            false => String::new(),
        };
        (plain && count > 1).then(|| format!("write `array[{count}] {{ {inside} }}`{vector}"))
    }

    /// Reads a value that a keyword opens: `sphere { … }`, `rgb <…>`, `texture { … }`.
    fn word_block(&mut self, token: &Token, word: Word) -> Outcome<Value> {
        match word {
            Word::Texture => self.texture(token).map(Value::Texture),
            Word::Pigment => self.pigment(token).map(Value::Pigment),
            Word::Normal => self.normal(token).map(Value::Normal),
            Word::Finish => self.finish(token).map(Value::Finish),
            Word::Interior => self.interior(token).map(Value::Interior),
            Word::Material => self.material(token).map(Value::Material),
            Word::ColorMap => self.color_map(token),
            Word::PigmentMap | Word::NormalMap | Word::SlopeMap | Word::TextureMap => {
                self.map_value(token, word)
            }
            Word::TransformWord => self.transform_block(token).map(Value::Transform),
            Word::Camera => self.camera(token),
            Word::Array => self.array(token),
            Word::Spline => self.spline(token),
            Word::Function => self.function(token),
            Word::SkySphere => self.sky_sphere(token),
            Word::Fog => self.fog(token),
            Word::Rainbow => self.rainbow(token),
            _ if word.family() == Family::Color => self.color_from(token).map(Value::Color),
            _ if opens_object(word) => self.object(token, word),
            _ if !word.is_built() || word == Word::Background => {
                let poison = Poison::new(word, token.here.site(token.span));
                self.skip_arguments(word);
                Ok(Value::Poison(poison))
            }
            _ if matches!(word.role(), Role::Function { .. }) => {
                Err(self.lacks_parentheses(token, word))
            }
            _ if word.family() == Family::Transform && word != Word::Inverse => {
                Err(self.bare_transform(token, word))
            }
            _ => {
                let name = word.name();
                let diagnostic = Diagnostic::new(
                    Code::ExpectedExpression,
                    format!("expected a value, found `{name}`"),
                )
                .at(token.span, "this word does not begin a value");
                let reported = self.report(&token.here, diagnostic);
                self.skip_arguments(word);
                Err(reported)
            }
        }
    }

    /// Adds the fix that puts braces around the text from `from` to the item taken last: `pigment rgb 1`.
    fn braces_around(&self, token: &Token, from: Span, told: Diagnostic, word: Word) -> Diagnostic {
        let whole = Span { start: from.start, ..self.whole(token).span };
        let text = self.sources.text(whole);
        if text.contains(['{', '#', '/', ';']) || text.ends_with(',') {
            return told.help(self.form_of(word));
        }
        let text = format!("{{ {text} }}");
        told.help(format!("write `{} {text}`", word.name())).fix(whole, text)
    }

    /// Reads the block after `token` with a consumer.
    pub(in crate::evaluate) fn block<T>(
        &mut self,
        token: &Token,
        word: Word,
        consumer: impl FnOnce(&mut Self) -> Outcome<T>,
    ) -> Outcome<T> {
        match self.peek() {
            Some(Token { kind: TokenKind::Block(_), .. }) => {}
            next => {
                let next = next.cloned();
                if let Some(reported) = self.before_braces(word) {
                    return Err(reported);
                }
                let found = next.as_ref().map_or("nothing".to_owned(), |next| self.describe(next));
                let name = word.name();
                let message = format!("expected `{{` after `{name}`, found {found}");
                let diagnostic = Diagnostic::new(Code::MissingPart, message);
                // If its parts are in parentheses, at these.
                let group = next.as_ref().filter(|next| {
                    matches!(next.kind, TokenKind::Expression(_))
                        && self.sources.text(next.span).starts_with('(')
                });
                let group = group.map(|group| group.span);
                let mut diagnostic = match group {
                    Some(group) => diagnostic
                        .at(Span { end: group.start + 1, ..group }, "expected `{`")
                        .also(token.span, "its block is missing"),
                    None => diagnostic.at(token.span, "its block is missing"),
                };
                diagnostic = match next {
                    Some(Token { kind: TokenKind::Expression(id), span, here })
                        if matches!(here.unit.expression(id).kind, ExpressionKind::Name(_)) =>
                    {
                        let (place, text) = self.named_outside(word, span);
                        let end = if text.ends_with('}') { "" } else { " … }" };
                        diagnostic.help(format!("write `{name} {text}{end}`")).fix(place, text)
                    }
                    Some(Token { kind: TokenKind::Expression(id), here, .. })
                        if matches!(
                            here.unit.expression(id).kind,
                            ExpressionKind::Group(_) | ExpressionKind::GroupItems(_)
                        ) =>
                    {
                        let told =
                            diagnostic.help(format!("its parts stand in braces: `{name} {{ … }}`"));
                        match group.filter(|group| {
                            let text = &self.sources.get(group.file).text;
                            let behind = text.get(group.end as usize..).unwrap_or("");
                            self.sources.text(*group).ends_with(')')
                                && !behind.trim_start().starts_with('{')
                        }) {
                            Some(group) => told
                                .fix(Span { end: group.start + 1, ..group }, "{")
                                .fix(Span { start: group.end - 1, ..group }, "}"),
                            None => told,
                        }
                    }
                    Some(Token { kind: TokenKind::Word(own), span, .. })
                        if place::home(own) == Some(word) || own.family() == Family::Color =>
                    {
                        self.skip_missing_block(token);
                        let diagnostic = self.braces_around(token, span, diagnostic, word);
                        return Err(self.report(&token.here, diagnostic));
                    }
                    Some(Token { span, .. }) if self.is_picture(word, span) => {
                        self.braces_around_file(word, span, diagnostic)
                    }
                    _ => diagnostic.help(self.form_of(word)),
                };
                let reported = self.report(&token.here, diagnostic);
                self.skip_missing_block(token);
                return Err(reported);
            }
        }
        match self.next() {
            Some(Token { kind: TokenKind::Block(contents), here, span }) => {
                self.openers.push(token.span);
                self.blocks.push(here.site(span));
                // The contents are not part of an unsupported item before the block.
                let outer = self.poison.take();
                let outcome = self.inside_block(&here, contents, span, consumer);
                if let Some(inner) = std::mem::replace(&mut self.poison, outer) {
                    self.set_poison(inner);
                }
                self.blocks.pop();
                self.openers.pop();
                outcome
            }
            _ => Err(Reported),
        }
    }
}

/// Returns whether a word opens an object.
fn opens_object(word: Word) -> bool {
    matches!(word.family(), Family::Shape | Family::Csg) || is_object_word(word)
}

/// Returns whether a word opens an object that is not a shape.
fn is_object_word(word: Word) -> bool {
    matches!(word, Word::Object | Word::LightSource | Word::LightGroup)
}

/// Returns whether a word has a block that is a value.
fn opens_value(word: Word) -> bool {
    opens_object(word)
        || matches!(
            word,
            Word::Texture
                | Word::Pigment
                | Word::Finish
                | Word::Interior
                | Word::Material
                | Word::ColorMap
                | Word::TransformWord
                | Word::Camera
                | Word::SkySphere
                | Word::Fog
                | Word::Rainbow
        )
}
