//! Lowers polygons, Bézier patches, text and height fields from their points, each about its own centre and
//! of size about 1.
//!
//! **In:** a solid as written. **Out:** a body and the map to it from its own space; `None` if it is empty.

use super::Fault;
use super::transform::{Affine, exact};
use crate::math::double::{Double, DoubleVector};
use crate::math::{Vector, reciprocal_power_of_two};
use crate::scene::height_field::HeightField;
use crate::scene::polygon::Polygon;
use crate::scene::text::Text;
use crate::shape::curve::{Outline, Piece};
use crate::shape::{self, BicubicPatch, Body};

/// A body and the map to it from its own space.
pub type Made = Option<(Body, Affine)>;

/// The centre of the points' bounding box, and its size. The centre is rounded to 1/256 of the size, and the
/// size to a power of two, so that most numbers lose no digit.
struct Middle {
    middle: Vector,
    inverse_size: f64,
}

impl Middle {
    fn of<'p>(points: impl Iterator<Item = &'p Vector>, what: &str) -> Result<Self, Fault> {
        let none = (Vector::INFINITY, Vector::NEG_INFINITY);
        let (low, high) =
            points.fold(none, |(low, high), point| (low.min(*point), high.max(*point)));
        let (low, high) = (low * 0.5, high * 0.5);
        if !(low.is_finite() && high.is_finite()) {
            return Err(Fault::not_finite(what));
        }
        let inverse_size = 0.5 * reciprocal_power_of_two((high - low).max_element());
        let step = 1.0 / (256.0 * inverse_size);
        let middle = ((low + high) / step).round() * step;
        let middle = if middle.is_finite() { middle } else { low + high };
        Ok(Self { middle, inverse_size })
    }

    fn local(&self, point: Vector) -> Vector {
        point * self.inverse_size - self.middle * self.inverse_size
    }

    fn frame(&self, columns: [DoubleVector; 3]) -> Affine {
        let size = Double::from(1.0 / self.inverse_size);
        Affine::from_columns(columns.map(|column| column * size), exact(self.middle))
    }
}

/// Returns a patch of 16 control points.
pub fn bicubic_patch(points: &[Vector; 16]) -> Result<(Body, Affine), Fault> {
    let middle = Middle::of(points.iter(), "this patch")?;
    let patch = BicubicPatch::new(points.map(|point| middle.local(point)));
    Ok((Body::BicubicPatch(patch), middle.frame([0, 1, 2].map(DoubleVector::axis))))
}

/// Returns a polygon in the plane of its corners, with z along the normal.
pub fn polygon(polygon: &Polygon) -> Result<Made, Fault> {
    let Some(plane) = polygon.plane() else { return Ok(None) };
    let middle = Middle::of(polygon.lines.iter().flatten(), "this polygon")?;
    let size = Double::from(1.0 / middle.inverse_size);
    // Moved back by the centre's distance from the plane, which comes from rounding.
    let off = (plane.corner - exact(middle.middle)).dot(plane.normal);
    let foot = exact(middle.middle) + plane.normal * off;
    let Some(columns) = across(plane.normal) else { return Ok(None) };
    let local = |point: &Vector| {
        let from = exact(*point) - foot;
        [0, 1].map(|axis| (from.dot(columns[axis]) / size).round())
    };
    let lines: Vec<Vec<_>> =
        polygon.lines.iter().map(|line| line.iter().map(local).collect()).collect();
    let frame = Affine::from_columns(columns.map(|column| column * size), foot);
    Ok(shape::Polygon::new(&lines).map(|polygon| (Body::Polygon(polygon), frame)))
}

/// Returns three orthonormal vectors, the last of which is `normal`; coordinate axes if `normal` is one.
fn across(normal: DoubleVector) -> Option<[DoubleVector; 3]> {
    let sizes = normal.round().abs();
    // The first of the coordinate axes farthest from it.
    let away = (0..3).min_by(|&i, &j| sizes[i].total_cmp(&sizes[j]))?;
    let aside = normal.cross(DoubleVector::axis(away)).normalized()?;
    Some([aside, normal.cross(aside), normal])
}

/// Returns text between the heights −1 and 1.
pub fn text(text: &Text) -> Result<Made, Fault> {
    let points = || text.letters.iter().flat_map(|letter| &letter.contours);
    let points: Vec<Vector> =
        points().flat_map(|all| &all.points).map(|&[x, y]| Vector::new(x, y, 0.0)).collect();
    let what = "this text";
    let middle = Middle::of(points.iter(), what)?;
    let place = |&[x, y]: &[f64; 2]| {
        // Leaves room for the diagonal.
        let local = middle.local(Vector::new(x, y, 0.0)) * 0.5;
        [local.x, local.y]
    };
    let outlines = text.letters.iter().map(|letter| {
        let mut outline = Outline::default();
        for contour in &letter.contours {
            let pieces =
                contour.pieces().map(|points| points.iter().map(place).collect::<Vec<_>>());
            let mut pieces: Vec<Piece> =
                pieces.filter_map(|points| Piece::bezier(&points)).collect();
            if let (Some(first), Some(last)) = (pieces.first(), pieces.last()) {
                let closing = Piece::line(last.last(), first.first());
                if last.last() != first.first() {
                    pieces.push(closing);
                }
            }
            outline.add(pieces);
        }
        outline
    });
    let outlines = outlines.filter(|outline| !outline.pieces.is_empty()).collect();
    let is_flat = text.thickness == 0.0;
    let half = Double::from(text.thickness) * Double::from(0.5);
    let width = Double::from(2.0 / middle.inverse_size);
    let [x, y, z] = [0, 1, 2].map(DoubleVector::axis);
    let centre = exact(middle.middle) + z * half;
    if !half.is_finite() {
        return Err(Fault::not_finite(what));
    }
    let up = if is_flat { width } else { half.abs() };
    let frame = Affine::from_columns([x * width, y * width, z * up], centre);
    Ok(shape::Text::new(outlines, is_flat).map(|text| (Body::Text(text), frame)))
}

/// Returns a height field in the unit cube about the origin.
pub fn height_field(field: &HeightField) -> Made {
    let heights = field.heights.iter().map(|height| height - 0.5).collect();
    let HeightField { width, water, smooth, .. } = *field;
    let body = shape::HeightField::new(heights, width, water - 0.5, smooth)?;
    let frame = Affine::from_columns([0, 1, 2].map(DoubleVector::axis), exact(Vector::splat(0.5)));
    Some((Body::HeightField(body), frame))
}
