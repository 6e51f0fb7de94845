//! `light_source`: a point, a beam, parallel rays, or the seed's direction.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::{
    Beam, Dialect, Fade, LightKind, LightSource, Modifier, ModifierKind, Object, ObjectId,
    ObjectKind,
};
use crate::vocabulary::{Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::Place;

impl Evaluator<'_> {
    pub(super) fn light_source(&mut self, token: &Token) -> Outcome<ObjectId> {
        let site = token.here.site(token.span);
        let opener = token.clone();
        let (kind, modifiers) = self.block(token, Word::LightSource, |evaluator| {
            let mut modifiers = Vec::new();
            if let Some(declared) = evaluator.declared_light() {
                let name = evaluator.next();
                if let Some(name) = name
                    && let Some(reported) = evaluator.wrong_kind(&name, Word::LightSource, declared)
                {
                    let _: Outcome<()> = evaluator.light_modifiers(&mut modifiers, None);
                    return Err(reported);
                }
                // A light of its own from here on: its words can change it.
                let (mut light, mut all) = evaluator.light_of(declared);
                let outcome = evaluator.light_modifiers(&mut modifiers, light.as_mut());
                all.append(&mut modifiers);
                let kind = light.map_or(ObjectKind::Use(declared), ObjectKind::LightSource);
                return outcome.map(|()| (kind, all));
            }
            if evaluator.takes_poison() {
                let _: Outcome<()> = evaluator.light_modifiers(&mut modifiers, None);
                return Err(Reported);
            }
            let mut light = evaluator.light_parts(&opener);
            let outcome = evaluator.light_modifiers(&mut modifiers, light.as_mut().ok());
            let light = light?;
            outcome?;
            Ok((ObjectKind::LightSource(light), modifiers))
        })?;
        self.add_object(Object { kind, modifiers, site, item: None })
    }

    /// A declared light's own parts, and every modifier it has got, in order.
    fn light_of(&self, mut object: ObjectId) -> (Option<LightSource>, Vec<Modifier>) {
        let mut layers = Vec::new();
        loop {
            let Object { kind, modifiers, .. } = &self.scene.objects[object.index()];
            layers.push(modifiers);
            match kind {
                ObjectKind::Use(inner) => object = *inner,
                ObjectKind::LightSource(light) => {
                    return (
                        Some(light.clone()),
                        layers.into_iter().rev().flatten().cloned().collect(),
                    );
                }
                ObjectKind::Sphere { .. }
                | ObjectKind::Plane { .. }
                | ObjectKind::Box { .. }
                | ObjectKind::Union(_) => {
                    return (None, Vec::new());
                }
            }
        }
    }

    fn declared_light(&mut self) -> Option<ObjectId> {
        let token = self.peek()?.clone();
        let TokenKind::Expression(id) = token.kind else { return None };
        match self.named(&token, id)? {
            Value::Object(object) => Some(object),
            _ => None,
        }
    }

    /// The place and the colour; or, in a `.scene`, `direction` and the colour.
    fn light_parts(&mut self, opener: &Token) -> Outcome<LightSource> {
        let ours = self.options.dialect == Dialect::Scene;
        let kind = match self.peek().map(|token| &token.kind) {
            Some(TokenKind::Word(Word::Direction)) if ours => self.seed_direction(),
            Some(TokenKind::Word(word)) if word.family() == Family::Color => {
                return Err(self.color_before_place(opener));
            }
            _ => self
                .vector_after(opener, "a vector for the light's place")
                .map(|given| LightKind::Point { location: given.value }),
        };
        let color = self.color_after(opener, "a colour for the light");
        Ok(LightSource { kind: kind?, color: color?.value.rgb, shadowless: false, fade: None })
    }

    /// `light_source { rgb 1, <5, 8, 6> }`.
    fn color_before_place(&mut self, opener: &Token) -> Reported {
        const PLACE: &str = "a vector for the light's place";
        const COLOR: &str = "a colour for the light";
        let Some(first) = self.peek().cloned() else { return Reported };
        let before = self.diagnostics.len();
        let color = self.color_after(opener, COLOR);
        if color.is_err() && self.diagnostics.len() > before {
            return Reported;
        }
        let color = self.whole(&first);
        self.skip_commas();
        match self.peek().map(|token| &token.kind) {
            Some(TokenKind::Expression(_) | TokenKind::Literal(_)) => {}
            _ => {
                let found = self.describe(&first);
                let name = self.describe(opener);
                let diagnostic = Diagnostic::new(
                    Code::MissingPart,
                    format!("expected {PLACE} after {name}, found {found}"),
                )
                .at(first.span_head(), format!("expected {PLACE}"))
                .also(opener.span, "for this")
                .help(Word::LightSource.sentence().to_owned());
                return self.report(&first.here, diagnostic);
            }
        }
        match self.vector_after(opener, PLACE) {
            Ok(place) => self.swapped(color, place.site(), PLACE, COLOR),
            Err(reported) => reported,
        }
    }

    fn seed_direction(&mut self) -> Outcome<LightKind> {
        let Some(token) = self.next() else { return Err(Reported) };
        let to_light = self.direction_after(&token, "the direction to the light")?.value;
        Ok(LightKind::Direction { to_light })
    }

    /// The words after the place and the colour. `light` is `None` where there is none to change.
    fn light_modifiers(
        &mut self,
        modifiers: &mut Vec<Modifier>,
        mut light: Option<&mut LightSource>,
    ) -> Outcome<()> {
        let mut failed = false;
        let mut written = Written::of(light.as_deref(), self.options.dialect);
        while let Some(token) = self.next() {
            let outcome = match token.kind {
                TokenKind::Word(word @ (Word::Parallel | Word::Spotlight | Word::Cylinder)) => {
                    written.shapes.push(word);
                    written.last = Some(token.clone());
                    Ok(())
                }
                TokenKind::Word(Word::PointAt) => {
                    written.last = Some(token.clone());
                    self.vector_after(&token, "a point").map(|given| written.point_at = given.value)
                }
                TokenKind::Word(Word::Radius) => self
                    .number_after(&token, "a number")
                    .map(|given| written.radius = Some(given.value)),
                TokenKind::Word(Word::Falloff) => self
                    .number_after(&token, "a number")
                    .map(|given| written.falloff = Some(given.value)),
                TokenKind::Word(Word::Tightness) => self
                    .number_after(&token, "a number")
                    .map(|given| written.tightness = given.value),
                TokenKind::Word(Word::FadeDistance) => self
                    .number_after(&token, "a distance")
                    .map(|given| written.fade.distance = given.value.abs()),
                TokenKind::Word(Word::FadePower) => self
                    .number_after(&token, "a number")
                    .map(|given| written.fade.power = given.value),
                TokenKind::Word(Word::Shadowless) => {
                    if let Some(light) = &mut light {
                        light.shadowless = true;
                    }
                    Ok(())
                }
                _ => match self.transform_from(&token) {
                    Some(transform) => transform.map(|id| {
                        modifiers.push(Modifier {
                            kind: ModifierKind::Transform(id),
                            site: token.here.site(token.span),
                        });
                    }),
                    None => self.other_light_word(&token),
                },
            };
            failed |= outcome.is_err();
        }
        if let Some(light) = light
            && let Some(token) = written.spend(light)
        {
            let diagnostic =
                Diagnostic::new(Code::ZeroVector, "this light points at its own place")
                    .at(token.span, "expected a `point_at` other than the light's place");
            self.report(&token.here, diagnostic);
            failed = true;
        }
        if failed { Err(Reported) } else { Ok(()) }
    }

    fn other_light_word(&mut self, token: &Token) -> Outcome<()> {
        if let Some(outcome) = self.inert(token, Place::LIGHT) {
            return outcome;
        }
        self.unexpected(token, Place::LIGHT);
        let harmless = matches!(token.kind, TokenKind::Comma | TokenKind::Semicolon);
        if harmless || self.poison.is_some() { Ok(()) } else { Err(Reported) }
    }
}

