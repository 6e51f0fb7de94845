//! Bounding volume hierarchy over the pieces of one body; finds the pieces that a line may intersect.
//!
//! **In:** the bounds of the pieces. **Out:** the tree, and the order of the pieces in its leaves.
//! **Invariant:** never skips a box within the given distance of the line; no recursion; the tree depends
//! only on the bounds and their order.
//!
//! **Source:** I. Wald, "On fast construction of SAH-based bounding volume hierarchies", RT 2007.

use std::ops::Range;

use smallvec::SmallVec;

use super::Bounds;
use super::local::LocalRay;
use crate::math::Vector;

const BINS: usize = 16;
/// Maximum number of pieces in a leaf, unless they cannot be separated or each is expensive.
const LEAF: usize = 4;
/// Depth from which on splits halve the number of pieces.
const DEPTH: usize = 40;
/// Maximum number of nodes visited for pieces that touch a box; the remaining nodes count in full.
const MOST_NODES: usize = 256;
/// Replaces 1/0.
const STEEPEST: f64 = 1e300;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tree {
    /// The first node is the root; there is at least one.
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    bounds: Bounds,
    /// A leaf's first piece, or the first of two adjacent child nodes.
    first: u32,
    /// Number of pieces of a leaf; 0 for an inner node.
    count: u32,
}

impl Tree {
    /// Builds the tree and returns it with the order of the pieces. `bounds` are finite, and there is at
    /// least one.
    pub fn build(bounds: &[Bounds]) -> (Self, Vec<u32>) {
        Self::with_leaves(bounds, LEAF)
    }

    /// Builds the tree for pieces that each cost more than testing a box.
    pub fn of_costly(bounds: &[Bounds]) -> (Self, Vec<u32>) {
        Self::with_leaves(bounds, 1)
    }

    fn with_leaves(bounds: &[Bounds], most: usize) -> (Self, Vec<u32>) {
        let mut order: Vec<u32> = (0..bounds.len() as u32).collect();
        let all = |pieces: &[u32]| {
            pieces.iter().fold(Bounds::NOWHERE, |all, &piece| all.union(&bounds[piece as usize]))
        };
        let mut nodes = vec![Node { bounds: all(&order), first: 0, count: order.len() as u32 }];
        let mut tasks = vec![(0, 0)];
        while let Some((index, depth)) = tasks.pop() {
            let Node { first, count, .. }: Node = nodes[index];
            let range = first as usize..(first + count) as usize;
            let pieces = &mut order[range.clone()];
            let Some(middle) = split(bounds, pieces, most, depth) else { continue };
            let children = nodes.len();
            nodes[index] = Node { first: children as u32, count: 0, ..nodes[index] };
            for part in [range.start..range.start + middle, range.start + middle..range.end] {
                let (first, count) = (part.start as u32, part.len() as u32);
                nodes.push(Node { bounds: all(&order[part]), first, count });
            }
            tasks.extend([(children, depth + 1), (children + 1, depth + 1)]);
        }
        (Self { nodes }, order)
    }

    /// Calls `leaf` with each run of pieces whose box lies within `slack` of the line.
    pub fn along(&self, ray: &LocalRay, slack: f64, mut leaf: impl FnMut(Range<usize>)) {
        let LocalRay { nearest, direction, .. } = *ray;
        let steepest = Vector::splat(STEEPEST);
        let reciprocal = direction.recip().clamp(-steepest, steepest);
        let (past_low, past_high) = (nearest + slack, nearest - slack);
        let meets = |Bounds { low, high }: &Bounds| {
            let a = ((*low - past_low) * reciprocal).to_array();
            let b = ((*high - past_high) * reciprocal).to_array();
            // All are numbers: a comparison is less than `min` does.
            let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
            for (a, b) in a.into_iter().zip(b) {
                let (near, far) = if a < b { (a, b) } else { (b, a) };
                enter = if near > enter { near } else { enter };
                leave = if far < leave { far } else { leave };
            }
            enter <= leave
        };
        let mut stack: SmallVec<[u32; 64]> = SmallVec::new();
        let mut next = Some(0);
        while let Some(index) = next {
            let Node { bounds, first, count } = &self.nodes[index as usize];
            if meets(bounds) {
                if *count == 0 {
                    stack.push(first + 1);
                    next = Some(*first);
                    continue;
                }
                leaf(*first as usize..(first + count) as usize);
            }
            next = stack.pop();
        }
    }

    /// Calls `leaf` with each run of pieces whose box touches `wanted`.
    pub fn touching(&self, wanted: &Bounds, mut leaf: impl FnMut(Range<usize>)) {
        let mut stack: SmallVec<[u32; 64]> = SmallVec::new();
        stack.push(0);
        while let Some(index) = stack.pop() {
            let Node { bounds, first, count } = &self.nodes[index as usize];
            let is_near =
                bounds.low.cmple(wanted.high).all() && wanted.low.cmple(bounds.high).all();
            match (is_near, *count) {
                (false, _) => {}
                (true, 0) => stack.extend([first + 1, *first]),
                (true, count) => leaf(*first as usize..(first + count) as usize),
            }
        }
    }

