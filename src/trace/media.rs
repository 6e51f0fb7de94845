//! Which solids a ray is in, and so which interior is on either side of a surface.
//!
//! **In:** crossings, in the order of the ray. **Out:** indices of refraction, and how much light fades. **Invariant:** of
//! several solids that a point is in, the one entered last fills it; a ray enters each solid that it is not
//! known to be in, whichever side of the surface it meets.
//!
//! **Source:** POV-Ray 3.7's behaviour, measured with nested, overlapping and touching slabs and with
//! the camera inside.

use super::dispersion;
use super::packet::Packet;
use super::way::Way;
use crate::color::Rgb;
use crate::geometry::{self, Hit};
use crate::math::Vector;
use crate::math::bounds::Bounds;
use crate::math::wide::numbers;
use crate::world::{Dispersion, Interior, World};

/// The index of refraction of the air.
const AIR: f64 = 1.0;

/// The solids that a ray is in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Within {
    /// Those that this camera's ray of the batch starts in: nothing has asked yet.
    Start(u32),
    /// A list in [`Media`].
    Known { first: u32, count: u32 },
}

/// The solids that the rays of a batch are in.
#[derive(Debug, Default)]
pub(super) struct Media {
    /// Lists of objects, one after the other; in each, the one entered last at the end.
    lists: Vec<u32>,
    /// Where the camera's rays start.
    starts: Vec<Vector>,
    /// What the place a ray last started from is in: a camera's rays often start in one place.
    last_start: Option<Vector>,
    at_last_start: Vec<u32>,
    /// The list at hand.
    list: Vec<u32>,
}

/// The solids that the camera may be in, each with its bounds.
///
/// A solid contains the camera only within its bounds: none is below a disc, nor outside an inverse sphere.
///
/// **Source:** POV-Ray 3.7's behaviour, measured.
#[derive(Debug, Default)]
pub(super) struct Around {
    solids: Vec<(u32, Bounds)>,
    /// All its rays start in one place.
    is_one_place: bool,
}

impl Around {
    pub fn of(world: &World) -> Self {
        let camera = &world.camera;
        // The corner of a square lens is farther off than its radius.
        let lens = camera.focus.as_ref().map_or(0.0, |focus| 2.0 * focus.radius.abs());
        let half = match camera.has_one_origin() {
            false if camera.meshes.is_some() => Vector::INFINITY,
            true => Vector::ZERO,
            false => (camera.right.abs() + camera.up.abs()) * 0.5 + Vector::splat(lens),
        };
        // Room for the rounding of a start.
        let half = half + (half + camera.location.abs()) * (8.0 * f64::EPSILON);
        let starts = Bounds { low: camera.location - half, high: camera.location + half };
        let bounds = |solid| geometry::bounds(world, solid).unwrap_or(Bounds::EVERYWHERE);
        let solids = world.solids().map(|solid| (solid, bounds(solid)));
        let solids = solids.filter(|(_, bounds)| !bounds.intersection(&starts).is_empty());
        Self { solids: solids.collect(), is_one_place: camera.has_one_origin() }
    }

    /// Returns the solids that `start` is in, in the order of declaration.
    fn at(&self, world: &World, start: Vector) -> impl Iterator<Item = u32> {
        let contains = move |&&(solid, bounds): &&(u32, Bounds)| {
            bounds.contains(start) && world.csg_contains(&world.objects[solid as usize], start)
        };
        self.solids.iter().filter(contains).map(|(solid, _)| *solid)
    }
}

/// The media before a surface and behind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Border {
    /// The indices of refraction.
    pub from: f64,
    pub to: f64,
    /// The interiors; `None` for air.
    sides: [Option<u32>; 2],
    /// The interior of the solid that the ray is known to be in, and leaves.
    left: Option<u32>,
    /// The ray enters a solid, or leaves the last one that has an interior.
    is_outer: bool,
    /// What a ray is in before the surface, and behind it.
    pub within: [Within; 2],
}

