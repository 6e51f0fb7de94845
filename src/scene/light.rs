//! Lights as written.

use super::TransformId;
use crate::color::Rgb;
use crate::math::Vector;
use crate::source::Site;

#[derive(Debug, Clone, PartialEq)]
pub struct LightSource {
    /// Linear intensity; may exceed 1.
    pub color: Rgb,
    /// The source range of the colour, if written.
    pub color_site: Option<Site>,
    pub kind: LightKind,
    /// The transforms before its `point_at`: they move the light, and not the target (measured on POV-Ray
    /// 3.7).
    pub aimed_after: Vec<TransformId>,
    pub shadowless: bool,
    /// `None`: equally bright at any distance.
    pub fade: Option<Fade>,
    /// The last `spotlight` or `cylinder`.
    pub beam_site: Option<Site>,
    /// The last `fade_distance`, with its value.
    pub fade_site: Option<Site>,
    /// The last `media_attenuation`, if it is on.
    pub media_site: Option<Site>,
    /// `false`: `media_attenuation` has no effect.
    pub media_interaction: bool,
}

impl LightSource {
    /// Returns a light of this kind and colour, without other settings.
    pub fn new(kind: LightKind, color: Rgb) -> Self {
        Self {
            color,
            color_site: None,
            kind,
            aimed_after: Vec::new(),
            shadowless: false,
            fade: None,
            beam_site: None,
            fade_site: None,
            media_site: None,
            media_interaction: true,
        }
    }
}

/// Attenuation with the distance d: the colour is multiplied by 2/(1 + (d/distance)^power).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fade {
    /// The distance of the full colour: more than 0. No transform changes it (measured on POV-Ray 3.7).
    pub distance: f64,
    /// More than 0.
    pub power: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub enum LightKind {
    Point {
        location: Vector,
    },
    /// Parallel rays from the plane through `location` toward `point_at`.
    Parallel {
        location: Vector,
        point_at: Vector,
    },
    /// Light from infinitely far away: `to_light` is the direction to it, of any length but zero.
    Direction {
        to_light: Vector,
    },
    /// A cone of light around the line from `location` to `point_at`.
    Spotlight {
        location: Vector,
        point_at: Vector,
        beam: Beam,
    },
    /// Parallel rays, limited to the neighbourhood of the line from `location` through `point_at`.
    Cylinder {
        location: Vector,
        point_at: Vector,
        beam: Beam,
    },
}

/// The falloff of a light around its axis: in degrees for a spotlight; for a cylinder of light in units,
/// which no transform changes (measured on POV-Ray 3.7).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beam {
    /// The edge of the fully bright core.
    pub radius: f64,
    /// The outer edge, where the light ends.
    pub falloff: f64,
    /// How fast the light fades inside the core already.
    pub tightness: f64,
}
