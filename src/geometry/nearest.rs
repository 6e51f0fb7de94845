//! The first surface a ray meets.
//!
//! **Invariant:** the answer does not depend on the order of the search; only what error bounds cannot
//! tell apart is decided by rank.

use super::search::Seeker;
use super::{EASY, Geometry, TIGHT};
use crate::shape::{Crossing, Ray};

/// The first surface a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Index into `World::objects`.
    pub object: u32,
    /// Distance along the ray.
    pub t: f64,
    /// The ray leaves the solid here; where it enters, normal and direction are opposed.
    pub leaving: bool,
    /// Error bounds could not tell it from a crossing of another object.
    pub contested: bool,
}

impl Geometry {
    /// The first surface ahead of the ray's start. Of crossings that their error bounds cannot
    /// tell apart, that of the first-declared object, the opaque before the clear: with U the least
    /// t + 2·error of all, the first of those with t ≤ U. So it does not depend on the order of
    /// search, one of two coinciding faces wins everywhere, and glass on a floor shows the floor.
    #[inline(always)]
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        if self.single {
            return self.nearest_in_single(ray);
        }
        let mut race = Race::new(self, ray);
        self.search(ray, f64::INFINITY, &mut race);
        if race.contested() { self.first_declared(ray) } else { race.winner() }
    }

    /// The same by definition, with the tightest error bounds: first U, then the first object.
    #[cold]
    #[inline(never)]
    fn first_declared(&self, ray: &Ray) -> Option<Hit> {
        let limit = self.end_of_first(ray);
        let mut first: Option<((bool, u32), Hit)> = None;
        self.search(ray, limit, &mut |place: usize| {
            let entry = &self.entries[place];
            let object = entry.object;
            let rank = (entry.clear, object);
            if first.is_none_or(|first| rank < first.0) {
                let crossing = self.first_crossing::<TIGHT>(entry, ray, limit);
                let hit = |(Crossing { t, .. }, leaving)| {
                    (rank, Hit { object, t, leaving, contested: true })
                };
                first = crossing.map(hit).or(first);
            }
            limit
        });
        first.map(|(_, hit)| hit)
    }

    /// U: the least t + 2·error of all crossings.
    pub(super) fn end_of_first(&self, ray: &Ray) -> f64 {
        let mut limit = f64::INFINITY;
        self.search(ray, limit, &mut |place: usize| {
            let crossing = self.first_crossing::<TIGHT>(&self.entries[place], ray, limit);
            if let Some((Crossing { t, error }, _)) = crossing {
                limit = limit.min(t + 2.0 * error);
            }
            limit
        });
        limit
    }
}

/// Looks for the nearest crossing, and for another that may be as near.
struct Race<'a> {
    geometry: &'a Geometry,
    ray: &'a Ray,
    /// The entry whose crossing is nearest so far; none has this place before the first.
    place: usize,
    t: f64,
    leaving: bool,
    /// Its t + 2·error: what is farther is certainly not first. Whether another crossing is at this
    /// or before is the same as with the least t + 2·error of all: that other's is not before its t.
    limit: f64,
    /// The least t among the others.
    rival_t: f64,
}

impl<'a> Race<'a> {
    #[inline(always)]
    fn new(geometry: &'a Geometry, ray: &'a Ray) -> Self {
        let beyond = f64::INFINITY;
        let place = usize::MAX;
        Self { geometry, ray, place, t: beyond, leaving: false, limit: beyond, rival_t: beyond }
    }

    #[inline(always)]
    fn contested(&self) -> bool {
        self.rival_t <= self.limit && self.place != usize::MAX
    }

    #[inline(always)]
    fn winner(&self) -> Option<Hit> {
        let entry = self.geometry.entries.get(self.place)?;
        Some(Hit { object: entry.object, t: self.t, leaving: self.leaving, contested: false })
    }
}

impl Seeker for Race<'_> {
    #[inline(always)]
    fn look(&mut self, place: usize) -> f64 {
        let entry = &self.geometry.entries[place];
        let crossing = self.geometry.first_crossing::<EASY>(entry, self.ray, self.limit);
        if let Some((Crossing { t, error }, leaving)) = crossing {
            if t < self.t {
                self.rival_t = self.t;
                self.limit = t + 2.0 * error;
                (self.place, self.t, self.leaving) = (place, t, leaving);
            } else {
                self.rival_t = if t < self.rival_t { t } else { self.rival_t };
            }
        }
        self.limit
    }
}
