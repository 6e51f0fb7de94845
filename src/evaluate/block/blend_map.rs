//! Maps of things over the values of a pattern: `pigment_map`, `normal_map`, `texture_map`.
//!
//! **In:** entries `[value thing]`, or the names of declared things' maps. **Out:** the entries, sorted by
//! value; in a `.pov` those that render as POV-Ray renders the written ones. In the map of an `average`, the value is a weight, and may be missing.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::rising::rising;
use crate::evaluate::block::{Given, Place};
use crate::evaluate::lint::Rise;
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Outcome, Reported};
use crate::scene::{NormalId, PigmentId, TextureId};
use crate::source::Site;
use crate::vocabulary::{Dialect, Word};

/// What an entry of a map holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Entry {
    Pigment(PigmentId),
    Normal(NormalId),
    Texture(TextureId),
    /// A height and a slope.
    Slope([f64; 2]),
}

/// A declared map: its word, and its entries as written: in an `average`, their numbers are weights.
#[derive(Debug, Clone, PartialEq)]
pub struct BlendMap {
    pub word: Word,
    pub entries: Arc<[(f64, Entry)]>,
}

impl Evaluator<'_> {
    /// Reads a map whose entries `read` reads, up to their end, after the number.
    fn blend_map(
        &mut self,
        token: &Token,
        map: Word,
        average: bool,
        mut read: impl FnMut(&mut Self, &Token) -> Outcome<Entry>,
    ) -> Outcome<(Vec<(f64, Entry)>, Rise)> {
        let place = Place { word: Some(map), families: &[], others: &[] };
        let mut entries: Vec<(f64, Entry)> = Vec::new();
        let mut rise = Rise::default();
        let opener = token.clone();
        self.block(token, map, |evaluator| {
            let mut failed = false;
            while let Some(token) = evaluator.next() {
                match &token.kind {
                    TokenKind::Entry(items) => {
                        let here = token.here.clone();
                        let entry = evaluator.inside(&here, *items, |evaluator| {
                            let value = match evaluator.value_of_entry(&token, average)? {
                                Some(given) => {
                                    let value = given.value;
                                    rise.entry(given, evaluator.sources);
                                    value
                                }
                                None => 1.0,
                            };
                            if let Some(reported) = evaluator.wrapped_entry(map) {
                                return Err(reported);
                            }
                            read(evaluator, &token).map(|of| (value, of))
                        });
                        match entry {
                            Ok(entry) => entries.push(entry),
                            Err(Reported) => failed = true,
                        }
                    }
                    TokenKind::Comma => {}
                    TokenKind::Expression(id) => match evaluator.declared(&token, *id) {
                        Some(Value::BlendMap(declared)) if declared.word == map => {
                            let values = declared.entries.iter().map(|(value, _)| *value);
                            rise.named(values, token.here.site(token.span));
                            entries.extend_from_slice(&declared.entries);
                        }
                        Some(Value::Broken) => failed = true,
                        Some(Value::Poison(poison)) => evaluator.set_poison(poison),
                        _ => {
                            evaluator.unexpected(&token, place);
                            failed = true;
                        }
                    },
                    _ => {
                        evaluator.unexpected(&token, place);
                        failed = true;
                    }
                }
            }
            if failed {
                return Err(Reported);
            }
            if entries.is_empty() {
                if evaluator.poison.is_some() {
                    return Err(Reported);
                }
                let message = format!("this `{}` is empty", map.name());
                let diagnostic = Diagnostic::new(Code::MissingPart, message)
                    .at(opener.span, "expected entries in square brackets");
                return Err(evaluator.report(&opener.here, diagnostic));
            }
            Ok((entries, rise))
        })
    }

    /// Reports an entry in a block of its own: `[0 pigment { rgb 1 }]` in a `pigment_map`.
    fn wrapped_entry(&mut self, map: Word) -> Option<Reported> {
        let own = match map {
            Word::PigmentMap => Word::Pigment,
            Word::NormalMap => Word::Normal,
            Word::TextureMap => Word::Texture,
            _ => return None,
        };
        self.skip_commas();
        let token = self.next_if(|kind| *kind == TokenKind::Word(own))?;
        self.pass_not_built(&token, own);
        let whole = self.whole(&token).span;
        let (name, map) = (own.name(), map.name());
        let message = format!("an entry of a `{map}` is a {name} without `{name} {{ }}`");
        let told = Diagnostic::new(Code::ExtraPart, message).at(token.span, "leave it out");
        let inside = self.sources.text(whole).strip_prefix(name).map(str::trim_start);
        let inside = inside.and_then(|text| text.strip_prefix('{')?.strip_suffix('}'));
        let told = match inside.map(str::trim) {
            Some(inside) if !inside.is_empty() => {
                told.help(format!("write `[… {inside}]`")).fix(whole, inside)
            }
            _ => told.help(format!("write what is in its braces: `{map} {{ [0 …] [1 …] }}`")),
        };
        Some(self.report(&token.here, told))
    }

    /// Sorts the entries of a map. POV-Ray's curve of a `slope_map` is read as it is written.
    fn in_order(&mut self, map: Word, entries: &mut Vec<(f64, Entry)>, site: Site) {
        if entries.is_sorted_by(|a, b| a.0 <= b.0) {
            return;
        }
        match self.options.dialect {
            Dialect::Scene => entries.sort_by(|a, b| a.0.total_cmp(&b.0)),
            Dialect::Pov if map == Word::SlopeMap => {}
            Dialect::Pov => {
                *entries = rising(entries, |a, b, part| self.between(a, b, part, site));
            }
        }
    }

    /// Reads `pigment_map { … }` and the like as a value, after its keyword.
    pub(super) fn map_value(&mut self, token: &Token, word: Word) -> Outcome<Value> {
        let (entries, _) = self.written_entries(token, word, false)?;
        Ok(Value::BlendMap(BlendMap { word, entries: entries.into() }))
    }

    /// Reads the entries of a map by its keyword.
    pub(super) fn entries_of(
        &mut self,
        token: &Token,
        word: Word,
        average: bool,
    ) -> Outcome<Vec<(f64, Entry)>> {
        let (mut entries, rise) = self.written_entries(token, word, average)?;
        if !average {
            self.lint_map(rise, word);
            self.in_order(word, &mut entries, token.here.site(token.span));
        }
        Ok(entries)
    }

    fn written_entries(
        &mut self,
        token: &Token,
        word: Word,
        average: bool,
    ) -> Outcome<(Vec<(f64, Entry)>, Rise)> {
        self.blend_map(token, word, average, |evaluator, opener| match word {
            Word::PigmentMap => evaluator.pigment_of_entry(opener).map(Entry::Pigment),
            Word::NormalMap => {
                let default = evaluator.default_texture.index();
                let start = evaluator.scene.textures[default].kind.first_normal();
                evaluator.normal_of_items(opener, start, false).map(Entry::Normal)
            }
            Word::SlopeMap => evaluator.slope_of_entry(opener).map(Entry::Slope),
            _ => evaluator.texture_of_entry().map(Entry::Texture),
        })
    }

    /// Reports an `average` without its `map`.
    pub(super) fn average_of_nothing(&mut self, average: Site, map: Word) -> Reported {
        let map = map.name();
        let diagnostic =
            Diagnostic::new(Code::MissingPart, format!("this `average` lacks its `{map}`"))
                .at(average.span, "the mean of what?")
                .help(format!("write `average {map} {{ [1 …] [1 …] }}`"));
        self.report_in(average.expansion, diagnostic)
    }

    /// Reads the number that begins an entry; `None` for a weight that is missing.
    fn value_of_entry(&mut self, entry: &Token, average: bool) -> Outcome<Option<Given<f64>>> {
        let next = self.peek().cloned();
        let begins_with_word =
            matches!(next.as_ref().map(|next| &next.kind), Some(TokenKind::Word(_)));
        if begins_with_word && average {
            return Ok(None);
        }
        if let Some(Token { kind: TokenKind::Word(word), here, span }) = next {
            let message = format!("expected a number before `{}`", word.name());
            let diagnostic = Diagnostic::new(Code::MissingPart, message)
                .at(span, "an entry of a map begins with a number")
                .help(format!("write `[0.5 {} …]`", word.name()));
            return Err(self.report(&here, diagnostic));
        }
        self.number_after(entry, "a number").map(Some)
    }
}
