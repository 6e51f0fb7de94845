//! Isolates sign changes of a function, given bounds on its values and slopes over intervals.
//!
//! **In:** a function's bounds over an interval or at a position. **Out:** its changes of sign, each between
//! two positions where the sign is certain. **Invariant:** none is missed where the bounds are conclusive;
//! where they are infinite, the function is evaluated at positions no farther apart than the resolution;
//! where it is undefined, it has no sign.
//!
//! An interval has no root if the bounds, or the slopes starting from its ends, exclude one; it has at most
//! one if the function is monotone in it. Any other interval is reduced to what the slopes at its ends leave
//! of it, or divided in two.
//!
//! **Source:** R. E. Moore, R. B. Kearfott, M. J. Cloud, *Introduction to Interval Analysis* (2009), chapter
//! 8; D. Mitchell, "Robust ray intersection with interval arithmetic", Graphics Interface (1990), p. 68.

use smallvec::SmallVec;

use crate::math::interval::Interval;

/// Bounds of a function in an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Range of the values; NaN in [`Bounds::UNDEFINED`].
    pub value: Interval,
    /// Range of the slopes; a kink has the slopes of both sides, a jump is unbounded.
    pub slope: Interval,
}

impl Bounds {
    /// Bounds of a function that is undefined throughout the interval.
    pub const UNDEFINED: Self =
        Self { value: Interval { low: f64::NAN, high: f64::NAN }, slope: Interval::EVERYTHING };

    fn is_undefined(&self) -> bool {
        self.value.low.is_nan()
    }
}

/// A change of sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// The last known position with the old sign.
    pub before: f64,
    /// The first known position with the new sign.
    pub after: f64,
    /// Whether the sign changes from negative to positive.
    pub rising: bool,
}

/// The changes of sign in an interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Changes {
    /// The first and the last position with a certain sign, and whether the function is negative there.
    pub first: Option<(f64, bool)>,
    pub last: Option<(f64, bool)>,
    pub all: SmallVec<[Change; 4]>,
}

/// How finely to search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fineness {
    /// Minimum width for dividing an interval with infinite bounds.
    pub resolution: f64,
    /// Minimum width for dividing any interval, given by rounding.
    pub least: f64,
}

/// Number of intervals after which only those longer than the resolution are divided; after eight times as
/// many, none is.
const MOST: u32 = 4_096;

/// Fractions at which intervals are divided: uneven, so that they rarely coincide with a feature.
const CUTS: [f64; 3] = [0.4934, 0.5481, 0.4127];

#[derive(Debug, Clone, Copy)]
struct End {
    s: f64,
    value: Interval,
}

impl End {
    /// Whether it is negative; `None` if uncertain.
    fn sign(&self) -> Option<bool> {
        sign(self.value)
    }
}

fn sign(value: Interval) -> Option<bool> {
    match (value.low > 0.0, value.high < 0.0) {
        (true, _) => Some(false),
        (_, true) => Some(true),
        _ => None,
    }
}

/// A search that proceeds from interval to interval, in order.
pub struct Search<F> {
    function: F,
    fineness: Fineness,
    cells: u32,
    found: Changes,
    /// The last position evaluated.
    end: Option<End>,
    /// Intervals yet to be searched, the nearest last.
    left: SmallVec<[(End, End); 64]>,
}

/// Returns the changes of sign of a function in an interval.
pub fn changes(
    function: &impl Fn(Interval) -> Bounds,
    from: f64,
    to: f64,
    fineness: Fineness,
) -> Changes {
    let mut search = Search::new(function, fineness);
    search.through(from, to);
    search.found
}

impl<F: Fn(Interval) -> Bounds> Search<F> {
    pub fn new(function: F, fineness: Fineness) -> Self {
        let found = Changes { first: None, last: None, all: SmallVec::new() };
        Self { function, fineness, cells: 0, found, end: None, left: SmallVec::new() }
    }

    pub fn found(&self) -> &Changes {
        &self.found
    }

    /// Searches an interval.
    pub fn through(&mut self, from: f64, to: f64) {
        self.begin(from, to);
        while self.goes_on() {}
    }

    /// Starts the search of an interval; [`Search::goes_on`] performs it.
    pub fn begin(&mut self, from: f64, to: f64) {
        let first = self.look_again(from);
        let last = self.look(to);
        self.note(from, first.sign());
        self.end = Some(last);
        self.left.push((first, last));
    }

