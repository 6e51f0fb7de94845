//! Constructive solid geometry: selects the crossings of the parts that are crossings of the combined solid.
//!
//! **In:** a tree of operations in postfix order, the crossings of a line with each leaf. **Out:** the
//! crossings that are kept, in order. **Invariant:** the operations evaluate inside and outside before and
//! after each position on the line. Crossings that their error bounds cannot separate share one position, so
//! coincident faces leave no thin remainder: A − A is empty, and a hole whose ends lie in the faces is open
//! (regularised set operations). No recursion.
//!
//! **Source:** A. Requicha, "Representations for rigid solids: theory, methods, and systems", ACM Computing
//! Surveys 12 (1980); S. Roth, "Ray casting for modeling solids", Computer Graphics and Image Processing 18
//! (1982).

mod sweep;

use std::ops::Range;

use smallvec::SmallVec;

use super::local::Met;

/// A node of the tree; its operands precede it. Without operands, a union is empty and an intersection is all
/// of space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Node {
    /// The next leaf; its complement if `inverse`.
    Leaf { inverse: bool },
    /// The union of this many nodes with all their surfaces, including interior walls.
    Union(u32),
    /// The union of this many nodes without interior walls.
    Merge(u32),
    /// The intersection of this many nodes.
    Intersection(u32),
    /// The surface of the first node, clipped to the second; `inverse` if the first node is the complement of
    /// the solid.
    Clip { inverse: bool },
}

/// A crossing with one of the leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// The crossing; a line that comes from inside the leaf enters it at −∞.
    pub met: Met,
    /// Index of the leaf, in the order of the nodes.
    pub leaf: u32,
    /// Whether the leaf is a sheet, which has no inside.
    pub sheet: bool,
    /// Where the same leaf was crossed before; `None` if it was not.
    pub last: Option<f64>,
    /// Whether another crossing shares this position; set on the events that are kept.
    pub shared: bool,
}

impl Event {
    /// Whether its leaf was already crossed at or after `start`.
    fn crosses_again_since(&self, start: &Self) -> bool {
        self.last.is_some_and(|last| (last, self.leaf) >= (start.met.t, start.leaf))
    }
}

/// Events in order.
pub type Events = SmallVec<[Event; 8]>;

/// The state of a node at one position on the line.
#[derive(Debug, Clone, Copy)]
struct State {
    /// Whether the line is inside just before the position.
    before: bool,
    /// Whether the line is inside just after it.
    after: bool,
    /// The event that provides the node's surface here: whether it is invisible (which hides no visible one),
    /// its leaf, and its index in the list.
    shown: Option<(bool, u32, usize)>,
}

impl State {
    fn changes(self) -> bool {
        self.before != self.after
    }

    fn touches(self) -> bool {
        self.before || self.after
    }

    fn stays(self) -> bool {
        self.before && self.after
    }

    /// Whether it may affect the operation that it is an operand of.
    fn counts(self) -> bool {
        self.changes() || self.shown.is_some()
    }
}

/// The nodes, each with a link to its parent operation: where a line crosses few of many leaves, only the
/// ancestors of those are evaluated.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tree {
    leaves: Vec<(Part, bool)>,
    /// Operands precede the operation that holds them.
    operations: Vec<Operation>,
    /// For each operation, the weight of the operands that a line outside all leaves is inside.
    outside: Vec<u32>,
}

/// The parent operation of an operand, and its weight there.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part {
    operation: u32,
    /// 1; for the second operand of [`Node::Clip`], 2.
    weight: u32,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Operation {
    node: Node,
    /// `None` for the root.
    part: Option<Part>,
}

