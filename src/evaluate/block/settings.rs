//! Settings of the whole scene: `global_settings`, `background` and `sky_sphere`.

use std::sync::Arc;

use crate::color::{Gamma, Rgb};
use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Background, Dialect, SkySphere, TransformId};
use crate::source::Site;
use crate::vocabulary::Word;

use super::super::stream::Token;
use super::super::value::Value;
use super::super::{Evaluator, Outcome};
use super::Place;
use super::parts::{Block, Part, Parts};
use super::range::Range;

/// The maximum `max_trace_level` that POV-Ray uses; it warns of more.
const DEEPEST: f64 = 256.0;

/// The maximum `max_trace_level` here.
const MOST_LEVELS: f64 = 1_000_000.0;

/// The block of settings, which go straight into the scene: directives between them change others.
struct GlobalSettings;

impl Block for GlobalSettings {
    const PLACE: Place = Place::SETTINGS;
    const PARTS: Parts<Self> = &[
        Part::Special(Word::AmbientLight, |evaluator, token, _| {
            let light = evaluator.color_after(token, "a number or a colour")?.value.rgb;
            evaluator.scene.settings.ambient_light = light;
            Ok(())
        }),
        Part::Special(Word::IridWavelength, |evaluator, token, _| {
            let wavelengths = evaluator.color_after(token, "a colour")?.value.rgb;
            evaluator.scene.settings.irid_wavelength = wavelengths;
            Ok(())
        }),
        Part::Special(Word::AssumedGamma, |evaluator, token, _| evaluator.assumed_gamma(token)),
        Part::Special(Word::MaxTraceLevel, |evaluator, token, _| evaluator.max_trace_level(token)),
        Part::Special(Word::AdcBailout, |evaluator, token, _| {
            let bailout = evaluator.number_in(token, Word::AdcBailout, &Range::ZERO_IF_NEGATIVE)?;
            evaluator.scene.settings.adc_bailout = bailout;
            Ok(())
        }),
        Part::Special(Word::NumberOfWaves, |evaluator, token, _| {
            let given = evaluator.number_after(token, "a number of waves")?;
            evaluator.waves = if given.value >= 1.0 { given.value as usize } else { 1 };
            Ok(())
        }),
        Part::Special(Word::NoiseGenerator, |evaluator, token, _| {
            evaluator.says_noise = true;
            evaluator.noise = evaluator.noise_generator_after(token)?;
            Ok(())
        }),
    ];
}

impl Block for SkySphere {
    const PLACE: Place = Place::SKY_SPHERE;
    const PARTS: Parts<Self> = &[
        Part::Special(Word::Pigment, |evaluator, token, sky| {
            sky.pigments.push(evaluator.pigment(token)?);
            sky.items.push(evaluator.whole(token));
            Ok(())
        }),
        Part::Color(Word::Emission, "a number or a colour", |sky, light, _| sky.emission = light),
    ];

    fn inherit(&mut self, _: &Evaluator, value: &Value) -> bool {
        let Value::SkySphere(sky) = value else { return false };
        *self = Self { site: self.site, ..sky.as_ref().clone() };
        true
    }

    fn transform(&mut self, _: &mut Evaluator, transform: TransformId, _: Site) {
        self.transforms.push(transform);
    }
}

impl Evaluator<'_> {
    pub(super) fn global_settings(&mut self, token: &Token) -> Outcome<()> {
        self.block(token, Word::GlobalSettings, |evaluator| evaluator.parts(&mut GlobalSettings))
    }

    fn assumed_gamma(&mut self, token: &Token) -> Outcome<()> {
        let gamma = self.gamma_after(token, Word::AssumedGamma)?;
        // If repeated, the first counts, as in POV-Ray.
        if std::mem::replace(&mut self.says_gamma, true) {
            return Ok(());
        }
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
        Ok(())
    }

    fn max_trace_level(&mut self, token: &Token) -> Outcome<()> {
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
        self.part(token, &mut GlobalSettings)
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
            emission: Rgb::WHITE,
            site: token.here.site(token.span),
            items: Vec::new(),
        };
        self.value_or_poison(|evaluator| {
            evaluator.block(token, Word::SkySphere, |evaluator| {
                let told = evaluator.diagnostics.len();
                evaluator.parts(&mut sky)?;
                let is_whole = evaluator.poison.is_some() || !sky.pigments.is_empty();
                // POV-Ray refuses it.
                let refused = !is_whole && evaluator.options.dialect == Dialect::Pov;
                if refused && evaluator.diagnostics.len() == told {
                    let message = "this `sky_sphere` has no `pigment`";
                    let diagnostic = Diagnostic::new(Code::MissingPart, message)
                        .at(token.span, "expected `pigment { … }` in it")
                        .help(Word::SkySphere.sentence());
                    return Err(evaluator.report(&token.here, diagnostic));
                }
                Ok(())
            })?;
            Ok(Value::SkySphere(Arc::new(sky)))
        })
    }

    /// Sets the sky, replacing any earlier one.
    pub(super) fn place_sky(&mut self, sky: SkySphere) {
        self.scene.sky_sphere = Some(sky);
    }
}
