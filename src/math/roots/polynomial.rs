//! All real roots of a polynomial whose coefficients are known to within error bounds.
//!
//! **In:** coefficients up to degree 15, lowest first, and the error bound of each. **Out:** where the
//! polynomial certainly changes its sign, in order, on the entire line. **Invariant:** consecutive roots have
//! opposite directions; every polynomial within the bounds has an odd number of roots within each root's
//! error. A possible root that may not exist (the polynomial touches zero within its bound) is omitted.
//!
//! A piece whose Bernstein coefficients change sign at most once has at most one root. Other pieces are
//! divided at the roots of the derivative, found recursively from the last derivative up: between these
//! roots, the polynomial is monotone. The search covers the entire line: roots beyond ±σ are those of the
//! reversed polynomial between −1 and 1.
//!
//! **Source:** C. Yuksel, "High-performance polynomial root finding for graphics", Proceedings of the ACM on
//! Computer Graphics 5 (2022); N. Higham, *Accuracy and Stability of Numerical Algorithms* (2002), ch. 5.

mod bernstein;
mod formula;
mod turning;

use std::cell::OnceCell;

use smallvec::SmallVec;

use crate::math::double::{power_of_two, power_of_two_near};
use bernstein::{Form, Signs};
pub use turning::turning_points;

/// The maximum degree.
pub const MOST: usize = 15;

/// Coefficients of 1, s, s², …
pub type Coefficients = [f64; MOST + 1];

/// Unit roundoff of `f64`.
const U: f64 = f64::EPSILON / 2.0;

/// A change of the polynomial's sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    pub s: f64,
    /// Error bound: the exact root is within this distance.
    pub error: f64,
    /// Whether the sign changes from negative to positive.
    pub rising: bool,
}

/// Parameters of a search for roots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// Expected magnitude of most roots. Affects only the running time.
    pub size: f64,
    /// Upper bound on the magnitude of any root, for every polynomial within the error bounds; ∞ if unknown.
    pub end: f64,
    /// Error that roots of magnitude below `size` may have.
    pub tolerance: f64,
    /// Roots certainly outside of this range may be omitted; this does not affect the others.
    pub between: (f64, f64),
}

type Brackets = SmallVec<[Bracket; 6]>;
/// Positions at which the polynomial is evaluated.
type Marks = SmallVec<[f64; 16]>;

/// So many coefficients are few.
const FEW: usize = 5;

/// Number of times that a piece is halved before its extrema are computed.
const HALVED: u32 = 3;

/// Ends of the requested range up to this many sizes away are covered by the inner search, whose pieces are then
/// halved more often. Affects only the running time.
const COVERED: f64 = 16.0;
const HALVED_MORE: u32 = 3;

/// A polynomial with its error bounds, with room for so many coefficients: most have few, and little is copied.
#[derive(Debug, Clone)]
pub struct Polynomial<const ROOM: usize = { MOST + 1 }> {
    values: [f64; ROOM],
    /// Σ slackₖ·|s|ᵏ bounds the error of a computed value.
    slack: [f64; ROOM],
    degree: usize,
}

impl<const ROOM: usize> Polynomial<ROOM> {
    /// Returns the position of a parabola's vertex, if rounding decides whether it reaches 0 there.
    pub fn doubtful_vertex(&self) -> Option<f64> {
        let ([c, b, a, ..], [slack_c, slack_b, slack_a, ..]) = (&self.values[..], &self.slack[..])
        else {
            return None;
        };
        if self.degree != 2 || a.abs() <= 4.0 * slack_a {
            return None;
        }
        let s = -0.5 * b / a;
        let slack = (slack_a * s.abs() + slack_b) * s.abs() + slack_c;
        (((a * s + b) * s + c).abs() <= slack).then_some(s)
    }

    /// Builds a polynomial; `errors` are the error bounds of `values`.
    pub fn new(values: [f64; ROOM], errors: [f64; ROOM]) -> Self {
        let known = |k: &usize| values[*k] != 0.0 || errors[*k] != 0.0;
        let degree = (0..ROOM).rev().find(known).unwrap_or(0);
        let mut slack = errors;
        for (k, slack) in slack.iter_mut().enumerate() {
            // Horner's rule rounds the term of sᵏ 2k + 1 times; the rest is for the bound itself.
            *slack = (*slack + (2 * k + 2) as f64 * U * values[k].abs()) * (1.0 + 64.0 * U);
        }
        Self { values, slack, degree }
    }

