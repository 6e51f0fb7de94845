//! Area lights: a grid of lights instead of one, which makes soft shadows.
//!
//! **In:** a light with an [`Area`], and a place on a surface. **Out:** the part of the light that comes there.
//! **Invariant:** it depends on the place and the light alone; random numbers are numbered by both and by the
//! node.
//!
//! The grid is a block of nodes; its light is the mean of its four corners, or the mean of four blocks into which it
//! is divided in the middle. An odd number of nodes shares the node in the middle. A block is divided if it has nodes
//! that are not corners, and if its corners differ, or the light asks for more divisions.
//!
//! **Source:** POV-Ray 3.7 manual, section "Area Lights"; where it leaves something open, the program's behaviour,
//! measured to 1/65,535 with grids of 1 × 1 to 17 × 17 nodes.

use super::Walk;
use super::media::Within;
use super::shade::{self, Place, Side};
use super::shadow::{self, Aim};
use super::surface_batch::{ShadedSurface, SurfaceBatch};
use super::tracer::Tracer;
use crate::color::Rgb;
use crate::math::random::Random;
use crate::math::wide::{ROW, Rays, numbers};
use crate::math::{UnitVector, Vector};
use crate::shape::Ray;
use crate::world::{Area, Beam, Light, LightKind};

/// Corners that differ by more than this, summed over the components of the light, divide a block.
const LEAST_DIFFERENCE: f64 = 0.1;

/// By how much of its sides a circular light is beside its place (measured).
const CIRCULAR_OFFSET: f64 = 0.001;

/// Begins the numbers of jitter.
const SEED: u64 = 0x6172_6561_0000_0000;

/// Nodes that are remembered, so that the blocks around one share it.
const REMEMBERED: u64 = 1 << 16;

/// A light with an area, and its number.
#[derive(Clone, Copy)]
pub(super) struct AreaLight<'a> {
    pub number: usize,
    pub light: &'a Light,
    pub area: &'a Area,
}

impl<'a> AreaLight<'a> {
    /// Returns a light, if it has an area.
    #[inline(always)]
    pub fn of(number: usize, light: &'a Light) -> Option<Self> {
        light.area.as_ref().map(|area| Self { number, light, area })
    }

    /// Returns a light, if it illuminates by all of its nodes.
    #[inline(always)]
    pub fn illuminating(number: usize, light: &'a Light) -> Option<Self> {
        Self::of(number, light).filter(|of| of.area.illuminates)
    }
}

/// A block of nodes.
struct Block {
    low: [u32; 2],
    high: [u32; 2],
    /// Its share of the light.
    weight: f64,
    /// The places of its corners' factors.
    corners: [u32; 4],
}

impl Block {
    fn new(low: [u32; 2], high: [u32; 2], weight: f64) -> Self {
        Self { low, high, weight, corners: [0; 4] }
    }

    /// Returns the corners; the two that differ along one side only are neighbours.
    fn corner_nodes(&self) -> [[u32; 2]; 4] {
        let ([i, j], [k, l]) = (self.low, self.high);
        [[i, j], [k, j], [k, l], [i, l]]
    }

    fn is_divisible(&self) -> bool {
        (0..2).any(|side| self.high[side] - self.low[side] > 1)
    }

    /// Adds its parts.
    fn divide(&self, parts: &mut Vec<Self>) {
        let halves = |side: usize| {
            let (low, high) = (self.low[side], self.high[side]);
            let half = (high - low) / 2;
            let halves = [(low, low + half), (high - half, high)];
            halves.into_iter().take(if low == high { 1 } else { 2 })
        };
        let count = halves(0).count() * halves(1).count();
        let weight = self.weight / count as f64;
        for (i, k) in halves(0) {
            parts.extend(halves(1).map(|(j, l)| Self::new([i, j], [k, l], weight)));
        }
    }
}

