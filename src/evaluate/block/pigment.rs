//! `pigment` and `color_map`.

use std::sync::Arc;

use crate::color::{Color, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::pattern::Pattern;
use crate::scene::{ColorMap, Pigment, PigmentId, PigmentKind};
use crate::source::Site;
use crate::source::Span;
use crate::vocabulary::{Family, Word};

use super::super::lint::Rise;
use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::finish::list_once;
use super::{Given, Place};

/// Entries of one map: more are a mistake, and soon more than memory holds.
const MOST_ENTRIES: usize = 1 << 20;

/// What was written in one block: its last pattern, and its last map.
#[derive(Default)]
struct Written {
    pattern: Option<Site>,
    /// A colour of its map is clear.
    clear: bool,
    map: Option<(ColorMap, Token, Site)>,
}

impl Evaluator<'_> {
    /// `pigment { [Name] … }`, starting from the default texture's pigment.
    pub(super) fn pigment(&mut self, token: &Token) -> Outcome<PigmentId> {
        let start = self.scene.textures[self.default_texture.index()].pigment;
        self.pigment_from(token, start)
    }

    pub(super) fn pigment_from(&mut self, token: &Token, start: PigmentId) -> Outcome<PigmentId> {
        let mut pigment = self.scene.pigments[start.index()].clone();
        pigment.site = token.here.site(token.span);
        let pigment = self.block(token, Word::Pigment, |evaluator| {
            let mut failed = false;
            // A map may stand before its pattern.
            let mut written = Written::default();
            while let Some(token) = evaluator.next() {
                if evaluator.pigment_item(&token, &mut pigment, &mut written) == Err(Reported) {
                    failed = true;
                    evaluator.skip_values();
                }
            }
            if let Some((given, token, item)) = written.map
                && !failed
            {
                let is_clear = given.0.iter().any(|(_, color)| color.is_clear());
                failed |= evaluator.paint(&mut pigment, given, &token) == Err(Reported);
                // Without its pattern the map would be a mistake.
                written.pattern = Some(match written.pattern {
                    Some(pattern) => evaluator.joined(pattern, item),
                    None => item,
                });
                written.clear = is_clear;
            }
            if let Some(item) = written.pattern {
                list_once(&mut pigment.pattern, item);
                if written.clear {
                    list_once(&mut pigment.clear, item);
                }
            }
            if failed { Err(Reported) } else { Ok(pigment) }
        })?;
        Ok(self.add_pigment(pigment))
    }

    /// Puts the colours of a map over the values of the pigment's pattern.
    fn paint(&mut self, pigment: &mut Pigment, given: ColorMap, token: &Token) -> Outcome<()> {
        match &mut pigment.kind {
            PigmentKind::Patterned { map, .. } => {
                *map = given;
                Ok(())
            }
            // The pattern is one that is not built.
            PigmentKind::Color(_) if self.poison.is_some() => Ok(()),
            PigmentKind::Color(_) => {
                let diagnostic = Diagnostic::new(
                    Code::MissingPart,
                    "a `color_map` needs a pattern in its pigment",
                )
                .at(token.span, "colours over the values of which pattern?")
                .help("name one: `gradient y color_map { … }`");
                Err(self.report(&token.here, diagnostic))
            }
        }
    }

    /// The item that `token` began gives the pigment one colour.
    fn color_of(&self, pigment: &mut Pigment, color: Color, token: &Token) {
        pigment.kind = PigmentKind::Color(color);
        if color.is_clear() {
            list_once(&mut pigment.clear, self.whole(token));
        }
    }

    pub(super) fn add_pigment(&mut self, pigment: Pigment) -> PigmentId {
        let map = match &pigment.kind {
            PigmentKind::Patterned { map, .. } => size_of_val(&map.0[..]),
            PigmentKind::Color(_) => 0,
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
                let (first, second) = self.color_pair(token, &mut pigment.clear)?;
                let map = ColorMap(vec![(0.0, first), (1.0, second)]);
                pigment.kind = PigmentKind::Patterned { pattern: Pattern::Checker, map };
                let item = written.pattern.replace(self.whole(token));
                item.into_iter().for_each(|item| list_once(&mut pigment.pattern, item));
            }
            TokenKind::Word(Word::Gradient) => {
                let direction = self.direction_after(token, "the gradient's direction")?.value;
                let map = ColorMap(vec![(0.0, Color::BLACK), (1.0, Color::WHITE)]);
                pigment.kind =
                    PigmentKind::Patterned { pattern: Pattern::Gradient { direction }, map };
                let item = written.pattern.replace(self.whole(token));
                item.into_iter().for_each(|item| list_once(&mut pigment.pattern, item));
            }
            TokenKind::Word(Word::ColorMap) => {
                let Value::ColorMap(given) = self.color_map(token)? else { return Err(Reported) };
                written.map = Some((given.as_ref().clone(), token.clone(), self.whole(token)));
            }
            TokenKind::Word(word) if word.family() == Family::Color => {
                let color = self.color_from(token)?;
                self.color_of(pigment, color, token);
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
                        let site = pigment.site;
                        *pigment = self.scene.pigments[id.index()].clone();
                        pigment.site = site;
                        written.pattern = None;
                    }
                    value @ (Value::Color(_) | Value::Vector(_)) => {
                        if matches!(value, Value::Vector(_)) {
                            self.bare_color(token);
                        }
                        let (span, here) = (token.span, token.here.clone());
                        let given = Given { value, span, here, expression: Some(id) };
                        let color = self.plain_color(&given, "a colour")?;
                        let color = self.color_components(color)?;
                        self.color_of(pigment, color, token);
                    }
                    // Not an error: what it lacks is told where it is needed.
                    Value::Poison(poison) => self.set_poison(poison),
                    Value::Broken => return Err(Reported),
                    _ => {
                        self.unexpected(token, Place::PIGMENT);
                        return Err(Reported);
                    }
                }
            }
            _ => {
                if let Some(outcome) = self.inert(token, Place::PIGMENT) {
                    return outcome;
                }
                let poisoned = self.poison.is_some();
                self.unexpected(token, Place::PIGMENT);
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

    /// `pigment { <1, 0, 0> }`, which POV-Ray refuses, too.
    fn bare_color(&mut self, token: &Token) {
        let text = self.sources.text(token.span).to_owned();
        let message = "expected a pigment: a colour or a pattern, found a vector";
        let diagnostic = Diagnostic::new(Code::WrongType, message)
            .at(token.span, "a vector is no colour by itself")
            .help(format!("write `rgb {text}`"))
            .fix(Span { end: token.span.start, ..token.span }, "rgb ");
        self.report(&token.here, diagnostic);
    }

    /// The two colours of `checker`; blue and green where they are missing.
    fn color_pair(&mut self, token: &Token, clear: &mut Vec<Site>) -> Outcome<(Color, Color)> {
        let mut colors =
            [Color::opaque(Rgb::new(0.0, 0.0, 1.0)), Color::opaque(Rgb::new(0.0, 1.0, 0.0))];
        let mut given = 0;
        for color in &mut colors {
            self.skip_commas();
            if self.at_color() {
                let first = self.peek().cloned();
                *color = self.color_after(token, "a colour")?.value;
                if let Some(first) = first.filter(|_| color.is_clear()) {
                    list_once(clear, self.whole(&first));
                }
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
                    let id = self.pigment(&next)?;
                    if let Pigment { kind: PigmentKind::Color(plain), clear: inner, .. } =
                        &self.scene.pigments[id.index()]
                    {
                        *color = *plain;
                        inner.iter().for_each(|&item| list_once(clear, item));
                        continue;
                    }
                } else {
                    self.skip_arguments(word);
                    not_built = Word::Checker;
                }
                self.set_poison(super::super::value::Poison {
                    word: not_built,
                    site: next.here.site(next.span),
                });
            }
        }
        // Without any, the author knows the two that it has.
        if given == 1 && self.poison.is_none() {
            self.lint_missing_color(token);
        }
        Ok((colors[0], colors[1]))
    }

    /// `color_map { [value color] … }` or `color_map { Name }`.
    pub(super) fn color_map(&mut self, token: &Token) -> Outcome<Value> {
        let mut entries: Vec<(f64, Color)> = Vec::new();
        let mut rise = Rise::default();
        let opener = token.clone();
        self.block(token, Word::ColorMap, |evaluator| {
            let mut failed = false;
            while let Some(token) = evaluator.next() {
                match &token.kind {
                    TokenKind::Entry(items) => {
                        let here = token.here.clone();
                        let read = evaluator.inside(&here, *items, |evaluator| {
                            evaluator.map_entry(&token, &mut rise)
                        });
                        match read {
                            Ok(read) => entries.extend(read),
                            Err(Reported) => failed = true,
                        }
                    }
                    TokenKind::Expression(id) => match evaluator.declared(&token, *id) {
                        Some(Value::Broken) => failed = true,
                        Some(Value::ColorMap(map))
                            if entries.len() + map.0.len() > MOST_ENTRIES =>
                        {
                            let message = format!("this map has more than {MOST_ENTRIES} entries");
                            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                                .at(token.span, "these are too many");
                            return Err(evaluator.report(&token.here, diagnostic));
                        }
                        Some(Value::ColorMap(map)) => {
                            rise.named(&map, token.here.site(token.span));
                            entries.extend(map.0.iter().copied());
                        }
                        Some(Value::Poison(poison)) => evaluator.set_poison(poison),
                        _ => {
                            evaluator.unexpected(&token, Place::COLOR_MAP);
                            failed = true;
                        }
                    },
                    _ => evaluator.unexpected(&token, Place::COLOR_MAP),
                }
            }
            if failed {
                return Err(Reported);
            }
            if entries.is_empty() {
                if evaluator.poison.is_some() {
                    return Err(Reported);
                }
                let diagnostic = Diagnostic::new(Code::MissingPart, "this `color_map` is empty")
                    .at(opener.span, "expected entries: `[0 rgb 0] [1 rgb 1]`");
                return Err(evaluator.report(&opener.here, diagnostic));
            }
            evaluator.lint_map(rise);
            // Stable: of two entries with one value, the first ends the part below, the second begins the part above.
            entries.sort_by(|a, b| a.0.total_cmp(&b.0));
            Ok(Value::ColorMap(Arc::new(ColorMap(entries))))
        })
    }

    /// `[value color]`, or the old `[from, to color a color b]`.
    fn map_entry(&mut self, token: &Token, rise: &mut Rise) -> Outcome<Vec<(f64, Color)>> {
        let given = self.number_after(token, "a number and a colour")?;
        let from = given.value;
        rise.entry(given, self.sources);
        self.skip_commas();
        let starts_color = matches!(self.peek(), Some(Token { kind: TokenKind::Word(_), .. }));
        if starts_color {
            let color = self.color_after(token, "a colour")?.value;
            self.end_of_entry(token)?;
            return Ok(vec![(from, color)]);
        }
        let second = self.given(token, "a colour")?;
        let entries = match second.value {
            Value::Number(to) => {
                rise.entry(second.with(to), self.sources);
                let first = self.color_after(token, "a colour")?.value;
                let last = self.color_after(token, "a second colour")?.value;
                self.lint_legacy(
                    &token.here,
                    token.span,
                    "an entry with two values is an old form",
                    "write two entries, one for each value",
                );
                vec![(from, first), (to, last)]
            }
            _ => {
                let color = self.plain_color(&second, "a colour")?;
                vec![(from, self.color_components(color)?)]
            }
        };
        self.end_of_entry(token)?;
        Ok(entries)
    }

    fn end_of_entry(&mut self, entry: &Token) -> Outcome<()> {
        self.skip_commas();
        match self.next() {
            None => Ok(()),
            Some(extra) => {
                let diagnostic = Diagnostic::new(
                    Code::ExtraPart,
                    "an entry of a `color_map` is one number and one colour",
                )
                .at(extra.span_head(), "this is more")
                .also(entry.span_head(), "in this entry");
                Err(self.report(&extra.here, diagnostic))
            }
        }
    }
}
