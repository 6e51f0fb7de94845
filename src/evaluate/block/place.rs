//! Which words are valid in which block.

use crate::vocabulary::{Dialect, Family, Role, Word};

/// A kind of block, and the families of words that are valid in it.
#[derive(Debug, Clone, Copy)]
pub(in crate::evaluate) struct Place {
    /// The keyword that opens it; `None` for the top level of the scene.
    pub word: Option<Word>,
    pub families: &'static [Family],
    /// Valid words of other families.
    pub others: &'static [Word],
}

impl Place {
    pub const SCENE: Self = Self {
        word: None,
        families: &[
            Family::Shape,
            Family::Csg,
            Family::Camera,
            Family::Light,
            Family::Atmosphere,
            Family::Setting,
            Family::Directive,
        ],
        others: &[Word::Media],
    };
    pub const PIGMENT: Self = Self {
        word: Some(Word::Pigment),
        families: &[
            Family::Pattern,
            Family::PatternItem,
            Family::Color,
            Family::Transform,
            Family::Texture,
        ],
        others: &[
            Word::NoiseGenerator,
            Word::Exponent,
            Word::Function,
            Word::Df3,
            Word::Object,
            Word::Cubic,
        ],
    };
    pub const PATTERN: Self = Self {
        word: Some(Word::Pattern),
        families: &[Family::Pattern, Family::PatternItem, Family::Transform],
        others: Self::PIGMENT.others,
    };
    pub const NORMAL: Self = Self {
        word: Some(Word::Normal),
        families: &[Family::Pattern, Family::PatternItem, Family::Transform],
        others: &[
            Word::NormalMap,
            Word::UvMapping,
            Word::NoiseGenerator,
            Word::Accuracy,
            Word::Exponent,
            Word::Function,
            Word::Object,
            Word::Cubic,
        ],
    };
    pub const IMAGE: Self = Self {
        word: Some(Word::ImageMap),
        families: &[Family::PatternItem, Family::FileKind, Family::Color],
        others: &[Word::All, Word::UseColor, Word::UseIndex, Word::UseAlpha],
    };
    pub const WARP: Self = Self {
        word: Some(Word::Warp),
        families: &[Family::PatternItem],
        others: &[
            Word::Cubic,
            Word::Cylindrical,
            Word::Planar,
            Word::Spherical,
            Word::Falloff,
            Word::Inverse,
            Word::MajorRadius,
            Word::Strength,
        ],
    };
    pub const COLOR_MAP: Self =
        Self { word: Some(Word::ColorMap), families: &[Family::Color], others: &[] };
    pub const FINISH: Self =
        Self { word: Some(Word::Finish), families: &[Family::FinishItem], others: &[] };
    pub const REFLECTION: Self = Self {
        word: Some(Word::Reflection),
        families: &[Family::FinishItem, Family::Color],
        others: &[],
    };
    pub const IRID: Self = Self {
        word: Some(Word::Irid),
        families: &[],
        others: &[Word::Thickness, Word::Turbulence],
    };
    pub const BOKEH: Self =
        Self { word: Some(Word::Bokeh), families: &[], others: &[Word::Pigment] };
    /// The `radiosity` block of an object.
    pub const RADIOSITY: Self =
        Self { word: Some(Word::Radiosity), families: &[], others: &[Word::Importance] };
    pub const TEXTURE: Self = Self {
        word: Some(Word::Texture),
        families: &[Family::Texture, Family::Transform, Family::Pattern, Family::PatternItem],
        others: &[Word::NoiseGenerator, Word::Exponent, Word::Object, Word::Cubic],
    };
    pub const DEFAULT: Self = Self {
        word: Some(Word::Default),
        families: &[Family::Texture, Family::Setting, Family::Camera],
        others: &[],
    };
    pub const INTERIOR: Self = Self {
        word: Some(Word::Interior),
        families: &[Family::Interior],
        // Supported for lights.
        others: &[Word::FadeDistance, Word::FadePower],
    };
    pub const MATERIAL: Self = Self {
        word: Some(Word::Material),
        families: &[Family::Transform],
        others: &[Word::Texture, Word::Interior, Word::InteriorTexture],
    };
    pub const TRANSFORM: Self =
        Self { word: Some(Word::TransformWord), families: &[Family::Transform], others: &[] };
    pub const CAMERA: Self = Self {
        word: Some(Word::Camera),
        families: &[Family::Camera, Family::Transform, Family::PatternItem, Family::Texture],
        others: &[Word::Cylinder, Word::Spherical],
    };
    pub const LIGHT: Self = Self {
        word: Some(Word::LightSource),
        families: &[Family::Light, Family::Transform, Family::Color, Family::Interior],
        others: &[
            Word::Falloff,
            Word::Cylinder,
            Word::Orient,
            Word::NoImage,
            Word::NoReflection,
            Word::Photons,
        ],
    };
    pub const BACKGROUND: Self =
        Self { word: Some(Word::Background), families: &[Family::Color], others: &[] };
    pub const SKY_SPHERE: Self = Self {
        word: Some(Word::SkySphere),
        families: &[Family::Texture, Family::Transform, Family::FinishItem],
        others: &[Word::Emission],
    };
    pub const SETTINGS: Self = Self {
        word: Some(Word::GlobalSettings),
        families: &[Family::Setting, Family::Interior],
        others: &[Word::Subsurface, Word::NoiseGenerator, Word::IridWavelength],
    };

