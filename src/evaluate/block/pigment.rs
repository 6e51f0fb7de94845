//! `pigment`: one colour, or a pattern with its colours.

mod open;
mod second;

use std::sync::Arc;

use crate::color::{Color, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::pattern::Pattern;
use crate::scene::{ColorMap, Pigment, PigmentId, PigmentKind};
use crate::source::Site;
use crate::source::Span;
use crate::vocabulary::{Dialect, Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::{Poison, Value};
use super::super::{Evaluator, Outcome, Reported};
use super::finish::list_once;
use super::pieces::{WrittenColor, WrittenMap};
use super::{Given, Place};
pub(super) use open::OpenPigment;
use second::First;
pub(super) use second::colors_of;

/// What a block has specified: its last pattern, with the items that gave the pigment an earlier one, and its
/// last map.
#[derive(Default)]
struct Written {
    pattern: Option<(Site, Vec<Site>)>,
    map: Option<(Arc<WrittenMap>, Token, Site)>,
    first: Option<First>,
    /// Whether it began as a declared pigment.
    named: bool,
}

/// Returns the items that gave a pigment its pattern, if that has more than one colour.
fn called_pattern(pigment: &mut Pigment) -> Vec<Site> {
    match &pigment.kind {
        PigmentKind::Patterned { map, .. } if map.lone_color().is_none() => {
            std::mem::take(&mut pigment.pattern)
        }
        PigmentKind::Patterned { .. } | PigmentKind::Color(_) | PigmentKind::Faces(_) => Vec::new(),
    }
}

/// The colours of `checker`, the items that make them transparent, and the pieces whose removal leaves one
/// colour, if not the whole.
struct Pair {
    colors: [Color; 2],
    clear: Vec<Site>,
    pattern: Option<Vec<Site>>,
}

impl Evaluator<'_> {
    /// Reads `pigment { [Name] … }`, starting from the default texture's pigment.
    pub(super) fn pigment(&mut self, token: &Token) -> Outcome<PigmentId> {
        let start = self.scene.textures[self.default_texture.index()].pigment;
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

    /// Applies the colours of a map to the pigment's pattern. `is_new`: it had no other colours.
    fn paint(
        &mut self,
        pigment: &mut Pigment,
        given: ColorMap,
        token: &Token,
        is_new: bool,
    ) -> Outcome<()> {
        match &mut pigment.kind {
            PigmentKind::Patterned { pattern: Pattern::Checker, .. } => {
                let message = "`checker` takes two colours, and no `color_map`";
                let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                    .at(token.span, "its values are two, with nothing between them")
                    .help("write the colours behind it: `checker rgb 0, rgb 1`");
                Err(self.report(&token.here, diagnostic))
            }
            PigmentKind::Patterned { map, .. } => {
                *map = given;
                Ok(())
            }
            // The pattern is unsupported.
            PigmentKind::Color(_) | PigmentKind::Faces(_) if self.poison.is_some() => Ok(()),
            PigmentKind::Color(_) | PigmentKind::Faces(_) => {
                let diagnostic = Diagnostic::new(
                    Code::MissingPart,
                    "a `color_map` needs a pattern in its pigment",
                )
                .at(token.span, "colours over the values of which pattern?")
                .help("name one: `gradient y color_map { … }`");
                match is_new {
                    // It stays black in POV-Ray 3.7, which refuses the map over any other colour (measured).
                    true => self.opinion(&token.here, diagnostic),
                    false => Err(self.report(&token.here, diagnostic)),
                }
            }
        }
    }

    /// Records the pieces that cause an effect in a pigment with the map `given`, whose site is `item`.
    fn note_map(
        &self,
        pigment: &mut Pigment,
        given: &WrittenMap,
        item: Site,
        pattern: Option<(Site, Vec<Site>)>,
    ) {
        match &given.clear {
            Some(pieces) => pigment.clear.clone_from(pieces),
            // The pattern's own colours become visible again.
            None => list_once(&mut pigment.clear, item),
        }
        match (&given.pattern, pattern) {
            (Some(pieces), _) if !pieces.is_empty() => pigment.pattern.clone_from(pieces),
            // Without its pattern the map would be a mistake.
            (_, Some((pattern, before))) => {
                pigment.pattern = before;
                list_once(&mut pigment.pattern, self.joined(pattern, item));
            }
            (_, None) => {
                pigment.pattern = called_pattern(pigment);
                list_once(&mut pigment.pattern, item);
            }
        }
    }

    /// Sets the pigment to one colour, by the item that `token` began.
    fn color_of(&self, pigment: &mut Pigment, color: &WrittenColor, token: &Token) {
        pigment.kind = PigmentKind::Color(color.color());
        pigment.pattern.clear();
        match color.without_clear() {
            Some(pieces) => pigment.clear = pieces,
            None => list_once(&mut pigment.clear, self.whole(token)),
        }
    }

    /// Sets the pigment's pattern, by the item that `token` began; `pieces` of it suffice as the cause.
    fn pattern_of(
        &self,
        pigment: &mut Pigment,
        written: &mut Written,
        token: &Token,
        pieces: Option<Vec<Site>>,
    ) {
        let before = called_pattern(pigment);
        let item = self.whole(token);
        match pieces {
            Some(pieces) => pigment.pattern = pieces,
            None => {
                pigment.pattern.clone_from(&before);
                list_once(&mut pigment.pattern, item);
            }
        }
        written.pattern = Some((item, before));
    }

    pub(super) fn add_pigment(&mut self, pigment: Pigment) -> PigmentId {
        let map = match &pigment.kind {
            PigmentKind::Patterned { map, .. } => size_of_val(&map.0[..]),
            PigmentKind::Color(_) => 0,
            PigmentKind::Faces(colors) => size_of_val(&colors[..]),
        };
        let lists =
            map + 2 * size_of_val(&pigment.transforms[..]) + size_of_val(&pigment.pattern[..]);
        self.stored += (size_of::<Pigment>() + lists) as u64;
        self.scene.pigments.push(pigment);
        PigmentId(self.scene.pigments.len() as u32 - 1)
    }

    fn pigment_item(
        &mut self,
        token: &Token,
        pigment: &mut Pigment,
        written: &mut Written,
    ) -> Outcome<()> {
        if let Some(transform) = self.transform_from(token) {
            pigment.transforms.push(transform?);
            return Ok(());
        }
        match &token.kind {
            TokenKind::Word(Word::Checker) => {
                let Pair { colors: [first, second], clear, pattern } = self.color_pair(token)?;
                self.alone_in_pigment(token, Some(Word::Checker), written)?;
                let pattern = pattern.filter(|_| first != second);
                self.pattern_of(pigment, written, token, pattern);
                let map = ColorMap(vec![(0.0, first), (1.0, second)]);
                pigment.kind = PigmentKind::Patterned { pattern: Pattern::Checker, map };
                pigment.clear = clear;
            }
            TokenKind::Word(Word::Gradient) => {
                let direction = self.any_direction_after(token, "the gradient's direction")?.value;
                self.alone_in_pigment(token, Some(Word::Gradient), written)?;
                self.pattern_of(pigment, written, token, None);
                let pattern = Pattern::Gradient { direction };
                match &mut pigment.kind {
                    // In POV-Ray 3.7 the colours stay, those of `checker` too (measured).
                    PigmentKind::Patterned { pattern: before, .. }
                        if self.options.dialect == Dialect::Pov =>
                    {
                        *before = pattern;
                    }
                    kind => {
                        let map = ColorMap(vec![(0.0, Color::BLACK), (1.0, Color::WHITE)]);
                        *kind = PigmentKind::Patterned { pattern, map };
                        pigment.clear.clear();
                    }
                }
            }
            TokenKind::Word(Word::ColorMap) => {
                let Value::ColorMap(given) = self.color_map(token)? else { return Err(Reported) };
                written.map = Some((given, token.clone(), self.whole(token)));
            }
            TokenKind::Word(word) if word.family() == Family::Color => {
                let color = self.color_from(token)?;
                self.alone_in_pigment(token, None, written)?;
                self.color_of(pigment, &color, token);
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
                        self.first_in_pigment(token, written)?;
                        let site = pigment.site;
                        *pigment = self.scene.pigments[id.index()].clone();
                        pigment.site = site;
                        written.pattern = None;
                        written.named = true;
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
                        let color = self.color_components(color, given.site())?;
                        self.alone_in_pigment(token, None, written)?;
                        self.color_of(pigment, &color, token);
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
            TokenKind::Comma if written.first.is_some() && self.at_color() => {}
            _ => {
                if let Some(outcome) = self.inert(token, Place::PIGMENT) {
                    return outcome;
                }
                let poisoned = self.poison.is_some();
                self.unexpected(token, Place::PIGMENT);
                if let TokenKind::Word(word) = token.kind
                    && word.family() == Family::Pattern
                    && self.poison.is_some()
                {
                    self.alone_in_pigment(token, Some(word), written)?;
                }
                if !poisoned
                    && self.poison.is_none()
                    && !matches!(token.kind, TokenKind::Comma | TokenKind::Semicolon)
                {
                    return Err(Reported);
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

    /// Reads the two colours of `checker`; missing ones are blue and green.
    fn color_pair(&mut self, token: &Token) -> Outcome<Pair> {
        let mut colors =
            [Color::opaque(Rgb::new(0.0, 0.0, 1.0)), Color::opaque(Rgb::new(0.0, 1.0, 0.0))];
        let mut clear = Vec::new();
        let mut said: Vec<WrittenColor> = Vec::new();
        let (mut given, mut pigments) = (0, 0);
        // All items before the last colour.
        let mut lead = self.whole(token);
        for color in &mut colors {
            let before = self.whole(token);
            self.skip_commas();
            if self.at_color() {
                lead = before;
                let first = self.peek().cloned();
                let written = self.written_color_after(token, "a colour")?.value;
                *color = written.color();
                if let Some(first) = first {
                    let pieces = written.without_clear().unwrap_or(vec![self.whole(&first)]);
                    pieces.into_iter().for_each(|piece| list_once(&mut clear, piece));
                }
                said.push(written);
                given += 1;
            } else if let Some(Token {
                kind: TokenKind::Word(word @ (Word::Pigment | Word::Texture)),
                ..
            }) = self.peek()
            {
                let word = *word;
                let Some(next) = self.next() else { break };
                given += 1;
                let mut not_built = word;
                if word == Word::Pigment {
                    pigments += 1;
                    let id = self.pigment(&next)?;
                    if let Pigment { kind: PigmentKind::Color(plain), clear: inner, .. } =
                        &self.scene.pigments[id.index()]
                    {
                        *color = *plain;
                        inner.iter().for_each(|&item| list_once(&mut clear, item));
                        continue;
                    }
                } else {
                    self.skip_arguments(word);
                    not_built = Word::Checker;
                }
                let site = next.here.site(next.span);
                self.set_poison(Poison::new(not_built, site));
            }
        }
        // `checker rgb 1; rgb 0`.
        if given == 1
            && let Some(sign) = self.next_if(|kind| matches!(kind, TokenKind::Semicolon))
        {
            let diagnostic =
                Diagnostic::new(Code::UnexpectedCharacter, "commas part the colours of a pattern")
                    .at(sign.span, "expected `,`")
                    .help("replace the `;` with `,`")
                    .fix(sign.span, ",");
            self.report(&sign.here, diagnostic);
            self.skip_color(token);
        } else if given == 1 && self.poison.is_none() {
            // Without any, the author knows the two that it has. Beside a pigment the other is the default one,
            // as in POV-Ray 3.7 (measured).
            if pigments > 0 {
                let default = self.scene.textures[self.default_texture.index()].pigment;
                match self.scene.pigments[default.index()].kind {
                    PigmentKind::Color(color) => colors[1] = color,
                    _ => self.set_poison(Poison::new(Word::Pigment, token.here.site(token.span))),
                }
            }
            self.lint_missing_color(token, if pigments > 0 { "black" } else { "green" });
        }
        let alike = match said.as_slice() {
            [first, second] => {
                let like = |color: Color| move |other: Color| other == color;
                second.without(like(colors[0])).or_else(|| first.without(like(colors[1])))
            }
            _ => None,
        };
        // A colour is a pigment by itself.
        let last = said.last().filter(|last| said.len() == given && !last.bare);
        let pattern = alike.or(last.map(|_| vec![lead]));
        Ok(Pair { colors, clear, pattern })
    }
}
