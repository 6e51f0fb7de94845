//! Solids made of others: the tree of operations becomes a list in postfix order.
//!
//! **Invariant:** no difference is left, and no inverse of a node: what is outside of a solid goes down
//! to the leaves (de Morgan). A node of one part is that part; a whole of one leaf is no whole.

use super::Lowering;
use crate::scene::Operation;
use crate::shape::csg::Node;
use crate::world::Whole;

/// A whole under way.
#[derive(Debug)]
pub(super) struct Building {
    /// Its first leaf in `World::objects`.
    first: u32,
    nodes: Vec<Node>,
    /// So many parts has the innermost operation that is open, so far.
    parts: u32,
}

/// An operation on parts that are still to come.
#[derive(Debug, Clone, Copy)]
pub(super) struct Open {
    making: Making,
    inverse: bool,
    /// The parts of the operation around it; `None` where it began the whole.
    outer: Option<u32>,
}

/// What makes one solid of several.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Making {
    Union,
    Operation(Operation),
    /// Of an object, and then what it is clipped by.
    Clip,
}

impl Making {
    /// What makes one of so many parts; or of what is outside of each.
    fn nodes(self, parts: u32, inverse: bool) -> impl Iterator<Item = Node> {
        let is_meeting =
            matches!(self, Self::Operation(Operation::Intersection | Operation::Difference));
        let (first, last) = match self {
            Self::Clip => {
                // All of what clips is what it shares.
                let regions = (parts > 2).then_some(Node::Intersection(parts - 1));
                (regions, Node::Clip { inverse })
            }
            _ if is_meeting != inverse => (None, Node::Intersection(parts)),
            Self::Union if !inverse => (None, Node::Union(parts)),
            Self::Union | Self::Operation(_) => (None, Node::Merge(parts)),
        };
        first.into_iter().chain([last])
    }
}

impl Lowering<'_, '_> {
    /// Opens an operation; `None` where its parts may stand by themselves.
    pub(super) fn open(&mut self, making: Making, inverse: bool) -> Option<Open> {
        if let Some(building) = &mut self.building {
            return Some(Open {
                making,
                inverse,
                outer: Some(std::mem::take(&mut building.parts)),
            });
        }
        if making == Making::Union && !inverse {
            return None;
        }
        let first = self.world.objects.len() as u32;
        self.building = Some(Building { first, nodes: Vec::new(), parts: 0 });
        Some(Open { making, inverse, outer: None })
    }

    /// Ends an operation: all of its parts are there.
    pub(super) fn close(&mut self, open: Open) {
        let Some(building) = &mut self.building else { return };
        let Open { making, inverse, outer } = open;
        if building.parts > 1 {
            building.nodes.extend(making.nodes(building.parts, inverse));
        }
        let Some(outer) = outer else { return self.finish() };
        building.parts = outer + building.parts.min(1);
    }

    /// The whole that an object placed now is a part of.
    pub(super) fn leaf(&mut self, inverse: bool) -> Option<u32> {
        let building = self.building.as_mut()?;
        building.nodes.push(Node::Leaf { inverse });
        building.parts += 1;
        Some(self.world.wholes.len() as u32)
    }

    fn finish(&mut self) {
        let Some(Building { first, nodes, .. }) = self.building.take() else { return };
        match &mut self.world.objects[first as usize..] {
            [] => {}
            [only] => only.whole = None,
            leaves => {
                let count = leaves.len() as u32;
                self.world.wholes.push(Whole { nodes, first, count });
            }
        }
    }
}
