//! Closed quadric: an ellipsoid written as a polynomial, and where it ends.
//!
//! **Invariant:** all of the surface lies within what is said; what is nearly open counts as open.

use super::super::U;
use crate::math::singular::singular_values;
use crate::math::{Matrix, Vector};

/// How many times as long as wide what counts as closed may be, squared: as many times a rounding is the
/// matrix's inverse off.
const MOST_STRETCHED: f64 = 1_048_576.0;
/// How often a number is rounded on the way, at most.
const ROUNDINGS: f64 = 64.0;

/// (P − centre)ᵀ · inverse⁻¹ · (P − centre) ≤ depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closed {
    centre: Vector,
    inverse: Matrix,
    /// As near as it is known, and at most.
    depths: [f64; 2],
    /// The longest half axis, and what all that was computed may be off by.
    longest: f64,
    slack: f64,
}

impl Closed {
    /// Of x², xy, xz, x, y², yz, y, z², z, 1; `None` where its inside has an end nowhere, or nearly so.
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

    /// The least and the greatest `along`·P, at most.
    pub fn extent(&self, along: Vector) -> (f64, f64) {
        self.around(along, self.half(along, self.depths[1]) + self.slack * along.length())
    }

    /// The same, as near as it is known.
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

    /// The radius of a ball around the origin that holds it.
    pub fn reach(&self) -> f64 {
        self.centre.length() + self.longest + self.slack
    }
}
