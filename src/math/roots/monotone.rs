//! Monotone pieces: the roots of a function of which one can tell, over any piece of the line, between what
//! it and its slope lie.
//!
//! **In:** the function at places, and over pieces. **Out:** where it certainly changes its sign, in order.
//! **Invariant:** between two neighbouring roots there is a place of certain sign; no piece is let go in
//! which the function could have a certain sign other than at its ends.
//!
//! **Source:** R. E. Moore, R. B. Kearfott, M. J. Cloud, *Introduction to Interval Analysis*, 2009, ch. 8.

use smallvec::SmallVec;

use super::bracket::{Root, Sample, root};
use crate::math::interval::Interval;

/// Finds roots along a line, piece after piece.
pub struct Walk<S> {
    sample: S,
    /// How far a root may be off beyond what the samples' errors ask for.
    tolerance: f64,
    /// The last place of certain sign, and whether it was positive.
    last: Option<(f64, bool)>,
}

impl<S: Fn(f64) -> Sample> Walk<S> {
    pub fn new(sample: S, tolerance: f64) -> Self {
        Self { sample, tolerance, last: None }
    }

    /// Goes on to `s`; shows the root that lies before, and whether the function is positive behind it.
    pub fn advance(&mut self, s: f64, found: &mut impl FnMut(Root, bool)) {
        let here = (self.sample)(s);
        let is_outside = here.is_outside();
        if !(is_outside || here.is_inside()) {
            return;
        }
        if let Some((before, was_outside)) = self.last.replace((s, is_outside))
            && was_outside != is_outside
        {
            let ends = if is_outside { (s, before) } else { (before, s) };
            found(root(&self.sample, ends, f64::NAN, self.tolerance), is_outside);
        }
    }

    /// Goes on from `low` to `high`, where it has been, by pieces in which the function has one sign or
    /// goes one way: `value` and `slope` tell what it and its slope may come to over a piece, whatever
    /// function was meant.
    pub fn through(
        &mut self,
        (low, high): (f64, f64),
        value: impl Fn(Interval) -> Interval,
        slope: impl Fn(Interval) -> Interval,
        found: &mut impl FnMut(Root, bool),
    ) {
        let mut pieces: SmallVec<[(f64, f64); 64]> = SmallVec::new();
        pieces.push((low, high));
        while let Some((low, high)) = pieces.pop() {
            let piece = Interval { low, high };
            let middle = 0.5 * (low + high);
            let is_simple = !value(piece).contains(0.0) || !slope(piece).contains(0.0);
            if is_simple || !(low < middle && middle < high) {
                self.advance(low, found);
                self.advance(high, found);
            } else {
                pieces.extend([(middle, high), (low, middle)]);
            }
        }
    }
}
