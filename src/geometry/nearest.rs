//! The first surface a ray meets.
//!
//! **Invariant:** the answer does not depend on the order of the search; only what error bounds cannot
//! tell apart is decided by rank.

use super::race::Races;
use super::search::{Each, Seeker};
use super::work::{Tally, Uncounted};
use super::{EASY, Geometry, TIGHT, Work};
use crate::bvh::packet;
use crate::math::wide::{ROW, Rays, numbers};
use crate::shape::Ray;
use crate::shape::local::Met;

/// The first surface a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Index into `World::objects`.
    pub object: u32,
    /// Distance along the ray.
    pub t: f64,
    /// The true crossing lies within this distance of `t`: not the tightest bound.
    pub error: f64,
    /// The ray leaves the solid here; where it enters, normal and direction are opposed.
    pub leaving: bool,
    /// The part of the surface, as passed to `Local::height`, or `Met::UNKNOWN`.
    pub part: u32,
    /// Error bounds could not tell it from a crossing of another object, or of another part of its whole.
    pub contested: bool,
}

impl Hit {
    /// At ∞: nothing is met. An `Option` would be taken to pieces and put together again on each path of a ray.
    pub const NOTHING: Self = Self {
        object: u32::MAX,
        t: f64::INFINITY,
        error: 0.0,
        leaving: false,
        part: Met::UNKNOWN,
        contested: false,
    };

    #[inline(always)]
    pub fn found(self) -> Option<Self> {
        (self.t < f64::INFINITY).then_some(self)
    }
}

impl Geometry {
    /// The first surface ahead of the ray's start. Of crossings that their error bounds cannot
    /// tell apart, that of the first-declared object, the opaque before the clear: with U the least
    /// t + 2·error of all, the first of those with t ≤ U. So it does not depend on the order of
    /// search, one of two coinciding faces wins everywhere, and glass on a floor shows the floor.
    /// Where opaque surfaces only touch, that which is nearer all around is seen.
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        self.nearest_counted(ray, &mut Work::default()).found()
    }

    /// As [`Geometry::nearest`], or [`Hit::NOTHING`]; what it takes is added to `work` by a geometry that is
    /// [`Geometry::counting`].
    #[inline(always)]
    pub fn nearest_counted(&self, ray: &Ray, work: &mut Work) -> Hit {
        if self.counts {
            return self.nearest_while_counting(ray, work);
        }
        self.nearest_with(ray, Uncounted)
    }

    /// As [`Geometry::nearest_counted`] for rays side by side.
    #[inline(never)]
    pub fn nearest_together(&self, rays: &Rays, hits: &mut [Hit; ROW], work: &mut Work) {
        if !self.counts && rays.mask.count_ones() < packet::LEAST {
            for number in numbers(rays.mask) {
                hits[number] = self.nearest_with(&rays.at(number), Uncounted);
            }
            return;
        }
        let mut races = Races::new(self, rays, self.counts.then_some(work));
        self.search_together(&mut races);
        races.finish(hits);
    }

    /// Apart from the common path, which stays short.
    #[cold]
    #[inline(never)]
    fn nearest_while_counting(&self, ray: &Ray, work: &mut Work) -> Hit {
        self.nearest_with(ray, work)
    }

    #[inline(always)]
    fn nearest_with(&self, ray: &Ray, tally: impl Tally) -> Hit {
        let mut race = Race::new(self, ray, tally);
        self.search(ray, f64::INFINITY, &mut race);
        race.finish()
    }

    /// The nearest hit; contested where it cannot be told which that is.
    pub(super) fn raced(&self, ray: &Ray) -> Option<Hit> {
        let mut race = Race::new(self, ray, Uncounted);
        self.search(ray, f64::INFINITY, &mut race);
        let contested = race.contested();
        race.winner().found().map(|hit| Hit { contested: contested || hit.contested, ..hit })
    }

    /// The same by definition, with the tightest error bounds.
    #[cold]
    #[inline(never)]
    fn first_with<T: Tally>(&self, ray: &Ray, mut tally: T) -> Hit {
        let limit = self.end_of_first(ray, &mut tally);
        self.first_declared(ray, limit, tally).unwrap_or(Hit::NOTHING)
    }

    /// Of the crossings at `limit`, which is U, or before, that of the first object.
    fn first_declared<T: Tally>(&self, ray: &Ray, limit: f64, tally: T) -> Option<Hit> {
        let mut first: Option<((bool, u32), Hit)> = None;
        let look = |place: usize, tally: &mut T| {
            let entry = &self.entries[place];
            let rank = (entry.clear, entry.object);
            if first.is_none_or(|first| rank < first.0) {
                tally.root_solve(|| self.price(entry));
                let hit = |hit| (rank, Hit { contested: true, ..hit });
                let crossing = self.first_crossing::<TIGHT>(entry, ray, limit);
                first = crossing.map(hit).or(first);
            }
            limit
        };
        self.search(ray, limit, &mut Each(tally, look));
        first.map(|(_, hit)| hit)
    }

    /// U: the least t + 2·error of all crossings.
    pub(super) fn end_of_first<T: Tally>(&self, ray: &Ray, tally: T) -> f64 {
        let mut limit = f64::INFINITY;
        let look = |place: usize, tally: &mut T| {
            let entry = &self.entries[place];
            tally.root_solve(|| self.price(entry));
            let crossing = self.first_crossing::<TIGHT>(entry, ray, limit);
            if let Some(Hit { t, error, .. }) = crossing {
                limit = limit.min(t + 2.0 * error);
            }
            limit
        };
        self.search(ray, f64::INFINITY, &mut Each(tally, look));
        limit
    }
}

