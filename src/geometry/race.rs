//! The first surfaces that rays side by side meet.
//!
//! **Invariant:** each ray finds what it finds alone: spheres and planes are solved for four rays at once, all else
//! for one.

use super::nearest::Race;
use super::search::RowSeeker;
use super::whole::together::{Known, Line};
use super::{EASY, Entry, Geometry, Hit, Work};
use crate::math::wide::*;
use crate::shape::First;
use crate::shape::local::Met;

/// A [`Race`] for each ray.
pub(super) struct Races<'a> {
    geometry: &'a Geometry,
    rays: &'a Rays,
    object: [u32; ROW],
    part: [u32; ROW],
    /// A bit for each ray.
    leaving: u32,
    is_contested: u32,
    t: Row,
    limits: Row,
    rival_t: Row,
    tally: Option<&'a mut Work>,
}

impl<'a> Races<'a> {
    #[inline(always)]
    pub fn new(geometry: &'a Geometry, rays: &'a Rays, tally: Option<&'a mut Work>) -> Self {
        let Hit { object, t, part, .. } = Hit::NOTHING;
        let ([object, part], [t, limits, rival_t]) = ([[object; ROW], [part; ROW]], [[t; ROW]; 3]);
        Self {
            geometry,
            rays,
            object,
            part,
            leaving: 0,
            is_contested: 0,
            t,
            limits,
            rival_t,
            tally,
        }
    }

    /// Tells the first surface that each ray meets.
    #[inline(always)]
    pub fn finish(mut self, hits: &mut [Hit; ROW]) {
        for number in numbers(self.rays.mask) {
            let hit = &mut hits[number];
            let (t, limit) = (self.t[number], self.limits[number]);
            let may_differ = self.rival_t[number] <= limit || self.is_contested >> number & 1 == 1;
            if may_differ && t != f64::INFINITY {
                *hit = self.decided(number);
                continue;
            }
            // Field by field: a whole hit would be read before its parts are written.
            hit.object = self.object[number];
            hit.t = t;
            hit.error = (limit - t) / 2.0;
            hit.leaving = self.leaving >> number & 1 == 1;
            hit.part = self.part[number];
            hit.contested = false;
        }
    }

    #[cold]
    #[inline(never)]
    fn decided(&mut self, number: usize) -> Hit {
        let ray = self.rays.at(number);
        let race = Race {
            geometry: self.geometry,
            ray: &ray,
            object: self.object[number],
            t: self.t[number],
            leaving: self.leaving >> number & 1 == 1,
            part: self.part[number],
            is_contested: self.is_contested >> number & 1 == 1,
            limit: self.limits[number],
            rival_t: self.rival_t[number],
            tally: &mut self.tally,
        };
        race.finish()
    }

    /// Takes note of where the ray of this number first meets an entry.
    #[inline(always)]
    fn take_one(&mut self, number: usize, hit: Hit) {
        if hit.t < self.t[number] {
            self.rival_t[number] = self.t[number];
            self.limits[number] = hit.t + 2.0 * hit.error;
            (self.object[number], self.part[number]) = (hit.object, hit.part);
            self.t[number] = hit.t;
            let bit = 1 << number;
            self.leaving = self.leaving & !bit | u32::from(hit.leaving) << number;
            self.is_contested = self.is_contested & !bit | u32::from(hit.contested) << number;
        } else if hit.t < self.rival_t[number] {
            self.rival_t[number] = hit.t;
        }
    }
}

impl<'a> RowSeeker<'a> for Races<'a> {
    #[inline(always)]
    fn geometry(&self) -> &'a Geometry {
        self.geometry
    }

    #[inline(always)]
    fn rays(&self) -> &'a Rays {
        self.rays
    }

    #[inline(always)]
    fn open(&self) -> u32 {
        self.rays.mask
    }

    #[inline(always)]
    fn limits(&self) -> &Row {
        &self.limits
    }

    #[inline(always)]
    fn tally(&mut self) -> &mut Option<&'a mut Work> {
        &mut self.tally
    }

    #[inline(always)]
    fn concerns(&self, _: &Entry) -> bool {
        true
    }

    #[inline(always)]
    fn take<S: Simd>(&mut self, simd: S, place: usize, group: usize, first: First<S>) {
        let (t, rival_t) = (four(simd, &self.t, group), four(simd, &self.rival_t, group));
        let limit = four(simd, &self.limits, group);
        let nearer = first.t.simd_lt(t);
        let rival = first.t.simd_lt(rival_t).select(first.t, rival_t);
        let new_limit = first.t + first.error * all(simd, 2.0);
        store(nearer.select(t, rival), &mut self.rival_t, group);
        store(nearer.select(new_limit, limit), &mut self.limits, group);
        store(nearer.select(first.t, t), &mut self.t, group);
        let nearer = bits(nearer, group);
        let object = self.geometry.entries[place].object;
        self.leaving = self.leaving & !nearer | bits(first.leaving, group) & nearer;
        self.is_contested &= !nearer;
        for number in numbers(nearer) {
            (self.object[number], self.part[number]) = (object, Met::UNKNOWN);
        }
        for number in numbers(bits(first.unsure, group)) {
            self.look_alone(place, number);
        }
    }

    #[inline(never)]
    fn look_alone(&mut self, place: usize, number: usize) {
        let entry = &self.geometry.entries[place];
        let (ray, limit) = (self.rays.at(number), self.limits[number]);
        if let Some(hit) = self.geometry.first_crossing::<EASY>(entry, &ray, limit) {
            self.take_one(number, hit);
        }
    }

    #[inline(never)]
    fn look_together(&mut self, place: usize, body: u32, mask: u32) {
        let geometry = self.geometry;
        let entry = &geometry.entries[place];
        let limits = self.limits;
        let placed = &geometry.placed[body as usize];
        let instructions = geometry.instructions;
        placed.first_crossings_together(
            instructions,
            self.rays,
            mask,
            &limits,
            |number, ray, found| {
                if let Some(met) = geometry.first_of(body, entry.sides, ray, limits[number], found)
                {
                    self.take_one(number, entry.hit(met));
                }
            },
        );
    }

    #[inline(never)]
    fn look_at_whole(&mut self, _: usize, whole: u32, number: usize, known: &Known) {
        let ray = self.rays.at(number);
        let line = Line { ray: &ray, known: Some((known, number)) };
        let limit = self.limits[number];
        if let Some(hit) = self.geometry.first_of_whole(whole, &line, limit, |_| true) {
            self.take_one(number, hit);
        }
    }
}
