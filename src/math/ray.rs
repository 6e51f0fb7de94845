//! Rays, and their closest approach to a point.

use super::Vector;

/// A half-line: `origin + t · direction`, t > 0.
///
/// The error bounds of crossings also hold for the intended direction, as long as each component of
/// `direction` is within 2 roundoffs of it. A ray aimed at a point therefore crosses surfaces through that
/// point there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    pub origin: Vector,
    /// Unit length, within rounding.
    pub direction: Vector,
}

impl Ray {
    #[inline]
    pub fn at(&self, t: f64) -> Vector {
        self.origin + self.direction * t
    }

    /// Returns the ray relative to its closest approach to `centre`.
    ///
    /// Curved shapes start from this so that the terms they square have the size of the shape, not of the
    /// distance. Flat shapes do not need it: their crossings are linear in the origin, and the shift would
    /// add a rounding.
    ///
    /// **Error:** across the ray, `offset` is within 2u·(|along| + |offset|), u the roundoff; `along` is
    /// within 12u·(|along| + |offset|), as long as the direction's squared length is 1 within 8u.
    ///
    /// **Source:** E. Haines, J. Günther, T. Akenine-Möller, "Precision improvements for ray/sphere
    /// intersection", Ray Tracing Gems (2019), ch. 7.
    #[inline(always)]
    pub fn slide(&self, centre: Vector) -> Approach {
        let start = self.origin - centre;
        let along = start.dot(self.direction);
        Approach { start, along, offset: start - self.direction * along }
    }
}

/// A ray relative to a centre; see [`Ray::slide`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// Vector from the centre to the ray's origin.
    pub start: Vector,
    /// Signed distance along the ray from the closest approach to the origin: positive when the ray moves
    /// away.
    pub along: f64,
    /// Vector from the centre to the closest approach; perpendicular to the ray.
    pub offset: Vector,
}
