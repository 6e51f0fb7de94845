//! Lowers interior textures: the texture of an object's inner side, and which side that is.
//!
//! **Source:** POV-Ray 3.7's behaviour, measured with each kind of shape, seen from both sides, inverse and
//! reflected.

use super::inherited::Inherited;
use super::place::next;
use super::shape::LocalFace;
use super::surface::Surface;
use super::{Fault, Lowering};
use crate::scene::Solid;
use crate::scene::outline::Point;
use crate::source::Site;
use crate::vocabulary::Word;

impl Inherited {
    /// Returns what a solid inherits whose outer side is the one that others have inside; `None` for others.
    pub fn turned(&self, solid: &Solid) -> Option<Self> {
        let lining = self.lining.as_ref()?;
        let inverse = self.flags.inverse;
        let is_turned = match solid {
            // An inverse one has the same sides.
            Solid::Polygon { .. }
            | Solid::Polynomial { form: Word::Quadric, .. }
            | Solid::Triangles { word: Word::Triangle, .. } => inverse,
            Solid::BicubicPatch { .. } => inverse != self.world_from_here.is_reflection(),
            Solid::Triangles { word: Word::SmoothTriangle, triangles } => {
                triangles.is_turned() != inverse
            }
            Solid::Lathe { points, .. } => match (points.first(), points.last()) {
                (Some([_, first]), Some([_, last])) => last < first,
                (None, _) | (_, None) => false,
            },
            Solid::Prism { points, .. } => area(points) < 0.0,
            _ => false,
        };
        is_turned.then(|| {
            let (surface, lining) = (lining.clone(), Some(self.surface.clone()));
            Self { surface, lining, ..self.clone() }
        })
    }
}

/// Returns twice the area of an outline, positive if it turns left.
fn area(points: &[Point]) -> f64 {
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    pairs.map(|([a, b], [c, d])| a * d - c * b).sum()
}

impl Lowering<'_, '_> {
    /// Returns the World's index of the texture of an object's inner side.
    pub(super) fn lining(
        &mut self,
        surface: &Surface,
        faces: &[LocalFace],
        casts_shadow: bool,
        site: Site,
    ) -> Result<u32, Fault> {
        let lining = self.coat(surface, faces, site)?;
        if casts_shadow {
            self.note_filters(lining.texture, surface);
        }
        let known = self.world.linings.iter().rposition(|known| *known == lining);
        Ok(known.map_or_else(|| next(&mut self.world.linings, lining), |known| known as u32))
    }
}
