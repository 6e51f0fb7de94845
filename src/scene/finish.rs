//! Finishes as written: how a surface reflects and emits light.

use crate::color::Rgb;
use crate::noise::NoiseGenerator;
use crate::source::Site;
use crate::vocabulary::Word;

/// A finish, by the rules of one of the two dialects.
#[derive(Debug, Clone, PartialEq)]
pub enum Finish {
    /// The native formula (`kd ks phong_exponent`).
    Seed { kd: f64, ks: f64, phong_exponent: f64 },
    /// POV-Ray's finish.
    Classic(ClassicFinish),
}

/// The origin of a finish.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FinishOrigin {
    /// The keyword `finish`.
    pub site: Option<Site>,
    /// The last of each keyword that calls for an effect, with its values, such as `phong 0.4`. For
    /// `diffuse 0.6, 0.3` it is the second number.
    pub words: Vec<(Word, Site)>,
    /// The first native keyword, and the first of POV-Ray's.
    pub seed: Option<(Word, Site)>,
    pub classic: Option<(Word, Site)>,
}

impl FinishOrigin {
    /// Returns the last site of a keyword.
    pub fn of(&self, word: Word) -> Option<Site> {
        self.words.iter().find(|(other, _)| *other == word).map(|(_, site)| *site)
    }

    /// Records a keyword; its earlier site no longer counts.
    pub fn set(&mut self, word: Word, site: Site) {
        self.words.retain(|(other, _)| *other != word);
        self.words.push((word, site));
    }
}

impl Finish {
    /// Returns whether the weight that a keyword sets is more than zero; for `diffuse`, that of light from
    /// behind.
    pub fn has_weight(&self, word: Word) -> bool {
        match (self, word) {
            (Self::Seed { ks, .. }, Word::Ks) => *ks != 0.0,
            (Self::Classic(classic), Word::Phong) => classic.phong > 0.0,
            (Self::Classic(classic), Word::Specular) => classic.specular > 0.0,
            (Self::Classic(classic), Word::Diffuse) => classic.behind > 0.0,
            (Self::Classic(classic), Word::Reflection) => {
                let reflection = classic.reflection.as_ref();
                reflection.is_some_and(|r| r.minimum.gives_light() || r.maximum.gives_light())
            }
            _ => false,
        }
    }
}

/// POV-Ray's finish (manual, section 3.4.7.3 "Finish").
#[derive(Debug, Clone, PartialEq)]
pub struct ClassicFinish {
    pub ambient: Rgb,
    pub emission: Rgb,
    pub diffuse: f64,
    /// `diffuse`, for light on the other side.
    pub behind: f64,
    pub brilliance: f64,
    pub phong: f64,
    pub phong_size: f64,
    pub specular: f64,
    pub roughness: f64,
    /// 0: highlights have the light's colour, 1: the surface's.
    pub metallic: f64,
    pub reflection: Option<Box<Reflection>>,
    /// Reflected light is not transmitted as well.
    pub conserve_energy: bool,
    /// The old form of the interior's index of refraction, which it overrides (measured on POV-Ray 3.7).
    pub ior: Option<f64>,
    /// The old form of the interior's, which it overrides, on another scale (measured on POV-Ray 3.7).
    pub caustics: Option<f64>,
    pub crand: f64,
    pub irid: Option<Box<Irid>>,
    /// The old factor of the light seen through the surface.
    pub refraction: f64,
}

/// The iridescence of a thin film: `irid { amount thickness … turbulence … }`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Irid {
    pub amount: f64,
    pub thickness: f64,
    pub turbulence: f64,
    /// The scene's, for the turbulence.
    pub generator: NoiseGenerator,
}

impl Default for ClassicFinish {
    fn default() -> Self {
        Self {
            ambient: Rgb::gray(0.1),
            emission: Rgb::BLACK,
            diffuse: 0.6,
            behind: 0.0,
            brilliance: 1.0,
            phong: 0.0,
            phong_size: 40.0,
            specular: 0.0,
            roughness: 0.05,
            metallic: 0.0,
            reflection: None,
            conserve_energy: false,
            ior: None,
            caustics: None,
            crand: 0.0,
            irid: None,
            refraction: 1.0,
        }
    }
}

/// A finish's `reflection`.
#[derive(Debug, Clone, PartialEq)]
pub struct Reflection {
    /// At grazing angles if `minimum` was given too, else at all angles.
    pub maximum: Rgb,
    /// At normal incidence.
    pub minimum: Rgb,
    pub falloff: f64,
    /// Varies from minimum to maximum by Fresnel's equations, not by `falloff`.
    pub fresnel: bool,
    pub exponent: f64,
    pub metallic: f64,
}