impl Tree {
    pub fn new(nodes: &[Node]) -> Self {
        let mut tree = Self::default();
        // What stands for itself so far: a leaf or an operation, and whether what is nowhere is in it.
        let mut stack: Vec<(bool, usize, bool)> = Vec::new();
        for &node in nodes {
            let Some(count) = node.parts() else {
                let inverse = node == Node::Leaf { inverse: true };
                stack.push((true, tree.leaves.len(), inverse));
                tree.leaves.push((Part { operation: 0, weight: 1 }, inverse));
                continue;
            };
            let operation = tree.operations.len() as u32;
            let mut outside = 0;
            let first = stack.len().saturating_sub(count as usize);
            for (place, (is_leaf, index, inside)) in stack.drain(first..).enumerate() {
                let weight = if node.is_clip() && place == 1 { 2 } else { 1 };
                outside += weight * u32::from(inside);
                let part = Part { operation, weight };
                match is_leaf {
                    true => tree.leaves[index].0 = part,
                    false => tree.operations[index].part = Some(part),
                }
            }
            tree.operations.push(Operation { node, part: None });
            tree.outside.push(outside);
            stack.push((false, operation as usize, node.holds(outside)));
        }
        tree
    }

    /// Advances past the events at one position and returns the one that is a crossing of the combined solid.
    fn pass(
        &self,
        counts: &mut [u32],
        events: &[Event],
        place: Range<usize>,
        changes: &mut SmallVec<[Change; 8]>,
    ) -> Option<usize> {
        if self.operations.is_empty() {
            return place.last();
        }
        if place.len() == 1 {
            return self.pass_one(counts, &events[place.start], place.start);
        }
        changes.extend(place.map(|number| self.change(&events[number], number)));
        // The last operation first: the next is at the end.
        changes.sort_unstable_by_key(|change| std::cmp::Reverse(change.part.operation));
        // The operations in order, so that of each all parts are known.
        let mut whole = None;
        while let Some(operation) = changes.last().map(|change| change.part.operation) {
            let first = changes.partition_point(|change| change.part.operation > operation);
            let (state, part) = self.change_operation(counts, operation, &changes[first..]);
            changes.truncate(first);
            match part {
                None => whole = state.shown,
                Some(part) if state.counts() => push(changes, Change { part, state }),
                Some(_) => {}
            }
        }
        whole.map(|(_, _, number)| number)
    }

    /// [`Self::pass`] for a single event: in each operation above it, one operand changes.
    fn pass_one(&self, counts: &mut [u32], event: &Event, number: usize) -> Option<usize> {
        let mut change = self.change(event, number);
        loop {
            let operation = change.part.operation;
            let (state, part) = self.change_operation(counts, operation, &[change]);
            change = match part {
                None => return state.shown.map(|(_, _, number)| number),
                Some(part) if state.counts() => Change { part, state },
                Some(_) => return None,
            };
        }
    }

    /// Returns the state of the event's leaf; `number` is the event's index.
    fn change(&self, event: &Event, number: usize) -> Change {
        let (part, inverse) = self.leaves[event.leaf as usize];
        let inside = |raw: bool| (raw && !event.sheet) != inverse;
        let state = State {
            before: inside(event.met.leaving),
            after: inside(!event.met.leaving),
            shown: Some((!event.met.is_seen(), event.leaf, number)),
        };
        Change { part, state }
    }

    /// Updates an operation whose operands change; returns its state and its parent.
    #[inline(always)]
    fn change_operation(
        &self,
        counts: &mut [u32],
        operation: u32,
        changes: &[Change],
    ) -> (State, Option<Part>) {
        let Operation { node, part } = self.operations[operation as usize];
        let count = &mut counts[operation as usize];
        let sums = Sums::new(*count, changes);
        *count = sums.after;
        (node.state(&sums, changes), part)
    }
}

/// The state of an operand at a position where it is crossed.
#[derive(Debug, Clone, Copy)]
struct Change {
    part: Part,
    state: State,
}

/// Inserts a change, in descending order of operation.
fn push(changes: &mut SmallVec<[Change; 8]>, change: Change) {
    let place = changes.partition_point(|other| other.part.operation >= change.part.operation);
    changes.insert(place, change);
}

/// Total weight of an operation's operands that the line is inside of.
struct Sums {
    before: u32,
    after: u32,
    /// Weight of those that it is inside of both before and after.
    stay: u32,
}

impl Sums {
    fn new(before: u32, changes: &[Change]) -> Self {
        let mut sums = Self { before, after: before, stay: before };
        for Change { part, state } in changes {
            sums.after += part.weight * u32::from(state.after);
            sums.after -= part.weight * u32::from(state.before);
            sums.stay -= part.weight * u32::from(state.before && !state.after);
        }
        sums
    }

