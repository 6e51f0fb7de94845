//! Whether something stands before lights, for rays side by side.
//!
//! **Invariant:** each ray finds what it finds alone: spheres and planes are solved for four rays at once, all else
//! for one.

use super::occluder::Occluder;
use super::search::RowSeeker;
use super::work::Tally;
use super::{Entry, Geometry, Sides, Solid, Work};
use crate::bvh::packet;
use crate::math::wide::*;
use crate::shape::local::{Local, Met};
use crate::shape::{First, Ray};
use smallvec::SmallVec;

/// Looks for anything that shadows each ray.
pub(super) struct Shades<'a> {
    geometry: &'a Geometry,
    rays: &'a Rays,
    distances: &'a Row,
    /// The distances; −∞ where something is found.
    limits: Row,
    /// A bit for each ray whose search goes on.
    open: u32,
    /// What was found last.
    last: Occluder,
    tally: Option<&'a mut Work>,
}

impl<'a> Shades<'a> {
    #[inline(always)]
    pub fn new(
        geometry: &'a Geometry,
        rays: &'a Rays,
        distances: &'a Row,
        tally: Option<&'a mut Work>,
    ) -> Self {
        let (open, limits) = (rays.mask, *distances);
        Self { geometry, rays, distances, limits, open, last: Occluder::NONE, tally }
    }

    /// Returns a bit for each ray that is shadowed; `guess` becomes what shadowed one of them.
    #[inline(always)]
    pub fn finish(self, guess: &mut Occluder) -> u32 {
        if self.last != Occluder::NONE {
            *guess = self.last;
        }
        self.rays.mask & !self.open
    }

    #[inline(always)]
    fn found(&mut self, place: usize, mask: u32) {
        let found = mask & self.open;
        if found != 0 {
            self.last = Occluder(place);
            self.open &= !found;
            numbers(found).for_each(|number| self.limits[number] = f64::NEG_INFINITY);
        }
    }

    #[inline(never)]
    fn look_alone(&mut self, place: usize, number: usize) {
        let entry = &self.geometry.entries[place];
        if self.geometry.shadows(entry, &self.rays.at(number), self.distances[number]) {
            self.found(place, 1 << number);
        }
    }

    /// Looks at a body that is seen from both sides for the rays whose bits are set.
    #[inline(never)]
    fn look_together(&mut self, place: usize, body: u32, mask: u32) {
        let rays: SmallVec<[Ray; ROW]> = numbers(mask).map(|number| self.rays.at(number)).collect();
        let distances: SmallVec<[f64; ROW]> =
            numbers(mask).map(|number| self.distances[number]).collect();
        let shadows = |number: usize, met: &Met| {
            Sides::Both.see(met) && met.t + met.error < distances[number]
        };
        let body = &self.geometry.placed[body as usize];
        let crossed = body.crosses_together(&rays, &distances, shadows);
        let shadowed = numbers(mask).enumerate().filter(|(nth, _)| crossed >> nth & 1 == 1);
        let shadowed = shadowed.fold(0, |all, (_, number)| all | 1 << number);
        self.found(place, shadowed);
    }

    /// Takes note of where the rays of a group first meet an entry.
    #[inline(always)]
    fn take<S: Simd>(&mut self, simd: S, place: usize, group: usize, first: First<S>) {
        let distance = four(simd, self.distances, group);
        let before = (first.t + first.error).simd_lt(distance);
        let barely = first.t.simd_lt(all(simd, f64::INFINITY)) & !before;
        self.found(place, bits(before, group));
        for number in numbers(bits(barely | first.unsure, group) & self.open) {
            self.look_alone(place, number);
        }
    }
}

impl RowSeeker for Shades<'_> {
    #[inline(always)]
    fn look<S: Simd>(&mut self, simd: S, place: usize, mask: u32) {
        let geometry = self.geometry;
        let entry: &Entry = &geometry.entries[place];
        if !entry.blocks {
            return;
        }
        self.tally.root_solves(mask.count_ones(), || geometry.price(entry));
        match &entry.solid {
            Solid::Sphere(sphere) if mask.count_ones() > 1 => {
                let inside = entry.sides == Sides::Inside;
                for group in 0..GROUPS {
                    if !has(mask, group) {
                        continue;
                    }
                    let (ray, limit) =
                        (self.rays.four(simd, group), four(simd, &self.limits, group));
                    let first = sphere.first_of_four(simd, &ray, inside, limit);
                    self.take(simd, place, group, first);
                }
            }
            Solid::Plane(plane) => {
                let shows = [false, true].map(|leaving| entry.sides.shows(leaving));
                for group in 0..GROUPS {
                    if !has(mask, group) {
                        continue;
                    }
                    let (ray, limit) =
                        (self.rays.four(simd, group), four(simd, &self.limits, group));
                    let first = plane.first_of_four(simd, &ray, shows, limit);
                    self.take(simd, place, group, first);
                }
            }
            Solid::Placed(i)
                if mask.count_ones() >= packet::LEAST
                    && entry.sides == Sides::Both
                    && geometry.placed[*i as usize].body.goes_together() =>
            {
                self.look_together(place, *i, mask);
            }
            _ => numbers(mask).for_each(|number| self.look_alone(place, number)),
        }
    }

    #[inline(always)]
    fn open(&self) -> u32 {
        self.open
    }

    #[inline(always)]
    fn limits(&self) -> &Row {
        &self.limits
    }

    #[inline(always)]
    fn box_visit(&mut self) {
        self.tally.box_visit();
    }
}
