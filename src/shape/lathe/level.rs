//! Lines nearly parallel to a horizontal end of a lathe. Their position relative to the end is determined in
//! world space, so that a solid that touches the end gets the same answer; the outline is then intersected
//! with a line certainly above or below the end.

use super::line::Line;
use crate::math::Vector;
use crate::shape::U;
use crate::shape::curve::Outline;
use crate::shape::local::{Height, LocalRay};
use crate::shape::slab::{Level, nudge};

/// The lines to intersect with the outline instead of a line nearly parallel to a horizontal end.
pub(super) enum Beside {
    Whole(Line),
    /// The line crosses the end: one substitute before the crossing, one after it.
    Parted {
        before: Line,
        passage: Passage,
        behind: Line,
    },
}

/// The crossing of a line with the plane of a horizontal end, and whether the line rises there.
pub(super) struct Passage {
    pub s: f64,
    pub error: f64,
    pub height: f64,
    pub rises: bool,
}

/// Number of roundings by which a line is moved above or below an end, so that its position is certain for
/// the outline.
const FAR: f64 = 64.0;

/// Rise over an end, in roundings, up to which the outline cannot determine where a line crosses it.
const UNTOLD: f64 = 8.0;

/// Speed, in roundings, above which a line is never ambiguous: no end is narrow enough.
const NARROWEST: f64 = 1024.0;

/// Returns the line, or its substitutes, raised to a height that is unambiguous for the outline.
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

/// Bound on the distance, along the line, from a crossing to that of the raised line with the same wall.
#[cold]
pub(super) fn moved(line: &Line, Height { gradient, .. }: Height, direction: Vector) -> f64 {
    let rise = 2.0 * (line.raised * gradient.z).abs();
    if rise > 0.0 { rise / gradient.dot(direction).abs() + U * rise } else { 0.0 }
}
