//! The parts of each solid, before its modifiers.

use crate::diagnostic::{Code, Diagnostic, Label};
use crate::math::Vector;
use crate::scene::{Dialect, Solid};
use crate::vocabulary::Word;

use super::super::stream::{FrameKind, Token, TokenKind};
use super::super::{Evaluator, Here, Outcome};
use super::foreign_value::told_comma;
use super::part::Given;

/// Value that POV-Ray 3.7 substitutes for an exponent of 0 in a superellipsoid (measured).
const SHARPEST: f64 = 1e-5;

impl Evaluator<'_> {
    /// Consumes `open`, with or without a comma before it, and returns whether it came next.
    pub(super) fn take_open(&mut self) -> bool {
        self.skip_commas();
        self.take_word(Word::Open).is_some()
    }

    /// Returns the reader for a solid's block; `None` for other words, and for unsupported solids.
    pub(super) fn parts_of(word: Word) -> Option<fn(&mut Self, &Token) -> Outcome<Solid>> {
        Some(match word {
            Word::Sphere => Self::sphere,
            Word::Plane => Self::plane,
            Word::Box => Self::box_,
            Word::Cylinder => Self::cylinder,
            Word::Cone => Self::cone,
            Word::Disc => Self::disc,
            Word::Ovus => Self::ovus,
            Word::SphereSweep => Self::sphere_sweep,
            Word::Superellipsoid => Self::superellipsoid,
            Word::Torus => Self::torus,
            Word::Blob => Self::blob,
            Word::Isosurface => Self::isosurface,
            Word::JuliaFractal => Self::julia_fractal,
            Word::Parametric => Self::parametric,
            Word::Lathe => Self::lathe,
            Word::Prism => Self::prism,
            Word::Sor => Self::sor,
            Word::Quadric => Self::quadric,
            Word::Cubic => Self::cubic,
            Word::Quartic => Self::quartic,
            Word::Poly => Self::poly,
            Word::Polynomial => Self::polynomial,
            Word::BicubicPatch => Self::bicubic_patch,
            Word::HeightField => Self::height_field,
            Word::Polygon => Self::polygon,
            Word::Text => Self::text,
            Word::Triangle => Self::triangle,
            Word::SmoothTriangle => Self::smooth_triangle,
            Word::Mesh => Self::mesh,
            Word::Mesh2 => Self::mesh2,
            _ => return None,
        })
    }

    /// Returns the code for a shape without size: POV-Ray renders a scene that has one, as in animations
    /// whose shapes grow from nothing.
    pub(super) fn sizeless(&self) -> Code {
        self.undrawn(Code::ZeroSize)
    }

    /// Returns the code for a shape of which POV-Ray draws nothing, and which is a mistake here.
    pub(super) fn undrawn(&self, mistake: Code) -> Code {
        match self.options.dialect {
            Dialect::Scene => mistake,
            Dialect::Pov => Code::DegenerateShape,
        }
    }

    /// Reports that a shape has no size; it is omitted.
    pub(super) fn nothing(
        &mut self,
        shape: &Token,
        here: &Here,
        diagnostic: Diagnostic,
    ) -> Outcome<()> {
        if let TokenKind::Word(word) = shape.kind {
            self.scene.sizeless.push((word.name(), shape.here.site(shape.span)));
        }
        // `0,5`: the rest of the number comes next, and is reported.
        let number = |kind: &TokenKind| {
            matches!(kind, TokenKind::Comma | TokenKind::Expression(_) | TokenKind::Literal(_))
        };
        let fraction = diagnostic.primary().and_then(|label| self.comma_after(label.span));
        if self.options.dialect == Dialect::Pov
            && fraction.is_some()
            && self.peek().is_some_and(|next| number(&next.kind))
        {
            return Ok(());
        }
        let diagnostic = self.in_this_turn(diagnostic);
        let reported = self.report(here, diagnostic);
        match self.options.dialect {
            Dialect::Scene => Err(reported),
            Dialect::Pov => Ok(()),
        }
    }

    /// Adds the current value of the loop counter to a diagnostic: `sphere { I*x, I/10 }`.
    pub(super) fn in_this_turn(&self, told: Diagnostic) -> Diagnostic {
        let mut counters = self.frames.iter().rev().filter_map(|frame| match frame.kind {
            FrameKind::For { symbol, value, .. } => Some((self.scopes.name(symbol), value)),
            _ => None,
        });
        let names = |label: &Label, name: &str| {
            let of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
            self.sources.text(label.span).split(|c| !of_name(c)).any(|word| word == name)
        };
        match counters.find(|(name, _)| told.labels.iter().any(|label| names(label, name))) {
            Some((name, value)) => {
                told.help(format!("in this turn of the loop `{name}` is {value}"))
            }
            None => told,
        }
    }

    /// Reads a point after which bare numbers may follow that do not belong to it.
    pub(super) fn point(&mut self, shape: &Token, wanted: &str) -> Outcome<Given<Vector>> {
        let given = self.given(shape, wanted)?;
        self.as_vector(given, wanted)
    }

    pub(super) fn sphere(&mut self, token: &Token) -> Outcome<Solid> {
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
        // `plane { <0, 0, 0>, y }`: if the two are swapped, that is reported.
        let distance = distance?;
        let normal = self.as_direction(normal?, "the normal")?;
        Ok(Solid::Plane { normal: normal.value, distance: distance.value })
    }

    pub(super) fn box_(&mut self, token: &Token) -> Outcome<Solid> {
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
        let (base, cap) = (base?, cap?);
        self.ends_apart(token, "cylinder", &base, &cap)?;
        let radius = radius?;
        self.lint_lone_height("cylinder", &base, &cap);
        if radius.value == 0.0 {
            let diagnostic = Diagnostic::new(self.sizeless(), "a cylinder of radius 0 is nothing")
                .at(radius.span, "expected a number more than 0");
            self.nothing(token, &radius.here, diagnostic)?;
        }
        if radius.value < 0.0 {
            self.lint_negative_radius(&radius.here, radius.span, radius.value);
        }
        let open = self.take_open();
        Ok(Solid::Cylinder { ends: [base.value, cap.value], radius: radius.value, open })
    }

    /// Reports a shape without length.
    fn ends_apart(
        &mut self,
        shape: &Token,
        name: &str,
        base: &Given<Vector>,
        cap: &Given<Vector>,
    ) -> Outcome<()> {
        if base.value != cap.value {
            return Ok(());
        }
        let message =
            format!("a {name} whose ends are the same point has no length, and is nothing");
        // POV-Ray refuses it as well.
        let diagnostic = Diagnostic::new(Code::ZeroSize, message)
            .at(cap.span, "expected another place")
            .also(base.span, "the base")
            .also(shape.span, "of this");
        if let TokenKind::Word(word) = shape.kind {
            self.scene.sizeless.push((word.name(), shape.here.site(shape.span)));
        }
        let diagnostic = self.in_this_turn(diagnostic);
        Err(self.report(&cap.here, diagnostic))
    }

    fn cone(&mut self, token: &Token) -> Outcome<Solid> {
        let base = self.vector_after(token, "a vector for the middle of the base");
        let base_radius = self.number_after(token, "a number for the radius at the base");
        let cap = self.vector_after(token, "a vector for the middle of the cap");
        let cap_radius = self.number_after(token, "a number for the radius at the cap");
        let (base, cap) = (base?, cap?);
        self.ends_apart(token, "cone", &base, &cap)?;
        let (base_radius, cap_radius) = (base_radius?, cap_radius?);
        self.lint_lone_height("cone", &base, &cap);
        let radii = [base_radius.value, cap_radius.value];
        if radii == [0.0; 2] {
            let diagnostic =
                Diagnostic::new(self.sizeless(), "a cone of radius 0 at both ends is nothing")
                    .at(cap_radius.span, "expected a number more than 0")
                    .also(base_radius.span, "and so is the other");
            self.nothing(token, &cap_radius.here, diagnostic)?;
        }
        let is_hourglass = radii[0].min(radii[1]) < 0.0 && radii[0].max(radii[1]) > 0.0;
        for radius in [&base_radius, &cap_radius].into_iter().filter(|radius| radius.value < 0.0) {
            if is_hourglass {
                let message = "the radii have opposite signs: two cones stand tip to tip";
                let diagnostic =
                    Diagnostic::new(Code::NegativeSize, message).at(radius.span, "a negative size");
                self.report(&radius.here, diagnostic);
            } else {
                self.lint_negative_radius(&radius.here, radius.span, radius.value);
            }
        }
        let open = self.take_open();
        Ok(Solid::Cone { ends: [base.value, cap.value], radii, open })
    }

    fn disc(&mut self, token: &Token) -> Outcome<Solid> {
        if let Some(reported) = self.bare_points(2, 1) {
            return Err(reported);
        }
        let centre = self.vector_after(token, "a vector for the centre");
        let normal = self.any_direction_after(token, "the normal");
        let radius = self.number_after(token, "a number for the radius");
        let (centre, normal, radius) = (centre?, normal?, radius?);
        self.skip_commas();
        let hole = match self.peek().map(|token| &token.kind) {
            Some(TokenKind::Expression(_) | TokenKind::Literal(_)) => {
                Some(self.number_after(token, "a number for the radius of the hole")?)
            }
            _ => None,
        };
        let hole_radius = hole.as_ref().map_or(0.0, |hole| hole.value);
        if normal.value == Vector::ZERO {
            // Reported and omitted.
            let (centre, normal) = (centre.value, Vector::Y);
            return Ok(Solid::Disc { centre, normal, radius: 0.0, hole: 0.0 });
        }
        if radius.value == 0.0 {
            let diagnostic = Diagnostic::new(self.sizeless(), "a disc of radius 0 is nothing")
                .at(radius.span, "expected a number more than 0");
            self.nothing(token, &radius.here, diagnostic)?;
        } else if let Some(hole) =
            hole.as_ref().filter(|hole| hole.value.abs() >= radius.value.abs())
        {
            let diagnostic = Diagnostic::new(
                self.sizeless(),
                "a disc that is no wider than its hole is nothing",
            )
            .at(hole.span, "expected a number less than the radius")
            .also(radius.span, "the radius");
            let is_swapped = hole.value > radius.value
                && radius.value > 0.0
                && self.sources.between(radius.span, hole.span).map(str::trim) == Some(",");
            let diagnostic = if is_swapped {
                let [less, more] = [radius.span, hole.span].map(|span| self.sources.text(span));
                let right = format!("{more}, {less}");
                diagnostic
                    .help(format!("are the two swapped? write `{right}`"))
                    .fix(radius.span.to(hole.span), right)
            } else {
                diagnostic
            };
            self.nothing(token, &hole.here, diagnostic)?;
        }
        for radius in [&radius].into_iter().chain(&hole).filter(|radius| radius.value < 0.0) {
            self.lint_negative_radius(&radius.here, radius.span, radius.value);
        }
        let (centre, normal) = (centre.value, normal.value);
        Ok(Solid::Disc { centre, normal, radius: radius.value, hole: hole_radius })
    }

    fn torus(&mut self, token: &Token) -> Outcome<Solid> {
        let major = self.number_after(token, "a number for the major radius");
        let minor = self.number_after(token, "a number for the minor radius");
        let (major, minor) = (major?, minor?);
        if minor.value == 0.0
            && let Some((span, number)) = self.comma_after(minor.span)
        {
            let told = told_comma(self.sources.text(span), span, number);
            self.skip_values();
            return Err(self.report(&minor.here, told));
        }
        if minor.value == 0.0 {
            let diagnostic =
                Diagnostic::new(self.sizeless(), "a torus of minor radius 0 is nothing")
                    .at(minor.span, "expected a number more than 0");
            self.nothing(token, &minor.here, diagnostic)?;
        }
        self.lint_spindle(&major, &minor);
        // Measured in POV-Ray 3.7: with a negative minor radius it draws nothing.
        if minor.value < 0.0 && self.options.dialect == Dialect::Pov {
            let message = "POV-Ray draws nothing of a torus whose minor radius is negative";
            let diagnostic = Diagnostic::new(Code::DegenerateShape, message)
                .at(minor.span, "expected a number more than 0");
            let diagnostic = match self.sources.text(minor.span).strip_prefix('-') {
                Some(right) if right.parse::<f64>().is_ok() => {
                    diagnostic.help(format!("write `{right}`")).fix(minor.span, right.to_owned())
                }
                _ => diagnostic,
            };
            self.nothing(token, &minor.here, diagnostic)?;
            return Ok(Solid::Torus { major: major.value, minor: 0.0 });
        }
        for radius in [&major, &minor].into_iter().filter(|radius| radius.value < 0.0) {
            self.lint_negative_radius(&radius.here, radius.span, radius.value);
        }
        Ok(Solid::Torus { major: major.value, minor: minor.value })
    }

    fn ovus(&mut self, token: &Token) -> Outcome<Solid> {
        let bottom = self.number_after(token, "a number for the radius at the bottom");
        let top = self.number_after(token, "a number for the radius at the top");
        let (bottom, top) = (bottom?, top?);
        for radius in [&bottom, &top] {
            if radius.value < 0.0 {
                return Err(self.out_of_range(radius, Word::Ovus, "0 or more"));
            }
        }
        if bottom.value.max(top.value) == 0.0 {
            let diagnostic = Diagnostic::new(self.sizeless(), "an ovus of two radii 0 is nothing")
                .at(top.span, "expected a number more than 0")
                .also(bottom.span, "or here");
            self.nothing(token, &top.here, diagnostic)?;
        } else if top.value >= 2.0 * bottom.value {
            let message = "the top ball of this ovus holds the bottom one: it is a sphere";
            let diagnostic = Diagnostic::new(Code::DegenerateShape, message)
                .at(top.span, "expected less than twice the radius at the bottom")
                .also(bottom.span, "the radius at the bottom");
            self.report(&top.here, diagnostic);
        }
        Ok(Solid::Ovus { bottom: bottom.value, top: top.value })
    }

    /// Reads `<e, n>`, or one number for both.
    fn superellipsoid(&mut self, token: &Token) -> Outcome<Solid> {
        const WANTED: &str = "a vector of the two exponents";
        let given = self.given(token, WANTED)?;
        self.skip_commas();
        // `0.2, 0.3` lacks its brackets.
        let is_bare = matches!(
            self.peek().map(|next| &next.kind),
            Some(TokenKind::Expression(_) | TokenKind::Literal(_))
        );
        let exponents = match given.value.numbers().as_ref().map(|numbers| numbers.as_slice()) {
            Some(&[both]) if !is_bare => [both; 2],
            Some(&[east, north]) => [east, north],
            Some(numbers) => {
                let is_pair = is_bare && numbers.len() == 1;
                let second = self.peek().filter(|_| is_pair).map(|next| next.span);
                let (found, what) = match numbers.len() {
                    1 => (Code::WrongType, "bare numbers".to_owned()),
                    count => (Code::WrongArity, format!("a vector of {count}")),
                };
                let diagnostic = Diagnostic::new(found, format!("expected {WANTED}, found {what}"))
                    .at(given.span, "expected `<e, n>`")
                    .help("east-west first, then north-south: `<1, 0.2>` is a round tin");
                let diagnostic = match second.filter(|second| second.file == given.span.file) {
                    Some(second) => {
                        let [a, b] = [given.span, second].map(|span| self.sources.text(span));
                        let right = format!("<{a}, {b}>");
                        diagnostic
                            .help(format!("write `{right}`"))
                            .fix(given.span.to(second), right)
                    }
                    None => diagnostic,
                };
                return Err(self.report(&given.here, diagnostic));
            }
            None => return Err(self.wrong_type(&given.here, given.span, WANTED, &given.value)),
        };
        if let Some(place) = exponents.into_iter().position(|exponent| exponent <= 0.0) {
            let exponent = exponents[place];
            let component =
                given.expression.and_then(|id| given.here.unit.component_span(id, place));
            let message = format!("an exponent of this superellipsoid is {exponent}");
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(component.unwrap_or(given.span), "expected more than 0")
                .help("from near 0, a box, over 1, round, to 2 and more, a star");
            self.opinion(&given.here, diagnostic)?;
            // POV-Ray 3.7 draws nothing where one is negative, and the sharpest box for 0 (measured).
            if exponents.iter().any(|exponent| *exponent < 0.0) {
                return Ok(Solid::Sphere { centre: Vector::ZERO, radius: 0.0 });
            }
        }
        let exponents = exponents.map(|exponent| if exponent == 0.0 { SHARPEST } else { exponent });
        Ok(Solid::Superellipsoid { exponents })
    }
}
