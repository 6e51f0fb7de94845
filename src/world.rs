//! What is there, in canonical form: what the tracer is handed.
//!
//! **Invariant:** no transform list, no degree, no missing default, no nested union; every placement
//! invertible; every number finite. One flat list per kind; an object is (kind, index, material).
//! Specified in `docs/world.md`.

pub mod pigment;
pub mod print;
mod solid;

use std::sync::Arc;

use crate::color::{Clearness, Color, Gamma, Rgb};
use crate::math::placement::Map;
use crate::math::{UnitVector, Vector};
use crate::pattern::Pattern;
use crate::shape::csg::Node;
use crate::shape::{Box_, Ellipsoid, Placed, Plane, Shape, Sphere};
use crate::source::{Expansions, Site, Span};

#[derive(Debug, Clone, PartialEq, Default)]
pub struct World {
    pub camera: Camera,
    pub settings: Settings,
    /// What a ray that leaves the scene sees where the sky shows nothing.
    pub background: Rgb,
    pub sky: Option<Sky>,
    pub lights: Vec<Light>,
    /// In written order.
    pub objects: Vec<Object>,
    pub spheres: Vec<Sphere>,
    pub planes: Vec<Plane>,
    pub boxes: Vec<Box_>,
    pub ellipsoids: Vec<Ellipsoid>,
    /// Whatever else there is, each where it stands; bodies are shared.
    pub placed: Vec<Placed>,
    /// Solids made of others.
    pub wholes: Vec<Whole>,
    pub materials: Vec<Material>,
    /// What solids are filled with; `Object::interior` points here. Empty when nothing bends light.
    pub interiors: Vec<Interior>,
    /// Where textures stand; `Object::texture_from_world` points here.
    pub texture_maps: Vec<Map>,
    /// Texture coordinates that are the same all over a flat face; see `Object::faces`.
    pub faces: Vec<FaceCoordinates>,
}

/// A solid made of others.
#[derive(Debug, Clone, PartialEq)]
pub struct Whole {
    /// In postfix order.
    pub nodes: Vec<Node>,
    /// Its leaves are the objects from here on, in the order of the nodes.
    pub first: u32,
    pub count: u32,
}

impl Whole {
    /// The places of its leaves in `World::objects`.
    pub fn leaves(&self) -> std::ops::Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// Where the World's parts came from, a list for each of its lists. Never compared.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Origins {
    pub objects: Vec<Site>,
    /// What makes the wholes, as it is written: several may make one.
    pub operations: Vec<OperationOrigin>,
    /// All of each, as a piece that can be taken out of the text.
    pub lights: Vec<Site>,
    /// What has to be taken out for each not to shine: mostly all of it.
    pub light_pieces: Vec<Vec<Site>>,
    /// Each word that makes a light less than its colour somewhere, likewise.
    pub attenuation: Vec<Site>,
    pub materials: Vec<MaterialOrigin>,
    /// What called for each interior, likewise.
    pub interiors: Vec<Vec<Site>>,
    /// Each `no_image` and `no_reflection` that holds for a solid, likewise.
    pub hidden: Vec<Site>,
    /// Each `double_illuminate`, likewise.
    pub double_illuminate: Vec<Site>,
    pub camera: Option<Site>,
    pub sky: Option<SkyOrigin>,
    pub max_trace_level: Option<Site>,
    /// What lowering left out, and why.
    pub dropped: Vec<Dropped>,
    /// Transforms that nearly flatten space, in text order.
    pub near_singular: Vec<NearSingular>,
    /// Parts of one solid whose surfaces coincide, where they were looked for; each two places once.
    pub coinciding: Vec<Coinciding>,
    pub expansions: Expansions,
}

/// Where a material's parts were written. Each site of a list is a piece that can be taken out of
/// the text, such as `phong 0.4`; without all of them the material has no such part.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MaterialOrigin {
    /// The word `pigment` that called for it first; `None` for a default.
    pub pigment: Option<Site>,
    /// The word `finish`, likewise.
    pub finish: Option<Site>,
    pub pattern: Vec<Site>,
    pub highlights: Vec<Site>,
    pub reflection: Vec<Site>,
    /// Of colours that let light through.
    pub clear: Vec<Site>,
    /// Of those on objects that cast shadows.
    pub filter: Vec<Site>,
}

/// An operation that makes one solid of others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OperationOrigin {
    /// `difference`, `clipped_by`.
    pub word: &'static str,
    pub site: Site,
}

