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
        let whole = |(coordinate, error)| settled(coordinate, error).floor();
        let [w, u, v] = Self::coordinates(point, error, height).map(whole);
        Self { u, v, is_upright: w <= u + v }
    }

    /// Returns the triangle that contains all points within `reach` of `point`; `None` if there may be several.
    pub fn around(point: Vector, reach: Vector, height: f64) -> Option<Self> {
        let whole = |(coordinate, error): (f64, f64)| {
            let [low, high] = [coordinate - 2.0 * error, coordinate + 2.0 * error].map(f64::floor);
            (low == high).then_some(low)
        };
        let [w, u, v] = Self::coordinates(point, reach, height).map(whole);
        let (w, u, v) = (w?, u?, v?);
        Some(Self { u, v, is_upright: w <= u + v })
    }

    /// Returns the coordinates across the three families of sides, each with its error; a coordinate is an
    /// integer on its sides.
    #[inline]
    fn coordinates(point: Vector, error: Vector, height: f64) -> [(f64, f64); 3] {
        // The sums and the division round, too.
        let rounded = |coordinate: f64| coordinate.abs() * (4.0 * f64::EPSILON);
        let (v, v_error) = (point.z / height, (error.z + rounded(point.z)) / height);
        let u_error = error.x + rounded(point.x) + 0.5 * v_error;
        [(point.x + 0.5 * v, u_error), (point.x - 0.5 * v, u_error), (v, v_error)]
    }
}
