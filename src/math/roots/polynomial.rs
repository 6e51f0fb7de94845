//! All real roots of a polynomial of which each coefficient is known to within a bound.
//!
//! **In:** coefficients up to degree 15, lowest first, and how far each may be off. **Out:** where it
//! certainly changes its sign, in order, on the whole line. **Invariant:** neighbouring roots go in
//! opposite ways; whatever polynomial was meant has an odd number of roots within each bound. What could
//! as well be no root (it touches zero within its bound) is none.
//!
//! Pieces whose Bernstein coefficients change their sign once at most have no more roots than that. In
//! others, from the last derivative up, each has one root at most between two neighbours of the one before:
//! between the roots of its derivative a polynomial is monotone. The line is followed to its very end: what
//! lies beyond ±σ are the roots of the reversed polynomial between −1 and 1.
//!
//! **Source:** C. Yuksel, "High-performance polynomial root finding for graphics", Proceedings of the ACM on
//! Computer Graphics 5 (2022); N. Higham, *Accuracy and Stability of Numerical Algorithms* (2002), ch. 5.

mod bernstein;

use smallvec::SmallVec;

use crate::math::double::{power_of_two, power_of_two_near};
use bernstein::{Form, Signs};

/// The greatest degree.
pub const MOST: usize = 15;

/// Coefficients of 1, s, s², …
pub type Coefficients = [f64; MOST + 1];

/// The roundoff of `f64`.
const U: f64 = f64::EPSILON / 2.0;

/// A place where the polynomial changes its sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    pub s: f64,
    /// The root that was meant is within this distance.
    pub error: f64,
    /// From negative to positive.
    pub rising: bool,
}

/// At most one for each degree.
pub type Roots = SmallVec<[Root; 6]>;

type Brackets = SmallVec<[Bracket; 6]>;
type Changes = SmallVec<[Change; 6]>;
/// Places at which it is looked.
type Marks = SmallVec<[f64; 16]>;

/// How often a piece is halved before it is looked for turning points.
const HALVED: u32 = 3;

/// A polynomial and the rounding that it carries.
#[derive(Debug, Clone)]
pub struct Polynomial {
    values: Coefficients,
    /// Σ slackₖ·|s|ᵏ bounds how far a computed value may be from the one that was meant.
    slack: Coefficients,
    degree: usize,
}

impl Polynomial {
    /// Where a parabola turns, if rounding does not tell whether it reaches 0 there.
    pub fn doubtful_vertex(&self) -> Option<f64> {
        let ([c, b, a, ..], [slack_c, slack_b, slack_a, ..]) = (&self.values, &self.slack);
        if self.degree != 2 || a.abs() <= 4.0 * slack_a {
            return None;
        }
        let s = -0.5 * b / a;
        let slack = (slack_a * s.abs() + slack_b) * s.abs() + slack_c;
        (((a * s + b) * s + c).abs() <= slack).then_some(s)
    }

    /// `errors` holds how far each of `values` may be off.
    pub fn new(values: Coefficients, errors: Coefficients) -> Self {
        let known = |k: &usize| values[*k] != 0.0 || errors[*k] != 0.0;
        let degree = (0..=MOST).rev().find(known).unwrap_or(0);
        let mut slack = errors;
        for (k, slack) in slack.iter_mut().enumerate() {
            // Horner's rule rounds the term of sᵏ 2k + 1 times; the rest is for the bound itself.
            *slack = (*slack + (2 * k + 2) as f64 * U * values[k].abs()) * (1.0 + 64.0 * U);
        }
        Self { values, slack, degree }
    }

    /// Where it changes its sign on the whole line, in order. `size` is about how far from 0 most of them
    /// are to be expected: it costs time where it is far from right, and nothing else. A root nearer than
    /// that need be found no better than `tolerance`.
    pub fn roots(&self, size: f64, tolerance: f64) -> Roots {
        if let Some(roots) = self.roots_of_parabola() {
            return roots;
        }
        let mut roots = Roots::new();
        let Some((near, scale)) = self.parted(size) else { return roots };
        let far = near.reversed();
        let odd = near.degree % 2 == 1;
        // From −∞ to −σ: w = σ/s goes from 0 down to −1.
        let before = far.between((-1.0, 0.0), 0.0).into_iter().rev();
        roots.extend(before.filter_map(|bracket| bracket.outer(scale, odd)));
        let within = near.between((-1.0, 1.0), tolerance / scale);
        roots.extend(within.into_iter().map(|bracket| bracket.root(scale)));
        let behind = far.between((0.0, 1.0), 0.0).into_iter().rev();
        roots.extend(behind.filter_map(|bracket| bracket.outer(scale, false)));
        roots
    }

