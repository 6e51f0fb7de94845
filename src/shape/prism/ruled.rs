//! A line relative to a prism's walls: the side on which it passes each of the walls' lines, and where it
//! intersects them.
//!
//! All lines of a wall that the ray intersects lie with it in one plane, through the direction of the lines
//! or through the tip. So the side is a linear function of the point of the outline, and its sign over a box
//! follows from two corners.

use std::cell::Cell;

use smallvec::SmallVec;

use crate::math::Vector;
use crate::math::roots::bracket::{Root, Sample};
use crate::shape::U;
use crate::shape::curve::{Change, Course, Hull, Isolated, Piece, Point, Side};
use crate::shape::local::{LocalRay, Met};

use super::GRAZING;
use super::wall::aside;

/// Part number of the first piece's outside; the next number is the same surface seen from within, and so on.
pub(super) const WALLS: u32 = 3;

/// Part number of a piece's outside, or of the same surface seen from within.
pub(super) fn part_of(piece: usize, is_outside: bool) -> u32 {
    WALLS + 2 * piece as u32 + u32::from(!is_outside)
}

/// Sine of an angle between the ray and a wall's line from which on the ray's turn is nothing beside it.
const APART: f64 = 1.0 / 1024.0;

/// All crossings with walls.
pub(super) type Walls = SmallVec<[Wall; 6]>;

/// A crossing with a wall.
#[derive(Clone, Copy)]
pub(super) struct Wall {
    pub s: f64,
    pub error: f64,
    pub piece: usize,
    /// If the prism narrows: whether the crossing is where z is positive.
    pub above: bool,
    /// Whether the line goes in the direction of the wall's normal.
    pub along: bool,
}

impl Wall {
    /// Returns a placeholder that ends a span at ±∞ or at the tip.
    pub fn beyond(s: f64) -> Self {
        Self { s, error: 0.0, piece: 0, above: true, along: true }
    }

    pub fn met(&self, leaving: bool) -> Met {
        let part = part_of(self.piece, self.along == leaving);
        Met { t: self.s, error: self.error, leaving, part }
    }
}

pub(super) struct Ruled<'a> {
    ray: &'a LocalRay<'a>,
    conic: bool,
    /// If the line lies in a wall, within rounding: how far it must be displaced, in the common direction, to
    /// be separable from the wall.
    pub beside: Cell<Option<f64>>,
    /// The coefficients of x, y and 1.
    side: [f64; 3],
    /// For vertical walls: the sine of the angle between the ray and their lines.
    sine: f64,
    /// Upper bound on the error of the side anywhere within 1 of the origin.
    error: f64,
}

impl<'a> Ruled<'a> {
    /// Builds the line. With g the direction of a wall's line and r the gap to it, the volume r·(d × g) has
    /// the sign of the side on which the ray passes. No g is longer than √2, no r longer than |n| + 1.
    pub fn new(ray: &'a LocalRay<'a>, conic: bool) -> Self {
        let LocalRay { nearest: n, direction: d, blur, turn, .. } = *ray;
        let beside = Cell::new(None);
        if conic {
            let normal = d.cross(n);
            let size = n.length();
            // As of a place, and so much that what is told there is no parallel.
            let error = 2.0 * blur + (4.0 * turn + 64.0 * U) * size;
            let side = [normal.x, normal.y, normal.z];
            return Self { ray, conic, beside, side, sine: f64::NAN, error };
        }
        let sine = (d.x * d.x + d.y * d.y).sqrt();
        let size = n.length() + 1.0;
        let error = 1.2 * (blur * sine + turn * size) + 32.0 * U * sine * (size + 1.0);
        let error = if turn <= 0.5 * sine { error } else { f64::INFINITY };
        let side = [d.y, -d.x, n.y * d.x - n.x * d.y];
        Self { ray, conic, beside, side, sine, error }
    }

    /// Returns the direction of the wall's line through a point of the outline.
    fn way(&self, [x, y]: Point) -> Vector {
        if self.conic { Vector::new(x, y, 1.0) } else { Vector::Z }
    }

    /// Returns the side, like [`Self::value`], to within `error`.
    #[inline(always)]
    pub fn roughly(&self, [x, y]: Point) -> f64 {
        let [a, b, c] = self.side;
        a * x + b * y + c
    }

