//! Finds where a curve changes from one side of something to the other.
//!
//! **In:** a run of pieces, and a function that decides on which side a point of the plane certainly is.
//! **Out:** the changes, each between two points that are certainly on opposite sides. **Invariant:** a
//! closed run has an even number of changes; a curve that only touches, within rounding, has none.
//!
//! The joint of two pieces is not a boundary: a change may span several pieces.

use smallvec::SmallVec;

use super::boxes::{Boxes, Hull};
use super::{Outline, Piece, Point, Run};
use crate::math::roots::bracket::{Root, Sample, root};
use crate::shape::U;

/// What is known of the sides along a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Course {
    /// All of it is certainly on one side.
    Side(bool),
    /// The value has at most one root.
    OneRoot,
    Unknown,
}

/// A division of the plane into two sides.
pub trait Side {
    /// Returns the value, positive on one side and negative on the other, with its slope by u.
    fn sample(&self, piece: &Piece, u: f64) -> Sample;

    /// Returns the side that a box is certainly on entirely.
    fn of_box(&self, hull: &Hull) -> Option<bool>;

    /// Returns what is known of an entire piece, where its box is inconclusive.
    fn course(&self, piece: &Piece) -> Course;

    /// Whether the value is linear along a straight piece.
    const IS_LINEAR: bool = false;

    /// Called when rounding hides the side of both ends of a straight piece.
    fn holds(&self, _piece: &Piece) {}

    /// Returns where the value may have extrema within a piece.
    fn turns(&self, piece: &Piece) -> SmallVec<[f64; 8]>;
}

/// A section of an outline; positions count pieces from the start of its run.
#[derive(Debug, Clone, Copy)]
pub struct Path<'a> {
    pieces: &'a [Piece],
    boxes: &'a Boxes,
    /// Index of its root box.
    root: usize,
    /// Index of the first piece of its run.
    first: usize,
    /// Whether its run is closed: positions continue at its start.
    cyclic: bool,
    /// Whether it is all of a closed run.
    closed: bool,
    from: f64,
    to: f64,
    /// The sides assumed for its ends; `None` for a closed run.
    ends: [Option<bool>; 2],
}

impl<'a> Path<'a> {
    /// Returns the path of an entire run.
    pub fn whole(outline: &'a Outline, run: &Run, ends: Option<bool>) -> Self {
        let pieces = &outline.pieces[run.from..run.to];
        let ends = [ends.filter(|_| !run.closed); 2];
        let to = pieces.len() as f64;
        Self {
            pieces,
            boxes: &outline.boxes,
            root: run.root,
            first: run.from,
            cyclic: run.closed,
            closed: run.closed,
            from: 0.0,
            to,
            ends,
        }
    }

    /// Returns the section between two positions.
    pub fn part(self, from: f64, to: f64, ends: [bool; 2]) -> Self {
        Self { closed: false, from, to, ends: ends.map(Some), ..self }
    }

    /// Returns a piece, and the position on it.
    fn locate(&self, v: f64) -> (usize, f64) {
        let count = self.pieces.len();
        let number = v as usize;
        if number < count {
            return (number, v - number as f64);
        }
        if self.cyclic { (number % count, v - number as f64) } else { (count - 1, 1.0) }
    }

    pub fn at(&self, v: f64) -> (Point, Point) {
        let (piece, u) = self.locate(v);
        self.pieces[piece].at(u)
    }

    /// Calls `look` with its boxes in order, each with its start and end position; descends into both halves
    /// where it returns `true`. A path that continues at its run's start visits that again.
    #[inline(always)]
    fn rows(&self, mut look: impl FnMut(&Hull, f64, f64) -> bool) {
        let count = self.pieces.len() as f64;
        let mut turn = 0.0;
        while turn < self.to {
            self.boxes.descend(self.root, |hull, row| {
                let [from, to] = [row.start, row.end].map(|i| turn + (i - self.first) as f64);
                to > self.from && from < self.to && look(hull, from, to)
            });
            turn += count;
        }
    }