    pub const BOUNDED_BY: Self = Self {
        word: Some(Word::BoundedBy),
        families: &[Family::Shape, Family::Csg],
        others: &[Word::ClippedBy],
    };

    /// Returns the block of a shape.
    pub fn shape(word: Word) -> Self {
        const FAMILIES: &[Family] =
            &[Family::Modifier, Family::Transform, Family::Texture, Family::ShapeItem];
        const OTHERS: &[Word] = &[Word::Interior, Word::Photons, Word::Radiosity];
        Self { word: Some(word), families: FAMILIES, others: OTHERS }
    }

    /// Returns the block of a blob's component.
    pub fn component(word: Word) -> Self {
        let families = &[Family::Transform, Family::Texture];
        Self { word: Some(word), families, others: &[] }
    }

    /// Returns the block of a CSG operation: shapes and modifiers.
    pub fn csg(word: Word) -> Self {
        const FAMILIES: &[Family] = &[
            Family::Shape,
            Family::Csg,
            Family::Light,
            Family::Modifier,
            Family::Transform,
            Family::Texture,
        ];
        const OTHERS: &[Word] =
            &[Word::Hierarchy, Word::Interior, Word::Sturm, Word::Photons, Word::Radiosity];
        Self { word: Some(word), families: FAMILIES, others: OTHERS }
    }

    /// Returns the word that was probably meant by a word of the language that is not valid here.
    pub(super) fn meant(self, word: Word, has_block: bool) -> Option<Word> {
        match (self.word, word) {
            (None, Word::Sky) if has_block => Some(Word::SkySphere),
            (None, Word::Floor) if has_block => Some(Word::Plane),
            (Some(Word::GlobalSettings), Word::GammaWord) => Some(Word::AssumedGamma),
            (Some(Word::Normal), Word::ImageMap) if has_block => Some(Word::BumpMap),
            (Some(Word::Fog), Word::Density) => Some(Word::Distance),
            (Some(Word::Fog), Word::Type) => Some(Word::FogType),
            (Some(Word::LightSource), Word::NoShadow) => Some(Word::Shadowless),
            (Some(Word::LightSource), Word::LookAt) => Some(Word::PointAt),
            (Some(Word::Camera), Word::PointAt) => Some(Word::LookAt),
            // Its block in the oldest versions.
            (Some(_), Word::Refraction)
                if has_block && self.families.contains(&Family::Modifier) =>
            {
                Some(Word::Interior)
            }
            // Modellers' name for the position of an object.
            (Some(_), Word::Location) if self.families.contains(&Family::Transform) => {
                Some(Word::Translate)
            }
            _ => None,
        }
    }

    pub(in crate::evaluate) fn name(self) -> String {
        match self.word {
            Some(word) => format!("in `{}`", word.name()),
            None => "at the top level".to_owned(),
        }
    }

    /// Returns whether a word is valid: by its family, and by its block if it has one.
    pub(super) fn holds(self, word: Word) -> bool {
        // `samples` of a medium is not a setting of the scene.
        let is_of_a_setting = self.word == Some(Word::GlobalSettings)
            && home(word).is_some_and(|home| home != word && home != Word::GlobalSettings);
        let is_of_family = self.families.contains(&word.family()) && !is_of_a_setting;
        (is_of_family || self.others.contains(&word))
            && matches!(word.role(), Role::Statement)
            && word.block().is_none_or(|block| Some(block) == self.word)
    }

