//! `camera`: its items in source order.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Camera, CameraItem, CameraItemKind, CameraKind, CylinderForm, TransformId};
use crate::source::Site;
use crate::vocabulary::{Dialect, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::{Components, Value};
use super::super::{Evaluator, Outcome};
use super::Place;
use super::parts::{Block, Part, Parts};
use super::range::Range;
use CameraItemKind as Kind;

/// The version from which the order of a camera's items does not matter (measured).
const SORTED_SINCE: f64 = 3.5;

/// The defaults of POV-Ray 3.7, which it takes instead of numbers out of range (measured).
const DEFAULT_CONFIDENCE: f64 = 0.9;
const DEFAULT_VARIANCE: f64 = 1.0 / 128.0;

const CONFIDENCE: Range =
    Range::new(|n| (0.0..1.0).contains(&n), "a probability: 0 or more, and less than 1")
        .but("it is 0.9", |_| DEFAULT_CONFIDENCE);
const VARIANCE: Range = Range::NOT_NEGATIVE.but("it is 1/128", |_| DEFAULT_VARIANCE);
/// The most rays of a pixel.
const MOST_SAMPLES: f64 = 1e6;

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
        Part::Flag(Word::Fisheye, |c, (), _| c.kind = CameraKind::Fisheye),
        Part::Flag(Word::UltraWideAngle, |c, (), _| c.kind = CameraKind::UltraWideAngle),
        Part::Flag(Word::Omnimax, |c, (), _| c.kind = CameraKind::Omnimax),
        Part::Flag(Word::Panoramic, |c, (), _| c.kind = CameraKind::Panoramic),
        Part::Choice(Word::Cylinder, "the form of the camera's cylinder, 1 to 4", |c, number| {
            c.kind = CameraKind::Cylinder(CylinderForm::from_number(number)?);
            Some(())
        }),
        Part::Flag(Word::Spherical, |c, (), _| c.kind = CameraKind::Spherical),
        Part::Special(Word::MeshCamera, |evaluator, token, c| evaluator.mesh_camera(token, c)),
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
        Part::Number(Word::Aperture, |c, width, site| c.add(Kind::Aperture(width.abs()), site)),
        Part::Special(Word::BlurSamples, |evaluator, token, c| evaluator.blur_samples(token, c)),
        Part::Vector(Word::FocalPoint, "a point", |c, at, site| c.add(Kind::FocalPoint(at), site)),
        Part::Ranged(Word::Confidence, CONFIDENCE, |c, n, site| c.add(Kind::Confidence(n), site)),
        Part::Ranged(Word::Variance, VARIANCE, |c, n, site| c.add(Kind::Variance(n), site)),
        Part::Special(Word::Bokeh, |evaluator, token, c| evaluator.bokeh(token, c)),
        Part::Special(Word::Normal, |evaluator, token, c| {
            let normal = evaluator.normal_from(token, None)?;
            c.add(Kind::Normal(normal), evaluator.whole(token));
            Ok(())
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
        let mut camera = Camera { kind, meshes: None, items, is_in_order, site };
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
            let read = match camera.kind.is_flat() {
                false => "all of the picture shows one direction",
                true => match camera.is_in_order && camera.kind == CameraKind::Perspective {
                    true => "in a scene for this version the camera sees no object",
                    false => "`direction` alone says how much the camera sees",
                },
            };
            self.out_of_range_but_read(&given, Word::Angle, "more than 0", read)?;
        }
        if given.value >= 180.0 && camera.kind == CameraKind::Perspective {
            let wanted = "less than 180 for a perspective camera";
            return Err(self.out_of_range(&given, Word::Angle, wanted));
        }
        if camera.kind.is_flat() {
            self.lint_angle_in_radians(&given);
        }
        camera.add(Kind::Angle(given.value), self.whole(token));
        // A spherical camera has a horizontal and a vertical angle.
        if camera.kind == CameraKind::Spherical && self.is_before_value() {
            let down = self.number_after(token, "degrees from top to bottom")?;
            camera.add(Kind::VerticalAngle(down.value), self.whole(token));
        }
        Ok(())
    }

    /// Reads `blur_samples [least,] most`.
    fn blur_samples(&mut self, token: &Token, camera: &mut Camera) -> Outcome<()> {
        let samples = |evaluator: &mut Self| {
            let given = evaluator.number_after(token, "a number of rays")?;
            if !(1.0..=MOST_SAMPLES).contains(&given.value) {
                let wanted = "from 1 to a million rays";
                return Err(evaluator.out_of_range(&given, Word::BlurSamples, wanted));
            }
            Ok((given.value as u32, given))
        };
        let (first, given) = samples(self)?;
        if !self.is_before_value() {
            camera.add(Kind::BlurSamples(None, first), self.whole(token));
            return Ok(());
        }
        let (most, _) = samples(self)?;
        if first > most {
            let wanted = format!("at most the {most} rays that follow");
            return Err(self.out_of_range(&given, Word::BlurSamples, &wanted));
        }
        camera.add(Kind::BlurSamples(Some(first), most), self.whole(token));
        Ok(())
    }

    /// Reads `bokeh { pigment { … } }`.
    fn bokeh(&mut self, token: &Token, camera: &mut Camera) -> Outcome<()> {
        let mut pigment = None;
        self.block(token, Word::Bokeh, |evaluator| {
            while let Some(item) = evaluator.next() {
                match item.kind {
                    TokenKind::Word(Word::Pigment) => pigment = Some(evaluator.pigment(&item)?),
                    _ => evaluator.unexpected(&item, Place::BOKEH),
                }
            }
            Ok(())
        })?;
        if let Some(pigment) = pigment {
            camera.add(Kind::Bokeh(pigment), self.whole(token));
        }
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
