//! Unrealistic values in a finish.

use super::is_literal;
use crate::color::Rgb;
use crate::diagnostic::{Code, Diagnostic};
use crate::evaluate::block::Given;
use crate::evaluate::stream::Token;
use crate::evaluate::{Evaluator, Here, Outcome};
use crate::scene::{ClassicFinish, Finish};
use crate::source::{Site, Span};
use crate::vocabulary::Word;

/// From this value on, light is not visible on a surface of a medium colour.
const LAMP_AMBIENT: f64 = 2.0;
/// The manual limits roughness to 1; slightly beyond it a surface still has a highlight.
const ROUGHEST: f64 = 2.0;
/// Whole-number strengths in this range are taken for percentages. A lamp's ambient light may be as high.
const PERCENTAGE: std::ops::RangeInclusive<f64> = 10.0..=100.0;
const BRIGHT_AMBIENT: f64 = 20.0;
/// Indices of refraction from here on, written as integers, are unlikely.
const NO_IOR: f64 = 10.0;

impl Evaluator<'_> {
    /// Warns of a surface that removes light, or reflects more than it receives.
    pub(in crate::evaluate) fn lint_strength(
        &mut self,
        here: &Here,
        span: Span,
        word: Word,
        light: Rgb,
    ) {
        let name = word.name();
        let text = self.sources.text(span);
        let percentage = is_literal(text)
            && light.red.fract() == 0.0
            && PERCENTAGE.contains(&light.red)
            && matches!(word, Word::Diffuse | Word::Phong | Word::Specular | Word::Reflection);
        let diagnostic = if light.red.min(light.green).min(light.blue) < 0.0 {
            Diagnostic::new(Code::UnlikelyFinish, format!("a negative `{name}` takes light away"))
                .at(span, "expected 0 or more")
        } else if percentage {
            percentage_of(span, name, light.red)
        } else if word == Word::Reflection && light.largest() > 1.0 {
            let message = format!("this `{name}` gives back more light than arrives");
            Diagnostic::new(Code::UnlikelyFinish, message).at(span, "expected 0 to 1")
        } else {
            return;
        };
        self.report(here, diagnostic);
    }

    /// Warns of a percentage in a colour, `transmit 50`. Values from 100 on increase contrast, as in
    /// POV-Ray's own scenes.
    pub(in crate::evaluate) fn lint_clear_percentage(
        &mut self,
        here: &Here,
        span: Span,
        word: Word,
    ) {
        let text = self.sources.text(span);
        let number = text.parse::<f64>().ok().filter(|number| number.fract() == 0.0);
        let is_percentage = |number: &f64| PERCENTAGE.contains(number) && number < PERCENTAGE.end();
        if let Some(number) = number.filter(is_percentage) {
            self.report(here, percentage_of(span, word.name(), number));
        }
    }

    /// Warns of a repeated keyword, `diffuse 0.6 … diffuse 0.2`. A caller may override a macro's value, and a
    /// branch the value before it.
    pub(in crate::evaluate) fn lint_word_twice(
        &mut self,
        token: &Token,
        word: Word,
        said: &mut Vec<(Word, Site)>,
    ) {
        let site = token.here.site(token.span);
        let before = said.iter().rev().find(|(other, _)| *other == word).map(|(_, first)| *first);
        said.push((word, site));
        let Some(first) = before.filter(|first| {
            let between = Span { end: site.span.start, ..first.span };
            first.expansion == site.expansion
                && first.span.file == site.span.file
                && first.span.end <= site.span.start
                && !self.sources.text(between).contains('#')
        }) else {
            return;
        };
        let message = format!("this finish has `{}` twice; the last one is used", word.name());
        let diagnostic = Diagnostic::new(Code::UnlikelyFinish, message)
            .at(token.span, "this one is used")
            .also(first.span, "this one does nothing");
        self.report(&token.here, diagnostic);
    }

    /// Warns of `ambient 50` if the surface also scatters light, and so is not a lamp.
    pub(in crate::evaluate) fn lint_ambient(&mut self, given: &Given<Rgb>, finish: &Finish) {
        let Finish::Classic(ClassicFinish { diffuse, .. }) = finish else { return };
        let ambient = given.value.red;
        let whole = ambient.fract() == 0.0 && (BRIGHT_AMBIENT..=100.0).contains(&ambient);
        if *diffuse == 0.0 || !is_literal(self.sources.text(given.span)) {
            return;
        }
        if whole {
            self.report(&given.here, percentage_of(given.span, Word::Ambient.name(), ambient));
        } else if (LAMP_AMBIENT..BRIGHT_AMBIENT).contains(&ambient) {
            let message =
                format!("an `ambient` of {ambient} outshines every light on this surface");
            let diagnostic = Diagnostic::new(Code::UnlikelyFinish, message)
                .at(given.span, "expected 0 to 1")
                .help("of a lamp it is meant: `ambient` with `diffuse 0`, or `emission`");
            self.report(&given.here, diagnostic);
        }
    }

    /// Reads `ior`, and warns of values such as 0.75: a medium is rarely thinner than air.
    pub(in crate::evaluate) fn index_of_refraction(&mut self, token: &Token) -> Outcome<f64> {
        let given = self.number_after(token, "a number")?;
        if given.value == 0.0 {
            self.out_of_range_but_read(
                &given,
                Word::Ior,
                "more than 0",
                "the object refracts nothing",
            )?;
            return Ok(1.0);
        }
        if given.value < 0.0 {
            let read = "light is bent to the other side";
            self.out_of_range_but_read(&given, Word::Ior, "more than 0", read)?;
        }
        let value = given.value;
        if value > 0.0 && value < 1.0 && is_literal(self.sources.text(given.span)) {
            let message = format!("an `ior` of {value} is below that of a vacuum");
            let diagnostic = Diagnostic::new(Code::LowIor, message)
                .at(given.span, "expected 1 or more: water has 1.33, glass 1.5")
                .help(format!(
                    "the way out of a material is known: write its own, {:.2}",
                    1.0 / value
                ));
            self.report(&given.here, diagnostic);
        }
        let text = self.sources.text(given.span);
        let is_whole = text.bytes().all(|byte| byte.is_ascii_digit());
        if value >= NO_IOR && is_literal(text) && is_whole {
            let message = format!("no material has an `ior` of {value}");
            let diagnostic = Diagnostic::new(Code::UnlikelyFinish, message)
                .at(given.span, "water has 1.33, glass 1.5, diamond 2.4");
            let diagnostic = match text.split_at(1) {
                (whole @ ("1" | "2"), rest) => {
                    diagnostic.help(format!("is a point missing? write `{whole}.{rest}`"))
                }
                _ => diagnostic,
            };
            self.report(&given.here, diagnostic);
        }
        Ok(value)
    }

    /// Warns of swapped ranges: `roughness 30`, `phong_size 0.5`.
    pub(in crate::evaluate) fn lint_highlight(&mut self, given: &Given<f64>, word: Word) {
        let value = given.value;
        if !is_literal(self.sources.text(given.span)) {
            return;
        }
        let diagnostic = match word {
            Word::Roughness if value > ROUGHEST => {
                let message = format!("a `roughness` of {value} leaves no highlight");
                Diagnostic::new(Code::UnlikelyFinish, message)
                    .at(given.span, "expected 0.0005 (smooth) to 1 (rough)")
                    .help("`phong_size` goes the other way: 1 (dull) to 250 (polished)")
            }
            Word::PhongSize if 0.0 < value && value < 1.0 => {
                let message = format!("a `phong_size` of {value} leaves no highlight");
                Diagnostic::new(Code::UnlikelyFinish, message)
                    .at(given.span, "expected 1 (dull) to 250 (polished)")
                    .help("`roughness` goes the other way: 1 (rough) to 0.0005 (smooth)")
            }
            _ => return,
        };
        self.report(&given.here, diagnostic);
    }

    /// Warns of a highlight's size without a strength: `finish { roughness 0.02 }`.
    pub(in crate::evaluate) fn lint_unlit_highlight(
        &mut self,
        finish: &Finish,
        written: &[(Word, Site)],
    ) {
        let Finish::Classic(ClassicFinish { phong, specular, phong_size, .. }) = finish else {
            return;
        };
        for &(word, site) in written {
            let (strength, of) = match word {
                Word::Roughness => (*specular, Word::Specular),
                Word::PhongSize if *phong_size != 0.0 => (*phong, Word::Phong),
                _ => continue,
            };
            // A strength that is written may be zero for now.
            if strength != 0.0 || written.iter().any(|(other, _)| *other == of) {
                continue;
            }
            let of = of.name();
            let name = word.name();
            let message = format!("`{name}` has no effect without `{of}`");
            let diagnostic = Diagnostic::new(Code::UnlikelyFinish, message)
                .at(site.span, "the highlight that it measures has no strength")
                .help(format!("add one, as `{of} 0.5`, or leave it out"));
            self.report_in(site.expansion, diagnostic);
        }
    }

    /// Warns of stronger reflection at normal incidence than at grazing angles: `reflection { 0.9, 0.1 }`.
    pub(in crate::evaluate) fn lint_reflection_order(
        &mut self,
        least: &Given<Rgb>,
        most: &Given<Rgb>,
    ) {
        let [a, b] = [least.value, most.value].map(|c| [c.red, c.green, c.blue]);
        let above = a.iter().zip(&b).all(|(a, b)| a >= b);
        if !above || a == b {
            return;
        }
        let diagnostic =
            Diagnostic::new(Code::UnlikelyFinish, "the least reflection is more than the most")
                .at(least.span, "the least, where one looks straight at the surface")
                .also(most.span, "the most, at a glance");
        let texts = [least.span, most.span].map(|span| self.sources.text(span).to_owned());
        let diagnostic = match texts.iter().all(|text| is_literal(text)) {
            true => {
                let [a, b] = texts;
                let right = format!("{b}, {a}");
                diagnostic.help(format!("write `{right}`")).fix(least.span.to(most.span), right)
            }
            false => diagnostic.help("the least comes first: `reflection { 0.1, 0.9 }`"),
        };
        self.report(&least.here, diagnostic);
    }
}

fn percentage_of(span: Span, name: &str, value: f64) -> Diagnostic {
    let part = format!("{}", value / 100.0);
    let diagnostic =
        Diagnostic::new(Code::SuspiciousUnit, format!("this `{name}` looks like a percentage"))
            .at(span, "expected 0 to 1")
            .help(format!("write `{part}`"))
            .fix(span, part);
    match name {
        "phong" => {
            diagnostic.help(format!("or did you mean `phong_size {value}`, how small it is?"))
        }
        _ => diagnostic,
    }
}
