//! Lowers solids made of a plane curve: converts points to polynomial pieces of size about 1, about their
//! centre where the solid may be translated.
//!
//! Sizes are powers of two and the centre is rounded, so that most numbers lose no digit.

use super::Fault;
use super::transform::Affine;
use crate::math::double::{Double, DoubleVector, exact_middle, power_of_two_near};
use crate::scene::outline::{Point, Spline, sameness};
use crate::shape::curve::{Outline, Piece};
use crate::shape::sor::Segment;
use crate::shape::{Body, Lathe, Prism, Sor};

/// Returns the map that takes the y axis to the local z axis, and z to the local y axis.
fn frame(width: f64, height: Double, middle: [Double; 3]) -> Affine {
    let width = Double::from(width);
    let [x, y, z] = [0, 1, 2].map(DoubleVector::axis);
    let columns = [x * width, z * width, y * height];
    let [x, y, z] = middle;
    Affine::from_columns(columns, DoubleVector::new(x, y, z))
}

/// As [`frame`], for a solid of revolution about the y axis.
fn about_axis(width: f64, height: f64, middle: f64) -> Affine {
    let zero = Double::from(0.0);
    frame(width, Double::from(height), [zero, Double::from(middle), zero])
}

/// Returns a power of two greater than `size` and at most twice it; ∞ if `size` is not finite.
fn size_over(size: f64) -> f64 {
    if size.is_finite() { 2.0 * power_of_two_near(size) } else { f64::INFINITY }
}

/// Returns the minimum and the maximum of some numbers.
fn range(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), n| (a.min(n), b.max(n)))
}

/// Returns the approximate middle of a range, rounded to few digits.
fn middle((low, high): (f64, f64)) -> f64 {
    let step = size_over(high - low) / 512.0;
    let middle = ((0.5 * low + 0.5 * high) / step).round() * step;
    if middle.is_finite() { middle } else { 0.5 * low + 0.5 * high }
}

/// Returns the pieces of a curve through points, some of which only define slopes.
///
/// **Source:** manual, section 3.4.5.1.8 ("Lathe"); the slopes are POV-Ray 3.7's, measured with `trace`.
pub fn pieces(spline: Spline, points: &[Point]) -> Vec<Piece> {
    let toward = |from: Point, [a, b]: [Point; 2], share: f64| {
        [0, 1].map(|axis| from[axis] + share * (b[axis] - a[axis]))
    };
    let made: Vec<Option<Piece>> = match spline {
        Spline::Linear => points.windows(2).map(Piece::bezier).collect(),
        Spline::Quadratic => {
            let piece =
                |p: &[Point]| Piece::bezier(&[p[1], toward(p[1], [p[0], p[2]], 0.25), p[2]]);
            points.windows(3).map(piece).collect()
        }
        Spline::Cubic => {
            const SHARE: f64 = 1.0 / 6.0;
            let piece = |p: &[Point]| {
                let (out, in_) =
                    (toward(p[1], [p[0], p[2]], SHARE), toward(p[2], [p[3], p[1]], SHARE));
                Piece::bezier(&[p[1], out, in_, p[2]])
            };
            points.windows(4).map(piece).collect()
        }
        Spline::Bezier => points.chunks_exact(4).map(Piece::bezier).collect(),
    };
    made.into_iter().flatten().collect()
}

/// Returns the largest distance of Bézier points from the origin along an axis.
fn widest(curves: &[Vec<Piece>], axis: usize) -> f64 {
    let points = curves.iter().flatten().flat_map(Piece::points);
    points.map(|point| point[axis].abs()).fold(0.0, |most, size| {
        if size > most {
            size
        } else if size.is_nan() {
            f64::INFINITY
        } else {
            most
        }
    })
}

fn scaled(curves: Vec<Vec<Piece>>, by: [f64; 2]) -> Vec<Vec<Piece>> {
    let scale = |piece: Piece| {
        let points: Vec<Point> =
            piece.points().iter().map(|point| [0, 1].map(|i| point[i] / by[i])).collect();
        Piece::bezier(&points)
    };
    curves.into_iter().map(|curve| curve.into_iter().filter_map(scale).collect()).collect()
}

