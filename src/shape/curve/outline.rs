//! Outlines: plane regions bounded by one or more curves.
//!
//! **Invariant:** pieces are monotone along both axes; a point is tested only against pieces whose boxes are
//! near it.

use std::ops::Range;

use smallvec::SmallVec;

use super::boxes::{Boxes, Hull, union};
use super::{Piece, Point, is_apart};
use crate::shape::{Memory, U};

/// A row of pieces, by the indices of the first and of the one after the last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    pub from: usize,
    pub to: usize,
    /// Whether its end is its start.
    pub closed: bool,
    /// Index of its first box.
    pub(super) root: usize,
}

/// Runs of monotone pieces.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Outline {
    pub pieces: Vec<Piece>,
    pub runs: Vec<Run>,
    pub(super) boxes: Memory<Boxes>,
    /// Bounding box.
    hull: Hull,
    /// Maximum distance from the origin.
    reach: f64,
}

impl Outline {
    /// Adds pieces that join end to end.
    pub fn add(&mut self, pieces: impl IntoIterator<Item = Piece>) {
        let from = self.pieces.len();
        self.pieces.extend(pieces.into_iter().flat_map(Piece::monotone));
        let run = &self.pieces[from..];
        let sizes = run.iter().flat_map(Piece::points).map(|[x, y]| x * x + y * y);
        let reach = sizes.fold(0.0, f64::max).sqrt() * (1.0 + 4.0 * U);
        self.reach = self.reach.max(reach);
        if let (Some(first), Some(last)) = (run.first(), run.last()) {
            let closed = first.first() == last.last();
            let root = self.boxes.add(&self.pieces, from);
            let hull = self.boxes.hull(root);
            self.hull = if self.runs.is_empty() { hull } else { union(self.hull, hull) };
            self.runs.push(Run { from, to: self.pieces.len(), closed, root });
        }
    }

    /// Calls `look` with the boxes of a run, each with the range of its pieces, in order; descends into both halves
    /// where it returns `true`.
    #[inline(always)]
    pub fn descend(&self, run: &Run, look: impl FnMut(&Hull, Range<usize>) -> bool) {
        self.boxes.descend(run.root, look);
    }

    /// Returns the maximum of `a`·x + `b`·y over visible pieces; −∞ if there are none.
    pub fn greatest(&self, along: Point) -> f64 {
        let seen = self.pieces.iter().filter(|piece| piece.seen);
        seen.map(|piece| piece.greatest(along)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the bounding box.
    pub fn hull(&self) -> Hull {
        self.hull
    }

    /// Returns the maximum distance from the origin.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Returns whether a point lies inside: whether the ray from it along x crosses the outline an odd number
    /// of times.
    pub fn contains(&self, [x, y]: Point) -> bool {
        let above = |[_, end]: Point| end > y;
        let mut odd = false;
        for run in &self.runs {
            self.boxes.descend(run.root, |[low, high], row| {
                if above(*low) || !above(*high) || high[0] <= x {
                    return false;
                }
                let (first, last) = (&self.pieces[row.start], &self.pieces[row.end - 1]);
                if low[0] > x {
                    odd ^= above(first.first()) != above(last.last());
                    return false;
                }
                // Its control points may go on where it has turned back.
                if row.len() == 1 && above(first.first()) != above(first.last()) {
                    odd ^= first.at(first.meets(1, y)).0[0] > x;
                }
                row.len() > 1
            });
        }
        odd
    }

    /// Returns whether a point lies inside, for any displacement up to `error`; `None` if that is uncertain.
    pub fn is_inside(&self, place: Point, error: f64) -> Option<bool> {
        let mut is_told = true;
        self.near(place, error, |number| {
            is_told = is_told && self.pieces[number].is_clear(place, error);
        });
        is_told.then(|| self.contains(place))
    }

    /// Calls `found` with the indices of all pieces within `distance` of a point, and possibly a few more.
    pub fn near(&self, place: Point, distance: f64, mut found: impl FnMut(usize)) {
        for run in &self.runs {
            self.boxes.descend(run.root, |hull, row| {
                let is_near = !is_apart(hull, place, distance);
                if is_near && row.len() == 1 {
                    found(row.start);
                }
                is_near && row.len() > 1
            });
        }
    }

    /// Returns the index of the piece that a point is on, within `error`; `None` if it may be on another.
    pub fn piece_at(&self, place: Point, error: f64) -> Option<usize> {
        let mut found: SmallVec<[usize; 4]> = SmallVec::new();
        self.near(place, error, |number| found.push(number));
        if found.len() > 1 {
            found.retain(|number| {
                let ([x, y], _) = self.pieces[*number].nearest(place);
                let gap = [place[0] - x, place[1] - y];
                gap[0] * gap[0] + gap[1] * gap[1] <= 4.0 * error * error
            });
        }
        if let [number] = found[..] { Some(number) } else { None }
    }

    /// Returns a lower bound on the distance from a point.
    pub fn clearance(&self, place: Point) -> f64 {
        let all = self.pieces.iter().map(|piece| piece.clearance(place, 40));
        all.fold(f64::INFINITY, f64::min)
    }
}
