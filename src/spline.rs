//! Splines: values that vary smoothly over time.
//!
//! **Invariant:** the times of the knots are strictly increasing; before the first and after the last, the
//! value is constant.
//!
//! **Source:** manual, section 3.3.1.10 ("Splines"); unspecified details were determined from POV-Ray's
//! values (see the table in the tests): a quadratic piece passes through the preceding point; the slope of a
//! cubic piece at each end is the mean of those on either side. A value replaces an earlier one for the same
//! time, unless that time is the last of several so far: then it is dropped.

use crate::math::interval::Interval;

/// Length of a time span, relative to the time, below which rounding makes its thirds uneven.
const UNEVEN: f64 = 1.0 / (1_u32 << 20) as f64;

/// The numbers of one value: two to five; the others are zero.
type Values = [f64; 5];

/// The interpolation between two knots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SplineKind {
    Linear,
    /// A parabola through both ends and the preceding point (the following one for the first piece).
    Quadratic,
    /// A cubic with given slopes at its ends; the first and last points only determine slopes.
    Cubic,
    /// Cubics with continuous first and second derivatives; the latter are zero at both ends.
    Natural,
}

/// A value at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
    pub time: f64,
    pub value: Values,
}

/// A curve that interpolates values over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Spline {
    kind: SplineKind,
    knots: Vec<Knot>,
    /// Second derivatives at the knots of a natural spline.
    bends: Vec<Values>,
}

impl Spline {
    /// Builds a spline from knots in any order; `None` if there are none.
    pub fn new(kind: SplineKind, knots: Vec<Knot>) -> Option<Self> {
        let knots = in_order(knots);
        let bends = match kind {
            SplineKind::Natural => bends(&knots),
            SplineKind::Linear | SplineKind::Quadratic | SplineKind::Cubic => Vec::new(),
        };
        (!knots.is_empty()).then_some(Self { kind, knots, bends })
    }

    pub fn kind(&self) -> SplineKind {
        self.kind
    }

    pub fn knots(&self) -> &[Knot] {
        &self.knots
    }

    /// Returns the range of a component over a span of time.
    ///
    /// Between two knots, a component is at most a cubic, and its Bernstein coefficients, computed from four
    /// of its values, bound it over any part. Where times are so close that rounding makes the thirds uneven,
    /// the margin is as large as the range.
    pub fn bounds(&self, component: usize, over: Interval) -> Interval {
        let value = |time: f64| self.at(time).get(component).copied().unwrap_or(f64::NAN);
        let within = |time: &f64| over.low < *time && *time < over.high;
        let knots = self.knots.iter().map(|knot| knot.time).filter(within);
        let (mut from, mut all) = (over.low, None::<Interval>);
        for to in knots.chain([over.high]) {
            let third = (to - from) / 3.0;
            let [a, b, c, d] = [from, from + third, to - third, to].map(value);
            let second = (-5.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) / 6.0;
            let last_but_one = (2.0 * a - 9.0 * b + 18.0 * c - 5.0 * d) / 6.0;
            let coefficients = [a, second, last_but_one, d];
            if coefficients.iter().any(|c| !c.is_finite()) {
                return Interval::EVERYTHING;
            }
            let low = coefficients.into_iter().fold(f64::INFINITY, f64::min);
            let high = coefficients.into_iter().fold(f64::NEG_INFINITY, f64::max);
            let is_uneven = to - from <= UNEVEN * from.abs().max(to.abs());
            let room = 64.0 * f64::EPSILON * low.abs().max(high.abs())
                + if is_uneven { high - low } else { 0.0 };
            let piece = Interval { low: low - room, high: high + room };
            all = Some(all.map_or(piece, |all| all.hull(piece)));
            from = to;
        }
        all.unwrap_or(Interval::EVERYTHING)
    }

