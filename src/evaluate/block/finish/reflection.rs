//! `reflection` in a finish: a colour, or two for the limits of the angle.

use super::POWER;
use crate::color::{Color, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::parts::{Block, Part, Parts};
use crate::evaluate::block::{Given, Place};
use crate::evaluate::stream::{Token, TokenKind};
use crate::evaluate::{Evaluator, Outcome, Reported};
use crate::scene::Reflection;
use crate::source::Span;
use crate::vocabulary::Word;

/// An `exponent` below this counts as 0: light to the power of a million vanishes.
const NEARLY_NOTHING: f64 = 1e-6;

impl Reflection {
    /// What a finish without `reflection` has.
    pub(super) const NONE: Self = Self {
        maximum: Rgb::BLACK,
        minimum: Rgb::BLACK,
        falloff: 1.0,
        fresnel: false,
        exponent: 1.0,
        metallic: 0.0,
    };
}

/// A reflection during reading.
struct OpenReflection {
    reflection: Reflection,
    /// `fresnel`, if it is written.
    fresnel: Option<bool>,
}

impl Block for OpenReflection {
    const PLACE: Place = Place::REFLECTION;
    const PARTS: Parts<Self> = &[
        Part::Ranged(Word::Falloff, POWER, |open, power, _| open.reflection.falloff = power),
        Part::Special(Word::Exponent, |evaluator, token, open| {
            evaluator.exponent(token).map(|exponent| open.reflection.exponent = exponent)
        }),
        Part::Optional(Word::Metallic, |open, metallic, _| open.reflection.metallic = metallic),
        Part::Optional(Word::Fresnel, |open, on, _| open.fresnel = Some(on != 0.0)),
    ];
}

impl Evaluator<'_> {
    /// Reads `reflection 0.5`, `reflection rgb <…>` or `reflection { [min,] max … }`. Properties that are not
    /// specified keep their values from `before`, as in POV-Ray.
    pub(super) fn reflection(
        &mut self,
        token: &Token,
        before: Option<Reflection>,
    ) -> Outcome<Reflection> {
        let before = before.unwrap_or(Reflection::NONE);
        let plain = |color: Rgb| Reflection { minimum: color, maximum: color, ..before };
        if !matches!(self.peek(), Some(Token { kind: TokenKind::Block(_), .. })) {
            let color = self.intensity_after(token)?.value;
            if let Some(reported) = self.ends_without_braces(token) {
                return Err(reported);
            }
            return Ok(plain(color));
        }
        let opener = token.clone();
        self.block(token, Word::Reflection, |evaluator| {
            if let Some(reported) = evaluator.named_ends() {
                return Err(reported);
            }
            let least = evaluator.intensity_after(&opener)?;
            let mut reflection = plain(least.value);
            evaluator.skip_commas();
            let both = evaluator.at_color();
            if both {
                let most = evaluator.intensity_after(&opener)?;
                evaluator.lint_reflection_order(&least, &most);
                reflection.maximum = most.value;
            }
            let mut open = OpenReflection { reflection, fresnel: None };
            evaluator.parts(&mut open)?;
            let OpenReflection { mut reflection, fresnel } = open;
            reflection.fresnel = fresnel.unwrap_or(reflection.fresnel);
            // With only one colour, the minimum is zero, unless `fresnel` is inherited (measured on POV-Ray 3.7).
            if fresnel == Some(true) && !both {
                reflection.minimum = Rgb::BLACK;
            }
            Ok(reflection)
        })
    }

    /// Reads `exponent`: POV-Ray 3.7 raises light to its reciprocal, so that 0 leaves no reflected light
    /// (measured).
    pub(super) fn exponent(&mut self, token: &Token) -> Outcome<f64> {
        let given = self.number_after(token, "a number")?;
        if given.value > 0.0 {
            return Ok(given.value);
        }
        let read = match given.value == 0.0 {
            true => "nothing is reflected",
            false => "light is taken to this negative power",
        };
        self.out_of_range_but_read(&given, Word::Exponent, "more than 0", read)?;
        Ok(if given.value == 0.0 { NEARLY_NOTHING } else { given.value })
    }

    /// Reports two values without braces, the first of which was taken: `reflection 0.1, 0.9`.
    fn ends_without_braces(&mut self, token: &Token) -> Option<Reported> {
        let taken = self.taken?.span;
        let behind = self.sources.get(taken.file).text.get(taken.end as usize..)?;
        let second = behind.trim_start().strip_prefix(',')?.trim_start();
        let is_number = second.starts_with(|c: char| c.is_ascii_digit() || c == '.' || c == '<');
        if !is_number && !second.starts_with("rgb") && !second.starts_with("color") {
            return None;
        }
        let _: Outcome<Given<Color>> = self.color_after(token, "a number");
        let whole = self.whole(token).span;
        let both = Span { start: token.span.end, ..whole };
        let text = self.sources.text(both);
        let both =
            Span { start: both.start + (text.len() - text.trim_start().len()) as u32, ..both };
        let right = format!("{{ {} }}", text.trim_start());
        let message = "the least and the most of a `reflection` stand in braces";
        let told = Diagnostic::new(Code::MissingPart, message)
            .at(both, "expected `{` before this, and `}` behind it");
        let told = match whole.start == token.span.start && !text.contains('#') {
            true => told.help(format!("write `reflection {right}`")).fix(both, right),
            false => told.help(Word::Reflection.sentence()),
        };
        Some(self.report(&token.here, told))
    }

    /// Reports named limits: `reflection { min 0.1 max 0.5 }`.
    fn named_ends(&mut self) -> Option<Reported> {
        let first = self.peek()?.clone();
        if !matches!(first.kind, TokenKind::Word(Word::Min | Word::Max)) {
            return None;
        }
        let inside = self.within_block()?.span;
        let ends = ends_by_name(self.sources.text(inside), ["min", "max"]);
        let message = "the least and the most of a `reflection` have no names";
        let told = Diagnostic::new(Code::ExtraPart, message).at(first.span, "leave this out");
        let told = match ends {
            Some((right, length)) => told
                .help(format!("write `reflection {{ {right} }}`"))
                .fix(Span { end: inside.start + length as u32, ..inside }, format!(" {right}")),
            None => told.help(Word::Reflection.sentence()),
        };
        Some(self.report(&first.here, told))
    }

    /// Reports other tools' keywords, the first of which is the name at `token`: `reflection_min 0.1
    /// reflection_max 0.5`.
    pub(super) fn ends_of_reflection(&mut self, token: &Token) -> Option<Reported> {
        let text = self.sources.get(token.span.file).text.get(token.span.start as usize..)?;
        let (right, length) = ends_by_name(text, ["reflection_min", "reflection_max"])
            .or_else(|| ends_by_name(text, ["min_reflection", "max_reflection"]))?;
        let whole = Span { end: token.span.start + length as u32, ..token.span };
        let right = format!("reflection {{ {right} }}");
        let message = "the least and the most reflection stand together";
        let told = Diagnostic::new(Code::ForeignWord, message)
            .at(token.span, "not a word in `finish`")
            .help(format!("write `{right}`"))
            .fix(whole, right);
        let reported = self.report(&token.here, told);
        let is_within = |next: &Token| next.span.file == whole.file && next.span.start < whole.end;
        while self.peek().is_some_and(is_within) {
            self.next();
        }
        Some(reported)
    }
}

/// Recognizes `min 0.1 max 0.5` with these names, in this order, at the beginning of a text. Returns the
/// values in the language's syntax, and the length of the match.
fn ends_by_name(text: &str, [least, most]: [&str; 2]) -> Option<(String, usize)> {
    let number = |text: &str, name: &str| {
        let rest = text.trim_start().strip_prefix(name)?.trim_start();
        let length = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        let (number, rest) = rest.split_at(length);
        number.parse::<f64>().ok().map(|_| (number.to_owned(), rest.len()))
    };
    let (low, left) = number(text, least)?;
    let rest = text[text.len() - left..].trim_start().trim_start_matches(',');
    let (high, left) = number(rest, most)?;
    Some((format!("{low}, {high}"), text.len() - left))
}
