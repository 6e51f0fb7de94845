//! A line that goes nearly along a level end of a lathe: it is asked how it lies to the end in the world, where what
//! touches the end is asked the same, and the outline is asked about a line that is certainly above the end, or below.

use super::line::Line;
use crate::math::Vector;
use crate::shape::U;
use crate::shape::body::{Height, LocalRay};
use crate::shape::curve::Outline;
use crate::shape::slab::{Level, nudge};

/// What is asked of the outline instead of a line that goes nearly along a level end.
pub(super) enum Beside {
    Whole(Line),
    /// It goes through the end, and is on one side of it before, on the other behind.
    Parted {
        before: Line,
        passage: Passage,
        behind: Line,
    },
}

/// Where a line goes through the plane of a level end, and whether up.
pub(super) struct Passage {
    pub s: f64,
    pub error: f64,
    pub height: f64,
    pub rises: bool,
}

/// A line that is so many of its roundings higher or lower than an end of which it is told where it lies is certainly so
/// for the outline.
const FAR: f64 = 64.0;

/// The outline does not tell where a line goes through an end over which it rises by no more than so many roundings.
const UNTOLD: f64 = 8.0;

/// No end is so narrow that a steeper line is untold, by roundings over the line's speed.
const NARROWEST: f64 = 1024.0;

/// The line, or what stands for it, raised to where the outline tells.
pub(super) fn beside(line: Line, outline: &Outline, ray: &LocalRay) -> Beside {
    let (off, speed) = (line.off, line.speed.abs());
    if speed > NARROWEST * off {
        return Beside::Whole(line);
    }
    let levels = || outline.pieces.iter().filter_map(|piece| Some((piece, piece.level()?)));
    for (piece, height) in levels() {
        if speed * piece.width() > UNTOLD * off {
            continue;
        }
        let raised = |from: f64, side: f64| {
            // Not beyond another end.
            let gaps = levels().map(|(_, other)| (other - height).abs()).filter(|gap| *gap > 0.0);
            let far = (FAR * off).min(gaps.fold(f64::INFINITY, f64::min) * 0.5);
            line.raised_to(from + far.copysign(side))
        };
        match Level::of(ray, 2, height, (2.0, 0.0)) {
            Level::In => return Beside::Whole(raised(height, nudge(ray).z)),
            Level::Through { s, error, rise } => {
                // As high there, at s.
                let start = height - line.speed * s;
                let [before, behind] = [-rise, rise].map(|side| raised(start, side));
                let passage = Passage { s, error, height, rises: rise > 0.0 };
                return Beside::Parted { before, passage, behind };
            }
            Level::Beside(side) if (height - line.start).abs() <= UNTOLD * off => {
                return Beside::Whole(raised(line.start, side));
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