    /// Returns the value at a time.
    pub fn at(&self, time: f64) -> Values {
        let (first, last) = match self.kind {
            SplineKind::Linear | SplineKind::Quadratic | SplineKind::Natural => {
                (0, self.knots.len() - 1)
            }
            SplineKind::Cubic => match self.knots.len() {
                1 => (0, 0),
                2 => return mix(&self.knots[0], &self.knots[1], 0.5),
                count => (1, count - 2),
            },
        };
        if time.is_nan() || time <= self.knots[first].time {
            return self.knots[first].value;
        }
        if time >= self.knots[last].time {
            return self.knots[last].value;
        }
        // Both ends were seen to: there is a knot before and one after.
        let end = self.knots.partition_point(|knot| knot.time <= time).clamp(first + 1, last);
        let (from, to) = (&self.knots[end - 1], &self.knots[end]);
        let width = to.time - from.time;
        let share = (time - from.time) / width;
        match self.kind {
            SplineKind::Linear => mix(from, to, share),
            SplineKind::Quadratic => self.quadratic(end, time),
            SplineKind::Cubic => {
                let (before, after) = (&self.knots[end - 2], &self.knots[end + 1]);
                let slopes = |k: usize| {
                    let middle = slope(from, to, k);
                    [(slope(before, from, k) + middle) / 2.0, (middle + slope(to, after, k)) / 2.0]
                };
                each(|k| hermite([from.value[k], to.value[k]], slopes(k), width, share))
            }
            SplineKind::Natural => {
                let rest = 1.0 - share;
                let bend = |share: f64| (share * share * share - share) * width * width / 6.0;
                let (bend_from, bend_to) = (&self.bends[end - 1], &self.bends[end]);
                each(|k| {
                    rest * from.value[k]
                        + share * to.value[k]
                        + (bend(rest) * bend_from[k] + bend(share) * bend_to[k])
                })
            }
        }
    }

    fn quadratic(&self, end: usize, time: f64) -> Values {
        if self.knots.len() == 2 {
            let (from, to) = (&self.knots[0], &self.knots[1]);
            return mix(from, to, (time - from.time) / (to.time - from.time));
        }
        let first = end.saturating_sub(2);
        let [a, b, c] = [first, first + 1, first + 2].map(|index| self.knots[index]);
        // Newton's form.
        each(|k| {
            let (ab, bc) = (slope(&a, &b, k), slope(&b, &c, k));
            let bend = (bc - ab) / (c.time - a.time);
            a.value[k] + (time - a.time) * (ab + (time - b.time) * bend)
        })
    }
}

/// Returns, for each time in the order written, whether its value replaces an earlier one for the same time.
pub fn replacing(times: impl Iterator<Item = f64>) -> impl Iterator<Item = bool> {
    let (mut first, mut last) = (f64::INFINITY, f64::NEG_INFINITY);
    times.map(move |time| {
        let is_dropped = time == last && first < last;
        (first, last) = (first.min(time), last.max(time));
        !is_dropped
    })
}

/// Returns the effective knots in order of time.
fn in_order(knots: Vec<Knot>) -> Vec<Knot> {
    let replacing = replacing(knots.iter().map(|knot| knot.time)).collect::<Vec<_>>();
    let mut all: Vec<(Knot, bool)> = knots.into_iter().zip(replacing).collect();
    // Adding zero turns −0 into 0. What is equal keeps its order.
    all.sort_by(|(a, _), (b, _)| (a.time + 0.0).total_cmp(&(b.time + 0.0)));
    let mut kept: Vec<Knot> = Vec::with_capacity(all.len());
    for (knot, replaces) in all {
        match kept.last_mut() {
            Some(before) if before.time == knot.time => {
                if replaces {
                    *before = knot;
                }
            }
            _ => kept.push(knot),
        }
    }
    kept
}

fn each(f: impl Fn(usize) -> f64) -> Values {
    [0, 1, 2, 3, 4].map(f)
}

fn mix(from: &Knot, to: &Knot, share: f64) -> Values {
    each(|k| from.value[k] + (to.value[k] - from.value[k]) * share)
}

fn slope(from: &Knot, to: &Knot, k: usize) -> f64 {
    (to.value[k] - from.value[k]) / (to.time - from.time)
}

/// Returns the cubic with these values and slopes at its ends, at a fraction `share` of its width.
fn hermite([from, to]: [f64; 2], [leaving, arriving]: [f64; 2], width: f64, share: f64) -> f64 {
    let rest = 1.0 - share;
    rest * rest * ((1.0 + 2.0 * share) * from + share * width * leaving)
        + share * share * ((1.0 + 2.0 * rest) * to - rest * width * arriving)
}

/// Returns the second derivatives that make slopes continuous at the knots, with zeros at both ends.
///
/// **Source:** the tridiagonal system of the natural cubic spline, solved from the top down (C. de Boor, *A
/// Practical Guide to Splines*, 1978, chapter IV); diagonally dominant, so pivoting is unnecessary.
fn bends(knots: &[Knot]) -> Vec<Values> {
    let count = knots.len();
    let mut bends = vec![[0.0; 5]; count];
    let mut above = vec![0.0; count];
    for i in 1..count.saturating_sub(1) {
        let (before, here, after) = (&knots[i - 1], &knots[i], &knots[i + 1]);
        let (left, right) = (here.time - before.time, after.time - here.time);
        let pivot = 2.0 * (left + right) - left * above[i - 1];
        above[i] = right / pivot;
        let previous = bends[i - 1];
        bends[i] = each(|k| {
            let jump = 6.0 * (slope(here, after, k) - slope(before, here, k));
            (jump - left * previous[k]) / pivot
        });
    }
    for i in (1..count.saturating_sub(1)).rev() {
        let next = bends[i + 1];
        bends[i] = each(|k| bends[i][k] - above[i] * next[k]);
    }
    bends
}