/// Where the sky was written.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyOrigin {
    /// The word `sky_sphere`.
    pub site: Site,
    /// All of each pigment.
    pub items: Vec<Site>,
    /// As of a material.
    pub pattern: Vec<Site>,
}

/// A part of the Scene that cannot change the picture, and so is not in the World.
#[derive(Debug, Clone, PartialEq)]
pub struct Dropped {
    pub site: Site,
    /// `light_source`, `reflection`.
    pub what: String,
    /// `its colour is black`.
    pub why: String,
    /// Of what stands in a macro the calls that made it, each place once.
    pub calls: Vec<Span>,
}

/// A map that costs more than half of the digits of what goes through it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearSingular {
    /// All of the transform; of the object, where only its transforms together are so.
    pub site: Site,
    /// The largest factor by which it stretches a direction over the smallest: 2²⁶ or more.
    pub condition: f64,
}

/// Two parts of one solid that have a face, or a part of one, in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coinciding {
    /// `box`, `cylinder`.
    pub words: [&'static str; 2],
    /// The first declared first.
    pub sites: [Site; 2],
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Object {
    pub shape: Shape,
    /// Index into `World::materials`.
    pub material: u32,
    /// Index into `World::texture_maps`; `None` is the identity, or a material without pattern.
    pub texture_from_world: Option<u32>,
    /// For a patterned plane (1 entry) or box (6 entries, in the order of
    /// [`crate::shape::SurfacePoint::face`]): where its entries start in `World::faces`.
    pub faces: Option<u32>,
    /// Index into `World::interiors`; `None` is filled with air.
    pub interior: Option<u32>,
    pub casts_shadow: bool,
    /// Rays that come from the camera, straight or through others, meet it.
    pub in_image: bool,
    /// Rays that have been mirrored meet it.
    pub in_reflections: bool,
    /// Light on one side of the surface lights the other, too.
    pub double_illuminate: bool,
    /// Inside and outside are exchanged.
    pub inverse: bool,
    /// Index into `World::wholes`: it is a part of that, and nothing by itself.
    pub whole: Option<u32>,
}

impl Object {
    /// Rays can meet it in 32 bits.
    pub fn has_single_kernel(&self) -> bool {
        match self.shape {
            Shape::Sphere(_) | Shape::Plane(_) | Shape::Box(_) => self.whole.is_none(),
            Shape::Ellipsoid(_) | Shape::Placed(_) => false,
        }
    }

    /// A shape of which nothing else is said: the first material, filled with air.
    pub fn plain(shape: Shape) -> Self {
        Self {
            shape,
            material: 0,
            texture_from_world: None,
            faces: None,
            interior: None,
            casts_shadow: true,
            in_image: true,
            in_reflections: true,
            double_illuminate: false,
            inverse: false,
            whole: None,
        }
    }
}

/// What a solid is filled with. It only matters where light goes into it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interior {
    /// Index of refraction, > 0; that of the air is 1.
    pub ior: f64,
}

/// For one flat face: each texture coordinate that is constant over it, computed in extended
/// precision. The tracer uses these numbers, so a pattern never flickers on its own lattice.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FaceCoordinates(pub [Option<f64>; 3]);

#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    pub pigment: Pigment,
    pub finish: Finish,
}

#[derive(Debug, Clone, PartialEq)]
pub enum Pigment {
    Color(Color),
    Patterned {
        pattern: Pattern,
        /// The pattern's space from the texture's.
        pattern_from_texture: Map,
        /// Sorted by value; at least one entry.
        map: Vec<(f64, Color)>,
    },
    /// The colours of a mesh's faces, by their corners: `shape::mesh::Skin::paint`. At least two.
    Faces(Arc<[Color]>),
}

impl Pigment {
    /// Its colours, without their places.
    pub fn colors(&self) -> impl Iterator<Item = Color> {
        let (some, map) = match self {
            Self::Color(color) => (std::slice::from_ref(color), &[][..]),
            Self::Patterned { map, .. } => (&[][..], map.as_slice()),
            Self::Faces(colors) => (&colors[..], &[][..]),
        };
        some.iter().copied().chain(map.iter().map(|(_, color)| *color))
    }

    /// Whether light goes through in any place.
    pub fn is_clear(&self) -> bool {
        self.colors().any(Color::is_clear)
    }
}