/// What is known of the nodes of the light at hand. Kept from light to light for its memory.
#[derive(Debug, Default)]
pub(super) struct Nodes {
    /// The number of the light at hand, among those of the thread.
    now: u32,
    /// For each node the last light that asked for it, and the place of its factor.
    places: Vec<(u32, u32)>,
    /// The part of the light of each node that comes to the surface.
    factors: Vec<Rgb>,
    /// Nodes without a factor: those from this place on are asked for.
    asked: Vec<[u32; 2]>,
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

/// Where on a surface the light falls.
pub(super) struct Ground<'a> {
    pub place: &'a Place<'a>,
    /// Where rays start on the other side.
    pub behind: Vector,
    /// The lights of its object; `None` if all are.
    pub lights: Option<&'a [u32]>,
}

impl Ground<'_> {
    /// Returns whether a light lights the object.
    #[inline(always)]
    pub fn is_lit_by(&self, light: usize) -> bool {
        self.lights.is_none_or(|lights| lights.contains(&(light as u32)))
    }

    /// Returns where a ray starts.
    fn start(&self, direction: Vector) -> Vector {
        let normal = self.place.flat.map_or(self.place.normal, |flat| flat.normal);
        if normal.dot(direction) < 0.0 { self.behind } else { self.place.origin }
    }
}

/// Returns what part of a light comes from its nodes to a surface; `color` is the light without shadows.
#[inline(never)]
pub(super) fn visible(
    tracer: &Tracer,
    walk: &mut Walk,
    of: AreaLight,
    ground: &Ground,
    color: Rgb,
) -> Rgb {
    if tracer.counts {
        walk.counters.evaluations.area_lights += 1;
    }
    let casts = tracer.shadows && of.light.casts_shadows;
    if !casts && of.light.through.is_none() {
        return Rgb::WHITE;
    }
    let area = of.area;
    let mut nodes = std::mem::take(&mut walk.nodes);
    nodes.begin(area);
    let mut sum = Rgb::BLACK;
    let mut blocks = vec![Block::new([0; 2], area.nodes.map(|count| count - 1), 1.0)];
    let mut divisions = 0;
    while !blocks.is_empty() && !walk.patience.is_over {
        for block in &mut blocks {
            let corners = block.corner_nodes();
            block.corners = corners.map(|node| nodes.place(area, node));
        }
        search(tracer, walk, of, ground, &mut nodes);
        let mut finer = Vec::new();
        for block in &blocks {
            let corners = block.corners.map(|place| nodes.factors[place as usize]);
            let divides = block.is_divisible()
                && (divisions < area.least_divisions || differ(&corners, color));
            if divides {
                block.divide(&mut finer);
            } else {
                let all = corners.into_iter().fold(Rgb::BLACK, |sum, corner| sum + corner);
                sum += all * (block.weight * 0.25);
            }
        }
        blocks = finer;
        divisions += 1;
    }
    walk.nodes = nodes;
    sum
}

/// Returns whether two neighbours among the corners of a block differ.
fn differ(corners: &[Rgb; 4], color: Rgb) -> bool {
    (0..4).any(|corner| {
        let [a, b] =
            [corner, (corner + 1) % 4].map(|corner| (corners[corner] * color).components());
        let difference: f64 = (0..3).map(|component| (a[component] - b[component]).abs()).sum();
        difference > LEAST_DIFFERENCE
    })
}

