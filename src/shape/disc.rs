//! Disc: z = 0 between `hole` and 1 from the axis of its own space, as far as it is seen. It is the
//! surface of the half space z ≤ 0, which is what it means to other solids.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.5.2.2: "The inside of a disc is the inside of the plane that
//! contains the disc"; so it is in differences and intersections there.

use super::U;
use super::body::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// From 0 to less than 1.
    pub hole: f64,
}

impl Local for Disc {
    /// The crossing with the plane z = 0, seen or not. **Error:** the line's blur there, and the
    /// rounding of z, over its speed toward the plane, less what that may be off by: no crossing is
    /// told of a line that may as well be parallel.
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

    /// Of what is seen, with room for the rounding of a point on it.
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