    /// Returns the error of the side anywhere in the outline.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// **Error:** no line within the ray's blur intersects the wall's line if the two are farther apart than
    /// the blur: |r·(d × g)| > B·|d × g|, with B the blur at their closest approach, which is at distance |r
    /// × g|/|d × g| along the ray; plus a small margin, as the lines within the blur are not parallel. Valid
    /// while the ray's turn is less than half of the angle between the two.
    fn value(&self, point: Point) -> (f64, f64) {
        let LocalRay { nearest, direction, blur, turn, .. } = *self.ray;
        let [a, b, c] = self.side;
        if self.conic {
            let way = self.way(point);
            let sine = direction.cross(way).length();
            let error = 1.2 * (blur * sine + turn * nearest.cross(way).length())
                + 32.0 * U * nearest.length();
            let is_told = turn * way.length() <= 0.5 * sine;
            return (a * point[0] + b * point[1] + c, if is_told { error } else { f64::INFINITY });
        }
        let [x, y] = [point[0] - nearest.x, point[1] - nearest.y];
        let (sine, gap) = (self.sine, (x * x + y * y).sqrt());
        let error = 1.2 * (blur * sine + turn * gap) + 16.0 * U * sine * (gap + 1.0);
        (a * x + b * y, if turn <= 0.5 * sine { error } else { f64::INFINITY })
    }

    /// Returns where on the ray it is nearest to a wall's line.
    fn place(&self, point: Point) -> f64 {
        let LocalRay { nearest, direction, .. } = *self.ray;
        if self.conic {
            let way = self.way(point);
            let across = direction.cross(way);
            return -nearest.cross(way).dot(across) / across.length_squared();
        }
        let along = (point[0] - nearest.x) * direction.x + (point[1] - nearest.y) * direction.y;
        along / (self.sine * self.sine)
    }

    /// Returns −∞ or ∞ if the wall's line is certainly not intersected before the body ends, at √2; the
    /// intersection with a ray so nearly parallel might be anywhere beyond.
    fn beyond(&self, point: Point) -> Option<f64> {
        let LocalRay { nearest, direction, .. } = *self.ray;
        let way = self.way(point);
        let gap = if self.conic { nearest } else { nearest - Vector::new(point[0], point[1], 0.0) };
        let near = 2.0 * direction.cross(way).length();
        let off = (2.0 * self.ray.blur_at(2.0) + 32.0 * U) * way.length();
        (gap.cross(way).length() > near + off).then(|| self.place(point) * f64::INFINITY)
    }

    /// Returns whether a narrowing wall's line is so nearly parallel to the ray that they intersect beyond
    /// the body, on either side. If this holds for two lines, it holds for every line between them, as |n ×
    /// g| is more than 0.9·|n|·|g| there.
    fn is_along(&self, point: Point) -> bool {
        let LocalRay { nearest, direction, .. } = *self.ray;
        let way = self.way(point);
        let off = 2.0 * self.ray.blur_at(2.0) + 32.0 * U;
        let near = 4.0 * direction.cross(way).length() + 2.0 * off * way.length();
        self.conic && near < nearest.length() * way.length()
    }

    /// Returns whether the ray is certainly apart from the direction of the walls' lines, if that is the same for all.
    pub fn is_apart(&self) -> bool {
        let is_apart = self.conic || self.ray.turn.max(APART * APART) <= APART * self.sine;
        is_apart && self.error.is_finite()
    }

    /// As [`Self::wall`] for a change within a piece, `None` where the ray is nearly parallel to the wall's line.
    #[inline]
    pub fn wall_at(&self, number: usize, piece: &Piece, root: Root, rising: bool) -> Option<Wall> {
        let Root { t: u, error } = root;
        let (point, speed) = piece.at(u);
        let sine = if self.conic {
            let way = self.way(point);
            let sine = self.ray.direction.cross(way).length() / way.length();
            if self.is_along(point) || self.ray.turn > APART * sine {
                return None;
            }
            sine
        } else {
            self.sine
        };
        let s = self.place(point);
        let reach = if piece.is_straight() && !self.conic {
            let LocalRay { direction, .. } = *self.ray;
            error * (speed[0] * direction.x + speed[1] * direction.y).abs() / (sine * sine)
        } else {
            let gap = |u: f64| (self.place(piece.at(u.clamp(0.0, 1.0)).0) - s).abs();
            gap(u - error).max(gap(u + error))
        };
        let off = self.ray.blur_at(s) + 8.0 * U * (1.0 + s.abs());
        let above = !self.conic || self.ray.at(s).dot(self.way(point)) > 0.0;
        let along = rising == above;
        Some(Wall { s, error: 1.25 * reach + 1.5 * off / sine, piece: number, above, along })
    }

