//! Warnings for light keywords that have no effect, or an unlikely one.
//!
//! **Invariant:** usage in POV-Ray's own scenes is not a mistake: `radius -90 falloff 90 tightness 1` falls
//! off with the cosine.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{LightKind, LightSource};
use crate::source::Span;
use crate::vocabulary::Word;

use super::super::super::stream::{Token, TokenKind};
use super::super::super::{Evaluator, Outcome};
use super::super::part::Given;
use super::Written;

/// A warning about a keyword's number: the value, the message, and what was expected.
struct Doubt<'a>(&'a Given<f64>, String, &'static str);

impl Evaluator<'_> {
    /// Warns of a second number that was probably meant as the power: `fade_distance 3, 2`.
    pub(super) fn power_behind_distance(&mut self, token: &Token) {
        // Without a comma it may be a grey colour.
        let rest = self.taken.and_then(|taken| {
            let text = &self.sources.get(taken.span.file).text;
            text.get(taken.span.end as usize..)?.trim_start().strip_prefix(',')
        });
        let is_number =
            |rest: &str| rest.trim_start().starts_with(|c: char| c.is_ascii_digit() || c == '.');
        if !rest.is_some_and(is_number) {
            return;
        }
        self.skip_commas();
        let Some(Token { kind: TokenKind::Expression(id), here, span }) = self.next() else {
            return;
        };
        if self.number(&here, id).is_err() {
            return;
        }
        let (text, name) = (self.sources.text(span).to_owned(), Word::FadePower.name());
        let message = "`fade_distance` takes one number, and here is one more";
        let between = Span { start: token.span.end, end: span.start, ..span };
        let comma = self.sources.text(between).rfind(',').map(|at| {
            let start = between.start + at as u32;
            Span { start, end: start + 1, ..span }
        });
        let diagnostic = Diagnostic::new(Code::WrongArity, message)
            .at(span, "is this the power?")
            .also(token.span, "for this")
            .help(format!("write `{name} {text}`"))
            .fix(span, format!("{name} {text}"));
        let diagnostic = match comma {
            Some(comma) => diagnostic.fix(comma, ""),
            None => diagnostic,
        };
        self.report(&here, diagnostic);
    }

    /// Warns of doubtful settings of a light, before they are applied. For a light at infinity, reports
    /// invalid ones.
    pub(super) fn doubt_light(&mut self, light: &LightSource, written: &Written) -> Outcome<()> {
        if self.poison.is_some() {
            return Ok(());
        }
        if let (LightKind::Direction { .. }, [first, others @ ..]) =
            (&light.kind, written.of_a_place.as_slice())
        {
            let word = self.describe(first);
            let message = format!("{word} has no meaning for a light with a `direction`");
            let mut diagnostic = Diagnostic::new(Code::ExtraPart, message)
                .at(first.span, "its light comes on parallel rays from infinitely far");
            for other in others {
                diagnostic = diagnostic.also(other.span, "nor has this");
            }
            let help = "give the light a place: `light_source { <place>, rgb 1 … }`";
            return Err(self.report(&first.here, diagnostic.help(help)));
        }
        if let Some((second, other)) = &written.second {
            let message = match (&second.kind, other) {
                (TokenKind::Word(Word::Shadowless), other) => {
                    format!("`shadowless` after `{0}` makes it a light without `{0}`", other.name())
                }
                (TokenKind::Word(word), Word::Shadowless) => {
                    format!("`{}` after `shadowless` makes it a light with shadows", word.name())
                }
                _ => "a light is a `spotlight` or a `cylinder`; the last one is used".to_owned(),
            };
            let diagnostic = Diagnostic::new(Code::UnlikelyLight, message)
                .at(second.span, "this light has the other before it");
            self.report(&second.here, diagnostic);
        }
        for Doubt(given, message, label) in doubts(light, written) {
            let diagnostic = Diagnostic::new(Code::UnlikelyLight, message).at(given.span, label);
            self.report(&given.here, diagnostic);
        }
        Ok(())
    }
}

fn doubts<'a>(light: &LightSource, written: &'a Written) -> Vec<Doubt<'a>> {
    let mut found = beam_doubts(light, written);
    let distance = written.said(Word::FadeDistance);
    let power = written.said(Word::FadePower);
    if let Some(given) = distance {
        if given.value < 0.0 {
            let (is, used) = (given.value, -given.value);
            let message = format!("this `fade_distance` is {is}; {used} is used");
            found.push(Doubt(given, message, "expected more than 0"));
        }
        if power.is_none() && light.fade.is_none() && given.value != 0.0 {
            let message = "`fade_distance` does nothing without a `fade_power`".to_owned();
            found.push(Doubt(given, message, "expected `fade_power 2`, or the like, beside it"));
        }
    }
    if let Some(given) = power {
        if given.value < 0.0 {
            let message = format!("this `fade_power` is {}; the light does not fade", given.value);
            found.push(Doubt(given, message, "expected more than 0"));
        } else if distance.is_none() && light.fade.is_none() && given.value != 0.0 {
            let message = "`fade_power` does nothing without a `fade_distance`".to_owned();
            found.push(Doubt(given, message, "expected a `fade_distance` beside it"));
        }
    }
    found
}

fn beam_doubts<'a>(light: &LightSource, written: &'a Written) -> Vec<Doubt<'a>> {
    let mut found = Vec::new();
    let Some(round) = written.round(light) else { return found };
    let [radius, falloff] = [Word::Radius, Word::Falloff].map(|word| written.said(word));
    if round == Word::Cylinder {
        if let Some(given) = falloff.filter(|given| given.value <= 0.0) {
            let message = "this cylinder of light has no width, and gives no light".to_owned();
            found.push(Doubt(given, message, "expected more than 0"));
        }
        if let Some(given) = radius.filter(|given| given.value < 0.0) {
            let message = format!("the `radius` of this cylinder of light is {}", given.value);
            found.push(Doubt(given, message, "expected 0 or more"));
        }
    } else {
        for (name, given) in [("radius", radius), ("falloff", falloff)] {
            let Some(given) = given.filter(|given| given.value.abs() > 180.0) else { continue };
            let message = format!("the `{name}` of this spotlight is {} degrees", given.value);
            found.push(Doubt(given, message, "expected 90 at most"));
        }
        if let (Some(radius), Some(falloff)) = (written.radius, written.falloff)
            && radius.max(falloff) < 0.0
        {
            let given = written.said(Word::Radius).or(written.said(Word::Falloff));
            let message = "`radius` and `falloff` of this spotlight are both negative".to_owned();
            found.extend(given.map(|given| Doubt(given, message, "expected 0 or more")));
        }
    }
    if let Some(given) = written.said(Word::Tightness).filter(|given| given.value < 0.0) {
        let message = "with a negative `tightness` a beam is darkest in its middle".to_owned();
        found.push(Doubt(given, message, "expected 0 or more"));
    }
    found
}
