//! Axis-aligned bounding boxes of shapes.
//!
//! **Invariant:** bounds that are rounded outward contain every point of the shape that a ray can hit.

use super::U;
use crate::math::Vector;

/// An axis-aligned box that contains a shape; a side is at ∞ where the shape is unbounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    pub low: Vector,
    pub high: Vector,
}

/// How bounds are rounded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rounding {
    /// To the nearest known values, for display.
    Nearest,
    /// Outward, by all rounding that an intersection with the shape may involve; for searches.
    Outward,
}

impl Bounds {
    pub const NOWHERE: Self = Self { low: Vector::INFINITY, high: Vector::NEG_INFINITY };
    pub const EVERYWHERE: Self = Self { low: Vector::NEG_INFINITY, high: Vector::INFINITY };

    /// Returns the box from `low` to `high` relative to `centre`. With [`Rounding::Outward`], it grows by
    /// `slack`, which covers the rounding of the arguments, and by a margin for the sums here.
    pub(super) fn around(
        centre: Vector,
        [low, high]: [Vector; 2],
        slack: Vector,
        rounding: Rounding,
    ) -> Self {
        let room = match rounding {
            Rounding::Nearest => Vector::ZERO,
            Rounding::Outward => {
                let size = centre.abs() + low.abs().max(high.abs());
                slack + size * (8.0 * U)
            }
        };
        Self { low: centre + low - room, high: centre + high + room }
    }

    pub fn union(&self, other: &Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    pub fn intersection(&self, other: &Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    pub fn is_empty(&self) -> bool {
        self.low.cmpgt(self.high).any()
    }

    pub fn is_finite(&self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    pub fn contains(&self, point: Vector) -> bool {
        self.low.cmple(point).all() && point.cmple(self.high).all()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::UnitVector;
    use crate::shape::Plane;

    #[test]
    fn a_half_space_ends_where_its_plane_lies_across_an_axis() {
        let half = |x: f64, y: f64, z: f64, distance: f64| {
            let normal = UnitVector::from_unit(Vector::new(x, y, z));
            Plane { normal, distance }.bounds(Rounding::Nearest)
        };
        let below = half(0.0, 1.0, -0.0, 2.0);
        assert_eq!(below, Bounds { high: Bounds::EVERYWHERE.high.with_y(2.0), ..below });
        assert_eq!(below.low, Bounds::EVERYWHERE.low);
        let above = half(0.0, 0.0, -1.0, 3.0);
        assert_eq!(above, Bounds { low: Bounds::EVERYWHERE.low.with_z(-3.0), ..above });
        assert_eq!(above.high, Bounds::EVERYWHERE.high);
        // The second is 1 long, as far as numbers tell.
        for askew in [half(0.6, 0.8, 0.0, 1.0), half(1.0, 1e-9, 0.0, 1.0)] {
            assert_eq!(askew, Bounds::EVERYWHERE);
        }
    }

    #[test]
    fn rounded_outward_bounds_hold_the_nearest() {
        let sides = [Vector::new(-1.0, -0.1, 0.0), Vector::new(1.0, 0.3, 0.0)];
        let bounds = |rounding| Bounds::around(Vector::splat(0.1), sides, Vector::ZERO, rounding);
        let (nearest, outward) = (bounds(Rounding::Nearest), bounds(Rounding::Outward));
        assert_eq!(nearest.low.y, 0.0);
        assert!(outward.low.cmplt(nearest.low).all() && nearest.high.cmplt(outward.high).all());
    }
}