impl Border {
    /// Where no interior changes any ray.
    pub const fn none(within: Within) -> Self {
        let within = [within; 2];
        Self { from: AIR, to: AIR, sides: [None; 2], left: None, is_outer: false, within }
    }

    /// Returns the indices of refraction for a position in the spectrum, or for all colours.
    pub fn indices(&self, world: &World, spectrum: Option<f64>) -> [f64; 2] {
        self.sides.map(|side| index(world, side, spectrum))
    }

    /// Returns how many rays a ray of all colours becomes that goes through; `None` if it stays one.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured.
    pub fn samples(&self, world: &World) -> Option<u32> {
        let [before, behind] =
            self.sides.map(|side| side.and_then(|side| world.interiors[side as usize].dispersion));
        let ratio = |side: Option<Dispersion>| side.map(|dispersion| dispersion.ratio);
        let splits = self.is_outer && ratio(before) != ratio(behind);
        behind.or(before).filter(|_| splits).map(|dispersion| dispersion.samples)
    }

    /// Returns the part of the light behind the surface, or mirrored there, that is left after the way to it.
    pub fn left_after(&self, world: &World, depth: f64) -> Rgb {
        let interior = self.left.map(|left| world.interiors[left as usize]);
        let absorption = interior.and_then(|interior| interior.absorption);
        absorption.map_or(Rgb::WHITE, |absorption| absorption.at(depth))
    }
}

impl Media {
    /// A batch of camera's rays starts; what one starts in is only asked for when a border is.
    pub fn start(&mut self, packets: &[Packet]) {
        self.lists.clear();
        self.starts.clear();
        for Packet { rays, .. } in packets {
            self.starts.extend(numbers(rays.mask).map(|number| rays.origins.at(number)));
        }
    }

    /// The room that lists take.
    pub fn known(&self) -> usize {
        self.lists.len()
    }

    /// Forgets the lists that came after [`Media::known`] was that.
    pub fn forget(&mut self, known: usize) {
        self.lists.truncate(known);
    }

    /// Puts what a ray is in at hand; of a camera's ray in the order of declaration.
    fn know(&mut self, (world, around): (&World, &Around), within: Within) {
        self.list.clear();
        match within {
            Within::Known { first, count } => {
                let list = first as usize..(first + count) as usize;
                self.list.extend_from_slice(&self.lists[list]);
            }
            Within::Start(root) => {
                let start = self.starts[root as usize];
                if self.last_start != Some(start) {
                    self.last_start = Some(start);
                    self.at_last_start.clear();
                    self.at_last_start.extend(around.at(world, start));
                }
                self.list.extend_from_slice(&self.at_last_start);
            }
        }
    }

    /// Keeps the list at hand.
    fn keep(&mut self) -> Within {
        let (first, count) = (self.lists.len() as u32, self.list.len() as u32);
        self.lists.extend_from_slice(&self.list);
        Within::Known { first, count }
    }

    /// The border at `hit`, where the ray `way` crosses `others`, too, that coincide with it.
    pub fn border(
        &mut self,
        (world, around): (&World, &Around),
        way: &Way,
        hit: &Hit,
        others: &[Hit],
    ) -> Border {
        self.know((world, around), way.within);
        let here = match way.within {
            Within::Start(_) => self.keep(),
            Within::Known { .. } => way.within,
        };
        let interior = |&object: &u32| world.objects[object as usize].interior;
        let before = self.list.last().and_then(interior);
        let (mut left, mut enters) = (None, false);
        for crossed in others.iter().chain([hit]) {
            let crossing = cross(world, &mut self.list, crossed);
            enters = matches!(crossing, Crossed::Entered);
            if matches!(crossing, Crossed::Left) {
                left = left.or(interior(&crossed.object));
            }
        }
        let behind = self.list.last().and_then(interior);
        let [from, to] = [before, behind].map(|side| index(world, side, way.spectrum));
        let is_outer = enters || self.list.iter().all(|object| interior(object).is_none());
        let within = [here, self.keep()];
        Border { from, to, sides: [before, behind], left, is_outer, within }
    }

