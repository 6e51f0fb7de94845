//! A line in the plane of a lathe's outline: a branch of a hyperbola if it is steep, otherwise two arms.
//!
//! With ρ the line's distance from the axis at the height of a point of that plane, d²·(ρ² − x²) is 0 only on
//! the hyperbola. Along a piece of the outline it is a polynomial, and its Bézier coefficients decide most
//! cases.

use smallvec::SmallVec;

use crate::math::roots::bracket::Sample;
use crate::math::roots::polynomial::turning_points;
use crate::shape::U;
use crate::shape::curve::{Change, Course, Hull, Outline, Path, Piece, Point, Run, Side};
use crate::shape::local::LocalRay;

use super::isolated::Squares;

/// Minimum vertical speed of a steep line.
pub(super) const STEEP: f64 = 0.125;

/// A line relative to the outline.
#[derive(Clone, Copy)]
pub(super) struct Line {
    /// Its nearest point, across the axis.
    nearest: Point,
    direction: Point,
    /// z where s is 0, and its speed.
    pub start: f64,
    pub speed: f64,
    /// Speed across the axis.
    across: f64,
    /// Error of the line, from rounding, anywhere near the body; includes the rounding of the outline.
    pub off: f64,
    /// Height by which it is raised above its actual position.
    pub raised: f64,
}

impl Line {
    pub fn new(ray: &LocalRay) -> Self {
        let (n, d) = (ray.nearest, ray.direction);
        Self {
            nearest: [n.x, n.y],
            direction: [d.x, d.y],
            start: n.z,
            speed: d.z,
            across: (d.x * d.x + d.y * d.y).sqrt(),
            off: ray.blur_at(2.0) + 32.0 * U,
            raised: 0.0,
        }
    }

    /// Returns the line raised to the height `start`.
    pub fn raised_to(&self, start: f64) -> Self {
        Self { start, raised: start - self.start, ..*self }
    }

    /// Returns dz times the line's position, across the axis, at the height z.
    fn reached(&self, z: f64) -> Point {
        let ([n, m], [d, e]) = (self.nearest, self.direction);
        let up = z - self.start;
        [d * up + n * self.speed, e * up + m * self.speed]
    }

    /// Returns where the line crosses a place, between two others, and the error: by the height, or by the distance
    /// to the axis if that is more accurate. **Error:** as of [`Arm::wall`].
    pub fn crossing(&self, [x, height]: Point, places: [Point; 2]) -> (f64, f64) {
        let Self { start, speed, across, off, .. } = *self;
        let [low, high] = places;
        let s = (height - start) / speed;
        let rise = (low[1] - height).abs().max((high[1] - height).abs());
        let error = (1.25 * rise + 1.5 * off) / speed.abs();
        if speed.abs() >= STEEP {
            return (s, error);
        }
        let [arm, _] = Arm::both(self);
        let (least, most) = (low[0].min(high[0]) - off, low[0].max(high[0]) + off);
        // It is on one arm only.
        if least <= arm.miss || (s - arm.middle).abs() <= error {
            return (s, error);
        }
        let here = arm.reach(x);
        let extent = (here - arm.reach(least)).max(arm.reach(most) - here);
        let by_reach = extent + (2.0 * off + 8.0 * U * here) / across;
        match error < by_reach {
            true => (s, error),
            false => (arm.middle + here.copysign(s - arm.middle), by_reach),
        }
    }

    /// Returns the Bézier coefficients of d²·(ρ² − x²) along a piece, and an upper bound on its terms.
    fn coefficients(&self, piece: &Piece) -> ([f64; 7], f64) {
        let (x, y) = (piece.cubic(0), piece.cubic(1));
        let reached = y.map(|y| self.reached(y));
        let across = [square(reached.map(|[a, _]| a)), square(reached.map(|[_, b]| b))];
        let out = square(x.map(|x| x * self.speed));
        let size = reached.iter().zip(x).map(|([a, b], x)| a.abs() + b.abs() + x.abs());
        let coefficients = std::array::from_fn(|k| across[0][k] + across[1][k] - out[k]);
        (coefficients, size.fold(0.0, f64::max))
    }

    /// Returns where d²·(ρ² − x²) has extrema on a piece, with ρ the line's at the height of the piece.
    fn turns(&self, piece: &Piece) -> SmallVec<[f64; 8]> {
        let (x, mut y) = (piece.powers(0), piece.powers(1));
        y[0] -= self.start;
        let ([n, m], [d, e]) = (self.nearest, self.direction);
        let linear = 2.0 * self.speed * (n * d + m * e);
        let mut values = [0.0; 7];
        for i in 0..4 {
            values[i] += linear * y[i];
            for j in 0..4 {
                values[i + j] +=
                    self.across * self.across * y[i] * y[j] - self.speed * self.speed * x[i] * x[j];
            }
        }
        turning_points(&values[..=2 * (piece.points().len() - 1)], 0.0, 1.0)
    }
}

