//! Isolates sign changes of a function, given bounds on its values and slopes over intervals.
//!
//! **In:** a function's bounds over an interval or at a position. **Out:** its changes of sign, each between
//! two positions where the sign is certain. **Invariant:** none is missed where the bounds are conclusive;
//! where they are infinite, the function is evaluated at positions no farther apart than the resolution;
//! where it is undefined, it has no sign.
//!
//! An interval has no root if the bounds, or the slopes starting from its ends, exclude one; it has at most
//! one if the function is monotone in it. Any other interval is reduced to what the slopes at its ends leave
//! of it, or divided in two. Slopes hold in all parts of their interval, where often a value is enough.
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

/// Share of an interval with two ends of one sign, which the slopes say is certain, from which on its middle may well
/// settle the rest: a value takes a fraction of the time of bounds.
const NEARLY: f64 = 0.15;

/// Up to this share of an interval that slopes are known of, those of a part are much narrower.
const AGAIN: f64 = 0.6;

/// Share of an interval that is certain from an end so near to a root that only a monotone function settles it; and
/// [`AGAIN`] for such an interval.
const WEAK: f64 = 0.03;
const AGAIN_AT_ROOT: f64 = 0.3;

/// Number of times that the ends around a root are moved towards it before slopes are narrowed.
const MOVES: u32 = 4;

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

/// Returns how far from each end its sign is certain, if the slopes in between are in `slope`.
fn reaches(first: &End, last: &End, slope: Interval) -> [f64; 2] {
    let width = last.s - first.s;
    let far = |gap: f64, speed: f64| if speed > 0.0 { 0.999_999 * gap / speed } else { width };
    let from_first = match first.sign() {
        Some(false) => far(first.value.low, -slope.low),
        Some(true) => far(-first.value.high, slope.high),
        None => 0.0,
    };
    let from_last = match last.sign() {
        Some(false) => far(last.value.low, slope.high),
        Some(true) => far(-last.value.high, -slope.low),
        None => 0.0,
    };
    [from_first, from_last]
}

/// An interval to search.
#[derive(Debug, Clone, Copy)]
struct Part {
    ends: [End; 2],
    /// Range of the slopes, as far as known.
    slope: Interval,
    /// Width of the interval that it is the range of.
    of: f64,
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
    left: SmallVec<[Part; 64]>,
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
        self.begin(from, to, Interval::EVERYTHING);
        while self.goes_on() {}
    }

    /// Starts the search of an interval with slopes in `slope`; [`Search::goes_on`] performs it.
    pub fn begin(&mut self, from: f64, to: f64, slope: Interval) {
        let first = self.look_again(from);
        let last = self.look(to);
        self.note(from, first.sign());
        self.end = Some(last);
        self.left.push(Part { ends: [first, last], slope, of: to - from });
    }

    /// Continues to the next change; returns `false` if there is none and the interval is done.
    pub fn goes_on(&mut self) -> bool {
        let told = self.found.all.len();
        while let Some(part) = self.left.pop() {
            match self.part(part) {
                Some((Part { ends: [first, last], slope, of }, cut)) => {
                    self.left.push(Part { ends: [cut, last], slope, of });
                    self.left.push(Part { ends: [first, cut], slope, of });
                }
                None => self.note(part.ends[1].s, part.ends[1].sign()),
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
            self.left.push(Part {
                ends: [first, last],
                slope: Interval::EVERYTHING,
                of: to - from,
            });
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
    fn part(&mut self, Part { ends, slope: known, of }: Part) -> Option<(Part, End)> {
        let Fineness { resolution, least } = self.fineness;
        let [mut a, mut b] = ends;
        let mut width = b.s - a.s;
        self.cells += 1;
        let is_short = width.is_nan() || width <= resolution;
        let is_spent = self.cells > 8 * MOST || self.cells > MOST && is_short;
        if is_spent || width.is_nan() || width <= least {
            return None;
        }
        let both = a.sign().is_some() && a.sign() == b.sign();
        let [from_first, from_last] = reaches(&a, &b, known);
        if both && from_first + from_last >= width {
            return None;
        }
        let is_known = known.low.is_finite() && known.high.is_finite();
        if is_known
            && both
            && Self::is_for_values(width / of, [from_first / width, from_last / width])
        {
            let middle = 0.5 * ((a.s + from_first) + (b.s - from_last));
            if !(a.s < middle && middle < b.s) {
                return None;
            }
            self.note(a.s, a.sign());
            return Some((Part { ends, slope: known, of }, self.look(middle)));
        }
        if is_known && !both && a.sign().is_some() && b.sign().is_some() {
            for _ in 0..MOVES {
                let [from_first, from_last] = reaches(&a, &b, known);
                if from_first + from_last < 0.12 * width || width < 0.25 * of {
                    break;
                }
                (a, b) = (self.nearer(a, a.s + from_first), self.nearer(b, b.s - from_last));
                width = b.s - a.s;
            }
            self.note(a.s, a.sign());
        }
        let all = (self.function)(Interval { low: a.s, high: b.s });
        if all.is_undefined() {
            return None;
        }
        let slope =
            Interval { low: all.slope.low.max(known.low), high: all.slope.high.min(known.high) };
        if sign(all.value).is_some() || slope.low > 0.0 || slope.high < 0.0 {
            self.note(b.s, b.sign());
            return None;
        }
        let [from_first, from_last] = reaches(&a, &b, slope);
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
        Some((Part { ends: [first, last], slope, of: width }, cut))
    }

    /// Returns whether a value is to divide an interval with two ends of one sign, instead of bounds, given its share of
    /// the interval that slopes are known of, and the shares that are certain from its ends.
    fn is_for_values(share: f64, [first, last]: [f64; 2]) -> bool {
        match first.min(last) < WEAK {
            true => share > AGAIN_AT_ROOT,
            false => first + last > NEARLY || share > AGAIN,
        }
    }

    /// Moves an end inward while its sign is certain; returns it unchanged if rounding prevents that.
    fn nearer(&self, end: End, s: f64) -> End {
        let moved = self.look(s);
        if moved.sign() == end.sign() { moved } else { end }
    }
}

#[cfg(test)]
mod tests;
