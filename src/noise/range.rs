//! Bounds of noise and its slopes over a box.
//!
//! **In:** a box. **Out:** intervals. **Invariant:** the intervals contain the values at every point of the
//! box, and the slopes between any two; for a box within a cell or two of the lattice, they are nearly
//! optimal.
//!
//! Within a cell, noise blends the linear functions of the eight corners along one axis after another by s =
//! 3t² − 2t³. A blend of intervals lies between the blends of their ends, at the ends of s; its slope is the
//! blend of the slopes, plus s′ times the difference.

use super::{LATTICE_ORIGIN, NoiseGenerator, corner, noise, perlin, vector_noise};
use crate::math::Vector;
use crate::math::interval::Interval;

/// Coordinate beyond which rounding makes slopes meaningless.
const FAR: f64 = 1e6;

/// A corner of a cell: its value, and its slopes.
pub(super) type Linear = [f64; 4];

/// Returns the range of noise over a box, and of its slope along each axis, which includes 0 where noise is
/// clamped.
///
/// For a box longer than a cell, the bounds are global: |s′| is at most 1.5, and the linear functions of two
/// adjacent corners, with |value| ≤ ½ + 3 within a cell and slope ≤ 1, differ by at most 7; so the slope is
/// at most 1.5·7 + 1 along each axis. Perlin noise has |value| ≤ √3.
pub(super) fn range(generator: NoiseGenerator, point: [Interval; 3]) -> (Interval, [Interval; 3]) {
    const RANGE: Interval = Interval { low: 0.0, high: 1.0 };
    // (v + shift)·scale, cut off; what rounding may do to v; the steepest slope.
    let (shift, scale, rounded, steepest) = match generator {
        NoiseGenerator::Plateaus => (0.5, 1.0, 1e-14, 11.5),
        NoiseGenerator::RangeCorrected => {
            (0.5 + 0.552_42, 0.489_855_82, 1e-14, 11.5 * 0.489_855_83)
        }
        // Its coordinates come in steps of 2⁻²⁹.
        NoiseGenerator::Perlin => (0.4925 / 0.795, 0.795, 1e-8, 6.2 * 0.795),
    };
    if !is_local(&point) {
        return (RANGE, [Interval { low: -steepest, high: steepest }; 3]);
    }
    let (mut value, slopes) = match generator {
        NoiseGenerator::Perlin => over(point.map(perlin::shifted), 0, perlin::corner),
        NoiseGenerator::Plateaus | NoiseGenerator::RangeCorrected => {
            over(point, LATTICE_ORIGIN, |at| corner(0, at))
        }
    };
    value = Interval { low: (value.low + shift) * scale, high: (value.high + shift) * scale };
    let slopes = slopes.map(|slope| Interval {
        low: (slope.low * scale - 1e-12).max(-steepest),
        high: (slope.high * scale + 1e-12).min(steepest),
    });
    let middle = middle(&point);
    let there = noise(generator, Vector::from_array(middle));
    let value = narrowed(value, there, change(&point, middle, &slopes), rounded);
    let is_cut = value.low <= 0.0 || value.high >= 1.0;
    let value = Interval { low: value.low.max(0.0), high: value.high.min(1.0) };
    let zero = Interval { low: 0.0, high: 0.0 };
    (value, if is_cut { slopes.map(|slope| slope.hull(zero)) } else { slopes })
}

/// Returns intervals that contain the components of [`vector_noise`] over a box. For a box longer than a cell,
/// they are global.
pub(super) fn vector_range(point: [Interval; 3]) -> [Interval; 3] {
    if !is_local(&point) {
        return [Interval { low: -2.0, high: 2.0 }; 3];
    }
    let middle = middle(&point);
    let there = vector_noise(Vector::from_array(middle));
    std::array::from_fn(|component| {
        let (value, slopes) = over(point, LATTICE_ORIGIN, |at| corner(component, at));
        narrowed(value, there[component], change(&point, middle, &slopes), 1e-13)
    })
}