/// Looks for the nearest crossing, and for another that may be as near.
pub(super) struct Race<'a, T> {
    pub geometry: &'a Geometry,
    pub ray: &'a Ray,
    /// The nearest crossing so far. Field by field: a whole [`Hit`] would be read before its parts are written.
    pub object: u32,
    pub t: f64,
    pub leaving: bool,
    pub part: u32,
    pub is_contested: bool,
    /// Its t + 2·error: what is farther is certainly not first. Whether another crossing is at this
    /// or before is the same as with the least t + 2·error of all: that other's is not before its t.
    pub limit: f64,
    /// The least t among the others.
    pub rival_t: f64,
    pub tally: T,
}

impl<'a, T: Tally> Race<'a, T> {
    #[inline(always)]
    fn new(geometry: &'a Geometry, ray: &'a Ray, tally: T) -> Self {
        let Hit { object, t, leaving, part, contested: is_contested, .. } = Hit::NOTHING;
        Self { geometry, ray, object, t, leaving, part, is_contested, limit: t, rival_t: t, tally }
    }

    #[inline(always)]
    fn contested(&self) -> bool {
        self.rival_t <= self.limit && self.t != f64::INFINITY
    }

    /// The first surface, once all entries that may be met were looked at.
    #[inline(always)]
    pub fn finish(self) -> Hit {
        let Self { geometry, ray, limit, .. } = self;
        let hit = match self.contested() {
            true => geometry.first_with(ray, self.tally),
            false => self.winner(),
        };
        if hit.contested { geometry.as_seen_beside(ray, hit, limit) } else { hit }
    }

    #[inline(always)]
    fn winner(&self) -> Hit {
        let Self { object, t, leaving, part, is_contested: contested, .. } = *self;
        Hit { object, t, error: (self.limit - t) / 2.0, leaving, part, contested }
    }
}

impl<T: Tally> Seeker for Race<'_, T> {
    type Tally = T;

    #[inline(always)]
    fn tally(&mut self) -> &mut T {
        &mut self.tally
    }

    #[inline(always)]
    fn look(&mut self, place: usize) -> f64 {
        let entry = &self.geometry.entries[place];
        self.tally.root_solve(|| self.geometry.price(entry));
        let crossing = self.geometry.first_crossing::<EASY>(entry, self.ray, self.limit);
        if let Some(hit) = crossing {
            if hit.t < self.t {
                self.rival_t = self.t;
                self.limit = hit.t + 2.0 * hit.error;
                (self.object, self.t, self.leaving) = (hit.object, hit.t, hit.leaving);
                (self.part, self.is_contested) = (hit.part, hit.contested);
            } else {
                self.rival_t = if hit.t < self.rival_t { hit.t } else { self.rival_t };
            }
        }
        self.limit
    }
}
