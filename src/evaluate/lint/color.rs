//! Colours that were hardly meant so: 0 to 255, negative, two components, a clear background.

use super::is_literal;
use crate::color::{Color, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::Given;
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Here};
use crate::source::Span;

/// Below it, whole numbers may be meant as they are: of anything, and of what gives light.
const ANY: f64 = 16.0;
const LAMP: f64 = 128.0;

impl Evaluator<'_> {
    /// What is given for a colour, as numbers.
    pub(in crate::evaluate) fn lint_color(&mut self, given: &Given<Value>, rgb: Rgb) {
        match &given.value {
            Value::Color(_) => {}
            Value::Vector(components) if components.len() == 2 => {
                let message = "this colour has two components: its blue is 0";
                let diagnostic = Diagnostic::new(Code::ShortVector, message)
                    .at(given.span, "expected red, green and blue");
                let [red, green] = [rgb.red, rgb.green];
                let help = match red == green {
                    true => format!("did you mean `{red}`, a grey, or `<{red}, {green}, 0>`?"),
                    false => format!("write `<{red}, {green}, 0>` if it is to be so"),
                };
                self.report(&given.here, diagnostic.help(help));
            }
            _ => self.lint_color_range(&given.here, given.span, rgb),
        }
    }

    /// A colour is 0 to 1; this one looks like 0 to 255, or is negative.
    pub(in crate::evaluate) fn lint_color_range(&mut self, here: &Here, span: Span, rgb: Rgb) {
        let components = [rgb.red, rgb.green, rgb.blue];
        let whole = components.iter().all(|c| c.fract() == 0.0 && (0.0..=255.0).contains(c));
        let largest = rgb.largest();
        if components.iter().any(|c| *c < 0.0) {
            return self.lint_negative_color(here, span);
        }
        if !whole || largest < ANY {
            return;
        }
        let gray = rgb.red == rgb.green && rgb.green == rgb.blue;
        let opener = self.openers.last().map(|span| self.sources.text(*span));
        let is_seen = self.in_pigment() || matches!(opener, Some("background" | "global_settings"));
        // Lights may be far brighter than 1, and a colour that is declared may be for one: a grey or
        // round numbers may be meant so.
        let round = components.iter().all(|c| c % 10.0 == 0.0);
        let is_bytes = largest == 255.0 || largest >= LAMP && !(gray || round);
        if !(is_seen || is_bytes) {
            return;
        }
        let text = self.sources.text(span);
        let vector = text.starts_with('<') && text.ends_with('>');
        let written = match vector || is_literal(text) {
            true => text.to_owned(),
            false => format!("<{}, {}, {}>", rgb.red, rgb.green, rgb.blue),
        };
        let divided = match written.as_str() {
            "255" => "1".to_owned(),
            _ => format!("{written}/255"),
        };
        let mut diagnostic = Diagnostic::new(
            Code::ColorRange,
            "this colour looks as if written as 0 to 255; colours are 0 to 1",
        )
        .at(span, "far brighter than white")
        .help(match is_seen {
            true => format!("write `{divided}`"),
            false => format!("write `{divided}`, if it is no light of that strength"),
        });
        if written == text && is_seen {
            diagnostic = diagnostic.fix(span, divided);
        }
        self.report(here, diagnostic);
    }

    /// Of a light it may be meant: such a one takes light away. So may what is computed, or begins a map:
    /// it is cut at black.
    fn lint_negative_color(&mut self, here: &Here, span: Span) {
        let text = self.sources.text(span);
        let typed = !text.contains(|c: char| c.is_alphabetic());
        let opener = self.openers.last().map(|span| self.sources.text(*span));
        if typed && opener == Some("pigment") {
            let diagnostic =
                Diagnostic::new(Code::ColorRange, "a component of this colour is negative")
                    .at(span, "expected 0 to 1: no surface gives back less than nothing");
            self.report(here, diagnostic);
        }
    }

    /// There is nothing behind a background: what it lets through is black.
    pub(in crate::evaluate) fn lint_background(&mut self, given: &Given<Color>) {
        let Color { rgb, transmit, .. } = given.value;
        if rgb.is_black() || transmit <= 0.0 {
            return;
        }
        let end = self.taken.map_or(given.span, |taken| taken.span);
        let whole = if end.file == given.span.file { given.span.to(end) } else { given.span };
        let text = self.sources.text(whole);
        let number = ["color", "colour"].iter().find_map(|word| text.strip_prefix(word));
        let number = number.unwrap_or(text).trim();
        // A part that is written as such is meant.
        if transmit < 1.0 && !is_literal(number) {
            return;
        }
        let message = match transmit < 1.0 {
            true => "this background is clear, and so darker than its colour",
            false => "this background is clear, and so it is black",
        };
        let mut diagnostic = Diagnostic::new(Code::TooClear, message)
            .at(whole, format!("its `transmit` is {transmit}, and nothing is behind it"));
        diagnostic = match is_literal(number) {
            true => {
                let right = format!("rgb {number}");
                diagnostic
                    .help(format!("one number is for filter and transmit too: write `{right}`"))
                    .fix(whole, right)
            }
            false => diagnostic.help("write it with `rgb`, which has no transmit"),
        };
        self.report(&given.here, diagnostic);
    }
}
