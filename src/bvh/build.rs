//! Builds the tree of boxes: splits where the surface area heuristic, sampled in bins, is least.
//!
//! **In:** the bounds of pieces. **Out:** the tree, and the pieces in the order its leaves name
//! them. **Invariant:** depends on the bounds and their order alone; no leaf is deeper than
//! [`DEPTH`]; no recursion.
//!
//! **Source:** I. Wald, "On fast construction of SAH-based bounding volume hierarchies", RT 2007.

use std::ops::Range;

use super::{Child, DEPTH, LEAF, Node, Space, Tree};
use crate::math::bounds::Bounds;
use crate::math::{Lanes, Vector, reciprocal_power_of_two};

/// Bins along an axis, for many pieces and for few.
const BINS: usize = 16;
const FEW_BINS: usize = 6;
const FEW: usize = 24;
/// The price of testing a node's boxes, in tests of one piece.
const NODE_COST: f32 = 0.7;

impl Tree {
    /// Builds the tree and returns it with the order of the pieces in its leaves. The bounds are finite.
    pub fn build(bounds: &[Bounds]) -> (Self, Vec<u32>) {
        let space = Space::around(bounds);
        let mut pieces: Vec<Piece> =
            (0..).zip(bounds).map(|(index, b)| Piece::new(index, space.outward(b))).collect();
        let nodes = nodes(&mut pieces);
        let order = pieces.iter().map(|piece| piece.index).collect();
        (Self { space, nodes, count: bounds.len() }, order)
    }
}

impl Space {
    fn around(bounds: &[Bounds]) -> Self {
        let Some(all) = bounds.iter().copied().reduce(|all, b| all.union(&b)) else {
            return Self { origin: Vector::ZERO, scale: 1.0 };
        };
        // Halved first: their sum may be past all numbers.
        let (low, high) = (all.low * 0.5, all.high * 0.5);
        let size = (high - low).max_element();
        Self { origin: low + high, scale: 0.5 * reciprocal_power_of_two(size) }
    }
}

/// What is sorted into the tree.
#[derive(Clone, Copy)]
struct Piece {
    extent: Extent,
    index: u32,
}

impl Piece {
    fn new(index: u32, [low, high]: [Lanes; 2]) -> Self {
        Self { extent: Extent { low, high }, index }
    }

    /// Twice its centre.
    fn centre(&self) -> Lanes {
        self.extent.low + self.extent.high
    }
}

/// A box in the tree's space; the fourth lane is 0.
#[derive(Clone, Copy)]
struct Extent {
    low: Lanes,
    high: Lanes,
}

impl Extent {
    const NOTHING: Self = Self { low: Lanes::INFINITY, high: Lanes::NEG_INFINITY };

    fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Half the surface; 0 of nothing.
    fn area(&self) -> f32 {
        let [x, y, z, _] = (self.high - self.low).to_array();
        if x < 0.0 { 0.0 } else { x * y + y * z + z * x }
    }

    fn of(pieces: &[Piece]) -> Self {
        pieces.iter().fold(Self::NOTHING, |all, piece| all.with(piece.extent))
    }
}

/// A part of the pieces that will be one child.
#[derive(Clone)]
struct Part {
    range: Range<usize>,
    extent: Extent,
    depth: usize,
    /// A leaf: not to be split.
    whole: bool,
}

impl Part {
    fn new(range: Range<usize>, extent: Extent, depth: usize) -> Self {
        let whole = range.len() <= 1;
        Self { range, extent, depth, whole }
    }
}

/// The first is the root; no path to a leaf is longer than [`DEPTH`].
fn nodes(pieces: &mut [Piece]) -> Vec<Node> {
    let mut nodes = vec![Node::EMPTY];
    let mut tasks = vec![(0, 1, Part::new(0..pieces.len(), Extent::of(pieces), 0))];
    while let Some((index, level, part)) = tasks.pop() {
        debug_assert!(level <= DEPTH, "{level}");
        let mut parts = Vec::with_capacity(4);
        parts.push(part);
        while parts.len() < 4 {
            let open = parts.iter().enumerate().filter(|(_, part)| !part.whole);
            let widest = open.max_by(|a, b| a.1.extent.area().total_cmp(&b.1.extent.area()));
            let Some((place, _)) = widest else { break };
            match split(pieces, &parts[place]) {
                Some([left, right]) => {
                    parts[place] = left;
                    parts.insert(place + 1, right);
                }
                None => parts[place].whole = true,
            }
        }
        for (lane, part) in parts.into_iter().enumerate() {
            let child = if part.whole {
                Child::leaf(part.range.clone())
            } else {
                nodes.push(Node::EMPTY);
                Child::node(nodes.len() - 1)
            };
            nodes[index].set(lane, child, &part.extent);
            if !part.whole {
                tasks.push((nodes.len() - 1, level + 1, part));
            }
        }
    }
    nodes
}

impl Node {
    fn set(&mut self, lane: usize, child: Child, extent: &Extent) {
        self.children[lane] = child;
        for axis in 0..3 {
            self.planes[axis][0][lane] = extent.low[axis];
            self.planes[axis][1][lane] = extent.high[axis];
        }
    }
}

