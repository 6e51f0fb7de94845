//! The scene as the author meant it, after macros, loops, includes and names are resolved.
//!
//! **Invariant:** an object is a kind plus its modifiers *in written order* (a transform moves only what
//! precedes it); numbers and degrees are still the author's. All trees are arenas: a child is an index,
//! shared and never copied, and precedes its parents.

pub mod blob;
pub(crate) mod camera;
pub(crate) mod finish;
pub(crate) mod fog;
pub mod height_field;
pub(crate) mod julia_fractal;
pub(crate) mod light;
pub mod mesh;
pub mod outline;
pub mod polygon;
pub mod print;
pub(crate) mod rainbow;
pub(crate) mod solid;
pub mod sweep;
pub mod text;
pub mod texture;

use crate::color::{Clearness, Color, Gamma, Rgb};
use crate::math::transform::Step as TransformStep;
pub use crate::math::transform::TransformId;
use crate::source::{Expansions, Site, Span};
pub use crate::vocabulary::Dialect;
use crate::vocabulary::Word;
pub use camera::{
    Camera, CameraItem, CameraItemKind, CameraKind, CylinderForm, Distribution, MeshCamera,
};
pub use finish::{ClassicFinish, Finish, FinishOrigin, Irid, Reflection};
pub use fog::{Fog, FogTurbulence};
pub use julia_fractal::JuliaFractal;
pub use light::{Area, Beam, Fade, LightKind, LightSource, LooksLike, ProjectedThrough};
pub use rainbow::Rainbow;
pub use solid::{Container, Solid};
pub use texture::{
    ColorMap, Colors, Normal, NormalKind, Pattern, Pigment, PigmentKind, Source, Step, Texture,
    TextureKind,
};

/// Declares an index into one of the Scene's arenas.
macro_rules! ids {
    ($($id:ident)*) => {$(
        /// Index into one of the lists of a [`Scene`].
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $id(pub u32);

        impl $id {
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

ids! { ObjectId TextureId PigmentId NormalId FinishId InteriorId }

/// A scene as written: lists of its objects, textures and settings.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    pub dialect: Dialect,
    pub settings: Settings,
    /// Every camera of the scene, in order; the last one counts.
    pub cameras: Vec<Camera>,
    pub background: Option<Background>,
    pub sky_sphere: Option<SkySphere>,
    /// In written order.
    pub fogs: Vec<Fog>,
    /// In written order.
    pub rainbows: Vec<Rainbow>,
    /// The lights and solids placed in the scene itself, in written order.
    pub roots: Vec<Root>,
    pub objects: Vec<Object>,
    pub transforms: Vec<Vec<TransformStep>>,
    /// The source range of each transform.
    pub transform_sites: Vec<Site>,
    pub textures: Vec<Texture>,
    pub pigments: Vec<Pigment>,
    pub normals: Vec<Normal>,
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

/// A solid, a union or a light, and what modifies it.
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

/// Kind of an [`Object`].
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

/// A transform, a texture or another keyword of an object.
#[derive(Debug, Clone, PartialEq)]
pub struct Modifier {
    pub kind: ModifierKind,
    pub site: Site,
}

/// Kind of a [`Modifier`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ModifierKind {
    Transform(TransformId),
    /// Replaces the texture.
    Texture(TextureId),
    /// Replaces the texture of the inner side, which is the other texture if there is none.
    InteriorTexture(TextureId),
    /// Replaces the texture's pigment only (a texture always precedes it). As in POV-Ray (measured) it keeps
    /// the placement of the replaced one: its own transforms come after all those that moved the other.
    Pigment(PigmentId),
    /// Replaces the texture's normal only (a texture always precedes it).
    Normal(NormalId),
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
    /// Likewise, fog is inside as well.
    Hollow(bool),
    Inverse,
    /// Lights and objects of a group: its lights light its objects alone. `true`: other lights do, too.
    LightGroup(bool),
    /// The parts of the operation without a texture show those of the parts around their points.
    CutawayTextures,
    /// Keeps only the part of the surface inside this object.
    ClippedBy(ObjectId),
}

/// The interior of a solid.
#[derive(Debug, Clone, PartialEq)]
pub struct Interior {
    /// Index of refraction, > 0; that of the surrounding air is 1.
    pub ior: f64,
    /// An `ior` is written: without one, `dispersion` has no effect (measured on POV-Ray 3.7).
    pub is_refractive: bool,
    /// 0: light does not fade.
    pub fade_distance: f64,
    pub fade_power: f64,
    pub fade_color: Rgb,
    /// The last `fade_distance`, with its value.
    pub fade_site: Option<Site>,
    /// The index of refraction of violet light over that of red light.
    pub dispersion: f64,
    pub dispersion_samples: u32,
    /// The last `dispersion`, likewise.
    pub dispersion_site: Option<Site>,
    /// The last `ior`, likewise.
    pub ior_site: Option<Site>,
    /// Of the light in its shadow.
    pub caustics: Option<f64>,
}

impl Default for Interior {
    fn default() -> Self {
        Self {
            ior: 1.0,
            is_refractive: false,
            fade_distance: 0.0,
            fade_power: 0.0,
            fade_color: Rgb::BLACK,
            fade_site: None,
            dispersion: 1.0,
            dispersion_samples: 7,
            dispersion_site: None,
            ior_site: None,
            caustics: None,
        }
    }
}

/// A `background`.
#[derive(Debug, Clone, PartialEq)]
pub struct Background {
    pub color: Color,
    pub site: Site,
}

/// A `sky_sphere`.
#[derive(Debug, Clone, PartialEq)]
pub struct SkySphere {
    /// Layers, the last on top.
    pub pigments: Vec<PigmentId>,
    pub transforms: Vec<TransformId>,
    /// The colour that multiplies what the pigments show.
    pub emission: Rgb,
    pub site: Site,
    /// The site of each pigment, with its block.
    pub items: Vec<Site>,
}

/// `global_settings`.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    pub ambient_light: Rgb,
    /// The wavelengths of red, green and blue for `irid`.
    pub irid_wavelength: Rgb,
    /// The conversion of the scene's colours to linear light.
    pub assumed_gamma: Gamma,
    /// The rule for clear colours, the background's included.
    pub clearness: Clearness,
    /// Of the layers of a texture only the last below tints the light behind, as in versions up to 3.1.
    pub untinted_layers: bool,
    pub max_trace_level: u32,
    pub adc_bailout: f64,
    /// The site of `max_trace_level`.
    pub max_trace_level_site: Option<Site>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            ambient_light: Rgb::WHITE,
            irid_wavelength: Rgb::new(0.70, 0.52, 0.48),
            assumed_gamma: Gamma::LINEAR,
            clearness: Clearness::Current,
            untinted_layers: false,
            max_trace_level: 5,
            adc_bailout: 1.0 / 255.0,
            max_trace_level_site: None,
        }
    }
}
