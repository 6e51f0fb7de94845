//! `clipped_by` and `bounded_by`: objects that clip or bound another object.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Modifier, ModifierKind, Object, ObjectId, ObjectKind};
use crate::vocabulary::{Dialect, Word};

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};
use super::{Place, opens_object};

impl Evaluator<'_> {
    /// Reads `clipped_by { shape … }`, or `clipped_by { bounded_by }`, which clips with the bounding objects.
    pub(super) fn clips(&mut self, token: &Token) -> Outcome<Vec<ObjectId>> {
        if let Some(reported) = self.unbraced(token, Word::ClippedBy, opens_object) {
            return Err(reported);
        }
        self.block(token, Word::ClippedBy, |evaluator| {
            let begins =
                |token: &Token| matches!(token.kind, TokenKind::Word(word) if opens_object(word));
            let begins = evaluator.peek().is_some_and(begins);
            let clips = match evaluator.take_word(Word::BoundedBy) {
                // Without bounds it clips nothing in POV-Ray 3.7 (measured).
                Some(bounds) if evaluator.bounds.is_empty() && evaluator.poison.is_none() => {
                    let message = "expected `bounded_by` with a solid before it";
                    let diagnostic = Diagnostic::new(Code::MissingPart, message)
                        .at(bounds.span, "nothing bounds the object, and this clips nothing");
                    evaluator.opinion(&token.here, diagnostic)?;
                    return Ok(Vec::new());
                }
                Some(_) => evaluator.bounds.clone(),
                None => evaluator.clipping_objects()?,
            };
            if clips.is_empty() && evaluator.poison.is_none() {
                if begins {
                    // The mistake in it was reported.
                    return Err(Reported);
                }
                let found = evaluator.next();
                return Err(evaluator.expected(
                    "a solid",
                    found.as_ref(),
                    (&token.here, token.span),
                ));
            }
            Ok(clips)
        })
    }

    /// Reads `bounded_by { shape … }` or `bounded_by { clipped_by }`.
    pub(super) fn bounds(&mut self, token: &Token) -> Outcome<()> {
        self.bounds.clear();
        if let Some(reported) = self.unbraced(token, Word::BoundedBy, opens_object) {
            return Err(reported);
        }
        self.block(token, Word::BoundedBy, |evaluator| {
            let lost = evaluator.lost_children;
            if evaluator.take_word(Word::ClippedBy).is_none() {
                evaluator.bounds = evaluator.clipping_objects()?;
            }
            while let Some(token) = evaluator.next() {
                evaluator.unexpected(&token, Place::BOUNDED_BY);
            }
            if evaluator.lost_children > lost { Err(Reported) } else { Ok(()) }
        })
    }

    /// Reads the contents of `clipped_by` and `bounded_by`: objects, in a `.pov` also by their bare names,
    /// and transforms of all of them, as in POV-Ray 3.7 (measured).
    fn clipping_objects(&mut self) -> Outcome<Vec<ObjectId>> {
        let mut objects = Vec::new();
        self.more_children(&mut objects, true);
        if self.options.dialect == Dialect::Scene || objects.is_empty() {
            return Ok(objects);
        }
        let mut steps = Vec::new();
        let starts_transform = |kind: &TokenKind| match kind {
            TokenKind::Word(word) => is_transform(*word),
            _ => false,
        };
        while let Some(token) = self.next_if(starts_transform) {
            if let Some(transform) = self.transform_from(&token) {
                let kind = ModifierKind::Transform(transform?);
                steps.push(Modifier { kind, site: token.here.site(token.span) });
            }
        }
        if steps.is_empty() {
            return Ok(objects);
        }
        let moved = |&object: &ObjectId| {
            let site = self.scene.objects[object.index()].site;
            let (kind, modifiers) = (ObjectKind::Use(object), steps.clone());
            self.add_object(Object { kind, modifiers, site, item: None })
        };
        objects.iter().map(moved).collect()
    }
}

fn is_transform(word: Word) -> bool {
    matches!(
        word,
        Word::Translate | Word::Rotate | Word::Scale | Word::Matrix | Word::TransformWord
    )
}