    /// Returns whether a word of another tool can have its equivalent here.
    pub(super) fn may_mean(self, word: &str, dialect: Dialect) -> bool {
        let is_object = word == "object" && self.word.is_none();
        let is_itself = self.word.is_some_and(|own| own.name() == word);
        let is_here = || !is_itself && self.words(dialect).any(|own| own == word);
        is_object || word == "transmit" || is_here()
    }

    /// Returns the words to suggest here.
    pub(super) fn words(self, dialect: Dialect) -> impl Iterator<Item = &'static str> {
        let fits = move |word: &&Word| {
            self.holds(**word)
                && (dialect == Dialect::Scene || word.block().is_none())
                // Of the families with one opener, only that is valid at the top level.
                && (self.word.is_some() || !is_part(**word))
                && !self.is_of_another_shape(**word)
        };
        let parts = self.parts().iter().map(|word| word.name());
        Word::ALL.iter().filter(fits).map(|word| word.name()).chain(parts)
    }

    /// Returns the shapes that are parts of this one.
    fn parts(self) -> &'static [Word] {
        match self.word {
            Some(Word::Blob) => &[Word::Sphere, Word::Cylinder],
            Some(Word::Mesh) => &[Word::Triangle, Word::SmoothTriangle],
            _ => &[],
        }
    }

    fn is_of_another_shape(self, word: Word) -> bool {
        let Some(own) = self.word.filter(|_| word.family() == Family::ShapeItem) else {
            return false;
        };
        home(word).is_some_and(|home| home != own && !is_before_modifiers(own, word))
    }
}

/// Returns whether a word is valid only in the block of its family, or after a `#`.
fn is_part(word: Word) -> bool {
    match word.family() {
        Family::Camera => word != Word::Camera,
        Family::Light => !matches!(word, Word::LightSource | Word::LightGroup),
        Family::Setting => word != Word::GlobalSettings,
        Family::Atmosphere => home(word).is_some(),
        family => family == Family::Directive,
    }
}

/// Returns whether a word and its block are valid at the top level.
pub(super) fn is_at_top_level(word: Word) -> bool {
    Place::SCENE.holds(word) && !is_part(word)
}

/// Returns whether a word's block is never an argument of an unsupported word before it. If the block around
/// both does not accept it, it is reported, although what follows an unsupported word otherwise counts as
/// part of it.
pub(super) fn stands_alone(word: Word) -> bool {
    use Word as W;
    matches!(
        word,
        W::Finish | W::Camera | W::LightSource | W::GlobalSettings | W::Background | W::Interior
    )
}

/// Returns the block to which a word belongs, if it is not the one in which it appears.
pub(super) fn home(word: Word) -> Option<Word> {
    use Word as W;
    Some(match word {
        _ if word.block().is_some() => return word.block(),
        W::IridWavelength => W::GlobalSettings,
        // Reserved for an unknown purpose.
        W::Size | W::Altitude | W::Tile2 => return None,
        W::Bumps | W::BumpMap | W::BumpSize | W::Dents | W::Facets | W::Wrinkles => W::Normal,
        W::SlopeMap | W::NormalMap | W::NoBumpScale => W::Normal,
        W::PigmentMap => W::Pigment,
        W::TextureMap => W::Texture,
        W::BlackHole | W::DistExp | W::Flip | W::Offset | W::Repeat | W::Toroidal => W::Warp,
        W::Eccentricity | W::Extinction => W::Scattering,
        W::Absorption | W::Density | W::Intervals | W::Method | W::Ratio | W::Samples => W::Media,
        W::AaLevel | W::AaThreshold | W::Scattering => W::Media,
        W::DensityMap => W::Density,
        W::Collect | W::PassThrough | W::Target => W::Photons,
        W::Autostop | W::ExpandThresholds | W::Gather | W::Spacing => W::Photons,
        W::AlwaysSample | W::Brightness | W::Count | W::ErrorBound | W::GrayThreshold => {
            W::Radiosity
        }
        W::LowErrorFactor | W::MaxSample | W::MaximumReuse | W::MinimumReuse => W::Radiosity,
        W::NearestCount | W::PretraceEnd | W::PretraceStart | W::RecursionLimit => W::Radiosity,
        W::Importance => W::Radiosity,
        W::FogAlt | W::FogOffset | W::FogType | W::Distance | W::TurbDepth => W::Fog,
        W::ArcAngle | W::FalloffAngle | W::Width => W::Rainbow,
        W::GlobalLights => W::LightGroup,
        W::FaceIndices | W::NormalIndices | W::NormalVectors | W::TextureList => W::Mesh2,
        W::UvIndices | W::VertexVectors => W::Mesh2,
        W::InsideVector => W::Mesh,
        W::AllIntersections | W::ContainedBy | W::Evaluate | W::MaxGradient | W::MaxTrace => {
            W::Isosurface
        }
        W::Precompute => W::Parametric,
        W::ConicSweep | W::LinearSweep => W::Prism,
        W::Component | W::Strength => W::Blob,
        W::Smooth | W::WaterLevel => W::HeightField,
        W::Ttf => W::Text,
        W::Flatness | W::Type | W::USteps | W::VSteps => W::BicubicPatch,
        W::Cube | W::Hypercomplex | W::MaxIteration | W::Precision | W::Quaternion | W::Slice => {
            W::JuliaFractal
        }
        _ => match word.family() {
            Family::FinishItem => W::Finish,
            Family::Color | Family::Pattern | Family::PatternItem => W::Pigment,
            Family::Camera => W::Camera,
            Family::Light => W::LightSource,
            Family::Setting => W::GlobalSettings,
            Family::Interior => W::Interior,
            _ => return None,
        },
    })
}

