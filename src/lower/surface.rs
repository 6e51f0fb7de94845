//! The texture that an object has or inherits, and where its nodes lie.
//!
//! **Invariant:** an object's texture has a place in space for each of its slots: the outermost nodes that
//! are patterned. All transforms after a node's last warp are in the slot's place, and so a coordinate that is
//! constant over a flat face is one of the pattern's own.

use std::rc::Rc;
use std::sync::Arc;

use smallvec::SmallVec;

use super::Fault;
use super::transform::{Affine, Transforms};
use crate::scene::blob::Blob;
use crate::scene::mesh::Triangles;
use crate::scene::{
    FinishId, NormalId, PigmentId, Scene, Step, TextureId, TextureKind, TransformId,
};
use crate::source::Site;

/// A texture that is inherited down the object tree.
///
/// A part that replaces another has the whole placement among its own steps, as the Scene gives it.
#[derive(Debug, Clone)]
pub struct Surface {
    pub texture: TextureId,
    /// Replaces the texture's own.
    pub pigment: Option<PigmentId>,
    /// Replaces the texture's own.
    pub normal: Option<NormalId>,
    /// Replaces the texture's own.
    pub finish: Option<FinishId>,
    /// One for each slot; shared by all objects that inherit the surface unchanged.
    pub(super) places: Rc<SmallVec<[Slot; 1]>>,
    /// The solid whose parts have textures of their own.
    pub faces: Option<Parts>,
}

/// A solid whose parts may have textures of their own.
#[derive(Debug, Clone)]
pub enum Parts {
    Mesh(Arc<Triangles>),
    Blob(Arc<Blob>),
}

impl Parts {
    /// Returns the textures of its parts.
    pub fn textures(&self) -> &[TextureId] {
        match self {
            Self::Mesh(triangles) => &triangles.textures,
            Self::Blob(blob) => &blob.textures,
        }
    }

    /// Returns whether a part has none, so that the solid's own is visible.
    pub fn is_seen_bare(&self) -> bool {
        match self {
            Self::Mesh(triangles) => triangles.faces.iter().any(|face| face.paint.is_none()),
            Self::Blob(blob) => blob.components.iter().any(|part| part.paint.is_none()),
        }
    }

    /// Returns whether a part has one.
    pub fn is_painted(&self) -> bool {
        match self {
            Self::Mesh(triangles) => triangles.faces.iter().any(|face| face.paint.is_some()),
            Self::Blob(blob) => !blob.textures.is_empty(),
        }
    }

    /// Returns what distinguishes it from others.
    pub(super) fn key(&self) -> *const () {
        match self {
            Self::Mesh(triangles) => Arc::as_ptr(triangles).cast(),
            Self::Blob(blob) => Arc::as_ptr(blob).cast(),
        }
    }
}

/// The placement of a node of a texture.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Slot {
    /// The node's placement, in the space of the surface's current holder.
    pub place: Affine,
    /// The node's placement when it was set, and the map there from the solid's space: the shortest chain
    /// from solid to pattern, without the transforms that moved both.
    pub set_place: Affine,
    pub set_from_solid: Affine,
}

impl Slot {
    fn is_like(&self, other: &Self) -> bool {
        let same = |a: &Affine, b: &Affine| a.moves_nothing() && b.moves_nothing() || a == b;
        same(&self.place, &other.place)
            && same(&self.set_place, &other.set_place)
            && same(&self.set_from_solid, &other.set_from_solid)
    }
}

/// Returns the transforms after the last warp.
pub(super) fn tail(steps: &[Step]) -> Vec<TransformId> {
    let last_warp = steps.iter().rposition(|step| matches!(step, Step::Warp(_)));
    let after = &steps[last_warp.map_or(0, |at| at + 1)..];
    let transform = |step: &Step| match step {
        Step::Transform(id) => Some(*id),
        Step::Warp(_) => None,
    };
    after.iter().filter_map(transform).collect()
}

impl Surface {
    /// Returns the texture `id`, set in the space that `set_from_solid` maps to.
    pub fn set(
        scene: &Scene,
        transforms: &mut Transforms,
        id: TextureId,
        set_from_solid: Affine,
    ) -> Result<Self, (Fault, Site)> {
        let mut places = SmallVec::new();
        add_slots(scene, transforms, id, &[], &mut |place| {
            places.push(Slot { place, set_place: place, set_from_solid });
        })?;
        let places = Rc::new(places);
        Ok(Self { texture: id, pigment: None, normal: None, finish: None, places, faces: None })
    }

    /// Replaces the pigment.
    pub fn repaint(
        &mut self,
        scene: &Scene,
        transforms: &mut Transforms,
        id: PigmentId,
        set_from_solid: Affine,
    ) -> Result<(), (Fault, Site)> {
        let pigment = &scene.pigments[id.index()];
        let own =
            transforms.product(&tail(&pigment.steps)).map_err(|fault| (fault, pigment.site))?;
        self.pigment = Some(id);
        let at = self.places.len() - 1 - usize::from(self.has_normal(scene));
        let slot = Slot { place: own, set_place: own, set_from_solid };
        if self.places.get(at).is_some_and(|before| !before.is_like(&slot)) {
            Rc::make_mut(&mut self.places)[at] = slot;
        }
        Ok(())
    }

