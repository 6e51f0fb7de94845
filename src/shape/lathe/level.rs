//! A line that lies in a level end of a lathe, of two solids that touch there: one of them has it, as if it were
//! moved to its side.

use super::line::Line;
use crate::math::Vector;
use crate::shape::U;
use crate::shape::body::{Height, LocalRay};
use crate::shape::curve::Outline;
use crate::shape::slab::side;

/// The line, so much above or below a level end that it goes along that rounding tells.
pub(super) fn beside(line: Line, outline: &Outline, ray: &LocalRay) -> Line {
    if line.speed.abs() > line.off {
        return line;
    }
    let is_near = |height: f64| (height - line.start).abs() <= 8.0 * line.off;
    let far = 64.0 * line.off;
    let side = outline.pieces.iter().find_map(|piece| {
        let ([a, height], [b, _]) = (piece.first(), piece.last());
        let is_level = piece.points().iter().all(|point| point[1] == height);
        let holds = |way: f64| outline.contains([0.5 * (a + b), height + way * far]);
        (is_level && is_near(height)).then(|| side(ray, 2, height, holds)).flatten()
    });
    match side {
        Some(side) => line.raised(side * far),
        None => line,
    }
}

/// How far along the line a crossing may be from where the line that is raised crosses the same wall.
#[cold]
pub(super) fn moved(line: &Line, Height { gradient, .. }: Height, direction: Vector) -> f64 {
    let rise = 2.0 * (line.raised * gradient.z).abs();
    if rise > 0.0 { rise / gradient.dot(direction).abs() + U * rise } else { 0.0 }
}
