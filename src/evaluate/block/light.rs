//! `light_source`: a point, parallel rays, or the seed's direction.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::{
    Dialect, LightKind, LightSource, Modifier, ModifierKind, Object, ObjectId, ObjectKind,
};
use crate::vocabulary::Word;

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
            _ => self
                .vector_after(opener, "a vector for the light's place")
                .map(|given| LightKind::Point { location: given.value }),
        };
        let color = self.color_after(opener, "a colour for the light");
        Ok(LightSource { kind: kind?, color: color?.value.rgb, shadowless: false })
    }

    fn seed_direction(&mut self) -> Outcome<LightKind> {
        let Some(token) = self.next() else { return Err(Reported) };
        let to_light = self.direction_after(&token, "the direction to the light")?.value;
        Ok(LightKind::Direction { to_light })
    }

    fn light_modifiers(
        &mut self,
        modifiers: &mut Vec<Modifier>,
        mut light: Option<&mut LightSource>,
    ) -> Outcome<()> {
        let mut failed = false;
        // POV-Ray 3.7's default, measured; its manual says the origin.
        let mut point_at = match self.options.dialect {
            Dialect::Scene => Vector::ZERO,
            Dialect::Pov => Vector::Z,
        };
        let mut parallel = false;
        while let Some(token) = self.next() {
            let outcome = match token.kind {
                TokenKind::Word(Word::Parallel) => {
                    parallel = true;
                    Ok(())
                }
                TokenKind::Word(Word::PointAt) => {
                    self.vector_after(&token, "a point").map(|given| point_at = given.value)
                }
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
                    None => {
                        self.unexpected(&token, Place::LIGHT);
                        let harmless =
                            matches!(token.kind, TokenKind::Comma | TokenKind::Semicolon);
                        if harmless || self.poison.is_some() { Ok(()) } else { Err(Reported) }
                    }
                },
            };
            failed |= outcome.is_err();
            if let (true, Some(light)) = (parallel, &mut light)
                && let LightKind::Point { location } | LightKind::Parallel { location, .. } =
                    light.kind
            {
                if location == point_at && self.peek().is_none() {
                    let diagnostic = Diagnostic::new(
                        Code::ZeroVector,
                        "this parallel light points at its own place",
                    )
                    .at(token.span, "expected a `point_at` other than the light's place");
                    self.report(&token.here, diagnostic);
                    failed = true;
                }
                light.kind = LightKind::Parallel { location, point_at };
            }
        }
        if failed { Err(Reported) } else { Ok(()) }
    }
}
