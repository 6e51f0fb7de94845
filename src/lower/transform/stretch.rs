//! Computes the stretch of an affine map without its rotation: its effect on a sphere about the origin.
//!
//! **In:** a map. **Out:** its symmetric positive part, and the inverse of that part.

use super::{Affine, Cofactors};
use crate::math::double::{Double, DoubleVector, power_of_two_near};

impl Affine {
    /// Returns whether it exchanges left and right.
    pub fn is_reflection(&self) -> bool {
        self.cofactors().is_some_and(|Cofactors { determinant, .. }| determinant.round() < 0.0)
    }

    /// Returns the linear part without its initial rotation, which does not change a sphere about the origin:
    /// the symmetric positive matrix P of M = P·Q, and its inverse. `None` if the map flattens space.
    ///
    /// Newton's iteration X ← ½(X + X⁻ᵀ) converges from M to Q, quadratically near it; it is exact from the
    /// start if each row and column has only one nonzero number.
    /// **Source:** Higham, "Computing the polar decomposition", SIAM J. Sci. Stat. Comput. 7 (1986).
    pub fn stretch(&self) -> Option<(Self, Self)> {
        let turn = if self.is_monomial() {
            let sign = |c: Double| match c.round() {
                c if c > 0.0 => Double::ONE,
                c if c < 0.0 => -Double::ONE,
                _ => Double::ZERO,
            };
            self.rows.map(|row| row.map(sign))
        } else {
            self.nearest_rotation()?
        };
        let inverse = self.checked().ok()?;
        let stretch = self.rows.map(|row| {
            let [x, y, z] = turn.map(|axis| row.dot(axis));
            DoubleVector::new(x, y, z)
        });
        let columns = inverse.columns();
        let unstretch = turn.map(|row| {
            let [x, y, z] = columns.map(|column| row.dot(column));
            DoubleVector::new(x, y, z)
        });
        let symmetric = |rows: [DoubleVector; 3]| {
            let map = Self::new(rows, DoubleVector::ZERO, self.bound());
            let half = Double::from(0.5);
            let [x, y, z] = map.columns();
            let mean = [(rows[0] + x) * half, (rows[1] + y) * half, (rows[2] + z) * half];
            Self::new(mean, map.offset, map.rounding)
        };
        Some((symmetric(stretch), symmetric(unstretch)))
    }

    /// Returns the rows of the rotation (or reflection) nearest to the linear part.
    fn nearest_rotation(&self) -> Option<[DoubleVector; 3]> {
        let half = Double::from(0.5);
        let mut near = *self;
        for _ in 0..100 {
            let Cofactors { rows, determinant } = near.cofactors()?;
            // The columns of the inverse transpose.
            let [x, y, z] = rows.map(|row| row.map(|c| c / determinant));
            let opposite = Self::new([x, y, z], near.offset, near.rounding).columns();
            // Scaling the two to one size by a power of two speeds up the first steps.
            let balance = (opposite.iter().map(|r| r.largest()).fold(0.0, f64::max)
                / near.rows.iter().map(|r| r.largest()).fold(0.0, f64::max))
            .sqrt();
            let balance =
                if (0.25..4.0).contains(&balance) { 1.0 } else { power_of_two_near(balance) };
            let mut step: f64 = 0.0;
            for (row, other) in near.rows.iter_mut().zip(opposite) {
                let grown = row.map(|c| c.times_power_of_two(balance));
                let mean = (grown + other.map(|c| c.times_power_of_two(1.0 / balance))) * half;
                step = step.max((mean - *row).largest());
                *row = mean;
            }
            near = Self::new(near.rows, near.offset, near.rounding);
            if step < Self::STEP_ROUNDING {
                break;
            }
        }
        Some(near.rows)
    }

    /// Returns whether each row and each column has exactly one nonzero number.
    fn is_monomial(&self) -> bool {
        let lone = |v: &DoubleVector| v.components().iter().filter(|c| !c.is_zero()).count() == 1;
        self.rows.iter().all(lone) && self.columns().iter().all(lone)
    }
}