    /// Replaces the normal.
    pub fn bumped(
        &mut self,
        scene: &Scene,
        transforms: &mut Transforms,
        id: NormalId,
        set_from_solid: Affine,
    ) -> Result<(), (Fault, Site)> {
        let normal = &scene.normals[id.index()];
        let own = transforms.product(&tail(&normal.steps)).map_err(|fault| (fault, normal.site))?;
        let had = self.has_normal(scene);
        self.normal = Some(id);
        let places = Rc::make_mut(&mut self.places);
        if had {
            places.pop();
        }
        places.push(Slot { place: own, set_place: own, set_from_solid });
        Ok(())
    }

    /// Returns whether its last plain texture has a normal, whose slot is the last.
    fn has_normal(&self, scene: &Scene) -> bool {
        self.normal.is_some() || last_normal(scene, self.texture).is_some()
    }

    /// Replaces the finish.
    pub fn polished(self, finish: FinishId) -> Self {
        Self { finish: Some(finish), ..self }
    }

    /// Returns the same surface for a child whose own transforms compose to `child`.
    pub fn under(mut self, child: &Affine) -> Self {
        for slot in Rc::make_mut(&mut self.places) {
            slot.set_from_solid = slot.set_from_solid.after(child);
        }
        self
    }

    /// Returns the same surface in the space outside `outer`.
    pub fn within(mut self, outer: &Affine) -> Self {
        if !outer.moves_nothing() {
            for slot in Rc::make_mut(&mut self.places) {
                slot.place = outer.after(&slot.place);
            }
        }
        self
    }

    /// Returns the finish whose old `ior` and `caustics` are the object's: of layers that of the top one. In
    /// POV-Ray (measured) those in a blend of textures have no effect.
    pub fn medium(&self, scene: &Scene) -> FinishId {
        match scene.textures[self.texture.index()].kind {
            TextureKind::Blend { .. } => FinishId(0),
            TextureKind::Plain { .. } | TextureKind::Layers(_) => self.plain(scene).1,
        }
    }

    /// Returns the pigment and the finish of a texture without parts; of others, those of its last layer or
    /// entry.
    pub fn plain(&self, scene: &Scene) -> (PigmentId, FinishId) {
        let (pigment, finish) = last_plain(scene, self.texture);
        (self.pigment.unwrap_or(pigment), self.finish.unwrap_or(finish))
    }
}

/// Returns the pigment and the finish of a texture, of its last layer or entry.
pub(super) fn last_plain(scene: &Scene, mut id: TextureId) -> (PigmentId, FinishId) {
    loop {
        id = match &scene.textures[id.index()].kind {
            TextureKind::Plain { pigment, finish, .. } => return (*pigment, *finish),
            TextureKind::Blend { entries, .. } => match entries.last() {
                Some((_, last)) => *last,
                None => return (PigmentId(0), FinishId(0)),
            },
            TextureKind::Layers(layers) => match layers.last() {
                Some(last) => *last,
                None => return (PigmentId(0), FinishId(0)),
            },
        }
    }
}

/// Returns the normal of a texture, or of its last layer.
fn last_normal(scene: &Scene, mut id: TextureId) -> Option<NormalId> {
    loop {
        id = match &scene.textures[id.index()].kind {
            TextureKind::Plain { normal, .. } => return *normal,
            TextureKind::Blend { .. } => return None,
            TextureKind::Layers(layers) => *layers.last()?,
        }
    }
}

/// Calls `add` with the placement of each slot of a texture that `outer` moves.
pub(super) fn add_slots(
    scene: &Scene,
    transforms: &mut Transforms,
    id: TextureId,
    outer: &[TransformId],
    add: &mut dyn FnMut(Affine),
) -> Result<(), (Fault, Site)> {
    let texture = &scene.textures[id.index()];
    let outer = [&texture.transforms, outer].concat();
    let mut place = |steps: &[Step], site: Site| {
        let inner = transforms.product(&tail(steps)).map_err(|fault| (fault, site))?;
        let place = transforms.product(&outer).map_err(|fault| (fault, site))?;
        Ok(place.after(&inner))
    };
    match &texture.kind {
        TextureKind::Plain { pigment, normal, .. } => {
            let pigment = &scene.pigments[pigment.index()];
            add(place(&pigment.steps, pigment.site)?);
            if let Some(normal) = normal {
                let normal = &scene.normals[normal.index()];
                add(place(&normal.steps, normal.site)?);
            }
        }
        TextureKind::Blend { pattern, steps, .. } => add(place(steps, pattern.site)?),
        TextureKind::Layers(layers) => {
            for layer in layers {
                add_slots(scene, transforms, *layer, &outer, add)?;
            }
        }
    }
    Ok(())
}
