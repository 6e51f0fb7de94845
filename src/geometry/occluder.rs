//! Whether something stands between a place and a light.

use super::search::{RowSeeker, Seeker};
use super::shades::Shades;
use super::whole::together::Line;
use super::work::{Tally, Uncounted};
use super::{EASY, Entry, Geometry, Hit, Sides, Solid, TIGHT, Work};
use crate::bvh::packet;
use crate::math::wide::*;
use crate::shape::Ray;
use crate::shape::local::Met;

/// What shadows a ray: an entry of a [`Geometry`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Occluder(pub(super) usize);

impl Occluder {
    /// Nothing does.
    pub const NONE: Self = Self(usize::MAX);
}

impl Geometry {
    /// Whether an opaque surface that casts shadows is certainly nearer than `distance` (which may be ∞).
    /// Surfaces seen from one side shadow from that side.
    pub fn occluded(&self, ray: &Ray, distance: f64) -> bool {
        let mut work = Work::default();
        self.occluder(ray, distance, Occluder::NONE, &mut work) != Occluder::NONE
    }

    /// As [`Geometry::occluded`], and by what. `guess` is tried first: what shadowed the last ray
    /// is likely to shadow the next, and any answer but `NONE` is as good as another. What it takes
    /// is added to `work` by a geometry that is [`Geometry::counting`].
    #[inline(always)]
    pub fn occluder(&self, ray: &Ray, distance: f64, guess: Occluder, work: &mut Work) -> Occluder {
        match self.counts {
            true => self.opaque().occluder_with(ray, distance, guess, work),
            false => self.opaque().occluder_with(ray, distance, guess, Uncounted),
        }
    }

    /// Whether [`Geometry::occluded`], for rays side by side, each with its distance: a bit for each. `guess` becomes
    /// what shadowed the last of them.
    #[inline(never)]
    pub fn occluded_together(
        &self,
        rays: &Rays,
        distances: &Row,
        guess: &mut Occluder,
        work: &mut Work,
    ) -> u32 {
        if rays.mask.count_ones() >= packet::LEAST {
            let opaque = self.opaque();
            let mut shades = Shades::new(opaque, rays, distances, self.counts.then_some(work));
            if guess.0 < opaque.entries.len() {
                dispatch!(self.instructions.level(), simd => shades.look(simd, guess.0, rays.mask));
            }
            if shades.open() != 0 {
                opaque.search_together(&mut shades);
            }
            return shades.finish(guess);
        }
        let mut found = 0;
        for number in numbers(rays.mask) {
            let distance = distances[number];
            let occluder = self.occluder(&rays.at(number), distance, *guess, work);
            if occluder != Occluder::NONE {
                (*guess, found) = (occluder, found | 1 << number);
            }
        }
        found
    }

    #[inline(never)]
    fn occluder_with(
        &self,
        ray: &Ray,
        distance: f64,
        guess: Occluder,
        tally: impl Tally,
    ) -> Occluder {
        let mut shade = Shade { geometry: self, ray, distance, found: Occluder::NONE, tally };
        if self.entries.get(guess.0).is_some_and(|entry| shade.shadows(entry)) {
            return guess;
        }
        self.search(ray, distance, &mut shade);
        shade.found
    }
}

/// Looks for anything that shadows the ray.
struct Shade<'a, T> {
    geometry: &'a Geometry,
    ray: &'a Ray,
    distance: f64,
    found: Occluder,
    tally: T,
}

impl<T: Tally> Shade<'_, T> {
    #[inline(always)]
    fn shadows(&mut self, entry: &Entry) -> bool {
        let Self { geometry, ray, distance, .. } = *self;
        if entry.blocks {
            self.tally.root_solve(|| geometry.price(entry));
        }
        entry.blocks && geometry.shadows(entry, ray, distance)
    }
}

impl Geometry {
    /// Whether an entry that stops light does so before `distance`.
    #[inline(always)]
    pub(super) fn shadows(&self, entry: &Entry, ray: &Ray, distance: f64) -> bool {
        if let Solid::Whole(whole) = entry.solid {
            return self.whole_shadows(whole, &Line::alone(ray), distance);
        }
        if let (Solid::Placed(i), Sides::Both) = (entry.solid, entry.sides) {
            let shadows = |met: &Met| Sides::Both.see(met) && met.t + met.error < distance;
            return self.placed[i as usize].crosses(ray, distance, shadows);
        }
        let crossing = self.first_crossing::<EASY>(entry, ray, distance);
        crossing.is_some_and(|Hit { t, error, .. }| {
            t + error < distance || self.barely_shadows(entry, ray, distance)
        })
    }

    /// Whether one of its opaque leaves' surfaces does.
    pub(super) fn whole_shadows(&self, whole: u32, line: &Line, distance: f64) -> bool {
        let crossing = self.first_of_whole(whole, line, distance, |leaf| leaf.blocks);
        crossing.is_some_and(|Hit { t, error, .. }| t + error < distance)
    }

    #[cold]
    #[inline(never)]
    fn barely_shadows(&self, entry: &Entry, ray: &Ray, distance: f64) -> bool {
        let crossing = self.first_crossing::<TIGHT>(entry, ray, distance);
        crossing.is_some_and(|Hit { t, error, .. }| t + error < distance)
    }
}

impl<T: Tally> Seeker for Shade<'_, T> {
    type Tally = T;

    #[inline(always)]
    fn tally(&mut self) -> &mut T {
        &mut self.tally
    }

    #[inline(always)]
    fn look(&mut self, place: usize) -> f64 {
        if self.shadows(&self.geometry.entries[place]) {
            self.found = Occluder(place);
            return f64::NEG_INFINITY;
        }
        self.distance
    }
}
