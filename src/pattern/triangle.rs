//! The lattice of triangles with sides of length 1 in the x-z plane, on which `hexagon` and `triangular` are
//! based.

use super::settled;
use crate::math::Vector;

/// A triangle of the lattice. With the two sides <1, 0> and <½, height> as a basis, its lower corner is
/// (u, v); its other corners are (u + 1, v) and (u, v + 1) if it is upright, else it is the triangle between
/// these two and (u + 1, v + 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Triangle {
    pub u: f64,
    pub v: f64,
    pub is_upright: bool,
}

impl Triangle {
    /// Returns the triangle that contains a point, its lower sides included; a point that its error cannot
    /// separate from a side is on it. `height` is that of a triangle.
    #[inline]
    pub fn at(point: Vector, error: Vector, height: f64) -> Self {
        // The sums and the division round, too.
        let rounded = |coordinate: f64| coordinate.abs() * (4.0 * f64::EPSILON);
        let (v, v_error) = (point.z / height, (error.z + rounded(point.z)) / height);
        let u_error = error.x + rounded(point.x) + 0.5 * v_error;
        // Each of the three families of sides has its own coordinate, which is an integer on them.
        let w = settled(point.x + 0.5 * v, u_error).floor();
        let u = settled(point.x - 0.5 * v, u_error).floor();
        let v = settled(v, v_error).floor();
        Self { u, v, is_upright: w <= u + v }
    }
}