    /// Continues to the next change; returns `false` if there is none and the interval is done.
    pub fn goes_on(&mut self) -> bool {
        let told = self.found.all.len();
        while let Some((a, b)) = self.left.pop() {
            match self.part(a, b) {
                Some(([left, right], cut)) => {
                    self.left.push((cut, right));
                    self.left.push((left, cut));
                }
                None => self.note(b.s, b.sign()),
            }
            if self.found.all.len() > told {
                return true;
            }
        }
        // The last that was searched may have been moved inward from where all ends.
        if let Some(end) = self.end {
            self.note(end.s, end.sign());
        }
        self.found.all.len() > told
    }

    /// Like [`Search::through`], for an interval where the function is known to be monotone.
    pub fn through_slope(&mut self, from: f64, to: f64) {
        let first = self.look_again(from);
        let last = self.look(to);
        self.end = Some(last);
        if first.sign().is_none() || last.sign().is_none() {
            self.left.push((first, last));
            while self.goes_on() {}
        }
        self.note(from, first.sign());
        self.note(to, last.sign());
    }

    /// Records that the function has a constant sign in an interval.
    pub fn certain(&mut self, from: f64, to: f64, negative: bool) {
        self.note(from, Some(negative));
        self.note(to, Some(negative));
    }

    /// Returns whether the function is negative at a position that is searched next; `None` if uncertain.
    pub fn sign_at(&mut self, s: f64) -> Option<bool> {
        let end = self.look_again(s);
        self.end = Some(end);
        end.sign()
    }

    fn look_again(&self, s: f64) -> End {
        self.end.filter(|end| end.s == s).unwrap_or_else(|| self.look(s))
    }

    fn look(&self, s: f64) -> End {
        End { s, value: (self.function)(Interval::point(s)).value }
    }

    /// Records the sign, if certain, at a position after all others.
    fn note(&mut self, s: f64, negative: Option<bool>) {
        let Some(negative) = negative else { return };
        if let Some((before, was_negative)) = self.found.last
            && was_negative != negative
        {
            self.found.all.push(Change { before, after: s, rising: was_negative });
        }
        self.found.first.get_or_insert((s, negative));
        self.found.last = Some((s, negative));
    }

    /// Returns the reduced interval and the position at which to divide it; `None` if it need not be divided.
    fn part(&mut self, a: End, b: End) -> Option<([End; 2], End)> {
        let Fineness { resolution, least } = self.fineness;
        let width = b.s - a.s;
        self.cells += 1;
        let is_short = width.is_nan() || width <= resolution;
        let is_spent = self.cells > 8 * MOST || self.cells > MOST && is_short;
        if is_spent || width.is_nan() || width <= least {
            return None;
        }
        let all = (self.function)(Interval { low: a.s, high: b.s });
        if all.is_undefined() {
            return None;
        }
        let Interval { low: fall, high: rise } = all.slope;
        if sign(all.value).is_some() || fall > 0.0 || rise < 0.0 {
            return None;
        }
        // How far from each end its sign is certain yet.
        let far = |gap: f64, speed: f64| if speed > 0.0 { 0.999_999 * gap / speed } else { width };
        let from_first = match a.sign() {
            Some(false) => far(a.value.low, -fall),
            Some(true) => far(-a.value.high, rise),
            None => 0.0,
        };
        let from_last = match b.sign() {
            Some(false) => far(b.value.low, rise),
            Some(true) => far(-b.value.high, -fall),
            None => 0.0,
        };
        let both = a.sign().is_some() && a.sign() == b.sign();
        if both && from_first + from_last >= width {
            return None;
        }
        if is_short && !all.value.is_finite() {
            return None;
        }
        let (mut first, mut last) = (a, b);
        if from_first + from_last > 0.3 * width && from_first + from_last < width {
            first = self.nearer(a, a.s + from_first);
            last = self.nearer(b, b.s - from_last);
            if first.s >= last.s {
                (first, last) = (a, b);
            }
        }
        let mut cut = first;
        for share in CUTS {
            cut = self.look(first.s + share * (last.s - first.s));
            if cut.sign().is_some() {
                break;
            }
        }
        if !(first.s < cut.s && cut.s < last.s) {
            return None;
        }
        // Nothing is certain anywhere in it.
        let blank = [&first, &cut, &last].iter().all(|end| end.sign().is_none());
        if blank && is_short {
            return None;
        }
        self.note(first.s, first.sign());
        Some(([first, last], cut))
    }

