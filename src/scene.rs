//! What the author meant: no macro, loop, include or name is left.
//!
//! **Invariant:** an object is a kind plus its modifiers *in written order* (a transform moves only
//! what precedes it); numbers and degrees are still the author's. All trees are arenas: a child
//! is an index, shared and never copied, and stands before its parents.

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
    /// What stands in the scene itself, in written order: lights and solids.
    pub roots: Vec<Root>,
    pub objects: Vec<Object>,
    pub transforms: Vec<Vec<Step>>,
    /// All of each transform as it was written.
    pub transform_sites: Vec<Site>,
    pub textures: Vec<Texture>,
    pub pigments: Vec<Pigment>,
    pub finishes: Vec<Finish>,
    /// Where each finish was written; a finish without an entry is a default.
    pub finish_origins: Vec<FinishOrigin>,
    /// Names of the main file that nothing used.
    pub unused: Vec<Unused>,
    /// Branches of the main file that were not run, where its text had mistakes.
    pub skipped: Vec<Span>,
    /// Shapes without size, told and left out: the word of each, and where.
    pub sizeless: Vec<(&'static str, Site)>,
    pub interiors: Vec<Interior>,
    pub expansions: Expansions,
}

/// A name that was declared, and that nothing used.
#[derive(Debug, Clone, PartialEq)]
pub struct Unused {
    /// `declare`, `local`, `macro`.
    pub directive: &'static str,
    pub name: String,
    pub site: Site,
    /// What it stands for is a light.
    pub is_light: bool,
    /// What it stands for is a camera.
    pub is_camera: bool,
}

/// One object placed in the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    pub object: ObjectId,
    /// The default texture where it was placed: for whatever in it has no texture.
    pub default_texture: TextureId,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    pub kind: ObjectKind,
    /// In written order.
    pub modifiers: Vec<Modifier>,
    /// The word that opened it.
    pub site: Site,
    /// All of it, where the scene or a union holds it and would be whole without it; `None` for the
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

/// How several solids make one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    /// All of them together, without walls inside.
    Merge,
    /// What all of them share.
    Intersection,
    /// The first without the others.
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
    /// Replaces the texture's pigment only (a texture always precedes it). As in POV-Ray
    /// (measured) it stands where the other one stood: its own transforms come after all that the
    /// other went through.
    Pigment(PigmentId),
    /// Replaces the texture's finish only (a texture always precedes it).
    Finish(FinishId),
    /// Replaces the interior.
    Interior(InteriorId),
    NoShadow,
    /// True: the camera does not see it. False undoes it for a declared object.
    NoImage(bool),
    /// Likewise, mirrors do not.
    NoReflection(bool),
    /// Likewise, it is lit on both sides by light on either.
    DoubleIlluminate(bool),
    Inverse,
    /// Only what lies in this object is left of the surface.
    ClippedBy(ObjectId),
}

/// A pigment and a finish; a transform moves what precedes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    pub pigment: PigmentId,
    pub finish: FinishId,
    /// Move the pigment, in written order.
    pub transforms: Vec<TransformId>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Pigment {
    pub kind: PigmentKind,
    pub transforms: Vec<TransformId>,
    pub site: Site,
    /// What has to be taken out of the text for it to have no pattern, each the smallest such piece; also
    /// what those override, where it would show again.
    pub pattern: Vec<Site>,
    /// Likewise, for no light to go through it.
    pub clear: Vec<Site>,
}

impl Pigment {
    /// Where it was written; `None` for the default, whose place is empty.
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
    /// Each face of the mesh has its own, of these: `mesh::Face::paint`. At least one.
    Faces(Arc<[Color]>),
}

impl PigmentKind {
    /// Its colours, without their places.
    pub fn colors(&self) -> impl Iterator<Item = Color> {
        let (some, map) = match self {
            Self::Color(color) => (std::slice::from_ref(color), &[][..]),
            Self::Patterned { map, .. } => (&[][..], map.0.as_slice()),
            Self::Faces(colors) => (&colors[..], &[][..]),
        };
        some.iter().copied().chain(map.iter().map(|(_, color)| *color))
    }
}

/// Colours over pattern values; entries sorted by value, at least one. Between two entries the
/// colour is interpolated, outside it is that of the nearest.
#[derive(Debug, Clone, PartialEq)]
pub struct ColorMap(pub Vec<(f64, Color)>);

impl ColorMap {
    /// The only colour of a map; black where it has none at all.
    pub fn lone_color(&self) -> Option<Color> {
        let first = self.0.first().map_or(Color::BLACK, |(_, color)| *color);
        self.0.iter().all(|(_, color)| *color == first).then_some(first)
    }
}

#[derive(Debug, Clone, PartialEq)]
pub enum Finish {
    /// The seed's formula (`kd ks phong_exponent`).
    Seed { kd: f64, ks: f64, phong_exponent: f64 },
    /// POV-Ray's words.
    Classic(ClassicFinish),
}

/// Where a finish was written. Each site is the smallest piece that can be taken out of the text, such as
/// `phong 0.4`; what it overrides is listed too where it would show again.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FinishOrigin {
    /// The word `finish`.
    pub site: Option<Site>,
    /// With the word that it is about.
    pub highlights: Vec<(Word, Site)>,
    pub reflection: Vec<Site>,
    /// The old place of the index of refraction.
    pub ior: Vec<Site>,
    /// Words whose last value is a weight of zero.
    pub zeros: Vec<(Word, Site)>,
    /// Without what is listed none of the seed's words is left.
    pub all_of_seed: bool,
    /// The first word of the seed's, and of POV-Ray's.
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
    /// What is reflected is not let through as well.
    pub conserve_energy: bool,
    /// The old place of the interior's index of refraction, which it outdoes (measured on POV-Ray
    /// 3.7).
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
    /// At grazing angles when `minimum` was given too, else at all angles.
    pub maximum: Rgb,
    /// Seen head-on.
    pub minimum: Rgb,
    pub falloff: f64,
    /// From minimum to maximum it goes as Fresnel's equations have it, not by `falloff`.
    pub fresnel: bool,
    pub exponent: f64,
    pub metallic: f64,
}

/// What a solid is filled with.
#[derive(Debug, Clone, PartialEq)]
pub struct Interior {
    /// Index of refraction, > 0; 1 is that of the air around.
    pub ior: f64,
    /// Each `ior`, as a piece that can be taken out of the text, and of those it replaces.
    pub sites: Vec<Site>,
    /// `caustics` above zero, which is not simulated yet.
    pub caustics: Option<Site>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Background {
    pub color: Color,
    pub site: Site,
}

#[derive(Debug, Clone, PartialEq)]
pub struct SkySphere {
    /// Painted one over the other, the last on top.
    pub pigments: Vec<PigmentId>,
    pub transforms: Vec<TransformId>,
    pub site: Site,
    /// All of each pigment, as a piece that can be taken out of the text.
    pub items: Vec<Site>,
}

/// `global_settings`.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    pub ambient_light: Rgb,
    /// What turns the scene's colours into linear light.
    pub assumed_gamma: Gamma,
    /// How clear colours are, the background's too.
    pub clearness: Clearness,
    pub max_trace_level: u32,
    pub adc_bailout: f64,
    /// Where `max_trace_level` was written.
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