    /// Returns, for each node, the sum of the weights of its pieces, for [`Self::weight_touching`].
    pub fn weights(&self, piece: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut weights = vec![0.0; self.nodes.len()];
        // Children stand behind their parents.
        for (index, &Node { first, count, .. }) in self.nodes.iter().enumerate().rev() {
            let first = first as usize;
            weights[index] = match count {
                0 => weights[first] + weights[first + 1],
                _ => (first..first + count as usize).map(&piece).sum(),
            };
        }
        weights
    }

    /// Returns an upper bound on the total weight of the pieces whose boxes touch `wanted`, and the number of
    /// visited nodes, which is at most slightly more than [`MOST_NODES`].
    pub fn weight_touching(&self, wanted: &Bounds, weights: &[f64]) -> (f64, usize) {
        let mut queue: SmallVec<[u32; 64]> = SmallVec::new();
        queue.push(0);
        let (mut sum, mut seen) = (0.0, 0);
        while let Some(&index) = queue.get(seen) {
            seen += 1;
            let Node { bounds, first, count } = &self.nodes[index as usize];
            if !(bounds.low.cmple(wanted.high).all() && wanted.low.cmple(bounds.high).all()) {
                continue;
            }
            let is_within = wanted.contains(bounds.low) && wanted.contains(bounds.high);
            match count {
                0 if !is_within && queue.len() < MOST_NODES => queue.extend([*first, first + 1]),
                _ => sum += weights[index as usize],
            }
        }
        (sum, seen)
    }

    /// Returns the maximum of `leaf` over runs of pieces. Up to rounding, `leaf` must not exceed the maximum
    /// of `along`·P over the box of its run.
    pub fn greatest(&self, along: Vector, leaf: impl Fn(Range<usize>) -> f64) -> f64 {
        let most = |Bounds { low, high }: &Bounds| (*low * along).max(*high * along).element_sum();
        let mut best = f64::NEG_INFINITY;
        let mut stack: SmallVec<[u32; 64]> = SmallVec::new();
        stack.push(0);
        while let Some(index) = stack.pop() {
            let Node { bounds, first, count } = &self.nodes[index as usize];
            if most(bounds) <= best {
                continue;
            }
            match count {
                0 => {
                    let [a, b] = [*first, first + 1];
                    let is_more =
                        most(&self.nodes[a as usize].bounds) > most(&self.nodes[b as usize].bounds);
                    stack.extend(if is_more { [b, a] } else { [a, b] });
                }
                _ => best = best.max(leaf(*first as usize..(first + count) as usize)),
            }
        }
        best
    }
}

/// Half the surface area; 0 for an empty box.
fn area(Bounds { low, high }: &Bounds) -> f64 {
    let size = *high - *low;
    if size.x < 0.0 { 0.0 } else { size.x * size.y + size.y * size.z + size.z * size.x }
}

/// Twice the centre of a piece.
fn centre(Bounds { low, high }: &Bounds) -> Vector {
    *low + *high
}

/// Partitions some pieces in two and returns the size of the first part; `None` for a leaf.
fn split(bounds: &[Bounds], pieces: &mut [u32], most: usize, depth: usize) -> Option<usize> {
    if pieces.len() <= most {
        return None;
    }
    let place = |piece: u32| centre(&bounds[piece as usize]);
    let (low, high) = pieces.iter().fold((Vector::INFINITY, Vector::NEG_INFINITY), |(l, h), &p| {
        (l.min(place(p)), h.max(place(p)))
    });
    let axis = (high - low).max_position();
    let density = BINS as f64 / (high - low)[axis];
    if depth >= DEPTH || !density.is_finite() {
        return Some(pieces.len() / 2);
    }
    let bin = |piece: u32| (((place(piece) - low)[axis] * density) as usize).min(BINS - 1);
    let mut bins = [(Bounds::NOWHERE, 0usize); BINS];
    for &piece in pieces.iter() {
        let (all, count) = &mut bins[bin(piece)];
        (*all, *count) = (all.union(&bounds[piece as usize]), *count + 1);
    }
    let cost = |bins: &[(Bounds, usize)]| {
        let (all, count) =
            bins.iter().fold((Bounds::NOWHERE, 0), |(all, count), (bounds, more)| {
                (all.union(bounds), count + more)
            });
        (area(&all) * count as f64, count)
    };
    let best = (1..BINS)
        .map(|first| (first, cost(&bins[..first]), cost(&bins[first..])))
        .filter(|(_, (_, left), (_, right))| *left > 0 && *right > 0)
        .min_by(|a, b| (a.1.0 + a.2.0).total_cmp(&(b.1.0 + b.2.0)));
    let (first, (_, left), _) = best?;
    // Stable: what is equal keeps its order.
    pieces.sort_by_key(|&piece| bin(piece) >= first);
    Some(left)
}
