//! Wholes: where a ray meets solids made of others, by the algebra of `shape/csg.rs`.
//!
//! **Invariant:** each leaf is crossed by its own kernel; what is not the whole's is left out.

use std::ops::Range;

use super::tree::Tree;
use super::work::Uncounted;
use super::{Entry, Geometry, Hit, Solid, TREE_FROM, build};
use crate::shape::body::{Crossings, Local, Met};
use crate::shape::csg::{self, Event, Events};
use crate::shape::{Bounds, Chord, Crossing, Ray};
use crate::world;

/// The cosine of the angle between two faces from which on they are the sides of something thin.
const ALONG: f64 = 0.99;

/// A solid made of others.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Whole {
    pub nodes: csg::Tree,
    /// In the order of the nodes.
    pub leaves: Vec<Entry>,
    /// Those that every line may meet.
    pub always: Vec<u32>,
    /// The others, in the order in which the tree's leaves name them. Without a tree there are none.
    pub tree: Option<(Tree, Vec<u32>)>,
}

impl Whole {
    pub fn new(whole: &world::Whole, leaves: Vec<Entry>, bounds: Vec<Option<Bounds>>) -> Self {
        let (mut always, mut bounded) = (Vec::new(), Vec::new());
        for (leaf, bounds) in (0..).zip(bounds) {
            match bounds {
                Some(bounds) => bounded.push((leaf, bounds)),
                None => always.push(leaf),
            }
        }
        let tree = if bounded.len() < TREE_FROM {
            always = (0..leaves.len() as u32).collect();
            None
        } else {
            let boxes: Vec<Bounds> = bounded.iter().map(|(_, bounds)| *bounds).collect();
            let (tree, order) = build::tree(&boxes);
            Some((tree, order.into_iter().map(|place| bounded[place as usize].0).collect()))
        };
        Self { nodes: csg::Tree::new(&whole.nodes), leaves, always, tree }
    }

    /// What it takes to find where a line crosses it, from what that takes of each leaf: twice as much
    /// (as of `Local::price`), of leaves in a tree for those that lie along a line.
    pub fn price(&self, leaf: impl Fn(&u32) -> u64) -> u64 {
        let always: u64 = self.always.iter().map(&leaf).sum();
        let along = self.tree.iter().map(|(_, order)| {
            let all: u64 = order.iter().map(&leaf).sum();
            let count = order.len().max(1);
            all * 2 * u64::from(count.ilog2() + 1) / count as u64
        });
        6 + 2 * (always + along.sum::<u64>())
    }

    /// Shows `look` every leaf that the line of a ray may meet, on both sides of its start.
    pub fn search(&self, ray: &Ray, mut look: impl FnMut(u32)) {
        self.always.iter().for_each(|&leaf| look(leaf));
        if let Some((tree, order)) = &self.tree {
            let show = |places: Range<usize>, limit| {
                order[places].iter().for_each(|&leaf| look(leaf));
                limit
            };
            tree.visit::<Uncounted>(&tree.space.before(ray), f64::INFINITY, show);
        }
    }
}

impl Geometry {
    /// All crossings with a whole, in order.
    pub(super) fn events(&self, whole: &Whole, ray: &Ray) -> Events {
        let mut events = Events::new();
        whole.search(ray, |leaf| {
            let solid = &whole.leaves[leaf as usize].solid;
            let sheet = self.is_sheet(solid);
            let (mut inside, mut last) = (false, None);
            let mut all = self.crossings(solid, ray);
            self.drop_grazed(solid, ray, &mut all);
            for met in all {
                // What is told twice was not crossed.
                if sheet || met.leaving == inside {
                    // 0 and −0 are one place: what ends there has begun before.
                    let met = Met { t: met.t + 0.0, ..met };
                    events.push(Event { met, leaf, sheet, last, shared: false });
                    (inside, last) = (!met.leaving, Some(met.t));
                }
            }
        });
        if !events.is_empty() {
            // Stable: those of one leaf stay as they are.
            events.sort_by(|a, b| a.met.t.total_cmp(&b.met.t).then(a.leaf.cmp(&b.leaf)));
            whole.nodes.keep(&mut events);
        }
        events
    }

