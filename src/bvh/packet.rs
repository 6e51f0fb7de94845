//! Rays that go together: a box that misses the whole packet is tested once for all of them.
//!
//! **In:** up to [`MOST`] rays, each with a limit. **Out:** for each ray, runs of pieces, near ones first.
//! **Invariant:** a ray is shown the leaves whose boxes it meets by the test of a single ray. What is computed for
//! the packet bounds what is computed for each of its rays, rounding included, since the rounded difference and
//! product are monotonic.
//!
//! **Source:** interval arithmetic over a packet: S. Boulos, I. Wald, P. Shirley, "Geometric and arithmetic
//! culling methods for entire ray packets", technical report UUCS-06-010, University of Utah, 2006; rays in
//! ranges: R. Overbeck, R. Ramamoorthi, W. Mark, "Large ray packets for real-time Whitted ray tracing", RT 2008.

use std::ops::Range;

use smallvec::SmallVec;

use super::{Child, FAR, Node, OUTWARD, STACK, STEEPEST, Seeker, Space, Tree};
use crate::math::Lanes;
use crate::math::wide::*;

/// The most rays of a packet.
pub const MOST: usize = ROW;
const WIDTH: usize = 4;
/// Fewer rays are faster one by one.
pub const LEAST: u32 = 4;

/// Looks for something for each ray of a packet among the pieces that it may meet.
pub trait PacketSeeker {
    /// Looks at a run of pieces for the rays whose bits are set.
    fn leaf(&mut self, mask: u32, pieces: Range<usize>);

    /// Returns how far each ray goes; −∞ where its search has ended.
    fn limits(&self) -> &Row;

    /// Returns the instructions to search with.
    fn instructions(&self) -> Instructions {
        Instructions::best()
    }

    /// Takes note of a visit to a node.
    fn node(&mut self);
}

/// One ray of a packet by itself.
struct Alone<'a, S> {
    seeker: &'a mut S,
    ray: usize,
}

impl<S: PacketSeeker> Seeker for Alone<'_, S> {
    fn leaf(&mut self, pieces: Range<usize>, _: f64) -> f64 {
        self.seeker.leaf(1 << self.ray, pieces);
        self.seeker.limits()[self.ray]
    }

    fn node(&mut self) {
        self.seeker.node();
    }
}

/// Rays in the tree's space, side by side, and what bounds them all.
struct Packet {
    axes: [PacketAxis; 3],
    /// By which each ray is out of the race; −∞ where there is no ray.
    limits: [f32; MOST],
    /// The greatest of these.
    limit: f32,
}

#[derive(Clone, Copy)]
struct PacketAxis {
    /// 0 or 1: which of the two planes comes first, for all rays.
    near: usize,
    /// Those of the rays, as by [`starts`](super::starts); where there is no ray, those of the first.
    near_start: [f32; MOST],
    far_start: [f32; MOST],
    reciprocal: [f32; MOST],
    /// The starts from which the near plane is met soonest and the far plane latest.
    soonest: Lanes,
    latest: Lanes,
    /// The least and the greatest reciprocal.
    reciprocals: [Lanes; 2],
}

impl PacketAxis {
    const NONE: Self = Self {
        near: 0,
        near_start: [0.0; MOST],
        far_start: [0.0; MOST],
        reciprocal: [0.0; MOST],
        soonest: Lanes::ZERO,
        latest: Lanes::ZERO,
        reciprocals: [Lanes::ZERO; 2],
    };

