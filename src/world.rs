//! The scene in canonical form, as the tracer reads it.
//!
//! **Invariant:** no transform list, no degrees, no missing default, no nested union; every placement is
//! invertible; every number is finite. One flat list per kind; an object is (kind, index, material).
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
    /// The colour of a ray that leaves the scene where the sky is transparent.
    pub background: Rgb,
    pub sky: Option<Sky>,
    pub lights: Vec<Light>,
    /// In written order.
    pub objects: Vec<Object>,
    pub spheres: Vec<Sphere>,
    pub planes: Vec<Plane>,
    pub boxes: Vec<Box_>,
    pub ellipsoids: Vec<Ellipsoid>,
    /// All other solids, each with its placement; bodies are shared.
    pub placed: Vec<Placed>,
    /// CSG solids.
    pub csg_solids: Vec<CsgSolid>,
    pub materials: Vec<Material>,
    /// Interiors of solids, indexed by `Object::interior`. Empty when nothing refracts light.
    pub interiors: Vec<Interior>,
    /// Placements of textures, indexed by `Object::texture_from_world`.
    pub texture_maps: Vec<Map>,
    /// Texture coordinates that are constant over a flat face; see `Object::faces`.
    pub faces: Vec<FaceCoordinates>,
}

/// A CSG solid.
#[derive(Debug, Clone, PartialEq)]
pub struct CsgSolid {
    /// In postfix order.
    pub nodes: Vec<Node>,
    /// The index of its first leaf in `World::objects`; the leaves follow in the order of the nodes.
    pub first: u32,
    pub count: u32,
}

impl CsgSolid {
    /// Returns the indices of its leaves in `World::objects`.
    pub fn leaves(&self) -> std::ops::Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// The origins of the World's parts, one list for each of its lists. Never compared.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Origins {
    pub objects: Vec<Site>,
    /// The operations that make the CSG solids, as written: several may make one.
    pub operations: Vec<OperationOrigin>,
    /// The removable source piece of each light.
    pub lights: Vec<Site>,
    /// The pieces to remove for each light not to shine: usually the whole light.
    pub light_pieces: Vec<Vec<Site>>,
    /// Each keyword that attenuates a light, likewise.
    pub attenuation: Vec<Site>,
    pub materials: Vec<MaterialOrigin>,
    /// The source pieces that give each interior, likewise.
    pub interiors: Vec<Vec<Site>>,
    /// Each `no_image` and `no_reflection` that applies to a solid, likewise.
    pub hidden: Vec<Site>,
    /// Each `double_illuminate`, likewise.
    pub double_illuminate: Vec<Site>,
    pub camera: Option<Site>,
    pub sky: Option<SkyOrigin>,
    pub max_trace_level: Option<Site>,
    /// Parts that lowering left out, with the reasons.
    pub dropped: Vec<Dropped>,
    /// Transforms that nearly flatten space, in source order.
    pub near_singular: Vec<NearSingular>,
    /// Parts of one solid whose surfaces coincide, if searched; each pair of locations once.
    pub coinciding: Vec<Coinciding>,
    pub expansions: Expansions,
}

/// The origins of a material's parts. Each site of a list is a removable source piece, such as `phong 0.4`;
/// without all of them the material has no such part.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MaterialOrigin {
    /// The keyword `pigment` of its first use; `None` for a default.
    pub pigment: Option<Site>,
    /// The keyword `finish`, likewise.
    pub finish: Option<Site>,
    pub pattern: Vec<Site>,
    pub highlights: Vec<Site>,
    pub reflection: Vec<Site>,
    /// For colours that let light through.
    pub clear: Vec<Site>,
    /// For colours with a `filter` on objects that cast shadows.
    pub filter: Vec<Site>,
}

/// An operation that combines several solids into one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OperationOrigin {
    /// For example `difference` or `clipped_by`.
    pub word: &'static str,
    pub site: Site,
}

/// The origin of the sky.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyOrigin {
    /// The keyword `sky_sphere`.
    pub site: Site,
    /// The source range of each pigment.
    pub items: Vec<Site>,
    /// As in [`MaterialOrigin`].
    pub pattern: Vec<Site>,
}

/// A part of the Scene that cannot change the picture, and is therefore not in the World.
#[derive(Debug, Clone, PartialEq)]
pub struct Dropped {
    pub site: Site,
    /// For example `light_source` or `reflection`.
    pub what: String,
    /// For example `its colour is black`.
    pub why: String,
    /// For a part inside a macro, the calls that made it, each location once.
    pub calls: Vec<Span>,
}

/// A map that loses more than half of the digits of its input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearSingular {
    /// The whole transform; the object if only its transforms together are near-singular.
    pub site: Site,
    /// The condition number: the largest factor by which it stretches a direction over the smallest; 2²⁶ or
    /// more.
    pub condition: f64,
}