    /// Returns the index of the piece at a position.
    pub fn piece(&self, v: f64) -> usize {
        self.first + self.locate(v).0
    }
}

/// A change of sides.
#[derive(Debug, Clone, Copy)]
pub struct Change<'a> {
    pub path: Path<'a>,
    /// Approximate position.
    pub v: f64,
    /// Index of the crossed piece; at a joint, of the piece that the line crosses more steeply.
    pub piece: usize,
    /// The change certainly lies between `low` and `high`.
    pub low: f64,
    pub high: f64,
    /// Whether it goes from the negative side to the positive.
    pub rising: bool,
}

impl Change<'_> {
    /// Returns whether it may lie at an end of its path; closed paths have no ends.
    pub fn is_at_end(&self) -> bool {
        !self.path.closed && (self.low <= self.path.from || self.high >= self.path.to)
    }

    pub fn point(&self) -> Point {
        self.path.at(self.v).0
    }

    /// Returns the points at `low`, at `high`, and at the joints between them.
    pub fn places(&self) -> impl Iterator<Item = Point> + '_ {
        let joints = (1..).map(|k| self.low.floor() + f64::from(k)).take_while(|v| *v < self.high);
        // No more than the run has.
        let joints = joints.take(self.path.pieces.len());
        [self.low, self.high].into_iter().chain(joints).map(|v| self.path.at(v).0)
    }
}

/// A position whose side is certain.
#[derive(Clone, Copy)]
struct Certain {
    v: f64,
    outside: bool,
    /// The value there, if it was evaluated.
    value: f64,
}

impl Certain {
    fn new(v: f64, outside: bool) -> Self {
        Self { v, outside, value: f64::NAN }
    }
}

/// Returns the root of a linear function, with the error of [`root`]: at twice the error from the root, the
/// side is certain.
pub fn on_line(v: f64, Sample { slope, error, .. }: Sample) -> Root {
    let least = (2.0 * error / slope.abs()).max(4.0 * U * v);
    Root { t: v, error: least + 2.0 * U * v }
}

/// Error, as a fraction of a piece, above which the bounds of a change are refined, as it may span all of the
/// next piece if that is of another size. Affects only the running time.
pub const WIDE: f64 = 1.0 / 64.0;

/// Bisects from a position with a certain side toward another; returns about the last position with a certain
/// side.
fn nearest_told(sample: impl Fn(f64) -> Sample, told: f64, other: f64, outside: bool) -> f64 {
    let (mut told, mut near) = (told, other);
    for _ in 0..f64::MANTISSA_DIGITS {
        let middle = 0.5 * (told + near);
        let here = sample(middle);
        let is_told = if outside { here.is_outside() } else { here.is_inside() };
        *if is_told { &mut told } else { &mut near } = middle;
    }
    told
}

/// At the joint nearest to a change, if the change may lie there: returns the joint and the adjacent piece,
/// if that piece is visible and is crossed in the same direction and more steeply. A line that touches a wall
/// has no definite crossing with it, but has one with the adjacent wall.
#[cold]
fn steeper<S: Side>(path: &Path, side: &S, change: &Change) -> Option<(f64, usize)> {
    let Change { v, low, high, rising, .. } = *change;
    let is_within = |joint: &f64| low < *joint && *joint < high;
    let joints = [v.floor(), v.floor() + 1.0].into_iter().filter(is_within);
    let joint = joints.min_by(|a, b| (a - v).abs().total_cmp(&(b - v).abs()))?;
    let count = path.pieces.len();
    let after = path.locate(joint).0;
    let before = (after + count - 1) % count;
    let steepness = |number: usize, u: f64| {
        let piece = &path.pieces[number];
        let [x, y] = piece.at(u).1;
        let slope = side.sample(piece, u).slope / (x * x + y * y).sqrt();
        if rising { slope } else { -slope }
    };
    let [own, other] =
        [(after, 0.0), (before, 1.0)].map(|(number, u)| (number, steepness(number, u)));
    let [own, other] = if path.locate(v).0 == after { [own, other] } else { [other, own] };
    let is_better = path.pieces[other.0].seen && other.1 > own.1.max(0.0);
    is_better.then_some((joint, path.first + other.0))
}

