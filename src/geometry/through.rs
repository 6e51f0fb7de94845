//! What a ray meets on its way through: every clear surface before a light, and surfaces that
//! coincide with one it has gone through.
//!
//! **In:** a ray. **Out:** crossings, in a list of the caller's. **Invariant:** no allocation per
//! ray once the list has grown; what is reported does not depend on the order of the search.

use smallvec::SmallVec;

use super::search::Each;
use super::work::{Tally, Uncounted};
use super::{Entry, Geometry, Hit, Solid, Work};
use crate::shape::local::Met;
use crate::shape::{Chord, Crossing, Ray};

impl Geometry {
    /// Adds to `hits` every crossing with a clear surface that casts shadows and is certainly nearer
    /// than `distance` (which may be ∞), in no order. What it takes is added to `work` by a geometry
    /// that is [`Geometry::counting`].
    pub fn filters(&self, ray: &Ray, distance: f64, hits: &mut Vec<Hit>, work: &mut Work) {
        match self.counts() {
            true => self.filtering().filters_with(ray, distance, hits, work),
            false => self.filtering().filters_with(ray, distance, hits, Uncounted),
        }
    }

    fn filters_with<T: Tally>(&self, ray: &Ray, distance: f64, hits: &mut Vec<Hit>, tally: T) {
        let look = |place: usize, tally: &mut T| {
            let entry = &self.entries[place];
            if !entry.filters {
                return distance;
            }
            let clear = |leaf: &Entry| leaf.filters;
            let ahead = |hit: &Hit| hit.is_ahead() && hit.t + hit.error < distance;
            hits.extend(self.seen(entry, ray, clear, tally).into_iter().filter(ahead));
            distance
        };
        self.search(ray, distance, &mut Each(tally, look));
    }

    /// A ray went through the surface at `hit`, and others may coincide with that. Adds to `hits`
    /// those of other objects that a ray from `start`, which goes straight on from behind the
    /// surface, will not meet any more, in the order of the objects; one that it has gone through
    /// in and out is there twice. What it takes is added to `work` by a geometry that is
    /// [`Geometry::counting`].
    #[cold]
    #[inline(never)]
    pub fn coinciding(
        &self,
        ray: &Ray,
        hit: &Hit,
        start: &Ray,
        hits: &mut Vec<Hit>,
        work: &mut Work,
    ) {
        let mut found = Work::default();
        let limit = self.end_of_first(ray, &mut found);
        let first = hits.len();
        let look = |place: usize, tally: &mut &mut Work| {
            let entry = &self.entries[place];
            if self.holds(entry, hit.object) {
                return limit;
            }
            let seen = self.seen(entry, ray, |_| true, tally);
            for (place, hit) in seen.iter().enumerate() {
                // Its own bound may be wider than that of the surface that was hit.
                if hit.is_ahead() && hit.t <= limit + 2.0 * hit.error {
                    // So many crossings before the end of the line it is found again.
                    let after = seen.len() - place;
                    let from_start = self.seen(entry, start, |_| true, tally);
                    let again = from_start.len().checked_sub(after).map(|i| from_start[i]);
                    let still_ahead =
                        again.is_some_and(|again| again.leaving == hit.leaving && again.is_ahead());
                    if !still_ahead {
                        hits.push(*hit);
                    }
                }
            }
            limit
        };
        self.search(ray, limit, &mut Each(&mut found, look));
        if self.counts() {
            *work += found;
        }
        hits[first..].sort_by_key(|hit| (hit.object, hit.leaving));
    }

    /// A ray starts inside of `object`, on its surface, but for a distance `off`. Where it leaves that, or
    /// what it is a part of, if it does so at its very start: in an edge, or where what is left of the
    /// solid is too thin to be told. What is met first lies at `limit`. What it takes is added to `work`
    /// by a geometry that is [`Geometry::counting`].
    #[cold]
    #[inline(never)]
    pub fn left_at_start(
        &self,
        ray: &Ray,
        object: u32,
        off: f64,
        limit: f64,
        work: &mut Work,
    ) -> Option<Hit> {
        let (mut found, mut left) = (Work::default(), None);
        let look = |place: usize, tally: &mut &mut Work| {
            let entry = &self.entries[place];
            if !self.holds(entry, object) {
                return limit;
            }
            let seen = self.seen(entry, ray, |_| true, tally);
            let last = seen.into_iter().rfind(|hit| !hit.is_ahead());
            left = last.filter(|hit| hit.leaving && hit.t + hit.error + off >= 0.0);
            f64::NEG_INFINITY
        };
        self.search(ray, limit, &mut Each(&mut found, look));
        if self.counts() {
            *work += found;
        }
        left
    }

    /// All crossings that are seen, in order; of a whole, those with leaves that count.
    fn seen(
        &self,
        entry: &Entry,
        ray: &Ray,
        counts: fn(&Entry) -> bool,
        tally: &mut impl Tally,
    ) -> Seen {
        tally.root_solve(|| self.price(entry));
        let chord = match &entry.solid {
            Solid::Sphere(sphere) => sphere.chord(ray),
            Solid::Plane(plane) => plane.chord(ray),
            Solid::Box(i) => self.boxes[*i as usize].0.chord(ray),
            Solid::Ellipsoid(i) => self.ellipsoids[*i as usize].chord(ray),
            Solid::Placed(i) => {
                let all = self.placed[*i as usize].crossings(ray).into_iter();
                let seen = all.filter(|met| met.is_seen() && entry.sides.shows(met.leaving));
                return seen.map(|met| entry.hit(met)).collect();
            }
            Solid::Whole(i) => return self.seen_of_whole(*i, ray, counts).collect(),
        };
        let Some(Chord { enter, leave }) = chord else { return Seen::new() };
        let seen = |&(_, leaving): &(Crossing, bool)| entry.sides.shows(leaving);
        let ends = [(enter, false), (leave, true)].into_iter().filter(seen);
        // A flat box is one sheet.
        let is_flat = |i: u32| self.boxes[i as usize].0.is_flat();
        let is_sheet = enter.t == leave.t && matches!(entry.solid, Solid::Box(i) if is_flat(i));
        let all = ends.map(|(crossing, leaving)| entry.hit(Met::of(crossing, leaving)));
        all.take(if is_sheet { 1 } else { 2 }).collect()
    }

    /// Whether an object is the entry's, or a part of it.
    fn holds(&self, entry: &Entry, object: u32) -> bool {
        match entry.solid {
            Solid::Whole(i) => {
                self.wholes[i as usize].leaves.iter().any(|leaf| leaf.object == object)
            }
            Solid::Sphere(_)
            | Solid::Plane(_)
            | Solid::Box(_)
            | Solid::Ellipsoid(_)
            | Solid::Placed(_) => entry.object == object,
        }
    }
}

/// Most solids are crossed twice.
type Seen = SmallVec<[Hit; 2]>;

impl Hit {
    fn is_ahead(&self) -> bool {
        Crossing { t: self.t, error: self.error }.is_ahead()
    }
}

impl Entry {
    #[inline(always)]
    pub(super) fn hit(&self, Met { t, error, leaving, part }: Met) -> Hit {
        Hit { object: self.object, t, error, leaving, part, contested: false }
    }
}
