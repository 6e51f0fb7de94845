//! Fog in canonical form: what it adds to a ray, and where it is dense.

use crate::color::Rgb;
use crate::math::{UnitVector, Vector};
use crate::noise::{NoiseGenerator, Turbulence};

/// A fog. A ray of length d through it lets the part T = max(e^(−τ), `least`) through, where τ = d/`distance`
/// times the mean density: what is behind is multiplied by T·`tint`, and (1 − T)·`color` is added.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fog {
    pub color: Rgb,
    /// Tints the light that comes through: 1 − filter + filter·color.
    pub tint: Rgb,
    /// The part of light that comes through however long the way is; not negative.
    pub least: f64,
    /// The way after which 1/e of the light is left where the density is 1; not 0. If negative, the fog
    /// brightens what is behind it.
    pub distance: f64,
    /// `None`: the density is 1 everywhere.
    pub ground: Option<Ground>,
    /// `None`: still.
    pub churn: Option<Churn>,
}

/// Density by height: with h the component along `up` and u = (h − `offset`)/`alt`, the density is 1 where
/// u ≤ 0, and 1/(1 + u²) elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ground {
    pub up: UnitVector,
    pub offset: f64,
    /// Not 0; of `Ground::SHARP` the density is 0 above `offset`. If negative, the fog is dense above
    /// `offset`.
    pub alt: f64,
}

impl Ground {
    /// The least size of `alt`: a fog with a sharp edge.
    pub const SHARP: f64 = 1e-60;
}

/// Turbulence: multiplies τ by 1 − e^(−d/`distance`)·min(`depth`·N, 1), where N is the noise at the middle of
/// the ray, each coordinate multiplied by that of `scale`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Churn {
    pub scale: Vector,
    /// Not 0.
    pub depth: f64,
    pub turbulence: Turbulence,
    pub noise: NoiseGenerator,
}
