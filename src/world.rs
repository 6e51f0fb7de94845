//! The scene in canonical form, as the tracer reads it.
//!
//! **Invariant:** no transform list, no degrees, no missing default, no nested union; every placement is
//! invertible; every number is finite. One flat list per kind; an object is (kind, index, texture).
//! Specified in `docs/world.md`.

mod camera;
mod csg_solid;
mod fog;
mod light;
pub mod print;
mod rainbow;
mod solid;

use crate::color::{Clearness, Color, Gamma, Rgb};
use crate::math::placement::Map;
use crate::shape::uv::Mapping;
use crate::shape::{Box_, Ellipsoid, Placed, Plane, Shape, Sphere};
use crate::source::{Expansions, Site, Span};
pub use camera::{Camera, CameraKind, Face, Faces, Focus, MeshCamera, UnwrappedFace};
pub use csg_solid::{CsgSolid, Cutaway};
pub use fog::{Churn, Fog, Ground};
pub use light::{Area, Attenuation, Beam, Fade, Light, LightKind};

pub use rainbow::Rainbow;

pub use crate::texture::{
    Extras, Finish, Irid, Lobe, LobeKind, Pigment, Plain, Reflection, Texture,
};

/// The scene to render: flat lists of objects, shapes, lights and textures.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct World {
    pub camera: Camera,
    pub settings: Settings,
    /// The colour of a ray that leaves the scene where the sky is transparent.
    pub background: Rgb,
    /// What that is in a picture with alpha.
    pub backdrop: Backdrop,
    pub sky: Option<Sky>,
    /// In written order; each changes the picture.
    pub fogs: Vec<Fog>,
    /// Likewise.
    pub rainbows: Vec<Rainbow>,
    pub lights: Vec<Light>,
    /// The lights that light an object, in order; see `Object::lights`. Empty if all light every object.
    pub light_sets: Vec<Vec<u32>>,
    /// Objects that lights shine through, each in a World of its own; see `Light::through`.
    pub projections: Vec<World>,
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
    pub textures: Vec<Texture>,
    /// Interiors of solids, indexed by `Object::interior`. Empty when nothing refracts or absorbs light.
    pub interiors: Vec<Interior>,
    /// The exponent of each object's caustics; 0, like an entry that is missing, for none. Light
    /// on its way to another surface passes `1 + |L·N|^exponent` times its transmittance.
    pub caustics: Vec<f64>,
    /// Textures of the inner sides of objects.
    pub linings: Vec<Coat>,
    /// Placements of the nodes of textures: those of one object one after the other, from `Object::places` on.
    pub texture_maps: Vec<Map>,
    /// The surfaces' own coordinates; see `Object::uv`.
    pub uv_mappings: Vec<Mapping>,
    /// Texture coordinates that are constant over a flat face; see `Object::faces`.
    pub faces: Vec<FaceCoordinates>,
}

impl World {
    /// Returns whether fog or rainbows veil what rays meet.
    pub fn has_haze(&self) -> bool {
        !self.fogs.is_empty() || !self.rainbows.is_empty()
    }
}

