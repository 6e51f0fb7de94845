//! Plane curves, made of polynomial pieces that join end to end.
//!
//! **In:** pieces, as Bézier points. **Out:** runs of pieces that are monotone along both axes, closed or
//! with two ends. **Invariant:** adjacent pieces share their joint exactly.

mod boxes;
mod isolate;
mod outline;
mod walk;

pub(super) use boxes::Hull;
pub(super) use isolate::{Isolated, isolate};
pub use outline::{Outline, Run};
pub(super) use walk::{Change, Course, Path, Side, WIDE, on_line, walk};

use smallvec::SmallVec;

use super::U;
use boxes::union;

/// A point in the plane.
pub type Point = [f64; 2];

/// A polynomial curve of degree 1 to 3 for u from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Control points, one more than the degree; the remaining ones repeat the last.
    points: [Point; 4],
    degree: usize,
    /// Whether it is visible; pieces that close a curve are not.
    pub seen: bool,
}

/// Fraction of a piece's size, or of its parameter range, whose square is negligible.
const NEAR: f64 = 1e-9;

#[inline(always)]
fn mix(a: Point, b: Point, u: f64) -> Point {
    [(1.0 - u) * a[0] + u * b[0], (1.0 - u) * a[1] + u * b[1]]
}

fn way(from: Point, to: Point) -> Point {
    [to[0] - from[0], to[1] - from[1]]
}

impl Piece {
    pub fn line(from: Point, to: Point) -> Self {
        Self { points: [from, to, to, to], degree: 1, seen: true }
    }

    pub fn unseen(self) -> Self {
        Self { seen: false, ..self }
    }

    /// Builds a piece from two to four Bézier points; `None` for any other number.
    pub fn bezier(points: &[Point]) -> Option<Self> {
        let last = *points.last()?;
        let degree = points.len().checked_sub(1).filter(|degree| (1..=3).contains(degree))?;
        let mut all = [last; 4];
        all[..=degree].copy_from_slice(points);
        Some(Self { points: all, degree, seen: true })
    }

    pub fn points(&self) -> &[Point] {
        &self.points[..=self.degree]
    }

    pub fn first(&self) -> Point {
        self.points[0]
    }

    pub fn last(&self) -> Point {
        self.points[self.degree]
    }

    /// Returns its y coordinate, if it is horizontal.
    pub fn level(&self) -> Option<f64> {
        let [_, height] = self.first();
        self.points().iter().all(|point| point[1] == height).then_some(height)
    }

    /// Returns an upper bound on its x coordinate, from its control points.
    pub fn width(&self) -> f64 {
        self.points().iter().map(|point| point[0]).fold(0.0, f64::max)
    }

    pub fn is_straight(&self) -> bool {
        self.degree == 1
    }

    /// Whether it is a single point.
    fn is_nothing(&self) -> bool {
        self.points.iter().all(|point| *point == self.points[0])
    }

    /// Returns the point and the derivative at u; at 0 and 1, exactly the end points.
    #[inline]
    pub fn at(&self, u: f64) -> (Point, Point) {
        let [a, b, c, d] = self.points;
        let (first, last) = match self.degree {
            1 => (a, b),
            2 => (mix(a, b, u), mix(b, c, u)),
            _ => {
                let middle = mix(b, c, u);
                (mix(mix(a, b, u), middle, u), mix(middle, mix(c, d, u), u))
            }
        };
        let degree = self.degree as f64;
        let speed = [degree * (last[0] - first[0]), degree * (last[1] - first[1])];
        (mix(first, last, u), speed)
    }

    /// Returns the coefficients of 1, u, u² and u³ of one coordinate.
    pub fn powers(&self, axis: usize) -> [f64; 4] {
        let [a, b, c, d] = self.points.map(|point| point[axis]);
        match self.degree {
            1 => [a, b - a, 0.0, 0.0],
            2 => [a, 2.0 * (b - a), (c - b) - (b - a), 0.0],
            _ => [a, 3.0 * (b - a), 3.0 * ((c - b) - (b - a)), (d - a) - 3.0 * (c - b)],
        }
    }

