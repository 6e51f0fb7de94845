//! `checker`: unit cubes of two kinds, alternating along every axis.
//!
//! A cell is half-open: a point on a lattice plane belongs to the cell on its positive side.

use crate::math::Vector;

/// 0 in the cell that starts at the origin, 1 in its six neighbours, and so on.
///
/// Exact for coordinates up to 2⁵³; beyond, every number is even and the value is constant.
#[inline]
pub fn value(point: Vector) -> f64 {
    // Parities are added, not indices: the sum of three large indices would round.
    let parity = |c: f64| {
        let half = c.floor() * 0.5;
        half != half.floor()
    };
    f64::from(parity(point.x) ^ parity(point.y) ^ parity(point.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_differ_and_cells_are_half_open() {
        assert_eq!(value(Vector::new(0.0, 0.0, 0.0)), 0.0);
        assert_eq!(value(Vector::new(-1e-9, 0.0, 0.0)), 1.0);
        assert_eq!(value(Vector::new(1.0, 0.5, 0.5)), 1.0);
        assert_eq!(value(Vector::new(1.5, -0.5, 0.5)), 0.0);
    }

    #[test]
    fn cells_beyond_two_to_the_31_still_alternate() {
        let far = 4_503_599_627_370_497.0; // 2^52 + 1
        assert_eq!(value(Vector::new(far, 0.0, 0.0)), 1.0);
        assert_eq!(value(Vector::new(far - 1.0, 0.0, 0.0)), 0.0);
    }
}