/// Returns whether a polynomial with these Bézier coefficients certainly has at most one root: at most the
/// number of their sign changes.
fn course_of(coefficients: &[f64; 7], size: f64) -> Course {
    let is_told = |c: &f64| c.abs() > 64.0 * U * size * size;
    let changes = coefficients.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0));
    match changes.count() <= 1 && coefficients.iter().all(is_told) {
        true => Course::OneRoot,
        false => Course::Unknown,
    }
}

/// The Bézier coefficients of the square of a cubic.
fn square([a, b, c, d]: [f64; 4]) -> [f64; 7] {
    [
        a * a,
        a * b,
        (2.0 * a * c + 3.0 * b * b) / 5.0,
        (a * d + 9.0 * b * c) / 10.0,
        (2.0 * b * d + 3.0 * c * c) / 5.0,
        c * d,
        d * d,
    ]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn length(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// A steep line: its outside is nearer to the axis.
pub(super) struct Steep<'a>(pub &'a Line);

impl Side for Steep<'_> {
    /// Evaluates f = |a| − |dz|·x, with a = dz·(the line's position at the height of the piece).
    ///
    /// **Error:** points farther than B from the branch are certain. The outside of the branch lies beyond
    /// its tangent: there, f over the length of its gradient is less than the distance. Inside, a
    /// neighbourhood of radius B must be inside.
    fn sample(&self, piece: &Piece, u: f64) -> Sample {
        let Line { direction, speed, across, off, .. } = *self.0;
        let ([x, y], [x_speed, y_speed]) = piece.at(u);
        let reached = self.0.reached(y);
        let (a, dz) = (length(reached), speed.abs());
        let along = dot(reached, direction);
        let slope = if a > 0.0 { along / a } else { across };
        let value = a - dz * x;
        let error = if value > 0.0 {
            off * (dz * dz + slope * slope).sqrt()
        } else {
            let more = across * off * (across * off) + 2.0 * off * along.abs();
            more / ((a * a + more).sqrt() + a).max(f64::MIN_POSITIVE) + dz * off
        };
        Sample { value, slope: slope * y_speed - dz * x_speed, error: error + 4.0 * U * a }
    }

    fn of_box(&self, [low, high]: &Hull) -> Option<bool> {
        let Line { speed, off, .. } = *self.0;
        let (first, last) = (self.0.reached(low[1]), self.0.reached(high[1]));
        let way = [last[0] - first[0], last[1] - first[1]];
        let (before, behind) = (length(first), length(last));
        let is_between = dot(first, way) < 0.0 && dot(last, way) > 0.0;
        let least = match is_between {
            true => (first[0] * way[1] - first[1] * way[0]).abs() / length(way),
            false => before.min(behind),
        };
        match () {
            () if least - speed.abs() * high[0] > 2.0 * off => Some(true),
            () if speed.abs() * low[0] - before.max(behind) > 2.0 * off => Some(false),
            () => None,
        }
    }

    /// The coefficients bound |a|² − dz²·x², which is f times |a| + |dz|·x, and that factor is at most the
    /// size.
    fn course(&self, piece: &Piece) -> Course {
        let (coefficients, size) = self.0.coefficients(piece);
        let least = (2.0 * self.0.off + 64.0 * U * size) * size;
        let is_outside = coefficients.iter().all(|c| *c > least);
        match is_outside || coefficients.iter().all(|c| *c < -least) {
            true => Course::Side(is_outside),
            false => course_of(&coefficients, size),
        }
    }

    fn turns(&self, piece: &Piece) -> SmallVec<[f64; 8]> {
        self.0.turns(piece)
    }
}

/// d²·(ρ² − x²) as a polynomial in x and y, the height.
pub(super) struct Hyperbola {
    /// The coefficients of y², y, 1 and −x².
    up: f64,
    linear: f64,
    constant: f64,
    out: f64,
    /// Height of its vertex, and the value there where x is 0.
    vertex: f64,
    least: f64,
    /// Error of Bézier coefficients, of values, and of what [`Steep`] takes from them.
    pub error: f64,
}

