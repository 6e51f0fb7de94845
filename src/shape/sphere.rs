//! Sphere: |P − C| = r. Outward is away from the centre.

use crate::math::Vector;

/// **Invariant:** `radius` > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    pub centre: Vector,
    pub radius: f64,
}
