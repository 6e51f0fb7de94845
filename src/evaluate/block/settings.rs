//! `global_settings`, `background` and `sky_sphere`.

use crate::color::Gamma;
use crate::scene::{Background, SkySphere};
use crate::vocabulary::Word;

use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};
use super::Place;
use super::finish::list_once;

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
            TokenKind::Word(Word::AssumedGamma) => {
                let gamma = match self.take_word(Word::Srgb) {
                    Some(_) => Gamma::Srgb,
                    None => Gamma::Power(self.more_than_zero(token, Word::AssumedGamma)?),
                };
                // Said twice, the first counts, as in POV-Ray.
                if !std::mem::replace(&mut self.says_gamma, true) {
                    self.scene.settings.assumed_gamma = gamma;
                }
            }
            TokenKind::Word(Word::MaxTraceLevel) => {
                let given = self.number_after(token, "a whole number")?;
                if !(1.0..=1_000_000.0).contains(&given.value) || given.value.fract() != 0.0 {
                    return Err(self.out_of_range(
                        &given,
                        Word::MaxTraceLevel,
                        "a whole number from 1 to 1000000",
                    ));
                }
                self.scene.settings.max_trace_level = given.value as u32;
                self.scene.settings.max_trace_level_site = Some(given.site());
            }
            TokenKind::Word(Word::AdcBailout) => {
                self.scene.settings.adc_bailout = self.at_least_zero(token, Word::AdcBailout)?;
            }
            _ => self.unexpected(token, Place::SETTINGS),
        }
        Ok(())
    }

    pub(super) fn background(&mut self, token: &Token) -> Outcome<()> {
        let site = token.here.site(token.span);
        let opener = token.clone();
        self.block(token, Word::Background, |evaluator| {
            let color = evaluator.color_after(&opener, "a colour")?.value;
            while let Some(token) = evaluator.next() {
                evaluator.unexpected(&token, Place::BACKGROUND);
            }
            evaluator.scene.background = Some(Background { color, site });
            Ok(())
        })
    }

    pub(super) fn sky_sphere(&mut self, token: &Token) -> Outcome<()> {
        let mut sky = SkySphere {
            pigments: Vec::new(),
            transforms: Vec::new(),
            site: token.here.site(token.span),
            items: Vec::new(),
        };
        self.block(token, Word::SkySphere, |evaluator| {
            let mut failed = false;
            while let Some(token) = evaluator.next() {
                if let Some(transform) = evaluator.transform_from(&token) {
                    match transform {
                        Ok(id) => sky.transforms.push(id),
                        Err(Reported) => failed = true,
                    }
                    continue;
                }
                match token.kind {
                    TokenKind::Word(Word::Pigment) => match evaluator.pigment(&token) {
                        Ok(pigment) => sky.pigments.push(pigment),
                        Err(Reported) => failed = true,
                    },
                    _ => evaluator.unexpected(&token, Place::SKY_SPHERE),
                }
            }
            if failed { Err(Reported) } else { Ok(()) }
        })?;
        sky.items = self.scene.sky_sphere.take().map_or(Vec::new(), |replaced| replaced.items);
        list_once(&mut sky.items, self.whole(token));
        self.scene.sky_sphere = Some(sky);
        Ok(())
    }
}
