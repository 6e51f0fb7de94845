//! Which solids a ray is in, and so which index of refraction is on either side of a surface.
//!
//! **In:** crossings, in the order of the ray. **Out:** indices of refraction. **Invariant:** of
//! several solids that a point is in, the one entered last fills it; a solid that a ray leaves
//! without having been seen to enter counts as one it was in.
//!
//! **Source:** POV-Ray 3.7's behaviour, measured with nested, overlapping and touching slabs and with
//! the camera inside.

use crate::geometry::Hit;
use crate::math::Vector;
use crate::world::World;

/// The index of refraction of the air.
const AIR: f64 = 1.0;

/// The solids along one ray, and those that waiting rays are in.
#[derive(Debug, Default)]
pub(super) struct Media {
    /// Objects, the one entered last at the end. Read after [`Media::known`] only.
    inside: Vec<u32>,
    is_known: bool,
    /// Where the camera's ray starts.
    start: Vector,
    /// What the place a ray last started from is in: a camera's rays often start in one place.
    last_start: Option<Vector>,
    at_last_start: Vec<u32>,
    /// As `inside` will be behind the surface at hand.
    behind: Vec<u32>,
    /// The lists of rays that wait, one after the other.
    waiting: Vec<u32>,
}

/// The indices of refraction before a surface and behind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Border {
    pub from: f64,
    pub to: f64,
}

impl Border {
    pub const NONE: Self = Self { from: AIR, to: AIR };
}

impl Media {
    /// A camera's ray starts; what it starts in is only asked for when a border is.
    pub fn start(&mut self, start: Vector) {
        (self.start, self.is_known) = (start, false);
        self.waiting.clear();
    }

    /// Finds out what the ray's start is in, in the order of declaration.
    fn know(&mut self, world: &World) {
        if self.is_known {
            return;
        }
        self.is_known = true;
        let start = self.start;
        if self.last_start != Some(start) {
            self.last_start = Some(start);
            let contains = |&i: &u32| world.csg_contains(&world.objects[i as usize], start);
            self.at_last_start.clear();
            self.at_last_start.extend(world.solids().filter(contains));
        }
        self.inside.clone_from(&self.at_last_start);
    }

    /// The border at `hit`, where the ray crosses `others`, too, that coincide with it.
    pub fn border(&mut self, world: &World, hit: &Hit, others: &[Hit]) -> Border {
        self.know(world);
        self.behind.clear();
        self.behind.extend_from_slice(&self.inside);
        let mut from = self.inside.last().map_or(AIR, |&object| ior(world, object));
        for crossed in others.iter().chain([hit]) {
            if world.is_flat_box(crossed.object) {
                continue;
            }
            let known =
                self.behind.iter().position(|&object| world.is_same_solid(object, crossed.object));
            if let Some(place) = known {
                self.behind.remove(place);
            }
            // A sheet has no sides: whoever is not in it goes in.
            let enters = match world.is_sheet(crossed.object) {
                true => known.is_none(),
                false => crossed.leaving == world.objects[crossed.object as usize].inverse,
            };
            if enters {
                self.behind.push(crossed.object);
            } else if known.is_none() && self.inside.is_empty() {
                from = ior(world, crossed.object);
            }
        }
        let to = self.behind.last().map_or(AIR, |&object| ior(world, object));
        Border { from, to }
    }

    /// The ray goes through the border last asked for.
    pub fn go_through(&mut self) {
        std::mem::swap(&mut self.inside, &mut self.behind);
    }

    /// A ray behind that border waits; returns where its list is kept.
    pub fn wait_behind(&mut self) -> usize {
        let kept = self.waiting.len();
        self.waiting.extend_from_slice(&self.behind);
        kept
    }

    /// The ray whose list was kept there, the last of those that wait, goes on.
    pub fn go_on(&mut self, kept: usize) {
        self.inside.clear();
        self.inside.extend(self.waiting.drain(kept..));
    }
}

fn ior(world: &World, object: u32) -> f64 {
    let interior = world.objects[object as usize].interior;
    interior.map_or(AIR, |i| world.interiors[i as usize].ior)
}
