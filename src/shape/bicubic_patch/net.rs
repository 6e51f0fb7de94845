//! Control nets of Bézier surfaces of degree 3 in both parameters: 16 points in four rows of four.
//!
//! **Invariant:** the surface, its parts and its derivatives each lie within the box of their own net. Four points are
//! calculated with at once, and none has other bits for it.
//!
//! **Source:** G. Farin, *Curves and Surfaces for CAGD*, 5th ed. (2002), ch. 5 and 14.

use crate::math::Vector;
use crate::math::wide::*;

/// A control net: `u` runs along the rows, `v` from row to row, both from 0 to 1. The points are stored column by
/// column: side by side are those of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Net(Rows);

/// A point on the surface, and the derivatives there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub point: Vector,
    pub along_u: Vector,
    pub along_v: Vector,
}

/// The weights of the points of a row and of a column, and the slopes of these.
#[derive(Clone, Copy)]
pub(super) struct Weights {
    across: ([f64; 4], [f64; 4]),
    down: ([f64; 4], [f64; 4]),
}

impl Weights {
    #[inline(always)]
    pub fn at([u, v]: [f64; 2]) -> Self {
        Self { across: weights(u), down: weights(v) }
    }
}

/// Values of the four Bernstein polynomials, and their slopes.
#[inline(always)]
fn weights(t: f64) -> ([f64; 4], [f64; 4]) {
    let r = 1.0 - t;
    let values = [r * r * r, 3.0 * r * r * t, 3.0 * r * t * t, t * t * t];
    let slopes = [-3.0 * r * r, 3.0 * r * (r - 2.0 * t), 3.0 * t * (2.0 * r - t), 3.0 * t * t];
    (values, slopes)
}

fn halves([a, b, c, d]: [Vector; 4]) -> ([Vector; 4], [Vector; 4]) {
    let half = |p: Vector, q: Vector| (p + q) * 0.5;
    let (ab, bc, cd) = (half(a, b), half(b, c), half(c, d));
    let (abc, bcd) = (half(ab, bc), half(bc, cd));
    let middle = half(abc, bcd);
    ([a, ab, abc, middle], [middle, bcd, cd, d])
}

impl Net {
    /// Returns the net of points row by row.
    pub fn new(points: &[Vector; 16]) -> Self {
        let mut net = Self(Rows::ZERO);
        points.iter().enumerate().for_each(|(i, point)| net.set(i % 4, i / 4, *point));
        net
    }

    /// Returns the point of a column and a row.
    #[inline(always)]
    pub fn point(&self, column: usize, row: usize) -> Vector {
        self.0.at(LANES * column + row)
    }

    #[inline(always)]
    fn set(&mut self, column: usize, row: usize, point: Vector) {
        self.0.set(LANES * column + row, point);
    }

    /// Returns the points row by row.
    pub fn points(&self) -> [Vector; 16] {
        std::array::from_fn(|i| self.point(i % 4, i / 4))
    }

    /// Returns a coordinate of the points of a column.
    #[inline(always)]
    pub fn column<S: Simd>(&self, simd: S, axis: usize, column: usize) -> Wide<S> {
        four(simd, &self.0.0[axis], column)
    }

    /// Returns a coordinate of the point on the surface, and of the derivatives along u and v.
    #[inline(always)]
    pub fn coordinate<S: Simd>(&self, simd: S, axis: usize, weights: &Weights) -> [f64; 3] {
        let Weights { across: (across, slope_u), down: (down, slope_v) } = weights;
        let points = weighed(simd, &self.0.0[axis], across);
        let down = Wide::simd_from(simd, *down);
        let along_u = weighed(simd, &self.0.0[axis], slope_u) * down;
        let along_v = points * Wide::simd_from(simd, *slope_v);
        [sum(points * down), sum(along_u), sum(along_v)]
    }

    #[inline(always)]
    pub fn place<S: Simd>(&self, simd: S, place: [f64; 2]) -> Place {
        let weights = Weights::at(place);
        let x = self.coordinate(simd, 0, &weights);
        let y = self.coordinate(simd, 1, &weights);
        let z = self.coordinate(simd, 2, &weights);
        Place {
            point: Vector::new(x[0], y[0], z[0]),
            along_u: Vector::new(x[1], y[1], z[1]),
            along_v: Vector::new(x[2], y[2], z[2]),
        }
    }

    /// Returns the net relative to a point, along three axes.
    #[inline(always)]
    pub fn seen<S: Simd>(&self, simd: S, from: Vector, axes: &[Vector; 3]) -> Self {
        let from = WideVector::splat(simd, from);
        let [x, y, z] = axes;
        let x = WideVector::splat(simd, *x);
        let y = WideVector::splat(simd, *y);
        let z = WideVector::splat(simd, *z);
        let mut seen = Rows::ZERO;
        for column in 0..GROUPS {
            let way = WideVector::of(simd, &self.0, column) - from;
            WideVector([way.dot(x), way.dot(y), way.dot(z)]).store(&mut seen, column);
        }
        Self(seen)
    }

