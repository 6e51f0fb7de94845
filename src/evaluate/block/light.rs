//! `light_source`: a point light, a beam, parallel rays, or the seed's direction.

mod area;
mod doubt;
mod form;
mod order;
mod written;

use crate::color::Rgb;
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{
    Dialect, LightKind, LightSource, LooksLike, Modifier, ModifierKind, Object, ObjectId,
    ObjectKind, ProjectedThrough, TransformId,
};
use crate::vocabulary::{Family, Word};

use super::super::lint::Cone;
use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::Place;
use order::Late;
use written::Written;

impl Evaluator<'_> {
    pub(super) fn light_source(&mut self, token: &Token) -> Outcome<ObjectId> {
        let site = token.here.site(token.span);
        let opener = token.clone();
        let mut closed_early = None;
        let outcome = self.block(token, Word::LightSource, |evaluator| {
            let mut modifiers = Vec::new();
            if let Some(declared) = evaluator.declared_light() {
                let name = evaluator.next();
                if let Some(name) = name
                    && let Some(reported) = evaluator.wrong_kind(&name, Word::LightSource, declared)
                {
                    let _: Outcome<()> = evaluator.light_modifiers(&mut modifiers, None, None);
                    return Err(reported);
                }
                // From here on an independent light, which its words can change.
                let (mut light, mut modifiers) = evaluator.light_of(declared);
                let outcome = evaluator.light_modifiers(&mut modifiers, light.as_mut(), None);
                let kind = light.map_or(ObjectKind::Use(declared), |light| {
                    ObjectKind::LightSource(Box::new(light))
                });
                return outcome.map(|()| (kind, modifiers));
            }
            if evaluator.takes_poison() {
                let _: Outcome<()> = evaluator.light_modifiers(&mut modifiers, None, None);
                return Err(Reported);
            }
            let (mut light, late) = evaluator.light_parts(&opener);
            if late.as_ref().is_some_and(Late::ends_block) {
                closed_early = evaluator.closer_before_color();
            }
            let outcome = evaluator.light_modifiers(&mut modifiers, light.as_mut().ok(), late);
            let light = light?;
            outcome?;
            Ok((ObjectKind::LightSource(Box::new(light)), modifiers))
        });
        if let (Err(Reported), Some(closer)) = (&outcome, closed_early) {
            return Err(self.color_behind_light(token, closer));
        }
        let (kind, modifiers) = outcome?;
        self.add_object(Object { kind, modifiers, site, item: None })
    }

    /// Returns a declared light's own parts, and every modifier applied to it, in order.
    fn light_of(&self, mut object: ObjectId) -> (Option<LightSource>, Vec<Modifier>) {
        let mut layers = Vec::new();
        loop {
            let Object { kind, modifiers, .. } = &self.scene.objects[object.index()];
            layers.push(modifiers);
            match kind {
                ObjectKind::Use(inner) => object = *inner,
                ObjectKind::LightSource(light) => {
                    return (
                        Some(light.as_ref().clone()),
                        layers.into_iter().rev().flatten().cloned().collect(),
                    );
                }
                ObjectKind::Solid(_) | ObjectKind::Union(_) | ObjectKind::Csg { .. } => {
                    return (None, Vec::new());
                }
            }
        }
    }

    fn declared_light(&mut self) -> Option<ObjectId> {
        match *self.peek_declared()? {
            Value::Object(object) => Some(object),
            _ => None,
        }
    }

    /// Reads the position and the colour; in a `.scene`, also `direction` and the colour. If another word of
    /// the light precedes the colour, the colour may come late.
    fn light_parts(&mut self, opener: &Token) -> (Outcome<LightSource>, Option<Late>) {
        if self.at_color_word() {
            return (self.color_before_place(opener), None);
        }
        if let Some(parts) = self.light_by_kind(opener) {
            return parts;
        }
        let kind = self.light_place(opener);
        self.semicolon_for_comma();
        let late = self.late_color(opener);
        let color = match late {
            // Reported where it appears, or as missing.
            Some(_) => Ok((Rgb::BLACK, None)),
            None => self.color_after(opener, "a colour for the light").map(|given| {
                let first = given.site();
                let all = self.joined(first, self.taken.unwrap_or(first));
                (given.value.rgb, Some(all))
            }),
        };
        let light = kind.and_then(|kind| {
            let (color, color_site) = color?;
            Ok(LightSource { color_site, ..LightSource::new(kind, color) })
        });
        (light, late)
    }

    fn light_place(&mut self, opener: &Token) -> Outcome<LightKind> {
        let ours = self.options.dialect == Dialect::Scene;
        match self.peek().map(|token| &token.kind) {
            Some(TokenKind::Word(Word::Direction)) if ours => self.seed_direction(),
            _ => self
                .vector_after(opener, "a vector for the light's place")
                .map(|given| LightKind::Point { location: given.value }),
        }
    }

    fn seed_direction(&mut self) -> Outcome<LightKind> {
        let Some(token) = self.next() else { return Err(Reported) };
        let to_light = self.direction_after(&token, "the direction to the light")?.value;
        Ok(LightKind::Direction { to_light })
    }

    /// Reads the words after the position and the colour. `light` is `None` if there is none to modify.
    fn light_modifiers(
        &mut self,
        modifiers: &mut Vec<Modifier>,
        mut light: Option<&mut LightSource>,
        mut late: Option<Late>,
    ) -> Outcome<()> {
        let mut failed = false;
        let mut written = Written::of(light.as_deref(), self.options.dialect);
        let mut cone = Cone::default();
        let ours = self.options.dialect == Dialect::Scene;
        while let Some(token) = self.next() {
            if is_of_a_place(&token) {
                written.of_a_place.push(token.clone());
            }
            if let Some(word) = area::word_of_area(&token) {
                let light = light.as_deref_mut();
                failed |= self.area_word(&token, word, light, modifiers, &mut written).is_err();
                continue;
            }
            let outcome = match token.kind {
                TokenKind::Word(word) if word.family() == Family::Color => {
                    self.take_late_color(&token, late.take(), light.as_deref_mut())
                }
                TokenKind::Word(Word::Direction) if ours => {
                    self.second_direction(&token, light.as_deref())
                }
                TokenKind::Word(word @ (Word::Parallel | Word::Spotlight | Word::Cylinder)) => {
                    let light = light.as_deref_mut().filter(|_| word != Word::Parallel);
                    if let Some(light) = light {
                        light.beam_site = Some(self.whole(&token));
                        light.shadowless &= ours;
                    }
                    written.shape(word, &token);
                    written.last = Some(token.clone());
                    self.kind_without_braces(&token)
                }
                TokenKind::Word(Word::PointAt) => {
                    written.last = Some(token.clone());
                    cone.word(&token);
                    if !ours {
                        written.aimed_after = transforms_of(modifiers);
                    }
                    self.vector_after(&token, "a point").map(|given| written.point_at = given.value)
                }
                TokenKind::Word(
                    word @ (Word::Radius
                    | Word::Falloff
                    | Word::Tightness
                    | Word::FadeDistance
                    | Word::FadePower),
                ) => self.number_after(&token, "a number").map(|given| {
                    cone.say(&token, word, &given);
                    written.say(word, given);
                    if word == Word::FadeDistance {
                        if let Some(light) = &mut light {
                            light.fade_site = Some(self.whole(&token));
                        }
                        self.power_behind_distance(&token);
                    }
                }),
                TokenKind::Word(Word::LooksLike) => {
                    self.looks_like(&token, light.as_deref_mut(), modifiers)
                }
                TokenKind::Word(Word::ProjectedThrough) => {
                    self.projected_through(&token, light.as_deref_mut(), modifiers)
                }
                TokenKind::Word(Word::Shadowless) => {
                    if let Some(light) = &mut light {
                        light.shadowless = true;
                    }
                    if !ours {
                        written.shape(Word::Shadowless, &token);
                    }
                    Ok(())
                }
                TokenKind::Word(word @ (Word::MediaAttenuation | Word::MediaInteraction)) => {
                    self.optional_flag(&token).map(|on| {
                        let site = self.whole(&token);
                        if let Some(light) = &mut light {
                            match word {
                                Word::MediaAttenuation => light.media_site = on.then_some(site),
                                _ => light.media_interaction = on,
                            }
                        }
                    })
                }
                _ => match self.transform_from(&token) {
                    Some(transform) => transform.map(|id| {
                        modifiers.push(Modifier {
                            kind: ModifierKind::Transform(id),
                            site: token.here.site(token.span),
                        });
                    }),
                    None => self.other_item(&token, Place::LIGHT),
                },
            };
            failed |= outcome.is_err();
        }
        if let Some(late) = late {
            failed |= self.no_color(&late).is_err();
        }
        if let Some(light) = light.as_deref()
            && !failed
        {
            failed = self.doubt_light(light, &written).is_err()
                || self.doubt_area(light, &written).is_err();
        }
        if let Some(light) = light.as_deref_mut()
            && let Some(token) = written.spend(light)
        {
            let diagnostic =
                Diagnostic::new(Code::ZeroVector, "this light points at its own place")
                    .at(token.span, "expected a `point_at` other than the light's place");
            // It emits no light, as in POV-Ray 3.7 (measured).
            failed = self.opinion(&token.here, diagnostic).is_err();
            light.color = Rgb::BLACK;
        }
        // The missing word may be in the item that failed.
        if let Some(light) = light
            && !failed
        {
            self.lint_light(&cone, &light.kind);
        }
        if failed { Err(Reported) } else { Ok(()) }
    }
}