    /// Weight of those that it is inside of before or after.
    fn touch(&self) -> u32 {
        self.before + self.after - self.stay
    }
}

impl Node {
    /// Number of operands; `None` for a leaf.
    fn parts(self) -> Option<u32> {
        match self {
            Self::Leaf { .. } => None,
            Self::Union(count) | Self::Merge(count) | Self::Intersection(count) => Some(count),
            Self::Clip { .. } => Some(2),
        }
    }

    fn is_clip(self) -> bool {
        match self {
            Self::Clip { .. } => true,
            Self::Leaf { .. } | Self::Union(_) | Self::Merge(_) | Self::Intersection(_) => false,
        }
    }

    /// Whether a point is inside that lies in operands of total weight `count`.
    fn holds(self, count: u32) -> bool {
        match self {
            Self::Leaf { inverse } => inverse,
            Self::Union(_) | Self::Merge(_) => count > 0,
            Self::Intersection(all) => count == all,
            Self::Clip { inverse: false } => count == 3,
            Self::Clip { inverse: true } => count != 2,
        }
    }

    #[inline(always)]
    fn state(self, sums: &Sums, changes: &[Change]) -> State {
        let (before, after) = (self.holds(sums.before), self.holds(sums.after));
        let begins_or_ends = before != after;
        let shown = match self {
            Self::Leaf { .. } => None,
            // Where the whole begins or ends, what does so is shown, and not a wall.
            Self::Union(_) => {
                first_shown(changes, |part, _| part.before == before && part.after == after)
                    .or_else(|| first_shown(changes, |_, _| true))
            }
            // A sheet shows itself where it lies in no other part; of what is shared, in all others.
            Self::Merge(_) => first_shown(changes, |part, _| match part.changes() {
                true => begins_or_ends,
                false => sums.stay == u32::from(part.stays()),
            }),
            Self::Intersection(all) => first_shown(changes, |part, _| match part.changes() {
                true => begins_or_ends,
                false => sums.touch() + u32::from(!part.touches()) == all,
            }),
            Self::Clip { .. } => {
                let region = (sums.before | sums.after) & 2 != 0;
                first_shown(changes, |_, part| region && part.weight == 1)
            }
        };
        State { before, after, shown }
    }
}

/// Of the operands that show themselves, the first for which something holds.
#[inline(always)]
fn first_shown(
    changes: &[Change],
    holds: impl Fn(State, Part) -> bool,
) -> Option<(bool, u32, usize)> {
    let shown = |change: &Change| change.state.shown.filter(|_| holds(change.state, change.part));
    match changes {
        [only] => shown(only),
        _ => changes.iter().filter_map(shown).min(),
    }
}

/// Returns whether a point lies inside the combined solid. `insides` yields, for each leaf, whether the point
/// lies in it, ignoring inversion.
pub fn contains(nodes: &[Node], insides: impl IntoIterator<Item = bool>) -> bool {
    let mut insides = insides.into_iter();
    let mut stack: SmallVec<[bool; 16]> = SmallVec::new();
    for node in nodes {
        let inside = match *node {
            Node::Leaf { inverse } => insides.next().unwrap_or(false) != inverse,
            Node::Union(count) | Node::Merge(count) => last(&mut stack, count).any(|part| part),
            Node::Intersection(count) => last(&mut stack, count).all(|part| part),
            Node::Clip { inverse: false } => last(&mut stack, 2).all(|part| part),
            Node::Clip { inverse: true } => {
                last(&mut stack, 2).enumerate().any(|(place, part)| part == (place == 0))
            }
        };
        stack.push(inside);
    }
    stack.pop().unwrap_or(false)
}

/// Pops the last `count` values.
fn last(stack: &mut SmallVec<[bool; 16]>, count: u32) -> impl Iterator<Item = bool> + use<> {
    let rest = stack.len().saturating_sub(count as usize);
    let parts: SmallVec<[bool; 16]> = stack.drain(rest..).collect();
    parts.into_iter()
}

#[cfg(test)]
mod tests;
