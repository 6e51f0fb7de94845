//! Axis-aligned bounding boxes of shapes.
//!
//! **Invariant:** bounds that are rounded outward contain every point of the shape that a ray can hit.

use super::Vector;

const U: f64 = f64::EPSILON / 2.0;

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
    pub(crate) fn around(
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

    #[test]
    fn rounded_outward_bounds_hold_the_nearest() {
        let sides = [Vector::new(-1.0, -0.1, 0.0), Vector::new(1.0, 0.3, 0.0)];
        let bounds = |rounding| Bounds::around(Vector::splat(0.1), sides, Vector::ZERO, rounding);
        let (nearest, outward) = (bounds(Rounding::Nearest), bounds(Rounding::Outward));
        assert_eq!(nearest.low.y, 0.0);
        assert!(outward.low.cmplt(nearest.low).all() && nearest.high.cmplt(outward.high).all());
    }
}