/// Finds the factors of the nodes that are asked for.
fn search(tracer: &Tracer, walk: &mut Walk, of: AreaLight, ground: &Ground, nodes: &mut Nodes) {
    let Nodes { factors, asked, .. } = nodes;
    let casts = tracer.shadows && of.light.casts_shadows;
    for asked in asked.chunks(ROW) {
        // Of no meaning any more, as all of the batch.
        if walk.patience.is_over_after(asked.len() as u32, tracer.watch) {
            factors.extend(asked.iter().map(|_| Rgb::BLACK));
            continue;
        }
        let (mut rays, mut reaches, mut missed) = (Rays::NONE, [0.0; ROW], 0);
        for (number, &node) in asked.iter().enumerate() {
            let kind = node_kind(of, ground.place.point, node);
            // The side is that of the surface's point, and the aim that of where the ray starts.
            let Some(toward) = shadow::aim(&kind, ground.place.point) else { continue };
            let origin = ground.start(toward.to_light);
            let Some(aim) = shadow::aim(&kind, origin) else { continue };
            let Some(aim) = tracer.shone_through(walk, of.light, origin, &aim) else {
                missed |= 1 << number;
                continue;
            };
            rays.set(number, &Ray { origin, direction: aim.to_light });
            reaches[number] = aim.reach;
        }
        let shadowed = match casts {
            true => shadow::shadowed_together(tracer, walk, of.number, &rays, &reaches),
            false => 0,
        };
        for (number, &reach) in reaches.iter().enumerate().take(asked.len()) {
            let there = |bits: u32| bits >> number & 1 == 1;
            factors.push(if there(shadowed | missed) {
                Rgb::BLACK
            } else if casts && tracer.filters_shadows && there(rays.mask) {
                let Ray { origin, direction: to_light } = rays.at(number);
                let aim = Aim { to_light, reach };
                tracer.filtered(walk, ground.place.within, origin, &aim)
            } else {
                Rgb::WHITE
            });
        }
    }
    asked.clear();
}

/// Returns the mean of what a surface answers to each node of a light, without shadows, times the part of the light
/// that comes to it; `None` where that is nothing.
#[inline(never)]
pub(super) fn mean(
    tracer: &Tracer,
    walk: &mut Walk,
    of: AreaLight,
    ground: &Ground,
    mut answer: impl FnMut(&mut Walk, &LightKind) -> Option<Rgb>,
) -> Option<Rgb> {
    let [m, n] = of.area.nodes;
    let mut sum = Rgb::BLACK;
    for node in (0..m).flat_map(|i| (0..n).map(move |j| [i, j])) {
        let kind = node_kind(of, ground.place.point, node);
        sum += answer(walk, &kind).unwrap_or(Rgb::BLACK);
    }
    if sum.is_black() {
        return None;
    }
    if tracer.counts {
        let evaluations = &mut walk.counters.evaluations;
        evaluations.diffuse += u64::from(m) * u64::from(n);
    }
    let visible = shade::shared(walk, (of.number, Side::Front), |walk| {
        Some(visible(tracer, walk, of, ground, of.light.color))
    });
    Some(sum * (1.0 / (f64::from(m) * f64::from(n))) * visible?)
}

/// Returns the light of one node without shadows, as it comes to a point. A node of a cylinder of light has the
/// beam of the light's position (measured).
pub(super) fn emitted(
    tracer: &Tracer,
    walk: &mut Walk,
    of: AreaLight,
    within: Within,
    (kind, aim): (&LightKind, &Aim),
    origin: Vector,
) -> Option<Rgb> {
    let beam = of.light.attenuation.and_then(|attenuation| attenuation.beam);
    if !matches!(beam, Some(Beam::Cylinder { .. })) {
        return tracer.emitted(walk, (of.light, kind), within, origin, aim);
    }
    let aim = shadow::aim(&of.light.kind, origin)?;
    tracer.emitted(walk, (of.light, &of.light.kind), within, origin, &aim)
}

/// Returns the light at one node of a grid, as it lights a point.
fn node_kind(
    AreaLight { number, light, area }: AreaLight,
    point: Vector,
    node: [u32; 2],
) -> LightKind {
    let moved =
        |position: Vector, facing: Vector| position + offset(area, (number, node), point, facing);
    match light.kind {
        LightKind::Point { position } => {
            LightKind::Point { position: moved(position, position - point) }
        }
        LightKind::Parallel { position, to_light } => {
            // The grid is the same for all points (measured).
            let position = moved(position, to_light.get());
            let toward = area.target.and_then(|to| UnitVector::from_direction(position - to));
            LightKind::Parallel { position, to_light: toward.unwrap_or(to_light) }
        }
        directional @ LightKind::Directional { .. } => directional,
    }
}

