//! The grid of an area light, as the scene has it.
//!
//! The grid is a block of nodes; its light is the mean of its four corners, or the mean of four blocks into which it
//! is divided in the middle. An odd number of nodes shares the node in the middle. A block is divided if it has nodes
//! that are not corners, and if its corners differ, or the light asks for more divisions. Where all are divided, the
//! light is a mean of all nodes, with weights that are the same at all places.
//!
//! **Source:** POV-Ray 3.7 manual, section "Area Lights"; where it leaves something open, the program's behaviour,
//! measured to 1/65,535 with grids of 1 × 1 to 17 × 17 nodes.

use std::collections::BTreeMap;

use super::super::Walk;
use super::sight::{Seen, Sight};
use crate::color::Rgb;
use crate::math::wide::{ROW, Row, Rows, numbers};
use crate::world::Area;

/// Corners that differ by more than this, summed over the components of the light, divide a block.
const LEAST_DIFFERENCE: f64 = 0.1;

/// Nodes that are remembered, so that the blocks around one share it.
const REMEMBERED: u64 = 1 << 16;

/// How often blocks are divided before any node is looked at, at most.
const AT_ONCE: u32 = 3;

/// A block of nodes.
#[derive(Debug, Clone, Copy)]
struct Block {
    low: [u32; 2],
    high: [u32; 2],
    /// Its share of the light.
    weight: f64,
    /// The places of its corners' factors.
    corners: [u32; 4],
}

impl Block {
    fn whole(area: &Area) -> Self {
        Self::new([0; 2], area.nodes.map(|count| count - 1), 1.0)
    }

    fn new(low: [u32; 2], high: [u32; 2], weight: f64) -> Self {
        Self { low, high, weight, corners: [0; 4] }
    }

    /// Returns the corners; the two that differ along one side only are neighbours.
    #[inline(always)]
    fn corner_nodes(&self) -> [[u32; 2]; 4] {
        let ([i, j], [k, l]) = (self.low, self.high);
        [[i, j], [k, j], [k, l], [i, l]]
    }

    fn is_divisible(&self) -> bool {
        (0..2).any(|side| self.high[side] - self.low[side] > 1)
    }

    /// Adds its parts.
    #[inline(always)]
    fn divide(&self, parts: &mut Vec<Self>) {
        let halves = |side: usize| {
            let (low, high) = (self.low[side], self.high[side]);
            let half = (high - low) / 2;
            ([(low, low + half), (high - half, high)], if low == high { 1 } else { 2 })
        };
        let ((across, columns), (along, rows)) = (halves(0), halves(1));
        let weight = self.weight / (columns * rows) as f64;
        for &(i, k) in &across[..columns] {
            for &(j, l) in &along[..rows] {
                parts.push(Self::new([i, j], [k, l], weight));
            }
        }
    }
}

/// Nodes that are looked at together, and their shares of the light.
pub(in crate::trace) struct NodeRow {
    pub nodes: [[u32; 2]; ROW],
    pub weights: Row,
    pub count: usize,
}

/// What is looked at first of a grid.
pub(in crate::trace) struct Start {
    pub rows: Vec<NodeRow>,
    /// Blocks with these nodes as corners, which may be divided; `None` if the rows have all nodes.
    blocks: Option<Vec<Block>>,
    divisions: u32,
}

