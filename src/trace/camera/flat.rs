//! The perspective and the orthographic camera: the screen is a plane.

use super::{Point, Projection, unit};
use crate::math::Vector;
use crate::shape::Ray;
use crate::world::{Camera, CameraKind};

/// Where the ray of each point (u, v) of the screen begins and where it goes: both are linear in u and v.
pub(in crate::trace) struct Flat {
    origin: Vector,
    /// What the origin moves by along u and along v.
    shift: [Vector; 2],
    direction: Vector,
    /// What the direction turns by along u and along v.
    turn: [Vector; 2],
}

impl Flat {
    pub(super) fn new(camera: &Camera) -> Self {
        let &Camera { location: origin, forward: direction, right, up, .. } = camera;
        let (screen, still) = ([right, up], [Vector::ZERO; 2]);
        let (shift, turn) = match camera.kind {
            CameraKind::Orthographic => (screen, still),
            _ => (still, screen),
        };
        Self { origin, shift, direction, turn }
    }

    /// Returns the ray through the point (`u`, `v`) of the screen.
    #[inline(always)]
    pub fn ray(&self, Point { u, v, .. }: Point) -> Ray {
        let along = |[right, up]: [Vector; 2]| right * u + up * v;
        Ray {
            origin: self.origin + along(self.shift),
            direction: unit(self.direction + along(self.turn)),
        }
    }
}

impl Projection for Flat {
    fn through(&self, u: f64, v: f64) -> Option<Ray> {
        let along = |[right, up]: [Vector; 2]| right * u + up * v;
        let (origin, direction) =
            (self.origin + along(self.shift), self.direction + along(self.turn));
        Some(Ray { origin, direction })
    }
}
