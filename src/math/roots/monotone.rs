//! Roots of a function with bounds on its value and slope, found by dividing the line into monotone pieces.
//!
//! **In:** the function at positions, and its bounds over pieces. **Out:** where it certainly changes its
//! sign, in order. **Invariant:** between two consecutive roots there is a position with a certain sign. Up
//! to a maximum number of pieces, no piece is skipped in which the function may certainly have a sign other
//! than at its ends.
//!
//! **Source:** R. E. Moore, R. B. Kearfott, M. J. Cloud, *Introduction to Interval Analysis*, 2009, ch. 8.

use smallvec::SmallVec;

use super::bracket::{Root, Sample, root};
use crate::math::interval::Interval;

/// Maximum number of pieces, beyond which only their ends are evaluated: a line that lies in a surface would
/// be divided without end.
const MOST: usize = 1024;

/// Start and end of each piece, and whether it is final.
type Pieces = SmallVec<[(f64, f64, bool); 32]>;

/// Finds roots along a line, piece by piece.
pub struct Walk<S> {
    sample: S,
    /// Error that a root may have in addition to that caused by the errors of the samples.
    tolerance: f64,
    /// The last position with a certain sign, whether it was positive, and the value there; NaN if unknown.
    last: Option<(f64, bool, f64)>,
}

impl<S: Fn(f64) -> Sample> Walk<S> {
    pub fn new(sample: S, tolerance: f64) -> Self {
        Self { sample, tolerance, last: None }
    }

    /// Advances to `s`; calls `found` with a root before it, and with whether the function is positive after
    /// that root.
    pub fn advance(&mut self, s: f64, found: &mut impl FnMut(Root, bool)) {
        let here = (self.sample)(s);
        if here.is_outside() || here.is_inside() {
            self.note_value(s, here.is_outside(), here.value, found);
        }
    }

    /// Advances to `s`, where the sign is known.
    pub fn note(&mut self, s: f64, is_outside: bool, found: &mut impl FnMut(Root, bool)) {
        self.note_value(s, is_outside, f64::NAN, found);
    }

    fn note_value(
        &mut self,
        s: f64,
        is_outside: bool,
        value: f64,
        found: &mut impl FnMut(Root, bool),
    ) {
        if let Some((before, was_outside, old)) = self.last.replace((s, is_outside, value))
            && was_outside != is_outside
        {
            let ends = if is_outside { (s, before) } else { (before, s) };
            // As if it were straight between the two.
            let start = before + old / (old - value) * (s - before);
            found(root(&self.sample, ends, start, self.tolerance), is_outside);
        }
    }

    /// Returns whether the function is positive at `s`, if `s` is the last position and the sign there is
    /// certain.
    pub fn sign_at(&self, s: f64) -> Option<bool> {
        self.last.filter(|(last, ..)| *last == s).map(|(_, is_outside, _)| is_outside)
    }

    /// Advances from `low`, the current position, to `high`, by pieces in which the function has a constant
    /// sign or is monotone. `value` and `slope` return the range of the function and of its slope over a
    /// piece, including all errors.
    pub fn through(
        &mut self,
        ends: (f64, f64),
        value: impl Fn(Interval) -> Interval,
        slope: impl Fn(Interval) -> Interval,
        found: &mut impl FnMut(Root, bool),
    ) {
        let is_simple = |low, high| {
            let piece = Interval { low, high };
            !value(piece).contains(0.0) || !slope(piece).contains(0.0)
        };
        let mut pieces: Pieces = SmallVec::from_slice(&[(ends.0, ends.1, false)]);
        while pieces.len() < MOST && pieces.iter().any(|(_, _, is_done)| !is_done) {
            let mut finer = Pieces::new();
            for (low, high, is_done) in pieces {
                let middle = 0.5 * (low + high);
                if is_done || !(low < middle && middle < high) || is_simple(low, high) {
                    finer.push((low, high, true));
                } else {
                    finer.extend([(low, middle, false), (middle, high, false)]);
                }
            }
            pieces = finer;
        }
        if self.sign_at(ends.0).is_none() {
            self.advance(ends.0, found);
        }
        for (_, high, _) in pieces {
            self.advance(high, found);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    fn roots(count: &mut usize, shift: f64, ends: (f64, f64)) -> Vec<(Root, bool)> {
        // (s² − 1)·s − shift.
        let sample = |s: f64| Sample {
            value: (s * s - 1.0) * s - shift,
            slope: 3.0 * s * s - 1.0,
            error: 1e-14,
        };
        let one = Interval::point(1.0);
        let value = |s: Interval| {
            *count += 1;
            (s.square() - one) * s - Interval::point(shift)
        };
        let value = std::cell::RefCell::new(value);
        let slope = |s: Interval| Interval::point(3.0) * s.square() - one;
        let mut found = Vec::new();
        let mut walk = Walk::new(sample, 0.0);
        let mut note = |root, rising| found.push((root, rising));
        walk.through(ends, |s| (value.borrow_mut())(s), slope, &mut note);
        found
    }

    #[test]
    fn all_roots_are_found_in_order_and_none_where_the_function_turns_before_zero() {
        let mut random = Random(13);
        // Where the cubic turns, it is as far from 0 as this.
        let crest = 2.0 / 27.0_f64.sqrt();
        for _ in 0..tries() / 10 {
            let shift = match random.below(3) {
                0 => crest * (1.0 + random.size(-9.0, 0.0)),
                1 => -crest * (1.0 - random.size(-9.0, 0.0)),
                _ => random.number(-1.0, 1.0),
            };
            let mut count = 0;
            let found = roots(&mut count, shift, (-3.0, 3.0));
            let expected = if shift.abs() < crest { 3 } else { 1 };
            assert_eq!(found.len(), expected, "{shift} {found:?}");
            for (i, (root, rising)) in found.iter().enumerate() {
                assert_eq!(*rising, i % 2 == 0, "{shift} {found:?}");
                let off = |s: f64| (s * s - 1.0) * s - shift;
                let (before, behind) = (off(root.t - root.error), off(root.t + root.error));
                assert!(before * behind <= 0.0, "{shift} {root:?}");
            }
        }
    }

    #[test]
    fn a_function_that_may_be_0_all_along_comes_to_an_end() {
        let all = |_: Interval| Interval { low: -1.0, high: 1.0 };
        let nothing = |_: f64| Sample { value: 0.0, slope: 0.0, error: 1.0 };
        let mut found = 0;
        Walk::new(nothing, 0.0).through((0.0, 1.0), all, all, &mut |_, _| found += 1);
        assert_eq!(found, 0);
    }
}
