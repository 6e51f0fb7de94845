//! Blends of normals: `normal_map` and `average`.

use super::frame::unit;
use crate::math::Vector;

/// Returns the normal in a `normal_map` between two entries: their normals, blended linearly, of length 1.
///
/// `fraction` is that of the pattern's value between the entries, 0 … 1, as for colours. The entries are
/// results of [`Frame::entry`](super::Frame::entry) with the frame of each, of the normal and the point in
/// the space of the pattern that selects them. The turbulence and the warps of that pattern displace the
/// point of the entries, too. The amount of the block has no effect, that of an entry counts. All patterns
/// select entries by their value, also those with their own vectors. Lists of normals, as of `checker`, are
/// the same.
///
/// **Source:** POV-Ray manual, section 3.4.6.2.1 "Normal Map"; measured on POV-Ray 3.7.
pub fn between(from: Vector, to: Vector, fraction: f64, normal: Vector) -> Vector {
    unit(from * (1.0 - fraction) + to * fraction, normal)
}

/// Returns the weighted mean of the normals of `entries`, of length 1. A weight is 1 where it is not written.
///
/// A negative sum of weights turns the result around, because the sum of vectors is divided by it. The result is
/// `normal` where the sum of weights is 0 (POV-Ray 3.7 renders black there) or the vectors cancel.
///
/// **Source:** POV-Ray manual, section 3.4.7.4.1 "Average Pattern"; measured on POV-Ray 3.7.
pub fn average(entries: impl IntoIterator<Item = (f64, Vector)>, normal: Vector) -> Vector {
    let add = |(weights, sum), (weight, entry)| (weights + weight, sum + entry * weight);
    let (weights, sum) = entries.into_iter().fold((0.0, Vector::ZERO), add);
    match weights != 0.0 {
        true => unit(sum * f64::signum(weights), normal),
        false => normal,
    }
}
