//! Where a curve goes from one side of something to the other.
//!
//! **In:** a run of pieces, and a function that says on which side a place of the plane certainly is.
//! **Out:** the changes, each between two places of opposite and certain sides. **Invariant:** a closed run
//! has an even number of them; what only touches, as far as rounding tells, has none.
//!
//! The joint of two pieces is no end of anything: a change may lie in several pieces at once.

use smallvec::SmallVec;

use super::{Outline, Piece, Point, Run};
use crate::math::roots::bracket::{Root, Sample, root};

/// What parts the plane in two.
pub trait Side {
    /// Positive on one side, negative on the other; its slope by u.
    fn sample(&self, piece: &Piece, u: f64) -> Sample;

    /// The side that all of a piece is certainly on.
    fn of_all(&self, piece: &Piece) -> Option<bool>;

    /// Where within a piece the value may turn.
    fn turns(&self, piece: &Piece) -> SmallVec<[f64; 8]>;
}

/// A stretch of an outline, measured in pieces from the begin of its run.
#[derive(Debug, Clone, Copy)]
pub struct Path<'a> {
    pieces: &'a [Piece],
    /// The number of the first of the run.
    first: usize,
    /// Its run has no end: counting goes on at its begin.
    cyclic: bool,
    /// It is all of such a run.
    closed: bool,
    from: f64,
    to: f64,
    /// The sides that its ends are taken to be on; a closed run has none.
    ends: [Option<bool>; 2],
}

impl<'a> Path<'a> {
    /// All of a run.
    pub fn whole(outline: &'a Outline, run: &Run, ends: Option<bool>) -> Self {
        let pieces = &outline.pieces[run.from..run.to];
        let ends = [ends.filter(|_| !run.closed); 2];
        let to = pieces.len() as f64;
        Self {
            pieces,
            first: run.from,
            cyclic: run.closed,
            closed: run.closed,
            from: 0.0,
            to,
            ends,
        }
    }

    /// What lies between two places of it.
    pub fn part(self, from: f64, to: f64, ends: [bool; 2]) -> Self {
        Self { closed: false, from, to, ends: ends.map(Some), ..self }
    }

    /// A piece, and where on it.
    fn locate(&self, v: f64) -> (usize, f64) {
        let count = self.pieces.len() as i64;
        let whole = v.floor();
        let number = whole as i64;
        if !self.cyclic && number >= count {
            return (count as usize - 1, 1.0);
        }
        (number.rem_euclid(count) as usize, v - whole)
    }

    pub fn at(&self, v: f64) -> (Point, Point) {
        let (piece, u) = self.locate(v);
        self.pieces[piece].at(u)
    }

    /// The number of the piece at a place.
    pub fn piece(&self, v: f64) -> usize {
        self.first + self.locate(v).0
    }
}

/// A change of sides.
#[derive(Debug, Clone, Copy)]
pub struct Change<'a> {
    pub path: Path<'a>,
    /// About where.
    pub v: f64,
    /// Between these, certainly.
    pub low: f64,
    pub high: f64,
    /// From the negative side to the positive.
    pub rising: bool,
}

impl Change<'_> {
    /// It may lie at the very end of its path.
    pub fn is_at_end(&self) -> bool {
        self.low <= self.path.from || self.high >= self.path.to
    }

    pub fn point(&self) -> Point {
        self.path.at(self.v).0
    }

    /// The ends of what it lies between, and the joints there.
    pub fn places(&self) -> impl Iterator<Item = Point> + '_ {
        let joints = (1..).map(|k| self.low.floor() + f64::from(k)).take_while(|v| *v < self.high);
        // No more than the run has.
        let joints = joints.take(self.path.pieces.len());
        [self.low, self.high].into_iter().chain(joints).map(|v| self.path.at(v).0)
    }
}

/// A place whose side is certain.
#[derive(Clone, Copy)]
struct Certain {
    v: f64,
    outside: bool,
}

/// All changes of sides along a path, in its order, each found no better than `tolerance` asks for.
pub fn walk<'a>(
    path: Path<'a>,
    side: &impl Side,
    tolerance: f64,
    mut found: impl FnMut(Change<'a>),
) {
    let sample = |v: f64| {
        let (piece, u) = path.locate(v);
        side.sample(&path.pieces[piece], u)
    };
    let change = |before: Certain, after: Certain| {
        let (outside, inside) =
            if before.outside { (before.v, after.v) } else { (after.v, before.v) };
        // Lengths along the piece in the middle, as parts of it.
        let [low, high] = path.pieces[path.locate(0.5 * (outside + inside)).0].hull();
        let size = (high[0] - low[0]).max(high[1] - low[1]);
        let tolerance = if tolerance > 0.0 { (tolerance / size).min(0.25) } else { 0.0 };
        let Root { t: v, error } = root(sample, (outside, inside), f64::NAN, tolerance);
        let (low, high) = ((v - error).max(before.v), (v + error).min(after.v));
        Change { path, v, low, high, rising: after.outside }
    };
    let (mut first, mut last): (Option<Certain>, Option<Certain>) = (None, None);
    let mut advance = |here: Certain| {
        first.get_or_insert(here);
        if let Some(before) = last.replace(here)
            && before.outside != here.outside
        {
            found(change(before, here));
        }
    };
    let certain = |v: f64, sample: Sample| {
        let told = sample.is_outside() || sample.is_inside();
        told.then_some(Certain { v, outside: sample.value > 0.0 })
    };
    if let Some(outside) = path.ends[0] {
        advance(Certain { v: path.from, outside });
    }
    for number in path.from.floor() as usize..path.to.ceil() as usize {
        let (start, piece) = (number as f64, &path.pieces[number % path.pieces.len()]);
        let (low, high) = (start.max(path.from), (start + 1.0).min(path.to));
        if let Some(outside) = side.of_all(piece) {
            advance(Certain { v: low, outside });
            advance(Certain { v: high, outside });
            continue;
        }
        certain(low, sample(low)).into_iter().for_each(&mut advance);
        let turns = side.turns(piece);
        if !(turns.is_empty() && piece.is_straight()) {
            let mut before = low;
            for v in turns.into_iter().map(|u| start + u).chain([high]) {
                // Also between them, for where they tell nothing.
                for v in [0.5 * (before + v), v] {
                    if v > low && v < high {
                        certain(v, sample(v)).into_iter().for_each(&mut advance);
                    }
                }
                before = v;
            }
        }
        // The end of the piece, as this piece has it.
        let end = side.sample(piece, high - start);
        certain(high, end).into_iter().for_each(&mut advance);
    }
    if let Some(outside) = path.ends[1] {
        advance(Certain { v: path.to, outside });
    }
    if let (true, Some(first), Some(last)) = (path.closed, first, last)
        && first.outside != last.outside
    {
        let again = Certain { v: first.v + path.pieces.len() as f64, ..first };
        found(change(last, again));
    }
}