/// Whether a box is short enough, and near enough to the origin, for bounds of its own.
fn is_local(point: &[Interval; 3]) -> bool {
    let is_near = |i: &Interval| i.low.abs().max(i.high.abs()) < FAR;
    let is_short = |i: &Interval| i.high - i.low < 1.0;
    point.iter().all(|i| is_near(i) && is_short(i))
}

fn middle(point: &[Interval; 3]) -> [f64; 3] {
    point.map(|i| i.low + 0.5 * (i.high - i.low))
}

/// Returns the greatest change from the middle of a box on.
fn change(point: &[Interval; 3], middle: [f64; 3], slopes: &[Interval; 3]) -> f64 {
    let step = |axis: usize| {
        let away = (point[axis].high - middle[axis]).max(middle[axis] - point[axis].low);
        away * slopes[axis].low.abs().max(slopes[axis].high.abs())
    };
    step(0) + step(1) + step(2)
}

/// Returns what of a range is within a change of the value in the middle, widened by rounding.
fn narrowed(value: Interval, there: f64, change: f64, rounded: f64) -> Interval {
    Interval {
        low: value.low.max(there - change).min(there) - rounded,
        high: value.high.min(there + change).max(there) + rounded,
    }
}

/// A coordinate between its lattice neighbours.
#[derive(Clone, Copy)]
struct Place {
    /// The lower neighbour.
    low: usize,
    /// Distance from the lower neighbour, 0 … 1.
    fraction: f64,
}

impl Place {
    /// Splits a coordinate that is near.
    ///
    /// Avoids `floor`, which is a function call unless the target is known to support it.
    fn new(coordinate: f64, origin: i64) -> Self {
        let towards_zero = coordinate as i64;
        let low = towards_zero - i64::from(towards_zero as f64 > coordinate);
        Self { low: low.wrapping_add(origin) as usize, fraction: coordinate - low as f64 }
    }
}

/// Part of a cell along one axis.
#[derive(Clone, Copy)]
struct Span {
    /// Index of the cell.
    index: usize,
    /// The range in it, 0 … 1.
    from: [f64; 2],
    /// s at the ends.
    weight: [f64; 2],
    /// Range of s′.
    rise: Interval,
}

impl Span {
    fn new(index: usize, low: f64, high: f64) -> Self {
        let weight = |t: f64| t * t * (3.0 - 2.0 * t);
        let rise = |t: f64| 6.0 * t * (1.0 - t);
        let (a, b) = (rise(low), rise(high));
        let most = if low <= 0.5 && high >= 0.5 { 1.5 } else { a.max(b) };
        Self {
            index,
            from: [low, high],
            weight: [weight(low), weight(high)],
            rise: Interval { low: a.min(b), high: most },
        }
    }

    /// Splits an interval shorter than a cell into one or two parts.
    fn of(i: Interval, origin: i64) -> ([Self; 2], usize) {
        let (low, high) = (Place::new(i.low, origin), Place::new(i.high, origin));
        if low.low == high.low {
            let part = Self::new(low.low, low.fraction, high.fraction.max(low.fraction));
            return ([part; 2], 1);
        }
        ([Self::new(low.low, low.fraction, 1.0), Self::new(high.low, 0.0, high.fraction)], 2)
    }
}

/// Range over a box shorter than a cell, which may intersect up to eight cells.
fn over(
    point: [Interval; 3],
    origin: i64,
    corner: impl Fn([usize; 3]) -> Linear,
) -> (Interval, [Interval; 3]) {
    let spans = point.map(|i| Span::of(i, origin));
    let mut all: Option<(Interval, [Interval; 3])> = None;
    for x in &spans[0].0[..spans[0].1] {
        for y in &spans[1].0[..spans[1].1] {
            for z in &spans[2].0[..spans[2].1] {
                let (value, slopes) = within([*x, *y, *z], &corner);
                all = Some(match all {
                    None => (value, slopes),
                    Some((v, s)) => {
                        (v.hull(value), std::array::from_fn(|axis| s[axis].hull(slopes[axis])))
                    }
                });
            }
        }
    }
    all.unwrap_or((Interval::EVERYTHING, [Interval::EVERYTHING; 3]))
}

