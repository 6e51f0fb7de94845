//! Lights as they were written.

use super::TransformId;
use crate::color::Rgb;
use crate::math::Vector;
use crate::source::Site;
use crate::vocabulary::Word;

#[derive(Debug, Clone, PartialEq)]
pub struct LightSource {
    /// Linear intensity; may exceed 1.
    pub color: Rgb,
    /// All of that, where it is written.
    pub color_site: Option<Site>,
    pub kind: LightKind,
    /// The transforms that stand before its `point_at`: they move the light, and not what it points at
    /// (measured on POV-Ray 3.7).
    pub aimed_after: Vec<TransformId>,
    pub shadowless: bool,
    /// `None`: as bright at any distance.
    pub fade: Option<Fade>,
    /// Parts of its colour without which it is black; none where it takes all of the light.
    pub color_sites: Vec<Site>,
    /// Each word that makes a beam of it (`spotlight`, `cylinder`), as a piece that can be taken out of the
    /// text.
    pub beam_sites: Vec<(Word, Site)>,
    /// Each `fade_distance`, without which it does not fade, likewise.
    pub fade_sites: Vec<Site>,
}

impl LightSource {
    /// Without further words.
    pub fn new(kind: LightKind, color: Rgb) -> Self {
        let (color_sites, beam_sites, fade_sites) = (Vec::new(), Vec::new(), Vec::new());
        let (shadowless, fade, color_site, aimed_after) = (false, None, None, Vec::new());
        Self {
            color,
            color_site,
            kind,
            aimed_after,
            shadowless,
            fade,
            color_sites,
            beam_sites,
            fade_sites,
        }
    }
}

/// How light loses strength with the distance d: it is 2/(1 + (d/distance)^power) of its colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fade {
    /// Where it is all of its colour: more than 0. No transform changes it (measured on POV-Ray 3.7).
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
    /// Light from infinitely far: `to_light` points to it, any length but zero.
    Direction {
        to_light: Vector,
    },
    /// A cone of light around the line from `location` to `point_at`.
    Spotlight {
        location: Vector,
        point_at: Vector,
        beam: Beam,
    },
    /// Parallel rays, only near the line from `location` through `point_at`.
    Cylinder {
        location: Vector,
        point_at: Vector,
        beam: Beam,
    },
}

/// How a light falls off around its axis: in degrees for a spotlight, in units, which no transform
/// changes (measured on POV-Ray 3.7), for a cylinder of light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beam {
    /// The bright middle.
    pub radius: f64,
    /// The edge, where it is dark.
    pub falloff: f64,
    /// How fast it fades already in the middle.
    pub tightness: f64,
}