/// How a surface answers light. Everything of weight zero is absent.
///
/// The radiance toward the viewer is, with C the pigment's colour, f and t its filter and
/// transmit, and the sum over the lights that are visible:
/// `(1 − f − t)·C·(glow + Σ I·diffuse·(N·L)^brilliance) + Σ I·Σ lobes + reflection +
/// (f·C + t)·what is seen through it`; see [`Clearness`] for the first factor in old scenes.
#[derive(Debug, Clone, PartialEq)]
pub struct Finish {
    /// Light without a light source: `ambient · ambient_light + emission`, or the seed's kd·Ia.
    pub glow: Rgb,
    pub diffuse: f64,
    pub brilliance: f64,
    pub lobes: Vec<Lobe>,
    pub reflection: Option<Reflection>,
    /// What is let through is less by what is reflected; only where both are.
    pub conserve_energy: bool,
    /// The seed's rules: every radiance is clamped at 1 per component, and the surface is seen from
    /// outside only. Its one lobe is `Blinn` with the pigment's colour, unweighted by angle.
    pub seed: bool,
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

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LobeKind {
    /// (R·L)^exponent, R the mirrored direction of view.
    Phong,
    /// (N·H)^exponent, H the bisector of the directions to the light and to the viewer.
    Blinn,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reflection {
    /// Seen head-on; equal to `maximum` where the angle does not matter.
    pub minimum: Rgb,
    /// Seen at a grazing angle.
    pub maximum: Rgb,
    pub falloff: f64,
    /// From minimum to maximum as Fresnel's equations have it, by the indices of refraction on
    /// both sides; `falloff` is then 1.
    pub fresnel: bool,
    pub exponent: f64,
    pub metallic: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    pub kind: LightKind,
    pub color: Rgb,
    pub casts_shadows: bool,
    /// `None`: it shines everywhere in its colour.
    pub attenuation: Option<Attenuation>,
}

/// Where a light is less than its colour: the product of both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attenuation {
    pub beam: Option<Beam>,
    pub fade: Option<Fade>,
}

/// With s(a, b; v) = t²(3 − 2t), t = (v − a)/(b − a) kept within 0 … 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Beam {
    /// Of a point light: c^tightness · s(edge, core; c), c the cosine of the angle between `axis` and
    /// the light's way; 0 where c ≤ 0.
    Cone { axis: UnitVector, edge: f64, core: f64, tightness: f64 },
    /// Of a parallel light, before its plane: d^tightness · s(0, core; d), d = 1 − r/radius, r the
    /// distance from its axis; 0 where d ≤ 0.
    Cylinder { radius: f64, core: f64, tightness: f64 },
}

/// 2/(1 + (d/distance)^power) at the distance d; before and behind a parallel light's plane, that from
/// the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fade {
    pub distance: f64,
    pub power: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightKind {
    Point {
        position: Vector,
    },
    /// From infinitely far.
    Directional {
        to_light: UnitVector,
    },
    /// Parallel rays from the plane through `position` across `to_light`.
    Parallel {
        position: Vector,
        to_light: UnitVector,
    },
}

/// The sky, at infinity: patterns are evaluated at the ray's direction, of length 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Sky {
    /// Painted one over the other, the last on top.
    pub pigments: Vec<Pigment>,
}

/// The point (u, v) of the screen, −½ … ½ from left to right and from bottom to top, is seen along
/// `forward + u·right + v·up` from `location` (perspective), or along `forward` from
/// `location + u·right + v·up` (orthographic). A lens shift is part of `forward` or `location`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    pub kind: CameraKind,
    pub location: Vector,
    pub forward: Vector,
    pub right: Vector,
    pub up: Vector,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CameraKind {
    Perspective,
    Orthographic,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            kind: CameraKind::Perspective,
            location: Vector::ZERO,
            forward: -Vector::Z,
            right: Vector::X * (4.0 / 3.0),
            up: Vector::Y,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// How many surfaces deep a ray is followed: 1 is the camera's ray alone.
    pub max_trace_level: u32,
    /// A path whose weight falls below this in every component is not followed.
    pub adc_bailout: f64,
    /// What turns the film's colours into linear light.
    pub assumed_gamma: Gamma,
    /// `Old` only where that changes the picture.
    pub clearness: Clearness,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            max_trace_level: 5,
            adc_bailout: 1.0 / 255.0,
            assumed_gamma: Gamma::LINEAR,
            clearness: Clearness::Current,
        }
    }
}