    /// Returns one coordinate as a cubic, in Bézier coefficients.
    pub fn cubic(&self, axis: usize) -> [f64; 4] {
        self.cubic_of(|point| point[axis])
    }

    /// Returns a linear function of its points as a cubic, in Bézier coefficients.
    #[inline(always)]
    pub fn cubic_of(&self, value: impl Fn(Point) -> f64) -> [f64; 4] {
        let [a, b, c, d] = self.points;
        let (a, b, c, d) = (value(a), value(b), value(c), value(d));
        match self.degree {
            1 => [a, (2.0 * a + b) / 3.0, (a + 2.0 * b) / 3.0, b],
            2 => [a, (a + 2.0 * b) / 3.0, (2.0 * b + c) / 3.0, c],
            _ => [a, b, c, d],
        }
    }

    /// Splits it at u.
    fn split(&self, u: f64) -> [Self; 2] {
        let (mut before, mut after) = (*self, *self);
        let mut points = self.points;
        let degree = self.degree;
        for step in 0..degree {
            before.points[step] = points[0];
            after.points[degree - step] = points[degree - step];
            for i in 0..degree - step {
                points[i] = mix(points[i], points[i + 1], u);
            }
        }
        before.points[degree..].fill(points[0]);
        after.points[0] = points[0];
        after.points[degree..].fill(self.last());
        [before, after]
    }

    /// Returns the interior extrema of `a`·x + `b`·y.
    pub fn turns(&self, [a, b]: Point) -> SmallVec<[f64; 8]> {
        let mut found = SmallVec::new();
        if self.is_straight() {
            return found;
        }
        let (x, y) = (self.powers(0), self.powers(1));
        let [c, h, q] = [1, 2, 3].map(|k| k as f64 * (a * x[k] + b * y[k]));
        let roots = if self.ends_level([a, b]) {
            // (1 − u)·(c − q·u): 1 is no place within it.
            [c / q, f64::NAN]
        } else if h * h < 4.0 * q * c {
            [f64::NAN; 2]
        } else {
            // q·u² + h·u + c, by the root that does not cancel.
            let half = -0.5 * (h + (h * h - 4.0 * q * c).max(0.0).sqrt().copysign(h));
            [half / q, c / half]
        };
        found.extend(roots.into_iter().filter(|u| *u > 0.0 && *u < 1.0));
        found.sort_by(f64::total_cmp);
        found
    }

    /// Whether the derivative of `a`·x + `b`·y is 0 at the end.
    fn ends_level(&self, [a, b]: Point) -> bool {
        let ([x, y], [p, q]) = (self.last(), self.points[self.degree - 1]);
        a * (x - p) + b * (y - q) == 0.0
    }

    /// Upper bound on the rounding of its coordinates.
    fn rounding(&self) -> f64 {
        4.0 * U * self.points.iter().flatten().fold(0.0, |most: f64, c| most.max(c.abs()))
    }

    /// Returns the direction of the line that its points lie on, within rounding, scaled so that its longer
    /// coordinate is 1 or −1; `None` if they are not collinear.
    fn line_way(&self) -> Option<Point> {
        let ways = self.points().iter().map(|point| way(self.first(), *point));
        let size = |[x, y]: &Point| x.abs().max(y.abs());
        let farthest = ways.clone().max_by(|a, b| size(a).total_cmp(&size(b)))?;
        let [a, b] = farthest.map(|c| c / size(&farthest));
        let off = self.rounding();
        let mut is_beside = ways.map(|[x, y]| (x * b - y * a).abs() <= off);
        is_beside.all(|is_beside| is_beside).then_some([a, b])
    }

    /// Whether its points lie in order on the line from the first to the last, within rounding.
    fn is_row(&self) -> bool {
        let Some([a, b]) = self.line_way() else { return false };
        let is_onward = |pair: &[Point]| {
            let [x, y] = way(pair[0], pair[1]);
            x * a + y * b >= 0.0
        };
        self.points().windows(2).all(is_onward)
    }

    /// The line from its first point to its last.
    fn straight(self) -> Self {
        Self { seen: self.seen, ..Self::line(self.first(), self.last()) }
    }