impl Start {
    pub fn new(area: &Area) -> Self {
        // Until there are as many as are looked at together, nothing is looked at that is divided anyway.
        let divisions =
            area.nodes.map(|count| (count - 1).max(1).next_power_of_two().trailing_zeros());
        let count = area.nodes.into_iter().map(u64::from).product::<u64>();
        let is_all = area.least_divisions >= divisions[0].max(divisions[1]) && count <= REMEMBERED;
        let divisions = area.least_divisions.min(if is_all { u32::MAX } else { AT_ONCE });
        let mut blocks = vec![Block::whole(area)];
        for _ in 0..divisions {
            let mut finer = Vec::new();
            for block in blocks.drain(..) {
                match block.is_divisible() {
                    true => block.divide(&mut finer),
                    false => finer.push(block),
                }
            }
            blocks = finer;
            if blocks.iter().all(|block| !block.is_divisible()) {
                break;
            }
        }
        let mut weights: Vec<([u32; 2], f64)> = Vec::new();
        let mut known = BTreeMap::new();
        for block in &mut blocks {
            let nodes = block.corner_nodes();
            for (corner, node) in block.corners.iter_mut().zip(nodes) {
                *corner = *known.entry(node).or_insert(weights.len() as u32);
                if *corner as usize == weights.len() {
                    weights.push((node, 0.0));
                }
                weights[*corner as usize].1 += block.weight * 0.25;
            }
        }
        let together = |some: &[([u32; 2], f64)]| {
            let mut row = NodeRow { nodes: [[0; 2]; ROW], weights: [0.0; ROW], count: some.len() };
            for (number, (node, weight)) in some.iter().enumerate() {
                (row.nodes[number], row.weights[number]) = (*node, *weight);
            }
            row
        };
        let rows = weights.chunks(ROW).map(together).collect();
        Self { rows, blocks: (!is_all).then_some(blocks), divisions }
    }
}

/// What is known of the nodes of the light at hand. Kept from light to light for its memory.
#[derive(Debug, Default)]
pub(in crate::trace) struct Nodes {
    /// The number of the light at hand, among those of the thread.
    now: u32,
    /// For each node the last light that asked for it, and the place of its factor.
    places: Vec<(u32, u32)>,
    /// The part of the light of each node that comes to the surface.
    factors: Vec<Rgb>,
    /// Nodes without a factor: those from this place on are asked for.
    asked: Vec<[u32; 2]>,
    /// Blocks at hand, and those that they are divided into.
    blocks: Vec<Block>,
    finer: Vec<Block>,
}

impl Nodes {
    fn begin(&mut self, area: &Area) {
        self.now = self.now.wrapping_add(1);
        if self.now == 0 {
            self.places.clear();
            self.now = 1;
        }
        let count = area.nodes.into_iter().map(u64::from).product::<u64>().min(REMEMBERED) as usize;
        if self.places.len() < count {
            self.places.resize(count, (0, 0));
        }
        self.factors.clear();
        self.asked.clear();
        self.blocks.clear();
    }

    /// Returns the place of a node's factor; asks for it if it is not known.
    fn place(&mut self, area: &Area, node: [u32; 2]) -> u32 {
        let index = u64::from(node[0]) * u64::from(area.nodes[1]) + u64::from(node[1]);
        let place = self.places.get_mut(index as usize);
        if let Some((when, place)) = &place
            && *when == self.now
        {
            return *place;
        }
        let new = (self.factors.len() + self.asked.len()) as u32;
        self.asked.push(node);
        if let Some(place) = place {
            *place = (self.now, new);
        }
        new
    }
}

/// Returns what part of a light comes from the nodes of its grid; `color` is the light without shadows.
pub(super) fn visible(sight: &Sight, walk: &mut Walk, start: &Start, color: Rgb) -> Rgb {
    match &start.blocks {
        None => of_all(sight, walk, start),
        Some(blocks) => of_blocks(sight, walk, (start, blocks), color),
    }
}

fn of_all(sight: &Sight, walk: &mut Walk, start: &Start) -> Rgb {
    let (mut sum, mut white) = (Rgb::BLACK, 0.0);
    for (row, nodes) in start.rows.iter().enumerate() {
        let positions = sight.panel.positions(&sight.facing, row, nodes);
        match sight.look(walk, &positions, nodes.count) {
            Seen::Plain(lit) => numbers(lit).for_each(|number| white += nodes.weights[number]),
            Seen::Filtered(factors) => {
                let parts = factors.iter().zip(nodes.weights);
                parts.for_each(|(factor, weight)| sum += *factor * weight);
            }
        }
    }
    sum + Rgb::WHITE * white
}

