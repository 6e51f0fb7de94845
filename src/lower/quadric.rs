//! Quadrics that are cones, about their tips.
//!
//! Far from its tip, the few digits that tell the two crossings near it apart are lost in the sums that a line's
//! polynomial is made of; about the tip they are all that there is.

use crate::math::double::{Double, DoubleVector};
use crate::math::singular::singular_values;
use crate::math::{Matrix, Vector};

/// Of its squares, how many times as large one may be as another: with more, the tip is not known.
const MOST_STRETCHED: f64 = 4_294_967_296.0;
/// How often what is 0 at the tip may have been rounded, on the way to the terms that the author wrote.
const ROUNDINGS: f64 = 4.0;

/// The terms x², xy, xz, x, y², yz, y, z², z, 1 about the tip of a cone, and the tip; `None` where that is the
/// origin already, or there is none.
///
/// The gradient is 0 at c = −½·A⁻¹·l, with A the matrix of the squares and l the terms of degree 1. There the value is
/// l·c/2 + the constant: of a cone 0, to within what rounding the terms comes to.
pub fn about_tip(terms: &[f64]) -> Option<(Vec<f64>, DoubleVector)> {
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
    // An ellipsoid has no cone about its centre: there it is a point.
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
