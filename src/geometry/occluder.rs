//! Whether something stands between a place and a light.

use super::search::Seeker;
use super::{EASY, Entry, Geometry, TIGHT};
use crate::shape::{Crossing, Ray};

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
        self.occluder(ray, distance, Occluder::NONE) != Occluder::NONE
    }

    /// As [`Geometry::occluded`], and by what. `guess` is tried first: what shadowed the last ray
    /// is likely to shadow the next, and any answer but `NONE` is as good as another.
    #[inline(never)]
    pub fn occluder(&self, ray: &Ray, distance: f64, guess: Occluder) -> Occluder {
        if self.single {
            return self.occluder_in_single(ray, distance, guess);
        }
        if self.entries.get(guess.0).is_some_and(|entry| self.shadows(entry, ray, distance)) {
            return guess;
        }
        let mut shade = Shade { geometry: self, ray, distance, found: Occluder::NONE };
        self.search(ray, distance, &mut shade);
        shade.found
    }

    #[inline(always)]
    fn shadows(&self, entry: &Entry, ray: &Ray, distance: f64) -> bool {
        if !entry.blocks {
            return false;
        }
        let crossing = self.first_crossing::<EASY>(entry, ray, distance);
        crossing.is_some_and(|(Crossing { t, error }, _)| {
            t + error < distance || self.barely_shadows(entry, ray, distance)
        })
    }

    #[cold]
    #[inline(never)]
    fn barely_shadows(&self, entry: &Entry, ray: &Ray, distance: f64) -> bool {
        let crossing = self.first_crossing::<TIGHT>(entry, ray, distance);
        crossing.is_some_and(|(Crossing { t, error }, _)| t + error < distance)
    }
}

/// Looks for anything that shadows the ray.
struct Shade<'a> {
    geometry: &'a Geometry,
    ray: &'a Ray,
    distance: f64,
    found: Occluder,
}

impl Seeker for Shade<'_> {
    #[inline(always)]
    fn look(&mut self, place: usize) -> f64 {
        if self.geometry.shadows(&self.geometry.entries[place], self.ray, self.distance) {
            self.found = Occluder(place);
            return f64::NEG_INFINITY;
        }
        self.distance
    }
}
