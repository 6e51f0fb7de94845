//! Plane: N·P = d; its inside is the half space N·P < d, and N points out of it.

use crate::math::UnitVector;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    pub normal: UnitVector,
    /// Signed: positive exactly when the origin is inside.
    pub distance: f64,
}
