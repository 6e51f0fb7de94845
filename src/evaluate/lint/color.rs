//! Unlikely colours: components from 0 to 255, negative ones, two or too many of them, or a transparent
//! background.

use super::is_literal;
use crate::color::{Color, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::{Given, takes_transmit};
use crate::evaluate::stream::Token;
use crate::evaluate::value::Value;
use crate::evaluate::{Evaluator, Here};
use crate::source::Span;
use crate::vocabulary::Word;

/// Limit below which integers may be intended, in any colour; higher for light sources.
const ANY: f64 = 16.0;
const LAMP: f64 = 128.0;

impl Evaluator<'_> {
    /// Checks the numbers given for a colour.
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

    /// Warns of more components than the keyword takes: `rgb <1, 0, 0, 0.5>`. A colour has five, and passes
    /// unchanged except after `rgbt`.
    pub(in crate::evaluate) fn lint_extra_components(
        &mut self,
        token: &Token,
        word: Word,
        wanted: usize,
        given: &Given<Value>,
    ) {
        let name = word.name();
        let count = match &given.value {
            Value::Color(color) if takes_transmit(word) => {
                return self.lint_swapped_color(name, color, given);
            }
            Value::Vector(components) if components.len() > wanted => components.len(),
            _ => return,
        };
        let meant = match (count, wanted) {
            _ if takes_transmit(word) => "the fourth is its transmit, the fifth is dropped",
            (4, _) => "the fourth is its filter",
            (_, 3) => "the fourth is its filter, the fifth its transmit",
            _ => "the fifth is its transmit",
        };
        let message = format!("`{name}` takes {wanted} components, and is given {count}");
        let diagnostic = Diagnostic::new(Code::ExtraComponent, message).at(given.span, meant);
        let base = name.trim_end_matches(['f', 't']);
        let meant = self.commas_within(given.span);
        let diagnostic = match meant.or_else(|| self.commas_in_color(given.span)) {
            Some(vector) => diagnostic
                .help(format!("a fraction is written with a point: `{vector}`"))
                .fix(given.span, vector),
            None if count == 4 => diagnostic.help(format!(
                "`{base}f` takes red, green, blue and filter; `{base}t` red, green, blue and transmit"
            )),
            None => {
                let told = diagnostic.help(format!(
                    "`{base}ft` takes red, green, blue, filter and transmit"
                ));
                // A name may have fewer components in another call.
                match self.sources.text(given.span).starts_with('<') {
                    true => told.fix(token.span, format!("{base}ft")),
                    false => told,
                }
            }
        };
        self.report(&given.here, diagnostic);
    }

    /// Warns of `rgbt Glass` with a colour, whose fourth component is its filter.
    fn lint_swapped_color(&mut self, name: &str, color: &Color, given: &Given<Value>) {
        // As written: a value read back from a name has single precision.
        let [filter, transmit] = [color.filter as f32, color.transmit as f32];
        if filter == 0.0 && transmit == 0.0 {
            return;
        }
        let all = format!("{}ft", name.trim_end_matches('t'));
        let message = format!("`{name}` takes the filter of this colour for its transmit");
        let diagnostic = Diagnostic::new(Code::ExtraComponent, message)
            .at(given.span, format!("its filter is {filter}, its transmit {transmit}"))
            .help(format!("`{all} {}` takes it as it is", self.sources.text(given.span)));
        self.report(&given.here, diagnostic);
    }

    /// Warns of a colour, which should be 0 to 1, that looks like 0 to 255 or is negative.
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
            _ => clear_by_itself(&written).unwrap_or_else(|| format!("{written}/255")),
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

    /// Warns of a negative colour. In a light it may be intended, to remove light; so may a computed one, or
    /// one at the start of a map, which is clipped at black.
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

    /// Returns the only colour of three components up to 1 that results if some commas are decimal points:
    /// `<0,5,0,7,1>`.
    fn commas_in_color(&self, span: Span) -> Option<String> {
        let text = self.sources.text(span).strip_prefix('<')?.strip_suffix('>')?;
        let parts: Vec<&str> = text.split(',').map(str::trim).collect();
        let is_typed = |part: &&str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
        if !parts.iter().all(is_typed) || parts.iter().all(|part| matches!(*part, "0" | "1")) {
            return None;
        }
        // Of four, one component has a fraction, of five all but one. `<0, 128, 0, 1>` is rather one of
        // 0 to 255.
        let (few, many) = (parts.len() == 4, parts.len() == 5);
        if !(many || few && parts.iter().all(|part| part.len() == 1)) {
            return None;
        }
        let grouped = |odd: usize| {
            let mut rest = parts.iter();
            let colors = (0..3).map(|i| match (i == odd) == few {
                true => Some(format!("{}.{}", rest.next()?, rest.next()?)),
                false => Some((*rest.next()?).to_owned()),
            });
            let colors: Vec<String> = colors.collect::<Option<_>>()?;
            let is_part = |color: &String| color.parse::<f64>().is_ok_and(|color| color <= 1.0);
            colors.iter().all(is_part).then(|| format!("<{}>", colors.join(", ")))
        };
        let mut colors = (0..3).filter_map(grouped);
        let color = colors.next()?;
        colors.next().is_none().then_some(color)
    }

    /// Warns of a transparent background: there is nothing behind it, so it shows black.
    pub(in crate::evaluate) fn lint_background(&mut self, given: &Given<Color>) {
        let Color { rgb, transmit, .. } = given.value;
        // For surplus numbers, which were reported.
        let is_told = self.diagnostics.iter().any(|one| {
            let place = one.primary().filter(|_| one.code == Code::ExtraComponent);
            place.is_some_and(|place| self.taken.is_some_and(|taken| taken.span == place.span))
        });
        // In a scene for an older version a background is never transparent.
        if rgb.is_black() || transmit <= 0.0 || is_told || self.is_old() {
            return;
        }
        let end = self.taken.map_or(given.span, |taken| taken.span);
        let whole = if end.file == given.span.file { given.span.to(end) } else { given.span };
        let text = self.sources.text(whole);
        let number = ["color", "colour"].iter().find_map(|word| text.strip_prefix(word));
        let number = number.unwrap_or(text).trim();
        // A component that is written explicitly is intended.
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

/// Returns a vector with its colour divided by 255 if its transparency is a fraction already:
/// `<255, 128, 0, 0.5>`.
fn clear_by_itself(vector: &str) -> Option<String> {
    let parts: Vec<&str> = vector.strip_prefix('<')?.strip_suffix('>')?.split(',').collect();
    let (colors, clear) = parts.split_at_checked(3)?;
    let is_part = |part: &&str| part.trim().parse::<f64>().is_ok_and(|part| part <= 1.0);
    let typed = colors.iter().all(|part| is_literal(part.trim()));
    if clear.is_empty()
        || !typed
        || !clear.iter().all(is_part)
        || clear.iter().all(|c| c.trim() == "0")
    {
        return None;
    }
    let divided = colors.iter().map(|part| match part.trim() {
        "0" => "0".to_owned(),
        part => format!("{part}/255"),
    });
    let all: Vec<String> = divided.chain(clear.iter().map(|c| c.trim().to_owned())).collect();
    Some(format!("<{}>", all.join(", ")))
}