impl Hyperbola {
    /// Builds it for an outline that extends to `reach` from the origin. **Error:** as in [`Steep::course`], and the
    /// rounding of the terms.
    pub fn new(line: &Line, reach: f64) -> Self {
        let start = line.reached(0.0);
        let (up, out) = (line.across * line.across, line.speed * line.speed);
        let (linear, constant) = (2.0 * dot(line.direction, start), dot(start, start));
        let vertex = -0.5 * linear / up;
        let least = constant + 0.5 * linear * vertex;
        let terms = (up + out) * reach * reach + linear.abs() * reach + constant;
        let size = 1.5 * (line.across * reach + length(start)) + reach;
        let error = (2.0 * line.off + 64.0 * U * size) * size + 1024.0 * U * terms;
        Self { up, linear, constant, out, vertex, least, error }
    }

    /// Returns the square of the distance to the axis at a height, times d².
    fn square(&self, y: f64) -> f64 {
        (self.up * y + self.linear) * y + self.constant
    }

    /// Whether a box is certainly on one side.
    #[inline(always)]
    pub fn is_apart(&self, [low, high]: &Hull) -> bool {
        let (first, last) = (self.square(low[1]), self.square(high[1]));
        let has_vertex = low[1] < self.vertex && self.vertex < high[1];
        let least = if has_vertex { self.least } else { first.min(last) };
        // No piece is beyond the axis, but its control points may be.
        let near = low[0].max(0.0);
        let (inner, outer) = (self.out * near * near, self.out * high[0] * high[0]);
        least - outer > self.error || inner - first.max(last) > self.error
    }

    /// Returns the Bézier coefficients along a piece.
    #[inline(always)]
    pub fn coefficients(&self, squares: &Squares) -> [f64; 7] {
        let mut all = [0.0; 7];
        for (k, value) in all.iter_mut().enumerate() {
            let square = self.up * squares.up[k] + self.linear * squares.height[k] + self.constant;
            *value = square - self.out * squares.out[k];
        }
        all
    }

    /// Returns the value on a piece and its slope by u.
    #[inline(always)]
    pub fn at(&self, squares: &Squares, u: f64) -> (f64, f64) {
        let value = |[a, b, c, d]: [f64; 4]| a + u * (b + u * (c + u * d));
        let slope = |[_, b, c, d]: [f64; 4]| b + u * (2.0 * c + u * (3.0 * d));
        let [x, y] = squares.powers;
        let (out, up) = (value(x), value(y));
        let along = (2.0 * self.up * up + self.linear) * slope(y);
        (self.square(up) - self.out * out * out, along - 2.0 * self.out * out * slope(x))
    }
}

/// One arm of a flat line, for ρ ≥ m: its outside is above it.
pub(super) struct Arm<'a> {
    line: &'a Line,
    /// Minimum distance of the line from the axis, its position, and the height there.
    miss: f64,
    middle: f64,
    height: f64,
    /// 1 after the middle, −1 before it.
    pub way: f64,
}

impl<'a> Arm<'a> {
    pub fn both(line: &'a Line) -> [Self; 2] {
        let ([n, m], [d, e]) = (line.nearest, line.direction);
        let miss = (n * e - m * d).abs() / line.across;
        let middle = -dot(line.nearest, line.direction) / (line.across * line.across);
        let height = line.start + middle * line.speed;
        [-1.0, 1.0].map(|way| Self { line, miss, middle, height, way })
    }

    /// Distance along the line from the middle to where it is `x` from the axis.
    fn reach(&self, x: f64) -> f64 {
        ((x - self.miss) * (x + self.miss)).max(0.0).sqrt() / self.line.across
    }

    /// Rise from the middle to that point.
    fn rise(&self, x: f64) -> f64 {
        self.line.speed * self.way * self.reach(x)
    }

    /// Returns whether the arm certainly misses everything in a box.
    pub fn misses(&self, hull: &Hull) -> bool {
        self.miss > hull[1][0] + self.line.off || self.of_box(hull).is_some()
    }

