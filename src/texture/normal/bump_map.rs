//! `bump_map`: the heights of an image.

use super::frame::unit;
use crate::math::Vector;

/// Returns the vector to add to `normal`, of length 1 in the pattern's space, for a `bump_size` of 1.
///
/// `height` returns the height, 0 … 1, at a pixel position relative to the point: the first number is to the
/// right, the second is up. It is the grey of the image (or its index, with `use_index`), interpolated and
/// repeated as for colours. Three heights are used: that of the point, and those one pixel below it and one
/// to either side.
///
/// The axis to the right is perpendicular to the normal and to y; where the normal is along y, it is x.
/// Beyond the edge of the image is its opposite edge, even with `once`; but a point that an image with `once`
/// does not reach keeps its normal. The default of `bump_size` is that of all normals.
///
/// **Source:** POV-Ray manual, section 3.4.6.2.3 "Bump Map"; the formula is measured on POV-Ray 3.7.
pub fn displacement(normal: Vector, height: impl Fn(f64, f64) -> f64) -> Vector {
    let right = unit(normal.cross(Vector::Y), Vector::X);
    let up = right.cross(normal);
    let (here, left_below, right_below) = (height(0.0, 0.0), height(-1.0, -1.0), height(1.0, -1.0));
    right * (0.5 * (left_below - right_below)) + up * (0.5 * (left_below + right_below) - here)
}
