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
use super::parts::{Block, Part, Parts};
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
    const PARTS: Parts<Self> = &[
        Part::Flag(Word::Perspective, |c, (), _| c.kind = CameraKind::Perspective),
        Part::Flag(Word::Orthographic, |c, (), site| {
            c.kind = CameraKind::Orthographic;
            if c.is_in_order {
                c.add(Kind::Orthographic, site);
            }
        }),
        Part::Vector(Word::Location, "a point", |c, at, site| c.add(Kind::Location(at), site)),
        Part::Vector(Word::LookAt, "a point", |c, point, site| c.add(Kind::LookAt(point), site)),
        Part::Direction(Word::Sky, "the sky's direction", |c, at, site| c.add(Kind::Sky(at), site)),
        Part::Special(Word::Up, |evaluator, token, c| {
            let given = evaluator.any_direction_after(token, "the picture's height")?;
            evaluator.lint_lone_side(&given, Word::Up, 'y');
            c.add(Kind::Up(given.value), evaluator.whole(token));
            Ok(())
        }),
        Part::Special(Word::Right, |evaluator, token, c| {
            let given = evaluator.any_direction_after(token, "the picture's width")?;
            evaluator.lint_lone_side(&given, Word::Right, 'x');
            c.add(Kind::Right(given.value), evaluator.whole(token));
            Ok(())
        }),
        Part::Direction(Word::Direction, "the lens's axis", |c, at, site| {
            c.add(Kind::Direction(at), site)
        }),
        Part::Special(Word::Angle, |evaluator, token, c| evaluator.angle(token, c)),
        Part::Special(Word::Shift, |evaluator, token, c| evaluator.shift(token, c)),
        // Built as patterns, and not in cameras.
        Part::Special(Word::Spherical, |evaluator, token, _| {
            Err(evaluator.unbuilt_word(token, Word::Spherical))
        }),
        Part::Special(Word::Normal, |evaluator, token, _| {
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

    fn angle(&mut self, token: &Token, camera: &mut Camera) -> Outcome<()> {
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
        camera.add(Kind::Angle(given.value), self.whole(token));
        Ok(())
    }

    /// Reads `shift <x, y>`.
    fn shift(&mut self, token: &Token, camera: &mut Camera) -> Outcome<()> {
        let wanted = "a vector of two numbers";
        let given = self.given(token, wanted)?;
        match given.value.numbers().as_ref().map(Components::as_slice) {
            Some(&[x, y]) => {
                camera.add(Kind::Shift { x, y }, self.whole(token));
                Ok(())
            }
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
