//! Bounds of noise and its slopes over a box.
//!
//! **In:** a box. **Out:** intervals. **Invariant:** the intervals contain the values at every point of the
//! box, and the slopes between any two; for a box within a cell or two of the lattice, they are nearly
//! optimal.
//!
//! Within a cell, noise blends the linear functions of the eight corners along one axis after another by s =
//! 3t² − 2t³. A blend of intervals lies between the blends of their ends, at the ends of s; its slope is the
//! blend of the slopes, plus s′ times the difference.

#![expect(
    clippy::needless_range_loop,
    reason = "closures would not be inlined where the instructions are"
)]

use super::{
    LATTICE_ORIGIN, NoiseGenerator, SCALE, SHIFT, corners, noise, noise_and_slopes, perlin,
    vector_noise,
};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::wide::*;

/// Coordinate beyond which rounding makes slopes meaningless.
const FAR: f64 = 1e6;

/// A corner of a cell: its value, and its slopes.
pub(super) type Linear = [f64; 4];

/// How noise is made of a blend of corners: (blend + shift)·scale, cut off.
struct Shape {
    shift: f64,
    scale: f64,
    /// What rounding may do to a value.
    rounded: f64,
    /// What rounding may do to a slope.
    turned: f64,
    /// The steepest slope along an axis.
    steepest: f64,
    /// The most that a slope along an axis changes, as a multiple of how far the point moves along each.
    bent: f64,
}

impl Shape {
    /// Bounds for all boxes. The steepest slope is that at any place in a cell, with the data at each of its corners
    /// that make it steepest: over a grid of places at most 3.87 for the measured data, 2.18 for gradients of length
    /// 1. The limits leave room for what lies between the places, by estimate and not by proof.
    ///
    /// |s′| is at most 1.5 and |s″| at most 6, and the linear functions of two adjacent corners, with |value| ≤ ½ + 3
    /// within a cell and slope ≤ 1, differ by at most 7; so a slope changes by at most 6·7 + 2·1.5·2 along its axis,
    /// and 1.5·1.5·14 + 2·1.5·2 across. Perlin noise has |value| ≤ √3.
    fn of(generator: NoiseGenerator) -> Self {
        let (rounded, turned) = (1e-14, 1e-12);
        match generator {
            NoiseGenerator::Plateaus => {
                Self { shift: 0.5, scale: 1.0, rounded, turned, steepest: 4.0, bent: 50.0 }
            }
            NoiseGenerator::RangeCorrected => Self {
                shift: 0.5 + SHIFT,
                scale: SCALE,
                steepest: 4.0 * SCALE.next_up(),
                bent: 50.0 * SCALE,
                rounded,
                turned,
            },
            // Its coordinates come in steps of 2⁻²⁹.
            NoiseGenerator::Perlin => Self {
                shift: 0.4925 / 0.795,
                scale: 0.795,
                rounded: 1e-8,
                turned: 2e-7,
                steepest: 2.3 * 0.795,
                bent: 30.0 * 0.795,
            },
        }
    }
}

/// Returns how far computed noise may be from the exact one.
pub(super) fn rounding(generator: NoiseGenerator) -> f64 {
    Shape::of(generator).rounded
}

/// Sum of the sides up to which a box counts as a point.
const POINT: f64 = 1e-8;

fn sides(point: &[Interval; 3]) -> f64 {
    let [x, y, z] = point;
    (x.high - x.low) + (y.high - y.low) + (z.high - z.low)
}

/// Returns the range of noise over a box.
pub(super) fn value_range(generator: NoiseGenerator, point: [Interval; 3]) -> Interval {
    let Shape { steepest, rounded, .. } = Shape::of(generator);
    let change = sides(&point) * steepest;
    if change <= 64.0 * rounded && is_local(&point) {
        let there = noise(generator, Vector::from_array(middle(&point)));
        let off = change + rounded;
        return Interval { low: (there - off).max(0.0), high: (there + off).min(1.0) };
    }
    range(generator, point).0
}