    /// Those of degree 2 by the formula, each then held to its sign on both sides; `None` where it is of
    /// another degree, or its ends or its middle tell nothing.
    fn roots_of_parabola(&self) -> Option<Roots> {
        let [c, b, a, ..] = self.values;
        if self.degree != 2 || a == 0.0 {
            return None;
        }
        let opens_up = a > 0.0;
        let outside = if opens_up { 1 } else { -1 };
        let middle = -0.5 * b / a;
        let discriminant = b * b - 4.0 * a * c;
        let root = discriminant.max(0.0).sqrt();
        // Both half as far beyond each root as they are apart.
        let width = root / a.abs();
        let (low, high) = (middle - width, middle + width);
        if self.sign(low) != outside || self.sign(high) != outside {
            return None;
        }
        if self.sign(middle) != -outside {
            return Some(Roots::new());
        }
        // The farther root first: nothing cancels.
        let q = -0.5 * (b + root.copysign(b));
        let (one, other) = (q / a, c / q);
        let (first, last) = if one < other { (one, other) } else { (other, one) };
        let sides = [
            (first, Change { low, high: middle, rising: !opens_up }),
            (last, Change { low: middle, high, rising: opens_up }),
        ];
        let found = sides.map(|(s, change)| self.held(s, change, 0.0).root(1.0));
        found.iter().all(|root| root.error.is_finite()).then(|| found.into_iter().collect())
    }

