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

use super::{Child, Node, OUTWARD, STACK, Seeker, Space, Tree, starts};
use crate::math::Lanes;
use crate::math::wide::{ROW, Rays, Row, numbers};

/// The most rays of a packet.
pub const MOST: usize = ROW;
const WIDTH: usize = 4;
const GROUPS: usize = MOST / WIDTH;
/// Fewer rays are faster one by one.
pub const LEAST: u32 = 4;

/// Looks for something for each ray of a packet among the pieces that it may meet.
pub trait PacketSeeker {
    /// Looks at a run of pieces for the rays whose bits are set.
    fn leaf(&mut self, mask: u32, pieces: Range<usize>);

    /// Returns how far each ray goes; −∞ where its search has ended.
    fn limits(&self) -> &Row;

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

/// Rays in the tree's space, four to a group, and what bounds them all.
struct Packet {
    axes: [PacketAxis; 3],
    /// By which each ray is out of the race; −∞ where there is no ray.
    limits: [Lanes; GROUPS],
    /// The greatest of these.
    limit: f32,
}

struct PacketAxis {
    /// 0 or 1: which of the two planes comes first, for all rays.
    near: usize,
    /// Those of the rays, as by [`starts`].
    near_start: [Lanes; GROUPS],
    far_start: [Lanes; GROUPS],
    reciprocal: [Lanes; GROUPS],
    /// The starts from which the near plane is met soonest and the far plane latest.
    soonest: Lanes,
    latest: Lanes,
    /// The least and the greatest reciprocal.
    reciprocals: [Lanes; 2],
}

impl Packet {
    /// `None` where the rays do not all go the same way along each axis, or one starts too far off.
    fn new(rays: &Rays, slack: f64, limits: &Row, space: &Space) -> Option<Self> {
        // The starts and the reciprocals by axis; in lanes without a ray, those of the first.
        let first = starts(&rays.at(numbers(rays.mask).next()?), slack, space)?;
        let mut all = first.map(|axis| axis.map(|value| [value; MOST]));
        let mut out = [f32::NEG_INFINITY; MOST];
        for number in numbers(rays.mask) {
            let starts = starts(&rays.at(number), slack, space)?;
            out[number] = space.limit(limits[number]);
            for axis in 0..3 {
                if (starts[axis][2] < 0.0) != (first[axis][2] < 0.0) {
                    return None;
                }
                for value in 0..3 {
                    all[axis][value][number] = starts[axis][value];
                }
            }
        }
        let [x, y, z] = all.map(PacketAxis::new);
        let mut packet = Self { axes: [x, y, z], limits: groups(out), limit: 0.0 };
        packet.limit = packet.greatest_limit();
        Some(packet)
    }

    fn greatest_limit(&self) -> f32 {
        let all = self.limits.into_iter().fold(Lanes::NEG_INFINITY, Lanes::max);
        all.max_element()
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
        let mut exit = self.limits[group];
        for (axis, planes) in self.axes.iter().zip(&node.planes) {
            let [near, far] = [planes[axis.near & 1], planes[1 - (axis.near & 1)]]
                .map(|planes| Lanes::splat(planes[lane]));
            let reciprocal = axis.reciprocal[group];
            entry = entry.max((near - axis.near_start[group]) * reciprocal);
            exit = exit.min((far - axis.far_start[group]) * reciprocal);
        }
        entry.cmple(exit * OUTWARD).bitmask()
    }
}

impl PacketAxis {
    fn new([near_start, far_start, reciprocal]: [[f32; MOST]; 3]) -> Self {
        let near = usize::from(reciprocal[0] < 0.0);
        let [near_start, far_start, reciprocal] = [near_start, far_start, reciprocal].map(groups);
        let least = |all: [Lanes; GROUPS]| {
            Lanes::splat(all.into_iter().fold(Lanes::INFINITY, Lanes::min).min_element())
        };
        let greatest = |all: [Lanes; GROUPS]| {
            Lanes::splat(all.into_iter().fold(Lanes::NEG_INFINITY, Lanes::max).max_element())
        };
        let (soonest, latest) = match near {
            0 => (greatest(near_start), least(far_start)),
            _ => (least(near_start), greatest(far_start)),
        };
        let reciprocals = [least(reciprocal), greatest(reciprocal)];
        Self { near, near_start, far_start, reciprocal, soonest, latest, reciprocals }
    }
}

#[inline(always)]
fn groups(values: [f32; MOST]) -> [Lanes; GROUPS] {
    let group = |group: usize| Lanes::from_slice(&values[WIDTH * group..]);
    [group(0), group(1), group(2), group(3)]
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
        let packet = (rays.mask.count_ones() >= LEAST)
            .then(|| Packet::new(rays, slack, &limits, &self.space))
            .flatten();
        let Some(mut packet) = packet else {
            for ray in numbers(rays.mask) {
                self.visit(&rays.at(ray), slack, limits[ray], &mut Alone { seeker, ray });
            }
            return;
        };
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
                            packet.limits[ray / WIDTH][ray % WIDTH] = self.space.limit(reached);
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
