//! Convex wholes: what several solids share that a line enters once and leaves once.
//!
//! It is in all of them from the last that it enters to the first that it leaves.
//!
//! **Invariant:** what is told is what the algebra of `shape/csg.rs` keeps, but for what is seen of nobody: where
//! error bounds do not tell the two ends from all others, nothing is.
//!
//! **Source:** M. Cyrus, J. Beck, "Generalized two- and three-dimensional clipping", Computers & Graphics 3 (1978).

use super::span::Around;
use super::whole::Whole;
use super::whole::together::Line;
use super::{Geometry, Solid};
use crate::shape::Chord;
use crate::shape::csg::{Event, Events};
use crate::shape::local::Met;

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
        if place > self.place {
            self.others = self.others.max(self.place + self.error);
            (self.place, self.error, self.leaf) = (place, met.error, leaf);
            (self.part, self.leaving) = (met.part, met.leaving);
        } else {
            self.others = self.others.max(place + met.error);
        }
    }

    /// Whether it is told from the others.
    fn is_told(&self) -> bool {
        self.place == f64::NEG_INFINITY || self.others < self.place - self.error
    }

    /// As a crossing with the whole, at so many times its place; `None` of what is at no place.
    fn event(&self, side: f64) -> Option<Event> {
        let Self { place, error, leaf, part, leaving, .. } = *self;
        let met = Met { t: side * place + 0.0, error, leaving, part };
        let event = Event { met, leaf, sheet: false, last: None, shared: false };
        place.is_finite().then_some(event)
    }
}

/// Where a line is in a solid, or outside of it.
enum Inside {
    Nowhere,
    /// From one place to another; `None` where that is at no end.
    Once([Option<Met>; 2]),
    /// In several stretches.
    Often,
}

impl Geometry {
    /// Adds the crossings with a convex whole; `false` where they are not told so.
    pub(super) fn gather_convex(&self, whole: &Whole, line: &Line, events: &mut Events) -> bool {
        let (mut enter, mut leave) = (Last::new(), Last::new());
        for around in &whole.around {
            let solid = &whole.leaves[around.leaf as usize].solid;
            let [first, last] = match self.inside(solid, around, line) {
                Inside::Nowhere => return true,
                Inside::Once(ends) => ends,
                Inside::Often => return false,
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
        let is_told = is_thick && enter.is_told() && leave.is_told();
        if is_told {
            events.extend([enter.event(1.0), leave.event(-1.0)].into_iter().flatten());
        }
        is_told
    }

    #[inline(always)]
    fn inside(&self, solid: &Solid, around: &Around, line: &Line) -> Inside {
        if let Solid::Placed(_) = solid {
            return self.inside_body(around.leaf, solid, line);
        }
        let met =
            |t: f64, error, leaving| t.is_finite().then_some(Met { t, error, leaving, part: 0 });
        match (self.chord_of_leaf(around.leaf, solid, line), around.inverse) {
            (None, false) => Inside::Nowhere,
            (None, true) => Inside::Once([None, None]),
            (Some(Chord { enter, leave }), inverse) => {
                let ends = [met(enter.t, enter.error, false), met(leave.t, leave.error, true)];
                match (inverse, ends) {
                    (false, ends) => Inside::Once(ends),
                    (true, [None, None]) => Inside::Nowhere,
                    (true, [Some(enter), None]) => Inside::Once([None, Some(enter)]),
                    (true, [None, Some(leave)]) => Inside::Once([Some(leave), None]),
                    (true, [Some(_), Some(_)]) => Inside::Often,
                }
            }
        }
    }

    #[inline(never)]
    fn inside_body(&self, leaf: u32, solid: &Solid, line: &Line) -> Inside {
        let finite = |met: &Met| met.t.is_finite().then_some(*met);
        match self.crossings_of_leaf(leaf, solid, line).as_slice() {
            [] => Inside::Nowhere,
            [enter] if !enter.leaving => Inside::Once([finite(enter), None]),
            [enter, leave] if !enter.leaving && leave.leaving => {
                Inside::Once([finite(enter), finite(leave)])
            }
            _ => Inside::Often,
        }
    }
}