    /// Keeps the part for the lower half of u, and returns the upper one.
    pub fn halve_along_u(&mut self) -> Self {
        self.halve(|row, i| (i, row))
    }

    /// Like [`Self::halve_along_u`], along v.
    pub fn halve_along_v(&mut self) -> Self {
        self.halve(|column, i| (column, i))
    }

    /// Halves each of four curves; the i-th point of each is in the column and the row of `at(line, i)`.
    #[inline(always)]
    fn halve(&mut self, at: impl Fn(usize, usize) -> (usize, usize)) -> Self {
        let mut high = *self;
        for line in 0..4 {
            let point = |i: usize| {
                let (column, row) = at(line, i);
                self.point(column, row)
            };
            let (first, second) = halves([point(0), point(1), point(2), point(3)]);
            for i in 0..4 {
                let (column, row) = at(line, i);
                self.set(column, row, first[i]);
                high.set(column, row, second[i]);
            }
        }
        high
    }

    /// Returns the control points of the derivative along u.
    #[inline(always)]
    pub fn steps_along_u(&self) -> [Vector; 12] {
        let step = |column: usize, row: usize| {
            (self.point(column + 1, row) - self.point(column, row)) * 3.0
        };
        std::array::from_fn(|i| step(i % 3, i / 3))
    }

    /// Returns the control points of the derivative along v.
    #[inline(always)]
    pub fn steps_along_v(&self) -> [Vector; 12] {
        let step = |column: usize, row: usize| {
            (self.point(column, row + 1) - self.point(column, row)) * 3.0
        };
        std::array::from_fn(|i| step(i % 4, i / 4))
    }

    /// Returns the corners of its bounding box.
    pub fn bounds(&self) -> (Vector, Vector) {
        bounds(&self.points())
    }

    /// Returns the control points of an edge: u = 0, u = 1, v = 0, v = 1.
    pub fn edge(&self, edge: usize) -> [Vector; 4] {
        std::array::from_fn(|i| match edge {
            0 => self.point(0, i),
            1 => self.point(3, i),
            2 => self.point(i, 0),
            _ => self.point(i, 3),
        })
    }

    /// Returns an upper bound on `along`·P over the surface, too large by at most 2⁻¹² of its size.
    pub fn greatest(&self, along: Vector) -> f64 {
        /// More pieces than any surface needs, unless it is nearly flat across `along`.
        const MOST: usize = 4096;
        let value = |net: &Self| {
            let heights = net.points().map(|point| point.dot(along));
            let hull = heights.into_iter().fold(f64::NEG_INFINITY, f64::max);
            let corners = [0, 3, 12, 15].map(|i| heights[i]);
            (hull, corners.into_iter().fold(f64::NEG_INFINITY, f64::max))
        };
        let (low, high) = self.bounds();
        let enough = (high - low).length() * along.length() / 4096.0;
        let (hull, mut found) = value(self);
        let (mut pieces, mut greatest) = (vec![(*self, hull, 0)], f64::NEG_INFINITY);
        let mut count = 0;
        while let Some((mut net, hull, depth)) = pieces.pop() {
            count += 1;
            if hull <= found + enough || count > MOST {
                greatest = greatest.max(hull);
                continue;
            }
            let high = if depth % 2 == 0 { net.halve_along_u() } else { net.halve_along_v() };
            for half in [net, high] {
                let (hull, corner) = value(&half);
                found = found.max(corner);
                pieces.push((half, hull, depth + 1));
            }
        }
        greatest.max(found)
    }
}

/// Returns the sums of the points of each row, each with the weight of its column.
#[inline(always)]
fn weighed<S: Simd>(simd: S, points: &Row, [a, b, c, d]: &[f64; 4]) -> Wide<S> {
    four(simd, points, 0) * all(simd, *a)
        + four(simd, points, 1) * all(simd, *b)
        + four(simd, points, 2) * all(simd, *c)
        + four(simd, points, 3) * all(simd, *d)
}

/// Returns the sum of four numbers, from the first on.
#[inline(always)]
fn sum<S: Simd>(numbers: Wide<S>) -> f64 {
    let [a, b, c, d]: [f64; 4] = numbers.into();
    0.0 + a + b + c + d
}

pub(super) fn bounds(points: &[Vector]) -> (Vector, Vector) {
    let all = (Vector::INFINITY, Vector::NEG_INFINITY);
    points.iter().fold(all, |(low, high), point| (low.min(*point), high.max(*point)))
}
