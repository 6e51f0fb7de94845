//! Which solids fog fills: whether `hollow` counts for an object inside of others.
//!
//! The parts of a union or an operation that have no interior of their own share one, and so are all hollow or
//! none is: by the last of them, or if the whole is `hollow`. `hollow off` on the whole changes nothing.
//!
//! **Source:** POV-Ray 3.7's behaviour, measured for each order of parts, nested, and with interiors.

use super::Lowering;
use super::inherited::Inherited;
use super::modifier::Modified;
use crate::scene::{ModifierKind, ObjectId, ObjectKind};

/// What fills the parts of an object.
#[derive(Debug, Clone, Copy)]
pub(super) struct Filling {
    /// An object around them is `hollow`: so are parts with an interior of their own.
    all: bool,
    /// Whether the parts without an interior of their own are hollow.
    shared: bool,
}

impl Lowering<'_, '_> {
    /// Returns what fills an object, or its parts, from the modifiers of the object `id` and what it inherits.
    pub(super) fn filling(
        &self,
        id: ObjectId,
        modified: &Modified,
        inherited: &Inherited,
    ) -> Filling {
        let above = inherited.filling;
        let all = above.is_some_and(|above| above.all);
        let shared = match above {
            Some(above) if modified.interior.is_none() => above.shared,
            Some(_) | None => all || self.is_hollow(id),
        };
        Filling { all: all || modified.flags.hollow, shared }
    }

    /// Returns whether an object is hollow by itself: an operation as its last part that has no interior.
    fn is_hollow(&self, id: ObjectId) -> bool {
        let mut next = id;
        loop {
            let mut hollow = None;
            let object = loop {
                let object = &self.scene.objects[next.index()];
                let own = object.modifiers.iter().rev().find_map(|modifier| match modifier.kind {
                    ModifierKind::Hollow(on) => Some(on),
                    _ => None,
                });
                hollow = hollow.or(own);
                match object.kind {
                    ObjectKind::Use(used) => next = used,
                    _ => break object,
                }
            };
            let parts = match &object.kind {
                ObjectKind::Union(parts) | ObjectKind::Csg { children: parts, .. } => parts,
                _ => return hollow == Some(true),
            };
            if hollow == Some(true) {
                return true;
            }
            let last = parts.iter().rev().find(|part| self.shares_interior(**part));
            let Some(last) = last else { return false };
            next = *last;
        }
    }

    /// Returns whether a part has the interior of the object around it.
    fn shares_interior(&self, mut part: ObjectId) -> bool {
        loop {
            let object = &self.scene.objects[part.index()];
            let is_interior = |kind: ModifierKind| matches!(kind, ModifierKind::Interior(_));
            if object.modifiers.iter().any(|modifier| is_interior(modifier.kind)) {
                return false;
            }
            match object.kind {
                ObjectKind::Use(used) => part = used,
                ObjectKind::LightSource(_) => return false,
                _ => return true,
            }
        }
    }
}

impl Filling {
    pub fn is_hollow(self) -> bool {
        self.shared
    }
}
