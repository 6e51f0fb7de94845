//! `turbulence` as a warp: moves points by noise at its place among the transformations.

use super::Warping;
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::{Rows, numbers};
use crate::noise;
use crate::pattern::parameter::parameters;

parameters! {
    /// The point p moves to p + `amount` · turbulence(p), by axis.
    ///
    /// **Source:** POV-Ray manual, section "Turbulence Warp".
    pub struct Turbulence {
        after amount: Vector = Vector::ZERO, "the amount of turbulence along each axis";
        "octaves" octaves: f64 = 6.0, "the number of layers of turbulence";
        "lambda" lambda: f64 = 2.0, "the frequency of a layer of turbulence relative to the one before";
        "omega" omega: f64 = 0.5, "the size of a layer of turbulence relative to the one before";
    }
}

impl Turbulence {
    pub fn new(amount: Vector, octaves: f64, lambda: f64, omega: f64) -> Self {
        Self { amount, octaves, lambda, omega }
    }

    /// Replaces each of the moves that the mask has a bit for by how far its point moves.
    pub(super) fn moves(&self, points: &Rows, mask: u32, moves: &mut Rows) {
        self.layers().vectors(points, mask, moves);
        for number in numbers(mask) {
            moves.set(number, self.amount * moves.at(number));
        }
    }

    fn layers(&self) -> noise::Turbulence {
        noise::Turbulence::new(self.lambda, self.omega, self.octaves)
    }
}

impl Warping for Turbulence {
    fn moved(&self, point: Vector, _error: Vector) -> (Vector, Vector) {
        // No seam of the pattern coincides with anything after that.
        (point + self.amount * self.layers().vector(point), Vector::ZERO)
    }

    fn bounds(&self, sides: [Interval; 3]) -> [Interval; 3] {
        let noise = self.layers().vector_bounds(sides);
        std::array::from_fn(|axis| sides[axis] + noise[axis] * Interval::point(self.amount[axis]))
    }
}
