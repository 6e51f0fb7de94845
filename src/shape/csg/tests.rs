use super::*;
use crate::math::random::{Random, tries_in};

/// Of random trees.
fn trees() -> usize {
    tries_in(100)
}

const A: u32 = 0;
const B: u32 = 1;
const SOLID: Node = Node::Leaf { inverse: false };
const HOLE: Node = Node::Leaf { inverse: true };

/// What is kept of two solids, from 0 to `a` and from `b.0` to `b.1`, as (leaf, t).
fn of_two(nodes: &[Node], a: f64, b: (f64, f64)) -> Vec<(u32, f64)> {
    let met = |t, leaving, leaf, last| Event {
        met: Met { t, error: 1e-3, leaving, part: 0 },
        leaf,
        sheet: false,
        last,
        shared: false,
    };
    let first = [met(0.0, false, A, None), met(a, true, A, Some(0.0))];
    let second = [met(b.0, false, B, None), met(b.1, true, B, Some(b.0))];
    let mut events: Events = first.into_iter().chain(second).collect();
    events.sort_by(|x, y| x.met.t.total_cmp(&y.met.t));
    Tree::new(nodes).keep(&mut events);
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
fn what_is_not_there_to_be_seen_hides_nothing_that_lies_in_it() {
    let kept = |nodes: &[Node], hidden: u32| {
        let event = |leaf, t, leaving| {
            let part = if leaf == hidden { Met::UNSEEN } else { 0 };
            Event {
                met: Met { t, error: 1e-3, leaving, part },
                leaf,
                sheet: false,
                last: None,
                shared: false,
            }
        };
        let mut events: Events =
            [event(A, 0.0, false), event(B, 0.0, false), event(A, 1.0, true), event(B, 1.0, true)]
                .into_iter()
                .collect();
        Tree::new(nodes).keep(&mut events);
        events.iter().map(|event| event.leaf).collect::<Vec<_>>()
    };
    for nodes in [INTERSECTION, MERGE, UNION] {
        assert_eq!((kept(&nodes, A), kept(&nodes, B)), (vec![B, B], vec![A, A]), "{nodes:?}");
    }
    assert!(kept(&DIFFERENCE, A).is_empty());
}

#[test]
fn what_both_begin_with_is_shown_once() {
    assert_eq!(of_two(&INTERSECTION, 2.0, (0.0, 1.0)), [(A, 0.0), (B, 1.0)]);
    assert_eq!(of_two(&MERGE, 2.0, (0.0, 1.0)), [(A, 0.0), (A, 2.0)]);
}

/// How many levels one of so many trees has at most; a deep one has hundreds of leaves.
fn levels(number: usize) -> usize {
    if number.is_multiple_of(10) { 8 } else { 5 }
}

/// Operations of solids: merge and intersection.
const SOLIDS: usize = 2;
/// What is clipped, too, which is open.
const SHEETS: usize = 3;

/// Any tree of so many levels over leaves from `first` on; returns how many it has.
fn random_tree(random: &mut Random, depth: usize, kinds: usize, nodes: &mut Vec<Node>) -> u32 {
    if depth == 0 || random.below(5) == 0 {
        nodes.push(Node::Leaf { inverse: random.below(3) == 0 });
        return 1;
    }
    let kind = random.below(kinds);
    let parts = if kind == 2 { 2 } else { random.below(3) + 2 };
    let leaves = (0..parts).map(|_| random_tree(random, depth - 1, kinds, nodes)).sum();
    nodes.push(match kind {
        0 => Node::Merge(parts as u32),
        1 => Node::Intersection(parts as u32),
        _ => Node::Clip { inverse: random.below(2) == 0 },
    });
    leaves
}

/// Each leaf's crossings, at whole numbers: many coincide. Some have no end.
fn random_events(random: &mut Random, leaves: u32) -> Events {
    let mut events = Events::new();
    for leaf in 0..leaves {
        let mut places: Vec<i32> = (0..random.below(5)).map(|_| random.below(9) as i32).collect();
        places.sort_unstable();
        places.dedup();
        let mut places: Vec<f64> = places.into_iter().map(f64::from).collect();
        if random.below(6) == 0 {
            places.insert(0, f64::NEG_INFINITY);
        }
        let mut last = None;
        for (number, t) in places.into_iter().enumerate() {
            let met = Met { t, error: 1e-3, leaving: number % 2 == 1, part: 0 };
            events.push(Event { met, leaf, sheet: false, last, shared: false });
            last = Some(t);
        }
    }
    in_order(events)
}

fn in_order(mut events: Events) -> Events {
    events.sort_by(|a, b| a.met.t.total_cmp(&b.met.t).then(a.leaf.cmp(&b.leaf)));
    events
}

/// Which of the leaves a place is in.
fn insides(events: &Events, leaves: u32, t: f64) -> Vec<bool> {
    let crossed = |leaf| events.iter().filter(|e| e.leaf == leaf && e.met.t < t).count();
    (0..leaves).map(|leaf| crossed(leaf) % 2 == 1).collect()
}

fn kept(nodes: &[Node], events: &Events) -> Vec<(u32, f64)> {
    let mut events = events.clone();
    Tree::new(nodes).keep(&mut events);
    events.iter().map(|event| (event.leaf, event.met.t)).collect()
}

/// The nodes of what is outside.
fn complement(nodes: &[Node]) -> Vec<Node> {
    let other = |node: &Node| match *node {
        Node::Leaf { inverse } => Node::Leaf { inverse: !inverse },
        Node::Union(count) | Node::Merge(count) => Node::Intersection(count),
        Node::Intersection(count) => Node::Merge(count),
        clip @ Node::Clip { .. } => clip,
    };
    nodes.iter().map(other).collect()
}

#[test]
fn a_whole_begins_and_ends_where_an_exact_evaluation_of_its_places_says() {
    let mut random = Random(81);
    let (mut ends, mut coincide) = (0, 0);
    for number in 0..trees() {
        let mut nodes = Vec::new();
        let kinds = [SOLIDS, SHEETS][random.below(2)];
        let leaves = random_tree(&mut random, levels(number), kinds, &mut nodes);
        let is_clipped = nodes.iter().any(|node| node.is_clip());
        let events = random_events(&mut random, leaves);
        let found = kept(&nodes, &events);
        for place in 0..9 {
            let t = f64::from(place);
            let at = |t| contains(&nodes, insides(&events, leaves, t));
            let here: Vec<_> = found.iter().filter(|(_, other)| *other == t).collect();
            let changes = at(t - 0.5) != at(t + 0.5);
            coincide += usize::from(events.iter().filter(|e| e.met.t == t).count() > 1);
            ends += usize::from(changes);
            // What is clipped ends without a surface.
            if !is_clipped {
                assert_eq!(here.len(), usize::from(changes), "{nodes:?} {events:?} at {t}");
            }
            for (leaf, _) in here {
                assert!(events.iter().any(|e| e.leaf == *leaf && e.met.t == t));
            }
        }
    }
    assert!(ends > trees() / 2 && coincide > trees(), "{ends} ends, {coincide} coincide");
}

#[test]
fn what_is_outside_has_the_same_surface_and_shares_nothing_with_what_is_inside() {
    let mut random = Random(82);
    for number in 0..trees() {
        let mut nodes = Vec::new();
        let leaves = random_tree(&mut random, levels(number), SOLIDS, &mut nodes);
        let events = random_events(&mut random, leaves);
        let other = complement(&nodes);
        assert_eq!(kept(&nodes, &events), kept(&other, &events), "{nodes:?}");
        // A without A, and A together with all else.
        let again = events.iter().map(|&e| Event { leaf: e.leaf + leaves, ..e });
        let twice = in_order(events.iter().copied().chain(again).collect());
        for last in [Node::Intersection(2), Node::Merge(2)] {
            let both = [nodes.as_slice(), &other, &[last]].concat();
            assert_eq!(kept(&both, &twice), [], "{both:?} {events:?}");
            // With itself it is itself.
            let same = [nodes.as_slice(), &nodes, &[last]].concat();
            assert_eq!(kept(&same, &twice), kept(&nodes, &events), "{same:?} {events:?}");
        }
    }
}

#[test]
fn how_three_solids_are_put_together_does_not_matter() {
    let mut random = Random(83);
    let mut some = 0;
    for _ in 0..trees() {
        let three = [0; 3].map(|_| {
            let mut nodes = Vec::new();
            (random_tree(&mut random, 3, SOLIDS, &mut nodes), nodes)
        });
        let leaves = three.iter().map(|(leaves, _)| leaves).sum();
        let [a, b, c] = three.map(|(_, nodes)| nodes);
        let events = random_events(&mut random, leaves);
        for node in [Node::Merge, Node::Intersection] {
            let flat = [a.as_slice(), &b, &c, &[node(3)]].concat();
            let first = [a.as_slice(), &b, &[node(2)], &c, &[node(2)]].concat();
            let last = [a.as_slice(), &b, &c, &[node(2), node(2)]].concat();
            let expected = kept(&flat, &events);
            assert_eq!(kept(&first, &events), expected, "{flat:?} {events:?}");
            assert_eq!(kept(&last, &events), expected, "{flat:?} {events:?}");
            some += expected.len();
        }
    }
    assert!(some > trees(), "{some}");
}

#[test]
fn nothing_and_everything_are_parts_like_others() {
    let with = |part, last| of_two(&[SOLID, SOLID, part, last], 2.0, (1.0, 3.0));
    let [nothing, everything] = [Node::Merge(0), Node::Intersection(0)];
    assert_eq!(with(nothing, Node::Intersection(3)), []);
    assert_eq!(with(everything, Node::Intersection(3)), [(B, 1.0), (A, 2.0)]);
    assert_eq!(with(nothing, Node::Merge(3)), [(A, 0.0), (B, 3.0)]);
    assert_eq!(with(everything, Node::Merge(3)), []);
}

/// Twice the depth takes about twice the steps, and no stack.
#[test]
fn a_hundred_thousand_levels_are_gone_through() {
    let levels = 100_000;
    let mut nodes = vec![SOLID];
    for level in 0..levels {
        let last = if level % 2 == 0 { Node::Merge(2) } else { Node::Intersection(2) };
        nodes.extend([Node::Leaf { inverse: level % 2 == 1 }, last]);
    }
    let tree = Tree::new(&nodes);
    let met = |t, leaving| Met { t, error: 1e-9, leaving, part: 0 };
    // The first is the innermost, the last the outermost.
    for (leaf, expected) in [(0, 2), (1, 2), (levels, 0)] {
        let event = |t, leaving, last| Event {
            met: met(t, leaving),
            leaf,
            sheet: false,
            last,
            shared: false,
        };
        let mut events: Events =
            [event(1.0, false, None), event(2.0, true, Some(1.0))].into_iter().collect();
        tree.keep(&mut events);
        assert_eq!(events.len(), expected, "{leaf}");
    }
}

#[test]
fn of_solids_that_a_line_grazes_where_they_coincide_nothing_is_left() {
    // The second is crossed within the error of the first's two crossings.
    for b in [(0.0, 1e-5), (5e-6, 2.0), (2e-5, 3e-5), (-1.0, 2.0)] {
        assert_eq!(of_two(&DIFFERENCE, 1e-5, b), [], "{b:?}");
    }
    assert_eq!(of_two(&INTERSECTION, 1e-5, (-1.0, 5e-6)), []);
    // Alone, and beside what only touches it, it is there.
    for b in [(1.0, 2.0), (-1.0, 0.0)] {
        assert_eq!(of_two(&DIFFERENCE, 1e-5, b)[..2], [(A, 0.0), (A, 1e-5)], "{b:?}");
    }
}
