//! `camera`: its items in source order.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Camera, CameraItem, CameraItemKind, CameraKind, TransformId};
use crate::source::Site;
use crate::vocabulary::{Dialect, Word};

use super::super::stream::Token;
use super::super::value::{Components, Value};
use super::super::{Evaluator, Outcome};
use super::Place;
use super::parts::{Block, Part};
use CameraItemKind as Kind;

/// The version from which the order of a camera's items does not matter (measured).
const SORTED_SINCE: f64 = 3.5;

impl Camera {
    fn add(&mut self, kind: CameraItemKind, site: Site) {
        self.items.push(CameraItem { kind, site });
    }
}

impl Block for Camera {
    const PLACE: Place = Place::CAMERA;
    const PARTS: &'static [Part<Self>] = &[
        Part::flag(Word::Perspective, |c, (), _| c.kind = CameraKind::Perspective),
        Part::flag(Word::Orthographic, |c, (), site| {
            c.kind = CameraKind::Orthographic;
            if c.is_in_order {
                c.add(Kind::Orthographic, site);
            }
        }),
        Part::point(Word::Location, |c, point, site| c.add(Kind::Location(point), site)),
        Part::point(Word::LookAt, |c, point, site| c.add(Kind::LookAt(point), site)),
        Part::direction(Word::Sky, "the sky's direction", |c, sky, site| {
            c.add(Kind::Sky(sky), site)
        }),
        Part::special(Word::Up, |evaluator, token, c| {
            let given = evaluator.any_direction_after(token, "the picture's height")?;
            evaluator.lint_lone_side(&given, Word::Up, 'y');
            c.add(Kind::Up(given.value), evaluator.whole(token));
            Ok(())
        }),
        Part::special(Word::Right, |evaluator, token, c| {
            let given = evaluator.any_direction_after(token, "the picture's width")?;
            evaluator.lint_lone_side(&given, Word::Right, 'x');
            c.add(Kind::Right(given.value), evaluator.whole(token));
            Ok(())
        }),
        Part::direction(Word::Direction, "the lens's axis", |c, axis, site| {
            c.add(Kind::Direction(axis), site)
        }),
        Part::special(Word::Angle, |evaluator, token, c| {
            let angle = evaluator.angle(token, c)?;
            c.add(angle, evaluator.whole(token));
            Ok(())
        }),
        Part::special(Word::Shift, |evaluator, token, c| {
            let shift = evaluator.shift(token)?;
            c.add(shift, evaluator.whole(token));
            Ok(())
        }),
        // Built as patterns, and not in cameras.
        Part::special(Word::Spherical, |evaluator, token, _| {
            Err(evaluator.unbuilt_word(token, Word::Spherical))
        }),
        Part::special(Word::Normal, |evaluator, token, _| {
            Err(evaluator.unbuilt_word(token, Word::Normal))
        }),
    ];

    fn inherit(&mut self, _: &Evaluator, value: &Value) -> bool {
        let Value::Camera(camera) = value else { return false };
        *self = Self { site: self.site, ..camera.as_ref().clone() };
        true
    }

    fn transform(&mut self, _: &mut Evaluator, transform: TransformId, site: Site) {
        self.add(CameraItemKind::Transform(transform), site);
    }
}

impl Evaluator<'_> {
    pub(super) fn camera(&mut self, token: &Token) -> Outcome<Value> {
        let site = token.here.site(token.span);
        let is_in_order = self.options.dialect == Dialect::Pov && self.is_before(SORTED_SINCE);
        let (kind, items) = (CameraKind::Perspective, Vec::new());
        let mut camera = Camera { kind, items, is_in_order, site };
        self.value_or_poison(|evaluator| {
            evaluator.block(token, Word::Camera, |evaluator| evaluator.parts(&mut camera))?;
            Ok(Value::Camera(Arc::new(camera)))
        })
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
            let wanted = "less than 180 for a perspective camera";
            return Err(self.out_of_range(&given, Word::Angle, wanted));
        }
        self.lint_angle_in_radians(&given);
        Ok(CameraItemKind::Angle(given.value))
    }

    /// Reads `shift <x, y>`.
    fn shift(&mut self, token: &Token) -> Outcome<CameraItemKind> {
        let wanted = "a vector of two numbers";
        let given = self.given(token, wanted)?;
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
            None => Err(self.wrong_type(&given.here, given.span, wanted, &given.value)),
        }
    }
}