    /// Calls `show` with the changes of sign, in order, until it returns `false`.
    pub fn roots(&self, asked: &Asked, show: &mut impl FnMut(Root) -> bool) {
        let Asked { tolerance, between: (from, to), .. } = *asked;
        if let Some(guesses) = self.by_formula() {
            for (guess, change) in guesses.into_iter().filter(|(_, change)| change.high >= from) {
                if change.low > to || !show(self.near(guess, change, tolerance).root(1.0)) {
                    return;
                }
            }
            return;
        }
        self.search(asked, show);
    }

    /// Returns the coefficients, and their slack: all that there is room for where that is little, as loops over them
    /// then have a length that is known; zeros above the degree change nothing.
    #[inline(always)]
    fn terms(&self) -> (&[f64], &[f64]) {
        let count = if ROOM <= FEW { ROOM } else { self.degree + 1 };
        (&self.values[..count], &self.slack[..count])
    }

    /// [`Polynomial::roots`] by bounds of pieces.
    fn search(&self, asked: &Asked, show: &mut impl FnMut(Root) -> bool) {
        let Asked { size, end, tolerance, between: (from, to) } = *asked;
        let is_covered = |far: &f64| *far > size && *far <= COVERED * size;
        let farthest = [-from, to].into_iter().filter(is_covered).fold(0.0, f64::max);
        let is_wider = farthest > 0.0 && size < end;
        let (size, halved) = if is_wider { (1.5 * farthest, HALVED_MORE) } else { (size, 0) };
        let Some((near, scale)) = self.parted(size) else { return };
        let far = OnceCell::new();
        let outer = |ends| far.get_or_init(|| near.reversed()).all_between(ends).into_iter().rev();
        let odd = near.degree % 2 == 1;
        if scale < end && from < -scale {
            // From −∞ to −σ: w = σ/s goes from 0 down to −1.
            let before = outer((-1.0, 0.0));
            if !before.filter_map(|bracket| bracket.outer(scale, odd)).all(&mut *show) {
                return;
            }
        }
        let asked = (from / scale, to / scale);
        let within = &mut |bracket: Bracket| show(bracket.root(scale));
        if !near.between((-1.0, 1.0), tolerance / scale, asked, HALVED + halved, within) {
            return;
        }
        if scale < end && to > scale {
            outer((0.0, 1.0)).filter_map(|bracket| bracket.outer(scale, false)).all(show);
        }
    }

    /// Returns the polynomial of s/σ, and σ: a power of two near `size` such that the polynomial is certainly
    /// not 0 at ±σ. `None` if there is none, in which case it may be 0 everywhere.
    fn parted(&self, size: f64) -> Option<(Self, f64)> {
        let start = power_of_two_near(size);
        // More places than there can be roots near them.
        let powers = (0..2 * MOST as i32).map(|i| if i % 2 == 0 { i / 2 } else { -1 - i / 2 });
        powers.map(|power| start * power_of_two(power)).find_map(|scale| {
            let near = self.scaled(scale);
            (near.sign(-1.0) != 0 && near.sign(1.0) != 0).then_some((near, scale))
        })
    }

    fn scaled(&self, scale: f64) -> Self {
        let mut scaled = self.clone();
        // scaleᵏ as two factors: it may be as great as its coefficient is small.
        let (mut half, mut other) = (1.0, 1.0);
        for k in 0..=self.degree {
            for list in [&mut scaled.values, &mut scaled.slack] {
                list[k] = list[k] * half * other;
            }
            (half, other) = (other, half * scale);
        }
        scaled
    }

    fn reversed(&self) -> Self {
        let mut reversed = self.clone();
        reversed.values[..=self.degree].reverse();
        reversed.slack[..=self.degree].reverse();
        let rounding = |k: usize| (2 * k + 2) as f64 * U;
        for (k, slack) in reversed.slack.iter_mut().enumerate() {
            *slack += rounding(k) * reversed.values[k].abs();
        }
        reversed
    }