/// Two parts of one solid that share a face, or part of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coinciding {
    /// For example `box` and `cylinder`.
    pub words: [&'static str; 2],
    /// In order of declaration.
    pub sites: [Site; 2],
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Object {
    pub shape: Shape,
    /// Index into `World::materials`.
    pub material: u32,
    /// Index into `World::texture_maps`; `None` for the identity, or a material without pattern.
    pub texture_from_world: Option<u32>,
    /// For a patterned plane (1 entry) or box (6 entries, in the order of
    /// [`crate::shape::SurfacePoint::face`]): the index of its first entry in `World::faces`.
    pub faces: Option<u32>,
    /// Index into `World::interiors`; `None` for air.
    pub interior: Option<u32>,
    pub casts_shadow: bool,
    /// Visible to camera rays, direct or transmitted.
    pub in_image: bool,
    /// Visible to reflected rays.
    pub in_reflections: bool,
    /// Light on one side of the surface illuminates the other, too.
    pub double_illuminate: bool,
    /// Inside and outside are exchanged.
    pub inverse: bool,
    /// Index into `World::csg_solids` of the CSG solid that it is part of; it is not an object by itself then.
    pub csg_solid: Option<u32>,
}

impl Object {
    /// Returns whether rays can be intersected with it in 32-bit floats.
    pub fn has_single_kernel(&self) -> bool {
        match self.shape {
            Shape::Sphere(_) | Shape::Plane(_) | Shape::Box(_) => self.csg_solid.is_none(),
            Shape::Ellipsoid(_) | Shape::Placed(_) => false,
        }
    }

    /// Returns an object of this shape with defaults: the first material, filled with air.
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
            csg_solid: None,
        }
    }
}

/// The interior of a solid. It matters only where light enters it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interior {
    /// Index of refraction, > 0; that of air is 1.
    pub ior: f64,
}

/// For one flat face: each texture coordinate that is constant over it, computed in extended precision. The
/// tracer uses these numbers, so that a pattern never flickers on its own lattice.
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
        /// Maps the texture's space to the pattern's.
        pattern_from_texture: Map,
        /// Sorted by value; at least one entry.
        map: Vec<(f64, Color)>,
    },
    /// The colours of a mesh's faces, by corner: `shape::mesh::Skin::paint`. At least two.
    Faces(Arc<[Color]>),
}

impl Pigment {
    /// Returns its colours, without their map values.
    pub fn colors(&self) -> impl Iterator<Item = Color> {
        let (some, map) = match self {
            Self::Color(color) => (std::slice::from_ref(color), &[][..]),
            Self::Patterned { map, .. } => (&[][..], map.as_slice()),
            Self::Faces(colors) => (&colors[..], &[][..]),
        };
        some.iter().copied().chain(map.iter().map(|(_, color)| *color))
    }

    /// Returns whether light passes through it anywhere.
    pub fn is_clear(&self) -> bool {
        self.colors().any(Color::is_clear)
    }
}

/// The reflection and emission of a surface. Components of weight zero are absent.
///
/// The radiance toward the viewer is, with C the pigment's colour, f and t its filter and
/// transmit, and the sum over the lights that are visible:
/// `(1 − f − t)·C·(emission + Σ I·diffuse·(N·L)^brilliance) + Σ I·Σ lobes + reflection +
/// (f·C + t)·what is seen through it`; see [`Clearness`] for the first factor in old scenes.
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
    /// (R·L)^exponent, where R is the mirrored view direction.
    Phong,
    /// (N·H)^exponent, where H bisects the directions to the light and to the viewer.
    Blinn,
}

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

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    pub kind: LightKind,
    pub color: Rgb,
    pub casts_shadows: bool,
    /// `None`: its full colour everywhere.
    pub attenuation: Option<Attenuation>,
}

/// Attenuation of a light: the product of both factors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attenuation {
    pub beam: Option<Beam>,
    pub fade: Option<Fade>,
}

/// A beam, in terms of s(a, b; v) = t²(3 − 2t), where t = (v − a)/(b − a) is clamped to 0 … 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Beam {
    /// For a point light: c^tightness · s(edge, core; c), where c is the cosine of the angle between `axis`
    /// and the light ray; 0 where c ≤ 0.
    Cone { axis: UnitVector, edge: f64, core: f64, tightness: f64 },
    /// For a parallel light, in front of its plane: d^tightness · s(0, core; d), where d = 1 − r/radius and r
    /// is the distance from its axis; 0 where d ≤ 0.
    Cylinder { radius: f64, core: f64, tightness: f64 },
}

/// Multiplies by 2/(1 + (d/distance)^power) at the distance d from the light; for a parallel light, from its
/// plane, on both sides.
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
    /// From infinitely far away.
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
    /// Layers, the last on top.
    pub pigments: Vec<Pigment>,
}

/// The camera. The point (u, v) of the screen, −½ … ½ from left to right and from bottom to top, is seen
/// along `forward + u·right + v·up` from `location` (perspective), or along `forward` from `location +
/// u·right + v·up` (orthographic). A lens shift is part of `forward` or `location`.
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
    /// The most surfaces that a ray is followed through: 1 is the camera ray alone.
    pub max_trace_level: u32,
    /// A path is not followed if its weight is below this in every component.
    pub adc_bailout: f64,
    /// The conversion of the film's colours to linear light.
    pub assumed_gamma: Gamma,
    /// `Old` only if that changes the picture.
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
