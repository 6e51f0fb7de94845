//! Textures in canonical form, and their values at points of a surface.
//!
//! A pattern blends things: colours, pigments, normals or whole textures ([`Blend`]). Nodes are trees whose
//! equal branches are shared; so a function that evaluates a pigment contains all that it needs.
//!
//! **Invariant:** no default is missing, no number is infinite; blends have at least one entry, sorted by
//! position; trees are at most `DEEPEST` nodes deep, so evaluation may recurse.

pub(crate) mod blend;
mod bounds;
pub mod density;
pub(crate) mod finish;
pub(crate) mod function;
pub mod image;
pub mod normal;
pub(crate) mod picture;
pub(crate) mod pigment;
pub(crate) mod region;
pub(crate) mod slope;
pub(crate) mod space;
mod together;
pub(crate) mod walk;

use std::collections::HashMap;
use std::sync::Arc;

use smallvec::SmallVec;

pub use self::image::ImageMap;
pub use blend::{Blend, Pattern, Source};
pub use finish::{Extras, Finish, Irid, Lobe, LobeKind, Reflection};
pub(crate) use function::Asked;
pub use function::Closed;
pub use normal::{Bumps, Normal};
pub use pigment::Pigment;
pub use slope::{Slope, Toward};
pub(crate) use space::{Paint, Place, Surroundings};
pub use space::{Space, Start, Step, Turn};
pub(crate) use together::Together;

use crate::color::Color;
use walk::Node;

/// The most nodes on a path from the root of a texture, and of a pigment, to a leaf.
pub(crate) const DEEPEST: usize = 64;

/// What a surface looks like.
#[derive(Debug, Clone, PartialEq)]
pub enum Texture {
    Plain(Plain),
    Blend(Box<Blend<Arc<Texture>>>),
    /// The mean of textures by their weights, which sum to 1.
    Average {
        space: Space,
        entries: Vec<(f64, Arc<Texture>)>,
    },
    /// At least two, the last on top.
    Layers(Vec<Arc<Texture>>),
    /// Those of a mesh's faces, by corner, `shape::mesh::Skin::paint`, of a blob's components, or of the parts
    /// that a cut face shows, `world::Cutaway`. At least one; never within another.
    Faces(Vec<Arc<Texture>>),
}

/// The textures of a face, each with its share, the shares summing to 1.
pub(crate) type Shares<'a> = SmallVec<[(&'a Texture, f64); 3]>;

/// Returns the textures that count at a point of a face, a blob or a cut face. A point alone does not identify the face.
pub(crate) fn at_face<'a>(textures: &'a [Arc<Texture>], around: &dyn Surroundings) -> Shares<'a> {
    let mut shares = Shares::new();
    for (index, weight) in around.paint().unwrap_or_else(|| Paint::from_slice(&[(0, 1.0)])) {
        let Some(texture) = textures.get(index as usize).filter(|_| weight > 0.0) else { continue };
        let texture = &**texture;
        match shares.iter_mut().find(|(known, _)| std::ptr::eq(*known, texture)) {
            Some((_, share)) => *share += weight,
            None => shares.push((texture, weight)),
        }
    }
    shares
}

/// A texture without parts that are textures.
#[derive(Debug, Clone, PartialEq)]
pub struct Plain {
    pub pigment: Pigment,
    pub normal: Option<Box<Normal>>,
    pub finish: Finish,
}

// No number in them is NaN; and so `Arc` compares the pointers of shared branches before it compares what they
// contain.
impl Eq for Texture {}
impl Eq for Pigment {}
impl Eq for Normal {}

impl Texture {
    /// Returns its plain textures in written order, a shared one once.
    pub fn plains(&self) -> impl Iterator<Item = &Plain> {
        self.nodes().into_iter().filter_map(|node| match node {
            Self::Plain(plain) => Some(plain),
            _ => None,
        })
    }

    /// Returns whether any of its plain textures is as `suits` tests.
    pub fn any(&self, suits: impl Fn(&Plain) -> bool) -> bool {
        match self {
            Self::Plain(plain) => suits(plain),
            _ => self.plains().any(suits),
        }
    }

    /// Returns whether it depends on the point.
    pub fn is_patterned(&self) -> bool {
        if let Self::Plain(plain) = self {
            return plain.pigment.is_patterned();
        }
        self.nodes().into_iter().any(|node| match node {
            Self::Plain(plain) => plain.pigment.is_patterned(),
            Self::Blend(_) => true,
            Self::Average { .. } | Self::Layers(_) | Self::Faces(_) => false,
        })
    }

    /// Returns whether any part of it has layers.
    pub fn has_layers(&self) -> bool {
        let is_plain = matches!(self, Self::Plain(_));
        !is_plain && self.nodes().into_iter().any(|node| matches!(node, Self::Layers(_)))
    }

    /// Returns whether it follows the native rules; see [`Finish::seed`].
    pub fn is_seed(&self) -> bool {
        matches!(self, Self::Plain(plain) if plain.finish.seed)
    }

    /// Returns whether light passes through it anywhere: through all of its layers, or one of its entries.
    pub fn is_clear(&self) -> bool {
        self.is_clear_beside(&mut HashMap::new())
    }

    /// As [`Self::is_clear`]; `known` are the answers of textures with parts.
    fn is_clear_beside(&self, known: &mut HashMap<*const Self, bool>) -> bool {
        if let Self::Plain(plain) = self {
            return plain.pigment.is_clear();
        }
        if let Some(&clear) = known.get(&std::ptr::from_ref(self)) {
            return clear;
        }
        let mut parts = self.children().into_iter().map(|part| part.is_clear_beside(known));
        let clear = match self {
            Self::Layers(_) => parts.all(|clear| clear),
            _ => parts.any(|clear| clear),
        };
        known.insert(self, clear);
        clear
    }

    /// Calls `visit` for each of its colours, without positions in maps.
    pub fn for_each_color(&self, visit: &mut dyn FnMut(Color)) {
        match self {
            Self::Plain(plain) => plain.pigment.for_each_color(visit),
            _ => self.plains().for_each(|plain| plain.pigment.for_each_color(visit)),
        }
    }

    /// Returns its colours, without positions in maps.
    pub fn colors(&self) -> Vec<Color> {
        let mut colors = Vec::new();
        self.for_each_color(&mut |color| colors.push(color));
        colors
    }

    /// Calls `visit` for the space of each of its nodes in written order, the ones in blends included; of a
    /// shared one once.
    pub fn for_each_space<'a>(&'a self, visit: &mut dyn FnMut(&'a Space, Option<&'a Pattern>)) {
        if let Self::Plain(Plain { pigment: Pigment::Color(_), normal: None, .. }) = self {
            return;
        }
        for node in self.nodes() {
            match node {
                Self::Plain(plain) => {
                    plain.pigment.for_each_space(visit);
                    plain.normal.iter().for_each(|normal| normal.for_each_space(visit));
                }
                Self::Blend(blend) => visit(&blend.space, Some(&blend.pattern)),
                Self::Average { space, .. } => visit(space, None),
                Self::Layers(_) | Self::Faces(_) => {}
            }
        }
    }
}
