//! The sweep along a line over the events of a CSG solid, from position to position.
//!
//! **Invariant:** events that their error bounds cannot separate share one position, and no leaf is crossed
//! twice in one.

use smallvec::SmallVec;

use super::{Change, Event, Events, Tree};

impl Tree {
    /// Retains the crossings with the combined solid among `events`, which are in order.
    pub fn keep(&self, events: &mut Events) {
        let mut sweep = Sweep::new(self);
        let mut kept = 0;
        while let Some(event) = sweep.next(events) {
            events[kept] = event;
            kept += 1;
        }
        events.truncate(kept);
    }

    /// Returns the first crossing with the combined solid that `accepts` does, of `events`, which are in
    /// order.
    pub fn first(&self, events: &mut [Event], accepts: impl Fn(&Event) -> bool) -> Option<Event> {
        let mut sweep = Sweep::new(self);
        loop {
            let event = sweep.next(events)?;
            if accepts(&event) {
                return Some(event);
            }
        }
    }
}

/// A position on the line that moves from its start to its end.
struct Sweep<'a> {
    tree: &'a Tree,
    /// For each operation, the weight of the operands that the line is inside of.
    counts: SmallVec<[u32; 16]>,
    /// Scratch.
    changes: SmallVec<[Change; 8]>,
    /// Index of the first event ahead.
    ahead: usize,
}

impl<'a> Sweep<'a> {
    fn new(tree: &'a Tree) -> Self {
        let counts = SmallVec::from_slice(&tree.outside);
        Self { tree, counts, changes: SmallVec::new(), ahead: 0 }
    }

    /// Moves to the next crossing with the combined solid.
    fn next(&mut self, events: &mut [Event]) -> Option<Event> {
        while self.ahead < events.len() {
            let first = self.ahead;
            let mut end = end_of_place(events, first);
            if events.get(end).is_some_and(|next| next.crosses_again_since(&events[first])) {
                end = gather_place(events, first, end);
            }
            self.ahead = end;
            let shown = self.tree.pass(&mut self.counts, events, first..end, &mut self.changes);
            if let Some(shown) = shown {
                return Some(Event { shared: end - first > 1, ..events[shown] });
            }
        }
        None
    }
}

/// Returns the end of the run of events that cannot be separated from one another. No leaf occurs twice in
/// it: that would be a solid thinner than the error bounds, which nevertheless exists.
fn end_of_place(events: &[Event], first: usize) -> usize {
    let start = &events[first];
    let mut limit = start.met.t + start.met.error;
    let mut end = first + 1;
    while let Some(next) = events.get(end) {
        let apart = next.met.t - next.met.error > limit;
        if apart || next.crosses_again_since(start) {
            break;
        }
        limit = limit.max(next.met.t + next.met.error);
        end += 1;
    }
    end
}

/// Moves events that cross a leaf of the run again behind it, and other events that cannot be separated from
/// the run into it. For example, if a line grazes the shared edge of two boxes, it enters both before it
/// leaves either. Returns the new end.
#[cold]
fn gather_place(events: &mut [Event], first: usize, mut end: usize) -> usize {
    let start = events[first];
    let limit = |event: &Event| event.met.t + event.met.error;
    let mut most = events[first..end].iter().map(limit).fold(f64::NEG_INFINITY, f64::max);
    let mut at = end;
    while let Some(&next) = events.get(at)
        && next.met.t - next.met.error <= most
    {
        if !next.crosses_again_since(&start) {
            most = most.max(limit(&next));
            events[end..=at].rotate_right(1);
            end += 1;
        }
        at += 1;
    }
    // What is crossed again behind the place is crossed for the first time since then.
    for leaf in first..end {
        let leaf = events[leaf].leaf;
        if let Some(again) = events[end..at].iter_mut().find(|event| event.leaf == leaf) {
            again.last = None;
        }
    }
    end
}