    /// Returns about where the ray crosses a part of a piece, if that is certainly not in a range.
    pub fn wall_beyond(
        &self,
        number: usize,
        piece: &Piece,
        part: &Isolated<4>,
        range: (f64, f64),
    ) -> Option<Wall> {
        if self.conic {
            return None;
        }
        let LocalRay { nearest: n, direction: d, .. } = *self.ray;
        let axis = usize::from(d.y.abs() > d.x.abs());
        let place = |u: f64| (piece.at(u).0[axis] - n[axis]) / d[axis];
        let (first, last) = (place(part.from), place(part.to));
        let (low, high) = (first.min(last), first.max(last));
        let far = low.abs().max(high.abs());
        let off = 2.0 * (self.ray.blur_at(far) + 8.0 * U * (1.0 + far)) / d[axis].abs();
        let (low, high) = (low - off, high + off);
        let (s, error) = (0.5 * (low + high), 0.5 * (high - low));
        let wall = Wall { s, error, piece: number, above: true, along: part.rises() };
        (high < range.0 || low > range.1).then_some(wall)
    }

    /// Returns the crossing. **Error:** the extent of the change, and the distance along the ray over which
    /// its blur alone reaches the wall's line.
    pub fn wall(&self, change: &Change) -> Wall {
        let point = change.point();
        let (s, way) = (self.place(point), self.way(point));
        let piece = change.piece;
        // What is inside of one end of a wall along the ray is so as far as the body goes: on which side of the
        // body the two meet does not matter.
        if self.is_along(point) && change.places().all(|point| self.is_along(point)) {
            let (s, above) = (f64::INFINITY, self.ray.direction.z > 0.0);
            return Wall { s, error: 0.0, piece, above, along: change.rising == above };
        }
        let above = !self.conic || self.ray.at(s).dot(way) > 0.0;
        let reach = change.places().map(|point| (self.place(point) - s).abs()).fold(0.0, f64::max);
        let sine = self.ray.direction.cross(way).length() / way.length();
        let (s, error) = match self.beyond(point) {
            Some(end) if change.places().all(|point| self.beyond(point) == Some(end)) => (end, 0.0),
            _ => {
                let off = self.ray.blur_at(s) + 8.0 * U * (1.0 + s.abs());
                (s, 1.25 * reach + 1.5 * off / sine)
            }
        };
        // On the other side of its tip a wall faces the other way.
        let along = change.rising == above;
        Wall { s, error, piece, above, along }
    }
}

impl Side for Ruled<'_> {
    #[inline]
    fn sample(&self, piece: &Piece, u: f64) -> Sample {
        let (point, speed) = piece.at(u);
        let (value, error) = self.value(point);
        let [a, b, _] = self.side;
        Sample { value, slope: a * speed[0] + b * speed[1], error }
    }

    #[inline]
    fn of_box(&self, [low, high]: &Hull) -> Option<bool> {
        let [a, b, c] = self.side;
        let (left, right) = if a >= 0.0 { (low[0], high[0]) } else { (high[0], low[0]) };
        let (below, above) = if b >= 0.0 { (low[1], high[1]) } else { (high[1], low[1]) };
        let is_outside = a * left + b * below + c > self.error;
        (is_outside || a * right + b * above + c < -self.error).then_some(is_outside)
    }

    /// A polynomial changes its sign at most as often as its Bézier coefficients.
    fn course(&self, piece: &Piece) -> Course {
        let sides = || piece.points().iter().map(|point| self.roughly(*point));
        let is_outside = sides().all(|side| side > self.error);
        if is_outside || sides().all(|side| side < -self.error) {
            return Course::Side(is_outside);
        }
        let pairs = piece.points().windows(2);
        let signs = pairs.map(|pair| [pair[0], pair[1]].map(|point| self.roughly(point) > 0.0));
        match signs.filter(|[before, after]| before != after).count() <= 1 {
            true => Course::OneRoot,
            false => Course::Unknown,
        }
    }

    const IS_LINEAR: bool = true;

    #[cold]
    fn holds(&self, piece: &Piece) {
        let turned = self.ray.direction.cross(aside(self.ray));
        let ends = [piece.first(), piece.last()];
        // Where the wall's line goes the ray's way, moving leaves it so; the less of the wall is near to that as
        // the ray sees it, the better.
        let margin = if ends.iter().any(|end| self.is_along(*end)) { 64.0 } else { 1.0 };
        let least = |end: &Point| {
            let way = self.way(*end);
            let steep = self.ray.direction.cross(way).length();
            let least =
                64.0 * margin * self.value(*end).1 / turned.dot(way).abs().max(GRAZING * steep);
            if least.is_finite() && !self.is_along(*end) { least } else { 0.0 }
        };
        let [first, last] = ends.each_ref().map(least);
        self.beside.set(Some(first.max(last).max(self.beside.get().unwrap_or(0.0))));
    }

    fn turns(&self, piece: &Piece) -> SmallVec<[f64; 8]> {
        piece.turns([self.side[0], self.side[1]])
    }
}
