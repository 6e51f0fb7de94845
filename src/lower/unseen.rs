//! Objects that their own flags hide: nothing can see them, so they are not in the World.
//!
//! **Invariant:** pruning is exact. With `no_image`, `no_reflection` and `no_shadow` no ray meets the
//! object: not the camera's, straight or through others, nor one that was mirrored (totally, too), nor one
//! toward a light. It stays only where what it is filled with may show all the same: the camera may be
//! in it, and the scene bends light.
//!
//! **Source:** POV-Ray manual, sections 3.4.5.5.6 to 3.4.5.5.8; the exception and total reflection
//! measured on POV-Ray 3.7.

use super::Lowering;
use crate::scene::{Finish, ObjectId, ObjectKind, Scene};
use crate::shape::Shape;
use crate::world::{CameraKind, Object};

impl Lowering<'_, '_> {
    /// Takes back the shape that was made last, and tells so, unless the camera may be in it. `by` is what
    /// the flags of `object` were written on.
    pub(super) fn drop_unseen(&mut self, object: &Object, by: ObjectId) -> bool {
        let world = &self.world;
        // Which points are an orthographic camera's is not asked.
        let may_hold_camera = world.camera.kind == CameraKind::Orthographic
            || world.contains(object, world.camera.location);
        if may_hold_camera && self.bends_light() {
            return false;
        }
        let world = &mut self.world;
        match object.shape {
            Shape::Sphere(last) => world.spheres.truncate(last as usize),
            Shape::Plane(last) => world.planes.truncate(last as usize),
            Shape::Box(last) => world.boxes.truncate(last as usize),
            Shape::Ellipsoid(last) => world.ellipsoids.truncate(last as usize),
            Shape::Placed(last) => world.placed.truncate(last as usize),
        }
        self.drop_hidden(by);
        true
    }

    /// Tells that what is hidden by the flags of `by` is left out.
    pub(super) fn drop_hidden(&mut self, by: ObjectId) {
        let why = "`no_image`, `no_reflection` and `no_shadow` hide it";
        self.drop_part(self.scene.objects[by.index()].site, self.word(by), why);
    }

    /// Whether anything at all, placed or not, has an index of refraction.
    pub(super) fn bends_light(&self) -> bool {
        bends_light(self.scene)
    }

    /// What kind of object it is, or uses.
    pub(super) fn word(&self, mut id: ObjectId) -> &'static str {
        loop {
            return match self.scene.objects[id.index()].kind {
                ObjectKind::Solid(ref solid) => solid.word().name(),
                ObjectKind::Union(_) => "union",
                ObjectKind::Csg { operation, .. } => operation.word().name(),
                ObjectKind::LightSource(_) => "light_source",
                ObjectKind::Use(used) => {
                    id = used;
                    continue;
                }
            };
        }
    }
}

fn bends_light(scene: &Scene) -> bool {
    let old = |finish: &Finish| match finish {
        Finish::Classic(classic) => classic.ior.is_some_and(|ior| ior != 1.0),
        Finish::Seed { .. } => false,
    };
    scene.interiors.iter().any(|interior| interior.ior != 1.0) || scene.finishes.iter().any(old)
}
