//! Whether something stands before lights, for rays side by side.
//!
//! **Invariant:** each ray finds what it finds alone: spheres and planes are solved for four rays at once, all else
//! for one.

use super::occluder::Occluder;
use super::search::RowSeeker;
use super::whole::together::{Known, Line};
use super::{Entry, Geometry, Sides, Work};
use crate::math::wide::*;
use crate::shape::First;
use crate::shape::local::Met;

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

    /// Looks at a few entries, and no others: first at `guess`, if it is one of them.
    #[inline(always)]
    pub fn look_at<S: Simd>(&mut self, simd: S, places: &[usize], guess: Occluder) {
        let is_guess = |place: &&usize| **place == guess.0;
        let first = places.iter().find(is_guess).into_iter();
        for &place in first.chain(places.iter().filter(|place| !is_guess(place))) {
            if self.open == 0 {
                return;
            }
            self.look(simd, place, self.open);
        }
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
}

impl<'a> RowSeeker<'a> for Shades<'a> {
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
        self.open
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
    fn concerns(&self, entry: &Entry) -> bool {
        entry.blocks
    }

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

    #[inline(never)]
    fn look_alone(&mut self, place: usize, number: usize) {
        let entry = &self.geometry.entries[place];
        if self.geometry.shadows(entry, &self.rays.at(number), self.distances[number]) {
            self.found(place, 1 << number);
        }
    }

    #[inline(never)]
    fn look_together(&mut self, place: usize, body: u32, mask: u32) {
        let distances = self.distances;
        let shadows = |number: usize, met: &Met| {
            Sides::Both.see(met) && met.t + met.error < distances[number]
        };
        let body = &self.geometry.placed[body as usize];
        let shadowed =
            body.crosses_together(self.geometry.instructions, self.rays, mask, distances, shadows);
        self.found(place, shadowed);
    }

    #[inline(never)]
    fn look_at_whole(&mut self, place: usize, whole: u32, number: usize, known: &Known) {
        let ray = self.rays.at(number);
        let line = Line { ray: &ray, known: Some((known, number)) };
        if self.geometry.whole_shadows(whole, &line, self.distances[number]) {
            self.found(place, 1 << number);
        }
    }
}
