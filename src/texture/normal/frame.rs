//! The space in which a pattern perturbs normals.
//!
//! **Invariant:** a normal is perpendicular to its surface in both spaces: it is mapped by the inverse
//! transpose of the map of directions.

use crate::math::{UnitVector, Vector};
use crate::texture::space::Turn;

/// The map of normals between a surrounding space and the space of a pattern.
///
/// By default a normal has length 1 in the space of the pattern, so a pattern that is scaled keeps its
/// angles: its bumps grow in height as well as in width. With `no_bump_scale` the normal keeps the length
/// that its map gives it, so that bumps grow in width only.
///
/// `no_bump_scale` holds for this normal and for all entries inside of it. A transformation of a texture or
/// an object is part of the map of its outermost normals.
///
/// **Source:** POV-Ray manual, section 3.4.6.2.4 "Scaling normals"; the maps are measured on POV-Ray 3.7.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    turn: Turn,
    keeps_depth: bool,
}

impl Frame {
    /// Builds a frame from the map into the space of the pattern. `keeps_depth` is `no_bump_scale`.
    pub fn new(turn: Turn, keeps_depth: bool) -> Self {
        Self { turn, keeps_depth }
    }

    /// Returns the sum of `normal` and the vector that `displacement` returns for it, both in the space of
    /// the pattern, mapped back.
    ///
    /// The result has length 1, except with `no_bump_scale`; for an entry of a map its length is its weight.
    /// Where the sum vanishes, the result is `normal`.
    pub fn entry(&self, normal: Vector, displacement: impl FnOnce(Vector) -> Vector) -> Vector {
        let inner = self.inner(normal);
        self.outer(inner + displacement(inner), normal)
    }

    /// Returns a normal of the surrounding space in the space of the pattern.
    #[inline]
    pub fn inner(&self, normal: Vector) -> Vector {
        self.length_settled(self.turn.normals * normal, normal)
    }

    /// Returns a vector of the space of the pattern in the surrounding space; `normal` where it has no direction.
    #[inline]
    pub fn outer(&self, sum: Vector, normal: Vector) -> Vector {
        self.length_settled(self.turn.directions.transpose() * sum, normal)
    }

    fn length_settled(&self, v: Vector, otherwise: Vector) -> Vector {
        match self.keeps_depth && v.is_finite() {
            true => v,
            false => unit(v, otherwise),
        }
    }
}

/// Returns the direction of `v`, or `otherwise` if it has none.
pub fn unit(v: Vector, otherwise: Vector) -> Vector {
    UnitVector::from_direction(v).map_or(otherwise, UnitVector::get)
}
