//! The scene as the author meant it, after macros, loops, includes and names are resolved.
//!
//! **Invariant:** an object is a kind plus its modifiers *in written order* (a transform moves only what
//! precedes it); numbers and degrees are still the author's. All trees are arenas: a child is an index,
//! shared and never copied, and precedes its parents.

pub mod blob;
pub mod camera;
pub mod height_field;
pub mod julia_fractal;
pub mod light;
pub mod mesh;
pub mod outline;
pub mod polygon;
pub mod print;
pub mod solid;
pub mod sweep;
pub mod text;

use std::sync::Arc;

use crate::color::{Clearness, Color, Gamma, Rgb};
use crate::math::transform::Step;
pub use crate::math::transform::TransformId;
use crate::pattern::Pattern;
use crate::source::{Expansions, Site, Span};
pub use crate::vocabulary::Dialect;
use crate::vocabulary::Word;
pub use camera::{Camera, CameraItem, CameraItemKind, CameraKind};
pub use julia_fractal::JuliaFractal;
pub use light::{Beam, Fade, LightKind, LightSource};
pub use solid::{Container, Solid};

/// Declares an index into one of the Scene's arenas.
macro_rules! ids {
    ($($id:ident)*) => {$(
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $id(pub u32);

        impl $id {
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

ids! { ObjectId TextureId PigmentId FinishId InteriorId }

#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    pub dialect: Dialect,
    pub settings: Settings,
    /// Every camera of the scene, in order; the last one counts.
    pub cameras: Vec<Camera>,
    pub background: Option<Background>,
    pub sky_sphere: Option<SkySphere>,
    /// The lights and solids placed in the scene itself, in written order.
    pub roots: Vec<Root>,
    pub objects: Vec<Object>,
    pub transforms: Vec<Vec<Step>>,
    /// The source range of each transform.
    pub transform_sites: Vec<Site>,
    pub textures: Vec<Texture>,
    pub pigments: Vec<Pigment>,
    pub finishes: Vec<Finish>,
    /// The origin of each finish; a finish without an entry is a default.
    pub finish_origins: Vec<FinishOrigin>,
    /// Names declared in the main file and never used.
    pub unused: Vec<Unused>,
    /// Branches of the main file that were not run and contain errors.
    pub skipped: Vec<Span>,
    /// Shapes without size, which were reported and left out: the keyword and the site of each.
    pub sizeless: Vec<(&'static str, Site)>,
    pub interiors: Vec<Interior>,
    pub expansions: Expansions,
}

/// A declared name that is never used.
#[derive(Debug, Clone, PartialEq)]
pub struct Unused {
    /// `declare`, `local` or `macro`.
    pub directive: &'static str,
    pub name: String,
    pub site: Site,
    /// Its value is a light.
    pub is_light: bool,
    /// Its value is a camera.
    pub is_camera: bool,
}

/// One object placed in the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    pub object: ObjectId,
    /// The default texture at the point of placement, for every part without a texture.
    pub default_texture: TextureId,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    pub kind: ObjectKind,
    /// In written order.
    pub modifiers: Vec<Modifier>,
    /// The keyword that opened it.
    pub site: Site,
    /// The whole object, if the scene or union that contains it remains valid without it; `None` for the
    /// value of a declaration and the like.
    pub item: Option<Site>,
}

#[derive(Debug, Clone, PartialEq)]
pub enum ObjectKind {
    Solid(Solid),
    Union(Vec<ObjectId>),
    Csg {
        operation: Operation,
        /// In written order.
        children: Vec<ObjectId>,
    },
    /// A use of another object, with further modifiers: `object { Name … }`.
    Use(ObjectId),
    LightSource(Box<LightSource>),
}

/// An operation that combines several solids into one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    /// The union without interior surfaces.
    Merge,
    /// The intersection of all.
    Intersection,
    /// The first minus the others.
    Difference,
}

impl Operation {
    pub fn word(self) -> Word {
        match self {
            Self::Merge => Word::Merge,
            Self::Intersection => Word::Intersection,
            Self::Difference => Word::Difference,
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Modifier {
    pub kind: ModifierKind,
    pub site: Site,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ModifierKind {
    Transform(TransformId),
    /// Replaces the texture.
    Texture(TextureId),
    /// Replaces the texture's pigment only (a texture always precedes it). As in POV-Ray (measured) it keeps
    /// the placement of the replaced one: its own transforms come after all those that moved the other.
    Pigment(PigmentId),
    /// Replaces the texture's finish only (a texture always precedes it).
    Finish(FinishId),
    /// Replaces the interior.
    Interior(InteriorId),
    NoShadow,
    /// `true`: invisible to camera rays. `false` undoes this for a declared object.
    NoImage(bool),
    /// Likewise, for reflected rays.
    NoReflection(bool),
    /// Likewise, lights on either side illuminate both sides.
    DoubleIlluminate(bool),
    Inverse,
    /// Keeps only the part of the surface inside this object.
    ClippedBy(ObjectId),
}

/// A pigment and a finish; a transform moves what precedes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    pub pigment: PigmentId,
    pub finish: FinishId,
    /// Transforms of the pigment, in written order.
    pub transforms: Vec<TransformId>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Pigment {
    pub kind: PigmentKind,
    pub transforms: Vec<TransformId>,
    pub site: Site,
    /// The smallest source pieces to remove for it to have no pattern, including overridden ones that would
    /// apply again.
    pub pattern: Vec<Site>,
    /// Likewise, for it to let no light through.
    pub clear: Vec<Site>,
}

impl Pigment {
    /// Returns its site; `None` for the default, whose span is empty.
    pub fn written(&self) -> Option<Site> {
        Some(self.site).filter(|site| site.span.start < site.span.end)
    }
}

#[derive(Debug, Clone, PartialEq)]
pub enum PigmentKind {
    Color(Color),
    Patterned {
        pattern: Pattern,
        map: ColorMap,
    },
    /// Each face of the mesh has its own of these, see `mesh::Face::paint`. At least one.
    Faces(Arc<[Color]>),
}

impl PigmentKind {
    /// Returns its colours, without their map values.
    pub fn colors(&self) -> impl Iterator<Item = Color> {
        let (some, map) = match self {
            Self::Color(color) => (std::slice::from_ref(color), &[][..]),
            Self::Patterned { map, .. } => (&[][..], map.0.as_slice()),
            Self::Faces(colors) => (&colors[..], &[][..]),
        };
        some.iter().copied().chain(map.iter().map(|(_, color)| *color))
    }
}

/// Colours over pattern values, at least one entry, sorted by value. Interpolated between entries; constant
/// before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct ColorMap(pub Vec<(f64, Color)>);

impl ColorMap {
    /// Returns the only colour of a map, black if it is empty; `None` if it has several.
    pub fn lone_color(&self) -> Option<Color> {
        let first = self.0.first().map_or(Color::BLACK, |(_, color)| *color);
        self.0.iter().all(|(_, color)| *color == first).then_some(first)
    }
}

#[derive(Debug, Clone, PartialEq)]
pub enum Finish {
    /// The native formula (`kd ks phong_exponent`).
    Seed { kd: f64, ks: f64, phong_exponent: f64 },
    /// POV-Ray's finish.
    Classic(ClassicFinish),
}

/// The origin of a finish. Each site is the smallest piece that can be removed from the source, such as
/// `phong 0.4`; pieces that it overrides are listed too if they would apply again.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FinishOrigin {
    /// The keyword `finish`.
    pub site: Option<Site>,
    /// Each highlight with its keyword.
    pub highlights: Vec<(Word, Site)>,
    pub reflection: Vec<Site>,
    /// The sites of the old `ior` in a finish.
    pub ior: Vec<Site>,
    /// Keywords whose last value is a weight of zero.
    pub zeros: Vec<(Word, Site)>,
    /// Removing the listed pieces leaves none of the native keywords.
    pub all_of_seed: bool,
    /// The first native keyword, and the first of POV-Ray's.
    pub seed: Option<(Word, Site)>,
    pub classic: Option<(Word, Site)>,
}

/// POV-Ray's finish (manual, section 3.4.7.3 "Finish").
#[derive(Debug, Clone, PartialEq)]
pub struct ClassicFinish {
    pub ambient: Rgb,
    pub emission: Rgb,
    pub diffuse: f64,
    pub brilliance: f64,
    pub phong: f64,
    pub phong_size: f64,
    pub specular: f64,
    pub roughness: f64,
    /// 0: highlights have the light's colour, 1: the surface's.
    pub metallic: f64,
    pub reflection: Option<Reflection>,
    /// Reflected light is not transmitted as well.
    pub conserve_energy: bool,
    /// The old form of the interior's index of refraction, which it overrides (measured on POV-Ray 3.7).
    pub ior: Option<f64>,
}

impl Default for ClassicFinish {
    fn default() -> Self {
        Self {
            ambient: Rgb::gray(0.1),
            emission: Rgb::BLACK,
            diffuse: 0.6,
            brilliance: 1.0,
            phong: 0.0,
            phong_size: 40.0,
            specular: 0.0,
            roughness: 0.05,
            metallic: 0.0,
            reflection: None,
            conserve_energy: false,
            ior: None,
        }
    }
}

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

/// The interior of a solid.
#[derive(Debug, Clone, PartialEq)]
pub struct Interior {
    /// Index of refraction, > 0; that of the surrounding air is 1.
    pub ior: f64,
    /// The removable source piece of each `ior`, and of those it replaces.
    pub sites: Vec<Site>,
    /// A `caustics` above zero, which is not simulated yet.
    pub caustics: Option<Site>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Background {
    pub color: Color,
    pub site: Site,
}

#[derive(Debug, Clone, PartialEq)]
pub struct SkySphere {
    /// Layers, the last on top.
    pub pigments: Vec<PigmentId>,
    pub transforms: Vec<TransformId>,
    pub site: Site,
    /// The removable source piece of each pigment.
    pub items: Vec<Site>,
}

/// `global_settings`.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    pub ambient_light: Rgb,
    /// The conversion of the scene's colours to linear light.
    pub assumed_gamma: Gamma,
    /// The rule for clear colours, the background's included.
    pub clearness: Clearness,
    pub max_trace_level: u32,
    pub adc_bailout: f64,
    /// The site of `max_trace_level`.
    pub max_trace_level_site: Option<Site>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            ambient_light: Rgb::WHITE,
            assumed_gamma: Gamma::LINEAR,
            clearness: Clearness::Current,
            max_trace_level: 5,
            adc_bailout: 1.0 / 255.0,
            max_trace_level_site: None,
        }
    }
}
