//! The ultra wide angle camera: a fisheye for a rectangle.
//!
//! **Source:** POV-Ray manual, section 3.4.2.2 "Types of Projection"; measured on POV-Ray 3.7.

use std::f64::consts::TAU;

use super::{Axes, Projection, length, sin_cos};
use crate::math::Vector;
use crate::shape::Ray;
use crate::world::Camera;

/// The screen is wrapped on x² + y² + z² = x²y² + 1: x is the sine of an angle that is even across the screen, y of
/// one that is even down the screen, z the product of both cosines.
pub(super) struct UltraWideAngle {
    origin: Vector,
    axes: Axes,
    /// Across and down the screen, in turns.
    angle: [f64; 2],
}

impl UltraWideAngle {
    pub fn new(camera: &Camera, angle: f64) -> Self {
        let down = angle * (length(camera.up) / length(camera.right));
        // Beyond this an angle has no digits left.
        let down = if down < 1e100 { down } else { 0.0 };
        Self { origin: camera.location, axes: Axes::of(camera), angle: [angle, down] }
    }
}

impl Projection for UltraWideAngle {
    fn through(&self, u: f64, v: f64) -> Option<Ray> {
        let ((x, across), (y, down)) = (sin_cos(u * self.angle[0]), sin_cos(v * self.angle[1]));
        let Axes { forward, right, up } = self.axes;
        let direction = right * x + up * y + forward * (across * down);
        Some(Ray { origin: self.origin, direction })
    }
    fn film(&self, u: f64, v: f64) -> (f64, f64) {
        (TAU * u * self.angle[0], TAU * v * self.angle[1])
    }
}
