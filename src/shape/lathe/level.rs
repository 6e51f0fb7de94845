//! A line that lies in a level end of a lathe, of two solids that touch there: one of them has it, as if it were
//! moved to its side.

use super::line::Line;
use crate::math::Vector;
use crate::shape::U;
use crate::shape::body::{Height, LocalRay};
use crate::shape::curve::{Outline, Piece};
use crate::shape::slab::{Level, nudge};

/// What is asked of the outline instead of a line that goes nearly along a level end.
pub(super) enum Beside {
    Whole(Line),
    /// It goes through the end, and is on one side of it before, on the other behind.
    Parted {
        before: Line,
        through: Through,
        behind: Line,
    },
}

/// Where a line goes through the plane of a level end, and whether up.
pub(super) struct Through {
    pub s: f64,
    pub error: f64,
    pub height: f64,
    pub rises: bool,
}

/// The line, so much above or below a level end that it goes along that rounding tells.
pub(super) fn beside(line: Line, outline: &Outline, ray: &LocalRay) -> Beside {
    if line.speed.abs() > 2.0 * line.off {
        return Beside::Whole(line);
    }
    let far = 64.0 * line.off;
    let is_level = |piece: &Piece, height: f64| piece.points().iter().all(|p| p[1] == height);
    let levels = outline.pieces.iter().map(|piece| (piece, piece.first()[1]));
    for (_, height) in levels.filter(|(piece, height)| is_level(piece, *height)) {
        match Level::of(ray, 2, height, (2.0, 0.0)) {
            Level::In => {
                return Beside::Whole(line.raised_to(height + far.copysign(nudge(ray).z)));
            }
            Level::Through { s, error, rise } => {
                let [before, behind] =
                    [-rise, rise].map(|side| line.raised_to(height + far.copysign(side)));
                let through = Through { s, error, height, rises: rise > 0.0 };
                return Beside::Parted { before, through, behind };
            }
            Level::Beside(side) if (height - line.start).abs() <= 8.0 * line.off => {
                return Beside::Whole(line.raised_to(line.start + far.copysign(side)));
            }
            Level::Beside(_) => {}
        }
    }
    Beside::Whole(line)
}

/// How far along the line a crossing may be from where the line that is raised crosses the same wall.
#[cold]
pub(super) fn moved(line: &Line, Height { gradient, .. }: Height, direction: Vector) -> f64 {
    let rise = 2.0 * (line.raised * gradient.z).abs();
    if rise > 0.0 { rise / gradient.dot(direction).abs() + U * rise } else { 0.0 }
}
