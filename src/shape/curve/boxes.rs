//! Bounding boxes of a row of pieces, of the halves of the row, and so on: a property that holds throughout a
//! box need not be tested for each piece.

use std::ops::Range;

use super::{Piece, Point};

/// The minimum and maximum coordinates.
pub type Hull = [Point; 2];

/// The box trees of all runs, each in preorder: a node precedes its two halves.
#[derive(Debug, Clone, Default)]
pub struct Boxes {
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    hull: Hull,
    /// The range of pieces in it.
    from: usize,
    to: usize,
}

impl Boxes {
    /// Adds the boxes of the pieces from `from` on. Returns the index of the root.
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

    /// Returns the box of an entire run, given its root.
    pub fn hull(&self, root: usize) -> Hull {
        self.nodes[root].hull
    }

    /// Calls `look` with boxes in the order of their pieces; descends into both halves where it returns
    /// `true`.
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

/// Returns the box that contains both.
pub fn union(a: Hull, b: Hull) -> Hull {
    [[a[0][0].min(b[0][0]), a[0][1].min(b[0][1])], [a[1][0].max(b[1][0]), a[1][1].max(b[1][1])]]
}
