//! `fog { distance … color … fog_type … turbulence … }`: haze.

use std::sync::Arc;

use crate::color::Color;
use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::{Fog, FogTurbulence};
use crate::vocabulary::{Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::{Given, Place};

impl Place {
    pub const FOG: Self = Self {
        word: Some(Word::Fog),
        families: &[Family::Color, Family::Transform],
        others: &[
            Word::Distance,
            Word::FogAlt,
            Word::FogOffset,
            Word::FogType,
            Word::Lambda,
            Word::Octaves,
            Word::Omega,
            Word::TurbDepth,
            Word::Turbulence,
            Word::Up,
        ],
    };
}

/// Which items a fog has so far.
#[derive(Debug, Clone, Copy, Default)]
struct Has {
    distance: bool,
    color: bool,
    any: bool,
}

impl Evaluator<'_> {
    /// Reads a fog of the scene.
    pub(super) fn placed_fog(&mut self, token: &Token) -> Outcome<()> {
        if let Value::Fog(fog) = self.fog(token)? {
            let item = self.whole(token);
            self.scene.fogs.push(Fog { item, ..fog.as_ref().clone() });
            return Ok(());
        }
        self.needs_poison()
    }

    /// Reads `fog { [Name] … }`.
    pub(super) fn fog(&mut self, token: &Token) -> Outcome<Value> {
        let mut fog = Fog::new(token.here.site(token.span), self.noise);
        let outer = self.poison.take();
        let opener = token.clone();
        let outcome = self.block(token, Word::Fog, |evaluator| {
            let (mut failed, mut has) = (false, Has::default());
            while let Some(token) = evaluator.next() {
                failed |= evaluator.fog_item(&token, &mut fog, &mut has) == Err(Reported);
            }
            if failed {
                return Err(Reported);
            }
            evaluator.fog_is_complete(&opener, has)
        });
        let poison = std::mem::replace(&mut self.poison, outer);
        if let Some(poison) = poison {
            self.set_poison(poison);
            return Ok(Value::Poison(poison));
        }
        outcome?;
        Ok(Value::Fog(Arc::new(fog)))
    }

    /// Reports a fog without a distance, which is off, or without a colour, which is black.
    fn fog_is_complete(&mut self, opener: &Token, has: Has) -> Outcome<()> {
        if self.poison.is_some() {
            return Ok(());
        }
        let parts = [
            (has.distance, "distance", "`distance 50`", "without one it is off"),
            (has.color, "colour", "a colour such as `rgb 0.8`", "without one it is black"),
        ];
        for (_, what, wanted, otherwise) in parts.into_iter().filter(|(has, ..)| !has) {
            let message = format!("this `fog` has no {what}; {otherwise}");
            let diagnostic = Diagnostic::new(Code::MissingPart, message)
                .at(opener.span, format!("expected {wanted} in it"))
                .help("a whole fog: `fog { distance 50 rgb 0.8 }`");
            self.opinion(&opener.here, diagnostic)?;
        }
        Ok(())
    }

    fn fog_item(&mut self, token: &Token, fog: &mut Fog, has: &mut Has) -> Outcome<()> {
        let is_first = !std::mem::replace(&mut has.any, true);
        if let Some(transform) = self.transform_from(token) {
            fog.transforms.push(transform?);
            return Ok(());
        }
        let word = match token.kind {
            TokenKind::Word(word) => word,
            TokenKind::Expression(_) | TokenKind::Literal(_) => {
                return self.fog_value(token, fog, has, is_first);
            }
            _ => return self.unfit_in_fog(token),
        };
        let number = |evaluator: &mut Self| evaluator.number_after(token, "a number");
        match word {
            Word::Distance => {
                let given = number(self)?;
                self.fog_distance(&given, fog, has)?;
            }
            Word::FogType => {
                let given = number(self)?;
                let kind = given.value.trunc();
                if kind != 1.0 && kind != 2.0 {
                    let wanted = "1, the same everywhere, or 2, on the ground";
                    self.out_of_range_but_read(&given, Word::FogType, wanted, "it is 1")?;
                }
                fog.is_ground = kind == 2.0;
            }
            Word::FogOffset => fog.offset = number(self)?.value,
            Word::FogAlt => fog.alt = number(self)?.value,
            Word::Up => {
                let up = self.any_direction_after(token, "the direction of heights")?.value;
                fog.up = if up == Vector::ZERO { Vector::Y } else { up };
                fog.transforms.clear();
            }
            Word::Turbulence => {
                let scale = self.vector_after(token, "a number or a vector")?.value;
                fog.turbulence =
                    Some(FogTurbulence { scale, ..fog.turbulence.unwrap_or_default() });
            }
            Word::Octaves | Word::Lambda | Word::Omega => {
                let value = number(self)?.value;
                let own = fog.turbulence.get_or_insert_default();
                match word {
                    Word::Octaves => own.octaves = value,
                    Word::Lambda => own.lambda = value,
                    _ => own.omega = value,
                }
            }
            Word::TurbDepth => fog.turb_depth = number(self)?.value,
            _ if word.family() == Family::Color => {
                (fog.color, has.color) = (self.color_from(token)?, true);
            }
            _ => return self.unfit_in_fog(token),
        }
        Ok(())
    }

    /// Takes a distance; one of 0 or less is what POV-Ray makes of it.
    fn fog_distance(&mut self, given: &Given<f64>, fog: &mut Fog, has: &mut Has) -> Outcome<()> {
        if given.value <= 0.0 {
            let read = match given.value == 0.0 {
                true => "the fog is off",
                false => "the fog brightens what is behind it",
            };
            self.out_of_range_but_read(given, Word::Distance, "more than 0", read)?;
        }
        (fog.distance, has.distance) = (given.value, true);
        Ok(())
    }

    /// Takes a value without a word before it: a declared fog, a colour, or a distance.
    fn fog_value(
        &mut self,
        token: &Token,
        fog: &mut Fog,
        has: &mut Has,
        is_first: bool,
    ) -> Outcome<()> {
        let value = match token.kind {
            TokenKind::Expression(id) => match self.declared(token, id) {
                Some(value) => value,
                None if self.unknown_name(&token.here, id).is_some() => {
                    return self.unfit_in_fog(token);
                }
                None => self.joined_value(token)?,
            },
            _ => self.joined_value(token)?,
        };
        match value {
            Value::Broken => Err(Reported),
            Value::Fog(_) if !is_first => {
                let message = "a declared fog stands first in its block";
                let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                    .at(token.span, "it would replace all items before it")
                    .help("what is different comes behind it: `fog { Name distance 50 }`");
                Err(self.report(&token.here, diagnostic))
            }
            Value::Fog(declared) => {
                *fog = Fog { site: fog.site, ..declared.as_ref().clone() };
                *has = Has { distance: true, color: true, any: true };
                Ok(())
            }
            Value::Color(color) => {
                let color: Color = self.color_components(color)?;
                (fog.color, has.color) = (color, true);
                Ok(())
            }
            Value::Number(distance) => {
                let text = self.sources.text(token.span).to_owned();
                let diagnostic = Diagnostic::new(Code::ExtraPart, "a number alone in a `fog`")
                    .at(token.span, "expected a word before it")
                    .help(format!("its `distance`: `distance {text}`"));
                self.opinion(&token.here, diagnostic)?;
                let (span, here) = (token.span, token.here.clone());
                self.fog_distance(
                    &Given { value: distance, span, here, expression: None },
                    fog,
                    has,
                )
            }
            _ => self.unfit_in_fog(token),
        }
    }

    fn unfit_in_fog(&mut self, token: &Token) -> Outcome<()> {
        self.unexpected(token, Place::FOG);
        let harmless = matches!(token.kind, TokenKind::Comma | TokenKind::Semicolon);
        if harmless || self.poison.is_some() { Ok(()) } else { Err(Reported) }
    }
}