    /// Simplifies it to a line if it is one; otherwise makes an end horizontal or vertical where rounding
    /// cannot show that it is not.
    fn plain(self) -> Self {
        if self.is_row() {
            return self.straight();
        }
        let (mut plain, off) = (self, self.rounding());
        for end in [0, self.degree] {
            for axis in [0, 1] {
                let level = self.points[end][axis];
                let next = &mut plain.points[end.abs_diff(1)][axis];
                if (*next - level).abs() <= off {
                    *next = level;
                }
            }
        }
        plain
    }

    /// Splits it into parts that are monotone along both axes.
    fn monotone(self) -> SmallVec<[Self; 5]> {
        let whole = self.plain();
        let mut cuts = whole.turns([1.0, 0.0]);
        cuts.extend(whole.turns([0.0, 1.0]));
        cuts.sort_by(f64::total_cmp);
        let (mut parts, mut rest, mut done) = (SmallVec::new(), whole, 0.0);
        for cut in cuts {
            let [before, after] = rest.split((cut - done) / (1.0 - done));
            (rest, done) = (after, cut);
            parts.push(before);
        }
        parts.push(rest);
        // What goes back upon itself is straight all the same, between its turns.
        if whole.line_way().is_some() {
            parts.iter_mut().for_each(|part: &mut Self| *part = part.straight());
        }
        parts.retain(|part: &mut Self| !part.is_nothing());
        parts
    }

    /// Returns its parts to the right of x = 0, and the mirror images of those to the left; omits parts on x
    /// = 0.
    pub fn off_axis(self) -> SmallVec<[Self; 5]> {
        let mut parts: SmallVec<[Self; 5]> = SmallVec::new();
        for part in self.monotone() {
            let (first, last) = (part.first()[0], part.last()[0]);
            if first * last < 0.0 {
                let [mut before, mut after] = part.split(part.meets(0, 0.0));
                before.points[before.degree..].iter_mut().for_each(|point| point[0] = 0.0);
                after.points[0][0] = 0.0;
                parts.extend([before, after]);
            } else if part.points.iter().any(|[x, _]| *x != 0.0) {
                parts.push(part);
            }
        }
        for part in &mut parts {
            if part.first()[0] + part.last()[0] < 0.0 {
                part.points.iter_mut().for_each(|point| point[0] = -point[0]);
            }
        }
        parts
    }

    /// Returns the bounding box of its Bézier points, which contains it.
    pub fn hull(&self) -> Hull {
        let [first, rest @ ..] = self.points;
        rest.into_iter().map(|point| [point, point]).fold([first, first], union)
    }

    /// Returns the longer side of its box.
    pub fn size(&self) -> f64 {
        let [low, high] = self.hull();
        (high[0] - low[0]).max(high[1] - low[1])
    }

    /// Returns a length as a part of it; at most a quarter.
    pub fn share(&self, length: f64) -> f64 {
        if length > 0.0 { (length / self.size()).min(0.25) } else { 0.0 }
    }

    /// Returns the maximum of `a`·x + `b`·y.
    pub fn greatest(&self, [a, b]: Point) -> f64 {
        let value = |[x, y]: Point| a * x + b * y;
        let ends = value(self.first()).max(value(self.last()));
        self.turns([a, b]).into_iter().map(|u| value(self.at(u).0)).fold(ends, f64::max)
    }

    /// Returns the point nearest to `place`, which is close to the piece, and the unit normal there, to the
    /// left of the direction of increasing u.
    pub fn nearest(&self, place: Point) -> (Point, Point) {
        let (first, last) = (self.first(), self.last());
        let way = [last[0] - first[0], last[1] - first[1]];
        let off = [place[0] - first[0], place[1] - first[1]];
        let size = way[0] * way[0] + way[1] * way[1];
        let along = (off[0] * way[0] + off[1] * way[1]) / size;
        let start = if along.is_finite() { along.clamp(0.0, 1.0) } else { 0.0 };
        if self.is_straight() {
            return (self.at(start).0, self.normal(way));
        }
        // Mostly this finds it.
        let (u, is_last) = self.approached(place, start);
        let (at, speed) = self.at(u);
        let gap = [place[0] - at[0], place[1] - at[1]];
        if is_last && gap[0] * gap[0] + gap[1] * gap[1] <= NEAR * NEAR * size {
            return (at, self.normal(speed));
        }
        let (at, speed) = self.at(self.nearest_of_any(place));
        (at, self.normal(speed))
    }

