//! Surfaces defined by their points: polygons and Bézier patches.

use crate::diagnostic::{Code, Diagnostic};
use crate::math::Vector;
use crate::scene::Solid;
use crate::scene::outline::ROUNDED;
use crate::scene::polygon::Polygon;
use crate::source::Span;
use crate::vocabulary::{Dialect, Word};

use super::super::stream::Token;
use super::super::{Evaluator, Outcome};
use super::Given;
use super::range::Range;

/// Maximum distance of a polygon's points from its plane, relative to its size: the error of numbers with six
/// digits.
const FLAT_ENOUGH: f64 = 1e-5;

/// Maximum number of points among which a single point outside the plane is searched for.
const MOST_COMPARED: usize = 64;

/// Items before the points of a `bicubic_patch`.
const OF_PATCH: &[Word] =
    &[Word::Type, Word::USteps, Word::VSteps, Word::Flatness, Word::UvVectors];

impl Evaluator<'_> {
    /// Reads `polygon { count, <…>, … }`: a point equal to its outline's first point closes the outline, and
    /// the next point begins another.
    ///
    /// **Source:** POV-Ray 3.7 manual, 3.4.5.2.5 "Polygon".
    pub(super) fn polygon(&mut self, token: &Token) -> Outcome<Solid> {
        let label = "expected how many there are before this".to_owned();
        if let Some(reported) = self.uncounted("", label, "how many points there are") {
            return Err(reported);
        }
        let count = self.number_after(token, "how many points there are")?;
        if count.value < 3.0 {
            let message = "a polygon has three points or more";
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(count.span, format!("expected 3 or more, found {}", count.value));
            return Err(self.report(&count.here, diagnostic));
        }
        let wanted = self.counted(&count);
        let mut polygon = Polygon::default();
        let mut line: Vec<Vector> = Vec::new();
        let mut places: Vec<(Vector, Span)> = Vec::new();
        let announced = count.span;
        let (mut last, mut points) = (count.with(Vector::ZERO), 0u64);
        let (mut first, mut size) = (announced, 0.0_f64);
        for number in 1..=wanted {
            let name = format!("a vector for point {number} of {wanted}");
            self.announced = Some((announced, points as usize));
            let given = self.given(token, &name);
            self.announced = None;
            let point = self.as_vector(given?, &name)?;
            places.push((point.value, point.span));
            if line.is_empty() {
                first = point.span;
            }
            size = size.max(point.value.abs().max_element());
            if line.first().is_some_and(|first| is_same(*first, point.value, size)) {
                polygon.lines.push(std::mem::take(&mut line));
            } else {
                line.push(point.value);
            }
            points += 1;
            if !self.has_memory(points * size_of::<(Vector, Span)>() as u64) {
                return Err(self.too_much_memory(&token.here, token.span));
            }
            last = point;
        }
        if let Some(begins) = unclosed_before(&line) {
            let [outer, inner] = [line[0], line[begins]].map(crate::math::vector::written);
            let message = "an outline of this polygon does not return to where it began";
            let diagnostic = Diagnostic::new(Code::OpenOutline, message)
                .at(last.span, format!("the outline from {inner} on ends here"))
                .help(format!("add `{outer}` before {inner}, and count it"));
            self.report(&last.here, diagnostic);
        } else if !line.is_empty() && !self.goes_on() {
            self.lint_open_outline(Word::Polygon.name(), (&last.here, last.span), first);
        }
        if !line.is_empty() {
            polygon.lines.push(line);
        }
        self.stored += points * size_of::<Vector>() as u64;
        self.check_flat(token, &mut polygon, &places, &last)?;
        Ok(Solid::Polygon { polygon })
    }

    /// Checks that a polygon is flat: a collinear one is nothing, and POV-Ray draws nothing if it is not
    /// flat.
    fn check_flat(
        &mut self,
        token: &Token,
        polygon: &mut Polygon,
        places: &[(Vector, Span)],
        last: &Given<Vector>,
    ) -> Outcome<()> {
        let Some(plane) = polygon.plane() else {
            let message = "a polygon whose points lie in a line is nothing";
            let diagnostic = Diagnostic::new(self.sizeless(), message)
                .at(last.span, "expected a point beside the line through the others");
            return self.nothing(token, &last.here, diagnostic);
        };
        let points = || polygon.lines.iter().flatten();
        let farthest = points().max_by(|a, b| plane.off(**a).total_cmp(&plane.off(**b)));
        let Some(point) = farthest.filter(|point| plane.off(**point) > FLAT_ENOUGH) else {
            return Ok(());
        };
        let lone = lone_stray(places);
        let of = if lone.is_some() { "the others" } else { "others" };
        let point = crate::math::vector::written(lone.map_or(*point, |(point, _)| point));
        // In a run of many points, a single one has no span of its own.
        let is_one = |span: &Span| self.sources.text(*span).matches('<').count() <= 1;
        let place = lone.map(|(_, span)| span).filter(is_one).unwrap_or(token.span);
        let message = format!("this polygon is not flat: {point} lies beside the plane of {of}");
        let diagnostic = Diagnostic::new(self.undrawn(Code::OutOfRange), message)
            .at(place, "all points must lie in one plane")
            .help("a `mesh` may be bent");
        polygon.lines.clear();
        self.nothing(token, &token.here, diagnostic)
    }

    /// Reads `bicubic_patch { type 0 u_steps 3 v_steps 3 flatness 0 <…> }`, with 16 points in four rows. The
    /// exact patch is intersected; the subdivision settings have no effect.
    ///
    /// **Source:** POV-Ray 3.7 manual, 3.4.5.2.1 "Bicubic Patch".
    pub(super) fn bicubic_patch(&mut self, token: &Token) -> Outcome<Solid> {
        let (mut typed, mut uvs) = (false, None);
        while let Some((item, word)) = self.next_part(Word::BicubicPatch, OF_PATCH) {
            typed |= word == Word::Type;
            match word {
                Word::UvVectors => {
                    let mut corner = |name| self.uv_after(&item, name);
                    let [a, b] = [corner("first")?, corner("second")?];
                    uvs = Some(Box::new([a, b, corner("third")?, corner("fourth")?]));
                }
                Word::Type => {
                    let kind = self.number_after(&item, "0 or 1")?;
                    if ![0.0, 1.0].contains(&kind.value) {
                        // The subdivision has no effect here. POV-Ray drops fractions (measured).
                        if kind.value.trunc() < 0.0 {
                            return Err(self.out_of_range(&kind, word, "0 or 1"));
                        }
                        let read = if kind.value < 1.0 { "it is 0" } else { "it is 1" };
                        self.out_of_range_but_read(&kind, word, "0 or 1", read)?;
                    }
                }
                _ => drop(self.number_in(&item, word, &Range::ZERO_IF_NEGATIVE)?),
            }
        }
        if !typed && self.options.dialect == Dialect::Pov {
            let diagnostic =
                Diagnostic::new(Code::MissingPart, "this `bicubic_patch` has no `type`")
                    .at(token.span, "`type 0` or `type 1` is missing: POV-Ray refuses it without")
                    .help(Word::BicubicPatch.sentence());
            self.report(&token.here, diagnostic);
        }
        let mut points = [Vector::ZERO; 16];
        let mut last = None;
        for (i, place) in points.iter_mut().enumerate() {
            let wanted = format!("a vector for point {} of 16", i + 1);
            let given = self.given(token, &wanted)?;
            let point = self.as_vector(given, &wanted)?;
            *place = point.value;
            last = Some(point);
        }
        let solid = Solid::BicubicPatch { points: Box::new(points), uvs };
        if let Some(last) = last.filter(|_| solid.is_sizeless()) {
            let message = "a patch whose points lie in a line is nothing";
            let diagnostic = Diagnostic::new(self.sizeless(), message)
                .at(last.span, "expected a point beside the line through the others");
            self.nothing(token, &last.here, diagnostic)?;
        }
        Ok(solid)
    }
}