/// Divides a part in two, or `None` when it is better as a leaf.
fn split(pieces: &mut [Piece], part: &Part) -> Option<[Part; 2]> {
    let all = &mut pieces[part.range.clone()];
    let by_cost = if part.depth >= DEPTH / 2 {
        None
    } else if all.len() > FEW {
        Bins::<BINS>::fill(all).best()
    } else {
        Bins::<FEW_BINS>::fill(all).best()
    };
    let parts = |middle: usize, [left, right]: [Extent; 2]| {
        let Range { start, end } = part.range;
        let middle = start + middle;
        [(start..middle, left), (middle..end, right)]
            .map(|(range, extent)| Part::new(range, extent, part.depth + 1))
    };
    match by_cost {
        Some(best) => {
            let unsplit = all.len() as f32 * part.extent.area();
            if all.len() <= LEAF && unsplit <= best.cost + NODE_COST * part.extent.area() {
                return None;
            }
            let middle = partition(all, |piece| best.is_left(piece));
            Some(parts(middle, best.extents))
        }
        None if all.len() <= 4 => None,
        // All centres in one place, or too deep: by halves.
        None => {
            let middle = all.len() / 2;
            let size = part.extent.high - part.extent.low;
            let axis =
                (0..3).fold(0, |most, axis| if size[axis] > size[most] { axis } else { most });
            all.select_nth_unstable_by(middle, |a, b| {
                a.centre()[axis].total_cmp(&b.centre()[axis]).then(a.index.cmp(&b.index))
            });
            Some(parts(middle, [Extent::of(&all[..middle]), Extent::of(&all[middle..])]))
        }
    }
}

/// Moves what is `left` to the front, in place; returns how many.
fn partition(pieces: &mut [Piece], left: impl Fn(&Piece) -> bool) -> usize {
    let mut middle = 0;
    for place in 0..pieces.len() {
        if left(&pieces[place]) {
            pieces.swap(middle, place);
            middle += 1;
        }
    }
    middle
}

/// The pieces of a part, sorted coarsely along each axis by their centres.
struct Bins<const N: usize> {
    low: Lanes,
    /// Bins for each unit of length; 0 along an axis on which all centres coincide.
    density: Lanes,
    counts: [[u32; N]; 3],
    extents: [[Extent; N]; 3],
}

struct Best {
    axis: usize,
    /// The first bin on the right.
    bin: usize,
    low: Lanes,
    density: Lanes,
    /// Of what is on the left and on the right.
    extents: [Extent; 2],
    /// Σ area · count of the two sides.
    cost: f32,
}

fn bins_of<const N: usize>(piece: &Piece, low: Lanes, density: Lanes) -> [usize; 3] {
    let [x, y, z, _] = ((piece.centre() - low) * density).to_array();
    [x, y, z].map(|place| (place as u32 as usize).min(N - 1))
}

impl Best {
    fn is_left(&self, piece: &Piece) -> bool {
        let places = (piece.centre() - self.low) * self.density;
        places[self.axis] < self.bin as f32
    }
}

impl<const N: usize> Bins<N> {
    fn fill(pieces: &[Piece]) -> Self {
        let centres = pieces.iter().map(Piece::centre);
        let low = centres.clone().fold(Lanes::INFINITY, Lanes::min);
        let high = centres.fold(Lanes::NEG_INFINITY, Lanes::max);
        let size = high - low;
        let density = Lanes::from_array(size.to_array().map(|size| {
            let density = N as f32 / size;
            if density.is_finite() { density } else { 0.0 }
        }));
        let mut bins =
            Self { low, density, counts: [[0; N]; 3], extents: [[Extent::NOTHING; N]; 3] };
        for piece in pieces {
            let places = bins_of::<N>(piece, low, density);
            for (axis, bin) in places.into_iter().enumerate() {
                bins.counts[axis][bin] += 1;
                let extent = &mut bins.extents[axis][bin];
                *extent = extent.with(piece.extent);
            }
        }
        bins
    }

    /// The cheapest split; `None` when all centres coincide.
    fn best(&self) -> Option<Best> {
        let mut best: Option<Best> = None;
        for axis in 0..3 {
            if self.density[axis] == 0.0 {
                continue;
            }
            let (counts, extents) = (&self.counts[axis], &self.extents[axis]);
            let mut rights = [(Extent::NOTHING, 0.0); N];
            let (mut extent, mut count) = (Extent::NOTHING, 0);
            for bin in (1..N).rev() {
                extent = extent.with(extents[bin]);
                count += counts[bin];
                let cost = if count == 0 { f32::INFINITY } else { extent.area() * count as f32 };
                rights[bin] = (extent, cost);
            }
            let (mut extent, mut count) = (Extent::NOTHING, 0);
            for bin in 1..N {
                extent = extent.with(extents[bin - 1]);
                count += counts[bin - 1];
                let (right, right_cost) = rights[bin];
                let cost = extent.area() * count as f32 + right_cost;
                if count > 0 && cost < best.as_ref().map_or(f32::INFINITY, |best| best.cost) {
                    let (low, density, extents) = (self.low, self.density, [extent, right]);
                    best = Some(Best { axis, bin, low, density, extents, cost });
                }
            }
        }
        best
    }
}
