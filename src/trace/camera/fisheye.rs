//! The fisheye camera: angles grow evenly from the middle of a round picture.
//!
//! **Source:** POV-Ray manual, section 3.4.2.2 "Types of Projection"; measured on POV-Ray 3.7.

use std::f64::consts::TAU;

use super::{Axes, Projection, around, length, polar_angle, sin_cos};
use crate::math::Vector;
use crate::math::elementary::hypot;
use crate::shape::Ray;
use crate::world::Camera;

/// The picture is a disc of diameter 1, and the screen |right| wide and |up| high: the angle from `forward` is the
/// distance from the middle times `angle`.
pub(super) struct Fisheye {
    origin: Vector,
    axes: Axes,
    size: [f64; 2],
    /// In turns.
    angle: f64,
}

impl Fisheye {
    pub fn new(camera: &Camera, angle: f64) -> Self {
        let size = [length(camera.right), length(camera.up)];
        Self { origin: camera.location, axes: Axes::of(camera), size, angle }
    }
}

impl Projection for Fisheye {
    fn through(&self, u: f64, v: f64) -> Option<Ray> {
        let (x, y) = (u * self.size[0], v * self.size[1]);
        let radius = hypot(x, y);
        (radius <= 0.5).then(|| Ray {
            origin: self.origin,
            direction: around(&self.axes, sin_cos(radius * self.angle), (x, y), radius),
        })
    }

    fn film(&self, u: f64, v: f64) -> (f64, f64) {
        let (x, y) = (u * self.size[0], v * self.size[1]);
        (polar_angle(x, y), TAU * self.angle * hypot(x, y))
    }
}
