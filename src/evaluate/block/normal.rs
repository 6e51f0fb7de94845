//! `normal`: bumps of a pattern, or normals over a pattern.
//!
//! **In:** the items of a `normal` block. **Out:** a normal of the Scene.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.4.6.2 "Normal"; amounts measured.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Normal, NormalId, NormalKind, Pattern, Source, Step, TransformId};
use crate::source::Site;
use crate::texture::normal::bump::{ACCURACY, AMOUNT};
use crate::vocabulary::{Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::Place;
use super::blend_map::Entry;
use super::parts::{Block, Part, Parts};
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
    fn go_on_from(&mut self, normal: &Normal) {
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

impl Block for OpenNormal {
    const PLACE: Place = Place::NORMAL;
    const PARTS: Parts<Self> = &[
        Part::Number(Word::BumpSize, |normal, size, _| normal.amount = size),
        Part::Number(Word::Accuracy, |normal, accuracy, _| normal.accuracy = accuracy),
        Part::Flag(Word::NoBumpScale, |normal, (), _| normal.normal.keeps_depth = true),
        Part::Special(Word::BumpMap, |evaluator, token, normal| {
            let placed = evaluator.image(token, Word::BumpMap)?;
            normal.amount = placed.amount.unwrap_or(normal.amount);
            let source = Source::Image(Arc::new(placed.image));
            normal.pattern.choose(source, evaluator.whole(token));
            normal.is_image = true;
            Ok(())
        }),
        Part::Special(Word::SlopeMap, |evaluator, token, normal| {
            let entries = evaluator.entries_of(token, Word::SlopeMap, false)?.into_iter();
            let slope = |(value, entry)| match entry {
                Entry::Slope([height, slope]) => Some([value, height, slope]),
                _ => None,
            };
            normal.slopes = entries.filter_map(slope).collect();
            Ok(())
        }),
        Part::Special(Word::NormalMap, |evaluator, token, normal| {
            let pattern = normal.pattern.close();
            let average = pattern.is_some_and(|pattern| pattern.source == Source::Average);
            let entries = evaluator.entries_of(token, Word::NormalMap, average)?.into_iter();
            let of_entry = |(value, entry)| match entry {
                Entry::Normal(id) => Some((value, id)),
                _ => None,
            };
            normal.entries = Some(entries.filter_map(of_entry).collect());
            Ok(())
        }),
        Part::Special(Word::Object, |evaluator, token, normal| {
            let (source, entries) =
                evaluator.object_pattern(token, |evaluator, _| evaluator.list_of_normals(2))?;
            normal.entries = entries;
            normal.pattern.choose(source, evaluator.whole(token));
            Ok(())
        }),
    ];

    fn inherit(&mut self, evaluator: &Evaluator, value: &Value) -> bool {
        let Value::Normal(id) = value else { return false };
        self.go_on_from(&evaluator.scene.normals[id.index()]);
        true
    }

    fn transform(&mut self, _: &mut Evaluator, transform: TransformId, _: Site) {
        self.pattern.steps.push(Step::Transform(transform));
    }

    fn other(&mut self, evaluator: &mut Evaluator, token: &Token) -> Option<Outcome<()>> {
        match token.kind {
            TokenKind::Word(word) if word.family() == Family::Color => {
                Some(Err(evaluator.color_for_normal(token, word)))
            }
            TokenKind::Word(word) => match evaluator.pattern_item(token, &mut self.pattern) {
                Some(read) => Some(read),
                None => evaluator.bumps(token, word, self),
            },
            TokenKind::Expression(id) if evaluator.misspelt_item(token, id, Word::Normal) => {
                Some(Err(Reported))
            }
            _ => None,
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
            open.go_on_from(&self.scene.normals[start.index()]);
        }
        open
    }

    pub(super) fn item_of_normal(&mut self, token: &Token, open: &mut OpenNormal) {
        open.says_something = true;
        open.failed |= self.part(token, open).is_err();
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

    /// Reads a pattern, with its amount or its list.
    fn bumps(&mut self, token: &Token, word: Word, open: &mut OpenNormal) -> Option<Outcome<()>> {
        let source = self.pattern_source(token, word)?;
        Some(source.and_then(|source| {
            let site = self.whole(token);
            let mut has_list = false;
            if let Some(count) = source.list() {
                open.entries = self.list_of_normals(count)?;
                has_list = open.entries.is_some();
            }
            open.pattern.choose(source, site);
            open.is_image = false;
            // Entries that an inherited normal has over its pattern stay, and the amount has no effect (measured on
            // POV-Ray 3.7).
            if !has_list && self.is_before_value() {
                open.amount = self.number_after(token, "an amount")?.value;
            }
            Ok(())
        }))
    }

    /// Reports a colour.
    fn color_for_normal(&mut self, token: &Token, word: Word) -> Reported {
        let message = "a `normal` is made of a pattern, and has no colour";
        let diagnostic = Diagnostic::new(Code::MisplacedBlock, message)
            .at(token.span, "expected a pattern, such as `bumps 0.5`")
            .help("colours belong in `pigment { … }`");
        let reported = self.report(&token.here, diagnostic);
        self.skip_arguments(word);
        reported
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
