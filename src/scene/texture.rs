//! Textures and pigments as written: patterns, and what they blend.

use std::sync::Arc;

use super::{FinishId, NormalId, PigmentId, TextureId, TransformId};
use crate::color::Color;
use crate::math::Vector;
use crate::pattern::{Kind, Setting, Warp, WaveKind};
use crate::source::Site;
use crate::texture::density::Grid;
use crate::texture::region::Region;
use crate::texture::slope::Slope;
use crate::texture::{Closed, ImageMap};

/// What a surface looks like; a transform moves what precedes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    pub kind: TextureKind,
    /// Transforms of all of it, in written order.
    pub transforms: Vec<TransformId>,
    /// The points of a plain texture are the surface's own coordinates.
    pub uv_mapping: bool,
}

/// Kind of a [`Texture`].
#[derive(Debug, Clone, PartialEq)]
pub enum TextureKind {
    Plain {
        pigment: PigmentId,
        normal: Option<NormalId>,
        finish: FinishId,
    },
    /// Textures over the values of a pattern, sorted by value.
    Blend {
        pattern: Box<Pattern>,
        steps: Vec<Step>,
        entries: Vec<(f64, TextureId)>,
    },
    /// At least two, the last on top.
    Layers(Vec<TextureId>),
}

impl TextureKind {
    /// Returns the pigment of a plain texture; of others, the black one.
    pub fn first_pigment(&self) -> PigmentId {
        match self {
            Self::Plain { pigment, .. } => *pigment,
            Self::Blend { .. } | Self::Layers(_) => PigmentId(0),
        }
    }

    /// Returns the normal of a plain texture.
    pub fn first_normal(&self) -> Option<NormalId> {
        match self {
            Self::Plain { normal, .. } => *normal,
            Self::Blend { .. } | Self::Layers(_) => None,
        }
    }

    /// Returns the finish of a plain texture; of others, the default one.
    pub fn first_finish(&self) -> FinishId {
        match self {
            Self::Plain { finish, .. } => *finish,
            Self::Blend { .. } | Self::Layers(_) => FinishId(0),
        }
    }
}

impl Texture {
    /// Returns a texture of one pigment and one finish.
    pub fn plain(pigment: PigmentId, finish: FinishId) -> Self {
        let kind = TextureKind::Plain { pigment, normal: None, finish };
        Self { kind, transforms: Vec::new(), uv_mapping: false }
    }

    /// Replaces the pigment.
    pub fn set_pigment(&mut self, pigment: PigmentId) {
        let (normal, finish) = (self.kind.first_normal(), self.kind.first_finish());
        self.kind = TextureKind::Plain { pigment, normal, finish };
    }

    /// Replaces the finish.
    pub fn set_finish(&mut self, finish: FinishId) {
        let (pigment, normal) = (self.kind.first_pigment(), self.kind.first_normal());
        self.kind = TextureKind::Plain { pigment, normal, finish };
    }

    /// Replaces the normal.
    pub fn set_normal(&mut self, normal: NormalId) {
        let (pigment, finish) = (self.kind.first_pigment(), self.kind.first_finish());
        self.kind = TextureKind::Plain { pigment, normal: Some(normal), finish };
    }
}

/// A pattern with its parameters, and what follows its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    pub source: Source,
    /// The pattern's word with its values.
    pub site: Site,
    pub modifiers: Modifiers,
}

/// What follows the values of a pattern, whichever it is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Modifiers {
    pub setting: Setting,
    pub layers: Layers,
    /// `turbulence`, by axis.
    pub turbulence: Option<Vector>,
    /// `None`: the pattern's own.
    pub wave: Option<WaveKind>,
    pub frequency: Option<f64>,
    pub phase: Option<f64>,
    /// Points are the surface's own coordinates.
    pub uv_mapping: bool,
}

/// The layers of turbulence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layers {
    pub octaves: f64,
    pub lambda: f64,
    pub omega: f64,
}

impl Default for Layers {
    fn default() -> Self {
        Self { octaves: 6.0, lambda: 2.0, omega: 0.5 }
    }
}

/// Where the values of a pattern come from.
#[derive(Debug, Clone, PartialEq)]
pub enum Source {
    Kind(Kind),
    Function(Arc<Closed>),
    /// The grey of a pigment.
    Pigment(PigmentId),
    /// A picture: its values, or its colours.
    Image(Arc<ImageMap>),
    /// A picture whose values are the numbers of textures: `material_map`.
    Material(Arc<ImageMap>),
    Density(Arc<Grid>),
    Object(Region),
    Slope(Slope),
    Aoi,
    /// The mean of all entries of its map.
    Average,
}

