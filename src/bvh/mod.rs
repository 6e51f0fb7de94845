//! Bounding volume hierarchy, four boxes to a node, in `f32`: finds the pieces that a ray may meet.
//!
//! **In:** the bounds of the pieces, a ray. **Out:** runs of pieces, near ones first. **Invariant:** no box
//! that contains a crossing in `f64` is skipped. The boxes are relative to the tree's own origin and a power
//! of two, rounded outward, so nothing overflows, and scaling a scene by a power of two gives the same tree.
//!
//! **Source:** T. Ize, "Robust BVH ray traversal", JCGT 2 (2), 2013; the widths of boxes tested
//! together: I. Wald, C. Benthin, S. Boulos, "Getting rid of packets", RT 2008.

mod build;
pub(crate) mod packet;
pub(crate) mod shaft;
#[cfg(test)]
mod tests;

use std::ops::Range;

use smallvec::SmallVec;

use crate::math::bounds::Bounds;
use crate::math::ray::Ray;
use crate::math::{Lanes, Vector};

/// No leaf lies deeper: splits by cost end at half of it, the rest are by halves.
pub const DEPTH: usize = 64;
/// At most three siblings of every node on the path down wait.
const STACK: usize = 256;
const _: () = assert!(STACK > 3 * DEPTH);
/// Most pieces of a leaf that a [`Child`] can name.
const LEAF: usize = 15;
/// Distances from the tree beyond which no slab test can be trusted (in the tree's own size).
const FAR: f64 = (1u64 << 58) as f64;
/// Stands for 1/0: with the least padding, a slab it is in is never left.
const STEEPEST: f64 = (1u128 << 100) as f64;
/// 1 + 2γ₃ and a little more: of entry and exit each, the reciprocal, the difference and the
/// product are rounded.
const OUTWARD: f32 = 1.0 + 4.0 * f32::EPSILON;

/// Looks for something among the pieces that a ray may meet.
pub trait Seeker {
    /// Looks at a run of pieces; returns the limit from then on (−∞ ends the search).
    fn leaf(&mut self, pieces: Range<usize>, limit: f64) -> f64;

    /// Takes note of a visit to a node.
    #[inline(always)]
    fn node(&mut self) {}
}

