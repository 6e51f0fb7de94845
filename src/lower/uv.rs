//! Gives an object the coordinates on its surface that `uv_mapping` asks for.
//!
//! Transforms of objects do not matter to shapes with coordinates of their own.

use super::Lowering;
use super::outline;
use super::pigment::inverse_map;
use super::transform::{Affine, exact};
use crate::math::double::{Double, DoubleVector};
use crate::scene::Solid;
use crate::shape::uv::{Form, Mapping, PATCH};
use crate::texture::space::Start;
use crate::texture::{Pattern, Source, Space, Texture};
use crate::vocabulary::Word;

impl Lowering<'_, '_> {
    /// Maps the surface of the last object, which is a solid placed by `map`, if its texture asks for it.
    pub(super) fn map_surface(&mut self, solid: &Solid, map: &Affine) {
        let Some(object) = self.world.objects.last_mut() else { return };
        // That of a cut face is not known yet.
        let texture = self.world.textures.get(object.texture as usize);
        if texture.is_some_and(|texture| !asks(texture)) {
            return;
        }
        let Some((form, frame)) = form_of(solid) else { return };
        // What cannot be inverted is reported where the solid is placed.
        let Ok(map) = inverse_map(&map.after(&frame)) else { return };
        object.uv = Some(self.world.uv_mappings.len() as u32);
        self.world.uv_mappings.push(Mapping { form, map });
    }
}

/// Returns the coordinates of a solid, and the map to the space that it is written in from theirs; `None` if
/// it has none of its own.
fn form_of(solid: &Solid) -> Option<(Form, Affine)> {
    let whole = |form: Form| Some((form, Affine::IDENTITY));
    match solid {
        Solid::Sphere { centre, radius } => {
            let radius = Double::from(*radius).abs();
            let columns = [0, 1, 2].map(|axis| DoubleVector::axis(axis) * radius);
            Some((Form::Sphere, Affine::from_columns(columns, exact(*centre))))
        }
        Solid::Box { corners: [a, b] } => {
            let (low, high) = (a.min(*b), a.max(*b));
            let sides = high - low;
            // A flat box has no size across.
            let side = |axis: usize| if sides[axis] > 0.0 { sides[axis] } else { 1.0 };
            let columns = [0, 1, 2].map(|axis| DoubleVector::axis(axis) * Double::from(side(axis)));
            Some((Form::Box, Affine::from_columns(columns, exact(low))))
        }
        Solid::Torus { major, .. } => whole(Form::Torus(major.abs())),
        Solid::Ovus { top, .. } => whole(Form::Ovus(*top)),
        Solid::Lathe { spline, points } => whole(Form::Lathe(outline::pieces(*spline, points))),
        Solid::Sor { points, .. } => {
            let on_curve = &points[1..points.len() - 1];
            let heights = on_curve.iter().map(|point| point[1]).collect();
            let radius = |at: usize| on_curve.get(at).map_or(0.0, |point| point[0]);
            let ends = [radius(0), radius(on_curve.len().saturating_sub(1))];
            whole(Form::Sor { heights, ends })
        }
        Solid::BicubicPatch { uvs, .. } => {
            whole(Form::Patch(uvs.as_ref().map_or(PATCH, |uvs| **uvs)))
        }
        Solid::Parametric { .. } => whole(Form::Body),
        Solid::Triangles { word: Word::Mesh | Word::Mesh2, .. } => whole(Form::Body),
        _ => None,
    }
}

/// Returns whether a texture asks for the coordinates on the surface.
fn asks(texture: &Texture) -> bool {
    let mut found = false;
    texture.for_each_space(&mut |space, pattern| found |= asks_here(space, pattern));
    found
}

fn asks_here(space: &Space, pattern: Option<&Pattern>) -> bool {
    let inner = |pigment: &crate::texture::Pigment| {
        let mut found = false;
        pigment.for_each_space(&mut |space, pattern| found |= asks_here(space, pattern));
        found
    };
    matches!(space.start, Start::Uv | Start::UvTurned(_))
        || pattern.is_some_and(|pattern| match &pattern.source {
            Source::Pigment(pigment) => inner(pigment),
            _ => false,
        })
}
