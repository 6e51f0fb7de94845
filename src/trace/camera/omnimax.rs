//! The omnimax camera: a fisheye of 180 degrees for domes, cut off at the bottom.
//!
//! **Source:** POV-Ray manual, section 3.4.2.2 "Types of Projection"; measured on POV-Ray 3.7.

use super::{Axes, Projection, around, length, polar_angle};
use crate::math::Vector;
use crate::math::elementary::{cos, hypot, sin};
use crate::shape::Ray;
use crate::world::Camera;

/// The picture is a disc of radius 1. The angle from `forward` is an odd polynomial of the distance from the middle,
/// and nothing is seen more than 45 degrees below the middle.
pub(super) struct Omnimax {
    origin: Vector,
    axes: Axes,
    /// The width and height of the screen, in radii of the disc.
    size: [f64; 2],
    /// The height of the middle of the screen on the disc.
    rise: f64,
}

/// The width of a screen, in its heights, from which the disc ends at the top and 45 degrees below its middle.
const WIDEST: f64 = 1.283458;

/// Returns the angle from `forward` at a distance from the middle of the disc, in radians.
fn from_axis(radius: f64) -> f64 {
    let square = radius * radius;
    radius * (1.411269 + square * (square * 0.25674 - 0.09439))
}

impl Omnimax {
    pub fn new(camera: &Camera) -> Self {
        let wide = length(camera.right) / length(camera.up);
        let ratio = wide.clamp(1.0, WIDEST);
        let high = if wide > 1.0 { 2.0 / ratio } else { 2.0 / wide };
        let size = [(high * wide).min(f64::MAX), high.min(f64::MAX)];
        Self { origin: camera.location, axes: Axes::of(camera), size, rise: 1.0 - 1.0 / ratio }
    }
}

impl Projection for Omnimax {
    fn through(&self, u: f64, v: f64) -> Option<Ray> {
        let (x, y) = (u * self.size[0], v * self.size[1] + self.rise);
        let radius = hypot(x, y);
        if radius.is_nan() || radius > 1.0 {
            return None;
        }
        let angle = from_axis(radius);
        let (sine, cosine) = (sin(angle), cos(angle));
        // Upward and forward.
        let (above, ahead) = if radius == 0.0 { (0.0, 1.0) } else { (sine * y / radius, cosine) };
        let is_below = above < 0.0 && above < -ahead;
        (!is_below).then(|| Ray {
            origin: self.origin,
            direction: around(&self.axes, (sine, cosine), (x, y), radius),
        })
    }

    fn film(&self, u: f64, v: f64) -> (f64, f64) {
        let (x, y) = (u * self.size[0], v * self.size[1] + self.rise);
        (polar_angle(x, y), from_axis(hypot(x, y)))
    }
}
