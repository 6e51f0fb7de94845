//! Lowers CSG solids: flattens the tree of operations to a list in postfix order.
//!
//! **Invariant:** no differences remain, and no inverse nodes: complements move to the leaves (de Morgan). A
//! node of one part is replaced by that part, and no node contains another of its kind; a solid of one leaf
//! is not a CSG solid.

use super::Lowering;
use super::cutaway::Part;
use super::empty::Known;
use crate::scene::Operation;
use crate::shape::csg::Node;
use crate::source::Site;
use crate::world::{CsgSolid, OperationOrigin};

/// A CSG solid under construction.
#[derive(Debug)]
pub(super) struct Building {
    /// Its first leaf in `World::objects`.
    first: u32,
    nodes: Vec<Node>,
    /// The innermost operation that is open.
    kind: Kind,
    /// The number of its parts so far.
    parts: u32,
    /// The operations that make it, as written.
    operations: Vec<OperationOrigin>,
    /// What is known of the parts; an operation that ends becomes one part.
    pub(super) known: Vec<Known>,
    /// What the leaves show, if the scene has `cutaway_textures`.
    pub(super) shown: Vec<Part>,
}

/// The effect of an operation on solids or on their complements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Union,
    Merge,
    Intersection,
    Clip { inverse: bool },
}

/// An operation whose parts are not complete.
#[derive(Debug, Clone, Copy)]
pub(super) struct Open {
    pub(super) making: Making,
    pub(super) inverse: bool,
    /// The site of its keyword.
    pub(super) site: Site,
    /// The number of known parts before it.
    pub(super) known: usize,
    /// The enclosing operation and its number of parts; `None` if this operation began the CSG solid.
    outer: Option<(Kind, u32)>,
}

/// The ways to combine several solids into one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Making {
    Union,
    Operation(Operation),
    /// An object, followed by its clipping objects.
    Clip,
}

impl Making {
    fn word(self) -> &'static str {
        match self {
            Self::Union => "union",
            Self::Operation(operation) => operation.word().name(),
            Self::Clip => "clipped_by",
        }
    }

    /// Returns whether it keeps what all parts contain, by de Morgan's laws.
    pub(super) fn intersects(self, inverse: bool) -> bool {
        self.kind(inverse) == Kind::Intersection
    }

    /// Returns the effect, by de Morgan's laws.
    fn kind(self, inverse: bool) -> Kind {
        match (self, inverse) {
            (Self::Clip, inverse) => Kind::Clip { inverse },
            (Self::Union, false) => Kind::Union,
            (Self::Operation(Operation::Merge), false)
            | (Self::Operation(Operation::Intersection | Operation::Difference), true) => {
                Kind::Merge
            }
            (Self::Operation(Operation::Intersection | Operation::Difference), false)
            | (Self::Union | Self::Operation(Operation::Merge), true) => Kind::Intersection,
        }
    }
}

impl Kind {
    fn is_clip(self) -> bool {
        match self {
            Self::Clip { .. } => true,
            Self::Union | Self::Merge | Self::Intersection => false,
        }
    }

    /// Returns the nodes that combine this many parts into one.
    fn nodes(self, parts: u32) -> impl Iterator<Item = Node> {
        let (first, last) = match self {
            Self::Union => (None, Node::Union(parts)),
            Self::Merge => (None, Node::Merge(parts)),
            Self::Intersection => (None, Node::Intersection(parts)),
            // The clipping objects are intersected first.
            Self::Clip { inverse } => {
                ((parts > 2).then_some(Node::Intersection(parts - 1)), Node::Clip { inverse })
            }
        };
        first.into_iter().chain([last])
    }
}

impl Lowering<'_, '_> {
    /// Opens an operation; returns `None` if its parts may stay separate objects.
    pub(super) fn open(&mut self, making: Making, inverse: bool, site: Site) -> Option<Open> {
        let kind = making.kind(inverse);
        let written = OperationOrigin { word: making.word(), site };
        if let Some(building) = &mut self.building {
            let outer = Some((building.kind, building.parts));
            let known = building.known.len();
            (building.kind, building.parts) = (kind, 0);
            building.operations.extend((making != Making::Union).then_some(written));
            return Some(Open { making, inverse, site, known, outer });
        }
        if kind == Kind::Union {
            return None;
        }
        let first = self.world.objects.len() as u32;
        let (nodes, known, shown) = (Vec::new(), Vec::new(), Vec::new());
        let operations = vec![written];
        self.building = Some(Building { first, nodes, kind, parts: 0, operations, known, shown });
        Some(Open { making, inverse, site, known: 0, outer: None })
    }

    /// Closes an operation after its last part.
    pub(super) fn close(&mut self, open: Open) {
        let Open { inverse, outer, site, .. } = open;
        if self.building.as_ref().is_some_and(|building| building.parts == 0) {
            self.nothing(inverse, site);
        }
        self.know_operation(&open);
        let Some(building) = &mut self.building else { return };
        let (kind, parts) = (building.kind, building.parts);
        // (A ∩ B) ∩ C is A ∩ B ∩ C.
        let melts = outer.is_some_and(|(outer, _)| outer == kind) && !kind.is_clip();
        if parts > 1 && !melts {
            building.nodes.extend(kind.nodes(parts));
        }
        match outer {
            None => self.finish(),
            Some((outer, before)) => {
                building.kind = outer;
                building.parts = before + if melts { parts } else { 1 };
            }
        }
    }

    /// Adds a part that is nowhere, or everywhere.
    pub(super) fn nothing(&mut self, inverse: bool, site: Site) {
        self.know_nothing(inverse, site);
        if let Some(building) = &mut self.building {
            building.nodes.push(if inverse { Node::Intersection(0) } else { Node::Merge(0) });
            building.parts += 1;
        }
    }

    /// Returns the CSG solid that an object placed now belongs to.
    pub(super) fn leaf(&mut self, inverse: bool) -> Option<u32> {
        let building = self.building.as_mut()?;
        building.nodes.push(Node::Leaf { inverse });
        building.parts += 1;
        Some(self.world.csg_solids.len() as u32)
    }

    /// Turns the parts of an unfinished CSG solid into separate objects.
    pub(super) fn leave_unfinished(&mut self) {
        let Some(building) = self.building.take() else { return };
        for part in &mut self.world.objects[building.first as usize..] {
            part.csg_solid = None;
        }
        self.show_own(building.first, building.shown);
    }

    fn finish(&mut self) {
        let Some(building) = self.building.take() else { return };
        let Building { first, nodes, operations, shown, .. } = building;
        match &mut self.world.objects[first as usize..] {
            [] => {}
            [only] if nodes.len() == 1 => {
                only.csg_solid = None;
                self.show_own(first, shown);
            }
            leaves => {
                let count = leaves.len() as u32;
                let cutaway = self.cut_away(first, shown);
                self.world.csg_solids.push(CsgSolid { nodes, first, count, cutaway });
                self.origins.operations.extend(operations);
            }
        }
    }
}
