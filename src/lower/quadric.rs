//! Quadrics about their centres: where the gradient is 0, which of a cone is its tip.
//!
//! Far from it, the few digits that tell the two crossings near a tip apart are lost in the sums that a line's
//! polynomial is made of; from it they are all that there is.

use crate::math::double::{Double, DoubleVector};
use crate::math::singular::singular_values;
use crate::math::{Matrix, Vector};

/// How many times as wide one way as another what has a centre may be, squared: others may be meant to have none.
const MOST_STRETCHED: f64 = 1_048_576.0;

/// The terms x², xy, xz, x, y², yz, y, z², z, 1 about the centre, and the centre; `None` where that is the origin, or
/// nowhere.
///
/// With A the matrix of the squares and l the terms of degree 1, the centre is c = −½·A⁻¹·l, and the value there
/// l·c/2 + the constant. Where that is no more than the roundings of the terms come to, of what is a cone with 0
/// there, it is 0.
pub fn about_centre(terms: &[f64]) -> Option<(Vec<f64>, DoubleVector)> {
    let &[xx, xy, xz, x, yy, yz, y, zz, z, constant] = terms else { return None };
    let linear = Vector::new(x, y, z);
    if linear == Vector::ZERO {
        return None;
    }
    // Twice A.
    let rows = [[2.0 * xx, xy, xz], [xy, 2.0 * yy, yz], [xz, yz, 2.0 * zz]].map(Vector::from_array);
    let [greatest, _, least] = singular_values(Matrix::from_cols(rows[0], rows[1], rows[2]));
    // Also where it is no number.
    if !(greatest <= least * MOST_STRETCHED && least > 0.0) {
        return None;
    }
    let [a, b, c] = rows.map(DoubleVector::from);
    let (bc, ca, ab) = (b.cross(c), c.cross(a), a.cross(b));
    let determinant = a.dot(bc);
    let [x, y, z] = [x, y, z].map(Double::from);
    let centre = (bc * x + ca * y + ab * z).map(|sum| -sum / determinant);
    let half = Double::from(0.5);
    let mut value =
        (DoubleVector::from(linear).dot(centre) * half + Double::from(constant)).round();
    if !(centre.is_finite() && value.is_finite()) {
        return None;
    }
    let far = centre.round().abs();
    let across = rows.map(|row| row.abs().dot(far));
    let sizes = 0.5 * Vector::from_array(across).dot(far) + linear.abs().dot(far) + constant.abs();
    let is_definite = xx * determinant.round() > 0.0 && 4.0 * xx * yy > xy * xy;
    if !is_definite && value.abs() <= 2.0 * f64::EPSILON * sizes {
        value = 0.0;
    }
    Some((vec![xx, xy, xz, 0.0, yy, yz, 0.0, zz, 0.0, value], centre))
}