    /// The polynomial of s/σ, and a power of two σ near `size` where it is certainly not 0, nor at −σ. `None`
    /// where there is none: it may be 0 everywhere.
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
        let mut power = 1.0;
        for k in 0..=self.degree {
            scaled.values[k] *= power;
            scaled.slack[k] *= power;
            power *= scale;
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

    /// The sign at s; 0 where the bound does not tell it.
    fn sign(&self, s: f64) -> i8 {
        let value = value(&self.values[..=self.degree], s);
        let slack = value_of_positive(&self.slack[..=self.degree], s.abs());
        match () {
            () if value > slack && value.is_finite() => 1,
            () if value < -slack && value.is_finite() => -1,
            () => 0,
        }
    }

    /// The certain changes of sign from `low` to `high`, in order: −1, 0 or 1.
    fn between(&self, (low, high): (f64, f64), tolerance: f64) -> Brackets {
        let mut marks = Marks::from_slice(&[low]);
        for (ends, way) in [((-1.0, 0.0), -1.0), ((0.0, 1.0), 1.0)] {
            if low <= ends.0 && ends.1 <= high {
                let all = ..=self.degree;
                let form = Form::of(&self.values[all], &self.slack[all], way);
                self.mark(&form, ends, HALVED, &mut marks);
            }
        }
        let mut before = None;
        let changes = marks.into_iter().filter_map(|at| self.advance(&mut before, at));
        changes
            .collect::<Changes>()
            .into_iter()
            .map(|change| self.root(change, tolerance))
            .collect()
    }

    /// Adds places of a piece, the last its end, between which there is one root at most.
    fn mark(&self, form: &Form, (low, high): (f64, f64), halved: u32, marks: &mut Marks) {
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

    /// Goes on to `at`, if its sign is certain there.
    fn advance(&self, before: &mut Option<(f64, i8)>, at: f64) -> Option<Change> {
        let sign = self.sign(at);
        if sign == 0 {
            return None;
        }
        let (low, old) = before.replace((at, sign))?;
        (old != sign).then_some(Change { low, high: at, rising: sign > 0 })
    }

    /// The root at a change of sign, with as little around it as has certain signs at its ends, or no more
    /// than `tolerance` to each side.
    fn root(&self, change: Change, tolerance: f64) -> Bracket {
        let s = root_between(&self.values[..=self.degree], change, tolerance);
        self.held(s, change, tolerance)
    }

    /// As [`Self::root`], where about `s` is the root.
    fn held(&self, s: f64, change: Change, tolerance: f64) -> Bracket {
        let Change { low, high, rising } = change;
        let values = &self.values[..=self.degree];
        let (_, slope) = value_and_slope(values, s);
        let slack = value_of_positive(&self.slack[..=self.degree], s.abs());
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

/// Two places of certain and opposite signs.
#[derive(Debug, Clone, Copy)]
struct Change {
    low: f64,
    high: f64,
    rising: bool,
}

/// A root and two places that it is certainly between.
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

    /// A root of the reversed polynomial as one of the line; `None` where it could as well be beyond ∞.
    /// `odd` where the signs of the two polynomials differ.
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

/// The least order of a derivative that certainly keeps its sign between two places: its coefficients in
/// Bernstein's form, which are the differences of the polynomial's, have one sign.
///
/// **Source:** G. Farin, *Curves and Surfaces for CAGD* (2002), ch. 5.
fn order_without_roots(values: &[f64], low: f64, high: f64) -> usize {
    let degree = values.len() - 1;
    let mut forms: SmallVec<[f64; 8]> = SmallVec::from_slice(values);
    for first in 0..degree {
        for k in (first..degree).rev() {
            forms[k] += low * forms[k + 1];
        }
    }
    let (mut power, mut choices) = (1.0, 1.0);
    for (k, form) in forms.iter_mut().enumerate() {
        *form *= power / choices;
        power *= high - low;
        choices *= (degree - k) as f64 / (k + 1) as f64;
    }
    for first in 1..=degree {
        for k in (first..=degree).rev() {
            forms[k] += forms[k - 1];
        }
    }
    let mut rounding = 64.0 * U * forms.iter().fold(0.0, |most: f64, form| most.max(form.abs()));
    for order in 1..degree {
        forms = forms.windows(2).map(|pair| pair[1] - pair[0]).collect();
        rounding *= 2.0;
        let rises = forms.iter().all(|form| *form > rounding);
        if rises || forms.iter().all(|form| *form < -rounding) {
            return order;
        }
    }
    degree
}

/// Where the derivative is 0 between two places, in order, to rounding.
pub fn turning_points(values: &[f64], low: f64, high: f64) -> SmallVec<[f64; 8]> {
    let degree = values.len() - 1;
    let mut points: SmallVec<[f64; 8]> = SmallVec::new();
    // Derivatives of falling order, from the first below one that has no roots; each over the factorial of its
    // order, which has the same ones.
    for order in (1..order_without_roots(values, low, high)).rev() {
        let mut derivative = [0.0; MOST + 1];
        let mut share = 1.0;
        for j in order..=degree {
            derivative[j - order] = share * values[j];
            share *= (j + 1) as f64 / (j + 1 - order) as f64;
        }
        let derivative = &derivative[..=degree - order];
        let mut found: SmallVec<[f64; 8]> = SmallVec::new();
        let (mut from, mut below) = (low, value(derivative, low));
        for &to in points.iter().chain([&high]) {
            let above = value(derivative, to);
            if above == 0.0 && to < high {
                found.push(to);
            } else if (below < 0.0 && above > 0.0) || (below > 0.0 && above < 0.0) {
                let change = Change { low: from, high: to, rising: above > 0.0 };
                found.push(root_between(derivative, change, 0.0));
            }
            (from, below) = (to, above);
        }
        points = found;
    }
    points
}

/// Where a polynomial changes its sign between two places at which it has opposite ones, or about within
/// `tolerance` of it: by Newton's steps while they stay between the places known best, else by halves.
fn root_between(values: &[f64], change: Change, tolerance: f64) -> f64 {
    let Change { mut low, mut high, rising } = change;
    let mut s = 0.5 * (low + high);
    // Newton's steps square the error at a simple root; at others halves have to do.
    for turn in 0..128 {
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
        let halve = turn % 4 == 3 || !(newton > low && newton < high);
        let next = if halve { middle } else { newton };
        if (newton - s).abs() <= (U * s.abs()).max(0.5 * tolerance)
            || next == low && middle == low
            || next == high
        {
            return s;
        }
        s = next;
    }
    s
}

/// Where a polynomial changes its sign between two places, to rounding, if it has opposite ones there.
pub fn root_between_ends(values: &[f64], (low, high): (f64, f64)) -> Option<f64> {
    let (below, above) = (value(values, low), value(values, high));
    let change = Change { low, high, rising: above > 0.0 };
    (below * above < 0.0).then(|| root_between(values, change, 0.0))
}

fn value(values: &[f64], s: f64) -> f64 {
    values.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

fn value_of_positive(values: &[f64], s: f64) -> f64 {
    value(values, s) * (1.0 + 64.0 * U)
}

fn value_and_slope(values: &[f64], s: f64) -> (f64, f64) {
    let step = |(value, slope), c: &f64| (value * s + c, slope * s + value);
    values.iter().rev().fold((0.0, 0.0), step)
}

#[cfg(test)]
mod tests;
