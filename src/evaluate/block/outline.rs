//! Solids generated from a plane curve: `prism`, `lathe`, `sor`.
//!
//! **Invariant:** there are enough points for the curve, the curves of a prism are closed, and the heights of
//! a `sor` increase.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::outline::{Point, Spline, are_in_line, sameness};
use crate::scene::{Dialect, Solid};
use crate::source::Span;
use crate::syntax::ast::{Argument, ExpressionKind};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Here, Outcome};
use super::part::Given;

/// Points with their spans.
type Points = Vec<Given<Point>>;

fn values(points: &Points) -> Vec<Point> {
    points.iter().map(|point| point.value).collect()
}

/// Keywords before the numbers of a prism; without the first two, the sweeps, those of a lathe.
const SWEEPS_AND_SPLINES: &[Word] = &[
    Word::LinearSweep,
    Word::ConicSweep,
    Word::LinearSpline,
    Word::QuadraticSpline,
    Word::CubicSpline,
    Word::BezierSpline,
];

impl Evaluator<'_> {
    /// Reads `lathe { SPLINE count, <radius, height> … }`.
    pub(super) fn lathe(&mut self, token: &Token) -> Outcome<Solid> {
        let (spline, _) = self.spline_and_sweep(false);
        let points = self.points(token, Word::Lathe, spline)?;
        // Measured: POV-Ray uses the first and the last as they are.
        let inner = points.get(1..points.len() - 1).unwrap_or(&[]);
        let left = inner.iter().find(|point| point.value[0] < 0.0);
        if let Some(left) = left
            && spline == Spline::Linear
            && self.options.dialect == Dialect::Pov
        {
            let message = "a point of this lathe is left of its axis: POV-Ray refuses it";
            let told = Diagnostic::new(Code::OutOfRange, message)
                .at(left.span, "its first number is how far it is from the axis: 0 or more");
            return Err(self.report(&left.here, told));
        }
        let last = &points[points.len() - 1];
        let solid = Solid::Lathe { spline, points: values(&points).into() };
        if solid.is_sizeless() {
            let is_point = points.iter().all(|point| point.value == last.value);
            let where_ = if is_point { "are all in one place" } else { "all lie on its axis" };
            let message = format!("a lathe whose points {where_} is nothing");
            let diagnostic =
                Diagnostic::new(self.sizeless(), message).at(last.span, "expected another place");
            self.nothing(token, &last.here, diagnostic)?;
        } else if points.iter().all(|point| point.value[1] == last.value[1]) {
            // POV-Ray draws a flat ring, so it is not omitted silently.
            let message = "a lathe whose points have one height is flat, and has no size";
            let diagnostic = Diagnostic::new(Code::ZeroSize, message)
                .at(last.span, "expected another height")
                .help("a flat ring is a `disc { <centre>, <normal>, radius, hole }`");
            self.opinion(&last.here, diagnostic)?;
            let radii = || points.iter().map(|point| point.value[0].abs());
            let (radius, hole) = (radii().fold(0.0, f64::max), radii().fold(f64::MAX, f64::min));
            let centre = Vector::Y * last.value[1];
            return Ok(Solid::Disc { centre, normal: Vector::Y, radius, hole });
        }
        Ok(solid)
    }

    /// Reads `prism { SPLINE SWEEP low, high, count, <x, z> … open }`.
    pub(super) fn prism(&mut self, token: &Token) -> Outcome<Solid> {
        let (spline, conic) = self.spline_and_sweep(true);
        if let Some(reported) = self.misplaced_spline(Word::Prism, None) {
            return Err(reported);
        }
        let low = self.number_after(token, "a number for the height it begins at");
        let high = self.number_after(token, "a number for the height it ends at");
        let (low, high) = (low?, high?);
        if low.value == high.value {
            let message = "a prism that ends at the height it begins at is nothing";
            let diagnostic = Diagnostic::new(self.sizeless(), message)
                .at(high.span, "expected another height")
                .also(low.span, "it begins here");
            self.nothing(token, &high.here, diagnostic)?;
        }
        if let Some(reported) = self.lone_height(token, high.span) {
            return Err(reported);
        }
        let mut points = self.points(token, Word::Prism, spline)?;
        match spline.contours(&values(&points)) {
            Ok(_) => {}
            Err(from) if from > 0 && from + 1 == points.len() => self.stray_point(&mut points)?,
            Err(from) => self.unclosed_curve(token, spline, &mut points, from)?,
        }
        match spline {
            Spline::Bezier => self.pieces_meet(token, &mut points)?,
            // If one more point follows, that is reported.
            Spline::Linear if !self.goes_on() => self.lint_open_prism(&points),
            Spline::Linear | Spline::Quadratic | Spline::Cubic => {}
        }
        if let Some(last) = points.last().filter(|_| are_in_line(&values(&points))) {
            let message = "a prism whose points lie in a line is nothing";
            let diagnostic = Diagnostic::new(self.sizeless(), message)
                .at(last.span, "expected a point beside the line through the others");
            self.nothing(token, &last.here, diagnostic)?;
        }
        let open = self.take_open();
        let points: Vec<Point> = values(&points);
        let solid = Solid::Prism {
            spline,
            conic,
            heights: [low.value, high.value],
            points: points.into(),
            open,
        };
        Ok(solid)
    }

    /// Handles a single point after a closed curve, which POV-Ray ignores.
    fn stray_point(&mut self, points: &mut Points) -> Outcome<()> {
        let Some(stray) = points.pop() else { return Ok(()) };
        let code = match self.options.dialect {
            Dialect::Scene => Code::ExtraPart,
            Dialect::Pov => Code::OpenOutline,
        };
        let mut diagnostic = Diagnostic::new(code, "the curve of this prism is closed before its last point")
            .at(stray.span, "this point is one too many")
            .help("the point that tells the slope at its end comes once; leave this one out, and count one less");
        if let Some(last) = points.last() {
            diagnostic = diagnostic.also(last.span, "the curve ends here");
        }
        let reported = self.report(&stray.here, diagnostic);
        if code == Code::OpenOutline { Ok(()) } else { Err(reported) }
    }

    /// Reports an unclosed curve: an error, but in a `.pov`, a prism of Bézier pieces is omitted with a
    /// warning.
    ///
    /// **Source:** measured: POV-Ray 3.7 omits such a prism of Bézier pieces, and aborts with one of a quadratic
    /// or cubic spline. A linear spline closes itself.
    fn unclosed_curve(
        &mut self,
        token: &Token,
        spline: Spline,
        points: &mut Points,
        from: usize,
    ) -> Outcome<()> {
        let (before, behind) = spline.controls();
        let (first, last) =
            (&points[(from + before).min(points.len() - 1)], &points[points.len() - 1]);
        let [x, z] = first.value;
        let then = if behind > 0 { ", then the point that tells its slope there" } else { "" };
        let is_left_out = spline == Spline::Bezier;
        let code = if is_left_out { self.undrawn(Code::MissingPart) } else { Code::MissingPart };
        let diagnostic = Diagnostic::new(code, "a curve of this prism is not closed")
            .at(last.span, format!("expected <{x}, {z}> again before the points end"))
            .also(first.span, "the curve begins here")
            .help(format!("a curve ends with the point it began with{then}"));
        let here = last.here.clone();
        if !is_left_out {
            return Err(self.report(&here, diagnostic));
        }
        points.clear();
        self.nothing(token, &here, diagnostic)
    }

    /// Returns whether a value comes next, with or without a comma before it.
    pub(super) fn goes_on(&mut self) -> bool {
        matches!(
            self.peek().map(|next| &next.kind),
            Some(TokenKind::Expression(_) | TokenKind::Literal(_) | TokenKind::Comma)
        )
    }

    /// Warns if the last of several curves lacks its closing point.
    fn lint_open_prism(&mut self, points: &Points) {
        let all = values(points);
        let contours = Spline::Linear.contours(&all).unwrap_or_default();
        let Some(last) = contours.last() else { return };
        let (first, end) = (&points[last.start], &points[last.end - 1]);
        if last.len() == 1 || !sameness(&all)(first.value, end.value) {
            let name = Word::Prism.name();
            self.lint_open_outline(name, (&end.here, end.span), first.span);
        }
    }

    /// Warns of an outline that does not end at its start, which POV-Ray closes with a warning.
    pub(super) fn lint_open_outline(
        &mut self,
        name: &str,
        (here, end): (&Here, Span),
        first: Span,
    ) {
        if self.options.dialect != Dialect::Pov {
            return;
        }
        let point = self.sources.text(first).to_owned();
        let message =
            format!("the outline of this {name} does not end where it began; it is closed");
        let diagnostic =
            Diagnostic::new(Code::OpenOutline, message).at(end, "the outline ends here");
        // In a run of many points, a single one has no span of its own.
        let diagnostic = match point.matches('<').count() > 1 {
            true => diagnostic.help("add its first point at its end, and count it"),
            false => diagnostic
                .also(first, "it began here")
                .help(format!("add the point `{point}` at its end, and count it")),
        };
        self.report(here, diagnostic);
    }

    /// Checks that the pieces of a closed curve are connected; if they are not, POV-Ray omits the prism.
    fn pieces_meet(&mut self, token: &Token, points: &mut Points) -> Outcome<()> {
        let all = values(points);
        let same = sameness(&all);
        let contours = Spline::Bezier.contours(&all).unwrap_or_default();
        for joint in contours.iter().flat_map(|run| (run.start + 4..run.end).step_by(4)) {
            if !same(all[joint - 1], all[joint]) {
                let message = "two pieces of this prism's curve do not meet";
                let diagnostic = Diagnostic::new(self.undrawn(Code::OutOfRange), message)
                    .at(points[joint].span, "a piece begins here")
                    .also(points[joint - 1].span, "the one before ends here")
                    .help(
                        "of a closed curve of Bézier pieces, each begins where the one before ends",
                    );
                let here = points[joint].here.clone();
                points.clear();
                return self.nothing(token, &here, diagnostic);
            }
        }
        Ok(())
    }

    /// Reads `sor { count, <radius, height> … open }`.
    pub(super) fn sor(&mut self, token: &Token) -> Outcome<Solid> {
        // Of its points, too, the first and the last define slopes.
        let points = self.points(token, Word::Sor, Spline::Cubic)?;
        for pair in points[1..points.len() - 1].windows(2) {
            let [below, above] = pair else { continue };
            if above.value[1] <= below.value[1] {
                let message = "the heights of a sor must rise from point to point";
                let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                    .at(
                        self.height_of(above),
                        format!("expected a height above {}", below.value[1]),
                    )
                    .also(below.span, "the point before it")
                    .help("a lathe may go up and down");
                return Err(self.report(&above.here, diagnostic));
            }
        }
        for three in points.windows(3) {
            let [before, here, behind] = three else { continue };
            if before.value[1] == behind.value[1] {
                let message = "the points to both sides of this one have the same height";
                let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                    .at(here.span, "its slope cannot be told")
                    .also(before.span, "the point before it")
                    .also(behind.span, "the point behind it");
                return Err(self.report(&here.here, diagnostic));
            }
        }
        let negative = points.iter().find(|point| point.value[0] < 0.0);
        if let Some(point) = negative {
            let message = "a radius of this sor is negative";
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(point.span, "expected a radius of 0 or more");
            return Err(self.report(&point.here, diagnostic));
        }
        let solid = Solid::Sor { points: values(&points).into(), open: false };
        if solid.is_sizeless() {
            let last = &points[points.len() - 2];
            let message = "a sor whose radii are all 0 is nothing";
            let diagnostic = Diagnostic::new(self.sizeless(), message)
                .at(last.span, "expected a radius of more than 0");
            self.nothing(token, &last.here, diagnostic)?;
        }
        let open = self.take_open();
        let points: Vec<Point> = values(&points);
        Ok(Solid::Sor { points: points.into(), open })
    }

    /// Reads the keywords before the numbers, in any order; the last one of each kind counts.
    fn spline_and_sweep(&mut self, sweeps: bool) -> (Spline, bool) {
        let (mut spline, mut conic) = (Spline::Linear, false);
        let (shape, words) = match sweeps {
            true => (Word::Prism, SWEEPS_AND_SPLINES),
            false => (Word::Lathe, &SWEEPS_AND_SPLINES[2..]),
        };
        loop {
            let word = match self.peek() {
                Some(Token { kind: TokenKind::Word(Word::Spline), .. }) => {
                    spline = self.spline_in_two_words().unwrap_or(spline);
                    continue;
                }
                Some(Token { kind: TokenKind::Word(word), .. }) => {
                    let word = *word;
                    if !words.contains(&word) {
                        break;
                    }
                    self.next();
                    word
                }
                _ => match self.misspelt_part(shape, words) {
                    Some(word) => word,
                    None => break,
                },
            };
            match word {
                Word::LinearSweep => conic = false,
                Word::ConicSweep => conic = true,
                word => spline = Spline::of(word).unwrap_or(spline),
            }
        }
        (spline, conic)
    }

    /// Handles `spline quadratic` for `quadratic_spline`.
    fn spline_in_two_words(&mut self) -> Option<Spline> {
        let word = self.next()?;
        let kind = self.peek()?.clone();
        let name = format!("{}_spline", self.sources.text(kind.span));
        let named = Word::from_name(&name).and_then(Spline::of);
        let whole = word.span.to(kind.span);
        let told = Diagnostic::new(Code::UnknownWord, "the kind of a spline is one word")
            .at(whole, "expected one such as `linear_spline`");
        let told = match named {
            Some(_) => told.help(format!("write `{name}`")).fix(whole, name),
            None => told,
        };
        self.report(&word.here, told);
        named?;
        self.next();
        named
    }

    /// Reads the number of points, and the points.
    fn points(&mut self, token: &Token, word: Word, spline: Spline) -> Outcome<Points> {
        let label = "expected how many there are before this".to_owned();
        let lacks = self.misplaced_spline(word, None);
        if let Some(reported) =
            lacks.or_else(|| self.uncounted("", label, "how many points follow"))
        {
            return Err(reported);
        }
        let count = self.number_after(token, "a number for how many points follow")?;
        let lacks = self.misplaced_spline(word, Some(count.span));
        if let Some(reported) = lacks.or_else(|| self.bare_entries("a point", 2, &count)) {
            return Err(reported);
        }
        let least = match spline {
            // Lines around something.
            Spline::Linear if word == Word::Prism => 3,
            Spline::Linear => 2,
            Spline::Quadratic if word == Word::Prism => 5,
            Spline::Quadratic => 3,
            Spline::Cubic if word == Word::Prism => 6,
            Spline::Cubic | Spline::Bezier => 4,
        };
        let wanted = self.counted(&count);
        let name = if word == Word::Sor { "" } else { spline.word().name() };
        let needs = match () {
            () if spline == Spline::Bezier && !wanted.is_multiple_of(4) => {
                "4 points for each piece"
            }
            () if wanted < least && word == Word::Sor => "at least 4 points",
            () if wanted < least => &format!("at least {least} points"),
            () => "",
        };
        if !needs.is_empty() {
            let of = if name.is_empty() { String::new() } else { format!(" of `{name}`") };
            let message = format!("a {}{of} needs {needs}", word.name());
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(count.span, format!("this is {}", count.value));
            return Err(self.report(&count.here, diagnostic));
        }
        let mut points: Points = Vec::new();
        while points.len() < wanted {
            if !self.has_memory(size_of_val(&points[..]) as u64) {
                return Err(self.too_much_memory(&token.here, token.span));
            }
            self.announced = Some((count.span, points.len()));
            let given = self.given(token, &format!("{wanted} points"));
            self.announced = None;
            let given = given?;
            let point = match &given.value {
                Value::Vector(numbers) if numbers.as_slice().len() == 2 => {
                    [numbers.as_slice()[0], numbers.as_slice()[1]]
                }
                // POV-Ray 3.7 uses it for both (measured).
                &Value::Number(both) if self.options.dialect == Dialect::Pov => [both; 2],
                Value::Vector(_) => {
                    let what = format!("a point of a {}", word.name());
                    return Err(self.too_wide(&given, word, &what, 2));
                }
                other => {
                    let wanted = "a point of two numbers";
                    return Err(self.wrong_type(&given.here, given.span, wanted, other));
                }
            };
            points.push(given.with(point));
        }
        Ok(points)
    }

    /// Returns the span of the second component of a point, or of the whole point if it is not a vector
    /// literal.
    fn height_of(&self, point: &Given<[f64; 2]>) -> Span {
        let written = point.expression.map(|id| point.here.unit.expression(id).kind);
        let Some(ExpressionKind::Vector(components)) = written else { return point.span };
        match point.here.unit.ast.arguments(components) {
            [_, Argument::Expression(height)] => point.here.unit.expression(*height).span,
            _ => point.span,
        }
    }
}
