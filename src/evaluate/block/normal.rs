//! `normal`: bumps of a pattern, or normals over a pattern.
//!
//! **In:** the items of a `normal` block. **Out:** a normal of the Scene.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.4.6.2 "Normal"; amounts measured.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Normal, NormalId, NormalKind, Pattern, Source};
use crate::texture::normal::bump::{ACCURACY, AMOUNT};
use crate::vocabulary::{Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::Place;
use super::blend_map::Entry;
use super::pattern::OpenPattern;

/// A normal during reading.
pub(super) struct OpenNormal {
    normal: Normal,
    pattern: OpenPattern,
    amount: f64,
    accuracy: f64,
    slopes: Vec<[f64; 3]>,
    entries: Option<Vec<(f64, NormalId)>>,
    /// It is a `bump_map`.
    is_image: bool,
    says_something: bool,
    failed: bool,
}

impl OpenNormal {
    /// Goes on from a declared normal.
    fn inherit(&mut self, normal: &Normal) {
        let pattern = normal.kind.pattern();
        let is_flat =
            matches!(normal.kind, NormalKind::Bumps { .. }) && pattern.source == Source::Average;
        self.pattern.inherit(Some(pattern), &normal.steps);
        if is_flat {
            self.pattern.inherited = None;
        }
        self.normal.keeps_depth = normal.keeps_depth;
        match &normal.kind {
            NormalKind::Bumps { amount, accuracy, slopes, .. } => {
                (self.amount, self.accuracy) = (*amount, *accuracy);
                self.slopes.clone_from(slopes);
            }
            NormalKind::Image { amount, .. } => {
                (self.amount, self.is_image) = (*amount, true);
            }
            NormalKind::Map { entries, .. } => self.entries = Some(entries.clone()),
        }
    }
}

impl Evaluator<'_> {
    /// Reads `normal { [Name] … }`, starting from the default texture's normal.
    pub(super) fn normal(&mut self, token: &Token) -> Outcome<NormalId> {
        let start = self.scene.textures[self.default_texture.index()].kind.first_normal();
        self.normal_from(token, start)
    }

    pub(super) fn normal_from(
        &mut self,
        token: &Token,
        start: Option<NormalId>,
    ) -> Outcome<NormalId> {
        self.block(token, Word::Normal, |evaluator| evaluator.normal_of_items(token, start, true))
    }

    /// Reads the items of a normal, up to the end of its block or entry. `needs_pattern`: one without a pattern
    /// is a mistake.
    pub(super) fn normal_of_items(
        &mut self,
        opener: &Token,
        start: Option<NormalId>,
        needs_pattern: bool,
    ) -> Outcome<NormalId> {
        let mut open = self.open_normal(opener, start);
        while let Some(token) = self.next() {
            self.item_of_normal(&token, &mut open);
        }
        self.close_normal(opener, open, needs_pattern)
    }

    /// Returns a normal, begun by `opener`, into which items are read.
    pub(super) fn open_normal(&self, opener: &Token, start: Option<NormalId>) -> OpenNormal {
        let site = opener.here.site(opener.span);
        let (amount, accuracy) = (AMOUNT, ACCURACY);
        let flat = Box::new(OpenPattern::flat(site));
        let none = NormalKind::Bumps { pattern: flat, amount, accuracy, slopes: vec![] };
        let mut open = OpenNormal {
            normal: Normal { kind: none, steps: Vec::new(), site, keeps_depth: false },
            pattern: OpenPattern::new(self.noise, self.waves),
            amount,
            accuracy,
            slopes: Vec::new(),
            entries: None,
            is_image: false,
            says_something: false,
            failed: false,
        };
        if let Some(start) = start {
            open.inherit(&self.scene.normals[start.index()]);
        }
        open
    }

    pub(super) fn item_of_normal(&mut self, token: &Token, open: &mut OpenNormal) {
        open.says_something = true;
        if self.normal_item(token, open) == Err(Reported) {
            open.failed = true;
            self.skip_values();
        }
    }

    /// Adds the normal that was read. `needs_pattern` is as for [`Self::normal_of_items`].
    pub(super) fn close_normal(
        &mut self,
        opener: &Token,
        open: OpenNormal,
        needs_pattern: bool,
    ) -> Outcome<NormalId> {
        if open.failed {
            return Err(Reported);
        }
        let says_something = open.says_something;
        let OpenNormal { mut normal, pattern, amount, accuracy, slopes, entries, is_image, .. } =
            open;
        let site = normal.site;
        normal.steps = pattern.steps.clone();
        match pattern.close() {
            Some(pattern) if pattern.source == Source::Average && entries.is_none() => {
                return Err(self.average_of_nothing(pattern.site, Word::NormalMap));
            }
            Some(pattern) => {
                let pattern = Box::new(pattern);
                normal.kind = match entries {
                    Some(entries) => NormalKind::Map { pattern, entries },
                    None if is_image => NormalKind::Image { pattern, amount },
                    None => NormalKind::Bumps { pattern, amount, accuracy, slopes },
                };
            }
            // Flat in POV-Ray 3.7, too. What else it says holds for normals that start from it.
            None if self.poison.is_some() || !needs_pattern || says_something => {
                let modifiers = pattern.modifiers;
                let pattern = Box::new(Pattern { modifiers, ..OpenPattern::flat(site) });
                normal.kind = NormalKind::Bumps { pattern, amount, accuracy, slopes };
            }
            None => {
                let diagnostic = Diagnostic::new(Code::MissingPart, "this `normal` has no pattern")
                    .at(site.span, "it is flat")
                    .help("name a pattern, such as `bumps 0.5`");
                self.opinion(&opener.here, diagnostic)?;
            }
        }
        Ok(self.add_normal(normal))
    }

    pub(super) fn add_normal(&mut self, normal: Normal) -> NormalId {
        self.stored += size_of::<Normal>() as u64 + 200;
        self.scene.normals.push(normal);
        NormalId(self.scene.normals.len() as u32 - 1)
    }

    fn normal_item(&mut self, token: &Token, open: &mut OpenNormal) -> Outcome<()> {
        if let Some(read) = self.pattern_item(token, &mut open.pattern) {
            return read;
        }
        let word = match token.kind {
            TokenKind::Word(word) => word,
            TokenKind::Expression(id) => {
                match self.declared(token, id) {
                    Some(Value::Normal(id)) => {
                        let declared = self.scene.normals[id.index()].clone();
                        open.inherit(&declared);
                    }
                    Some(Value::Broken) => return Err(Reported),
                    Some(Value::Poison(poison)) => {
                        self.is_of_place(token, poison, Place::NORMAL);
                        self.set_poison(poison);
                    }
                    _ => {
                        if self.misspelt_item(token, id, Word::Normal) {
                            return Err(Reported);
                        }
                        self.unexpected(token, Place::NORMAL);
                        return Err(Reported);
                    }
                }
                return Ok(());
            }
            TokenKind::Comma => return Ok(()),
            _ => {
                self.unexpected(token, Place::NORMAL);
                return Err(Reported);
            }
        };
        match word {
            Word::BumpSize => open.amount = self.number_after(token, "a number")?.value,
            Word::Accuracy => open.accuracy = self.number_after(token, "a number")?.value,
            Word::NoBumpScale => open.normal.keeps_depth = true,
            Word::BumpMap => {
                let placed = self.image(token, word)?;
                open.amount = placed.amount.unwrap_or(open.amount);
                let source = Source::Image(Arc::new(placed.image));
                open.pattern.choose(source, self.whole(token));
                open.is_image = true;
            }
            Word::SlopeMap => {
                let entries = self.entries_of(token, word, false)?.into_iter();
                let slope = |(value, entry)| match entry {
                    Entry::Slope([height, slope]) => Some([value, height, slope]),
                    _ => None,
                };
                open.slopes = entries.filter_map(slope).collect();
            }
            Word::NormalMap => {
                let pattern = open.pattern.close();
                let average = pattern.is_some_and(|pattern| pattern.source == Source::Average);
                let entries = self.entries_of(token, word, average)?.into_iter();
                let normal = |(value, entry)| match entry {
                    Entry::Normal(id) => Some((value, id)),
                    _ => None,
                };
                open.entries = Some(entries.filter_map(normal).collect());
            }
            Word::Object => {
                let (source, entries) =
                    self.object_pattern(token, |evaluator, _| evaluator.list_of_normals(2))?;
                open.entries = entries;
                open.pattern.choose(source, self.whole(token));
            }
            _ if word.family() == Family::Color => {
                let message = "a `normal` is made of a pattern, and has no colour";
                let diagnostic = Diagnostic::new(Code::MisplacedBlock, message)
                    .at(token.span, "expected a pattern, such as `bumps 0.5`")
                    .help("colours belong in `pigment { … }`");
                let reported = self.report(&token.here, diagnostic);
                self.skip_arguments(word);
                return Err(reported);
            }
            _ => {
                if let Some(source) = self.pattern_source(token, word) {
                    let source = source?;
                    let site = self.whole(token);
                    if let Some(count) = source.list() {
                        open.entries = self.list_of_normals(count)?;
                    }
                    open.pattern.choose(source, site);
                    open.is_image = false;
                    if open.entries.is_none() && self.is_before_value() {
                        open.amount = self.number_after(token, "an amount")?.value;
                    }
                    return Ok(());
                }
                if let Some(outcome) = self.inert(token, Place::NORMAL) {
                    return outcome;
                }
                let poisoned = self.poison.is_some();
                self.unexpected(token, Place::NORMAL);
                if !poisoned && self.poison.is_none() {
                    return Err(Reported);
                }
            }
        }
        Ok(())
    }

    /// Reads the normals after a pattern that takes `count`, if there are any.
    fn list_of_normals(&mut self, count: usize) -> Outcome<Option<Vec<(f64, NormalId)>>> {
        let mut normals = Vec::new();
        while normals.len() < count {
            self.skip_commas();
            let Some(Token { kind: TokenKind::Word(Word::Normal), .. }) = self.peek() else {
                break;
            };
            let Some(next) = self.next() else { break };
            normals.push((normals.len() as f64, self.normal(&next)?));
        }
        Ok((!normals.is_empty()).then_some(normals))
    }

    /// Reads the height and the slope of an entry: `<height, slope>`.
    pub(super) fn slope_of_entry(&mut self, entry: &Token) -> Outcome<[f64; 2]> {
        let given = self.given(entry, "a height and a slope")?;
        self.skip_commas();
        if let Some(rest) = self.peek().cloned() {
            let wanted = "the end of the entry: a height and a slope stand in angle brackets";
            return Err(self.expected(wanted, Some(&rest), (&rest.here, rest.span)));
        }
        let numbers = given.value.numbers();
        match numbers.as_ref().map(|numbers| numbers.as_slice()) {
            // As in POV-Ray, a number stands for both.
            Some([both]) => Ok([*both, *both]),
            Some([height, slope]) => Ok([*height, *slope]),
            _ => {
                let wanted = "a height and a slope: `<height, slope>`";
                Err(self.wrong_type(&given.here, given.span, wanted, &given.value))
            }
        }
    }
}
