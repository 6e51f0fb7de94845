//! Pieces of a patch: whether a line is beside one, and where it intersects one that is nearly linear.
//!
//! **Invariant:** an intersection is within its error bound, and there is no other in a piece that is nearly linear.

use super::super::U;
use super::super::local::Met;
use super::net::{Net, Place, Weights};
use super::part_at;
use crate::math::Vector;
use crate::math::wide::*;

/// Maximum deviation of a piece's map from a linear one for Newton's method: below 1/3, convergence to the
/// single root is certain.
const NEARLY_LINEAR: f64 = 0.3;

/// A part of the surface; relative to a line, x and y are across it, and z is along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    pub net: Net,
    /// Start in u and v.
    pub start: [f64; 2],
    /// Extent in u and v.
    pub size: [f64; 2],
}

/// Classification of a piece.
pub(super) enum Seen {
    /// Beside the line, or beside the requested range of it.
    Beside,
    /// The map from u and v to the distances from the line is nearly linear: composed with this matrix, it
    /// differs from the identity by at most the second value.
    Linear([[f64; 2]; 2], f64),
    /// Entirely on the line, within rounding.
    Point,
    /// None of these.
    Bent,
}

/// An intersection of the line with the surface.
pub(super) struct Root {
    pub met: Met,
    pub place: [f64; 2],
    /// Error of `place`.
    pub off: [f64; 2],
}

impl Piece {
    /// Returns whether lines that intersect its box are likely to need its halves.
    pub fn is_bent(&self) -> bool {
        let off = |steps: [Vector; 12]| {
            let mean = steps.iter().copied().sum::<Vector>() / 12.0;
            let farthest = steps.iter().map(|step| (*step - mean).length()).fold(0.0, f64::max);
            farthest > NEARLY_LINEAR * mean.length()
        };
        off(self.net.steps_along_u()) || off(self.net.steps_along_v())
    }

    /// Classifies it for a range along the line, where distances below `off` count as 0.
    #[inline(always)]
    pub fn look<S: Simd>(&self, simd: S, (from, to): (f64, f64), off: f64) -> Seen {
        let x = Extremes::of(simd, &self.net, 0);
        let y = Extremes::of(simd, &self.net, 1);
        if x.are_beyond(simd, -off, off) || y.are_beyond(simd, -off, off) {
            return Seen::Beside;
        }
        if Extremes::of(simd, &self.net, 2).are_beyond(simd, from - off, to + off) {
            return Seen::Beside;
        }
        if x.are_within(simd, off) && y.are_within(simd, off) {
            return Seen::Point;
        }
        let net = &self.net;
        let [first, last_of_row] = [net.point(0, 0), net.point(3, 0)];
        let [first_of_last, last] = [net.point(0, 3), net.point(3, 3)];
        let along_u = last_of_row + last - first - first_of_last;
        let along_v = first_of_last + last - first - last_of_row;
        let Some(inverse) = inverse(along_u * 0.5, along_v * 0.5) else { return Seen::Bent };
        let [u, v] = inverse;
        let (off_u, off_v) = (off * (u[0].abs() + u[1].abs()), off * (v[0].abs() + v[1].abs()));
        let u = Straight::of(simd, net, u, off_u, [1.0, 0.0]);
        let v = Straight::of(simd, net, v, off_v, [0.0, 1.0]);
        if u.is_beside || v.is_beside {
            return Seen::Beside;
        }
        let bend = (u.farthest[0] + u.farthest[1]).max(v.farthest[0] + v.farthest[1]);
        if bend <= NEARLY_LINEAR { Seen::Linear(inverse, bend) } else { Seen::Bent }
    }

