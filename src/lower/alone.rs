//! Lowers single parts of a Scene, for the author's functions that evaluate them at points.
//!
//! **Out:** the same as in a World, or a diagnostic if the part cannot be built.

use super::pigment::{Branches, Nodes};
use super::transform::Transforms;
use super::{Fault, Reporter};
use crate::diagnostic::Diagnostics;
use crate::math::Vector;
use crate::scene::{PigmentId, Scene, TransformId};
use crate::source::Site;
use crate::texture::Pigment;
use crate::texture::space::Start;

/// Returns a pigment in its World form; reports what is wrong with it.
pub fn pigment(scene: &Scene, id: PigmentId, diagnostics: &mut Diagnostics) -> Option<Pigment> {
    let transforms = &mut Transforms::new(&scene.transforms);
    let branches = &mut Branches::default();
    let lowered = Nodes { scene, transforms, branches }.pigment(id, Start::Outer, &[], 0);
    Reporter::new(scene, diagnostics).made(lowered, scene.pigments[id.index()].site)
}

/// An affine map: the three rows of its matrix, and its translation.
pub type Rows = ([Vector; 3], Vector);

/// Returns the affine map of a transform written at `site`.
pub fn rows(
    scene: &Scene,
    id: TransformId,
    site: Site,
    diagnostics: &mut Diagnostics,
) -> Option<Rows> {
    let map = Transforms::new(&scene.transforms).get(id).and_then(|map| {
        let (rows, offset) = (map.rows().map(|row| row.round()), map.offset().round());
        let finite = offset.is_finite() && rows.iter().all(|row| row.is_finite());
        finite.then_some((rows, offset)).ok_or(Fault::not_finite("this transform"))
    });
    Reporter::new(scene, diagnostics).made(map, site)
}