    /// Moves an end inward while its sign is certain; returns it unchanged if rounding prevents that.
    fn nearer(&self, end: End, s: f64) -> End {
        let moved = self.look(s);
        if moved.sign() == end.sign() { moved } else { end }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    const FINE: Fineness = Fineness { resolution: 1e-3, least: 1e-14 };

    /// The product of x − r over the roots, in interval arithmetic.
    fn polynomial(roots: &[f64]) -> impl Fn(Interval) -> Bounds {
        move |x| {
            let (mut value, mut slope) = (Interval::point(1.0), Interval::point(0.0));
            for root in roots {
                let factor = x - Interval::point(*root);
                slope = slope * factor + value;
                value = value * factor;
            }
            Bounds { value, slope }
        }
    }

    #[test]
    fn every_root_of_a_polynomial_is_found_and_in_order() {
        let mut random = Random(3);
        for _ in 0..tries() {
            let mut roots = [(); 5].map(|()| random.number(-1.0, 1.0));
            // Two of them near each other.
            roots[1] = roots[0] + random.size(-5.0, -1.0);
            roots.sort_by(f64::total_cmp);
            let changes = changes(&polynomial(&roots), -2.0, 3.0, FINE);
            assert_eq!(changes.all.len(), 5, "{roots:?} {changes:?}");
            for (change, root) in changes.all.iter().zip(roots) {
                assert!(change.before < root && root < change.after, "{roots:?} {changes:?}");
            }
            assert!(changes.all.iter().enumerate().all(|(i, c)| c.rising == (i % 2 == 0)));
        }
    }

    #[test]
    fn who_wants_one_change_looks_no_farther() {
        let looks = std::cell::Cell::new(0);
        let roots = polynomial(&[-0.9, 0.1, 0.100_01, 0.100_02, 0.9]);
        let counted = |x: Interval| {
            looks.set(looks.get() + 1);
            roots(x)
        };
        let mut search = Search::new(counted, FINE);
        search.begin(-2.0, 3.0);
        assert!(search.goes_on());
        let first = looks.get();
        assert_eq!(search.found().all.len(), 1);
        while search.goes_on() {}
        let roots = polynomial(&[-0.9, 0.1, 0.100_01, 0.100_02, 0.9]);
        assert_eq!(search.found(), &changes(&roots, -2.0, 3.0, FINE));
        assert!(3 * first < looks.get(), "{first} {}", looks.get());
    }

    #[test]
    fn the_last_place_of_certain_sign_is_the_end_of_what_was_searched() {
        // Flat, and then falling: from its root on the slope alone tells the sign.
        let ramp = |x: Interval| Bounds {
            value: Interval::point(0.5) - x.max(Interval::point(0.0)),
            slope: Interval { low: if x.high > 0.0 { -1.0 } else { 0.0 }, high: 0.0 },
        };
        let found = changes(&ramp, -1.0, 1.0, FINE);
        assert_eq!((found.all.len(), found.last), (1, Some((1.0, true))), "{found:?}");
    }

    #[test]
    fn what_touches_zero_and_does_not_pass_it_changes_no_sign() {
        let touching = |x: Interval| Bounds {
            value: (x - Interval::point(0.3)).square(),
            slope: Interval::point(2.0) * (x - Interval::point(0.3)),
        };
        assert!(changes(&touching, -1.0, 1.0, FINE).all.is_empty());
    }

    #[test]
    fn where_a_distance_is_0_throughout_few_looks_are_enough() {
        let zero = Interval::point(0.0);
        let looks = std::cell::Cell::new(0);
        // From what lies between −1 and 1.
        let distance = |x: Interval| {
            looks.set(looks.get() + 1);
            let beyond = (x.abs() - Interval::point(1.0)).max(zero);
            let length = (beyond.square() + zero.square()).sqrt();
            let slope = match (x.low >= 1.0, x.high <= -1.0) {
                (true, _) => Interval::point(1.0),
                (_, true) => Interval::point(-1.0),
                _ => Interval::EVERYTHING,
            };
            Bounds { value: length - Interval::point(0.5), slope }
        };
        let found = changes(&distance, -2.0, 2.1, FINE);
        assert_eq!(found.all.len(), 2, "{found:?}");
        assert!(looks.get() < 100, "{}", looks.get());
    }

    #[test]
    fn a_jump_is_found_as_exactly_as_numbers_go() {
        let step = |x: Interval| {
            let at = |x: f64| if x < 0.123_456 { -1.0 } else { 1.0 };
            let value = Interval { low: at(x.low), high: at(x.high) };
            let slope =
                if value.single().is_some() { Interval::point(0.0) } else { Interval::EVERYTHING };
            Bounds { value, slope }
        };
        let found = changes(&step, -1.0, 1.0, FINE);
        let [change] = found.all[..] else { panic!("{found:?}") };
        assert!(change.rising && change.before < 0.123_456 && change.after >= 0.123_456);
        assert!(change.after - change.before < 1e-13);
    }
}
