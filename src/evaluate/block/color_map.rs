//! `color_map`: colours over the values of a pattern.

use std::sync::Arc;

use crate::color::Color;
use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::scene::ColorMap;
use crate::source::{Site, Span};
use crate::syntax::ast::ExpressionKind;
use crate::vocabulary::{Dialect, Family, Word};

use super::super::lint::Rise;
use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::Place;
use super::rising::rising;

/// A `color_map`, and the first colour in it that lets light through.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenMap {
    pub map: ColorMap,
    pub clear: Option<Site>,
}

/// The values and colours of an entry.
type Entries = Vec<(f64, Color)>;

/// Maximum number of entries in a map: more are a mistake, and would soon exhaust memory.
const MOST_ENTRIES: usize = 1 << 20;

impl Evaluator<'_> {
    /// Reads `color_map { [value color] … }` or `color_map { Name }`.
    pub(super) fn color_map(&mut self, token: &Token) -> Outcome<Value> {
        let mut entries: Vec<(f64, Color)> = Vec::new();
        let mut clear: Option<Site> = None;
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
                            Ok(read) => {
                                if read.iter().any(|(_, color)| color.is_clear()) {
                                    clear = clear.or(Some(here.site(token.span)));
                                }
                                entries.extend(read);
                            }
                            Err(Reported) => failed = true,
                        }
                    }
                    TokenKind::Expression(id) => match evaluator.declared(&token, *id) {
                        Some(Value::Broken) => failed = true,
                        Some(Value::ColorMap(map))
                            if entries.len() + map.map.0.len() > MOST_ENTRIES =>
                        {
                            let message = format!("this map has more than {MOST_ENTRIES} entries");
                            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                                .at(token.span, "these are too many");
                            return Err(evaluator.report(&token.here, diagnostic));
                        }
                        Some(Value::ColorMap(map)) => {
                            let site = token.here.site(token.span);
                            rise.named(map.map.0.iter().map(|(value, _)| *value), site);
                            entries.extend(map.map.0.iter().copied());
                            clear = clear.or(map.clear);
                        }
                        Some(Value::Poison(poison)) => evaluator.set_poison(poison),
                        _ if matches!(
                            token.here.unit.expression(*id).kind,
                            ExpressionKind::GroupItems(_)
                        ) =>
                        {
                            let message = "an entry of a map stands in square brackets";
                            let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
                                .at(token.span, "expected `[` and `]` around it")
                                .help("write `[value colour]`");
                            evaluator.report(&token.here, diagnostic);
                            failed = true;
                        }
                        // `0.8 rgb 1`
                        _ if evaluator.sources.text(token.span).parse::<f64>().is_ok() => {
                            let before = evaluator.told();
                            evaluator.skip_commas();
                            let _: Outcome<()> =
                                evaluator.color_after(&token, "a colour").map(drop);
                            evaluator.take_back(before);
                            let whole = evaluator.whole(&token).span;
                            let right = format!("[{}]", evaluator.sources.text(whole));
                            let message = "an entry of a map stands in square brackets";
                            let diagnostic = Diagnostic::new(Code::UnexpectedCharacter, message)
                                .at(whole, "expected `[` and `]` around it")
                                .help(format!("write `{right}`"))
                                .fix(whole, right);
                            evaluator.report(&token.here, diagnostic);
                            failed = true;
                        }
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
            evaluator.lint_map(rise, Word::ColorMap);
            if !entries.is_sorted_by(|a, b| a.0 <= b.0) {
                match evaluator.options.dialect {
                    // Stable: of two entries with one value, the first ends the part below, the second begins
                    // the part above.
                    Dialect::Scene => entries.sort_by(|a, b| a.0.total_cmp(&b.0)),
                    Dialect::Pov => entries = rising(&entries, |a, b, part| a.lerp(b, part)),
                }
            }
            Ok(Value::ColorMap(Arc::new(WrittenMap { map: ColorMap(entries), clear })))
        })
    }

    /// Reads `[value color]`, or the old `[from, to color a color b]`.
    fn map_entry(&mut self, token: &Token, rise: &mut Rise) -> Outcome<Entries> {
        if let Some(reported) = self.entry_without_value(token) {
            return Err(reported);
        }
        let given = self.number_after(token, "a number and a colour")?;
        let (from, first_number) = (given.value, given.span);
        rise.entry(given, self.sources);
        self.skip_commas();
        let starts_color = matches!(self.peek(), Some(Token { kind: TokenKind::Word(_), .. }));
        if starts_color {
            let color = self.color_after(token, "a colour")?.value;
            self.end_of_entry(token)?;
            return Ok(vec![(from, color)]);
        }
        if let Some(reported) = self.misspelt_color(token) {
            return Err(reported);
        }
        if let Some(reported) = self.pigment_in_color_map() {
            return Err(reported);
        }
        let second = self.given(token, "a colour")?;
        self.bare_components(None, &second)?;
        let entries = match second.value {
            Value::Number(to) => {
                rise.entry(second.with(to), self.sources);
                let first = self.color_after(token, "a colour")?.value;
                if let Some(diagnostic) = self.decimal_comma(first_number)
                    && self.peek().is_none()
                {
                    return Err(self.report(&token.here, diagnostic));
                }
                let last = self.color_after(token, "a second colour")?.value;
                // POV-Ray's manual lists it as a current form.
                if self.options.dialect == Dialect::Scene {
                    self.lint_legacy(
                        &token.here,
                        token.span,
                        "an entry with two values is an old form",
                        "write two entries, one for each value",
                    );
                }
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

    /// Handles an entry that begins with a colour instead of its value: `[Red]`, `[Red 0]`.
    fn entry_without_value(&mut self, entry: &Token) -> Option<Reported> {
        let first = self.peek()?.clone();
        let is_word = matches!(first.kind, TokenKind::Word(word) if word.family() == Family::Color);
        if !is_word && !matches!(self.peek_declared(), Some(Value::Color(_))) {
            return None;
        }
        let before = self.told();
        let read = self.color_after(entry, "a colour");
        if read.is_err() {
            return Some(Reported);
        }
        self.take_back(before);
        let color = self.whole(&first);
        self.skip_commas();
        let text = self.sources.text(color.span).to_owned();
        let number = self.peek().cloned().filter(|next| {
            let number = self.sources.text(next.span);
            number.parse::<f64>().is_ok() && next.span.file == color.span.file
        });
        let told = |message| Diagnostic::new(Code::MissingPart, message);
        let told = match number {
            Some(number) => {
                let whole = color.span.to(number.span);
                let right = format!("{} {text}", self.sources.text(number.span));
                told("the value of an entry stands before its colour")
                    .at(color.span, "expected a number before this")
                    .help(format!("write `[{right}]`"))
                    .fix(whole, right)
            }
            None => told("an entry begins with its value, from 0 to 1")
                .at(color.span, "expected a number before this")
                .help(format!("write `[0 {text}]` for the first, and `[1 …]` for the last")),
        };
        while self.next().is_some() {}
        Some(self.report(&first.here, told))
    }

    /// Handles a pigment in a `color_map`, which belongs in a `pigment_map`: `[0 P_Wood]`.
    fn pigment_in_color_map(&mut self) -> Option<Reported> {
        let token = self.peek()?.clone();
        let word = match self.peek_declared()? {
            Value::Pigment(_) => Word::Pigment,
            Value::Texture(_) => Word::Texture,
            Value::Poison(poison) => poison.of.filter(|of| {
                matches!(of, Word::Pigment | Word::Texture | Word::Normal | Word::Density)
            })?,
            _ => return None,
        };
        let (text, name) = (self.sources.text(token.span).to_owned(), word.name());
        let message = format!("a `color_map` holds colours, and `{text}` is a `{name}`");
        let diagnostic = Diagnostic::new(Code::WrongType, message)
            .at(token.span, "expected a colour")
            .help(format!("a map of these is a `{name}_map`"));
        let opener = self.openers.last().copied();
        let diagnostic = match opener.filter(|opener| self.sources.text(*opener).ends_with("_map"))
        {
            Some(opener) => diagnostic.also(opener, "a map of colours"),
            None => diagnostic,
        };
        self.next();
        self.skip_values();
        Some(self.report(&token.here, diagnostic))
    }

    /// Returns the fix for a number that belongs in the vector before it: `[1 rgbt <1, 0, 0>, 0.5]`.
    fn outside_of_vector(&self, extra: &Token) -> Option<(Span, String)> {
        let text = &self.sources.get(extra.span.file).text;
        let number = self.sources.text(extra.span);
        number.parse::<f64>().ok()?;
        let before = text.get(..extra.span.start as usize)?.trim_end().strip_suffix(',')?;
        let open = before.trim_end().strip_suffix('>')?.rfind('<')?;
        let inside = &before.trim_end()[open + 1..before.trim_end().len() - 1];
        let whole = Span { start: open as u32, ..extra.span };
        (inside.matches(',').count() < 4).then(|| (whole, format!("<{inside}, {number}>")))
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
                let name = self.sources.text(extra.span).to_owned();
                let near = suggest::foreign(&name)
                    .find(|ours| matches!(*ours, "transmit" | "filter"))
                    .or_else(|| suggest::closest(&name, ["transmit", "filter"]));
                let is_name = matches!(extra.kind, TokenKind::Expression(id)
                    if self.unknown_name(&extra.here, id).is_some());
                if let Some(near) = near.filter(|_| is_name) {
                    let message = format!("`{name}` is not a word of a colour");
                    let told = Diagnostic::new(Code::UnknownWord, message)
                        .at(extra.span, format!("did you mean `{near}`?"))
                        .help(format!("replace it with `{near}`"))
                        .fix(extra.span, near);
                    let reported = self.report(&extra.here, told);
                    while self.next().is_some() {}
                    return Err(reported);
                }
                let diagnostic = match self.outside_of_vector(&extra) {
                    Some((whole, right)) => diagnostic
                        .help(format!("all numbers of a colour stand in its vector: `{right}`"))
                        .fix(whole, right),
                    None => diagnostic,
                };
                Err(self.report(&extra.here, diagnostic))
            }
        }
    }
}
