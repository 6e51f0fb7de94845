//! What the parts of an object inherit: its place, textures, interior and flags.

use super::cutaway::CutFaces;
use super::hollow::Filling;
use super::modifier::Flags;
use super::surface::Surface;
use super::transform::Affine;
use crate::scene::{InteriorId, ObjectId};
use crate::source::Site;

/// What an object inherits from those around it.
#[derive(Debug, Clone)]
pub(super) struct Inherited {
    pub world_from_here: Affine,
    /// The texture of objects that have none; its placement is in world space.
    pub surface: Surface,
    /// The texture of the inner side of objects that have none, likewise.
    pub lining: Option<Surface>,
    /// The interior of objects that have none.
    pub interior: Option<InteriorId>,
    pub flags: Flags,
    /// The outermost object whose flags hide this one from every ray.
    pub hidden_by: Option<ObjectId>,
    /// The innermost enclosing item that could be removed from the source.
    pub item: Option<Site>,
    /// One of the transforms is near-singular by itself.
    pub strained: bool,
    /// No ray hits the CSG solid that this object belongs to.
    pub unseen: bool,
    pub cut: CutFaces,
    /// The innermost light group.
    pub light_group: Option<u32>,
    /// Of an object inside of another: what fills it.
    pub filling: Option<Filling>,
}

impl Inherited {
    /// Returns what a root object inherits; `surface` is the scene's default.
    pub fn root(surface: Surface) -> Self {
        Self {
            world_from_here: Affine::IDENTITY,
            surface,
            lining: None,
            interior: None,
            flags: Flags::default(),
            hidden_by: None,
            item: None,
            strained: false,
            unseen: false,
            cut: CutFaces::default(),
            light_group: None,
            filling: None,
        }
    }
}
