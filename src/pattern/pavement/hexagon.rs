//! Pavements of hexagons.

use std::f64::consts::PI;

use super::{Borders, H, Looks, R, concave, obtuse};
use crate::math::elementary::{atan2, sin_cos_degrees};

/// Returns the value at a point.
pub(super) fn value(borders: &Borders, looks: Looks, [x, z]: [f64; 2]) -> f64 {
    let (i, j, x, z) = nearest(x, z);
    // By the directions of their normals: 30°, 90° and so on.
    let sides = [
        borders.has(i, j, 1),
        borders.has(i, j, 0),
        borders.has(i - 1, j + 1, 2),
        borders.has(i - 1, j, 1),
        borders.has(i, j - 1, 0),
        borders.has(i, j, 2),
    ];
    let mut value = 0.0_f64;
    for (place, has_side) in sides.into_iter().enumerate() {
        let degrees = place as f64 * 60.0;
        if has_side {
            let (sin, cos) = sin_cos_degrees(degrees + 30.0);
            value = value.max(1.0 - (H - (x * cos + z * sin)) / R);
        }
        // The corner between this side and the one before.
        let (sin, cos) = sin_cos_degrees(degrees);
        value = value.max(match (sides[(place + 5) % 6], has_side) {
            (true, true) => obtuse(looks.form, [x * cos + z * sin, z * cos - x * sin]),
            (false, false) => 0.0,
            _ => {
                let (x, z) = (x - cos, z - sin);
                concave(looks.interior, (x * x + z * z).sqrt(), atan2(z, x) + PI)
            }
        });
    }
    value
}

/// Returns the indices of the cell with the nearest centre, and the point relative to that.
fn nearest(x: f64, z: f64) -> (i64, i64, f64, f64) {
    let column = ((x - 1.0) / 1.5).floor();
    let mut best = (0, 0, 0.0, 0.0);
    let mut least = f64::INFINITY;
    for column in [column, column + 1.0] {
        let x = x - 1.0 - 1.5 * column;
        let z = z - H * column;
        let row = (z / (2.0 * H)).round();
        let z = z - 2.0 * H * row;
        let squared = x * x + z * z;
        if squared < least {
            least = squared;
            best = (column as i64, row as i64, x, z);
        }
    }
    best
}
