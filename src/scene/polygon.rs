//! Polygons as written: closed lines in one plane.

use crate::math::Vector;
use crate::math::double::{Double, DoubleVector};

/// One or more closed lines.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Polygon {
    /// Each continues from its last corner to its first.
    pub lines: Vec<Vec<Vector>>,
}

/// The plane of a polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flat {
    pub corner: DoubleVector,
    /// Of length 1. The polygon faces along it: its first turn is to the left about it.
    pub normal: DoubleVector,
    /// The distance from the corner to the farthest point.
    pub size: Double,
}

impl Polygon {
    /// Returns the plane through the points that define it best; `None` if they are collinear.
    pub fn plane(&self) -> Option<Flat> {
        let points = || self.lines.iter().flatten().map(|point| DoubleVector::from(*point));
        let corner = points().next()?;
        let far = |of: &dyn Fn(DoubleVector) -> DoubleVector| {
            let all = points().map(|point| of(point - corner));
            all.max_by(|a, b| a.length().round().total_cmp(&b.length().round()))
        };
        let first = far(&|way| way)?;
        let across = far(&|way| first.cross(way))?;
        let size = first.length();
        let narrow = across.length().round() <= f64::EPSILON * (size * size).round();
        let normal = across.normalized().filter(|_| !narrow)?;
        let turns = self.lines.first()?.windows(3).map(|corners| {
            let [a, b, c] = [0, 1, 2].map(|i| DoubleVector::from(corners[i]));
            (b - a).cross(c - a).dot(normal).round()
        });
        let turned = turns.into_iter().find(|turn| *turn != 0.0).is_some_and(|turn| turn < 0.0);
        Some(Flat { corner, normal: if turned { -normal } else { normal }, size })
    }

    pub fn count(&self) -> usize {
        self.lines.iter().map(Vec::len).sum()
    }
}

impl Flat {
    /// Returns the distance of a point from the plane, relative to the polygon's size.
    pub fn off(&self, point: Vector) -> f64 {
        ((DoubleVector::from(point) - self.corner).dot(self.normal) / self.size).round().abs()
    }
}
