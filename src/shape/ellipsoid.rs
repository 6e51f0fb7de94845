//! Ellipsoid: the unit sphere under an affine map that keeps no sphere.

use crate::math::placement::Placement;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid {
    pub placement: Placement,
}
