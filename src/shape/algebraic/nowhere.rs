//! Detects polynomials without a surface: their terms prove that they are positive or negative everywhere.
//!
//! A polynomial in even powers whose coefficients have one sign, and whose constant has that sign, has this
//! sign everywhere. For a quadric, squares are split off, one for each of x, y and z, until a constant is
//! left.

use std::cmp::Ordering;

use super::Algebraic;
use crate::math::interval::Interval;
use crate::math::terms::exponents;

impl Algebraic {
    /// Returns how the polynomial compares with 0 everywhere, where that is proven.
    pub fn everywhere(&self) -> Option<Ordering> {
        let negated: Vec<f64> = self.terms.iter().map(|term| -term).collect();
        let is_above = |terms: &[f64]| {
            let last = terms.last().is_some_and(|constant| *constant > 0.0);
            last && (has_even_powers(self.degree, terms) || has_squares(terms))
        };
        match (is_above(&self.terms), is_above(&negated)) {
            (true, _) => Some(Ordering::Greater),
            (_, true) => Some(Ordering::Less),
            _ => None,
        }
    }
}

/// Returns whether no term is negative anywhere.
fn has_even_powers(degree: usize, terms: &[f64]) -> bool {
    exponents(degree).zip(terms).all(|(powers, term)| {
        *term == 0.0 || *term > 0.0 && powers.iter().all(|power| power % 2 == 0)
    })
}

/// Returns whether a quadric is a sum of squares and a positive number.
fn has_squares(terms: &[f64]) -> bool {
    let &[xx, xy, xz, x, yy, yz, y, zz, z, one] = terms else { return false };
    // Twice the polynomial is (x y z 1) times this times (x y z 1).
    let rows =
        [[2.0 * xx, xy, xz, x], [xy, 2.0 * yy, yz, y], [xz, yz, 2.0 * zz, z], [x, y, z, 2.0 * one]];
    let mut rows = rows.map(|row| row.map(Interval::point));
    let is_zero = |entry: Interval| entry.single() == Some(0.0);
    for pivot in 0..3 {
        let square = rows[pivot];
        if square[pivot].low <= 0.0 {
            // It does not occur, or nothing is known.
            if square[pivot..].iter().all(|entry| is_zero(*entry)) {
                continue;
            }
            return false;
        }
        for (i, row) in rows.iter_mut().enumerate().skip(pivot + 1) {
            let share = square[i] / square[pivot];
            for (entry, factor) in row.iter_mut().zip(square).skip(pivot + 1) {
                if !is_zero(square[i]) && !is_zero(factor) {
                    *entry = *entry - share * factor;
                }
            }
        }
    }
    rows[3][3].low > 0.0
}
