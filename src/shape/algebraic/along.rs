//! Restricts a polynomial in x, y and z to a line, as a polynomial in the line's s, and computes the terms of
//! its error bounds at the same time.
//!
//! **Out:** the coefficients of 1, s, s², … of three polynomials: one with the original terms along the line
//! itself, and one with the absolute values of the terms along each of two other lines. All three go through
//! the same steps side by side. Zeros are skipped.

use super::Algebraic;
use crate::math::Vector;

/// Three lines: start + s · step.
pub struct Line {
    pub starts: [Vector; 3],
    pub steps: [Vector; 3],
}

/// One number for each of the three polynomials, padded with a 0 for processors that work on pairs.
type Side = [f64; 4];

/// Returns the number of leading zero terms in each row.
pub fn zeros(degree: usize, terms: &[f64]) -> Vec<u8> {
    let mut terms = terms;
    let lengths = (0..=degree).flat_map(|i| (0..=i).map(|j| j + 1));
    let zeros = lengths.map(|length| {
        let (row, rest) = terms.split_at(length);
        terms = rest;
        row.iter().take_while(|term| **term == 0.0).count() as u8
    });
    zeros.collect()
}

impl Algebraic {
    /// Computes them with room for so many coefficients: one more than the degree, or more.
    #[inline(never)]
    pub(super) fn along<const ROOM: usize>(&self, line: &Line) -> [[f64; ROOM]; 3] {
        let axis = |of: [Vector; 3], axis: usize| [of[0][axis], of[1][axis], of[2][axis], 0.0];
        let ways = [0, 1, 2].map(|i| (axis(line.starts, i), axis(line.steps, i)));
        let mut terms = self.terms.as_slice();
        let mut zeros = self.zeros.iter();
        let mut all = Sum::<ROOM>::NOTHING;
        for i in 0..=self.degree {
            let mut plane = Sum::NOTHING;
            for j in 0..=i {
                let (row_terms, rest) = terms.split_at(j + 1);
                terms = rest;
                plane.multiply(ways[1]);
                let zeros = zeros.next().map_or(0, |zeros| usize::from(*zeros));
                if zeros <= j {
                    let mut row = Sum::NOTHING;
                    for term in &row_terms[zeros..] {
                        row.multiply(ways[2]);
                        row.add_number(*term);
                    }
                    plane.add(&row);
                }
            }
            all.multiply(ways[0]);
            all.add(&plane);
        }
        [0, 1, 2].map(|which| {
            let mut coefficients = [0.0; ROOM];
            for (coefficient, side) in coefficients.iter_mut().zip(&all.values) {
                *coefficient = side[which];
            }
            coefficients
        })
    }
}

/// With room for no more terms, zeros are multiplied and added, too: loops of a known length keep all in registers.
const FEW_TERMS: usize = 3;

/// Three polynomials in s.
struct Sum<const ROOM: usize> {
    /// All are 0 from `length` on.
    values: [Side; ROOM],
    length: usize,
}

impl<const ROOM: usize> Sum<ROOM> {
    const NOTHING: Self = Self { values: [[0.0; 4]; ROOM], length: 0 };

    /// Multiplies by start + s · step.
    #[inline(always)]
    fn multiply(&mut self, (start, step): (Side, Side)) {
        if self.length == 0 {
            return;
        }
        let last = if ROOM <= FEW_TERMS { ROOM - 1 } else { self.length };
        for k in (1..=last).rev() {
            let before = self.values[k - 1];
            for (i, value) in self.values[k].iter_mut().enumerate() {
                *value = *value * start[i] + before[i] * step[i];
            }
        }
        for (value, start) in self.values[0].iter_mut().zip(start) {
            *value *= start;
        }
        self.length += 1;
    }

    #[inline(always)]
    fn add_number(&mut self, term: f64) {
        let size = term.abs();
        for (value, term) in self.values[0].iter_mut().zip([term, size, size, 0.0]) {
            *value += term;
        }
        self.length = self.length.max(1);
    }

    #[inline(always)]
    fn add(&mut self, more: &Self) {
        let count = if ROOM <= FEW_TERMS { ROOM } else { more.length };
        for (value, more) in self.values.iter_mut().zip(&more.values[..count]) {
            for (value, more) in value.iter_mut().zip(more) {
                *value += more;
            }
        }
        self.length = self.length.max(more.length);
    }
}