    /// Keeps one half, split along its longer parameter direction, and returns the other.
    pub fn halve(&mut self, length: impl Fn(Vector) -> f64) -> Self {
        let length = |steps: [Vector; 12]| steps.into_iter().map(&length).sum::<f64>();
        let is_along_u = length(self.net.steps_along_u()) >= length(self.net.steps_along_v());
        let net = if is_along_u { self.net.halve_along_u() } else { self.net.halve_along_v() };
        let axis = usize::from(!is_along_u);
        self.size[axis] *= 0.5;
        let mut start = self.start;
        start[axis] += self.size[axis];
        Self { net, start, size: self.size }
    }

    /// Returns the intersection with a nearly linear piece, if it is within the piece's bounds, to rounding:
    /// Newton's method, clamped near them.
    ///
    /// **Error**: with M the inverse of the derivative and κ its deviation from linear, u and v are off by at
    /// most |M|·off/(1 − κ), counted twice; the position along the line is off by that times the largest
    /// derivative.
    #[inline(always)]
    pub fn root<S: Simd>(
        &self,
        simd: S,
        whole: &Net,
        (inverse, bend): ([[f64; 2]; 2], f64),
        off: f64,
    ) -> Option<Root> {
        let Self { start, size, .. } = *self;
        let global = |x: [f64; 2]| [start[0] + x[0] * size[0], start[1] + x[1] * size[1]];
        let mut x = [0.5, 0.5];
        for _ in 0..32 {
            let weights = Weights::at(global(x));
            let right = whole.coordinate(simd, 0, &weights);
            let up = whole.coordinate(simd, 1, &weights);
            // Far less than what can be told.
            if right[0].abs().max(up[0].abs()) <= off / 16.0 {
                break;
            }
            let along_u = Vector::new(right[1], up[1], 0.0) * size[0];
            let along_v = Vector::new(right[2], up[2], 0.0) * size[1];
            let Some([[a, b], [c, d]]) = self::inverse(along_u, along_v) else { break };
            let step = [a * right[0] + b * up[0], c * right[0] + d * up[0]];
            let next = [0, 1].map(|i| (x[i] - step[i]).clamp(-0.25, 1.25));
            let moved = (next[0] - x[0]).abs().max((next[1] - x[1]).abs());
            x = next;
            if moved <= 2.0 * U {
                break;
            }
        }
        let [[a, b], [c, d]] = inverse;
        let spread = 2.0 * off / (1.0 - bend);
        let spread = [spread * (a.abs() + b.abs()), spread * (c.abs() + d.abs())];
        let place = global(x);
        let Place { point, along_u, along_v } = whole.place(simd, place);
        let within = (0..2).all(|i| -spread[i] <= x[i] && x[i] <= 1.0 + spread[i]);
        if !within || point.x.abs().max(point.y.abs()) > off {
            return None;
        }
        let mut columns = [all(simd, 0.0); 4];
        for (column, points) in columns.iter_mut().enumerate() {
            *points = self.net.column(simd, 2, column);
        }
        let error = spread[0] * farthest_along_u(simd, &columns, 0.0)
            + spread[1] * farthest_along_v(simd, &columns, 0.0)
            + off;
        // The normal is v × u.
        let leaving = along_u.x * along_v.y - along_u.y * along_v.x < 0.0;
        let met = Met { t: point.z, error, leaving, part: part_at(place) };
        Some(Root { met, place, off: [spread[0] * size[0], spread[1] * size[1]] })
    }
}

impl Root {
    /// Returns whether both are the same intersection, found in two adjacent pieces.
    pub fn is(&self, other: &Self) -> bool {
        let near = |i: usize| {
            let apart = (self.place[i] - other.place[i]).abs();
            apart <= self.off[i] + other.off[i] + 8.0 * U
        };
        self.met.leaving == other.met.leaving && near(0) && near(1)
    }
}

/// Returns the inverse of the matrix with these derivatives along u and v, restricted to the directions
/// across the line.
fn inverse(along_u: Vector, along_v: Vector) -> Option<[[f64; 2]; 2]> {
    let determinant = along_u.x * along_v.y - along_v.x * along_u.y;
    let by = 1.0 / determinant;
    let inverse = [[along_v.y * by, -along_v.x * by], [-along_u.y * by, along_u.x * by]];
    inverse.iter().flatten().all(|entry| entry.is_finite()).then_some(inverse)
}