/// Returns whether an item is a part of a shape, and so must precede its transforms and textures.
///
/// **Source:** POV-Ray 3.7 refuses each behind a modifier (measured).
pub(super) fn is_before_modifiers(shape: Word, item: Word) -> bool {
    use Word as W;
    match shape {
        W::Cylinder | W::Cone | W::Sor => item == W::Open,
        W::Prism => matches!(
            item,
            W::Open | W::LinearSweep | W::ConicSweep | W::LinearSpline | W::CubicSpline
        ),
        W::Lathe => matches!(item, W::LinearSpline | W::CubicSpline | W::QuadraticSpline),
        W::SphereSweep => {
            matches!(item, W::Tolerance | W::LinearSpline | W::BSpline | W::CubicSpline)
        }
        W::Blob => matches!(item, W::Threshold | W::Component | W::Sphere | W::Cylinder),
        W::Mesh if matches!(item, W::Triangle | W::SmoothTriangle) => true,
        W::Union | W::Merge | W::Difference | W::Intersection => {
            matches!(item.family(), Family::Shape | Family::Csg)
                || matches!(item, W::Object | W::LightSource | W::LightGroup)
        }
        W::Isosurface | W::Parametric => matches!(
            item,
            W::ContainedBy
                | W::Threshold
                | W::Accuracy
                | W::MaxGradient
                | W::Evaluate
                | W::Open
                | W::MaxTrace
                | W::AllIntersections
                | W::Precompute
        ),
        W::Mesh | W::Mesh2 => {
            matches!(
                item,
                W::InsideVector
                    | W::VertexVectors
                    | W::NormalVectors
                    | W::UvVectors
                    | W::FaceIndices
                    | W::NormalIndices
                    | W::UvIndices
                    | W::TextureList
            ) && (shape == W::Mesh2 || item == W::InsideVector)
        }
        W::HeightField => matches!(item, W::Smooth | W::WaterLevel),
        W::BicubicPatch => matches!(item, W::Type | W::Flatness | W::USteps | W::VSteps),
        _ => false,
    }
}

/// Returns whether a word, supported or not, belongs to a block that is no part of this place: no part of a
/// light is valid in a camera, none of a texture in a finish or a pigment's map, none of an object in its
/// interior.
pub(super) fn is_of_no_part(word: Word, place: Place) -> bool {
    let of_interior = home(word) == Some(Word::Interior);
    match (place.word, word.family()) {
        (Some(Word::LightSource), Family::Camera) | (Some(Word::Texture), Family::FinishItem) => {
            true
        }
        (Some(Word::Pigment | Word::Normal), Family::FinishItem) => true,
        (Some(Word::Texture), _) if matches!(word, Word::ColorMap) => true,
        (Some(Word::GlobalSettings | Word::Finish | Word::Camera), _) => !place.holds(word),
        (Some(of), family) if matches!(of.family(), Family::Shape | Family::Csg) => {
            family == Family::FinishItem
                || of_interior
                || (of == Word::Blob && family == Family::Shape)
        }
        _ => false,
    }
}
