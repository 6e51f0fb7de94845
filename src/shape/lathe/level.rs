//! A line that lies in a level end of a lathe, of two solids that touch there: one of them has it, as if it were
//! moved to its side.

use super::line::Line;
use crate::math::Vector;
use crate::shape::U;
use crate::shape::body::{Height, LocalRay};
use crate::shape::curve::Outline;
use crate::shape::slab::{Level, nudge};

/// The line, so much above or below a level end that it goes along that rounding tells. One that is known to go
/// through is left to the outline.
pub(super) fn beside(line: Line, outline: &Outline, ray: &LocalRay) -> Line {
    if line.speed.abs() > 2.0 * line.off {
        return line;
    }
    let far = 64.0 * line.off;
    let height = outline.pieces.iter().find_map(|piece| {
        let [_, height] = piece.first();
        if !piece.points().iter().all(|point| point[1] == height) {
            return None;
        }
        match Level::of(ray, 2, height, (2.0, 0.0)) {
            Level::In => Some(height + far.copysign(nudge(ray).z)),
            // By less than the outline tells anywhere.
            Level::Through { rise, .. } if rise.abs() <= U => {
                Some(height + far.copysign(nudge(ray).z))
            }
            Level::Beside(side) if (height - line.start).abs() <= 8.0 * line.off => {
                Some(line.start + far.copysign(side))
            }
            _ => None,
        }
    });
    match height {
        Some(height) => line.raised_to(height),
        None => line,
    }
}

/// How far along the line a crossing may be from where the line that is raised crosses the same wall.
#[cold]
pub(super) fn moved(line: &Line, Height { gradient, .. }: Height, direction: Vector) -> f64 {
    let rise = 2.0 * (line.raised * gradient.z).abs();
    if rise > 0.0 { rise / gradient.dot(direction).abs() + U * rise } else { 0.0 }
}
