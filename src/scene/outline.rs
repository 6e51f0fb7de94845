//! Outlines as they were written: points in a plane, and how curves go through them.

use std::ops::Range;

use crate::vocabulary::Word;

/// A place in the plane of an outline.
pub type Point = [f64; 2];

/// How curves go through points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spline {
    Linear,
    /// The first point is none of the curve: it tells the slope at the second.
    Quadratic,
    /// The first point and the last are none of the curve: they tell the slopes at its ends.
    Cubic,
    /// Four points for each piece: its ends, and what it leans to.
    Bezier,
}

impl Spline {
    pub fn of(word: Word) -> Option<Self> {
        match word {
            Word::LinearSpline => Some(Self::Linear),
            Word::QuadraticSpline => Some(Self::Quadratic),
            Word::CubicSpline => Some(Self::Cubic),
            Word::BezierSpline => Some(Self::Bezier),
            _ => None,
        }
    }

    pub fn word(self) -> Word {
        match self {
            Self::Linear => Word::LinearSpline,
            Self::Quadratic => Word::QuadraticSpline,
            Self::Cubic => Word::CubicSpline,
            Self::Bezier => Word::BezierSpline,
        }
    }

    /// How many points stand before the first of the curve, and behind its last.
    pub fn controls(self) -> (usize, usize) {
        match self {
            Self::Linear | Self::Bezier => (0, 0),
            Self::Quadratic => (1, 0),
            Self::Cubic => (1, 1),
        }
    }

    /// The closed curves of a prism, each with its control points: a curve ends where its first point stands
    /// again. The last of a linear spline may lack that point. An error is where the points begin of a curve
    /// that never ends.
    ///
    /// **Source:** manual, section 3.4.5.1.11 ("Prism").
    pub fn contours(self, points: &[Point]) -> Result<Vec<Range<usize>>, usize> {
        let (before, behind) = self.controls();
        let step = if self == Self::Bezier { 4 } else { 1 };
        let same = sameness(points);
        let mut found = Vec::new();
        let mut from = 0;
        while from < points.len() {
            let first = from + before;
            let ends = (first + step.max(2) - 1..points.len()).step_by(step);
            let end = ends.into_iter().find(|&i| same(points[i], points[first]));
            let to = match end {
                Some(end) => end + 1 + behind,
                None if self == Self::Linear => points.len(),
                None => return Err(from),
            };
            if to > points.len() {
                return Err(from);
            }
            found.push(from..to);
            from = to;
        }
        Ok(found)
    }
}

/// Points of one outline that are as near as this, of its size, are one: the rounding of the calculations that
/// they may come from.
pub const ROUNDED: f64 = 64.0 * f64::EPSILON;

/// Whether two of these points are one, as far as the rounding tells of the calculations they may come from.
pub fn sameness(points: &[Point]) -> impl Fn(Point, Point) -> bool {
    let size = |axis: usize| points.iter().map(|p| p[axis].abs()).fold(0.0, f64::max);
    let off = size(0).max(size(1)) * ROUNDED;
    move |a, b| (a[0] - b[0]).abs() <= off && (a[1] - b[1]).abs() <= off
}

/// Whether points lie in a line, or in one place, as far as rounding tells.
pub fn are_in_line(points: &[Point]) -> bool {
    let Some(&first) = points.first() else { return true };
    let ways = || points.iter().map(|point| [point[0] - first[0], point[1] - first[1]]);
    let size = |way: &Point| way[0].abs().max(way[1].abs());
    let Some(far) = ways().max_by(|a, b| size(a).total_cmp(&size(b))) else { return true };
    let scale = size(&far);
    let off = 8.0 * f64::EPSILON;
    let turn =
        |way: Point| (far[0] / scale) * (way[1] / scale) - (far[1] / scale) * (way[0] / scale);
    scale == 0.0 || ways().all(|way| turn(way).abs() <= off)
}
