//! `camera`: its items in source order.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Camera, CameraItem, CameraItemKind, CameraKind};
use crate::vocabulary::{Dialect, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::{Components, Poison, Value};
use super::super::{Evaluator, Outcome, Reported};
use super::Place;

/// The version from which the order of a camera's items does not matter (measured).
const SORTED_SINCE: f64 = 3.5;

impl Evaluator<'_> {
    pub(super) fn camera(&mut self, token: &Token) -> Outcome<Value> {
        let site = token.here.site(token.span);
        let is_in_order = self.options.dialect == Dialect::Pov && self.is_before(SORTED_SINCE);
        let (kind, items) = (CameraKind::Perspective, Vec::new());
        let mut camera = Camera { kind, items, is_in_order, site };
        let outer = self.poison.take();
        let outcome = self.block(token, Word::Camera, |evaluator| {
            let mut failed = false;
            while let Some(token) = evaluator.next() {
                failed |= evaluator.camera_item(&token, &mut camera) == Err(Reported);
            }
            if failed { Err(Reported) } else { Ok(()) }
        });
        let poison = std::mem::replace(&mut self.poison, outer);
        if let Some(poison) = poison {
            self.set_poison(poison);
            return Ok(Value::Poison(poison));
        }
        outcome?;
        Ok(Value::Camera(Arc::new(camera)))
    }

    fn camera_item(&mut self, token: &Token, camera: &mut Camera) -> Outcome<()> {
        let site = token.here.site(token.span);
        if let Some(transform) = self.transform_from(token) {
            camera.items.push(CameraItem { kind: CameraItemKind::Transform(transform?), site });
            return Ok(());
        }
        if let Some(word) = self.contextual_word(token, Word::Camera) {
            let token = Token { kind: TokenKind::Word(word), ..token.clone() };
            return self.camera_item(&token, camera);
        }
        let word = match token.kind {
            TokenKind::Word(word) => word,
            TokenKind::Expression(id) => match self.declared(token, id) {
                Some(Value::Broken) => return Err(Reported),
                Some(Value::Camera(declared)) => {
                    *camera = Camera { site: camera.site, ..declared.as_ref().clone() };
                    return Ok(());
                }
                _ => {
                    self.unexpected(token, Place::CAMERA);
                    return if self.poison.is_some() { Ok(()) } else { Err(Reported) };
                }
            },
            TokenKind::Comma | TokenKind::Semicolon => {
                self.unexpected(token, Place::CAMERA);
                return Ok(());
            }
            _ => {
                self.unexpected(token, Place::CAMERA);
                return Err(Reported);
            }
        };
        let kind = match word {
            Word::Perspective => {
                camera.kind = CameraKind::Perspective;
                return Ok(());
            }
            Word::Orthographic => {
                camera.kind = CameraKind::Orthographic;
                if !camera.is_in_order {
                    return Ok(());
                }
                CameraItemKind::Orthographic
            }
            Word::Location => CameraItemKind::Location(self.vector_after(token, "a point")?.value),
            Word::LookAt => CameraItemKind::LookAt(self.vector_after(token, "a point")?.value),
            Word::Sky => {
                CameraItemKind::Sky(self.any_direction_after(token, "the sky's direction")?.value)
            }
            Word::Up => {
                let given = self.any_direction_after(token, "the picture's height")?;
                self.lint_lone_side(&given, word, 'y');
                CameraItemKind::Up(given.value)
            }
            Word::Right => {
                let given = self.any_direction_after(token, "the picture's width")?;
                self.lint_lone_side(&given, word, 'x');
                CameraItemKind::Right(given.value)
            }
            Word::Direction => {
                CameraItemKind::Direction(self.any_direction_after(token, "the lens's axis")?.value)
            }
            Word::Angle => self.angle(token, camera)?,
            Word::Shift => self.shift(token)?,
            // Built as patterns, and not in cameras.
            Word::Spherical | Word::Normal => {
                self.set_poison(Poison::new(word, token.here.site(token.span)));
                self.skip_arguments(word);
                return Ok(());
            }
            _ => {
                if let Some(outcome) = self.inert(token, Place::CAMERA) {
                    return outcome;
                }
                self.unexpected(token, Place::CAMERA);
                return if self.poison.is_some() { Ok(()) } else { Err(Reported) };
            }
        };
        camera.items.push(CameraItem { kind, site: self.whole(token) });
        Ok(())
    }

    fn angle(&mut self, token: &Token, camera: &Camera) -> Outcome<CameraItemKind> {
        let given = self.number_after(token, "degrees")?;
        if given.value < 0.0 {
            return Err(self.out_of_range(&given, Word::Angle, "more than 0"));
        }
        if given.value == 0.0 {
            let read = match camera.is_in_order && camera.kind == CameraKind::Perspective {
                true => "in a scene for this version the camera sees no object",
                false => "`direction` alone says how much the camera sees",
            };
            self.out_of_range_but_read(&given, Word::Angle, "more than 0", read)?;
        }
        // A spherical camera has a horizontal and a vertical angle.
        if self.poison.is_some_and(|poison| poison.word == Word::Spherical)
            && self.is_before_value()
        {
            self.number_after(token, "degrees from top to bottom")?;
        }
        if given.value >= 180.0 && camera.kind == CameraKind::Perspective && self.poison.is_none() {
            return Err(self.out_of_range(
                &given,
                Word::Angle,
                "less than 180 for a perspective camera",
            ));
        }
        self.lint_angle_in_radians(&given);
        Ok(CameraItemKind::Angle(given.value))
    }

    /// Reads `shift <x, y>`.
    fn shift(&mut self, token: &Token) -> Outcome<CameraItemKind> {
        let given = self.given(token, "a vector of two numbers")?;
        match given.value.numbers().as_ref().map(Components::as_slice) {
            Some(&[x, y]) => Ok(CameraItemKind::Shift { x, y }),
            Some(other) => {
                let diagnostic = Diagnostic::new(
                    Code::WrongArity,
                    format!("`shift` takes two numbers, and is given {}", other.len()),
                )
                .at(given.span, "expected `<x, y>`")
                .help(Word::Shift.sentence().to_owned());
                Err(self.report(&given.here, diagnostic))
            }
            None => Err(self.wrong_type(
                &given.here,
                given.span,
                "a vector of two numbers",
                &given.value,
            )),
        }
    }
}
