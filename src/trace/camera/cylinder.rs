//! The cylindrical cameras: a screen that is bent in one direction and straight in the other.
//!
//! **Source:** POV-Ray manual, section 3.4.2.2 "Types of Projection"; measured on POV-Ray 3.7.

use std::f64::consts::TAU;

use super::{Axes, Projection, length, sin_cos};
use crate::math::Vector;
use crate::shape::Ray;
use crate::world::Camera;

/// A cylinder of radius 1. Rays go through its axis, all through one point of it or each straight out.
pub(super) struct Cylinder {
    origin: Vector,
    /// What is seen in the middle of the bent side, and a quarter turn from it; length 1.
    forward: Vector,
    aside: Vector,
    /// The straight side.
    along: Vector,
    upright: bool,
    moving: bool,
    /// Of the bent side, in turns.
    angle: f64,
}

impl Cylinder {
    pub fn new(camera: &Camera, upright: bool, moving: bool, angle: f64) -> Self {
        let Axes { forward, right, up } = Axes::of(camera);
        let (aside, along) = match upright {
            true => (right, camera.up),
            false => (up, camera.right),
        };
        Self { origin: camera.location, forward, aside, along, upright, moving, angle }
    }
}

impl Projection for Cylinder {
    fn through(&self, u: f64, v: f64) -> Option<Ray> {
        let (bent, straight) = if self.upright { (u, v) } else { (v, u) };
        let (sine, cosine) = sin_cos(bent * self.angle);
        let (out, along) = (self.aside * sine + self.forward * cosine, self.along * straight);
        Some(match self.moving {
            true => Ray { origin: self.origin + along, direction: out },
            false => Ray { origin: self.origin, direction: out + along },
        })
    }
    fn film(&self, u: f64, v: f64) -> (f64, f64) {
        let side = length(self.along);
        match self.upright {
            true => (TAU * u * self.angle, v * side),
            false => (u * side, TAU * v * self.angle),
        }
    }
}