    /// Drops what a line enters and leaves at an edge, in one place as far as rounding tells: between solids that
    /// share the edge it would be something, and it is nothing.
    fn drop_grazed(&self, solid: &Solid, ray: &Ray, all: &mut Crossings) {
        let mut at = 0;
        while let [enter, leave, ..] = all[at..] {
            let is_one = !enter.leaving && leave.leaving && {
                leave.t - leave.error <= enter.t + enter.error && enter.t.is_finite()
            };
            if is_one && self.meets_edge(solid, ray, enter.t, leave.t) {
                all.drain(at..at + 2);
            } else {
                at += 1;
            }
        }
    }

    /// Whether the faces where a line enters and leaves are those of an edge, and not the two sides of something
    /// thin.
    #[cold]
    #[inline(never)]
    fn meets_edge(&self, solid: &Solid, ray: &Ray, enter: f64, leave: f64) -> bool {
        let surface = |t: f64, leaving| match solid {
            Solid::Box(i) => Some(self.boxes[*i as usize].0.surface(ray, t, leaving)),
            Solid::Placed(i) => Some(self.placed[*i as usize].surface(ray, t, leaving)),
            Solid::Sphere(_) | Solid::Plane(_) | Solid::Ellipsoid(_) | Solid::Whole(_) => None,
        };
        let (Some(one), Some(other)) = (surface(enter, false), surface(leave, true)) else {
            return false;
        };
        one.normal.dot(other.normal).abs() < ALONG
    }

    fn is_sheet(&self, solid: &Solid) -> bool {
        matches!(solid, Solid::Placed(i) if self.placed[*i as usize].body.is_sheet())
    }

    /// Where the ray's line crosses the surface of a solid; at −∞ where it comes from inside.
    pub(super) fn crossings(&self, solid: &Solid, ray: &Ray) -> Crossings {
        let met = |Crossing { t, error }, leaving| Met { t, error, leaving, part: 0 };
        let from_inside = Met { part: Met::UNSEEN, ..met(Crossing::BEFORE_ALL, false) };
        solid.compiled();
        let chord = match solid {
            Solid::Sphere(sphere) => sphere.chord(ray),
            Solid::Plane(plane) => plane.chord(ray),
            Solid::Box(i) => self.boxes[*i as usize].0.chord(ray),
            Solid::Ellipsoid(i) => self.ellipsoids[*i as usize].chord(ray),
            Solid::Placed(i) => {
                let placed = &self.placed[*i as usize];
                let mut all = placed.crossings_of_part(ray);
                let inside = match all.first() {
                    Some(first) => first.leaving && !placed.body.is_sheet(),
                    None => placed.body.reach() == f64::INFINITY && placed.holds(ray),
                };
                if inside {
                    all.insert(0, from_inside);
                }
                return all;
            }
            // A whole's leaves are no wholes.
            Solid::Whole(_) => None,
        };
        let Some(Chord { enter, leave }) = chord else { return Crossings::new() };
        let enter = if enter.t.is_finite() { met(enter, false) } else { from_inside };
        let leave = leave.t.is_finite().then_some(met(leave, true));
        [Some(enter), leave].into_iter().flatten().collect()
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
            let contested = event.shared;
            seen.then(|| Hit { contested, ..leaf.hit(met.crossing(), met.leaving) })
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
        let part = all.find(|hit| hit.t == crossing.t && hit.leaving == leaving);
        let (object, contested) =
            part.map_or((entry.object, false), |hit| (hit.object, hit.contested));
        Hit { object, contested, ..entry.hit(crossing, leaving) }
    }
}
