//! `black_hole`: draws a pattern towards a centre, or away from it, within a ball.

use super::Warping;
use crate::math::{Vector, elementary};
use crate::pattern::parameter::parameters;
use crate::pattern::scatter::{cell_at, numbers};

parameters! {
    /// A point at distance d from the centre moves away from it, or towards it if `inverse`, by d times
    /// strength · (1 − d/radius)^falloff, but by no more than d. So the pattern seems to move the other way.
    ///
    /// Along each axis on which `repeat` is positive, there is a black hole in each cell of a lattice.
    /// `turbulence`, times random numbers from 0 to 1, is added to each centre, also to a single one.
    ///
    /// **Source:** POV-Ray manual, section "Black Hole Warp"; measured on POV-Ray 3.7, in which a `type`
    /// other than 0 does nothing.
    pub struct BlackHole {
        after centre: Vector = Vector::ZERO, "the centre of the black hole";
        after radius: f64 = 1.0, "the radius of the black hole";
        "strength" strength: f64 = 1.0, "the strength of the black hole";
        "falloff" falloff: f64 = 2.0, "the exponent by which the strength decreases towards the radius";
        "inverse" inverse: bool = false, "whether the black hole pushes";
        "repeat" repeat: Vector = Vector::ZERO, "the size of the cells with a black hole each";
        "turbulence" turbulence: Vector = Vector::ZERO, "how far each black hole is off its place";
        "type" shape: f64 = 0.0, "the type of black hole";
    }
}

impl Warping for BlackHole {
    /// Fits the ball into its cell along each axis that repeats: moves the centre to `radius` at least, and
    /// widens the cell up to the radius beyond the centre, and turbulence beyond that.
    fn canonical(self) -> Self {
        let Self { mut centre, mut repeat, mut radius, turbulence, .. } = self;
        if self.shape.trunc() != 0.0 {
            radius = 0.0;
        }
        for axis in 0..3 {
            if repeat[axis] > 0.0 {
                centre[axis] = centre[axis].max(radius);
                let needed = centre[axis] + radius + turbulence[axis].max(0.0);
                repeat[axis] = repeat[axis].max(needed);
            } else {
                repeat[axis] = 0.0;
            }
        }
        Self { centre, repeat, radius, ..self }
    }

    fn moved(&self, point: Vector, error: Vector) -> (Vector, Vector) {
        if self.radius <= 0.0 {
            return (point, error);
        }
        let mut cell = Vector::ZERO;
        for axis in 0..3 {
            if self.repeat[axis] > 0.0 {
                cell[axis] = (point[axis] / self.repeat[axis]).floor();
            }
        }
        let mut from_centre = point - cell * self.repeat - self.centre;
        if self.turbulence != Vector::ZERO {
            from_centre -= self.turbulence * numbers(cell_at(cell));
        }
        let distance = from_centre.length();
        // Not a number where coordinates overflow.
        if distance.is_nan() || distance > self.radius {
            return (point, error);
        }
        let closeness = (self.radius - distance) / self.radius;
        let force = (elementary::pow(closeness, self.falloff) * self.strength).min(1.0);
        let step = from_centre * if self.inverse { -force } else { force };
        (point + step, Vector::ZERO)
    }
}