    /// The sign at s; 0 if uncertain.
    fn sign(&self, s: f64) -> i8 {
        self.sign_beyond(0.0, s)
    }

    /// The sign at s; 0 unless the value certainly exceeds `least` in magnitude.
    fn sign_beyond(&self, least: f64, s: f64) -> i8 {
        let (values, slack) = self.terms();
        let value = value(values, s);
        let slack = value_of_positive(slack, s.abs()) + least;
        match () {
            () if value > slack && value.is_finite() => 1,
            () if value < -slack && value.is_finite() => -1,
            () => 0,
        }
    }

    /// Returns all certain changes of sign between two ends, each of which is −1, 0 or 1, in order.
    fn all_between(&self, ends: (f64, f64)) -> Brackets {
        let mut all = Brackets::new();
        self.between(ends, 0.0, (f64::NEG_INFINITY, f64::INFINITY), HALVED, &mut |bracket| {
            all.push(bracket);
            true
        });
        all
    }

    /// Calls `show` with the changes of sign that are not certainly outside of the requested range, until it
    /// returns `false`; returns whether there may be more behind.
    fn between(
        &self,
        (low, high): (f64, f64),
        tolerance: f64,
        (from, to): (f64, f64),
        halved: u32,
        show: &mut impl FnMut(Bracket) -> bool,
    ) -> bool {
        let mut before = None;
        self.advance(&mut before, low);
        let pieces = [((-1.0, 0.0), -1.0), ((0.0, 1.0), 1.0)];
        for (ends, way) in pieces.into_iter().filter(|(ends, _)| low <= ends.0 && ends.1 <= high) {
            if ends.0 > to {
                return false;
            }
            let mut marks = Marks::new();
            if ends.1 < from && self.sign(ends.1) != 0 {
                marks.push(ends.1);
            } else {
                let all = ..=self.degree;
                let form = Form::<ROOM>::of(&self.values[all], &self.slack[all], way);
                self.mark(&form, ends, halved, &mut marks);
            }
            for at in marks {
                let change = self.advance(&mut before, at).filter(|change| change.high >= from);
                let Some(change) = change else { continue };
                if change.low > to || !show(self.near(f64::NAN, change, tolerance)) {
                    return false;
                }
            }
        }
        true
    }

    /// Adds positions in a piece, the last of them its end, such that at most one root lies between any two.
    fn mark(&self, form: &Form<ROOM>, (low, high): (f64, f64), halved: u32, marks: &mut Marks) {
        match form.signs() {
            Signs::Same | Signs::Change => marks.push(high),
            Signs::Unknown if halved > 0 => {
                let middle = 0.5 * (low + high);
                let [first, second] = form.halves();
                self.mark(&first, (low, middle), halved - 1, marks);
                self.mark(&second, (middle, high), halved - 1, marks);
            }
            Signs::Unknown => {
                let mut last = low;
                for turn in turning_points(&self.values[..=self.degree], low, high)
                    .into_iter()
                    .chain([high])
                {
                    // Also between them, for where the ends of a piece tell nothing.
                    marks.extend([0.5 * (last + turn), turn]);
                    last = turn;
                }
            }
        }
    }

    /// Advances to `at`, if the sign there is certain.
    fn advance(&self, before: &mut Option<(f64, i8)>, at: f64) -> Option<Change> {
        let sign = self.sign(at);
        if sign == 0 {
            return None;
        }
        let (low, old) = before.replace((at, sign))?;
        (old != sign).then_some(Change { low, high: at, rising: sign > 0 })
    }

