//! Intersects a line with a lathe where Bézier coefficients along its pieces isolate all crossings: nearly always.
//!
//! **Invariant:** what rounding may decide is left to [`walk`](super::walk), and so are lines that are nearly level.

use smallvec::SmallVec;

use super::line::{Hyperbola, Line, Steep};
use super::{Lathe, Wall, Walls};
use crate::math::roots::bracket::{Root, root};
use crate::shape::curve::{Isolated, Piece, Side, WIDE, isolate};
use crate::shape::local::LocalRay;

/// Vertical speed below which a line's crossings are not found by height.
const LEVEL: f64 = 1.0 / 256.0;

/// Number of pieces that are looked at one by one. Affects only the running time.
const FEW: usize = 2;

/// What lines take from a piece, in Bézier coefficients of degree 6.
#[derive(Clone, Copy)]
pub(super) struct Squares {
    /// x² and y².
    pub out: [f64; 7],
    pub up: [f64; 7],
    /// y.
    pub height: [f64; 7],
    /// The coefficients of 1, u, u² and u³ of x and y.
    pub powers: [[f64; 4]; 2],
}

impl Squares {
    pub fn new(piece: &Piece) -> Self {
        let (x, y) = (piece.cubic(0), piece.cubic(1));
        Self {
            out: product(x, x),
            up: product(y, y),
            height: product(y, [1.0; 4]),
            powers: [piece.powers(0), piece.powers(1)],
        }
    }

    fn height_at(&self, u: f64) -> f64 {
        let [_, [a, b, c, d]] = self.powers;
        a + u * (b + u * (c + u * d))
    }
}

/// Returns the Bézier coefficients of the product of two cubics.
fn product(a: [f64; 4], b: [f64; 4]) -> [f64; 7] {
    const CUBIC: [f64; 4] = [1.0, 3.0, 3.0, 1.0];
    const SEXTIC: [f64; 7] = [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0];
    let mut product = [0.0; 7];
    for i in 0..4 {
        for j in 0..4 {
            product[i + j] += CUBIC[i] * CUBIC[j] / SEXTIC[i + j] * a[i] * b[j];
        }
    }
    product
}

/// An interval of a piece with one crossing.
struct Candidate {
    number: usize,
    /// Its ends, first that where the value is positive.
    ends: (f64, f64),
    /// About where the crossing is.
    near: f64,
    rises: bool,
    /// From where to where on the line the crossing may be.
    from: f64,
    to: f64,
}

/// Half of the width, on its piece, to which a crossing is narrowed before its place in the order is known. Affects
/// only the running time.
const NEAR: f64 = 1e-6;

impl Candidate {
    fn new(
        part: &Isolated<7>,
        number: usize,
        squares: &Squares,
        (line, hyperbola): (&Line, &Hyperbola),
    ) -> Self {
        let step = |u: f64| {
            let (value, slope) = hyperbola.at(squares, u);
            (u - value / slope).max(part.from).min(part.to)
        };
        let (near, rises) = (step(step(step(part.on_chord()))), part.rises());
        let (mut low, mut high) = ((near - NEAR).max(part.from), (near + NEAR).min(part.to));
        let way = if rises { 1.0 } else { -1.0 };
        let is_told = |u: f64, side: f64| side * way * hyperbola.at(squares, u).0 > hyperbola.error;
        if !is_told(low, -1.0) {
            low = part.from;
        }
        if !is_told(high, 1.0) {
            high = part.to;
        }
        let place = |u: f64| (squares.height_at(u) - line.start) / line.speed;
        let (first, last) = (place(low), place(high));
        let off = 4.0 * line.off / line.speed.abs();
        let (from, to) = (first.min(last) - off, first.max(last) + off);
        let ends = if rises { (high, low) } else { (low, high) };
        Self { number, ends, near, rises, from, to }
    }
}

impl Lathe {
    /// Returns the crossings, as [`Local::first_crossings`](super::Local::first_crossings) does; `None` where
    /// rounding may decide. Those that are certainly not in the range have wide bounds.
    pub(super) fn isolated(
        &self,
        line: &Line,
        ray: &LocalRay,
        (from, to): (f64, f64),
    ) -> Option<Walls> {
        let mut candidates = self.candidates(line)?;
        candidates.sort_by(|a, b| (a.from + a.to).total_cmp(&(b.from + b.to)));
        let ahead = ray.ahead_of(from);
        let mut walls = Walls::new();
        for (nth, candidate) in candidates.iter().enumerate() {
            let Candidate { number, rises, .. } = *candidate;
            let (low, high) = (candidate.from, candidate.to);
            let is_beyond = high < from || low > to;
            let (s, error) = match is_beyond {
                true => (0.5 * (low + high), 0.5 * (high - low)),
                false => self.crossing(line, candidate, ray.tolerance)?,
            };
            // The positive side is to the left of a line that goes up.
            let along = rises != (line.speed > 0.0);
            walls.push(Wall { s, error, piece: number, along, begins: 0.0 });
            let is_ahead = !is_beyond && s - error > ahead && self.outline.pieces[number].seen;
            if is_ahead && candidates[nth + 1..].iter().all(|other| other.from > s + error) {
                break;
            }
        }
        Some(walls)
    }

    fn candidates(&self, line: &Line) -> Option<SmallVec<[Candidate; 6]>> {
        if line.speed.abs() < LEVEL {
            return None;
        }
        let hyperbola = Hyperbola::new(line, self.outline.reach());
        let mut found = SmallVec::new();
        let mut is_told = true;
        for run in &self.outline.runs {
            self.outline.descend(run, |hull, row| {
                if !is_told || hyperbola.is_apart(hull) {
                    return false;
                }
                if row.len() > FEW {
                    return true;
                }
                for number in row {
                    let squares = &self.squares[number];
                    let coefficients = hyperbola.coefficients(squares);
                    is_told &= isolate(coefficients, hyperbola.error, &mut |part| {
                        found.push(Candidate::new(part, number, squares, (line, &hyperbola)));
                    });
                }
                false
            });
        }
        is_told.then_some(found)
    }

    /// Returns the crossing and its error; `None` if its bounds take much of the piece.
    fn crossing(&self, line: &Line, candidate: &Candidate, tolerance: f64) -> Option<(f64, f64)> {
        let piece = &self.outline.pieces[candidate.number];
        let (tolerance, steep) = (piece.share(tolerance), Steep(line));
        let sample = |u: f64| steep.sample(piece, u);
        let Root { t: u, error } = root(sample, candidate.ends, candidate.near, tolerance);
        let at = |u: f64| piece.at(u.clamp(0.0, 1.0)).0;
        (error <= WIDE + 2.0 * tolerance)
            .then(|| line.crossing(at(u), [at(u - error), at(u + error)]))
    }
}

#[cfg(test)]
impl Lathe {
    /// Returns the crossings, as isolated and as walked: positions and errors in order.
    pub(in crate::shape) fn both_ways(&self, ray: &LocalRay) -> [Option<Vec<(f64, f64)>>; 2] {
        let line = Line::new(ray);
        let isolated = self.isolated(&line, ray, (f64::NEG_INFINITY, f64::INFINITY));
        [isolated, Some(self.walked(line, ray))].map(|walls| {
            let mut walls = walls?;
            walls.sort_by(|a, b| a.s.total_cmp(&b.s));
            Some(walls.iter().map(|wall| (wall.s, wall.error)).collect())
        })
    }
}