/// The origins of the World's parts, one list for each of its lists. Never compared.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Origins {
    pub objects: Vec<Site>,
    /// For each object and light at the top level of the scene, as written: the first object of the World that comes
    /// from it or from one after it.
    pub roots: Vec<u32>,
    /// The operations that make the CSG solids, as written: several may make one.
    pub operations: Vec<OperationOrigin>,
    /// The whole item of each light: its block, or the use of a declared one.
    pub lights: Vec<Site>,
    /// The keywords that attenuate the lights, with their values.
    pub attenuation: Vec<Site>,
    /// Each `area_light`, with its values.
    pub area_lights: Vec<Site>,
    /// Each `light_group` that is in no other.
    pub light_groups: Vec<Site>,
    /// Each `projected_through`, with its object.
    pub projections: Vec<Site>,
    pub textures: Vec<TextureOrigin>,
    /// What all textures and the sky consist of, each place once.
    pub surfaces: Vec<SurfaceOrigin>,
    pub interiors: Vec<InteriorOrigin>,
    /// Each `no_image` and `no_reflection` that applies to a solid.
    pub hidden: Vec<Site>,
    /// Each `double_illuminate` that applies to a solid.
    pub double_illuminate: Vec<Site>,
    pub camera: Option<Site>,
    /// The `aperture` and the `normal` of the camera, if it has them.
    pub aperture: Option<Site>,
    pub camera_normal: Option<Site>,
    pub sky: Option<SkyOrigin>,
    /// The whole item of each fog.
    pub fogs: Vec<Site>,
    /// Likewise of each rainbow.
    pub rainbows: Vec<Site>,
    pub max_trace_level: Option<Site>,
    /// Parts that lowering left out, with the reasons.
    pub dropped: Vec<Dropped>,
    /// Transforms that nearly flatten space, in source order.
    pub near_singular: Vec<NearSingular>,
    /// Parts of one solid whose surfaces coincide, if searched; each pair of locations once.
    pub coinciding: Vec<Coinciding>,
    pub expansions: Expansions,
}

impl Origins {
    /// Returns the number, from 1, of the object or light at the top level of the scene that an object comes from.
    pub fn root(&self, object: u32) -> u32 {
        self.roots.partition_point(|&first| first <= object) as u32
    }
}

/// The origins of a texture's parts. Each site is a keyword with its values, such as `phong 0.4`; equal
/// textures share one list.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TextureOrigin {
    /// The keyword `pigment` of its first use; `None` for a default.
    pub pigment: Option<Site>,
    /// The keyword `finish`, likewise.
    pub finish: Option<Site>,
    /// The places that call for its effects, in the order in which they were found. Most textures have few.
    pub sites: Vec<(TexturePart, Site)>,
}

/// An effect of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TexturePart {
    Pattern,
    Highlights,
    Reflection,
    /// For light from behind, as in `diffuse 0.6, 0.3`.
    Behind,
    /// For colours that let light through.
    Clear,
    /// For colours with a `filter` on objects that cast shadows.
    Filter,
}

impl TextureOrigin {
    /// Returns the places that call for an effect.
    pub fn of(&self, part: TexturePart) -> impl Iterator<Item = Site> {
        self.sites.iter().filter(move |(of, _)| *of == part).map(|(_, site)| *site)
    }
}

/// What a pattern, a picture or layers are part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SurfacePart {
    Pigment,
    Normal,
    Texture,
    Layers,
}

/// A pattern, a picture or layers in a texture or the sky.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceOrigin {
    pub part: SurfacePart,
    /// For example `wood` or `image_map`.
    pub word: &'static str,
    /// `None` for layers without pigments of their own.
    pub site: Option<Site>,
}

/// The origins of an interior's parts: keywords with their values, such as `ior 1.5`; equal interiors share one
/// list.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InteriorOrigin {
    pub ior: Vec<Site>,
    pub absorption: Vec<Site>,
    pub dispersion: Vec<Site>,
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
    /// As in [`TextureOrigin`].
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

/// A shape with its texture, and how light treats it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Object {
    pub shape: Shape,
    /// Index into `World::textures`.
    pub texture: u32,
    /// The index in `World::texture_maps` of the map into the space of its texture's slot 0; the other slots'
    /// follow. `None` if all are the identity, or the texture has no pattern.
    pub places: Option<u32>,
    /// For a patterned plane (1 entry) or box (6 entries, in the order of
    /// [`crate::shape::SurfacePoint::face`]): the index in `World::faces` of the first entry of slot 0; the
    /// other slots' follow.
    pub faces: Option<u32>,
    /// Index into `World::uv_mappings`, if its texture asks for it; `None` for shapes without coordinates of
    /// their own, which have the x and y of the point.
    pub uv: Option<u32>,
    /// Index into `World::linings`; `None`: both sides have the same texture.
    pub lining: Option<u32>,
    /// Index into `World::interiors`; `None` for air.
    pub interior: Option<u32>,
    pub casts_shadow: bool,
    /// Visible to camera rays, direct or transmitted.
    pub in_image: bool,
    /// Visible to reflected rays.
    pub in_reflections: bool,
    /// Light on one side of the surface illuminates the other, too.
    pub double_illuminate: bool,
    /// Fog is inside as well. False where the World has no fog.
    pub hollow: bool,
    /// Index into `World::light_sets`, if there are any.
    pub lights: u32,
    /// Inside and outside are exchanged.
    pub inverse: bool,
    /// Index into `World::csg_solids` of the CSG solid that it is part of; it is not an object by itself then.
    pub csg_solid: Option<u32>,
}

