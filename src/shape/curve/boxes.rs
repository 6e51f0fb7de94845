//! Boxes around pieces in a row, around the halves of that row, and so on: what holds all over a box need not be
//! asked of each piece in it.

use std::ops::Range;

use super::{Piece, Point};

/// The lowest and the highest coordinates.
pub type Hull = [Point; 2];

/// For each run all that its first node stands for: before its two halves, and these in order.
#[derive(Debug, Clone, Default)]
pub struct Boxes {
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    hull: Hull,
    /// The pieces in it, by number.
    from: usize,
    to: usize,
}

impl Boxes {
    /// Adds those of the pieces from one on to the last. Returns the number of the first.
    pub fn add(&mut self, pieces: &[Piece], from: usize) -> usize {
        let root = self.nodes.len();
        let mut rows = vec![(from, pieces.len())];
        while let Some((from, to)) = rows.pop() {
            let hulls = pieces[from..to].iter().map(Piece::hull);
            let hull = hulls.reduce(union).unwrap_or_default();
            self.nodes.push(Node { hull, from, to });
            if to - from > 1 {
                let middle = from.midpoint(to);
                rows.extend([(middle, to), (from, middle)]);
            }
        }
        root
    }

    /// The first, around all of a run.
    pub fn hull(&self, root: usize) -> Hull {
        self.nodes[root].hull
    }

    /// Shows `look` boxes in the order of their pieces: the two halves of each that it wants halved.
    #[inline(always)]
    pub fn descend(&self, root: usize, mut look: impl FnMut(&Hull, Range<usize>) -> bool) {
        let size = |node: &Node| 2 * (node.to - node.from) - 1;
        let mut here = root;
        let end = root + size(&self.nodes[root]);
        while here < end {
            let node = &self.nodes[here];
            here += if look(&node.hull, node.from..node.to) { 1 } else { size(node) };
        }
    }
}

/// About both.
pub fn union(a: Hull, b: Hull) -> Hull {
    [[a[0][0].min(b[0][0]), a[0][1].min(b[0][1])], [a[1][0].max(b[1][0]), a[1][1].max(b[1][1])]]
}
