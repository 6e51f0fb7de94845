//! Whether something stands between a place and a light.

use super::search::Seeker;
use super::work::{Tally, Uncounted};
use super::{ANY, EASY, Entry, Geometry, Hit, Sides, Solid, TIGHT, Work};
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
        self.occluder::<ANY>(ray, distance, Occluder::NONE, &mut work) != Occluder::NONE
    }

    /// As [`Geometry::occluded`], and by what. `guess` is tried first: what shadowed the last ray
    /// is likely to shadow the next, and any answer but `NONE` is as good as another. What it takes
    /// is added to `work` by a geometry that is [`Geometry::counting`].
    #[inline(always)]
    pub fn occluder<const KINDS: bool>(
        &self,
        ray: &Ray,
        distance: f64,
        guess: Occluder,
        work: &mut Work,
    ) -> Occluder {
        match self.counts {
            true => self.occluder_with::<ANY>(ray, distance, guess, work),
            false => self.occluder_with::<KINDS>(ray, distance, guess, Uncounted),
        }
    }

    #[inline(never)]
    fn occluder_with<const KINDS: bool>(
        &self,
        ray: &Ray,
        distance: f64,
        guess: Occluder,
        tally: impl Tally,
    ) -> Occluder {
        let mut shade =
            Shade::<_, KINDS> { geometry: self, ray, distance, found: Occluder::NONE, tally };
        if self.entries.get(guess.0).is_some_and(|entry| shade.shadows(entry)) {
            return guess;
        }
        self.search(ray, distance, &mut shade);
        shade.found
    }
}

/// Looks for anything that shadows the ray.
struct Shade<'a, T, const KINDS: bool> {
    geometry: &'a Geometry,
    ray: &'a Ray,
    distance: f64,
    found: Occluder,
    tally: T,
}

impl<T: Tally, const KINDS: bool> Shade<'_, T, KINDS> {
    #[inline(always)]
    fn shadows(&mut self, entry: &Entry) -> bool {
        if !entry.blocks {
            return false;
        }
        let Self { geometry, ray, distance, .. } = *self;
        self.tally.root_solve(|| geometry.price(entry));
        if KINDS == ANY
            && let Solid::Whole(whole) = entry.solid
        {
            return geometry.whole_shadows(whole, ray, distance);
        }
        if KINDS == ANY
            && let (Solid::Placed(i), Sides::Both) = (entry.solid, entry.sides)
        {
            let shadows = |met: &Met| Sides::Both.see(met) && met.t + met.error < distance;
            return geometry.placed[i as usize].crosses(ray, distance, shadows);
        }
        let crossing = geometry.first_crossing::<EASY, KINDS>(entry, ray, distance);
        crossing.is_some_and(|Hit { t, error, .. }| {
            t + error < distance || geometry.barely_shadows(entry, ray, distance)
        })
    }
}

impl Geometry {
    /// Whether one of its opaque leaves' surfaces does.
    fn whole_shadows(&self, whole: u32, ray: &Ray, distance: f64) -> bool {
        let crossing = self.first_of_whole(whole, ray, distance, |leaf| leaf.blocks);
        crossing.is_some_and(|Hit { t, error, .. }| t + error < distance)
    }

    #[cold]
    #[inline(never)]
    fn barely_shadows(&self, entry: &Entry, ray: &Ray, distance: f64) -> bool {
        let crossing = self.first_crossing::<TIGHT, ANY>(entry, ray, distance);
        crossing.is_some_and(|Hit { t, error, .. }| t + error < distance)
    }
}

impl<T: Tally, const KINDS: bool> Seeker for Shade<'_, T, KINDS> {
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
