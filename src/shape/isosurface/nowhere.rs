//! Detects empty isosurfaces: the function is above its threshold throughout the container, or undefined.

use super::Isosurface;
use crate::math::Vector;
use crate::math::interval::Interval;

/// Number of cells along an edge of the container; the function is sampled in the middle of each.
const EDGE: u32 = 8;
/// Maximum number of times that a cell is halved, along all axes, to prove what its middle suggests; and
/// maximum number of cells whose bounds are evaluated. More would not be worth the time.
const HALVINGS: u32 = 4;
const MOST: u32 = 4096;

/// Why an isosurface is empty.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Nowhere {
    /// The function is proven to be above its threshold everywhere.
    Above,
    /// The function was NaN at each of this many points.
    NoNumber(u32),
}

impl Isosurface {
    /// Returns why the isosurface is empty, if that is proven or nearly certain.
    pub fn nowhere(&self) -> Option<Nowhere> {
        let half = self.container.half() / f64::from(EDGE);
        let place = |i: u32| f64::from(2 * i + 1) - f64::from(EDGE);
        let middles = || {
            let rows = (0..EDGE).flat_map(|x| (0..EDGE).map(move |y| (x, y)));
            let all = rows.flat_map(|(x, y)| (0..EDGE).map(move |z| [x, y, z]));
            all.map(|cell| half * Vector::from_array(cell.map(place)))
        };
        let mut numbers = 0;
        for middle in middles() {
            let value = self.value(middle);
            if value <= 0.0 {
                return None;
            }
            numbers += u32::from(!value.is_nan());
        }
        let all = EDGE * EDGE * EDGE;
        if numbers == 0 {
            return Some(Nowhere::NoNumber(all));
        }
        let mut left = MOST;
        let is_above = |middle| self.is_above(middle, half, HALVINGS, &mut left);
        (numbers == all && middles().all(is_above)).then_some(Nowhere::Above)
    }

    /// Returns whether bounds prove that a cell is above the threshold. `left` is the remaining number of
    /// evaluations.
    fn is_above(&self, middle: Vector, half: Vector, halvings: u32, left: &mut u32) -> bool {
        if *left == 0 {
            return false;
        }
        *left -= 1;
        let along = |axis| Interval {
            low: (middle[axis] - half[axis]).next_down(),
            high: (middle[axis] + half[axis]).next_up(),
        };
        if self.bounds([0, 1, 2].map(along)).is_some_and(|all| all.value.low > 0.0) {
            return true;
        }
        halvings > 0
            && (0..8).all(|corner| {
                let side = |axis| if corner >> axis & 1 == 1 { 0.5 } else { -0.5 };
                let away = Vector::new(side(0), side(1), side(2)) * half;
                self.is_above(middle + away, half * 0.5, halvings - 1, left)
            })
    }
}