/// Returns the range of noise over a box, and of its slope along each axis, which includes 0 where noise is
/// clamped. For a box longer than a cell, the bounds are global.
pub(super) fn range(generator: NoiseGenerator, point: [Interval; 3]) -> (Interval, [Interval; 3]) {
    const RANGE: Interval = Interval { low: 0.0, high: 1.0 };
    let Shape { shift, scale, rounded, turned, steepest, bent } = Shape::of(generator);
    if !is_local(&point) {
        return (RANGE, [Interval { low: -steepest, high: steepest }; 3]);
    }
    let (middle, sides) = (middle(&point), sides(&point));
    let (value, slopes) = if sides <= POINT {
        let (there, slopes) = noise_and_slopes(generator, Vector::from_array(middle));
        let off = bent * sides + turned;
        let slopes = slopes.map(|slope| Interval { low: slope - off, high: slope + off });
        let off = change(&point, middle, &slopes) + rounded;
        (Interval { low: there - off, high: there + off }, slopes)
    } else {
        let (value, slopes) = match generator {
            NoiseGenerator::Perlin => over(point.map(perlin::shifted), 0, perlin::corners),
            NoiseGenerator::Plateaus | NoiseGenerator::RangeCorrected => {
                over(point, LATTICE_ORIGIN, |low| corners(0, low))
            }
        };
        let value =
            Interval { low: (value.low + shift) * scale, high: (value.high + shift) * scale };
        let slopes = slopes.map(|slope| Interval {
            low: (slope.low * scale - 1e-12).max(-steepest),
            high: (slope.high * scale + 1e-12).min(steepest),
        });
        let there = noise(generator, Vector::from_array(middle));
        (narrowed(value, there, change(&point, middle, &slopes), rounded), slopes)
    };
    let is_cut = value.low <= 0.0 || value.high >= 1.0;
    let value = Interval { low: value.low.clamp(0.0, 1.0), high: value.high.clamp(0.0, 1.0) };
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
        let (value, slopes) = over(point, LATTICE_ORIGIN, |low| corners(component, low));
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
    corners: impl Fn([usize; 3]) -> [Linear; 8],
) -> (Interval, [Interval; 3]) {
    dispatch!(Instructions::best().level(), simd => over_by(simd, point, origin, corners))
}

#[inline(always)]
fn over_by<S: Simd>(
    simd: S,
    [x, y, z]: [Interval; 3],
    origin: i64,
    corners: impl Fn([usize; 3]) -> [Linear; 8],
) -> (Interval, [Interval; 3]) {
    let [x, y, z] = [Span::of(x, origin), Span::of(y, origin), Span::of(z, origin)];
    let [mut low, mut high] = [all(simd, f64::INFINITY), all(simd, f64::NEG_INFINITY)];
    for i in 0..x.1 {
        for j in 0..y.1 {
            for k in 0..z.1 {
                let spans = [x.0[i], y.0[j], z.0[k]];
                let mut corners = corners([spans[0].index, spans[1].index, spans[2].index]);
                for at in 0..8 {
                    let [value, x, y, z] = corners[at];
                    let [i, j, k] = [(at >> 2) as f64, (at >> 1 & 1) as f64, (at & 1) as f64];
                    corners[at][0] = value - x * i - y * j - z * k;
                }
                let here = within(simd, &spans, &corners);
                (low, high) = (low.min(here.low), high.max(here.high));
            }
        }
    }
    let (low, high): ([f64; 4], [f64; 4]) = (low.into(), high.into());
    let at = |lane: usize| Interval { low: low[lane], high: high[lane] };
    (at(0), [at(1), at(2), at(3)])
}

/// Four intervals.
#[derive(Clone, Copy)]
struct Ranges<S: Simd> {
    low: Wide<S>,
    high: Wide<S>,
}

impl<S: Simd> Ranges<S> {
    /// Returns the ranges of four linear functions, given their values at zero and their slopes.
    #[inline(always)]
    fn linear(simd: S, [at_zero, x, y, z]: [Wide<S>; 4], spans: &[Span; 3]) -> Self {
        let mut sum = Self { low: at_zero, high: at_zero };
        let slopes = [x, y, z];
        for axis in 0..3 {
            let [from, to] = spans[axis].from;
            let (a, b) = (slopes[axis] * all(simd, from), slopes[axis] * all(simd, to));
            sum = Self { low: sum.low + a.min(b), high: sum.high + a.max(b) };
        }
        sum
    }

