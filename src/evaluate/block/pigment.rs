//! `pigment`: one colour, or a pattern with its colours.

mod list;
mod map;
mod open;
mod second;

use std::sync::Arc;

use crate::color::Color;
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Colors, Pigment, PigmentId, PigmentKind, Source};
use crate::source::Site;
use crate::source::Span;
use crate::vocabulary::{Dialect, Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::{Given, Place};
pub(super) use open::OpenPigment;
use second::First;
pub(super) use second::colors_of;

/// What a block has specified besides its pattern.
#[derive(Default)]
struct Written {
    /// The colours of its last map, or of a list.
    colors: Option<(Colors, Token)>,
    /// They are of a map.
    is_map: bool,
    /// The first colour of the map or list that lets light through.
    clear: Option<Site>,
    first: Option<First>,
    /// Whether it began as a declared pigment.
    named: bool,
}

impl Evaluator<'_> {
    /// Reads `pigment { [Name] … }`, starting from the default texture's pigment.
    pub(super) fn pigment(&mut self, token: &Token) -> Outcome<PigmentId> {
        let start = self.scene.textures[self.default_texture.index()].kind.first_pigment();
        self.pigment_from(token, start)
    }

    pub(super) fn pigment_from(&mut self, token: &Token, start: PigmentId) -> Outcome<PigmentId> {
        self.block(token, Word::Pigment, |evaluator| {
            let mut open = evaluator.open_pigment(token, start);
            while let Some(token) = evaluator.next() {
                evaluator.item_of_pigment(&token, &mut open);
            }
            evaluator.close_pigment(open)
        })
    }

    /// Reports a map whose pattern takes a list of colours, or that has no pattern. `is_new`: the pigment had
    /// no other colours.
    fn judge_map(&mut self, source: Option<&Source>, token: &Token, is_new: bool) -> Outcome<()> {
        let map = self.sources.text(token.span).to_owned();
        match source {
            Some(list) if list.list().is_some() => {
                let name = list.word();
                let count = list.list().unwrap_or_default();
                let message = format!("`{name}` takes {} colours, and no `{map}`", number(count));
                let values = match count {
                    2 => "its values are two, with nothing between them".to_owned(),
                    _ => format!("its values are {count}, with nothing between them"),
                };
                let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                    .at(token.span, values)
                    .help(format!("write the colours behind it: `{name} rgb 0, rgb 1`"));
                Err(self.report(&token.here, diagnostic))
            }
            Some(Source::Average) if map != Word::PigmentMap.name() => {
                let message = format!("`average` takes a `pigment_map`, and no `{map}`");
                let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                    .at(token.span, "it is the mean of pigments, and has no values for colours")
                    .help("write the colours as pigments: `pigment_map { [1 rgb 0] [1 rgb 1] }`");
                Err(self.report(&token.here, diagnostic))
            }
            Some(_) => Ok(()),
            // The pattern is unsupported.
            None if self.poison.is_some() => Ok(()),
            None => {
                let message = format!("a `{map}` needs a pattern in its pigment");
                let diagnostic = Diagnostic::new(Code::MissingPart, message)
                    .at(token.span, "colours over the values of which pattern?")
                    .help(format!("name one: `gradient y {map} {{ … }}`"));
                match is_new {
                    // It stays black in POV-Ray 3.7, which refuses the map over any other colour (measured).
                    true => self.opinion(&token.here, diagnostic),
                    false => Err(self.report(&token.here, diagnostic)),
                }
            }
        }
    }

    /// Sets the pigment to one colour, by the item that `token` began.
    fn color_of(&self, open: &mut OpenPigment, color: Color, token: &Token) {
        open.pigment.kind = PigmentKind::Color(color);
        open.pigment.clear = color.is_clear().then(|| self.whole(token));
        open.pattern.inherited = None;
    }

    pub(super) fn add_pigment(&mut self, pigment: Pigment) -> PigmentId {
        let map = match &pigment.kind {
            PigmentKind::Patterned { colors: Colors::Map(map), .. } => size_of_val(&map.0[..]),
            PigmentKind::Patterned { colors: Colors::Pigments(all), .. } => size_of_val(&all[..]),
            PigmentKind::Patterned { colors: Colors::Image, .. } => 0,
            PigmentKind::Color(_) => 0,
            PigmentKind::Faces(colors) => size_of_val(&colors[..]),
        };
        let lists = map + 2 * size_of_val(&pigment.steps[..]);
        self.stored += (size_of::<Pigment>() + lists) as u64;
        self.scene.pigments.push(pigment);
        PigmentId(self.scene.pigments.len() as u32 - 1)
    }

    fn pigment_item(&mut self, token: &Token, open: &mut OpenPigment) -> Outcome<()> {
        if let Some(read) = self.pattern_item(token, &mut open.pattern) {
            return read;
        }
        if let TokenKind::Word(Word::Object) = token.kind {
            let (source, (colors, clear)) = self.object_pattern(token, |evaluator, source| {
                evaluator.list_of_colors(token, source, 2)
            })?;
            self.alone_in_pigment(token, Some(Word::Object), &mut open.written)?;
            open.written.colors = Some((colors, token.clone()));
            open.written.clear = clear;
            open.pattern.choose(source, self.whole(token));
            return Ok(());
        }
        if let TokenKind::Word(word) = token.kind
            && word.family() != Family::Color
            && let Some(source) = self.pattern_source(token, word)
        {
            let source = source?;
            let site = self.whole(token);
            let list = match source.list() {
                Some(count) => Some(self.list_of_colors(token, &source, count)?),
                None => None,
            };
            self.alone_in_pigment(token, Some(word), &mut open.written)?;
            if let Some((colors, clear)) = list {
                open.written.colors = Some((colors, token.clone()));
                open.written.clear = clear;
            }
            open.pattern.choose(source, site);
            return self.only_in_normals(token, word);
        }
        match &token.kind {
            TokenKind::Word(Word::ColorMap) => {
                let Value::ColorMap(given) = self.color_map(token)? else { return Err(Reported) };
                open.written.colors = Some((Colors::Map(given.map.clone()), token.clone()));
                open.written.clear = given.clear;
                open.written.is_map = true;
            }
            TokenKind::Word(word @ Word::ImageMap) => {
                let placed = self.image(token, *word)?;
                self.alone_in_pigment(token, Some(*word), &mut open.written)?;
                let mut is_clear = false;
                placed.image.for_each_color(&mut |color| is_clear |= color.is_clear());
                let site = self.whole(token);
                open.written.clear = is_clear.then_some(site);
                open.written.colors = Some((Colors::Image, token.clone()));
                open.written.is_map = false;
                open.pattern.choose(Source::Image(Arc::new(placed.image)), site);
            }
            TokenKind::Word(Word::PigmentMap) => {
                let average = self.is_average(open);
                let given = self.pigment_map(token, average)?;
                open.written.colors = Some((Colors::Pigments(given), token.clone()));
                open.written.is_map = true;
            }
            TokenKind::Word(Word::QuickColor) => {
                open.pigment.quick_color = Some(self.color_after(token, "a colour")?.value);
            }
            TokenKind::Word(word) if word.family() == Family::Color => {
                let color = self.color_from(token)?;
                self.alone_in_pigment(token, None, &mut open.written)?;
                self.color_of(open, color, token);
            }
            TokenKind::Expression(id) => {
                let id = *id;
                let value = match self.named(&token.here, id) {
                    Some(value) => value,
                    None if matches!(
                        token.here.unit.expression(id).kind,
                        crate::syntax::ast::ExpressionKind::Name(_)
                    ) =>
                    {
                        self.unexpected(token, Place::PIGMENT);
                        return Err(Reported);
                    }
                    None => self.expression(&token.here, id)?,
                };
                match value {
                    Value::Pigment(id) => {
                        self.first_in_pigment(token, &open.written)?;
                        let site = open.pigment.site;
                        open.pigment = Pigment { site, ..self.scene.pigments[id.index()].clone() };
                        open.pattern.inherit(open.pigment.pattern(), &open.pigment.steps);
                        open.written.named = true;
                    }
                    value @ (Value::Color(_) | Value::Vector(_)) => {
                        if matches!(value, Value::Vector(_))
                            && !self.is_kept_as_color(token, &value)
                        {
                            self.bare_color(token);
                        }
                        let (span, here) = (token.span, token.here.clone());
                        let given = Given { value, span, here, expression: Some(id) };
                        let color = self.plain_color(&given, "a colour")?;
                        let color = self.color_components(color)?;
                        self.alone_in_pigment(token, None, &mut open.written)?;
                        self.color_of(open, color, token);
                    }
                    // Not an error: what it lacks is reported where it is needed.
                    Value::Poison(poison) => {
                        self.is_of_place(token, poison, Place::PIGMENT);
                        self.set_poison(poison);
                    }
                    Value::Broken => return Err(Reported),
                    _ => {
                        self.unexpected(token, Place::PIGMENT);
                        return Err(Reported);
                    }
                }
            }
            // The site of a surplus colour, which is reported.
            TokenKind::Comma if open.written.first.is_some() && self.at_color() => {}
            _ => {
                self.other_item(token, Place::PIGMENT)?;
                // A pattern that is not built.
                if let TokenKind::Word(word) = token.kind
                    && word.family() == Family::Pattern
                    && self.poison.is_some()
                {
                    self.alone_in_pigment(token, Some(word), &mut open.written)?;
                }
            }
        }
        Ok(())
    }

    /// Returns whether a value of five numbers counts as a colour in `pigment { Glass }`: POV-Ray 3.7 stores
    /// such a vector as one (measured).
    fn is_kept_as_color(&self, token: &Token, value: &Value) -> bool {
        let is_written = self.sources.text(token.span).starts_with('<');
        let has_five = matches!(value, Value::Vector(numbers) if numbers.as_slice().len() == 5);
        self.options.dialect == Dialect::Pov && has_five && !is_written
    }

    /// Reports `pigment { <1, 0, 0> }`, which POV-Ray refuses as well.
    fn bare_color(&mut self, token: &Token) {
        let text = self.sources.text(token.span).to_owned();
        let message = "expected a pigment: a colour or a pattern, found a vector";
        let diagnostic = Diagnostic::new(Code::WrongType, message)
            .at(token.span, "a vector is no colour by itself")
            .help(format!("write `rgb {text}`"))
            .fix(Span { end: token.span.start, ..token.span }, "rgb ");
        self.report(&token.here, diagnostic);
    }
}

/// Returns a small number as a word.
fn number(count: usize) -> String {
    match count {
        2 => "two".to_owned(),
        3 => "three".to_owned(),
        4 => "four".to_owned(),
        6 => "six".to_owned(),
        _ => count.to_string(),
    }
}
