//! Pavements of triangles.

use std::f64::consts::PI;

use super::super::settled;
use super::{Borders, H, Looks, R, ROOT_3, concave, obtuse};
use crate::math::elementary::{atan2, cos, sin};

/// A sixth of a turn.
const SIXTH: f64 = PI / 3.0;

/// Returns the value at a point.
pub(super) fn value(borders: &Borders, looks: Looks, [x, z]: [f64; 2], error: [f64; 2]) -> f64 {
    // Two coordinates count triangles that point up; the third line separates those from the others.
    let (column, row) = (x - z / (2.0 * H), z / H);
    let row = settled(row, error[1] / H);
    let column = settled(column, error[0] + error[1]);
    let (i, j) = (column.floor(), row.floor());
    let (s, t) = (column - i, row - j);
    let rest = settled(1.0 - s - t, error[0] + error[1]);
    let (i, j) = (i as i64, j as i64);
    let is_up = rest >= 0.0;
    let (sides, corners) = if is_up {
        let sides =
            [(borders.has(i, j, 0), t), (borders.has(i, j, 1), s), (borders.has(i, j, 2), rest)];
        (sides, [(0, 0), (1, 0), (0, 1)])
    } else {
        let sides = [
            (borders.has(i, j + 1, 0), 1.0 - t),
            (borders.has(i + 1, j, 1), 1.0 - s),
            (borders.has(i, j, 2), -rest),
        ];
        (sides, [(1, 0), (0, 1), (1, 1)])
    };
    let mut value = 0.0_f64;
    for (_, distance) in sides.iter().filter(|(has, _)| *has) {
        value = value.max(1.0 - distance * H / R);
    }
    for (right, up) in corners {
        let (s, t) = (s - right as f64, t - up as f64);
        let from_corner = [s + t / 2.0, t * H];
        if let Some(near) = near_corner(borders, looks, (i + right, j + up), from_corner) {
            value = value.max(near);
        }
    }
    value
}

/// Returns whether the line from a vertex in one of six directions is a border.
fn has_ray(borders: &Borders, (i, j): (i64, i64), direction: usize) -> bool {
    match direction % 6 {
        0 => borders.has(i, j, 0),
        1 => borders.has(i, j, 1),
        2 => borders.has(i - 1, j, 2),
        3 => borders.has(i - 1, j, 0),
        4 => borders.has(i, j - 1, 1),
        _ => borders.has(i, j - 1, 2),
    }
}

/// Returns what a vertex adds to the value at a point in one of its six triangles.
fn near_corner(
    borders: &Borders,
    looks: Looks,
    vertex: (i64, i64),
    [x, z]: [f64; 2],
) -> Option<f64> {
    let angle = atan2(z, x);
    let angle = if angle < 0.0 { angle + 2.0 * PI } else { angle };
    let sector = ((angle / SIXTH) as usize).min(5);
    let within = angle - sector as f64 * SIXTH;
    // Numbers of triangles to the nearest border on either side.
    let before = (0..6).find(|steps| has_ray(borders, vertex, sector + 6 - steps))?;
    let after = (0..6).find(|steps| has_ray(borders, vertex, sector + 1 + steps))?;
    let distance = (x * x + z * z).sqrt();
    let turn = before as f64 * SIXTH + within;
    let pointed = match (before, after) {
        (0, _) | (_, 0) => 0.0,
        // A corner of 300° is cut even if it is pointed.
        (2, 2) => 1.0 - distance * sin(SIXTH + within) / R,
        _ => {
            let other = (after + 1) as f64 * SIXTH - within;
            1.0 - distance * sin(turn.min(other)) / R
        }
    };
    let looked = match before + after + 1 {
        1 => {
            sharp(looks.exterior, distance * cos(turn - PI / 6.0), distance * sin(turn - PI / 6.0))
        }
        2 => {
            let (along, across) = (distance * cos(turn - SIXTH), distance * sin(turn - SIXTH));
            obtuse(looks.form, [1.0 - along, across])
        }
        _ => concave(looks.interior, distance, turn),
    };
    Some(pointed.max(looked))
}

/// Returns the value near a corner of 60°, which is greater than that of the borders alone if the corner is
/// not pointed; `along` is the distance from the corner along its bisector.
fn sharp(look: u8, along: f64, across: f64) -> f64 {
    let to_centre = 2.0 * R - along;
    match look {
        1 => to_centre / R,
        2 if across.abs() <= to_centre * ROOT_3 => {
            (to_centre * to_centre + across * across).sqrt() / R
        }
        _ => 0.0,
    }
}