impl Object {
    /// Returns an object of this shape with defaults: the first texture, filled with air.
    pub fn plain(shape: Shape) -> Self {
        Self {
            shape,
            texture: 0,
            places: None,
            faces: None,
            uv: None,
            lining: None,
            interior: None,
            casts_shadow: true,
            in_image: true,
            in_reflections: true,
            double_illuminate: false,
            hollow: false,
            lights: 0,
            inverse: false,
            csg_solid: None,
        }
    }
}

/// The texture of one side of an object, and where it lies: see the fields of [`Object`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coat {
    pub texture: u32,
    pub places: Option<u32>,
    pub faces: Option<u32>,
}

/// The interior of a solid. It matters only where light enters it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interior {
    /// Index of refraction, > 0; that of air is 1.
    pub ior: f64,
    /// `None`: light does not fade.
    pub absorption: Option<Absorption>,
    /// `None`: all colours have the same index of refraction.
    pub dispersion: Option<Dispersion>,
}

impl Interior {
    /// Returns an interior that only refracts.
    pub const fn of(ior: f64) -> Self {
        Self { ior, absorption: None, dispersion: None }
    }

    /// Returns whether rays change in it, unlike in air.
    pub fn is_active(&self) -> bool {
        self.ior != 1.0 || self.absorption.is_some() || self.dispersion.is_some()
    }
}

/// What is left of light after a way of length d, with c the colour: c + (1 − c)/(1 + (d/distance)^power), or
/// e^((c − 1)·d/distance) for a power of 1000 or more.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Absorption {
    /// Not 0.
    pub distance: f64,
    pub power: f64,
    pub color: Rgb,
}

/// The index of refraction at the position p of the spectrum, 0 (red) to 1 (violet), is ior·ratio^(p − ½).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dispersion {
    pub ratio: f64,
    /// The number of rays that a ray of all colours is split into; at least 2.
    pub samples: u32,
}

/// For one flat face: each texture coordinate that is constant over it, computed in extended precision. The
/// tracer uses these numbers, so that a pattern never flickers on its own lattice.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FaceCoordinates(pub [Option<f64>; 3]);

/// The background of a picture with alpha.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Backdrop {
    /// As written; clear if it is not.
    pub color: Color,
    /// Only mirrors show it and the sky, and the picture shows through both: in scenes for versions below 3.7.
    pub only_mirrored: bool,
}

impl Default for Backdrop {
    fn default() -> Self {
        let color = Color { rgb: Rgb::BLACK, filter: 0.0, transmit: 1.0 };
        Self { color, only_mirrored: false }
    }
}

/// The sky, at infinity: patterns are evaluated at the ray's direction, of length 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Sky {
    /// Layers, the last on top.
    pub pigments: Vec<Pigment>,
    /// Multiplies what they show, but not what is seen through them.
    pub emission: Rgb,
}

/// The `global_settings` that matter to the tracer.
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
    /// Of the layers of a texture only the last below tints the light behind. Set only if there are layers.
    pub untinted_layers: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            max_trace_level: 5,
            adc_bailout: 1.0 / 255.0,
            assumed_gamma: Gamma::LINEAR,
            clearness: Clearness::Current,
            untinted_layers: false,
        }
    }
}