fn of_blocks(
    sight: &Sight,
    walk: &mut Walk,
    (start, blocks): (&Start, &[Block]),
    color: Rgb,
) -> Rgb {
    let area = sight.of.area;
    let mut nodes = std::mem::take(&mut walk.nodes);
    nodes.begin(area);
    for (row, some) in start.rows.iter().enumerate() {
        let positions = sight.panel.positions(&sight.facing, row, some);
        nodes.look(sight, walk, &positions, some.count);
    }
    let first = nodes.factors.first().copied().unwrap_or(Rgb::BLACK);
    // Not before there are as many as are looked at in any case: a wire may be between them.
    let is_plain =
        start.divisions >= area.least_divisions && (first == Rgb::WHITE || first == Rgb::BLACK);
    if is_plain && nodes.factors.iter().all(|factor| *factor == first) {
        walk.nodes = nodes;
        return first;
    }
    for (place, node) in start.rows.iter().flat_map(|row| &row.nodes[..row.count]).enumerate() {
        nodes.remember(area, *node, place as u32);
    }
    nodes.blocks.extend_from_slice(blocks);
    let mut sum = Rgb::BLACK;
    let mut divisions = start.divisions;
    while !nodes.blocks.is_empty() && !walk.patience.is_over {
        let mut blocks = std::mem::take(&mut nodes.blocks);
        for block in &blocks {
            let mut corners = [Rgb::BLACK; 4];
            for (corner, place) in corners.iter_mut().zip(block.corners) {
                *corner = nodes.factors[place as usize];
            }
            let divides = block.is_divisible()
                && (divisions < area.least_divisions || differ(&corners, color));
            if divides {
                block.divide(&mut nodes.finer);
            } else {
                let all = corners.into_iter().fold(Rgb::BLACK, |sum, corner| sum + corner);
                sum += all * (block.weight * 0.25);
            }
        }
        blocks.clear();
        nodes.blocks = std::mem::replace(&mut nodes.finer, blocks);
        divisions += 1;
        nodes.find_corners(sight, walk);
    }
    walk.nodes = nodes;
    sum
}

impl Nodes {
    #[inline(always)]
    fn remember(&mut self, area: &Area, node: [u32; 2], place: u32) {
        let index = u64::from(node[0]) * u64::from(area.nodes[1]) + u64::from(node[1]);
        if let Some(known) = self.places.get_mut(index as usize) {
            *known = (self.now, place);
        }
    }

    /// Finds the factors of the corners of the blocks at hand.
    fn find_corners(&mut self, sight: &Sight, walk: &mut Walk) {
        let area = sight.of.area;
        let mut blocks = std::mem::take(&mut self.blocks);
        for block in &mut blocks {
            let nodes = block.corner_nodes();
            for (corner, node) in block.corners.iter_mut().zip(nodes) {
                *corner = self.place(area, node);
            }
        }
        self.blocks = blocks;
        let asked = std::mem::take(&mut self.asked);
        for asked in asked.chunks(ROW) {
            let mut positions = Rows::ZERO;
            for (number, &node) in asked.iter().enumerate() {
                positions.set(number, sight.panel.position(&sight.facing, node));
            }
            self.look(sight, walk, &positions, asked.len());
        }
        self.asked = asked;
        self.asked.clear();
    }

    /// Adds the factors of the first `count` of some positions.
    fn look(&mut self, sight: &Sight, walk: &mut Walk, positions: &Rows, count: usize) {
        match sight.look(walk, positions, count) {
            Seen::Plain(lit) => self.factors.extend(
                (0..count).map(
                    |number| {
                        if lit >> number & 1 == 1 { Rgb::WHITE } else { Rgb::BLACK }
                    },
                ),
            ),
            Seen::Filtered(factors) => self.factors.extend(&factors[..count]),
        }
    }
}

/// Returns whether two neighbours among the corners of a block differ.
#[inline(always)]
fn differ(corners: &[Rgb; 4], color: Rgb) -> bool {
    let [a, b, c, d] = *corners;
    let apart = |one: Rgb, other: Rgb| {
        let (one, other) = (one * color, other * color);
        let difference = (one.red - other.red).abs()
            + (one.green - other.green).abs()
            + (one.blue - other.blue).abs();
        difference > LEAST_DIFFERENCE
    };
    // Most are alike.
    let is_same = |one: Rgb, other: Rgb| one == other;
    !(is_same(a, b) && is_same(b, c) && is_same(c, d))
        && (apart(a, b) || apart(b, c) || apart(c, d) || apart(d, a))
}
