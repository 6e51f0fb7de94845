//! Ranges of u and v in degrees where radians are meant: `parametric { … <0, 0>, <360, 360> }`.

use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::Evaluator;
use crate::evaluate::block::Given;
use crate::evaluate::stream::Token;
use crate::source::Span;

use super::is_literal;

impl Evaluator<'_> {
    /// Warns of full or half turns in degrees for a parameter that is only an argument of sine and cosine.
    pub(in crate::evaluate) fn lint_range(
        &mut self,
        opener: &Token,
        corners: [&Given<[f64; 2]>; 2],
    ) {
        let first = corners[0].span;
        if first.file != opener.span.file || first.start < opener.span.end {
            return;
        }
        let functions =
            self.sources.text(Span { start: opener.span.end, end: first.start, ..first });
        let mut told: Option<Diagnostic> = None;
        for (axis, name) in ["u", "v"].into_iter().enumerate() {
            let [from, to] = corners.map(|corner| corner.value[axis]);
            let is_turn = matches!((from, to), (0.0 | -180.0, 180.0) | (0.0 | -360.0, 360.0));
            if !(is_turn || (from, to) == (-90.0, 90.0)) || !is_an_angle(functions, name) {
                continue;
            }
            let typed = corners.map(|corner| self.typed_component(corner, axis));
            let [Some(low), Some(high)] = typed else { continue };
            let [from_text, to_text] = [low, high].map(|span| in_radians(self.sources.text(span)));
            let message = format!("`sin` and `cos` take radians, and `{name}` looks like degrees");
            let label = format!("`{name}` goes from {from} to {to} radians");
            let diagnostic = match told {
                Some(told) => told.also(high, label),
                None => Diagnostic::new(Code::SuspiciousUnit, message).at(high, label),
            };
            let diagnostic = match from == 0.0 {
                true => diagnostic.help(format!("write `{to_text}`")),
                false => diagnostic
                    .help(format!("write `{from_text}` and `{to_text}`"))
                    .fix(low, from_text),
            };
            told = Some(diagnostic.fix(high, to_text));
        }
        if let Some(told) = told {
            self.report(&corners[1].here, told);
        }
    }

    /// Returns the span of a corner's component, if it is a literal number.
    fn typed_component(&self, corner: &Given<[f64; 2]>, axis: usize) -> Option<Span> {
        let unit = &corner.here.unit;
        let span = unit.component_span(corner.expression?, axis)?;
        is_literal(self.sources.text(span)).then_some(span)
    }
}

/// Returns whether the functions use `u` only as an argument of sine and cosine.
fn is_an_angle(functions: &str, name: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut found = false;
    for (at, _) in functions.match_indices(name) {
        let (before, behind) = (&functions[..at], &functions[at + name.len()..]);
        if before.ends_with(is_part) || behind.starts_with(is_part) {
            continue;
        }
        let asked = before.trim_end().strip_suffix('(').map_or("", str::trim_end);
        let is_angle = asked.ends_with("sin") || asked.ends_with("cos");
        if !is_angle || !behind.trim_start().starts_with(')') {
            return false;
        }
        found = true;
    }
    found
}

/// Returns literal degrees in radians: `180` is `pi`.
fn in_radians(degrees: &str) -> String {
    let (sign, number) = match degrees.strip_prefix('-') {
        Some(number) => ("-", number.trim_start()),
        None => ("", degrees),
    };
    let radians = match number.parse::<f64>() {
        Ok(360.0) => "2*pi".to_owned(),
        Ok(180.0) => "pi".to_owned(),
        Ok(90.0) => "pi/2".to_owned(),
        _ => format!("radians({number})"),
    };
    format!("{sign}{radians}")
}
