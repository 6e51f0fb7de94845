//! Pieces that may be between a point and a box: one search for all rays from the one to the other.
//!
//! **In:** a [`Shaft`]. **Out:** runs of pieces. **Invariant:** no piece is skipped that a ray from the point to a place
//! in the box meets on its way.
//!
//! At the part t of the way, 0 … 1, all these rays are within a box whose sides are linear in t. A box of the tree is
//! met where the two overlap along each axis: six linear inequalities in t, as for a ray and the slabs of a box.
//!
//! **Source:** shafts between objects: E. Haines, J. Wallace, "Shaft culling for efficient ray-cast radiosity",
//! Eurographics Workshop on Rendering, 1991.

use std::ops::Range;

use smallvec::SmallVec;

use super::{Child, FAR, Node, OUTWARD, STACK, STEEPEST, Space, Tree};
use crate::math::bounds::Bounds;
use crate::math::{Lanes, Vector};

/// All rays from a point to the places in a box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shaft {
    pub from: Vector,
    pub to: Bounds,
}

/// A side of the cross-section of a shaft, in the tree's space: before `plane`, or behind it, at each t for which
/// t · slope is beyond plane − start.
#[derive(Clone, Copy)]
struct Side {
    /// 0: it has to be beyond the low plane of a box, 1: before the high one.
    plane: usize,
    start: Lanes,
    reciprocal: Lanes,
    /// It has to be so from some t on, rather than up to some t.
    enters: bool,
}

impl Side {
    fn new(plane: usize, start: f64, end: f64) -> Self {
        let reciprocal = (1.0 / (end - start)).clamp(-STEEPEST, STEEPEST) as f32;
        let enters = (reciprocal > 0.0) == (plane == 0);
        let (start, reciprocal) = (Lanes::splat(start as f32), Lanes::splat(reciprocal));
        Self { plane, start, reciprocal, enters }
    }
}

/// A shaft in the tree's space.
struct Slanted {
    sides: [[Side; 2]; 3],
}

impl Slanted {
    /// Returns `None` if the shaft is so far off, or so large, that its crossings mean nothing in `f32`.
    fn new(shaft: &Shaft, space: &Space) -> Option<Self> {
        let [from, low, high] = [shaft.from, shaft.to.low, shaft.to.high]
            .map(|place| (place - space.origin) * space.scale);
        let size = from.abs().max(low.abs()).max(high.abs()).max_element();
        // NaN is not.
        let is_in_range = size < FAR;
        if !is_in_range {
            return None;
        }
        // Covers the rounding of starts and slopes to `f32`, and what the kernels' `f64` may be off.
        let padding = (1.0 + size) * f64::from(f32::EPSILON);
        let axis = |axis: usize| {
            let (from, low, high) = (from[axis], low[axis], high[axis]);
            [
                Side::new(0, from + padding, high + 2.0 * padding),
                Side::new(1, from - padding, low - 2.0 * padding),
            ]
        };
        Some(Self { sides: [axis(0), axis(1), axis(2)] })
    }

    /// Returns a bit for each box of a node that the shaft may meet.
    #[inline(always)]
    fn meets(&self, node: &Node) -> u32 {
        let (mut entry, mut exit) = (Lanes::ZERO, Lanes::ONE);
        for (sides, planes) in self.sides.iter().zip(&node.planes) {
            for side in sides {
                let t = (planes[side.plane] - side.start) * side.reciprocal;
                match side.enters {
                    true => entry = entry.max(t),
                    false => exit = exit.min(t),
                }
            }
        }
        entry.cmple(exit * OUTWARD).bitmask()
    }
}

impl Tree {
    /// Shows `leaf` every run of pieces whose box a shaft may meet, until it returns false; calls `node` for each visit
    /// to a node.
    #[inline(never)]
    pub fn visit_between(
        &self,
        shaft: &Shaft,
        mut node: impl FnMut(),
        mut leaf: impl FnMut(Range<usize>) -> bool,
    ) {
        let Some(slanted) = Slanted::new(shaft, &self.space) else {
            leaf(0..self.count);
            return;
        };
        let mut stack: SmallVec<[Child; STACK]> = SmallVec::new();
        let mut child = Child::node(0);
        loop {
            if child.is_leaf() {
                if !leaf(child.pieces()) {
                    return;
                }
            } else {
                node();
                let node = &self.nodes[child.0 as usize];
                let mut mask = slanted.meets(node);
                while mask != 0 {
                    stack.push(node.children[(mask.trailing_zeros() & 3) as usize]);
                    mask &= mask - 1;
                }
            }
            match stack.pop() {
                Some(next) => child = next,
                None => return,
            }
        }
    }
}