/// Returns the only point whose removal leaves the others flat. Among four points, each is such a point.
fn lone_stray(places: &[(Vector, Span)]) -> Option<(Vector, Span)> {
    let mut points: Vec<(Vector, Span)> = Vec::new();
    for place in places {
        if points.iter().all(|(other, _)| *other != place.0) {
            points.push(*place);
        }
        if points.len() > MOST_COMPARED {
            return None;
        }
    }
    let is_stray = |stray: &&(Vector, Span)| {
        let rest = points.iter().map(|(point, _)| *point).filter(|point| *point != stray.0);
        let rest = Polygon { lines: vec![rest.collect()] };
        let plane = rest.plane();
        plane.is_some_and(|plane| rest.lines[0].iter().all(|p| plane.off(*p) <= FLAT_ENOUGH))
    };
    let mut strays = points.iter().filter(is_stray);
    strays.next().filter(|_| strays.next().is_none()).copied()
}

/// Returns whether two corners of a polygon of this size are equal within the rounding error of the
/// calculations they may come from: `<10*cos(2*pi), 10*sin(2*pi), 0>` is `<10, 0, 0>`.
fn is_same(a: Vector, b: Vector, size: f64) -> bool {
    (a - b).abs().max_element() <= size * ROUNDED
}

/// Returns where, in an outline that does not return to its first point, another one begins that ends with
/// the last point.
fn unclosed_before(line: &[Vector]) -> Option<usize> {
    let (last, before) = line.split_last()?;
    let begins = before.iter().position(|point| point == last)?;
    // Both have at least three corners.
    (begins >= 3 && before.len() >= begins + 3).then_some(begins)
}
