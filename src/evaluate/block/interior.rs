//! `interior` and `material`: the medium inside a solid, and its texture with interior.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Interior, InteriorId};
use crate::vocabulary::{Dialect, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::{Material, Value};
use super::super::{Evaluator, Outcome, Reported};
use super::Place;

/// The most rays that one ray is split into by dispersion.
const MOST_SAMPLES: f64 = 65_535.0;

impl Evaluator<'_> {
    /// Reads `interior { [Name] ior … fade_distance … dispersion … }`.
    pub(super) fn interior(&mut self, token: &Token) -> Outcome<InteriorId> {
        let mut interior = Interior::default();
        let interior = self.block(token, Word::Interior, |evaluator| {
            let mut failed = false;
            while let Some(token) = evaluator.next() {
                failed |= evaluator.interior_item(&token, &mut interior) == Err(Reported);
            }
            if failed { Err(Reported) } else { Ok(interior) }
        })?;
        self.scene.interiors.push(interior);
        Ok(InteriorId(self.scene.interiors.len() as u32 - 1))
    }

    fn interior_item(&mut self, token: &Token, interior: &mut Interior) -> Outcome<()> {
        match token.kind {
            TokenKind::Word(Word::Ior) => {
                interior.ior = self.index_of_refraction(token)?;
                interior.is_refractive = true;
                interior.ior_site = Some(self.whole(token));
            }
            TokenKind::Word(Word::FadeDistance) => {
                interior.fade_distance = self.number_after(token, "a number")?.value;
                interior.fade_site = Some(self.whole(token));
            }
            TokenKind::Word(Word::FadePower) => {
                interior.fade_power = self.number_after(token, "a number")?.value;
            }
            TokenKind::Word(Word::FadeColor) => {
                interior.fade_color = self.color_after(token, "a color")?.value.rgb;
            }
            TokenKind::Word(Word::Dispersion) => {
                interior.dispersion = self.number_after(token, "a number")?.value;
                interior.dispersion_site = Some(self.whole(token));
            }
            TokenKind::Word(Word::DispersionSamples) => {
                let given = self.number_after(token, "a number")?;
                self.within_bounds(&given, Word::DispersionSamples);
                if given.value > MOST_SAMPLES {
                    let wanted = format!("{MOST_SAMPLES} or less");
                    let diagnostic = self.outside(&given, Word::DispersionSamples, &wanted);
                    let diagnostic = diagnostic.help("it is read as that; 7 to 100 are usual");
                    self.opinion(&given.here, diagnostic)?;
                }
                interior.dispersion_samples = given.value.clamp(2.0, MOST_SAMPLES) as u32;
            }
            TokenKind::Word(Word::Caustics) => {
                interior.caustics = Some(self.number_after(token, "a number")?.value);
            }
            // POV-Ray 3.7 ignores it (measured).
            TokenKind::Word(Word::Refraction) if self.options.dialect == Dialect::Pov => {
                let given = self.number_after(token, "a number")?;
                let message = "`refraction` has no effect in an `interior`";
                let diagnostic = Diagnostic::new(Code::UnknownWord, message)
                    .at(self.whole(token).span, "leave this out")
                    .help("`ior` alone bends light; it is weakened by `fade_power` and `fade_distance`");
                return self.opinion(&given.here, diagnostic);
            }
            TokenKind::Expression(id) => match self.declared(token, id) {
                Some(Value::Broken) => return Err(Reported),
                Some(Value::Interior(id)) => *interior = self.scene.interiors[id.index()].clone(),
                Some(Value::Poison(poison)) => self.set_poison(poison),
                _ => {
                    self.unexpected(token, Place::INTERIOR);
                    return Err(Reported);
                }
            },
            _ => match self.inert(token, Place::INTERIOR) {
                Some(outcome) => return outcome,
                None => return self.unfit(token, Place::INTERIOR),
            },
        }
        Ok(())
    }

    /// Reads `material { [Name] texture { … } interior_texture { … } interior { … } }`; transforms apply to its
    /// textures.
    pub(super) fn material(&mut self, token: &Token) -> Outcome<Material> {
        let mut material = Material::default();
        self.block(token, Word::Material, |evaluator| {
            let mut failed = false;
            while let Some(token) = evaluator.next() {
                failed |= evaluator.material_item(&token, &mut material) == Err(Reported);
            }
            if failed { Err(Reported) } else { Ok(material) }
        })
    }

    fn material_item(&mut self, token: &Token, material: &mut Material) -> Outcome<()> {
        if let Some(transform) = self.transform_from(token) {
            let transform = transform?;
            for texture in [&mut material.texture, &mut material.interior_texture] {
                if let Some(id) = texture {
                    let mut moved = self.scene.textures[id.index()].clone();
                    moved.transforms.push(transform);
                    *texture = Some(self.add_texture(moved));
                }
            }
            return Ok(());
        }
        match token.kind {
            TokenKind::Word(Word::Texture) => material.texture = Some(self.texture(token)?),
            TokenKind::Word(Word::InteriorTexture) => {
                let texture = self.layers_of(Word::InteriorTexture, token)?;
                material.interior_texture = Some(texture);
            }
            TokenKind::Word(Word::Interior) => material.interior = Some(self.interior(token)?),
            TokenKind::Expression(id) => match self.declared(token, id) {
                Some(Value::Broken) => {
                    self.broken_of_place(token, id, Place::MATERIAL);
                    return Err(Reported);
                }
                Some(Value::Material(named)) => *material = named,
                Some(Value::Poison(poison)) => self.set_poison(poison),
                _ => {
                    self.unexpected(token, Place::MATERIAL);
                    return Err(Reported);
                }
            },
            _ => return self.unfit(token, Place::MATERIAL),
        }
        Ok(())
    }

    /// Handles an item that the block does not accept: a mistake, unless it is inert or belongs to something
    /// unsupported.
    fn unfit(&mut self, token: &Token, place: Place) -> Outcome<()> {
        let poisoned = self.poison.is_some();
        self.unexpected(token, place);
        let harmless = matches!(token.kind, TokenKind::Comma | TokenKind::Semicolon);
        if harmless || poisoned || self.poison.is_some() { Ok(()) } else { Err(Reported) }
    }
}
