//! The edge of a box that is a part of a solid: which of the faces there is the solid's surface.
//!
//! **Invariant:** where blocks stand flush, a ray through the seam between them meets their common face,
//! and not one of those that they touch with. Looked at only where rounding cannot tell the faces apart.

use smallvec::SmallVec;

use super::Hit;
use crate::math::Vector;
use crate::shape::{Box_, Ray, SurfacePoint};
use crate::world::World;

/// So many errors of the point from the edge, a face is looked at.
const ASIDE: f64 = 256.0;
/// And so many before and behind it.
const ACROSS: f64 = 64.0;

/// The surface at a hit of a box.
#[inline(always)]
pub(super) fn surface(world: &World, ray: &Ray, hit: &Hit, box_: &Box_) -> SurfacePoint {
    match world.objects[hit.object as usize].csg_solid {
        None => box_.surface(ray, hit.t, hit.leaving),
        Some(_) => surface_of_part(world, ray, hit, box_),
    }
}

#[inline(never)]
fn surface_of_part(world: &World, ray: &Ray, hit: &Hit, box_: &Box_) -> SurfacePoint {
    let usual = box_.surface(ray, hit.t, hit.leaving);
    let faces: SmallVec<[u32; 3]> = box_.faces_at(&usual).collect();
    if faces.len() < 2 {
        return usual;
    }
    let object = &world.objects[hit.object as usize];
    let normal = |face: u32| {
        let normal = box_.normals[(face / 2) as usize].get();
        if face.is_multiple_of(2) { normal } else { -normal }
    };
    let is_outer = |face: &u32| {
        let out = normal(*face);
        let others = faces.iter().filter(|other| *other != face);
        let away = others.fold(Vector::ZERO, |sum, other| sum - normal(*other));
        let into = (away - out * away.dot(out)).normalize_or(Vector::ZERO);
        let place = usual.point + into * (ASIDE * usual.error);
        let step = out * (ACROSS * usual.error);
        let inside = |point| world.csg_contains(object, point);
        inside(place - step) != inside(place + step)
    };
    if is_outer(&usual.face) {
        return usual;
    }
    let is_passed = |face: &&u32| (normal(**face).dot(ray.direction) > 0.0) == hit.leaving;
    match faces.iter().filter(is_passed).find(|face| is_outer(face)) {
        Some(&face) => box_.surface_of_face(face, ray, hit.t),
        None => usual,
    }
}
