//! Intersects a line with a prism's walls where the sides of the outline's control points isolate all crossings:
//! nearly always.
//!
//! **Invariant:** what rounding may decide is left to [`walk`](super::walk).

use super::Prism;
use super::ruled::{Ruled, Walls};
use crate::math::roots::bracket::{Root, root};
use crate::shape::curve::{Piece, Side, WIDE, isolate, on_line};

/// Number of pieces that are looked at one by one: their boxes would cost as much. Affects only the running time.
const FEW: usize = 8;

impl Prism {
    /// Returns the crossings with the walls; `None` where rounding may decide. Those that are certainly not in a
    /// range have wide bounds.
    pub(super) fn isolated(
        &self,
        ruled: &Ruled,
        tolerance: f64,
        range: (f64, f64),
    ) -> Option<Walls> {
        let pieces = &self.outline.pieces;
        let walls = Walls::new();
        let mut search =
            Search { ruled, pieces, tolerance, range, walls, is_told: ruled.is_apart() };
        for run in &self.outline.runs {
            self.outline.descend(run, |hull, row| {
                if !search.is_told || ruled.of_box(hull).is_some() {
                    return false;
                }
                if row.len() > FEW {
                    return true;
                }
                row.for_each(|number| search.look_at(number));
                false
            });
        }
        search.is_told.then_some(search.walls)
    }
}

struct Search<'a> {
    ruled: &'a Ruled<'a>,
    pieces: &'a [Piece],
    tolerance: f64,
    range: (f64, f64),
    walls: Walls,
    /// Whether rounding decided nothing so far.
    is_told: bool,
}

impl Search<'_> {
    #[inline(always)]
    fn look_at(&mut self, number: usize) {
        let (piece, ruled) = (&self.pieces[number], self.ruled);
        if !piece.is_straight() {
            return self.look_at_curve(number);
        }
        let (first, last) = (ruled.roughly(piece.first()), ruled.roughly(piece.last()));
        let error = ruled.error();
        self.is_told &= first.abs() > error && last.abs() > error;
        if (first > 0.0) != (last > 0.0) && self.is_told {
            let start = first / (first - last);
            let root = on_line(start, ruled.sample(piece, start));
            self.note(number, root, 0.0, last > 0.0);
        }
    }

    fn look_at_curve(&mut self, number: usize) {
        let (piece, ruled) = (&self.pieces[number], self.ruled);
        let sides = piece.cubic_of(|point| ruled.roughly(point));
        let is_told = isolate(sides, 2.0 * ruled.error(), &mut |part| {
            if let Some(wall) = ruled.wall_beyond(number, piece, part, self.range) {
                self.walls.push(wall);
                return;
            }
            let tolerance = piece.share(self.tolerance);
            let sample = |u: f64| ruled.sample(piece, u);
            let root = root(sample, part.ends(), part.near_root(), tolerance);
            self.note(number, root, tolerance, part.rises());
        });
        self.is_told &= is_told;
    }

    #[inline(always)]
    fn note(&mut self, number: usize, root: Root, tolerance: f64, rising: bool) {
        let is_narrow = root.error <= WIDE + 2.0 * tolerance;
        match self.ruled.wall_at(number, &self.pieces[number], root, rising) {
            Some(wall) if is_narrow => self.walls.push(wall),
            _ => self.is_told = false,
        }
    }
}

#[cfg(test)]
impl Prism {
    /// Returns the crossings with the walls, as isolated and as walked: positions and errors in order.
    pub(in crate::shape) fn both_ways(
        &self,
        ray: &crate::shape::local::LocalRay,
    ) -> [Option<Vec<(f64, f64)>>; 2] {
        let ruled = Ruled::new(ray, self.conic);
        let isolated = self.isolated(&ruled, ray.tolerance, (f64::NEG_INFINITY, f64::INFINITY));
        [isolated, Some(self.walked(&ruled, ray.tolerance))].map(|walls| {
            let mut walls = walls?;
            walls.sort_by(|a, b| a.s.total_cmp(&b.s));
            Some(walls.iter().map(|wall| (wall.s, wall.error)).collect())
        })
    }
}