    /// Returns a bit for each ray that starts where fog is: in solids that are all hollow.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured.
    pub fn in_fog(&mut self, (world, around): (&World, &Around), packet: &Packet) -> u32 {
        let mask = packet.rays.mask;
        let mut is_in_fog = |number| {
            self.know((world, around), packet.within(number));
            self.list.iter().all(|&object| world.objects[object as usize].hollow)
        };
        match around {
            _ if !packet.is_of_camera() => {}
            Around { solids, .. } if solids.is_empty() => return mask,
            Around { is_one_place: true, .. } => {
                return if numbers(mask).next().is_some_and(is_in_fog) { mask } else { 0 };
            }
            _ => {}
        }
        numbers(mask).filter(|&number| is_in_fog(number)).fold(0, |all, number| all | 1 << number)
    }

    /// Returns the part of light that fog leaves along a ray of `length` that starts `within` solids and crosses
    /// `hits` on its way; `left` is that between two distances.
    pub fn fog_to_light(
        &mut self,
        (world, around): (&World, &Around),
        within: Within,
        hits: &mut [Hit],
        length: f64,
        left: impl Fn(f64, f64) -> Rgb,
    ) -> Rgb {
        self.know((world, around), within);
        hits.sort_by(|a, b| a.t.total_cmp(&b.t).then(a.object.cmp(&b.object)));
        let ends = hits.iter().map(|hit| (hit.t, Some(hit))).chain([(length, None)]);
        let (mut light, mut start) = (Rgb::WHITE, 0.0);
        for (end, hit) in ends {
            if self.list.iter().all(|&object| world.objects[object as usize].hollow) {
                light = light * left(start, end);
            }
            hit.map(|hit| cross(world, &mut self.list, hit));
            start = end;
        }
        light
    }

    /// Returns the part of light that is left of what comes along a ray that starts `within` solids and crosses
    /// `hits` on its way.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured.
    pub fn left_of_light(
        &mut self,
        (world, around): (&World, &Around),
        within: Within,
        hits: &mut [Hit],
    ) -> Rgb {
        self.know((world, around), within);
        hits.sort_by(|a, b| a.t.total_cmp(&b.t).then(a.object.cmp(&b.object)));
        let (mut light, mut start) = (Rgb::WHITE, 0.0);
        for hit in hits {
            if let Crossed::Left = cross(world, &mut self.list, hit)
                && let Some(interior) = world.objects[hit.object as usize].interior
                && let Some(absorption) = world.interiors[interior as usize].absorption
            {
                light = light * absorption.in_shadow(hit.t - start);
            }
            start = hit.t;
        }
        light
    }
}

/// How a ray crosses the surface of a solid.
enum Crossed {
    Entered,
    Left,
}

/// Updates the list of what a ray is in.
///
/// **Source:** POV-Ray 3.7's behaviour, measured on open, clipped and flat solids, and on height fields, whose
/// base is not there.
fn cross(world: &World, inside: &mut Vec<u32>, hit: &Hit) -> Crossed {
    let known = inside.iter().position(|&object| world.is_same_solid(object, hit.object));
    if let Some(place) = known {
        inside.remove(place);
    }
    // Not by the side that it meets: it may have come in, or gone out, where nothing of the solid is seen.
    let enters = known.is_none();
    if enters {
        inside.push(hit.object);
        return Crossed::Entered;
    }
    Crossed::Left
}

/// Returns an interior's index of refraction for a position in the spectrum.
fn index(world: &World, interior: Option<u32>, spectrum: Option<f64>) -> f64 {
    let Some(interior) = interior else { return AIR };
    let Interior { ior, dispersion, .. } = world.interiors[interior as usize];
    match (dispersion, spectrum) {
        (Some(Dispersion { ratio, .. }), Some(position)) => dispersion::index(ior, ratio, position),
        _ => ior,
    }
}
