//! Constructive solid geometry: which crossings with its parts are crossings with the whole.
//!
//! **In:** a tree of operations in postfix order, the crossings of a line with each leaf. **Out:**
//! those that are kept, in order. **Invariant:** an algebra of what lies before and behind a place
//! of the line. Crossings that their error bounds cannot tell apart are one place, so coinciding
//! faces leave nothing thin: A − A is empty, and a hole whose ends lie in the faces is open
//! (regularised set operations). No recursion.
//!
//! **Source:** A. Requicha, "Representations for rigid solids: theory, methods, and systems", ACM
//! Computing Surveys 12 (1980); S. Roth, "Ray casting for modeling solids", Computer Graphics and
//! Image Processing 18 (1982).

use smallvec::SmallVec;

use super::body::Met;

/// A node of the tree; those that it holds stand before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Node {
    /// The next leaf; `inverse` is what is outside of it.
    Leaf { inverse: bool },
    /// So many nodes together, each with all of its surface: there may be walls inside.
    Union(u32),
    /// So many nodes together, without walls inside.
    Merge(u32),
    /// What so many nodes share.
    Intersection(u32),
    /// The surface of the first node, as far as it lies in the second; `inverse` where the first node is
    /// what is outside of the solid.
    Clip { inverse: bool },
}

/// A crossing with one of the leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    pub met: Met,
    /// Which leaf, in the order of the nodes.
    pub leaf: u32,
    /// It is a crossing with a sheet: there is nothing inside.
    pub sheet: bool,
}

/// What a node is at one place of the line.
#[derive(Debug, Clone, Copy)]
struct State {
    /// The place right before lies inside.
    before: bool,
    /// The place right behind does.
    after: bool,
    /// The event, by its place in the list, whose surface is the node's here.
    shown: Option<u32>,
}

impl State {
    fn changes(self) -> bool {
        self.before != self.after
    }

    fn touches(self) -> bool {
        self.before || self.after
    }
}

/// The leaves' insides along a line, as far as it has been followed.
pub type Insides = SmallVec<[bool; 16]>;

/// Keeps of `events`, which are in order, those that are crossings with the whole. `insides` says of
/// each leaf, not inverted, whether the line comes from inside of it.
pub fn keep(nodes: &[Node], insides: &mut Insides, events: &mut SmallVec<[Event; 16]>) {
    let mut kept = 0;
    let mut first = 0;
    while first < events.len() {
        let end = end_of_place(events, first);
        if let Some(shown) = state(nodes, insides, events, first..end).shown {
            events[kept] = events[shown as usize];
            kept += 1;
        }
        for event in &events[first..end] {
            if !event.sheet {
                insides[event.leaf as usize] = !event.met.leaving;
            }
        }
        first = end;
    }
    events.truncate(kept);
}

/// Whether a place lies inside of the whole, where `insides` says whether it lies in each leaf.
pub fn contains(nodes: &[Node], insides: &Insides) -> bool {
    state(nodes, insides, &[], 0..0).before
}

/// The end of the run of events that cannot be told from one another. No leaf is in it twice: that
/// would be a solid too thin to be told, which is there all the same.
fn end_of_place(events: &[Event], first: usize) -> usize {
    let mut limit = events[first].met.t + events[first].met.error;
    let mut end = first + 1;
    while let Some(next) = events.get(end) {
        let apart = next.met.t - next.met.error > limit;
        if apart || events[first..end].iter().any(|event| event.leaf == next.leaf) {
            break;
        }
        limit = limit.max(next.met.t + next.met.error);
        end += 1;
    }
    end
}

/// The whole's state at the place of the events in `place`.
fn state(
    nodes: &[Node],
    insides: &Insides,
    events: &[Event],
    place: std::ops::Range<usize>,
) -> State {
    let mut stack: SmallVec<[State; 16]> = SmallVec::new();
    let mut leaf = 0;
    for node in nodes {
        match *node {
            Node::Leaf { inverse } => {
                let before = insides[leaf as usize];
                let mut state = State { before, after: before, shown: None };
                for number in place.clone() {
                    let event = &events[number];
                    if event.leaf == leaf {
                        state.shown = Some(number as u32);
                        if !event.sheet {
                            state.after = !event.met.leaving;
                            // What is told twice was not crossed.
                            state.shown = state.shown.filter(|_| state.changes());
                        }
                    }
                }
                if inverse {
                    (state.before, state.after) = (!state.before, !state.after);
                }
                stack.push(state);
                leaf += 1;
            }
            Node::Union(count) => combine(&mut stack, count, union),
            Node::Merge(count) => combine(&mut stack, count, merge),
            Node::Intersection(count) => combine(&mut stack, count, intersection),
            Node::Clip { inverse: false } => combine(&mut stack, 2, clip),
            Node::Clip { inverse: true } => combine(&mut stack, 2, clip_inverse),
        }
    }
    stack.pop().unwrap_or(State { before: false, after: false, shown: None })
}

fn combine(stack: &mut SmallVec<[State; 16]>, count: u32, operation: fn(&[State]) -> State) {
    let first = stack.len().saturating_sub(count as usize);
    let state = operation(&stack[first..]);
    stack.truncate(first);
    stack.push(state);
}

fn union(parts: &[State]) -> State {
    let before = parts.iter().any(|part| part.before);
    let after = parts.iter().any(|part| part.after);
    let shows = |part: &&State| part.shown.is_some();
    // Where the whole begins or ends, what does so is shown, and not a wall.
    let shown =
        parts.iter().filter(|part| part.before == before && part.after == after).find(shows);
    let shown = shown.or_else(|| parts.iter().find(shows)).and_then(|part| part.shown);
    State { before, after, shown }
}

