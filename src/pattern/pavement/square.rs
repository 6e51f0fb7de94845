//! Pavements of squares.

use super::super::settled;
use super::{Borders, Looks};

/// Combines the distances of a point from two lines at a right angle, for a corner of a look.
fn joined(look: u8, a: f64, b: f64) -> f64 {
    match look {
        0 => a.max(b),
        1 => a + b,
        _ => (a * a + b * b).sqrt(),
    }
}

/// Returns the value at a point.
pub(super) fn value(borders: &Borders, looks: Looks, at: [f64; 2], error: [f64; 2]) -> f64 {
    let at = [settled(at[0], error[0]), settled(at[1], error[1])];
    let cell = at.map(f64::floor);
    let ([x, z], [i, j]) = ([at[0] - cell[0], at[1] - cell[1]], cell.map(|index| index as i64));
    let has_left = borders.has(i, j, 0);
    let has_right = borders.has(i + 1, j, 0);
    let has_bottom = borders.has(i, j, 1);
    let has_top = borders.has(i, j + 1, 1);
    // A vertex by its two sides; any of the four lines from it may be a border.
    let touches = |right: bool, top: bool| {
        let (i, j) = (i + i64::from(right), j + i64::from(top));
        borders.has(i, j, 0)
            || borders.has(i, j, 1)
            || borders.has(i, j - 1, 0)
            || borders.has(i - 1, j, 1)
    };
    // Distances from the centre lines, towards borders only.
    let outwards = |position: f64, low: bool, high: bool| match position < 0.5 {
        true if low => 0.5 - position,
        false if high => position - 0.5,
        _ => 0.0,
    };
    let (across, up) = (outwards(x, has_left, has_right), outwards(z, has_bottom, has_top));
    let from = |position: f64, high: bool| if high { 1.0 - position } else { position };
    let inside = |look: u8, right: bool, top: bool| match touches(right, top) {
        true => 1.0 - 2.0 * joined(look, from(x, right), from(z, top)),
        false => 0.0,
    };
    let is_turn = has_left != has_right && has_bottom != has_top;
    if is_turn {
        let (right, top) = (!has_right, !has_top);
        // A turn around a corner of its own tile bends with it.
        if touches(right, top) && looks.form != 3 {
            if looks.form == 0 {
                return (2.0 * across.max(up)).max(inside(0, right, top));
            }
            return (2.0 * joined(looks.form, from(x, right), from(z, top)) - 1.0).abs();
        }
        return (2.0 * joined(looks.exterior, across, up)).max(inside(looks.interior, right, top));
    }
    let count = [has_left, has_right, has_bottom, has_top].iter().filter(|has| **has).count();
    if count >= 3 {
        return 2.0 * joined(looks.exterior, across, up);
    }
    let mut value = 2.0 * across.max(up);
    for (right, has_side) in [(false, has_left), (true, has_right)] {
        for (top, has_other) in [(false, has_bottom), (true, has_top)] {
            if !has_side && !has_other {
                value = value.max(inside(looks.interior, right, top));
            }
        }
    }
    value
}