/// Finds all changes of sides along a path, in order, with an accuracy limited by `tolerance`.
pub fn walk<'a, S: Side>(
    path: Path<'a>,
    side: &S,
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
        // As a part of the piece in the middle.
        let tolerance = path.pieces[path.locate(0.5 * (outside + inside)).0].share(tolerance);
        // As if it were straight between them.
        let share = before.value / (before.value - after.value);
        let start = before.v + share * (after.v - before.v);
        let piece = &path.pieces[path.locate(before.v).0];
        let is_linear =
            S::IS_LINEAR && piece.is_straight() && after.v - before.v <= 1.0 && start.is_finite();
        let line = is_linear.then(|| on_line(start, sample(start)));
        let Root { t: v, error } = line
            .filter(|root| root.error.is_finite())
            .unwrap_or_else(|| root(sample, (outside, inside), start, tolerance));
        let (mut low, mut high) = ((v - error).max(before.v), (v + error).min(after.v));
        if error > WIDE + 2.0 * tolerance {
            low = nearest_told(sample, low, v, before.outside);
            high = nearest_told(sample, high, v, after.outside);
        }
        let change = Change { path, v, piece: path.piece(v), low, high, rising: after.outside };
        if low.floor() + 1.0 < high
            && let Some((v, piece)) = steeper(&path, side, &change)
        {
            return Change { v, piece, ..change };
        }
        change
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
    let is_told = |sample: &Sample| sample.is_outside() || sample.is_inside();
    let certain = |v: f64, sample: Sample| {
        let Sample { value, .. } = sample;
        is_told(&sample).then_some(Certain { v, outside: value > 0.0, value })
    };
    if let Some(outside) = path.ends[0] {
        advance(Certain::new(path.from, outside));
    }
    path.rows(|hull, from, to| {
        let (low, high) = (from.max(path.from), to.min(path.to));
        if let Some(outside) = side.of_box(hull) {
            advance(Certain::new(low, outside));
            advance(Certain::new(high, outside));
            return false;
        }
        if to - from > 1.0 {
            return true;
        }
        let piece = &path.pieces[from as usize % path.pieces.len()];
        let is_linear = S::IS_LINEAR && piece.is_straight();
        let course = if is_linear { Course::OneRoot } else { side.course(piece) };
        if let Course::Side(outside) = course {
            advance(Certain::new(low, outside));
            advance(Certain::new(high, outside));
            return false;
        }
        // The end of the piece, as this piece has it.
        let ends = [sample(low), side.sample(piece, high - from)];
        certain(low, ends[0]).into_iter().for_each(&mut advance);
        if is_linear && !ends.iter().any(is_told) {
            side.holds(piece);
        }
        // What has one root at most, the ends tell if they are told.
        let is_known = is_linear || (ends.iter().all(is_told) && course == Course::OneRoot);
        if !is_known {
            let mut before = low;
            for v in side.turns(piece).into_iter().map(|u| from + u).chain([high]) {
                // Also between them, for where they tell nothing.
                for v in [0.5 * (before + v), v] {
                    if v > low && v < high {
                        certain(v, sample(v)).into_iter().for_each(&mut advance);
                    }
                }
                before = v;
            }
        }
        certain(high, ends[1]).into_iter().for_each(&mut advance);
        false
    });
    if let Some(outside) = path.ends[1] {
        advance(Certain::new(path.to, outside));
    }
    if let (true, Some(first), Some(last)) = (path.closed, first, last)
        && first.outside != last.outside
    {
        let again = Certain { v: first.v + path.pieces.len() as f64, ..first };
        found(change(last, again));
    }
}
