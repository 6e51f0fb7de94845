//! Intersections of solids, some of them inverse: where a line enters and leaves them, without the algebra.
//!
//! A line is in all solids that it enters once and leaves once from the last that it enters to the first that it
//! leaves. From this stretch the inverse ones cut holes, which are passed in order.
//!
//! **Invariant:** reports the visible crossings that the algebra of `shape/csg.rs` keeps, or none at all if error bounds
//! cannot separate a kept crossing from the others.
//!
//! **Source:** M. Cyrus, J. Beck, "Generalized two- and three-dimensional clipping", Computers & Graphics 3 (1978).

use super::span::{Around, Span};
use super::whole::together::{Line, Near};
use super::whole::{Whole, ends_of_chord};
use super::{Geometry, Solid};
use crate::shape::csg::{Event, Events};
use crate::shape::local::{Crossings, Met};
use crate::shape::{Chord, Crossing};
use smallvec::SmallVec;

/// The last of some places along a line.
struct Last {
    /// ±t of the place, and its error.
    place: f64,
    error: f64,
    /// Whose it is, which part of it, and whether the line leaves it there.
    leaf: u32,
    part: u32,
    leaving: bool,
    /// How far the others may reach.
    others: f64,
}

impl Last {
    fn new() -> Self {
        let place = f64::NEG_INFINITY;
        Self { place, error: 0.0, leaf: 0, part: Met::UNSEEN, leaving: false, others: place }
    }

    #[inline(always)]
    fn add(&mut self, place: f64, met: &Met, leaf: u32) {
        // `max` would drop a NaN.
        let error = if met.error.is_nan() { f64::INFINITY } else { met.error };
        if place > self.place {
            self.others = self.others.max(self.place + self.error);
            (self.place, self.error, self.leaf) = (place, error, leaf);
            (self.part, self.leaving) = (met.part, met.leaving);
        } else {
            self.others = self.others.max(place + error);
        }
    }

    /// Returns whether error bounds separate it from the others.
    fn is_told(&self) -> bool {
        self.place == f64::NEG_INFINITY || self.others < self.place - self.error
    }

    /// Returns it as a crossing; `side` is 1 where the line enters, −1 where it leaves.
    fn end(&self, side: f64) -> End {
        let Self { place, error, leaf, part, leaving, .. } = *self;
        End { met: Met { t: side * place, error, leaving, part }, leaf }
    }
}

/// A crossing with a leaf; at ±∞ where a stretch has no end.
#[derive(Clone, Copy)]
struct End {
    met: Met,
    leaf: u32,
}

impl End {
    /// Whether it comes before another; `None` where error bounds do not tell.
    #[inline(always)]
    fn is_before(&self, other: &Self) -> Option<bool> {
        let (a, b) = (&self.met, &other.met);
        let is_before = a.t + a.error < b.t - b.error;
        (is_before || b.t + b.error < a.t - a.error).then_some(is_before)
    }

    /// Returns it as a crossing with the whole that shares its position with no other; `None` at ±∞.
    fn event(self) -> Option<Event> {
        let Self { met, leaf } = self;
        // 0 and −0 are one place.
        let met = Met { t: met.t + 0.0, ..met };
        let event = Event { met, leaf, sheet: false, last: None, shared: false };
        met.t.is_finite().then_some(event)
    }
}

/// A part of the line, from where it begins to where it ends.
type Stretch = [End; 2];

/// The stretches that inverse solids cut out, and the gaps between those in which the line is in another.
type Holes = SmallVec<[Stretch; 4]>;

/// Where a line is in a solid, or outside of it.
enum Inside {
    Nowhere,
    /// From the first place to the last, apart from gaps; `None` where there is no end.
    Between([Option<Met>; 2]),
    /// Not known.
    Untold,
}

impl Geometry {
    /// Adds, in order, the crossings with an intersection of solids, at least those that lie `between` two positions;
    /// `near` are the leaves that the line may meet. Returns `false` if error bounds cannot separate the crossings.
    pub(super) fn gather_intersection(
        &self,
        whole: &Whole,
        line: &Line,
        near: Near,
        between: (f64, f64),
        events: &mut Events,
    ) -> bool {
        let (mut enter, mut leave) = (Last::new(), Last::new());
        let mut holes = Holes::new();
        for around in &whole.around {
            let solid = &whole.leaves[around.leaf as usize].solid;
            let [first, last] = match self.inside(solid, around, line, &mut holes) {
                Inside::Nowhere => return true,
                Inside::Between(ends) => ends,
                Inside::Untold => return false,
            };
            if let Some(met) = first {
                enter.add(met.t, &met, around.leaf);
            }
            if let Some(met) = last {
                leave.add(-met.t, &met, around.leaf);
            }
            // Certainly left before it is entered.
            if enter.place - enter.error > leave.error - leave.place {
                return true;
            }
        }
        let is_thick = enter.place + enter.error < -leave.place - leave.error;
        if !(is_thick && enter.is_told() && leave.is_told()) {
            return false;
        }
        let (low, high) = between;
        if enter.place - enter.error > high || leave.error - leave.place < low {
            return true;
        }
        let stretch = [enter.end(1.0), leave.end(-1.0)];
        if whole.is_convex && holes.is_empty() {
            events.extend(stretch.into_iter().filter_map(End::event));
            return true;
        }
        let is_told = self.add_all_holes(whole, line, near, &stretch, &mut holes)
            && cut(stretch, &mut holes, events).is_some();
        if !is_told {
            events.clear();
        }
        is_told
    }

