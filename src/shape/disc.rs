//! Disc: in local space, the visible part of z = 0 at distances between `hole` and 1 from the axis. In CSG it
//! acts as the surface of the half-space z ≤ 0.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.5.2.2: "The inside of a disc is the inside of the plane that contains
//! the disc"; this also applies in differences and intersections.

use super::U;
use super::local::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;

/// The part of z = 0 at distances between `hole` and 1 from the axis, in local space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// Radius of the hole, from 0 to less than 1.
    pub hole: f64,
}

impl Local for Disc {
    /// Adds the crossing with the plane z = 0, visible or not. **Error:** the line's blur there and the
    /// rounding of z, over the line's speed toward the plane less the error of that speed. A line that may be
    /// parallel has no crossing.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let (place, speed) = (ray.nearest.z, ray.direction.z);
        let t = -place / speed;
        let certain = speed.abs() - ray.turn;
        if !(t.is_finite() && certain > 0.0) {
            return;
        }
        let off = ray.blur_at(t) + 2.0 * U * place.abs();
        let error = off / certain + 4.0 * U * t.abs();
        let point = ray.at(t);
        let distance = (point.x * point.x + point.y * point.y).sqrt();
        let part = if self.hole <= distance && distance <= 1.0 { 0 } else { Met::UNSEEN };
        found.push(Met { t, error, leaving: speed > 0.0, part });
    }

    fn height(&self, _: u32, point: Vector) -> Height {
        Height { value: point.z, gradient: Vector::Z, error: 0.0 }
    }

    /// Extent of the visible part, with a margin for the rounding of a point on it.
    fn extent(&self, along: Vector) -> (f64, f64) {
        let (low, high) = self.nearest_extent(along);
        let slack = 64.0 * U * along.z.abs();
        (low - slack, high + slack)
    }

    fn nearest_extent(&self, along: Vector) -> (f64, f64) {
        let half = Vector::new(along.x, along.y, 0.0).length();
        (-half, half)
    }

    fn price(&self) -> u64 {
        6
    }

    fn reach(&self) -> f64 {
        f64::INFINITY
    }

    fn numbers(&self) -> String {
        if self.hole > 0.0 { format!(" hole {}", self.hole) } else { String::new() }
    }

    fn contains(&self, point: Vector) -> bool {
        point.z < 0.0
    }
}
