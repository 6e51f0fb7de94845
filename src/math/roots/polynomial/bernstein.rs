//! Bernstein form of a polynomial on a piece of the line; bounds its values and thus its signs.
//!
//! **Invariant:** every statement holds for all polynomials within the error bounds of the coefficients. A
//! piece without a statement may have any number of roots.
//!
//! **Source:** G. Farin, *Curves and Surfaces for CAGD* (2002), ch. 5 (the coefficients bound the polynomial,
//! and it changes its sign at most as often as they do) and 4 (halves).

use super::{Coefficients, MOST, U};

/// 1 / C(n, k), by n and k.
static SHARES: [Coefficients; MOST + 1] = {
    let mut all = [[0.0; MOST + 1]; MOST + 1];
    let mut n = 0;
    while n <= MOST {
        let (mut choices, mut k) = (1.0, 0);
        while k <= n {
            all[n][k] = 1.0 / choices;
            choices = choices * (n - k) as f64 / (k + 1) as f64;
            k += 1;
        }
        n += 1;
    }
    all
};

/// The coefficients over a piece, in order along the line.
#[derive(Clone, Copy)]
pub struct Form<const ROOM: usize = { MOST + 1 }> {
    degree: usize,
    values: [f64; ROOM],
    /// Error bound of each coefficient.
    bounds: [f64; ROOM],
}

/// What is known of the signs in a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signs {
    /// Constant throughout.
    Same,
    /// Opposite at the two ends, with a single change between them.
    Change,
    Unknown,
}

impl<const ROOM: usize> Form<ROOM> {
    /// Returns the form over 0 … 1 for a `way` of 1 and over −1 … 0 for −1, where a coefficient is a plain
    /// sum. `slack` are the error bounds of `values`.
    pub fn of(values: &[f64], slack: &[f64], way: f64) -> Self {
        let degree = values.len() - 1;
        let (mut forms, mut bounds) = ([0.0; ROOM], [0.0; ROOM]);
        let mut power = 1.0;
        for k in 0..=degree {
            forms[k] = values[k] * (power * SHARES[degree][k]);
            bounds[k] = (slack[k] + 64.0 * U * values[k].abs()) * SHARES[degree][k];
            power *= way;
        }
        // Σ C(i, k) of them, for each i.
        for first in 1..=degree {
            for i in (first..=degree).rev() {
                forms[i] += forms[i - 1];
                bounds[i] += bounds[i - 1];
            }
        }
        if way < 0.0 {
            forms[..=degree].reverse();
            bounds[..=degree].reverse();
        }
        Self { degree, values: forms, bounds }
    }

    pub fn signs(&self) -> Signs {
        let mut changes = 0;
        let mut last = 0;
        for (value, bound) in self.values.iter().zip(&self.bounds).take(self.degree + 1) {
            let sign = match () {
                () if value > bound => 1,
                () if *value < -bound => -1,
                () => return Signs::Unknown,
            };
            changes += usize::from(sign == -last);
            last = sign;
        }
        match changes {
            0 => Signs::Same,
            1 => Signs::Change,
            _ => Signs::Unknown,
        }
    }

    /// Returns the two halves of the piece.
    pub fn halves(&self) -> [Self; 2] {
        let (mut first, mut second) = (*self, *self);
        for row in 1..=self.degree {
            for i in 0..=self.degree - row {
                let mean = 0.5 * (second.values[i] + second.values[i + 1]);
                let bound = 0.5 * (second.bounds[i] + second.bounds[i + 1]);
                second.values[i] = mean;
                second.bounds[i] = (bound + U * mean.abs()) * (1.0 + 4.0 * U);
            }
            first.values[row] = second.values[0];
            first.bounds[row] = second.bounds[0];
        }
        [first, second]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    fn value(values: &[f64], s: f64) -> f64 {
        values.iter().rev().fold(0.0, |sum, c| sum * s + c)
    }

    /// Checks the statements about a piece at points in it, and recursively for its halves.
    fn assert_true_of(form: &Form, values: &[f64], (low, high): (f64, f64), depth: usize) {
        let at = |i: u32| value(values, low + (high - low) * f64::from(i) / 64.0);
        let rounding = 64.0 * f64::EPSILON * values.iter().map(|c| c.abs()).sum::<f64>();
        let signs: Vec<bool> =
            (0..=64).map(at).filter(|value| value.abs() > rounding).map(|v| v > 0.0).collect();
        let changes = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        match form.signs() {
            Signs::Same => assert_eq!(changes, 0, "{values:?} {low} {high}"),
            Signs::Change => {
                assert!(changes <= 1, "{values:?} {low} {high}");
                assert!(at(0) * at(64) < 0.0, "{values:?} {low} {high}");
            }
            Signs::Unknown => {}
        }
        if depth > 0 {
            let middle = 0.5 * (low + high);
            let [first, second] = form.halves();
            assert_true_of(&first, values, (low, middle), depth - 1);
            assert_true_of(&second, values, (middle, high), depth - 1);
        }
    }

    #[test]
    fn what_is_said_of_a_piece_is_true_of_each_place_in_it() {
        let mut random = Random(41);
        let mut known = 0;
        for _ in 0..tries() {
            let degree = 1 + random.below(15);
            let values: Vec<f64> = (0..=degree).map(|_| random.number(-1.0, 1.0)).collect();
            let slack = vec![0.0; degree + 1];
            for (way, ends) in [(1.0, (0.0, 1.0)), (-1.0, (-1.0, 0.0))] {
                let form: Form = Form::of(&values, &slack, way);
                known += usize::from(form.signs() != Signs::Unknown);
                assert_true_of(&form, &values, ends, 3);
            }
        }
        assert!(known > tries() / 2, "{known}");
    }

    #[test]
    fn nothing_is_said_of_what_may_be_off_by_all_it_is() {
        let form: Form = Form::of(&[1.0, 0.5], &[1.5, 0.0], 1.0);
        assert_eq!(form.signs(), Signs::Unknown);
        assert_eq!(Form::<2>::of(&[1.0, 0.5], &[0.5, 0.0], 1.0).signs(), Signs::Same);
        assert_eq!(Form::<2>::of(&[1.0, -1.5], &[0.1, 0.1], 1.0).signs(), Signs::Change);
    }
}
