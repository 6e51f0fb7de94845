//! What stands in each solid's block before its modifiers.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::{Dialect, Solid};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Here, Outcome};
use super::part::Given;

impl Evaluator<'_> {
    /// How to read the block of a solid; `None` for other words, and what is not built.
    pub(super) fn parts_of(word: Word) -> Option<fn(&mut Self, &Token) -> Outcome<Solid>> {
        Some(match word {
            Word::Sphere => Self::sphere,
            Word::Plane => Self::plane,
            Word::Box => Self::box_,
            Word::Cylinder => Self::cylinder,
            Word::Triangle => Self::triangle,
            Word::SmoothTriangle => Self::smooth_triangle,
            Word::Mesh => Self::mesh,
            Word::Mesh2 => Self::mesh2,
            _ => return None,
        })
    }

    /// What a shape without size is: POV-Ray draws a scene that has one, as films do whose shapes grow from
    /// nothing.
    pub(super) fn sizeless(&self) -> Code {
        match self.options.dialect {
            Dialect::Scene => Code::ZeroSize,
            Dialect::Pov => Code::DegenerateShape,
        }
    }

    /// Says that a shape has no size; it is left out.
    pub(super) fn nothing(
        &mut self,
        shape: &Token,
        here: &Here,
        diagnostic: Diagnostic,
    ) -> Outcome<()> {
        if let TokenKind::Word(word) = shape.kind {
            self.scene.sizeless.push((word.name(), shape.here.site(shape.span)));
        }
        let reported = self.report(here, diagnostic);
        match self.options.dialect {
            Dialect::Scene => Err(reported),
            Dialect::Pov => Ok(()),
        }
    }

    /// A point where bare numbers may follow that are none of its own.
    fn point(&mut self, shape: &Token, wanted: &str) -> Outcome<Given<Vector>> {
        let given = self.given(shape, wanted)?;
        self.as_vector(given, wanted)
    }

    fn sphere(&mut self, token: &Token) -> Outcome<Solid> {
        const WANTED: (&str, &str) = ("a vector for the centre", "a number for the radius");
        let (centre, radius) = self.vector_and_number(token, WANTED);
        let (centre, radius) = (centre?, radius?);
        if radius.value == 0.0 {
            let diagnostic = Diagnostic::new(self.sizeless(), "a sphere of radius 0 is nothing")
                .at(radius.span, "expected a number more than 0");
            let diagnostic = match self.comma_after(radius.span) {
                Some((span, number)) => diagnostic
                    .help(format!("a fraction is written with a point: `{number}`"))
                    .fix(span, number),
                None => diagnostic,
            };
            self.nothing(token, &radius.here, diagnostic)?;
        }
        if radius.value < 0.0 {
            self.lint_negative_radius(&radius.here, radius.span, radius.value);
        }
        Ok(Solid::Sphere { centre: centre.value, radius: radius.value })
    }

    fn plane(&mut self, token: &Token) -> Outcome<Solid> {
        const WANTED: (&str, &str) = ("a vector for the normal", "a number for the distance");
        let (normal, distance) = self.vector_and_number(token, WANTED);
        let normal = normal.and_then(|given| self.as_direction(given, "the normal"));
        let (normal, distance) = (normal?, distance?);
        Ok(Solid::Plane { normal: normal.value, distance: distance.value })
    }

    fn box_(&mut self, token: &Token) -> Outcome<Solid> {
        if let Some(reported) = self.bare_points(2, 0) {
            return Err(reported);
        }
        let first = self.vector_after(token, "a vector for a corner");
        let second = self.vector_after(token, "a vector for the opposite corner");
        let (first, second) = (first?, second?);
        let size: Vector = (second.value - first.value).abs();
        let flat = size.to_array().iter().filter(|side| **side == 0.0).count();
        if flat >= 2 {
            let diagnostic = Diagnostic::new(
                self.sizeless(),
                "a box whose corners differ along less than two axes is nothing",
            )
            .at(second.span, "expected the opposite corner")
            .also(first.span, "the first corner");
            self.nothing(token, &second.here, diagnostic)?;
        }
        Ok(Solid::Box { corners: [first.value, second.value] })
    }

    fn cylinder(&mut self, token: &Token) -> Outcome<Solid> {
        if let Some(reported) = self.bare_points(2, 1) {
            return Err(reported);
        }
        // `-1, 1, 1` is two points and a radius.
        let base = self.point(token, "a vector for the middle of the base");
        let cap = self.point(token, "a vector for the middle of the cap");
        let radius = self.number_after(token, "a number for the radius");
        let (base, cap, radius) = (base?, cap?, radius?);
        if base.value == cap.value {
            let diagnostic = Diagnostic::new(
                self.sizeless(),
                "a cylinder whose ends are in one place is nothing",
            )
            .at(cap.span, "expected another place")
            .also(base.span, "the base");
            self.nothing(token, &cap.here, diagnostic)?;
        }
        if radius.value == 0.0 {
            let diagnostic = Diagnostic::new(self.sizeless(), "a cylinder of radius 0 is nothing")
                .at(radius.span, "expected a number more than 0");
            self.nothing(token, &radius.here, diagnostic)?;
        }
        let open = self.take_word(Word::Open).is_some();
        Ok(Solid::Cylinder { ends: [base.value, cap.value], radius: radius.value, open })
    }
}
