//! Drops objects that their own flags hide from every ray.
//!
//! **Invariant:** pruning is exact. With `no_image`, `no_reflection` and `no_shadow` no ray hits the object:
//! no camera ray, direct or transmitted, no reflected ray (total reflection included), and no shadow ray. It
//! stays only where its interior may be visible all the same: the camera may be inside, and the scene has fog or
//! refracts light.
//!
//! **Source:** POV-Ray manual, sections 3.4.5.5.6 to 3.4.5.5.8; the exception and total reflection
//! measured on POV-Ray 3.7.

use super::Lowering;
use crate::scene::{Finish, Interior, ObjectId, ObjectKind, Scene};
use crate::shape::Shape;
use crate::world::Object;

impl Lowering<'_, '_> {
    /// Removes the object made last, and records that, unless the camera may be inside. `by` is the object on
    /// which the flags were written.
    pub(super) fn drop_unseen(&mut self, object: &Object, by: ObjectId) -> bool {
        let world = &self.world;
        // The ray origins of an orthographic camera are not checked.
        let may_hold_camera =
            !world.camera.has_one_origin() || world.contains(object, world.camera.location);
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

    /// Records that an object hidden by the flags of `by` is left out.
    pub(super) fn drop_hidden(&mut self, by: ObjectId) {
        let why = "`no_image`, `no_reflection` and `no_shadow` hide it";
        self.drop_part(self.scene.objects[by.index()].site, self.word(by), why);
    }

    /// Returns whether anything in the Scene, placed or not, refracts or absorbs light, or fog or rainbows are outside of solids.
    pub(super) fn bends_light(&self) -> bool {
        bends_light(self.scene) || self.world.has_haze()
    }

    /// Returns the keyword of an object, or of the object that it uses.
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
    let is_active = |interior: &Interior| {
        interior.ior != 1.0 || interior.fade_distance != 0.0 || interior.dispersion != 1.0
    };
    scene.interiors.iter().any(is_active) || scene.finishes.iter().any(old)
}