    /// Finds what [`starts`](super::starts) says of an axis; returns whether all rays go the same way along it.
    #[inline(always)]
    fn find<S: Simd>(
        &mut self,
        simd: S,
        rays: &Rays,
        axis: usize,
        (least, space): (&Row, &Space),
    ) -> bool {
        let [mut near, mut far, mut reciprocals] = [[0.0; MOST]; 3];
        let (steepest, epsilon) = (all(simd, STEEPEST), all(simd, f64::from(f32::EPSILON)));
        let mut backward = 0;
        for group in 0..GROUPS {
            let start = four(simd, &rays.origins.0[axis], group);
            let start = (start - all(simd, space.origin[axis])) * all(simd, space.scale);
            let reciprocal = all(simd, 1.0) / four(simd, &rays.directions.0[axis], group);
            let reciprocal = reciprocal.simd_gt(steepest).select(steepest, reciprocal);
            let reciprocal = reciprocal.simd_lt(-steepest).select(-steepest, reciprocal);
            let padding = start.abs() * epsilon + four(simd, least, group);
            let padding = padding.copysign(reciprocal);
            store(start + padding, &mut near, group);
            store(start - padding, &mut far, group);
            store(reciprocal, &mut reciprocals, group);
            backward |= bits(reciprocal.simd_lt(all(simd, 0.0)), group);
        }
        let first = (rays.mask.trailing_zeros() as usize) % MOST;
        for number in numbers(!rays.mask & ((1 << MOST) - 1)) {
            near[number] = near[first];
            far[number] = far[first];
            reciprocals[number] = reciprocals[first];
        }
        for number in 0..MOST {
            self.near_start[number] = near[number] as f32;
            self.far_start[number] = far[number] as f32;
            self.reciprocal[number] = reciprocals[number] as f32;
        }
        let backward = backward & rays.mask;
        self.near = usize::from(backward != 0);
        (self.soonest, self.latest) = match self.near {
            0 => (greatest(&self.near_start), least_of(&self.far_start)),
            _ => (least_of(&self.near_start), greatest(&self.far_start)),
        };
        self.reciprocals = [least_of(&self.reciprocal), greatest(&self.reciprocal)];
        backward == 0 || backward == rays.mask
    }
}

impl Packet {
    const NONE: Self = Self { axes: [PacketAxis::NONE; 3], limits: [0.0; MOST], limit: 0.0 };

    /// Finds the rays in the tree's space; returns whether all go the same way along each axis, and none starts too
    /// far off.
    #[inline(always)]
    fn find<S: Simd>(
        &mut self,
        simd: S,
        rays: &Rays,
        slack: f64,
        limits: &Row,
        space: &Space,
    ) -> bool {
        let slack = slack * space.scale;
        let (far, mut least, mut in_range) = (all(simd, FAR), [0.0; MOST], 0);
        for group in 0..GROUPS {
            let start = WideVector::of(simd, &rays.origins, group);
            let start = start - WideVector::splat(simd, space.origin);
            let WideVector([x, y, z]) = (start * all(simd, space.scale)).abs();
            let size = x.simd_gt(y).select(x, y);
            let size = size.simd_gt(z).select(size, z);
            in_range |= bits(x.simd_lt(far) & y.simd_lt(far) & z.simd_lt(far), group);
            let own = (all(simd, 1.0) + size) * all(simd, 1.0 / (1u64 << 40) as f64);
            store(own + all(simd, slack), &mut least, group);
        }
        if in_range & rays.mask != rays.mask || slack >= FAR {
            return false;
        }
        let mut is_coherent = true;
        for (number, axis) in self.axes.iter_mut().enumerate() {
            is_coherent &= axis.find(simd, rays, number, (&least, space));
        }
        self.limits = [f32::NEG_INFINITY; MOST];
        for number in numbers(rays.mask) {
            self.limits[number] = space.limit(limits[number]);
        }
        self.limit = self.greatest_limit();
        is_coherent
    }

    #[inline(always)]
    fn greatest_limit(&self) -> f32 {
        greatest(&self.limits).x
    }

    /// Not beyond where any of the rays enters each box, and a bit for each that one of them may enter.
    #[inline(always)]
    fn entries(&self, node: &Node) -> (Lanes, u32) {
        let mut entry = Lanes::ZERO;
        let mut exit = Lanes::splat(self.limit);
        for (axis, planes) in self.axes.iter().zip(&node.planes) {
            let [near, far] = [planes[axis.near & 1], planes[1 - (axis.near & 1)]];
            let [least, greatest] = axis.reciprocals;
            let (near, far) = (near - axis.soonest, far - axis.latest);
            entry = entry.max((near * least).min(near * greatest));
            exit = exit.min((far * least).max(far * greatest));
        }
        (entry, entry.cmple(exit * OUTWARD).bitmask())
    }

    /// A bit for each ray of a group that enters a box of a node.
    #[inline(always)]
    fn enter(&self, group: usize, node: &Node, lane: usize) -> u32 {
        let mut entry = Lanes::ZERO;
        let mut exit = group_of(&self.limits, group);
        for (axis, planes) in self.axes.iter().zip(&node.planes) {
            let near = Lanes::splat(planes[axis.near & 1][lane]);
            let far = Lanes::splat(planes[1 - (axis.near & 1)][lane]);
            let reciprocal = group_of(&axis.reciprocal, group);
            entry = entry.max((near - group_of(&axis.near_start, group)) * reciprocal);
            exit = exit.min((far - group_of(&axis.far_start, group)) * reciprocal);
        }
        entry.cmple(exit * OUTWARD).bitmask()
    }
}