    /// Returns the parts of a run beyond ρ = m.
    pub fn paths<'o>(&self, outline: &'o Outline, run: &Run) -> SmallVec<[Path<'o>; 4]> {
        let whole = Path::whole(outline, run, None);
        let pieces = &outline.pieces[run.from..run.to];
        let beyond = |point: Point| point[0] > self.miss;
        let far = 4.0 * self.line.off;
        let mut cuts: SmallVec<[f64; 8]> = SmallVec::new();
        for (number, piece) in pieces.iter().enumerate() {
            let is_first_beyond = beyond(piece.first());
            if is_first_beyond != beyond(piece.last()) {
                let [low, high] = piece.hull();
                let is_apart = low[1] - self.height > far || self.height - high[1] > far;
                // Nearer to the axis the arm stays as high, and so a piece that is apart from its beginning may
                // as well be taken whole.
                let u = match (is_apart, is_first_beyond) {
                    (true, true) => 1.0,
                    (true, false) => 0.0,
                    (false, _) => piece.meets(0, self.miss),
                };
                cuts.push(number as f64 + u);
            }
        }
        let Some(&first) = cuts.first() else {
            // A run that begins on the axis, and is nowhere beyond, is not met.
            let is_beyond = run.closed && beyond(pieces[0].first());
            return if is_beyond { SmallVec::from_iter([whole]) } else { SmallVec::new() };
        };
        if beyond(pieces[0].first()) {
            cuts.remove(0);
            cuts.push(first + pieces.len() as f64);
        }
        let end = |v: f64| whole.at(v).0[1] >= self.height;
        let part = |pair: &[f64]| whole.part(pair[0], pair[1], [end(pair[0]), end(pair[1])]);
        cuts.chunks_exact(2).map(part).collect()
    }

    /// Returns whether a change may lie right where the arms begin.
    pub fn may_begin_at(&self, change: &Change) -> bool {
        let is_near = |p: Point| p[0] - self.line.off <= self.miss;
        change.is_at_end() || change.places().any(is_near)
    }

    /// Returns the crossing, computed from its distance to the axis or from its height, whichever is more
    /// accurate.
    pub fn wall(&self, change: &Change) -> (f64, f64) {
        let (by_reach, by_height) = (self.by_reach(change), self.by_height(change));
        if by_height.1 < by_reach.1 { by_height } else { by_reach }
    }

    /// Computes the crossing from its height. **Error:** the extent of the change, B farther up and down;
    /// where the path begins at the middle, also that of the other arm, which is as far below it as this arm
    /// is above, or vice versa.
    fn by_height(&self, change: &Change) -> (f64, f64) {
        let Line { start, speed, off, .. } = *self.line;
        let here = change.point()[1];
        let from = |height: f64| change.places().map(|p| (p[1] - height).abs()).fold(0.0, f64::max);
        let reach = match change.is_at_end() {
            true => from(self.height) + (here - self.height).abs(),
            false => from(here),
        };
        ((here - start) / speed, (1.25 * reach + 1.5 * off) / speed.abs())
    }

    /// Computes the crossing from its distance to the axis. **Error:** the extent of the change, B farther
    /// out and in; where the path begins at the middle, also that of the other arm.
    fn by_reach(&self, change: &Change) -> (f64, f64) {
        let Line { across, off, .. } = *self.line;
        let here = self.reach(change.point()[0]);
        let least = change.places().map(|p| p[0]).fold(f64::INFINITY, f64::min);
        let most = change.places().map(|p| p[0]).fold(0.0, f64::max);
        let (near, far) = (self.reach(least - off), self.reach(most + off));
        let inner = if change.is_at_end() { here + far } else { here - near };
        let error = inner.max(far - here) + (2.0 * off + 8.0 * U * here) / across;
        (self.middle + self.way * here, error)
    }
}

impl Side for Arm<'_> {
    /// **Error:** the arm is monotone, so a result is certain if it holds at both corners of a square of
    /// width 2B.
    fn sample(&self, piece: &Piece, u: f64) -> Sample {
        let ([x, y], [x_speed, y_speed]) = piece.at(u);
        let Line { across, speed, off, .. } = *self.line;
        let rise = self.rise(x);
        let value = y - self.height - rise;
        let outer = (value > 0.0) == (speed * self.way > 0.0);
        let beside = if outer { self.rise(x + off) } else { self.rise((x - off).max(0.0)) };
        let steepness = speed * self.way * x / (self.reach(x) * across * across);
        Sample { value, slope: y_speed - steepness * x_speed, error: off + (beside - rise).abs() }
    }

    fn of_box(&self, [low, high]: &Hull) -> Option<bool> {
        let off = self.line.off;
        let most = self.rise(high[0] + off).abs() + 4.0 * off;
        match () {
            () if low[1] - self.height > most => Some(true),
            () if self.height - high[1] > most => Some(false),
            () => None,
        }
    }

    fn course(&self, piece: &Piece) -> Course {
        let (coefficients, size) = self.line.coefficients(piece);
        course_of(&coefficients, size)
    }

    fn turns(&self, piece: &Piece) -> SmallVec<[f64; 8]> {
        self.line.turns(piece)
    }
}
