//! `cubic`: the unfolded surface of a cube around the origin.

use super::Warping;
use crate::math::Vector;
use crate::pattern::parameter::parameters;

parameters! {
    /// The six faces of a cube, unfolded to a cross within 0 … 1 along x and y, as `uv_mapping` of a box does
    /// it. From left to right in the middle third: the faces towards −x, +z, +x and −z, each a quarter wide;
    /// above and below +z: +y and −y. The distance from the centre, as that of the face, becomes z. Where
    /// two faces meet the point is on the one that comes first in +z, +x, +y, −x, −y, −z.
    ///
    /// **Source:** POV-Ray manual, section "Mapping using warps"; the unfolding measured on POV-Ray 3.7.
    pub struct Cubic {}
}

impl Warping for Cubic {
    fn moved(&self, point: Vector, error: Vector) -> (Vector, Vector) {
        let Vector { x, y, z } = point;
        let far = point.abs().max_element();
        if far == 0.0 {
            return (Vector::new(0.375, 0.5, 0.0), error);
        }
        let (middle, across, up) = if z == far {
            ((0.375, 0.5), x, y)
        } else if x == far {
            ((0.625, 0.5), -z, y)
        } else if y == far {
            ((0.375, 5.0 / 6.0), x, -z)
        } else if x == -far {
            ((0.125, 0.5), z, y)
        } else if y == -far {
            ((0.375, 1.0 / 6.0), x, z)
        } else {
            ((0.875, 0.5), -x, y)
        };
        let moved = Vector::new(middle.0 + across / far / 8.0, middle.1 + up / far / 6.0, far);
        let error = error.max_element();
        (moved, Vector::new(error / far * 0.25, error / far / 3.0, error))
    }
}
