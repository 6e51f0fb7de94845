//! The method for most patterns: the normal leans against the slope of the pattern's value.

use crate::math::Vector;

/// The amount after the word of a pattern, and `bump_size`, where neither is written. Of several, the last
/// counts.
pub const AMOUNT: f64 = 0.5;

/// `accuracy`, where it is not written.
pub const ACCURACY: f64 = 0.02;

/// Four corners of a regular tetrahedron around the origin, at distance 1; measured on POV-Ray 3.7 with
/// patterns that are steps.
const CORNERS: [Vector; 4] = [
    Vector::new(0.0, 1.0, 0.0),
    Vector::new(2.0 * THIRD_OF_ROOT_2, -1.0 / 3.0, 0.0),
    Vector::new(-THIRD_OF_ROOT_2, -1.0 / 3.0, ROOT_OF_TWO_THIRDS),
    Vector::new(-THIRD_OF_ROOT_2, -1.0 / 3.0, -ROOT_OF_TWO_THIRDS),
];

const THIRD_OF_ROOT_2: f64 = std::f64::consts::SQRT_2 / 3.0;
const ROOT_OF_TWO_THIRDS: f64 = 0.816_496_580_927_726;

/// Weight of the differences. The sum over the corners is 4/3 of the gradient, so a slope of 1 turns a normal
/// as steeply as a slope of 2/15 of a real surface.
const STRENGTH: f64 = 0.1;

/// Returns the vector to add to a normal of length 1 for an amount of 1: the negative gradient of `value` at
/// `point`, times 2/15.
///
/// `values` are those at distance `accuracy` from `point` in the space of the pattern. Warps and turbulence
/// are applied to `point` before, not to the samples. Zero for an accuracy of 0, where POV-Ray 3.7 renders
/// black.
///
/// **Source:** POV-Ray manual, section 3.4.6.2.2.1 "Normals, Accuracy"; measured on POV-Ray 3.7.
pub fn displacement(
    point: Vector,
    accuracy: f64,
    values: impl FnOnce([Vector; 4]) -> [f64; 4],
) -> Vector {
    let weight = -STRENGTH / accuracy;
    if !weight.is_finite() {
        return Vector::ZERO;
    }
    let values = values(CORNERS.map(|corner| point + corner * accuracy));
    // Where all values are the same, no rounding tilts the normal.
    let base = values[0];
    let sum = |sum, (corner, value)| sum + corner * (value - base);
    CORNERS.into_iter().zip(values).fold(Vector::ZERO, sum) * weight
}
