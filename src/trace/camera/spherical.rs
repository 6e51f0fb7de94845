//! The spherical camera: the screen shows longitudes and latitudes.
//!
//! **Source:** POV-Ray manual, section 3.4.2.2 "Types of Projection"; measured on POV-Ray 3.7.

use std::f64::consts::TAU;

use super::{Axes, Projection, sin_cos};
use crate::math::Vector;
use crate::shape::Ray;
use crate::world::Camera;

/// A ray is `forward` turned about `right` by the latitude, and then about `up` by the longitude. If the three are at
/// right angles, a latitude is `up`'s sine and a longitude goes from `forward` to `right`.
pub(super) struct Spherical {
    origin: Vector,
    up: Vector,
    /// The part of `forward` along `right`, its other part, and where that is after a quarter turn.
    still: Vector,
    level: Vector,
    above: Vector,
    /// From left to right and from bottom to top, in turns.
    angle: [f64; 2],
}

impl Spherical {
    pub fn new(camera: &Camera, across: f64, down: f64) -> Self {
        let Axes { forward, right, up } = Axes::of(camera);
        let still = right * forward.dot(right);
        let (level, above) = (forward - still, forward.cross(right));
        Self { origin: camera.location, up, still, level, above, angle: [across, down] }
    }
}

impl Projection for Spherical {
    fn through(&self, u: f64, v: f64) -> Option<Ray> {
        let ((sine, cosine), (latitude, flat)) =
            (sin_cos(u * self.angle[0]), sin_cos(v * self.angle[1]));
        let turned = self.still + self.level * flat + self.above * latitude;
        let upright = self.up * turned.dot(self.up);
        let direction = upright + (turned - upright) * cosine + self.up.cross(turned) * sine;
        Some(Ray { origin: self.origin, direction })
    }
    fn film(&self, u: f64, v: f64) -> (f64, f64) {
        (TAU * u * self.angle[0], TAU * v * self.angle[1])
    }
}