#[cfg(test)]
mod tests {
    use super::*;

    const TIMES: [f64; 6] = [0.0, 1.0, 2.5, 3.0, 5.0, 6.0];

    /// Values of POV-Ray 3.7 at a time, for a spline that is 1 at one knot and 0 at the others.
    const MEASURED: &[(SplineKind, f64, [f64; 6])] = &[
        (SplineKind::Linear, -1.0, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        (SplineKind::Linear, 0.0, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        (SplineKind::Linear, 1.2, [0.0, 0.86666666666667, 0.13333333333333, 0.0, 0.0, 0.0]),
        (SplineKind::Linear, 1.75, [0.0, 0.5, 0.5, 0.0, 0.0, 0.0]),
        (SplineKind::Linear, 2.5, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
        (SplineKind::Linear, 2.7, [0.0, 0.0, 0.6, 0.4, 0.0, 0.0]),
        (SplineKind::Linear, 4.9, [0.0, 0.0, 0.0, 0.05, 0.95, 0.0]),
        (SplineKind::Linear, 5.25, [0.0, 0.0, 0.0, 0.0, 0.75, 0.25]),
        (SplineKind::Linear, 7.0, [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
        (SplineKind::Quadratic, -1.0, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        (SplineKind::Quadratic, 0.0, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        (SplineKind::Quadratic, 1.2, [-0.104, 1.04, 0.064, 0.0, 0.0, 0.0]),
        (SplineKind::Quadratic, 1.75, [-0.225, 0.875, 0.35, 0.0, 0.0, 0.0]),
        (SplineKind::Quadratic, 2.5, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
        (SplineKind::Quadratic, 2.7, [0.0, -0.02, 0.68, 0.34, 0.0, 0.0]),
        (SplineKind::Quadratic, 4.9, [0.0, 0.0, -0.152, 0.24, 0.912, 0.0]),
        (SplineKind::Quadratic, 5.25, [0.0, 0.0, 0.0, -0.03125, 0.84375, 0.1875]),
        (SplineKind::Quadratic, 7.0, [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
        (SplineKind::Cubic, -1.0, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]),
        (SplineKind::Cubic, 0.0, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]),
        (
            SplineKind::Cubic,
            1.2,
            [-0.07511111111111, 0.98414814814815, 0.11407407407407, -0.02311111111111, 0.0, 0.0],
        ),
        (SplineKind::Cubic, 1.75, [-0.09375, 0.59375, 0.6875, -0.1875, 0.0, 0.0]),
        (SplineKind::Cubic, 2.5, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
        (SplineKind::Cubic, 2.7, [0.0, -0.024, 0.648, 0.388, -0.012, 0.0]),
        (SplineKind::Cubic, 4.9, [0.0, 0.0, -0.00475, 0.033375, 1.0165, -0.045125]),
        (SplineKind::Cubic, 5.25, [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]),
        (SplineKind::Cubic, 7.0, [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]),
        (SplineKind::Natural, -1.0, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        (SplineKind::Natural, 0.0, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        (
            SplineKind::Natural,
            1.2,
            [
                -0.08426138032305,
                0.97864610866373,
                0.20083406754772,
                -0.09850220264317,
                0.00492511013216,
                -0.00164170337739,
            ],
        ),
        (
            SplineKind::Natural,
            1.75,
            [
                -0.11801349118943,
                0.58394135462555,
                0.9113436123348,
                -0.39028083700441,
                0.01951404185022,
                -0.00650468061674,
            ],
        ),
        (SplineKind::Natural, 2.5, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
        (
            SplineKind::Natural,
            2.7,
            [
                0.0074140969163,
                -0.02883259911894,
                0.63777973568282,
                0.39466079295154,
                -0.01653303964758,
                0.00551101321586,
            ],
        ),
        (
            SplineKind::Natural,
            4.9,
            [
                -0.00075330396476,
                0.0029295154185,
                -0.04285462555066,
                0.07168887665198,
                1.0247968061674,
                -0.05580726872247,
            ],
        ),
        (
            SplineKind::Natural,
            5.25,
            [
                0.00108411343612,
                -0.00421599669604,
                0.06167400881057,
                -0.10299077643172,
                0.85768860132159,
                0.18676004955947,
            ],
        ),
        (SplineKind::Natural, 7.0, [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
    ];

    fn one_at(kind: SplineKind, place: usize) -> Spline {
        let knot = |(index, time): (usize, &f64)| Knot {
            time: *time,
            value: [f64::from(u8::from(index == place)), 0.0, 0.0, 0.0, 0.0],
        };
        Spline::new(kind, TIMES.iter().enumerate().map(knot).collect()).expect("six knots")
    }

    #[test]
    fn values_are_those_that_pov_ray_gives() {
        for (kind, time, expected) in MEASURED {
            for (place, expected) in expected.iter().enumerate() {
                let value = one_at(*kind, place).at(*time)[0];
                assert!((value - expected).abs() < 1e-13, "{kind:?} {place} at {time}: {value}");
            }
        }
    }

    fn spline(kind: SplineKind, knots: &[(f64, f64)]) -> Spline {
        let knots = knots.iter().map(|(time, value)| Knot { time: *time, value: [*value; 5] });
        Spline::new(kind, knots.collect()).expect("knots")
    }

    #[test]
    fn few_knots_make_what_they_can() {
        use SplineKind::{Cubic, Linear, Natural, Quadratic};
        for kind in [Linear, Quadratic, Cubic, Natural] {
            assert_eq!(spline(kind, &[(2.0, 7.0)]).at(5.0)[4], 7.0);
            let middle = spline(kind, &[(0.0, 1.0), (1.0, 5.0)]).at(0.5)[0];
            assert_eq!(middle, 3.0, "{kind:?}");
            assert_eq!(spline(kind, &[(0.0, 1.0), (1.0, 5.0), (2.0, 7.0)]).at(1.0)[0], 5.0);
            assert!(Spline::new(kind, Vec::new()).is_none());
        }
        assert_eq!(spline(Quadratic, &[(0.0, 1.0), (1.0, 5.0), (2.0, 7.0)]).at(1.5)[0], 6.25);
        assert_eq!(spline(Natural, &[(0.0, 1.0), (1.0, 5.0), (2.0, 7.0)]).at(0.5)[0], 3.1875);
    }

    #[test]
    fn knots_may_come_in_any_order() {
        let s = spline(SplineKind::Linear, &[(2.0, 1.0), (1.0, 5.0), (0.0, 1.0)]);
        assert_eq!([s.at(0.5)[0], s.at(1.5)[0], s.at(-4.0)[0], s.at(9.0)[0]], [3.0, 3.0, 1.0, 1.0]);
    }

    /// Values of POV-Ray 3.7 at 0, 1/2, 1, 3/2, 2 and 3.
    #[test]
    fn a_value_for_a_time_that_has_one_replaces_it_but_for_the_last_of_several() {
        type Case = (&'static [(f64, f64)], [f64; 6]);
        const CASES: [Case; 5] = [
            (&[(0.0, 0.0), (1.0, 1.0), (1.0, 5.0), (2.0, 6.0)], [0.0, 0.5, 1.0, 3.5, 6.0, 6.0]),
            (&[(0.0, 0.0), (1.0, 1.0), (2.0, 6.0), (1.0, 5.0)], [0.0, 2.5, 5.0, 5.5, 6.0, 6.0]),
            (&[(0.0, 0.0), (0.0, 9.0), (0.0, 4.0), (1.0, 2.0)], [4.0, 3.0, 2.0, 2.0, 2.0, 2.0]),
            (&[(0.0, 0.0), (0.0, 9.0)], [9.0, 9.0, 9.0, 9.0, 9.0, 9.0]),
            (&[(2.0, 1.0), (1.0, 5.0), (0.0, 1.0), (1.0, 9.0)], [1.0, 5.0, 9.0, 5.0, 1.0, 1.0]),
        ];
        for (knots, expected) in CASES {
            let s = spline(SplineKind::Linear, knots);
            assert_eq!([0.0, 0.5, 1.0, 1.5, 2.0, 3.0].map(|time| s.at(time)[0]), expected);
        }
    }

    #[test]
    fn a_natural_spline_has_no_corner_and_no_jump_in_its_bend() {
        let s = spline(SplineKind::Natural, &[(0.0, 1.0), (1.0, -2.0), (1.5, 4.0), (4.0, 0.5)]);
        let f = |t: f64| s.at(t)[0];
        let h = 1e-4;
        for knot in [1.0, 1.5] {
            let slope = |at: f64| (f(at + h) - f(at - h)) / (2.0 * h);
            let bend = |at: f64| (f(at + h) - 2.0 * f(at) + f(at - h)) / (h * h);
            assert!((slope(knot - 2.0 * h) - slope(knot + 2.0 * h)).abs() < 0.05);
            assert!((bend(knot - 2.0 * h) - bend(knot + 2.0 * h)).abs() < 0.1);
        }
    }
}
