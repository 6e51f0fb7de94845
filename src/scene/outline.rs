//! Outlines as written: points in a plane, and the spline through them.

use std::ops::Range;

use crate::vocabulary::Word;

/// A point in the plane of an outline.
pub type Point = [f64; 2];

/// The kind of spline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spline {
    Linear,
    /// The first point is not on the curve: it defines the slope at the second.
    Quadratic,
    /// The first and the last point are not on the curve: they define the slopes at its ends.
    Cubic,
    /// Four points for each piece: its ends, and two control points.
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

    /// Returns the number of control points before the first point of the curve, and after its last.
    pub fn controls(self) -> (usize, usize) {
        match self {
            Self::Linear | Self::Bezier => (0, 0),
            Self::Quadratic => (1, 0),
            Self::Cubic => (1, 1),
        }
    }

    /// Returns the closed curves of a prism, each with its control points: a curve ends where its first point
    /// recurs. The last curve of a linear spline may omit that point. On error, returns the start of a curve
    /// that never closes.
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

/// Relative distance within which points of one outline are equal: the rounding of the calculations that may
/// have produced them.
pub(crate) const ROUNDED: f64 = 64.0 * f64::EPSILON;

/// Returns a predicate for equality of two of these points, up to the rounding of the calculations that may
/// have produced them.
pub(crate) fn sameness(points: &[Point]) -> impl Fn(Point, Point) -> bool {
    let size = |axis: usize| points.iter().map(|p| p[axis].abs()).fold(0.0, f64::max);
    let off = size(0).max(size(1)) * ROUNDED;
    move |a, b| (a[0] - b[0]).abs() <= off && (a[1] - b[1]).abs() <= off
}

/// Returns whether the points are collinear or equal, up to rounding.
pub(crate) fn are_in_line(points: &[Point]) -> bool {
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
