//! Isosurfaces that are nowhere: whose function is above its threshold in all of their container, or no number.

use super::Isosurface;
use crate::math::Vector;
use crate::math::interval::Interval;

/// Cells along an edge of the container that the function is tried in the middle of.
const EDGE: u32 = 8;
/// How often such a cell is halved, in all directions, to prove what its middle says; and in how many cells at
/// most bounds are tried: what takes more is not worth the time.
const HALVINGS: u32 = 4;
const MOST: u32 = 4096;

/// Why there is nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Nowhere {
    /// It is proven to be above its threshold everywhere.
    Above,
    /// It was NaN at each of so many places.
    NoNumber(u32),
}

impl Isosurface {
    /// Whether it is certain, or as good as certain, that there is nothing of it.
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

    /// Whether bounds prove it of a cell. `left` is how many more of them may be tried.
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