    /// Iterates toward the point nearest to `place`, which is close to the piece; also returns whether it
    /// converged.
    fn approached(&self, place: Point, start: f64) -> (f64, bool) {
        let mut u = start;
        for _ in 0..8 {
            let (at, [x, y]) = self.at(u);
            let along = (place[0] - at[0]) * x + (place[1] - at[1]) * y;
            let next = (u + along / (x * x + y * y)).clamp(0.0, 1.0);
            if next.is_nan() {
                break;
            }
            let step = (next - u).abs();
            u = next;
            if step <= NEAR {
                return (u, true);
            }
        }
        (u, false)
    }

    /// Finds the nearest point by starting from the same coordinate along either axis, and from both ends.
    fn nearest_of_any(&self, place: Point) -> f64 {
        let ends = [self.first(), self.last()];
        let from = |axis: usize| {
            let [a, b] = ends.map(|end| end[axis]);
            let start = self.meets(axis, place[axis].clamp(a.min(b), a.max(b)));
            self.approached(place, start).0
        };
        let distance = |u: &f64| {
            let [x, y] = self.at(*u).0;
            (place[0] - x) * (place[0] - x) + (place[1] - y) * (place[1] - y)
        };
        let starts = [0.0, from(0), from(1), 1.0];
        starts.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0.0)
    }

    /// Returns the unit normal to the left of the given derivative.
    pub fn normal(&self, [x, y]: Point) -> Point {
        let length = (x * x + y * y).sqrt();
        if length > 0.0 {
            return [-y / length, x / length];
        }
        // A cusp: it faces as the piece does as a whole.
        let ([a, b], [c, d]) = (self.first(), self.last());
        let length = ((c - a) * (c - a) + (d - b) * (d - b)).sqrt().max(f64::MIN_POSITIVE);
        [(b - d) / length, (c - a) / length]
    }

    /// Whether its distance from a point exceeds `distance`; rarely `false` if it does by a small margin.
    fn is_clear(&self, place: Point, distance: f64) -> bool {
        let [low, high] = self.hull();
        if is_apart(&[low, high], place, distance) {
            return true;
        }
        let size = (high[0] - low[0]).max(high[1] - low[1]);
        if size <= distance || distance.is_nan() {
            return false;
        }
        self.split(0.5).iter().all(|part| part.is_clear(place, distance))
    }

    /// Lower bound on its distance from a point.
    fn clearance(&self, place: Point, depth: u32) -> f64 {
        let [low, high] = self.hull();
        let gap = |axis: usize| (low[axis] - place[axis]).max(place[axis] - high[axis]).max(0.0);
        let away = (gap(0) * gap(0) + gap(1) * gap(1)).sqrt();
        let size = (high[0] - low[0]).max(high[1] - low[1]);
        if depth == 0 || away > size {
            return away;
        }
        let [before, after] = self.split(0.5);
        before.clearance(place, depth - 1).min(after.clearance(place, depth - 1))
    }

    /// Returns the u at which a coordinate has a value between those at its ends.
    pub fn meets(&self, axis: usize, value: f64) -> f64 {
        let rises = self.last()[axis] > self.first()[axis];
        let (mut low, mut high) = (0.0, 1.0);
        let mut u = 0.5;
        for _ in 0..64 {
            let (at, speed) = self.at(u);
            if (at[axis] < value) == rises {
                low = u;
            } else {
                high = u;
            }
            let newton = u + (value - at[axis]) / speed[axis];
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - u).abs() <= U {
                break;
            }
            u = next;
        }
        u
    }
}

/// Whether a box is farther than `distance` from a point.
fn is_apart([low, high]: &Hull, place: Point, distance: f64) -> bool {
    let gap = |axis: usize| (low[axis] - place[axis]).max(place[axis] - high[axis]).max(0.0);
    gap(0) * gap(0) + gap(1) * gap(1) > distance * distance
}