    /// Adds where a line is in the inverse leaves within a stretch; `false` if error bounds cannot tell.
    #[inline(always)]
    fn add_all_holes(
        &self,
        whole: &Whole,
        line: &Line,
        near: Near,
        stretch: &Stretch,
        holes: &mut Holes,
    ) -> bool {
        let mut is_told = true;
        let [enter, leave] = stretch.map(|end| end.met.crossing());
        whole.search_within(line.ray, Span { enter, leave }.reach(), |leaf| {
            if is_told && !whole.is_around[leaf as usize] && near.has(leaf) {
                let solid = &whole.leaves[leaf as usize].solid;
                is_told = self.add_holes(leaf, solid, line, stretch, holes).is_some();
            }
        });
        is_told
    }

    #[inline(always)]
    fn add_holes(
        &self,
        leaf: u32,
        solid: &Solid,
        line: &Line,
        stretch: &Stretch,
        holes: &mut Holes,
    ) -> Option<()> {
        if let Solid::Placed(_) = solid {
            return self.add_holes_of_body(leaf, solid, line, stretch, holes);
        }
        match self.chord_of_leaf(leaf, solid, line) {
            Some(chord) => {
                add_hole(ends_of_chord(chord).map(|met| End { met, leaf }), stretch, holes)
            }
            None => Some(()),
        }
    }

    #[inline(never)]
    fn add_holes_of_body(
        &self,
        leaf: u32,
        solid: &Solid,
        line: &Line,
        stretch: &Stretch,
        holes: &mut Holes,
    ) -> Option<()> {
        let mut all = Crossings::new();
        self.add_crossings_of_leaf(leaf, solid, line, &mut all);
        for ends in all.chunks(2) {
            let [enter, leave] = match *ends {
                [enter, leave] => [enter, leave],
                // It has no end.
                [enter] => [enter, Met::of(Crossing::BEYOND_ALL, true)],
                _ => return None,
            };
            if enter.leaving || !leave.leaving {
                return None;
            }
            add_hole([enter, leave].map(|met| End { met, leaf }), stretch, holes)?;
        }
        Some(())
    }

    #[inline(always)]
    fn inside(&self, solid: &Solid, around: &Around, line: &Line, gaps: &mut Holes) -> Inside {
        if let Solid::Placed(_) = solid {
            return self.inside_body(around.leaf, solid, line, gaps);
        }
        let met =
            |t: f64, error, leaving| t.is_finite().then_some(Met { t, error, leaving, part: 0 });
        match (self.chord_of_leaf(around.leaf, solid, line), around.inverse) {
            (None, false) => Inside::Nowhere,
            (None, true) => Inside::Between([None, None]),
            (Some(Chord { enter, leave }), inverse) => {
                let ends = [met(enter.t, enter.error, false), met(leave.t, leave.error, true)];
                match (inverse, ends) {
                    (false, ends) => Inside::Between(ends),
                    (true, [None, None]) => Inside::Nowhere,
                    (true, [Some(enter), None]) => Inside::Between([None, Some(enter)]),
                    (true, [None, Some(leave)]) => Inside::Between([Some(leave), None]),
                    (true, [Some(_), Some(_)]) => Inside::Untold,
                }
            }
        }
    }

    #[inline(never)]
    fn inside_body(&self, leaf: u32, solid: &Solid, line: &Line, gaps: &mut Holes) -> Inside {
        let mut all = Crossings::new();
        self.add_crossings_of_leaf(leaf, solid, line, &mut all);
        let [first, .., last] = all.as_slice() else {
            return match all.first() {
                None => Inside::Nowhere,
                Some(only) if !only.leaving => Inside::Between([finite(only), None]),
                Some(_) => Inside::Untold,
            };
        };
        if all.iter().enumerate().any(|(nth, met)| met.leaving != (nth % 2 == 1)) {
            return Inside::Untold;
        }
        let pairs = all[1..].chunks_exact(2);
        gaps.extend(pairs.map(|gap| [gap[0], gap[1]].map(|met| End { met, leaf })));
        Inside::Between([finite(first), if last.leaving { finite(last) } else { None }])
    }
}

fn finite(met: &Met) -> Option<Met> {
    met.t.is_finite().then_some(*met)
}

/// Adds a hole, unless it is certainly beside the stretch; `None` if error bounds cannot tell whether it is there.
#[inline(always)]
fn add_hole(hole: Stretch, stretch: &Stretch, holes: &mut Holes) -> Option<()> {
    let is_before = |a: &End, b: &End| a.is_before(b) == Some(true);
    let [enter, leave] = &hole;
    if is_before(leave, &stretch[0]) || is_before(&stretch[1], enter) {
        return Some(());
    }
    is_before(enter, leave).then(|| holes.push(hole))
}

/// Adds the ends of the parts of a stretch outside all holes; `None` if error bounds cannot separate them from others.
#[inline(always)]
fn cut([enter, leave]: Stretch, holes: &mut Holes, events: &mut Events) -> Option<()> {
    holes.sort_unstable_by(|a, b| a[0].met.t.total_cmp(&b[0].met.t));
    // The line up to `at` is decided; it last left the whole at `left`.
    let (mut at, mut left) = (enter, None::<End>);
    for &mut [begin, end] in holes {
        if at.is_before(&begin)? {
            if begin.is_before(&leave)? {
                events.extend(at.event());
                events.extend(begin.event());
                (at, left) = (end, Some(begin));
            }
            continue;
        }
        if left.is_some_and(|left| left.is_before(&begin) != Some(true)) {
            return None;
        }
        if at.is_before(&end)? {
            at = end;
        }
    }
    if at.is_before(&leave)? {
        events.extend(at.event());
        events.extend(leave.event());
    }
    Some(())
}