/// Range of a linear function, given its value at zero.
#[inline]
fn linear(at_zero: f64, slopes: [f64; 3], spans: &[Span; 3]) -> Interval {
    let mut sum = Interval { low: at_zero, high: at_zero };
    for (slope, span) in slopes.iter().zip(spans) {
        let (a, b) = (slope * span.from[0], slope * span.from[1]);
        let (less, more) = if a < b { (a, b) } else { (b, a) };
        sum = Interval { low: sum.low + less, high: sum.high + more };
    }
    sum
}

/// Range of a + s·(b − a) over all s.
#[inline]
fn blend(a: Interval, b: Interval, weight: [f64; 2]) -> Interval {
    let at = |a: f64, b: f64, s: f64| a + s * (b - a);
    let (first, last) = (at(a.low, b.low, weight[0]), at(a.low, b.low, weight[1]));
    let low = if first < last { first } else { last };
    let (first, last) = (at(a.high, b.high, weight[0]), at(a.high, b.high, weight[1]));
    Interval { low, high: if first > last { first } else { last } }
}

#[inline]
fn times(a: Interval, positive: Interval) -> Interval {
    let low = a.low * if a.low < 0.0 { positive.high } else { positive.low };
    Interval { low, high: a.high * if a.high > 0.0 { positive.high } else { positive.low } }
}

#[inline]
fn plus(a: Interval, b: Interval) -> Interval {
    Interval { low: a.low + b.low, high: a.high + b.high }
}

/// Range within one cell. Corner i + 2j + 4k is offset by (i, j, k).
fn within(spans: [Span; 3], corner: &impl Fn([usize; 3]) -> Linear) -> (Interval, [Interval; 3]) {
    let index = |axis: usize, further: usize| spans[axis].index.wrapping_add(further);
    // Each from the cell's first corner on.
    let all: [Linear; 8] = std::array::from_fn(|at| {
        let further = [at & 1, at >> 1 & 1, at >> 2];
        let [value, x, y, z] =
            corner([index(0, further[0]), index(1, further[1]), index(2, further[2])]);
        let [i, j, k] = further.map(|further| further as f64);
        [value - x * i - y * j - z * k, x, y, z]
    });
    let of = |[value, x, y, z]: Linear| linear(value, [x, y, z], &spans);
    let single = |value: f64| Interval { low: value, high: value };
    let values = all.map(of);
    // Blended along the axes of `ways`, but for the one that is left out by the caller.
    let weights = spans.map(|span| span.weight);
    let plane = |four: [Interval; 4], first: usize, second: usize| {
        let near = blend(four[0], four[1], weights[first]);
        let off = blend(four[2], four[3], weights[first]);
        blend(near, off, weights[second])
    };
    let value = {
        let edge = |at: usize| blend(values[at], values[at + 1], weights[0]);
        plane([edge(0), edge(2), edge(4), edge(6)], 1, 2)
    };
    let slope = |axis: usize| {
        let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
        let edges = std::array::from_fn(|at| {
            let near = (at & 1) << first | (at >> 1) << second;
            let (a, b) = (all[near], all[near | 1 << axis]);
            let difference = of(std::array::from_fn(|i| b[i] - a[i]));
            let slopes = blend(single(a[axis + 1]), single(b[axis + 1]), weights[axis]);
            plus(slopes, times(difference, spans[axis].rise))
        });
        plane(edges, first, second)
    };
    (value, [slope(0), slope(1), slope(2)])
}
