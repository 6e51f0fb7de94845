//! Lowers textures of single faces of a mesh: the colours of one material, by corner.

use std::sync::Arc;

use super::finish::lower_finish;
use super::object::Inherited;
use super::texture::{Surface, lower_pigment, material};
use super::{Fault, Lowering};
use crate::diagnostic::Code;
use crate::math::placement::Map;
use crate::scene::mesh::Triangles;
use crate::scene::{self, FinishId, PigmentId, PigmentKind};
use crate::world::Pigment;

impl Surface {
    /// Returns the surface for a mesh; it is visible where a face has no texture of its own.
    fn of_faces(&self, scene: &scene::Scene, triangles: &Arc<Triangles>) -> Self {
        let Some(first) = triangles.textures.first() else { return self.clone() };
        if triangles.faces.iter().all(|face| face.paint.is_none()) {
            return self.clone();
        }
        let faces = Some(triangles.clone());
        if triangles.faces.iter().any(|face| face.paint.is_none()) {
            return Self { faces, ..self.clone() };
        }
        let scene::Texture { pigment, finish, .. } = scene.textures[first.index()];
        Self { pigment, finish, faces, ..self.clone() }
    }

    /// Returns all textures that may be visible: those of faces, in their order, and then its own.
    pub fn all(&self, scene: &scene::Scene) -> impl Iterator<Item = (PigmentId, FinishId)> {
        let textures = self.faces.iter().flat_map(|triangles| &triangles.textures);
        let of_faces = textures.map(|id| &scene.textures[id.index()]);
        let of_faces = of_faces.map(|texture| (texture.pigment, texture.finish));
        of_faces.chain([(self.pigment, self.finish)])
    }
}

impl Inherited {
    /// Returns what a mesh inherits whose faces may have textures of their own.
    pub fn of_faces(&self, scene: &scene::Scene, triangles: &Arc<Triangles>) -> Self {
        Self { surface: self.surface.of_faces(scene, triangles), ..self.clone() }
    }
}

impl Lowering<'_, '_> {
    /// Returns the World's index of the material of a mesh whose faces have textures of their own.
    pub(super) fn material_of_faces(&mut self, surface: &Surface) -> Result<u32, Fault> {
        let scene = self.scene;
        let all: Vec<_> = surface.all(scene).collect();
        let (mut colors, mut finishes) = (Vec::new(), Vec::new());
        for &(pigment, finish) in &all {
            match lower_pigment(&scene.pigments[pigment.index()].kind, Map::IDENTITY)? {
                Pigment::Color(color) => colors.push(color),
                Pigment::Patterned { .. } | Pigment::Faces(_) => return Err(unlike_faces()),
            }
            let lowered =
                lower_finish(&scene.finishes[finish.index()], scene.settings.ambient_light)?;
            if finishes.first().is_some_and(|first| *first != lowered) {
                return Err(unlike_faces());
            }
            finishes.push(lowered);
        }
        let finish = finishes.swap_remove(0);
        let pigment = lower_pigment(&PigmentKind::Faces(colors.into()), Map::IDENTITY)?;
        let origin = self.origin(surface.pigment, surface.finish);
        let index = self.index(material(pigment, finish), origin);
        for (pigment, finish) in all {
            self.note_material(index, &scene.pigments[pigment.index()], finish);
        }
        Ok(index)
    }
}

fn unlike_faces() -> Fault {
    let message =
        "faces of one mesh with patterns, or with more than one finish, are not supported yet";
    Fault::new(Code::NotSupportedYet, message)
        .label("its textures are not each of one colour, all with the same finish")
}
