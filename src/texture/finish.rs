//! Finishes: how a surface reflects and emits light.

use crate::color::Rgb;
use crate::noise::NoiseGenerator;

/// The reflection and emission of a surface. Components of weight zero are absent.
///
/// The radiance toward the viewer is, with C the pigment's colour, f and t its filter and
/// transmit, and the sum over the lights that are visible:
/// `(1 − f − t)·C·(emission + Σ I·diffuse·(N·L)^brilliance) + Σ I·Σ lobes + reflection +
/// (f·C + t)·what is seen through it`; see [`crate::color::Clearness`] for the first factor in old scenes.
#[derive(Debug, Clone, PartialEq)]
pub struct Finish {
    /// Light without a light source: `ambient · ambient_light + emission`, or the seed's kd·Ia.
    pub emission: Rgb,
    pub diffuse: f64,
    pub brilliance: f64,
    pub lobes: Vec<Lobe>,
    pub reflection: Option<Reflection>,
    /// The transmitted light is reduced by the reflected; set only if there are both.
    pub conserve_energy: bool,
    /// The native rules: every radiance is clamped at 1 per component, and the surface is visible from
    /// outside only. Its one lobe is `Blinn` with the pigment's colour, unweighted by angle.
    pub seed: bool,
    /// `None` if all are neutral.
    pub extras: Option<Box<Extras>>,
}

/// The properties that few finishes have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extras {
    /// The diffuse reflection of light that falls on the side away from the viewer. That light makes no
    /// highlights. 0: none.
    pub behind: f64,
    /// `crand`: the most by which each light's diffuse reflection is darkened at random. 0: none.
    pub grain: f64,
    pub irid: Option<Irid>,
    /// The old `refraction`: the factor of the light seen through the surface. 1: all of it.
    pub passed: f64,
}

/// The iridescence of a thin film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Irid {
    /// More than 0.
    pub amount: f64,
    pub thickness: f64,
    /// The variation of the thickness from point to point.
    pub turbulence: f64,
    /// Of red, green and blue light.
    pub wavelengths: Rgb,
    /// Of the turbulence; the default if there is none.
    pub generator: NoiseGenerator,
}

impl Extras {
    pub const NEUTRAL: Self = Self { behind: 0.0, grain: 0.0, irid: None, passed: 1.0 };

    /// Returns them as a finish has them.
    pub fn kept(self) -> Option<Box<Self>> {
        (self != Self::NEUTRAL).then(|| Box::new(self))
    }
}

/// A specular lobe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lobe {
    pub kind: LobeKind,
    pub weight: f64,
    pub exponent: f64,
    /// 0: the light's colour; 1: the pigment's.
    pub metallic: f64,
}

/// Formula of a [`Lobe`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LobeKind {
    /// (R·L)^exponent, where R is the mirrored view direction.
    Phong,
    /// (N·H)^exponent, where H bisects the directions to the light and to the viewer.
    Blinn,
}

/// What a finish mirrors, by the angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reflection {
    /// At normal incidence; equal to `maximum` where the angle does not matter.
    pub minimum: Rgb,
    /// At grazing incidence.
    pub maximum: Rgb,
    pub falloff: f64,
    /// Varies from minimum to maximum by Fresnel's equations, with the indices of refraction on both sides;
    /// `falloff` is then 1.
    pub fresnel: bool,
    pub exponent: f64,
    pub metallic: f64,
}
