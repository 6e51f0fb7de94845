//! Wholes: where a ray meets solids made of others, by the algebra of `shape/csg.rs`.
//!
//! **Invariant:** each leaf is crossed by its own kernel; what is not the whole's is left out.

use smallvec::SmallVec;

use super::{Entry, Geometry, Hit, Solid};
use crate::shape::body::{Crossings, Local, Met};
use crate::shape::csg::{self, Event, Insides, Node};
use crate::shape::{Chord, Crossing, Ray};

/// A solid made of others.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Whole {
    pub nodes: Vec<Node>,
    /// In the order of the nodes.
    pub leaves: Vec<Entry>,
}

/// The crossings with a whole.
type Events = SmallVec<[Event; 16]>;

impl Geometry {
    /// All crossings with a whole, in order.
    fn events(&self, whole: &Whole, ray: &Ray) -> Events {
        let mut events = Events::new();
        let mut insides = Insides::new();
        for (leaf, entry) in whole.leaves.iter().enumerate() {
            let (inside, crossings) = self.crossings(&entry.solid, ray);
            insides.push(inside);
            let sheet =
                matches!(entry.solid, Solid::Placed(i) if self.placed[i as usize].body.is_sheet());
            let leaf = leaf as u32;
            events.extend(crossings.into_iter().map(|met| Event { met, leaf, sheet }));
        }
        if !events.is_empty() {
            // Stable: of equals that of the first leaf.
            events.sort_by(|a, b| a.met.t.total_cmp(&b.met.t));
            csg::keep(&whole.nodes, &mut insides, &mut events);
        }
        events
    }

    /// Whether the ray's line comes from inside of a solid, and where it crosses its surface.
    fn crossings(&self, solid: &Solid, ray: &Ray) -> (bool, Crossings) {
        let chord = match solid {
            Solid::Sphere(sphere) => sphere.chord(ray),
            Solid::Plane(plane) => plane.chord(ray),
            Solid::Box(i) => self.boxes[*i as usize].0.chord(ray),
            Solid::Ellipsoid(i) => self.ellipsoids[*i as usize].chord(ray),
            Solid::Placed(i) => {
                let placed = &self.placed[*i as usize];
                let all = placed.crossings(ray);
                let inside = match all.first() {
                    Some(first) => first.leaving && !placed.body.is_sheet(),
                    None => placed.body.reach() == f64::INFINITY && placed.contains(ray.origin),
                };
                return (inside, all);
            }
            // A whole's leaves are no wholes.
            Solid::Whole(_) => None,
        };
        let Some(Chord { enter, leave }) = chord else { return (false, Crossings::new()) };
        let met = |Crossing { t, error }, leaving| Met { t, error, leaving, part: 0 };
        let ends = [met(enter, false), met(leave, true)];
        let inside = enter.t == f64::NEG_INFINITY;
        (inside, ends.into_iter().filter(|met| met.t.is_finite()).collect())
    }

    /// The crossings with those leaves of a whole that `counts`, in order, as hits.
    pub(super) fn seen_of_whole(
        &self,
        whole: u32,
        ray: &Ray,
        counts: fn(&Entry) -> bool,
    ) -> impl Iterator<Item = Hit> {
        let whole = &self.wholes[whole as usize];
        let leaf = |event: &Event| &whole.leaves[event.leaf as usize];
        self.events(whole, ray).into_iter().filter_map(move |event| {
            let leaf = leaf(&event);
            let met = event.met;
            let seen = met.is_seen() && leaf.sides.shows(met.leaving) && counts(leaf);
            seen.then(|| leaf.hit(met.crossing(), met.leaving))
        })
    }

    /// The first of these ahead of the ray's start, at `limit` or before.
    #[inline(never)]
    pub(super) fn first_of_whole(
        &self,
        whole: u32,
        ray: &Ray,
        limit: f64,
        counts: fn(&Entry) -> bool,
    ) -> Option<(Crossing, bool)> {
        let ahead = |hit: &Hit| Crossing { t: hit.t, error: hit.error }.is_ahead();
        let hit = self.seen_of_whole(whole, ray, counts).find(ahead)?;
        (hit.t <= limit).then_some((Crossing { t: hit.t, error: hit.error }, hit.leaving))
    }

    /// The object that is met where an entry is: of a whole, one of its leaves.
    #[inline(always)]
    pub(super) fn hit(&self, entry: &Entry, ray: &Ray, crossing: Crossing, leaving: bool) -> Hit {
        match entry.solid {
            Solid::Whole(whole) => self.hit_of_whole(entry, whole, ray, crossing, leaving),
            Solid::Sphere(_)
            | Solid::Plane(_)
            | Solid::Box(_)
            | Solid::Ellipsoid(_)
            | Solid::Placed(_) => entry.hit(crossing, leaving),
        }
    }

    #[cold]
    #[inline(never)]
    fn hit_of_whole(
        &self,
        entry: &Entry,
        whole: u32,
        ray: &Ray,
        crossing: Crossing,
        leaving: bool,
    ) -> Hit {
        let mut all = self.seen_of_whole(whole, ray, |_| true);
        let object = all.find(|hit| hit.t == crossing.t && hit.leaving == leaving);
        Hit {
            object: object.map_or(entry.object, |hit| hit.object),
            ..entry.hit(crossing, leaving)
        }
    }
}
