//! Paint and texture coordinates of the corners of a mesh's faces.
//!
//! Stored separately from the faces, so that ray intersection does not load them.

use super::{Flat, Mesh};
use crate::math::Vector;

/// Lists with an entry for each face, or empty.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Skin {
    /// Indices into a list owned by the caller; [`Skin::BARE`] for a face without paint.
    pub paint: Vec<[u32; 3]>,
    /// Indices into `uvs`.
    pub places: Vec<[u32; 3]>,
    pub uvs: Vec<[f64; 2]>,
}

impl Skin {
    pub const BARE: [u32; 3] = [u32::MAX; 3];

    /// Reorders it; `order` are the former indices of the faces.
    pub(super) fn in_order(self, order: &[u32]) -> Self {
        let ordered = |list: Vec<[u32; 3]>| match list.is_empty() {
            true => list,
            false => order.iter().map(|&i| list[i as usize]).collect(),
        };
        Self { paint: ordered(self.paint), places: ordered(self.places), uvs: self.uvs }
    }
}

impl Mesh {
    /// Returns the paints of a face's corners, each with its weight at a point; `None` if the face has no
    /// paint.
    pub fn paint(&self, part: u32, point: Vector) -> Option<[(u32, f64); 3]> {
        let face = part as usize / 2;
        let paint = *self.skin.paint.get(face)?;
        let [a, b, c] = paint;
        if paint == Skin::BARE {
            return None;
        }
        let weights = match a == b && b == c {
            true => [1.0, 0.0, 0.0],
            false => self.weights(face, point)?,
        };
        Some([0, 1, 2].map(|i| (paint[i], weights[i])))
    }

    /// Returns the texture coordinates of a point of a face.
    pub fn uv(&self, part: u32, point: Vector) -> Option<[f64; 2]> {
        let face = part as usize / 2;
        let [a, b, c] = self.skin.places.get(face)?.map(|i| self.skin.uvs.get(i as usize).copied());
        let (a, b, c) = (a?, b?, c?);
        let [m, n, o] = self.weights(face, point)?;
        Some([0, 1].map(|i| a[i] * m + b[i] * n + c[i] * o))
    }

    /// Returns the barycentric coordinates of a point of a face.
    pub(super) fn weights(&self, face: usize, point: Vector) -> Option<[f64; 3]> {
        let corners = self.corners_of(self.faces.get(face)?);
        let Flat { normal, .. } = self.flat(face)?;
        let [a, b, c] = corners.map(|corner| corner - point);
        let areas = [c.cross(b), a.cross(c), b.cross(a)].map(|area| area.dot(normal).max(0.0));
        let all: f64 = areas.iter().sum();
        (all > 0.0).then(|| areas.map(|area| area / all))
    }
}
