//! Bounds of a closed quadric: an ellipsoid given by a polynomial.
//!
//! **Invariant:** the bounds contain the entire surface; nearly open quadrics count as open.

use super::super::U;
use crate::math::singular::singular_values;
use crate::math::{Matrix, Vector};

/// Maximum squared ratio of length to width for a quadric that counts as closed; the inverse of the matrix is
/// off by this many roundings.
const MOST_STRETCHED: f64 = 1_048_576.0;
/// Maximum number of roundings of a computed value.
const ROUNDINGS: f64 = 64.0;

/// The ellipsoid (P − centre)ᵀ · inverse⁻¹ · (P − centre) ≤ depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closed {
    centre: Vector,
    inverse: Matrix,
    /// Best estimate, and upper bound.
    depths: [f64; 2],
    /// The longest half axis, and the error bound of all computed values.
    longest: f64,
    slack: f64,
}

impl Closed {
    /// Builds it from the coefficients of x², xy, xz, x, y², yz, y, z², z, 1; `None` if the inside is
    /// unbounded, or nearly so.
    pub fn of(terms: &[f64]) -> Option<Self> {
        let &[xx, xy, xz, x, yy, yz, y, zz, z, constant] = terms else { return None };
        let row = Vector::new;
        let (a, b, c) =
            (row(xx, 0.5 * xy, 0.5 * xz), row(0.5 * xy, yy, 0.5 * yz), row(0.5 * xz, 0.5 * yz, zz));
        let form = Matrix::from_cols(a, b, c);
        let [greatest, _, least] = singular_values(form);
        let rises = xx > 0.0 && xx * yy - 0.25 * xy * xy > 0.0 && form.determinant() > 0.0;
        // Also where it is no number.
        if !(rises && greatest <= least * MOST_STRETCHED && greatest.is_finite()) {
            return None;
        }
        let room = ROUNDINGS * U * (greatest / least);
        let inverse = form.inverse();
        let linear = row(x, y, z);
        let centre = inverse * linear * -0.5;
        let depth = -0.5 * centre.dot(linear) - constant;
        // As if all that it is made of added up.
        let most = 0.25 * linear.length_squared() / least + constant.abs();
        let depths = [depth, depth + room * most].map(|depth| depth.max(0.0));
        let longest = (depths[1] / least).sqrt();
        let slack = room * (longest + linear.length() / least);
        let closed = Self { centre, inverse, depths, longest, slack };
        (closed.centre.is_finite() && longest.is_finite() && slack.is_finite()).then_some(closed)
    }

    /// Returns bounds on the minimum and maximum of `along`·P.
    pub fn extent(&self, along: Vector) -> (f64, f64) {
        self.around(along, self.half(along, self.depths[1]) + self.slack * along.length())
    }

    /// Returns the best estimate of [`Self::extent`].
    pub fn nearest_extent(&self, along: Vector) -> (f64, f64) {
        self.around(along, self.half(along, self.depths[0]))
    }

    fn half(&self, along: Vector, depth: f64) -> f64 {
        (along.dot(self.inverse * along) * depth).max(0.0).sqrt()
    }

    fn around(&self, along: Vector, half: f64) -> (f64, f64) {
        let middle = along.dot(self.centre);
        (middle - half, middle + half)
    }

    /// Returns the radius of a sphere around the origin that contains it.
    pub fn reach(&self) -> f64 {
        self.centre.length() + self.longest + self.slack
    }
}
