//! Lights as written.

use super::{ObjectId, TransformId};
use crate::color::Rgb;
use crate::math::Vector;
use crate::source::Site;

/// A `light_source`.
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
    pub area: Area,
    pub looks_like: Option<LooksLike>,
    pub projected_through: Option<ProjectedThrough>,
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
            area: Area::default(),
            looks_like: None,
            projected_through: None,
            beam_site: None,
            fade_site: None,
            media_site: None,
            media_interaction: true,
        }
    }
}

/// The object that is seen where a light is. It casts no shadow.
#[derive(Debug, Clone, PartialEq)]
pub struct LooksLike {
    /// Around the origin, which comes to the light's location.
    pub object: ObjectId,
    /// The transforms before it: they move the location, and do not change the object (measured on POV-Ray 3.7).
    pub after: Vec<TransformId>,
}

/// The object that a light shines through: only where a ray to the light meets it, it shines.
#[derive(Debug, Clone, PartialEq)]
pub struct ProjectedThrough {
    pub object: ObjectId,
    /// The transforms before it: they move the light, and not the object (measured on POV-Ray 3.7).
    pub after: Vec<TransformId>,
    /// The word, with its block.
    pub site: Site,
}

/// A grid of lights instead of one.
#[derive(Debug, Clone, PartialEq)]
pub struct Area {
    /// From one edge of the grid to the other.
    pub sides: [Vector; 2],
    /// The numbers of lights along the sides: at least 1; both 1 if there is no `area_light`.
    pub nodes: [u32; 2],
    /// The transforms before its `area_light`: they move the light, and do not change the sides (measured on POV-Ray
    /// 3.7).
    pub sides_after: Vec<TransformId>,
    /// `None`: every light casts shadows of its own.
    pub adaptive: Option<u32>,
    pub jitter: bool,
    pub circular: bool,
    pub orient: bool,
    /// `area_illumination`: not only shadows come from all lights.
    pub illuminates: bool,
    /// The last `area_light`, with its values.
    pub site: Option<Site>,
}

impl Default for Area {
    fn default() -> Self {
        Self {
            sides: [Vector::ZERO; 2],
            nodes: [1; 2],
            sides_after: Vec::new(),
            adaptive: None,
            jitter: false,
            circular: false,
            orient: false,
            illuminates: false,
            site: None,
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

impl LightKind {
    /// Returns where the light is; `None` for one at infinity.
    pub fn location(&self) -> Option<Vector> {
        match *self {
            Self::Point { location }
            | Self::Parallel { location, .. }
            | Self::Spotlight { location, .. }
            | Self::Cylinder { location, .. } => Some(location),
            Self::Direction { .. } => None,
        }
    }
}

/// Kind of a [`LightSource`].
#[derive(Debug, Clone, PartialEq)]
pub enum LightKind {
    Point {
        location: Vector,
    },
    /// Parallel rays from the plane through `location` toward `point_at`. One with a `beam` is also a spotlight,
    /// and shines in front of its plane only.
    Parallel {
        location: Vector,
        point_at: Vector,
        beam: Option<Beam>,
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