#[inline(always)]
fn group_of(values: &[f32; MOST], group: usize) -> Lanes {
    Lanes::from_slice(&values[WIDTH * group..WIDTH * group + WIDTH])
}

/// The least of values, in each lane.
#[inline(always)]
fn least_of(values: &[f32; MOST]) -> Lanes {
    let first = group_of(values, 0).min(group_of(values, 1));
    let second = group_of(values, 2).min(group_of(values, 3));
    Lanes::splat(first.min(second).min_element())
}

/// The greatest of values, in each lane.
#[inline(always)]
fn greatest(values: &[f32; MOST]) -> Lanes {
    let first = group_of(values, 0).max(group_of(values, 1));
    let second = group_of(values, 2).max(group_of(values, 3));
    Lanes::splat(first.max(second).max_element())
}

/// A child that waits, its node and lane, and where the first of the rays may enter it.
#[derive(Clone, Copy, Default)]
struct Waiting {
    entry: f32,
    child: Child,
    node: u32,
    lane: u32,
    /// The first group with a ray that enters it.
    group: usize,
}

impl Tree {
    /// Shows `seeker`, for each of up to [`MOST`] rays, every run of pieces whose box it meets, or passes by at
    /// most `slack`, at its limit or before. Fast where the rays go much the same way.
    #[inline(never)]
    pub fn visit_together(&self, rays: &Rays, slack: f64, seeker: &mut impl PacketSeeker) {
        let mut limits = *seeker.limits();
        let mut packet = Packet::NONE;
        let goes_together = rays.mask.count_ones() >= LEAST
            && dispatch!(
                seeker.instructions().level(),
                simd => packet.find(simd, rays, slack, &limits, &self.space)
            );
        if !goes_together {
            for ray in numbers(rays.mask) {
                self.visit(&rays.at(ray), slack, limits[ray], &mut Alone { seeker, ray });
            }
            return;
        }
        let groups = (u32::BITS - rays.mask.leading_zeros()).div_ceil(WIDTH as u32) as usize;
        let mut stack: SmallVec<[Waiting; STACK]> = SmallVec::new();
        let mut next = Waiting { child: Child::node(0), ..Waiting::default() };
        loop {
            let Waiting { child, node, lane, group: first, .. } = next;
            if child.is_leaf() {
                let node = &self.nodes[node as usize];
                let enters = |group| packet.enter(group, node, lane as usize) << (WIDTH * group);
                let mask = (first..groups).fold(0, |mask, group| mask | enters(group));
                if mask != 0 {
                    seeker.leaf(mask, child.pieces());
                    for ray in numbers(mask) {
                        let reached = seeker.limits()[ray];
                        if reached != limits[ray] {
                            limits[ray] = reached;
                            packet.limits[ray] = self.space.limit(reached);
                            packet.limit = packet.greatest_limit();
                        }
                    }
                }
            } else {
                seeker.node();
                let index = child.0;
                let node = &self.nodes[index as usize];
                let (entry, mut mask) = packet.entries(node);
                if mask != 0 {
                    // Those that a ray enters wait, the nearest on top.
                    let entry = entry.to_array();
                    let bottom = stack.len();
                    while mask != 0 {
                        let lane = (mask.trailing_zeros() & 3) as usize;
                        mask &= mask - 1;
                        let mut group = first;
                        while group < groups && packet.enter(group, node, lane) == 0 {
                            group += 1;
                        }
                        if group == groups {
                            continue;
                        }
                        let child = node.children[lane];
                        let (entry, lane) = (entry[lane], lane as u32);
                        let waiting = Waiting { entry, child, node: index, lane, group };
                        let mut place = stack.len();
                        stack.push(waiting);
                        while place > bottom && stack[place - 1].entry < entry {
                            stack.swap(place - 1, place);
                            place -= 1;
                        }
                    }
                }
            }
            next = loop {
                match stack.pop() {
                    Some(waiting) if waiting.entry <= packet.limit => break waiting,
                    Some(_) => {}
                    None => return,
                }
            };
        }
    }
}