/// What a light's words say, in whatever order.
struct Written {
    /// `parallel`, `spotlight`, `cylinder`. The last counts; but what is `parallel` is no spotlight.
    shapes: Vec<Word>,
    /// The last word that says where its axis lies.
    last: Option<Token>,
    point_at: Vector,
    radius: Option<f64>,
    falloff: Option<f64>,
    tightness: f64,
    /// Of distance or power 0 or less: none.
    fade: Fade,
}

impl Written {
    /// What a light was before; nothing where there is none.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured: its default `point_at` is <0, 0, 1>, where its
    /// manual says <0, 0, 0>; `tightness` is 0, and a `fade_distance` or `fade_power` alone is nothing.
    fn of(light: Option<&LightSource>, dialect: Dialect) -> Self {
        let point_at = match dialect {
            Dialect::Scene => Vector::ZERO,
            Dialect::Pov => Vector::Z,
        };
        let mut written = Self {
            shapes: Vec::new(),
            last: None,
            point_at,
            radius: None,
            falloff: None,
            tightness: 0.0,
            fade: light.and_then(|light| light.fade).unwrap_or(Fade { distance: 0.0, power: 0.0 }),
        };
        match light.map(|light| &light.kind) {
            Some(LightKind::Parallel { point_at, .. }) => written.point_at = *point_at,
            Some(
                LightKind::Spotlight { point_at, beam, .. }
                | LightKind::Cylinder { point_at, beam, .. },
            ) => {
                written.point_at = *point_at;
                (written.radius, written.falloff) = (Some(beam.radius), Some(beam.falloff));
                written.tightness = beam.tightness;
            }
            Some(LightKind::Point { .. } | LightKind::Direction { .. }) | None => {}
        }
        written
    }

    /// Makes the light what is written; returns the word that needs another `point_at`.
    fn spend(self, light: &mut LightSource) -> Option<Token> {
        let Self { shapes, last, point_at, radius, falloff, tightness, fade } = self;
        light.fade = (fade.distance > 0.0 && fade.power > 0.0).then_some(fade);
        let (location, before) = match light.kind {
            LightKind::Point { location } => (location, None),
            LightKind::Parallel { location, .. } => (location, Some(Word::Parallel)),
            LightKind::Spotlight { location, .. } => (location, Some(Word::Spotlight)),
            LightKind::Cylinder { location, .. } => (location, Some(Word::Cylinder)),
            // Light from infinitely far has neither a distance nor an axis.
            LightKind::Direction { .. } => {
                light.fade = None;
                return None;
            }
        };
        let said = |word: Word| before == Some(word) || shapes.contains(&word);
        if shapes.is_empty() && before.is_none() {
            return None;
        }
        let beam = |least: f64, most: f64| Beam {
            radius: radius.unwrap_or(least),
            falloff: falloff.unwrap_or(most),
            tightness,
        };
        let mut round = shapes.iter().rev().copied().chain(before);
        let round = round.find(|word| *word != Word::Parallel);
        light.kind = match (round, said(Word::Parallel)) {
            (Some(Word::Cylinder), _) => {
                LightKind::Cylinder { location, point_at, beam: beam(0.75, 1.0) }
            }
            (Some(_), false) => LightKind::Spotlight { location, point_at, beam: beam(30.0, 45.0) },
            (None, _) | (Some(_), true) => LightKind::Parallel { location, point_at },
        };
        last.filter(|_| location == point_at)
    }
}