/// The least and the greatest of a coordinate, in each row of a net.
struct Extremes<S: Simd> {
    low: Wide<S>,
    high: Wide<S>,
}

impl<S: Simd> Extremes<S> {
    #[inline(always)]
    fn of(simd: S, net: &Net, axis: usize) -> Self {
        let first = net.column(simd, axis, 0);
        let mut extremes = Self { low: first, high: first };
        for column in 1..4 {
            extremes.add(net.column(simd, axis, column));
        }
        extremes
    }

    #[inline(always)]
    fn add(&mut self, points: Wide<S>) {
        self.low = points.simd_lt(self.low).select(points, self.low);
        self.high = points.simd_gt(self.high).select(points, self.high);
    }

    /// Returns whether all are below the one bound, or all above the other.
    #[inline(always)]
    fn are_beyond(&self, simd: S, low: f64, high: f64) -> bool {
        self.low.simd_gt(all(simd, high)).all_true() || self.high.simd_lt(all(simd, low)).all_true()
    }

    #[inline(always)]
    fn are_within(&self, simd: S, off: f64) -> bool {
        (self.low.simd_ge(all(simd, -off)) & self.high.simd_le(all(simd, off))).all_true()
    }
}

/// A coordinate across the line after a matrix that makes a piece's map nearly the identity.
struct Straight {
    is_beside: bool,
    /// How far the derivatives along u and v are from those of the identity.
    farthest: [f64; 2],
}

impl Straight {
    /// From a row of the matrix.
    #[inline(always)]
    fn of<S: Simd>(simd: S, net: &Net, row: [f64; 2], off: f64, slopes: [f64; 2]) -> Self {
        let [a, b] = [all(simd, row[0]), all(simd, row[1])];
        let mut columns = [a; 4];
        for (column, points) in columns.iter_mut().enumerate() {
            *points = a * net.column(simd, 0, column) + b * net.column(simd, 1, column);
        }
        let [first, rest @ ..] = columns;
        let mut extremes = Extremes { low: first, high: first };
        for points in rest {
            extremes.add(points);
        }
        let is_beside = extremes.are_beyond(simd, -off, off);
        let by_u = farthest_along_u(simd, &columns, slopes[0]);
        let by_v = farthest_along_v(simd, &columns, slopes[1]);
        Self { is_beside, farthest: [by_u, by_v] }
    }
}

/// Returns how far the control points of the derivative along u are from a slope, of one coordinate of a net's columns.
#[inline(always)]
fn farthest_along_u<S: Simd>(simd: S, columns: &[Wide<S>; 4], slope: f64) -> f64 {
    let (three, slope) = (all(simd, 3.0), all(simd, slope));
    let mut farthest = all(simd, 0.0);
    for column in 0..3 {
        let off = ((columns[column + 1] - columns[column]) * three - slope).abs();
        farthest = off.simd_gt(farthest).select(off, farthest);
    }
    greatest(farthest)
}

/// [`farthest_along_u`], along v.
#[inline(always)]
fn farthest_along_v<S: Simd>(simd: S, columns: &[Wide<S>; 4], slope: f64) -> f64 {
    let (three, slope) = (all(simd, 3.0), all(simd, slope));
    // From the last point of a column there is no step.
    let is_step = mask(simd, 0b0111, 0);
    let mut farthest = all(simd, 0.0);
    for points in columns {
        let off = ((points.slide::<1>(*points) - *points) * three - slope).abs();
        farthest = (is_step & off.simd_gt(farthest)).select(off, farthest);
    }
    greatest(farthest)
}

/// Returns the greatest of numbers that are not negative.
#[inline(always)]
fn greatest<S: Simd>(numbers: Wide<S>) -> f64 {
    let numbers: [f64; 4] = numbers.into();
    numbers.into_iter().fold(0.0, f64::max)
}