impl<F: FnMut(Range<usize>, f64) -> f64> Seeker for F {
    #[inline(always)]
    fn leaf(&mut self, pieces: Range<usize>, limit: f64) -> f64 {
        self(pieces, limit)
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Tree {
    pub space: Space,
    /// The first is the root.
    nodes: Vec<Node>,
    /// Number of pieces in all leaves.
    count: usize,
}

/// Where the tree's coordinates are −1 … 1: `(p − origin) · scale`, `scale` a power of two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Space {
    pub origin: Vector,
    pub scale: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
struct Node {
    /// For each axis the low and the high planes of the four boxes. An absent child's are
    /// inside out, so no ray is in it.
    pub planes: [[Lanes; 2]; 3],
    pub children: [Child; 4],
}

/// Another node, or a run of up to 15 leaf entries: the highest bit tells which, four bits count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Child(u32);

impl Child {
    const IS_LEAF: u32 = 1 << 31;
    /// A leaf without pieces.
    const ABSENT: Self = Self(Self::IS_LEAF);

    pub fn node(index: usize) -> Self {
        Self(index as u32)
    }

    pub fn leaf(range: Range<usize>) -> Self {
        Self(Self::IS_LEAF | (range.start as u32) << 4 | range.len() as u32)
    }

    fn is_leaf(self) -> bool {
        self.0 & Self::IS_LEAF != 0
    }

    fn is_absent(self) -> bool {
        self == Self::ABSENT
    }

    /// Of a leaf.
    #[inline(always)]
    fn pieces(self) -> Range<usize> {
        let start = ((self.0 & !Self::IS_LEAF) >> 4) as usize;
        start..start + (self.0 & 15) as usize
    }
}

impl Node {
    pub const EMPTY: Self =
        Self { planes: [[Lanes::INFINITY, Lanes::NEG_INFINITY]; 3], children: [Child::ABSENT; 4] };

    /// How far off the ray enters each box, and a bit for each it does enter before `limit`.
    #[inline(always)]
    fn entries(&self, ray: &Slanted, limit: f32) -> (Lanes, u32) {
        let mut entry = Lanes::ZERO;
        let mut exit = Lanes::splat(limit);
        for axis in 0..3 {
            let Axis { near, near_start, far_start, reciprocal } = ray.axes[axis];
            let [near, far] = [self.planes[axis][near & 1], self.planes[axis][1 - (near & 1)]];
            entry = entry.max((near - near_start) * reciprocal);
            exit = exit.min((far - far_start) * reciprocal);
        }
        (entry, entry.cmple(exit * OUTWARD).bitmask())
    }
}

/// A ray in the tree's space, made for slab tests that err outward only.
struct Slanted {
    axes: [Axis; 3],
}

#[derive(Clone, Copy)]
struct Axis {
    /// 0 or 1: which of the two planes comes first.
    near: usize,
    /// The start, padded so that the near plane is met sooner, the far plane later.
    near_start: Lanes,
    far_start: Lanes,
    reciprocal: Lanes,
}

/// Along each axis: the start for the near plane, the start for the far plane, and the reciprocal of the direction.
type Starts = [[f32; 3]; 3];

/// `None` when the ray starts so far off that its crossings mean nothing in `f32`.
#[inline(always)]
fn starts(ray: &Ray, slack: f64, space: &Space) -> Option<Starts> {
    let start = (ray.origin - space.origin) * space.scale;
    let size = start.abs().max_element();
    let is_in_range = size < FAR && slack * space.scale < FAR;
    if !is_in_range {
        return None;
    }
    // Covers the rounding of the start to `f32`, and what the kernels' `f64` may be off.
    let least = (1.0 + size) * (1.0 / (1u64 << 40) as f64) + slack * space.scale;
    let axis = |axis: usize| {
        let reciprocal = (1.0 / ray.direction[axis]).clamp(-STEEPEST, STEEPEST);
        let padding = start[axis].abs() * f64::from(f32::EPSILON) + least;
        let padding = padding.copysign(reciprocal);
        [(start[axis] + padding) as f32, (start[axis] - padding) as f32, reciprocal as f32]
    };
    Some([axis(0), axis(1), axis(2)])
}

impl Slanted {
    /// `None` as of [`starts`].
    #[inline(always)]
    fn new(ray: &Ray, slack: f64, space: &Space) -> Option<Self> {
        let starts = starts(ray, slack, space)?;
        let axis = |axis: usize| {
            let [near_start, far_start, reciprocal] = starts[axis].map(Lanes::splat);
            Axis { near: usize::from(reciprocal.x < 0.0), near_start, far_start, reciprocal }
        };
        Some(Self { axes: [axis(0), axis(1), axis(2)] })
    }
}

impl Space {
    /// A ray of the same line that starts before all of the tree.
    pub fn before(&self, ray: &Ray) -> Ray {
        let along = (ray.origin - self.origin).dot(ray.direction) * self.scale;
        // Turned round where it goes away: so it is never moved far, and rounding moves it little.
        let direction = if along > 0.0 { -ray.direction } else { ray.direction };
        let back = if along.abs() < 4.0 { 8.0 / self.scale } else { 0.0 };
        Ray { origin: ray.origin - direction * back, direction }
    }

    /// A ray of the same line that starts at `t`; `None` where that is so far off that rounding might move it by
    /// more than the boxes have room for.
    pub fn moved_to(&self, ray: &Ray, t: f64) -> Option<Ray> {
        let far = t.abs() + ray.origin.abs().max_element();
        let is_near = far * self.scale < 1024.0;
        is_near.then(|| Ray { origin: ray.at(t), direction: ray.direction })
    }

    /// Not under `t` in the tree's space.
    #[inline]
    fn limit(&self, t: f64) -> f32 {
        ((t * self.scale) as f32).next_up()
    }

    /// The box in the tree's space, rounded outward: `f32`'s neighbour is farther off than what
    /// the difference in `f64` may be.
    pub fn outward(&self, bounds: &Bounds) -> [Lanes; 2] {
        let [low, high] = [bounds.low, bounds.high].map(|p| (p - self.origin) * self.scale);
        let lanes = |v: Vector, round: fn(f32) -> f32| {
            Lanes::new(round(v.x as f32), round(v.y as f32), round(v.z as f32), 0.0)
        };
        [lanes(low, f32::next_down), lanes(high, f32::next_up)]
    }
}

impl Tree {
    /// Shows `seeker` every run of pieces whose box the ray meets, or passes by at most `slack`, at `limit` or
    /// before. Near boxes come first.
    // However many kernels call it, it is the same code.
    #[inline(never)]
    pub fn visit(&self, ray: &Ray, slack: f64, limit: f64, seeker: &mut impl Seeker) {
        let Some(slanted) = Slanted::new(ray, slack, &self.space) else {
            seeker.leaf(0..self.count, limit);
            return;
        };
        let mut reach = limit;
        let mut limit = self.space.limit(reach);
        let mut stack: SmallVec<[(f32, Child); STACK]> = SmallVec::new();
        let mut child = Child::node(0);
        loop {
            if !child.is_leaf() {
                seeker.node();
                let node = &self.nodes[child.0 as usize];
                let (entry, mut mask) = node.entries(&slanted, limit);
                if mask != 0 {
                    // The nearest is next, the others wait, the nearest of them on top.
                    let entry = entry.to_array();
                    let lane = (mask.trailing_zeros() & 3) as usize;
                    let mut next = (entry[lane], node.children[lane]);
                    mask &= mask - 1;
                    let (mut waiting, mut count) = ([(0.0, Child::ABSENT); 3], 0);
                    while mask != 0 {
                        let lane = (mask.trailing_zeros() & 3) as usize;
                        mask &= mask - 1;
                        let mut other = (entry[lane], node.children[lane]);
                        if other.0 < next.0 {
                            (next, other) = (other, next);
                        }
                        let mut place = count;
                        while place > 0 && waiting[place - 1].0 < other.0 {
                            waiting[place] = waiting[place - 1];
                            place -= 1;
                        }
                        waiting[place] = other;
                        count += 1;
                    }
                    waiting[..count].iter().for_each(|child| stack.push(*child));
                    child = next.1;
                    continue;
                }
            } else {
                let reached = seeker.leaf(child.pieces(), reach);
                // Seldom: most leaves change nothing.
                if reached != reach {
                    reach = reached;
                    limit = self.space.limit(reach);
                }
            }
            child = loop {
                match stack.pop() {
                    Some((entry, child)) if entry <= limit => break child,
                    Some(_) => {}
                    None => return,
                }
            };
        }
    }

    /// Returns the maximum of `leaf` over runs of pieces. Up to rounding, `leaf` must not exceed the maximum of
    /// `along`·P over the box of its run.
    pub fn greatest(&self, along: Vector, leaf: impl Fn(Range<usize>) -> f64) -> f64 {
        let Space { origin, scale } = self.space;
        let most = |node: &Node, lane: usize| {
            let plane =
                |side: usize| [0, 1, 2].map(|axis| f64::from(node.planes[axis][side][lane]));
            let [low, high] = [plane(0), plane(1)].map(|p| Vector::from_array(p) / scale + origin);
            (low * along).max(high * along).element_sum()
        };
        let mut best = f64::NEG_INFINITY;
        let mut stack: SmallVec<[(f64, Child); 64]> =
            SmallVec::from_slice(&[(f64::INFINITY, Child::node(0))]);
        while let Some((bound, child)) = stack.pop() {
            if bound <= best {
                continue;
            }
            if child.is_leaf() {
                best = best.max(leaf(child.pieces()));
                continue;
            }
            let node = &self.nodes[child.0 as usize];
            let bottom = stack.len();
            let present = (0..4).filter(|&lane| !node.children[lane].is_absent());
            stack.extend(present.map(|lane| (most(node, lane), node.children[lane])));
            stack[bottom..].sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        best
    }
}