    /// Returns the root at a change of sign, starting at `guess` if that is in range, with the smallest
    /// interval around it whose ends have certain signs, or within `tolerance` on each side.
    fn near(&self, guess: f64, change: Change, tolerance: f64) -> Bracket {
        let (values, slack) = self.terms();
        // That of a parabola is no guess.
        let is_exact = self.degree == 2 && !guess.is_nan();
        let s = if is_exact { guess } else { root_near(values, guess, change, tolerance, U) };
        let tolerance = if is_exact { 0.0 } else { tolerance };
        let Change { low, high, rising } = change;
        let (_, slope) = value_and_slope(values, s);
        let slack = value_of_positive(slack, s.abs());
        let after = if rising { 1 } else { -1 };
        // Where the slope is as good as 0, this is far too much: it grows as it has to.
        let most = (high - low) * f64::from(f32::EPSILON);
        let likely = (1.5 * slack / slope.abs()).min(most);
        let start = (likely + 4.0 * U * s.abs()).max(f64::MIN_POSITIVE).max(tolerance);
        let reach = |way: f64, end: f64| {
            let mut reach = start;
            loop {
                let at = s + way * reach;
                if (end - at) * way <= 0.0 {
                    return end;
                }
                if self.sign(at) == if way > 0.0 { after } else { -after } {
                    return at;
                }
                reach *= 2.0;
            }
        };
        Bracket { low: reach(-1.0, low), s, high: reach(1.0, high), rising }
    }
}

/// Two positions with certain and opposite signs.
#[derive(Debug, Clone, Copy)]
struct Change {
    low: f64,
    high: f64,
    rising: bool,
}

/// A root between two certain bounds.
#[derive(Debug, Clone, Copy)]
struct Bracket {
    low: f64,
    s: f64,
    high: f64,
    rising: bool,
}

impl Bracket {
    fn root(self, scale: f64) -> Root {
        let Self { low, s, high, rising } = self;
        let error = (s - low).max(high - s) * (1.0 + 4.0 * U);
        Root { s: s * scale, error: error * scale, rising }
    }

    /// Converts a root of the reversed polynomial to one of the original; `None` if it may be beyond ∞. `odd`
    /// is set if the signs of the two polynomials differ.
    fn outer(self, scale: f64, odd: bool) -> Option<Root> {
        let Self { low, s: w, high, rising } = self;
        let s = scale / w;
        let off = |end: f64| scale * (end - w).abs() / (w.abs() * end.abs());
        let error = off(low).max(off(high)) * (1.0 + 8.0 * U) + 2.0 * U * s.abs();
        let fine = error.is_finite() && s.is_finite();
        // The way along the line is the other way along w.
        fine.then_some(Root { s, error, rising: rising == odd })
    }
}

/// Returns the root between two positions with opposite signs, to about `tolerance` or, relative to itself,
/// `finest`, starting at `guess` if that is in range: by Newton's method while each step is at most half as long as the previous one and stays
/// in the bracket, else by bisection.
#[inline(always)]
fn root_near(values: &[f64], guess: f64, change: Change, tolerance: f64, finest: f64) -> f64 {
    let Change { mut low, mut high, rising } = change;
    let mut s = if low < guess && guess < high { guess } else { 0.5 * (low + high) };
    let mut step = high - low;
    for _ in 0..128 {
        let (value, slope) = value_and_slope(values, s);
        if value == 0.0 {
            return s;
        }
        if (value < 0.0) == rising {
            low = s;
        } else {
            high = s;
        }
        let newton = s - value / slope;
        let middle = 0.5 * (low + high);
        let is_fast = 2.0 * (newton - s).abs() <= step && newton > low && newton < high;
        let next = if is_fast { newton } else { middle };
        if (newton - s).abs() <= (finest * s.abs()).max(0.5 * tolerance)
            || next == low && middle == low
            || next == high
        {
            return s;
        }
        step = (next - s).abs();
        s = next;
    }
    s
}

/// Returns the root between two positions, to rounding, if the signs there are opposite.
pub fn root_between_ends(values: &[f64], (low, high): (f64, f64)) -> Option<f64> {
    let (below, above) = (value(values, low), value(values, high));
    let change = Change { low, high, rising: above > 0.0 };
    (below * above < 0.0).then(|| root_near(values, f64::NAN, change, 0.0, U))
}

#[inline(always)]
fn value(values: &[f64], s: f64) -> f64 {
    values.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

#[inline(always)]
fn value_of_positive(values: &[f64], s: f64) -> f64 {
    value(values, s) * (1.0 + 64.0 * U)
}

#[inline(always)]
fn value_and_slope(values: &[f64], s: f64) -> (f64, f64) {
    let step = |(value, slope), c: &f64| (value * s + c, slope * s + value);
    values.iter().rev().fold((0.0, 0.0), step)
}

#[cfg(test)]
mod tests;