/// Returns a prism between the heights −1 and 1; a conic one has its tip at the local origin. `None` if it is
/// empty.
pub fn prism(
    spline: Spline,
    conic: bool,
    heights: [f64; 2],
    points: &[Point],
    open: bool,
) -> Result<Option<(Body, Affine)>, Fault> {
    let same = sameness(points);
    let centre = match conic {
        true => [0.0; 2],
        false => [0, 1].map(|axis| middle(range(points.iter().map(|point| point[axis])))),
    };
    let local = |point: &Point| [0, 1].map(|axis| point[axis] - centre[axis]);
    let (before, behind) = spline.controls();
    let mut curves = Vec::new();
    for contour in spline.contours(points).unwrap_or_default() {
        let mut curve = points[contour].to_vec();
        let (first, last) = (before, curve.len() - 1 - behind);
        match same(curve[first], curve[last]) {
            true => curve[last] = curve[first],
            false => curve.push(curve[first]),
        }
        if spline == Spline::Bezier {
            (4..curve.len()).step_by(4).for_each(|joint| curve[joint] = curve[joint - 1]);
        }
        curves.push(pieces(spline, &curve.iter().map(local).collect::<Vec<_>>()));
    }
    // One width for both axes keeps the angles of the walls; it leaves room for the diagonal.
    let width = 2.0 * size_over(widest(&curves, 0).max(widest(&curves, 1)));
    if !width.is_finite() {
        return Err(Fault::not_finite("this prism"));
    }
    let mut outline = Outline::default();
    scaled(curves, [width; 2]).into_iter().for_each(|curve| outline.add(curve));
    if outline.pieces.is_empty() {
        return Ok(None);
    }
    let (low, high) = range(heights.into_iter());
    let (heights, frame) = if conic {
        let size = size_over(low.abs().max(high.abs()));
        let origin = [Double::from(0.0); 3];
        ([low / size, high / size], frame(width * size, Double::from(size), origin))
    } else {
        let half = Double::from(0.5);
        let (height, middle) = (
            (Double::from(high) - Double::from(low)) * half,
            (Double::from(high) + Double::from(low)) * half,
        );
        let place = [Double::from(centre[0]), middle, Double::from(centre[1])];
        ([-1.0, 1.0], frame(width, height, place))
    };
    Ok(Some((Body::Prism(Prism { outline, conic, heights, open }), frame)))
}

/// Returns a lathe about the z axis. `None` if it is empty.
pub fn lathe(spline: Spline, points: &[Point]) -> Result<Option<(Body, Affine)>, Fault> {
    let same = sameness(points);
    let height = exact_middle(range(points.iter().map(|point| point[1])));
    let mut points = points.to_vec();
    let (before, behind) = spline.controls();
    let joints = if spline == Spline::Bezier { 4 } else { points.len() };
    let mut runs: Vec<Vec<Point>> = Vec::new();
    for i in (joints..points.len()).step_by(joints) {
        if same(points[i - 1], points[i]) {
            points[i] = points[i - 1];
        }
    }
    for group in points.chunks(joints) {
        match runs.last_mut() {
            Some(run) if run.last() == group.first() => run.extend_from_slice(group),
            _ => runs.push(group.to_vec()),
        }
    }
    let curves = runs.into_iter().map(|mut run| {
        let (first, last) = (before, run.len() - 1 - behind);
        if same(run[first], run[last]) {
            run[last] = run[first];
        }
        let local: Vec<Point> = run.iter().map(|[x, y]| [*x, y - height]).collect();
        pieces(spline, &local)
    });
    let curves: Vec<_> = curves.collect();
    let (width, tall) = (2.0 * size_over(widest(&curves, 0)), 2.0 * size_over(widest(&curves, 1)));
    if !(width.is_finite() && tall.is_finite()) {
        return Err(Fault::not_finite("this lathe"));
    }
    let lathe = Lathe::new(scaled(curves, [width, tall]));
    let frame = about_axis(width, tall, height);
    Ok(lathe.map(|lathe| (Body::Lathe(lathe), frame)))
}

/// Returns a sor about the z axis, between heights within −1 … 1. `None` if it is empty.
pub fn sor(points: &[Point], open: bool) -> Result<Option<(Body, Affine)>, Fault> {
    let on_curve = &points[1..points.len() - 1];
    let heights = range(on_curve.iter().map(|point| point[1]));
    let centre = exact_middle(heights);
    let tall = size_over((heights.0 - centre).abs().max((heights.1 - centre).abs()));
    let (_, widest) = range(points.iter().map(|point| point[0]));
    let size = size_over(widest);
    let radius = |i: usize| points[i][0] / size;
    let height = |i: usize| (points[i][1] - centre) / tall;
    // Twice r·r′ where the curve passes through a point.
    let slope = |i: usize| {
        2.0 * radius(i) * (radius(i + 1) - radius(i - 1)) / (height(i + 1) - height(i - 1))
    };
    let segment = |i: usize| {
        let (low, high) = (height(i), height(i + 1));
        let (first, last) = (radius(i) * radius(i), radius(i + 1) * radius(i + 1));
        let third = (high - low) / 3.0;
        let squares = [first, first + third * slope(i), last - third * slope(i + 1), last];
        Segment { low, high, squares }
    };
    let mut segments: Vec<Segment> = (1..points.len() - 2).map(segment).collect();
    segments.retain(|segment| segment.low < segment.high);
    // The curve may bulge between its points.
    let (_, greatest) = range(segments.iter().flat_map(|segment| segment.squares));
    let swell = size_over(greatest.max(0.0).sqrt()).max(1.0);
    for segment in &mut segments {
        segment.squares = segment.squares.map(|square| square / (swell * swell));
    }
    if segments.iter().flat_map(|segment| segment.squares).any(|square| !square.is_finite()) {
        return Err(Fault::not_finite("this sor"));
    }
    let frame = about_axis(size * swell, tall, centre);
    Ok(Sor::new(segments, open).map(|sor| (Body::Sor(sor), frame)))
}