impl Evaluator<'_> {
    /// Reads the object that is seen where the light is.
    fn looks_like(
        &mut self,
        token: &Token,
        light: Option<&mut LightSource>,
        modifiers: &[Modifier],
    ) -> Outcome<()> {
        let object = self.object_of_light(token, Word::LooksLike)?;
        if let Some(light) = light {
            light.looks_like = Some(LooksLike { object, after: transforms_of(modifiers) });
        }
        Ok(())
    }

    /// Reads the object in the block of a light's word.
    fn object_of_light(&mut self, token: &Token, word: Word) -> Outcome<ObjectId> {
        if !self.is_before_block() {
            self.block_is_missing(token, word);
            self.skip_values();
            return Err(Reported);
        }
        self.object_block(token)
    }

    /// Reads the object that the light shines through.
    fn projected_through(
        &mut self,
        token: &Token,
        light: Option<&mut LightSource>,
        modifiers: &[Modifier],
    ) -> Outcome<()> {
        let has_one = light.as_ref().is_some_and(|light| light.projected_through.is_some());
        if has_one {
            let message = "this light has a `projected_through` already";
            let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                .at(token.span, "one too many")
                .help("a `union` of the objects is one: `projected_through { union { … } }`");
            self.skip_arguments(Word::ProjectedThrough);
            return Err(self.report(&token.here, diagnostic));
        }
        let object = self.object_of_light(token, Word::ProjectedThrough)?;
        if let Some(light) = light {
            let (after, site) = (transforms_of(modifiers), self.whole(token));
            light.projected_through = Some(ProjectedThrough { object, after, site });
        }
        Ok(())
    }
}

/// Returns the transforms among the modifiers of a light.
fn transforms_of(modifiers: &[Modifier]) -> Vec<TransformId> {
    let transform = |modifier: &Modifier| match modifier.kind {
        ModifierKind::Transform(id) => Some(id),
        _ => None,
    };
    modifiers.iter().filter_map(transform).collect()
}

/// Returns whether a word specifies how light leaves a position, or fades with the distance from it.
fn is_of_a_place(token: &Token) -> bool {
    area::word_of_area(token).is_some()
        || matches!(
            token.kind,
            TokenKind::Word(
                Word::Parallel
                    | Word::Spotlight
                    | Word::Cylinder
                    | Word::PointAt
                    | Word::Radius
                    | Word::Falloff
                    | Word::Tightness
                    | Word::FadeDistance
                    | Word::FadePower
                    | Word::LooksLike
            )
        )
}