impl Source {
    /// Returns its word in the language.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Kind(kind) => kind.word(),
            Self::Function(_) => "function",
            Self::Pigment(_) => "pigment_pattern",
            Self::Image(_) => "image_pattern",
            Self::Material(_) => "material_map",
            Self::Density(_) => "density_file",
            Self::Object(_) => "object",
            Self::Slope(_) => "slope",
            Self::Aoi => "aoi",
            Self::Average => "average",
        }
    }

    /// Returns the wave and the frequency that its word sets; `None` for what it leaves as it is.
    pub fn own_wave(&self) -> (Option<WaveKind>, Option<f64>) {
        let wave = match self {
            Self::Kind(kind) => Some(kind.wave()).filter(|wave| *wave != WaveKind::Ramp),
            _ => None,
        };
        let is_picture = matches!(self, Self::Image(_) | Self::Material(_));
        (wave, (is_picture || self.list().is_some()).then_some(0.0))
    }

    /// Returns the number of colours of a pattern that takes a list.
    pub fn list(&self) -> Option<usize> {
        match self {
            Self::Kind(kind) => kind.list(),
            Self::Object(_) => Some(2),
            _ => None,
        }
    }
}

/// What moves a pattern; the first written is nearest to the pattern.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    Transform(TransformId),
    Warp(Warp),
}

/// A `pigment`, as written.
#[derive(Debug, Clone, PartialEq)]
pub struct Pigment {
    pub kind: PigmentKind,
    /// In written order.
    pub steps: Vec<Step>,
    pub site: Site,
    /// The first colour that lets light through.
    pub clear: Option<Site>,
    /// Its colours are those of its pattern, as none are written.
    pub has_own_colors: bool,
    /// Replaces it where a quick picture is asked for.
    pub quick_color: Option<Color>,
}

impl Pigment {
    /// Returns its site; `None` for the default, whose span is empty.
    pub fn written(&self) -> Option<Site> {
        Some(self.site).filter(|site| site.span.start < site.span.end)
    }

    /// Returns the site of its pattern, if it has one.
    pub fn pattern(&self) -> Option<&Pattern> {
        match &self.kind {
            PigmentKind::Patterned { pattern, .. } => Some(pattern),
            PigmentKind::Color(_) | PigmentKind::Faces(_) => None,
        }
    }
}

/// Bumps that do not move the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Normal {
    pub kind: NormalKind,
    /// In written order.
    pub steps: Vec<Step>,
    pub site: Site,
    /// `no_bump_scale`.
    pub keeps_depth: bool,
}

/// Kind of a [`Normal`].
#[derive(Debug, Clone, PartialEq)]
pub enum NormalKind {
    /// Bumps of a pattern.
    Bumps {
        pattern: Box<Pattern>,
        /// How steep they are.
        amount: f64,
        accuracy: f64,
        /// Value, height and slope of each entry of a `slope_map`, sorted by value.
        slopes: Vec<[f64; 3]>,
    },
    /// Bumps of the picture that is the pattern's source: `bump_map`.
    Image { pattern: Box<Pattern>, amount: f64 },
    /// Normals over a pattern, sorted by value; for `average`, each with its weight.
    Map { pattern: Box<Pattern>, entries: Vec<(f64, NormalId)> },
}

impl NormalKind {
    pub fn pattern(&self) -> &Pattern {
        match self {
            Self::Bumps { pattern, .. }
            | Self::Image { pattern, .. }
            | Self::Map { pattern, .. } => pattern,
        }
    }
}

/// Kind of a [`Pigment`].
#[derive(Debug, Clone, PartialEq)]
pub enum PigmentKind {
    Color(Color),
    Patterned {
        pattern: Box<Pattern>,
        colors: Colors,
    },
    /// Each face of the mesh has its own of these, see `mesh::Face::paint`. At least one.
    Faces(Arc<[Color]>),
}

impl PigmentKind {
    /// Returns its own colours, without their map values; those of pigments in its map are not included.
    pub fn colors(&self) -> impl Iterator<Item = Color> {
        let (some, map) = match self {
            Self::Color(color) => (std::slice::from_ref(color), &[][..]),
            Self::Patterned { colors: Colors::Map(map), .. } => (&[][..], map.0.as_slice()),
            Self::Patterned { colors: Colors::Pigments(_) | Colors::Image, .. } => {
                (&[][..], &[][..])
            }
            Self::Faces(colors) => (&colors[..], &[][..]),
        };
        some.iter().copied().chain(map.iter().map(|(_, color)| *color))
    }
}

/// What lies over the values of a pattern.
#[derive(Debug, Clone, PartialEq)]
pub enum Colors {
    Map(ColorMap),
    /// Sorted by value; for `average`, each with its weight.
    Pigments(Vec<(f64, PigmentId)>),
    /// Those of the pattern's picture: `image_map`.
    Image,
}

impl Colors {
    /// Returns the only colour, if there is but one.
    pub fn lone_color(&self) -> Option<Color> {
        match self {
            Self::Map(map) => map.lone_color(),
            Self::Pigments(_) | Self::Image => None,
        }
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

    /// Black to white.
    pub fn gray() -> Self {
        Self(vec![(0.0, Color::BLACK), (1.0, Color::WHITE)])
    }
}
