//! Settings of the whole scene: `global_settings`, `background` and `sky_sphere`.

use std::sync::Arc;

use crate::color::Gamma;
use crate::diagnostic::{Code, Diagnostic};
use crate::noise::NoiseGenerator;
use crate::scene::{Background, Dialect, SkySphere};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::Place;

/// The maximum `max_trace_level` that POV-Ray uses; it warns of more.
const DEEPEST: f64 = 256.0;

/// The maximum `max_trace_level` here.
const MOST_LEVELS: f64 = 1_000_000.0;

impl Evaluator<'_> {
    pub(super) fn global_settings(&mut self, token: &Token) -> Outcome<()> {
        self.block(token, Word::GlobalSettings, |evaluator| {
            let mut failed = false;
            while let Some(token) = evaluator.next() {
                failed |= evaluator.setting(&token) == Err(Reported);
            }
            if failed { Err(Reported) } else { Ok(()) }
        })
    }

    fn setting(&mut self, token: &Token) -> Outcome<()> {
        match token.kind {
            TokenKind::Word(Word::AmbientLight) => {
                self.scene.settings.ambient_light =
                    self.color_after(token, "a number or a colour")?.value.rgb;
            }
            TokenKind::Word(Word::IridWavelength) => {
                self.scene.settings.irid_wavelength =
                    self.color_after(token, "a colour")?.value.rgb;
            }
            TokenKind::Word(Word::AssumedGamma) => {
                let gamma = match self.take_word(Word::Srgb) {
                    Some(_) => Gamma::Srgb,
                    None => Gamma::Power(self.more_than_zero(token, Word::AssumedGamma)?),
                };
                // If repeated, the first counts, as in POV-Ray.
                if !std::mem::replace(&mut self.says_gamma, true) {
                    if let Some(site) = self.srgb_before_gamma
                        && gamma != Gamma::LINEAR
                    {
                        let message = "`assumed_gamma` stands behind a colour that it changes";
                        let diagnostic = Diagnostic::new(Code::UnknownWord, message)
                            .at(token.span, "expected before the first `srgb`")
                            .also(site.span, "this colour is converted already")
                            .help("write `global_settings` first in the file");
                        return Err(self.report(&token.here, diagnostic));
                    }
                    self.scene.settings.assumed_gamma = gamma;
                }
            }
            TokenKind::Word(Word::MaxTraceLevel) => {
                let given = self.number_after(token, "a whole number")?;
                let level = given.value.trunc().clamp(1.0, MOST_LEVELS);
                if level != given.value {
                    let wanted = format!("a whole number from 1 to {MOST_LEVELS}");
                    let read = format!("it is {level}");
                    self.out_of_range_but_read(&given, Word::MaxTraceLevel, &wanted, &read)?;
                }
                if given.value > DEEPEST && self.options.dialect == Dialect::Pov {
                    let message = format!(
                        "`max_trace_level` is {}, and POV-Ray follows no ray deeper than {DEEPEST}",
                        given.value
                    );
                    let diagnostic = Diagnostic::new(Code::DeepTrace, message)
                        .at(given.span, format!("expected {DEEPEST} or less"))
                        .help("here rays go as deep as they are told to");
                    self.report(&given.here, diagnostic);
                }
                self.scene.settings.max_trace_level = level as u32;
                self.scene.settings.max_trace_level_site = Some(given.site());
            }
            TokenKind::Word(Word::AdcBailout) => {
                let given = self.number_after(token, "a number")?;
                if given.value < 0.0 {
                    let read = "it is 0";
                    self.out_of_range_but_read(&given, Word::AdcBailout, "0 or more", read)?;
                }
                self.scene.settings.adc_bailout = given.value.max(0.0);
            }
            TokenKind::Word(Word::NumberOfWaves) => {
                let given = self.number_after(token, "a number of waves")?;
                self.waves = if given.value >= 1.0 { given.value as usize } else { 1 };
            }
            TokenKind::Word(Word::NoiseGenerator) => {
                let given = self.number_after(token, "a number")?;
                self.says_noise = true;
                self.noise = match given.value.trunc() {
                    1.0 => NoiseGenerator::Plateaus,
                    2.0 => NoiseGenerator::RangeCorrected,
                    3.0 => NoiseGenerator::Perlin,
                    _ => return Err(self.out_of_range(&given, Word::NoiseGenerator, "1, 2 or 3")),
                };
            }
            _ => match self.inert(token, Place::SETTINGS) {
                Some(outcome) => outcome?,
                None => self.unexpected(token, Place::SETTINGS),
            },
        }
        Ok(())
    }

    /// Reads `max_trace_level 9` outside `global_settings`, as in old files; POV-Ray 3.7 accepts it
    /// (measured).
    pub(super) fn lone_setting(&mut self, token: &Token) -> Outcome<()> {
        let name = self.sources.text(token.span).to_owned();
        let message = format!("`{name}` stands outside of `global_settings`");
        let diagnostic = Diagnostic::new(Code::UnknownWord, message)
            .at(token.span, "it belongs in `global_settings { … }`")
            .help(format!("write `global_settings {{ {name} … }}`"));
        self.opinion(&token.here, diagnostic)?;
        self.setting(token)
    }

    pub(super) fn background(&mut self, token: &Token) -> Outcome<()> {
        let site = token.here.site(token.span);
        let opener = token.clone();
        self.block(token, Word::Background, |evaluator| {
            let given = evaluator.color_after(&opener, "a colour")?;
            evaluator.lint_background(&given);
            let color = given.value;
            while let Some(token) = evaluator.next() {
                evaluator.unexpected(&token, Place::BACKGROUND);
            }
            evaluator.scene.background = Some(Background { color, site });
            Ok(())
        })
    }

    pub(super) fn sky_sphere(&mut self, token: &Token) -> Outcome<Value> {
        let mut sky = SkySphere {
            pigments: Vec::new(),
            transforms: Vec::new(),
            site: token.here.site(token.span),
            items: Vec::new(),
        };
        let outer = self.poison.take();
        let opener = token.clone();
        let outcome = self.block(token, Word::SkySphere, |evaluator| {
            let (mut failed, told) = (false, evaluator.diagnostics.len());
            while let Some(token) = evaluator.next() {
                failed |= evaluator.sky_item(&token, &mut sky) == Err(Reported);
            }
            let is_whole = failed || evaluator.poison.is_some() || !sky.pigments.is_empty();
            // POV-Ray refuses it.
            let refused = !is_whole && evaluator.options.dialect == Dialect::Pov;
            if refused && evaluator.diagnostics.len() == told {
                let message = "this `sky_sphere` has no `pigment`";
                let diagnostic = Diagnostic::new(Code::MissingPart, message)
                    .at(opener.span, "expected `pigment { … }` in it")
                    .help(Word::SkySphere.sentence());
                return Err(evaluator.report(&opener.here, diagnostic));
            }
            if failed { Err(Reported) } else { Ok(()) }
        });
        let poison = std::mem::replace(&mut self.poison, outer);
        if let Some(poison) = poison {
            self.set_poison(poison);
            return Ok(Value::Poison(poison));
        }
        outcome?;
        Ok(Value::SkySphere(Arc::new(sky)))
    }

    fn sky_item(&mut self, token: &Token, sky: &mut SkySphere) -> Outcome<()> {
        if let Some(transform) = self.transform_from(token) {
            sky.transforms.push(transform?);
            return Ok(());
        }
        match token.kind {
            TokenKind::Word(Word::Pigment) => {
                sky.pigments.push(self.pigment(token)?);
                sky.items.push(self.whole(token));
            }
            TokenKind::Expression(id) => match self.declared(token, id) {
                Some(Value::Broken) => return Err(Reported),
                Some(Value::SkySphere(declared)) => {
                    *sky = SkySphere { site: sky.site, ..declared.as_ref().clone() };
                }
                _ => self.unexpected(token, Place::SKY_SPHERE),
            },
            _ => self.unexpected(token, Place::SKY_SPHERE),
        }
        Ok(())
    }

    /// Sets the sky, replacing any earlier one.
    pub(super) fn place_sky(&mut self, sky: SkySphere) {
        self.scene.sky_sphere = Some(sky);
    }
}
