//! `fog` as written: haze that covers what is far away.

use super::TransformId;
use crate::color::Color;
use crate::math::Vector;
use crate::noise::NoiseGenerator;
use crate::source::Site;

/// A `fog`, with POV-Ray's defaults for what is not written.
#[derive(Debug, Clone, PartialEq)]
pub struct Fog {
    pub color: Color,
    /// The distance after which 1/e of the light is left; 0: the fog is off.
    pub distance: f64,
    /// `fog_type 2`: it thins with the height.
    pub is_ground: bool,
    /// Below this height ground fog is uniform.
    pub offset: f64,
    /// The height above `offset` at which ground fog is half as dense.
    pub alt: f64,
    /// The direction of heights, of any length, before `transforms`.
    pub up: Vector,
    /// Those written after the last `up`.
    pub transforms: Vec<TransformId>,
    /// Set by any of `turbulence`, `octaves`, `lambda` and `omega`.
    pub turbulence: Option<FogTurbulence>,
    /// How much the turbulence thins the fog.
    pub turb_depth: f64,
    pub noise: NoiseGenerator,
    /// The keyword.
    pub site: Site,
    /// The whole block, where it is placed.
    pub item: Site,
}

/// The turbulence of a fog.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FogTurbulence {
    /// Scales the points at which the noise is evaluated.
    pub scale: Vector,
    pub octaves: f64,
    pub lambda: f64,
    pub omega: f64,
}

impl Default for FogTurbulence {
    fn default() -> Self {
        Self { scale: Vector::ZERO, octaves: 6.0, lambda: 2.0, omega: 0.5 }
    }
}

impl Fog {
    /// Returns a fog without any items.
    pub fn new(site: Site, noise: NoiseGenerator) -> Self {
        Self {
            color: Color::BLACK,
            distance: 0.0,
            is_ground: false,
            offset: 0.0,
            alt: 0.0,
            up: Vector::Y,
            transforms: Vec::new(),
            turbulence: None,
            turb_depth: 0.5,
            noise,
            site,
            item: site,
        }
    }
}