fn merge(parts: &[State]) -> State {
    let before = parts.iter().any(|part| part.before);
    let after = parts.iter().any(|part| part.after);
    let alone = |i: usize| {
        parts.iter().enumerate().all(|(j, other)| j == i || !(other.before && other.after))
    };
    let shows = |(i, part): (usize, &State)| {
        part.shown.filter(|_| if part.changes() { before != after } else { alone(i) })
    };
    State { before, after, shown: parts.iter().enumerate().find_map(shows) }
}

fn intersection(parts: &[State]) -> State {
    let before = parts.iter().all(|part| part.before);
    let after = parts.iter().all(|part| part.after);
    let in_all_others =
        |i: usize| parts.iter().enumerate().all(|(j, other)| j == i || other.touches());
    let shows = |(i, part): (usize, &State)| {
        part.shown.filter(|_| if part.changes() { before != after } else { in_all_others(i) })
    };
    State { before, after, shown: parts.iter().enumerate().find_map(shows) }
}

fn clip(parts: &[State]) -> State {
    let [part, region] = parts else { return State { before: false, after: false, shown: None } };
    State {
        before: part.before && region.before,
        after: part.after && region.after,
        shown: part.shown.filter(|_| region.touches()),
    }
}

fn clip_inverse(parts: &[State]) -> State {
    let [part, region] = parts else { return State { before: true, after: true, shown: None } };
    State {
        before: part.before || !region.before,
        after: part.after || !region.after,
        shown: part.shown.filter(|_| region.touches()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: u32 = 0;
    const B: u32 = 1;
    const SOLID: Node = Node::Leaf { inverse: false };
    const HOLE: Node = Node::Leaf { inverse: true };

    /// What is kept of two solids, from 0 to `a` and from `b.0` to `b.1`, as (leaf, t).
    fn of_two(nodes: &[Node], a: f64, b: (f64, f64)) -> Vec<(u32, f64)> {
        let met = |t, leaving, leaf| Event {
            met: Met { t, error: 1e-3, leaving, part: 0 },
            leaf,
            sheet: false,
        };
        let mut events: SmallVec<[Event; 16]> =
            [met(0.0, false, A), met(a, true, A), met(b.0, false, B), met(b.1, true, B)]
                .into_iter()
                .collect();
        events.sort_by(|x, y| x.met.t.total_cmp(&y.met.t));
        let mut insides: Insides = [false, false].into_iter().collect();
        keep(nodes, &mut insides, &mut events);
        assert_eq!(insides.as_slice(), [false, false]);
        events.iter().map(|event| (event.leaf, event.met.t)).collect()
    }

    const DIFFERENCE: [Node; 3] = [SOLID, HOLE, Node::Intersection(2)];
    const INTERSECTION: [Node; 3] = [SOLID, SOLID, Node::Intersection(2)];
    const MERGE: [Node; 3] = [SOLID, SOLID, Node::Merge(2)];
    const UNION: [Node; 3] = [SOLID, SOLID, Node::Union(2)];

    #[test]
    fn operations_keep_what_belongs_to_the_whole() {
        let b = (1.0, 3.0);
        assert_eq!(of_two(&INTERSECTION, 2.0, b), [(B, 1.0), (A, 2.0)]);
        assert_eq!(of_two(&DIFFERENCE, 2.0, b), [(A, 0.0), (B, 1.0)]);
        assert_eq!(of_two(&MERGE, 2.0, b), [(A, 0.0), (B, 3.0)]);
        assert_eq!(of_two(&UNION, 2.0, b), [(A, 0.0), (B, 1.0), (A, 2.0), (B, 3.0)]);
        assert_eq!(of_two(&DIFFERENCE, 4.0, b), [(A, 0.0), (B, 1.0), (B, 3.0), (A, 4.0)]);
        assert_eq!(of_two(&[SOLID, SOLID, Node::Clip { inverse: false }], 2.0, b), [(A, 2.0)]);
    }

    #[test]
    fn a_solid_without_itself_is_empty() {
        assert_eq!(of_two(&DIFFERENCE, 2.0, (0.0, 2.0)), []);
        assert_eq!(of_two(&DIFFERENCE, 2.0, (0.0015, 1.999)), []);
    }

    #[test]
    fn a_hole_whose_ends_lie_in_the_faces_is_open() {
        // The line goes through the hole.
        assert_eq!(of_two(&DIFFERENCE, 2.0, (-1e-3, 2.0)), []);
        // A blind hole, flush with the first face.
        assert_eq!(of_two(&DIFFERENCE, 2.0, (0.0, 1.0)), [(B, 1.0), (A, 2.0)]);
    }

    #[test]
    fn solids_that_touch_merge_without_a_wall_and_share_nothing() {
        assert_eq!(of_two(&MERGE, 2.0, (2.0, 3.0)), [(A, 0.0), (B, 3.0)]);
        assert_eq!(of_two(&INTERSECTION, 2.0, (2.0, 3.0)), []);
        assert_eq!(of_two(&DIFFERENCE, 2.0, (2.0, 3.0)), [(A, 0.0), (A, 2.0)]);
    }

    #[test]
    fn what_both_begin_with_is_shown_once() {
        assert_eq!(of_two(&INTERSECTION, 2.0, (0.0, 1.0)), [(A, 0.0), (B, 1.0)]);
        assert_eq!(of_two(&MERGE, 2.0, (0.0, 1.0)), [(A, 0.0), (A, 2.0)]);
    }
}
