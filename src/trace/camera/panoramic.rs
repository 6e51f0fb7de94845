//! The panoramic camera: half a sphere of longitudes and latitudes, stretched along the camera's vectors.
//!
//! **Source:** POV-Ray manual, section 3.4.2.2 "Types of Projection"; measured on POV-Ray 3.7.

use std::f64::consts::PI;

use super::{Projection, sin_cos};
use crate::math::Vector;
use crate::shape::Ray;
use crate::world::Camera;

/// The screen is 180 degrees of longitude wide and 180 degrees of latitude high, on an ellipsoid whose half axes are
/// `forward`, `right` and `up`.
pub(super) struct Panoramic {
    origin: Vector,
    forward: Vector,
    right: Vector,
    up: Vector,
}

impl Panoramic {
    pub fn new(camera: &Camera) -> Self {
        let &Camera { location: origin, forward, right, up, .. } = camera;
        Self { origin, forward, right, up }
    }
}

impl Projection for Panoramic {
    fn through(&self, u: f64, v: f64) -> Option<Ray> {
        let ((sine, cosine), (above, level)) = (sin_cos(0.5 * u), sin_cos(0.5 * v));
        let direction = (self.right * sine + self.forward * cosine) * level + self.up * above;
        Some(Ray { origin: self.origin, direction })
    }

    fn film(&self, u: f64, v: f64) -> (f64, f64) {
        (PI * (0.5 - u), PI * v)
    }
}