    /// Returns the ranges of a + s·(b − a) over all s, given s at its ends.
    #[inline(always)]
    fn blend(self, other: Self, [from, to]: [Wide<S>; 2]) -> Self {
        let (low, high) = (other.low - self.low, other.high - self.high);
        Self {
            low: (self.low + from * low).min(self.low + to * low),
            high: (self.high + from * high).max(self.high + to * high),
        }
    }

    /// Returns the products with an interval of positive numbers.
    #[inline(always)]
    fn times(self, simd: S, positive: Interval) -> Self {
        let [zero, low, high] = [0.0, positive.low, positive.high].map(|n| all(simd, n));
        Self {
            low: self.low * self.low.simd_lt(zero).select(high, low),
            high: self.high * self.high.simd_gt(zero).select(high, low),
        }
    }
}

/// Returns the range within one cell, and of the slopes along its axes, from the linear functions of its corners.
#[inline(always)]
fn within<S: Simd>(simd: S, spans: &[Span; 3], corners: &[Linear; 8]) -> Ranges<S> {
    // A row for each: at four edges along an axis, which are ordered by the two other axes.
    let mut edges = [[[0.0; 4]; 4]; 2];
    for axis in 0..3 {
        let [first, second] = [(axis + 1) % 3, (axis + 2) % 3];
        let place = |at: usize| (at & 1) << (2 - first) | (at >> 1) << (2 - second);
        let near = four_of(simd, corners, [place(0), place(1), place(2), place(3)]);
        let along = 4 >> axis;
        let far = [place(0) | along, place(1) | along, place(2) | along, place(3) | along];
        let far = four_of(simd, corners, far);
        let weights = [all(simd, spans[axis].weight[0]), all(simd, spans[axis].weight[1])];
        if axis == 0 {
            let [near, far] = [Ranges::linear(simd, near, spans), Ranges::linear(simd, far, spans)];
            let value = near.blend(far, weights);
            (edges[0][0], edges[1][0]) = (value.low.into(), value.high.into());
        }
        let difference = [far[0] - near[0], far[1] - near[1], far[2] - near[2], far[3] - near[3]];
        let rise = Ranges::linear(simd, difference, spans).times(simd, spans[axis].rise);
        let [near, far] = [near[axis + 1], far[axis + 1]];
        let slope = Ranges { low: near, high: near }.blend(Ranges { low: far, high: far }, weights);
        edges[0][axis + 1] = (slope.low + rise.low).into();
        edges[1][axis + 1] = (slope.high + rise.high).into();
    }
    // Now the lanes are the value and the slopes, which are blended along the two axes that are left.
    let column = |at: usize| {
        let [low, high] = edges.map(|rows| rows.map(|row| row[at]));
        (low, high)
    };
    let mut four = [Ranges { low: all(simd, 0.0), high: all(simd, 0.0) }; 4];
    for at in 0..4 {
        let (low, high) = column(at);
        four[at] = Ranges { low: Wide::simd_from(simd, low), high: Wide::simd_from(simd, high) };
    }
    let ends = |axes: [usize; 4], end: usize| axes.map(|axis| spans[axis].weight[end]);
    let weights = |axes: [usize; 4]| [ends(axes, 0), ends(axes, 1)];
    let [from, to] = weights([1, 1, 2, 0]);
    let first = [Wide::simd_from(simd, from), Wide::simd_from(simd, to)];
    let [from, to] = weights([2, 2, 0, 1]);
    let second = [Wide::simd_from(simd, from), Wide::simd_from(simd, to)];
    let near = four[0].blend(four[1], first);
    near.blend(four[2].blend(four[3], first), second)
}

/// Returns four of the corners, by their value and slopes.
#[inline(always)]
fn four_of<S: Simd>(simd: S, corners: &[Linear; 8], places: [usize; 4]) -> [Wide<S>; 4] {
    let mut rows = [[0.0; 4]; 4];
    for lane in 0..4 {
        let corner = &corners[places[lane] % 8];
        for component in 0..4 {
            rows[component][lane] = corner[component];
        }
    }
    [
        Wide::simd_from(simd, rows[0]),
        Wide::simd_from(simd, rows[1]),
        Wide::simd_from(simd, rows[2]),
        Wide::simd_from(simd, rows[3]),
    ]
}
