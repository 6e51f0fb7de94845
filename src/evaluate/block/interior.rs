//! `interior` and `material`: the medium inside a solid, and its texture with interior.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Interior, InteriorId, TransformId};
use crate::source::Site;
use crate::vocabulary::{Dialect, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::{Material, Value};
use super::super::{Evaluator, Outcome};
use super::Place;
use super::parts::{Block, Part, Parts};

/// The most rays that one ray is split into by dispersion.
const MOST_SAMPLES: f64 = 65_535.0;

impl Block for Interior {
    const PLACE: Place = Place::INTERIOR;
    const PARTS: Parts<Self> = &[
        Part::Special(Word::Ior, |evaluator, token, interior| {
            interior.ior = evaluator.index_of_refraction(token)?;
            interior.is_refractive = true;
            interior.ior_site = Some(evaluator.whole(token));
            Ok(())
        }),
        Part::Number(Word::FadeDistance, |interior, number, site| {
            (interior.fade_distance, interior.fade_site) = (number, Some(site));
        }),
        Part::Number(Word::FadePower, |interior, number, _| interior.fade_power = number),
        Part::Color(Word::FadeColor, "a colour", |interior, color, _| interior.fade_color = color),
        Part::Number(Word::Dispersion, |interior, number, site| {
            (interior.dispersion, interior.dispersion_site) = (number, Some(site));
        }),
        Part::Special(Word::DispersionSamples, |evaluator, token, interior| {
            evaluator.dispersion_samples(token, interior)
        }),
        Part::Number(Word::Caustics, |interior, number, _| interior.caustics = Some(number)),
    ];

    fn inherit(&mut self, evaluator: &Evaluator, value: &Value) -> bool {
        let Value::Interior(id) = value else { return false };
        self.clone_from(&evaluator.scene.interiors[id.index()]);
        true
    }

    fn other(&mut self, evaluator: &mut Evaluator, token: &Token) -> Option<Outcome<()>> {
        evaluator.refraction(token)
    }
}

impl Block for Material {
    const PLACE: Place = Place::MATERIAL;
    const PARTS: Parts<Self> = &[
        Part::Special(Word::Texture, |evaluator, token, material| {
            evaluator.texture(token).map(|texture| material.texture = Some(texture))
        }),
        Part::Special(Word::InteriorTexture, |evaluator, token, material| {
            let texture = evaluator.layers_of(Word::InteriorTexture, token)?;
            material.interior_texture = Some(texture);
            Ok(())
        }),
        Part::Special(Word::Interior, |evaluator, token, material| {
            evaluator.interior(token).map(|interior| material.interior = Some(interior))
        }),
    ];

    fn inherit(&mut self, _: &Evaluator, value: &Value) -> bool {
        let Value::Material(material) = value else { return false };
        *self = *material;
        true
    }

    /// Moves the textures.
    fn transform(&mut self, evaluator: &mut Evaluator, transform: TransformId, _: Site) {
        for id in [&mut self.texture, &mut self.interior_texture].into_iter().flatten() {
            let mut moved = evaluator.scene.textures[id.index()].clone();
            moved.transforms.push(transform);
            *id = evaluator.add_texture(moved);
        }
    }
}

impl Evaluator<'_> {
    /// Reads `interior { [Name] ior … fade_distance … dispersion … }`.
    pub(super) fn interior(&mut self, token: &Token) -> Outcome<InteriorId> {
        let mut interior = Interior::default();
        self.block(token, Word::Interior, |evaluator| evaluator.parts(&mut interior))?;
        self.scene.interiors.push(interior);
        Ok(InteriorId(self.scene.interiors.len() as u32 - 1))
    }

    /// Reads `material { [Name] texture { … } interior_texture { … } interior { … } }`.
    pub(super) fn material(&mut self, token: &Token) -> Outcome<Material> {
        let mut material = Material::default();
        self.block(token, Word::Material, |evaluator| evaluator.parts(&mut material))?;
        Ok(material)
    }

    fn dispersion_samples(&mut self, token: &Token, interior: &mut Interior) -> Outcome<()> {
        let given = self.number_after(token, "a number")?;
        self.within_bounds(&given, Word::DispersionSamples);
        if given.value > MOST_SAMPLES {
            let wanted = format!("{MOST_SAMPLES} or less");
            let diagnostic = self.outside(&given, Word::DispersionSamples, &wanted);
            let diagnostic = diagnostic.help("it is read as that; 7 to 100 are usual");
            self.opinion(&given.here, diagnostic)?;
        }
        interior.dispersion_samples = given.value.clamp(2.0, MOST_SAMPLES) as u32;
        Ok(())
    }

    /// Reads `refraction`, which POV-Ray 3.7 ignores (measured).
    fn refraction(&mut self, token: &Token) -> Option<Outcome<()>> {
        if token.kind != TokenKind::Word(Word::Refraction) || self.options.dialect == Dialect::Scene
        {
            return None;
        }
        let message = "`refraction` has no effect in an `interior`";
        Some(self.number_after(token, "a number").and_then(|given| {
            let diagnostic = Diagnostic::new(Code::UnknownWord, message)
                .at(self.whole(token).span, "leave this out")
                .help(
                    "`ior` alone bends light; it is weakened by `fade_power` and `fade_distance`",
                );
            self.opinion(&given.here, diagnostic)
        }))
    }
}
