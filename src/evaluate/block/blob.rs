//! `blob`: spheres and cylinders with a strength each, and the threshold.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::blob::{Blob, Component};
use crate::scene::{Modifier, ModifierKind, Solid, Texture, TransformId};
use crate::source::Span;
use crate::vocabulary::{Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};
use super::{Given, Place};

/// A threshold below this counts as 0.
const SMALLEST: f64 = 1e-6;

impl Evaluator<'_> {
    /// Reads `blob { threshold number sphere { … } cylinder { … } … }`, in any order.
    pub(super) fn blob(&mut self, token: &Token) -> Outcome<Solid> {
        let mut blob = Blob { threshold: 1.0, components: Vec::new(), textures: Vec::new() };
        let (mut failed, mut count, mut bytes) = (false, 0, 0);
        loop {
            self.skip_commas();
            if self.passes_no_part(Place::shape(Word::Blob), &[Word::Sphere, Word::Cylinder]) {
                failed = true;
                continue;
            }
            let Some(Token { kind: TokenKind::Word(word), .. }) = self.peek() else { break };
            let word = *word;
            let read: fn(&mut Self, &Token, Word, &mut Blob) -> Outcome<()> = match word {
                Word::Sphere | Word::Cylinder => Self::blob_component,
                Word::Component => Self::old_component,
                Word::Threshold => Self::threshold,
                Word::Hierarchy | Word::Sturm => Self::inert_among_parts,
                _ => break,
            };
            let Some(part) = self.next() else { break };
            count += usize::from(word.family() == Family::Shape || word == Word::Component);
            let before = blob.components.len();
            failed |= read(self, &part, word, &mut blob).is_err();
            bytes += blob.components[before..].iter().map(Component::bytes).sum::<u64>();
            if !self.has_memory(bytes) {
                return Err(self.too_much_memory(&part.here, part.span));
            }
        }
        if failed || self.poison.is_some() {
            return Err(Reported);
        }
        self.stored += bytes;
        // Another shape is reported where it appears.
        let is_shape = |kind: &TokenKind| matches!(kind, TokenKind::Word(word) if word.family() == Family::Shape);
        if count == 0 && self.peek().is_some_and(|next| is_shape(&next.kind)) {
            return Err(Reported);
        }
        if count == 0 {
            let diagnostic = Diagnostic::new(Code::MissingPart, "this blob has no component")
                .at(token.span, "nothing to melt together")
                .help("a component is written `sphere { <center>, radius, strength }`");
            // Unless its components come too late.
            self.owed = Some((token.here.clone(), diagnostic));
            return Err(Reported);
        }
        if blob.is_weak() && blob.threshold < f64::INFINITY {
            let message = format!(
                "the strengths of this blob add up to no more than its threshold, {}",
                blob.threshold
            );
            let diagnostic = Diagnostic::new(Code::DegenerateShape, message);
            let diagnostic = match self.number_behind(token, Word::Threshold) {
                Some(threshold) => diagnostic
                    .at(threshold, "expected less than they add up to: nothing is left of it")
                    .also(token.span, "of this blob"),
                None => diagnostic.at(token.span, "nothing is left of it"),
            };
            self.scene.sizeless.push((Word::Blob.name(), token.here.site(token.span)));
            self.report(&token.here, diagnostic);
        }
        Ok(Solid::Blob(Arc::new(blob)))
    }

    /// Returns the span of the literal number after the only `word` in a block that `token` opened.
    fn number_behind(&self, token: &Token, word: Word) -> Option<Span> {
        let block = self.within_block().filter(|block| block.span.file == token.span.file)?.span;
        let mut found = self.sources.text(block).match_indices(word.name());
        let at = found.next().map(|(at, name)| at + name.len())?;
        let rest = self.sources.text(block).get(at..)?;
        let blank = rest.len() - rest.trim_start().len();
        let number = rest.trim_start().split(|c: char| c.is_whitespace() || c == '}').next()?;
        let start = block.start + (at + blank) as u32;
        let is_number = number.parse::<f64>().is_ok() && found.next().is_none();
        is_number.then(|| Span { start, end: start + number.len() as u32, ..block })
    }

    fn threshold(&mut self, token: &Token, word: Word, blob: &mut Blob) -> Outcome<()> {
        let given = self.number_after(token, "a number for the threshold")?;
        if given.value <= 0.0 {
            let read = match given.value == 0.0 {
                true => "the blob ends where its field does",
                false => "nothing is drawn",
            };
            self.out_of_range_but_read(&given, word, "more than 0", read)?;
        }
        blob.threshold = match given.value {
            0.0 => SMALLEST,
            value if value < 0.0 => f64::INFINITY,
            value => value,
        };
        Ok(())
    }

    fn inert_among_parts(&mut self, token: &Token, _: Word, _: &mut Blob) -> Outcome<()> {
        self.inert(token, Place::shape(Word::Blob)).unwrap_or(Ok(()))
    }

    /// Reads `sphere { <centre>, radius, strength … }` or `cylinder { <end>, <end>, radius, strength … }`.
    fn blob_component(&mut self, token: &Token, word: Word, blob: &mut Blob) -> Outcome<()> {
        self.block(token, word, |evaluator| {
            let is_bar = word == Word::Cylinder;
            if let Some(reported) = evaluator.bare_points(if is_bar { 2 } else { 1 }, 2) {
                return Err(reported);
            }
            let first = if is_bar { "an end" } else { "the centre" };
            let a = evaluator.point(token, &format!("a vector for {first}"));
            let b = match is_bar {
                true => Some(evaluator.point(token, "a vector for the other end")),
                false => None,
            };
            let radius = evaluator.number_after(token, "a number for the radius");
            evaluator.skip_commas();
            let _ = evaluator.take_word(Word::Strength);
            let strength = evaluator.number_after(token, "a number for the strength");
            let (a, b, radius, strength) = (a?, b.transpose()?, radius?, strength?);
            if let Some(b) = b.as_ref().filter(|b| b.value == a.value) {
                let message = "a cylinder of a blob whose ends are in one place is a sphere";
                let diagnostic = Diagnostic::new(Code::ZeroSize, message)
                    .at(b.span, "expected another place")
                    .also(a.span, "the first end");
                return Err(evaluator.report(&b.here, diagnostic));
            }
            let (transforms, texture) = evaluator.component_modifiers(word)?;
            let paint = texture.map(|texture| evaluator.texture_of_component(texture, blob));
            let ends = [a.value, b.map_or(a.value, |b| b.value)];
            evaluator.add_component(ends, radius, strength, (transforms, paint), blob);
            Ok(())
        })
    }

    /// Reads `component strength, radius, <centre>`.
    fn old_component(&mut self, token: &Token, _: Word, blob: &mut Blob) -> Outcome<()> {
        let strength = self.number_after(token, "a number for the strength");
        let radius = self.number_after(token, "a number for the radius");
        let centre = self.point(token, "a vector for the centre");
        let (strength, radius, centre) = (strength?, radius?, centre?);
        self.add_component([centre.value; 2], radius, strength, (Vec::new(), None), blob);
        Ok(())
    }

    /// Adds a component. One without size or strength is reported and omitted.
    fn add_component(
        &mut self,
        ends: [Vector; 2],
        radius: Given<f64>,
        strength: Given<f64>,
        (transforms, paint): (Vec<TransformId>, Option<u32>),
        blob: &mut Blob,
    ) {
        for (given, what) in [(&radius, "radius"), (&strength, "strength")] {
            if given.value == 0.0 {
                let message = format!("a component of {what} 0 has no field");
                let diagnostic = Diagnostic::new(Code::DegenerateShape, message)
                    .at(given.span, "left out: nothing of it could be seen");
                self.report(&given.here, diagnostic);
                return;
            }
        }
        if radius.value < 0.0 {
            self.lint_negative_radius(&radius.here, radius.span, radius.value);
        }
        let (radius, strength) = (radius.value, strength.value);
        blob.components.push(Component { ends, radius, strength, transforms, paint });
    }

    /// Reads the transforms of a component, and its own texture, which those behind it move.
    fn component_modifiers(&mut self, word: Word) -> Outcome<(Vec<TransformId>, Option<Texture>)> {
        let (mut transforms, mut failed) = (Vec::new(), false);
        let (mut texture, mut textured) = (None::<Texture>, false);
        let mut written = Vec::new();
        while let Some(token) = self.next() {
            match (self.transform_from(&token), &token.kind) {
                (Some(transform), _) => match transform {
                    Ok(transform) => {
                        transforms.push(transform);
                        texture.iter_mut().for_each(|texture| texture.transforms.push(transform));
                        let (kind, site) =
                            (ModifierKind::Transform(transform), token.here.site(token.span));
                        written.push(Modifier { kind, site });
                    }
                    Err(Reported) => failed = true,
                },
                (None, TokenKind::Comma) => {}
                (
                    None,
                    TokenKind::Word(Word::Texture | Word::Pigment | Word::Finish | Word::Normal),
                ) => {
                    let before = written.len();
                    match self.modifier(&token, None, &mut written, &mut textured) {
                        Some(Ok(kind)) => {
                            let site = token.here.site(token.span);
                            written.extend(kind.map(|kind| Modifier { kind, site }));
                            for Modifier { kind, .. } in &written[before..] {
                                self.modify_texture(&mut texture, kind);
                            }
                        }
                        _ => failed = true,
                    }
                }
                (None, _) => {
                    self.unexpected(&token, Place::component(word));
                    failed = true;
                }
            }
        }
        if failed { Err(Reported) } else { Ok((transforms, texture)) }
    }

    /// Returns the index of a texture in a blob's list, adding it if it is not the last one.
    fn texture_of_component(&mut self, texture: Texture, blob: &mut Blob) -> u32 {
        let last = blob.textures.last().map(|last| &self.scene.textures[last.index()]);
        if last != Some(&texture) {
            blob.textures.push(self.add_texture(texture));
        }
        blob.textures.len() as u32 - 1
    }
}
