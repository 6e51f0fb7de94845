//! Recentres quadrics that are cones at their tips.
//!
//! Far from the tip, a line's polynomial is a sum that cancels the few digits which separate two crossings
//! near the tip; about the tip nothing cancels.

use crate::math::double::{Double, DoubleVector};
use crate::math::singular::singular_values;
use crate::math::{Matrix, Vector};

/// The largest ratio of two squares for which the tip is considered known.
const MOST_STRETCHED: f64 = 4_294_967_296.0;
/// Roundings assumed in the author's terms, each of which may move the value at the tip from 0.
const ROUNDINGS: f64 = 4.0;

/// Returns the terms x², xy, xz, x, y², yz, y, z², z, 1 about the tip of a cone, and the tip; `None` if the
/// tip is the origin already, or there is none.
///
/// The gradient is 0 at c = −½·A⁻¹·l, where A is the matrix of the squares and l the terms of degree 1. There
/// the value is l·c/2 + the constant, which for a cone is 0 up to the rounding of the terms.
pub fn about_tip(terms: &[f64]) -> Option<(Vec<f64>, DoubleVector)> {
    let &[xx, xy, xz, x, yy, yz, y, zz, z, constant] = terms else { return None };
    let linear = Vector::new(x, y, z);
    if linear == Vector::ZERO {
        return None;
    }
    // Twice A.
    let rows = [[2.0 * xx, xy, xz], [xy, 2.0 * yy, yz], [xz, yz, 2.0 * zz]].map(Vector::from_array);
    let [greatest, _, least] = singular_values(Matrix::from_cols(rows[0], rows[1], rows[2]));
    // True also for NaN.
    if !(greatest <= least * MOST_STRETCHED && least > 0.0) {
        return None;
    }
    let [a, b, c] = rows.map(DoubleVector::from);
    let (bc, ca, ab) = (b.cross(c), c.cross(a), a.cross(b));
    let determinant = a.dot(bc);
    // An ellipsoid that is a cone about its centre is a single point.
    if xx * determinant.round() > 0.0 && 4.0 * xx * yy > xy * xy {
        return None;
    }
    let sum = bc * Double::from(x) + ca * Double::from(y) + ab * Double::from(z);
    let tip = sum.map(|sum| -sum / determinant);
    let twice = DoubleVector::from(linear).dot(tip) + Double::from(constant) * Double::from(2.0);
    let far = tip.round().abs();
    let across = Vector::from_array(rows.map(|row| row.abs().dot(far)));
    let sizes = across.dot(far) + 2.0 * (linear.abs().dot(far) + constant.abs());
    let is_tip = twice.round().abs() <= ROUNDINGS * 0.5 * f64::EPSILON * sizes;
    is_tip.then(|| (vec![xx, xy, xz, 0.0, yy, yz, 0.0, zz, 0.0, 0.0], tip))
}