/// Returns where a node of a light is, from the light's position; a grid that turns faces along `facing`.
fn offset(area: &Area, (light, node): (usize, [u32; 2]), point: Vector, facing: Vector) -> Vector {
    let [mut u, mut v] = [0, 1].map(|side| match area.nodes[side] {
        1 => 0.0,
        count => f64::from(node[side]) / f64::from(count - 1) - 0.5,
    });
    if area.jitter {
        let mut random = random(point, light, node);
        let mut moved = |side: usize| match area.nodes[side] {
            1 => 0.0,
            count => random.number(-0.5, 0.5) / f64::from(count - 1),
        };
        (u, v) = (u + moved(0), v + moved(1));
    }
    if area.circular {
        (u, v) = (u + CIRCULAR_OFFSET, v + CIRCULAR_OFFSET);
        let distance = (u * u + v * v).sqrt();
        if distance > 0.0 {
            let factor = u.abs().max(v.abs()) / distance;
            (u, v) = (u * factor, v * factor);
        }
    }
    let [a, b] = if area.orient { turned(area.sides[0], facing) } else { area.sides };
    a * u + b * v
}

/// Returns the sides of a grid that faces a direction: the first in the plane of x and y, or in that of x and z if the
/// direction is nearly z.
///
/// **Source:** measured on POV-Ray 3.7: it changes between the cosines 0.980 and 0.992.
fn turned(side: Vector, direction: Vector) -> [Vector; 2] {
    let length = UnitVector::from_direction(side).map_or(0.0, |unit| side.dot(unit.get()));
    let is_along_z =
        UnitVector::from_direction(direction).is_some_and(|to| to.get().z.abs() > 0.99);
    let across = if is_along_z { Vector::Y } else { Vector::Z };
    let first = UnitVector::from_direction(direction.cross(across));
    let first = first.map_or(Vector::X, UnitVector::get);
    let second =
        UnitVector::from_direction(direction.cross(first)).map_or(Vector::Y, UnitVector::get);
    [first * length, second * length]
}

/// Returns the random numbers of a node of a light, as it lights a point.
fn random(point: Vector, light: usize, node: [u32; 2]) -> Random {
    Random::at(SEED, point, [light as u64, u64::from(node[0]) << 32 | u64::from(node[1])])
}

impl<'a> Tracer<'a> {
    /// Returns the lights of an object; `None` if all are.
    #[inline(always)]
    pub(super) fn lights_of(&self, object: u32) -> Option<&'a [u32]> {
        if self.world.light_sets.is_empty() {
            return None;
        }
        let set = self.world.objects[object as usize].lights;
        Some(&self.world.light_sets[set as usize])
    }

    /// Adds to what surfaces show what they send to the viewer of a light that is not simple: an area light, or one
    /// that does not light all objects.
    #[inline(never)]
    pub(super) fn light_one_by_one(
        &self,
        walk: &mut Walk,
        stands: &mut SurfaceBatch,
        (number, light): (usize, &Light),
    ) {
        for of in numbers(stands.mask) {
            let Some(ShadedSurface { hit, place, surface, .. }) = stands.at(of) else { continue };
            let normal = place.flat.map_or(place.normal, |flat| flat.normal);
            let behind = place.flat.map_or_else(|| surface.spawn(-normal), |flat| flat.behind);
            let ground = Ground { place: &place, behind, lights: self.lights_of(hit.object) };
            if self.counts && ground.lights.is_some() {
                walk.counters.evaluations.light_groups += 1;
            }
            if shade::answers(place.finish)
                && ground.is_lit_by(number)
                && let Some(lit) = shade::before(self, walk, &ground, (number, light))
            {
                stands.answers.add_to(of, lit);
            }
        }
    }
}

#[cfg(test)]
mod tests;
