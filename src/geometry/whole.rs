//! Wholes: where a ray meets solids made of others, by the algebra of `shape/csg.rs`.
//!
//! **Invariant:** each leaf is crossed by its own kernel; what is not the whole's is left out.

mod near;
pub(super) mod together;

use smallvec::SmallVec;

use super::balls::{self, Ball, Balls};
use super::span::{Around, Span, around};
use super::{Entry, Geometry, Hit, Solid, TREE_FROM, bounds_of_part};
use crate::bvh::Tree;
use crate::shape::csg::{self, Event, Events};
use crate::shape::local::{Crossings, Local, Met};
use crate::shape::{Bounds, Chord, Crossing, Placed, Ray};
use crate::world::{self, World};
use together::Line;

/// The cosine of the angle between two faces from which on they are the sides of something thin.
const ALONG: f64 = 0.99;

/// A solid made of others.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Whole {
    pub nodes: csg::Tree,
    /// In the order of the nodes.
    pub leaves: Vec<Entry>,
    /// Those in which all of it lies, what is easily crossed first.
    pub around: Vec<Around>,
    /// Of each leaf, whether it is one of these.
    pub is_around: Vec<bool>,
    /// Nothing else is a part of it.
    pub is_convex: bool,
    /// It is the intersection of its leaves, and none of these is a sheet.
    pub is_intersection: bool,
    /// What holds it.
    pub bounds: Option<Bounds>,
    /// Around its first leaves, four by four.
    pub balls: [Balls; FOURS],
    /// A bit for each of these that all of it lies in.
    pub inside: u32,
    /// What it takes to find where a line crosses it, in equations of a sphere.
    pub price: u64,
    /// Those that every line may meet.
    pub always: Vec<u32>,
    /// The others, in the order in which the tree's leaves name them. Without a tree there are none.
    pub tree: Option<(Tree, Vec<u32>)>,
}

/// Of so many fours of leaves there are [`Balls`].
const FOURS: usize = 2;
const MOST_BALLS: u32 = (FOURS * balls::LANES) as u32;

/// What is asked of a leaf once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    /// Holds all of it.
    ball: Ball,
    /// `None` where it has no end.
    bounds: Option<Bounds>,
    /// What it takes to find where a line crosses it.
    price: u64,
    /// It has no inside.
    is_sheet: bool,
}

impl Part {
    pub fn of(world: &World, geometry: &Geometry, leaf: &Entry) -> Self {
        let bounds = bounds_of_part(world, leaf.object);
        Self {
            ball: if bounds.is_some() { geometry.ball(world, leaf) } else { Ball::EVERYWHERE },
            bounds,
            price: geometry.price(leaf),
            is_sheet: geometry.is_sheet(&leaf.solid),
        }
    }
}

/// From what it takes of each leaf: twice as much (as of `Local::price`), of leaves in a tree for those that lie
/// along a line.
fn price(parts: &[Part], always: &[u32], tree: Option<&[u32]>) -> u64 {
    let sum = |leaves: &[u32]| leaves.iter().map(|&leaf| parts[leaf as usize].price).sum::<u64>();
    let along = tree.map(|order| {
        let count = order.len().max(1);
        sum(order) * 2 * u64::from(count.ilog2() + 1) / count as u64
    });
    6 + 2 * (sum(always) + along.unwrap_or(0))
}

impl Whole {
    pub fn new(
        whole: &world::CsgSolid,
        leaves: Vec<Entry>,
        parts: &[Part],
        bounds: Option<Bounds>,
    ) -> Self {
        let (mut around, is_all) = around(&whole.nodes);
        let count = around.len();
        let is_intersection = is_all && !parts.iter().any(|part| part.is_sheet);
        // What is outside of something tells a span where that is a plane.
        around.retain(|part| {
            let is_plane = matches!(leaves[part.leaf as usize].solid, Solid::Plane(_));
            !parts[part.leaf as usize].is_sheet && (is_plane || !part.inverse)
        });
        let is_convex = is_all && around.len() == count;
        around.sort_by_key(|part| (parts[part.leaf as usize].price, part.leaf));
        let mut is_around = vec![false; leaves.len()];
        around.iter().for_each(|part| is_around[part.leaf as usize] = true);
        let (mut always, mut bounded) = (Vec::new(), Vec::new());
        for (leaf, part) in (0..).zip(parts) {
            match part.bounds {
                Some(bounds) if !is_around[leaf as usize] => bounded.push((leaf, bounds)),
                _ => always.push(leaf),
            }
        }
        let tree = if bounded.len() < TREE_FROM {
            always = (0..leaves.len() as u32).collect();
            None
        } else {
            let boxes: Vec<Bounds> = bounded.iter().map(|(_, bounds)| *bounds).collect();
            let (tree, order) = Tree::build(&boxes);
            let order = order.into_iter().map(|place| bounded[place as usize].0);
            Some((tree, order.collect::<Vec<u32>>()))
        };
        let price = price(parts, &always, tree.as_ref().map(|(_, order)| order.as_slice()));
        let nodes = csg::Tree::new(&whole.nodes);
        let mut balls = parts.chunks(balls::LANES).map(|parts| {
            let balls: SmallVec<[Ball; balls::LANES]> =
                parts.iter().map(|part| part.ball).collect();
            Balls::new(&balls)
        });
        let balls = [(); FOURS].map(|()| balls.next().unwrap_or_else(|| Balls::new(&[])));
        let inside = around.iter().filter(|part| !part.inverse && part.leaf < MOST_BALLS);
        let inside = inside.fold(0, |all, part| all | 1 << part.leaf);
        Self {
            nodes,
            leaves,
            around,
            is_around,
            is_convex,
            is_intersection,
            bounds,
            balls,
            inside,
            price,
            always,
            tree,
        }
    }

    fn leaf(&self, event: &Event) -> &Entry {
        &self.leaves[event.leaf as usize]
    }

    /// A crossing with the whole. Where several leaves are crossed in one place, which part it is is not known.
    fn hit(&self, event: &Event) -> Hit {
        let contested = event.shared;
        let part = if contested { Met::UNKNOWN } else { event.met.part };
        Hit { contested, part, ..self.leaf(event).hit(event.met) }
    }
}

impl Geometry {
    /// All crossings with a whole, in order.
    pub(super) fn events(&self, whole: &Whole, ray: &Ray) -> Events {
        let mut events = Events::new();
        if !self.gather(whole, &Line::alone(ray), EVERYWHERE, &mut events) {
            whole.nodes.keep(&mut events);
        }
        events
    }

    /// Gathers the crossings with a whole's leaves, in order; returns whether they are the whole's already. None of
    /// the whole's that lie from one place to another are missing.
    fn gather(&self, whole: &Whole, line: &Line, between: (f64, f64), events: &mut Events) -> bool {
        let ray = line.ray;
        let span_of_bounds =
            || whole.bounds.as_ref().map_or(Span::ALL, |bounds| Span::of_bounds(bounds, ray));
        // Of rays in rows these are left out before.
        if line.known.is_none() && span_of_bounds().is_empty() {
            return true;
        }
        let near = line.near(whole);
        if near.0 & whole.inside != whole.inside {
            return true;
        }
        if whole.is_intersection && self.gather_intersection(whole, line, near, between, events) {
            return true;
        }
        let mut span = span_of_bounds();
        for part in &whole.around {
            let leaf = &whole.leaves[part.leaf as usize];
            if near.has(part.leaf) {
                self.with_crossings(part.leaf, &leaf.solid, line, |all| {
                    span = span.and(Span::of_crossings(all, part.inverse));
                    add_events(part.leaf, false, all, EVERYWHERE, events);
                });
            }
            let (low, high) = span.reach();
            if span.is_empty() || high < between.0 || low > between.1 {
                events.clear();
                return true;
            }
        }
        let reach = span.reach();
        whole.search_within(ray, reach, |leaf| {
            if !whole.is_around[leaf as usize] && near.has(leaf) {
                let solid = &whole.leaves[leaf as usize].solid;
                let sheet = self.is_sheet(solid);
                self.with_crossings(leaf, solid, line, |all| {
                    add_events(leaf, sheet, all, reach, events);
                });
            }
        });
        // Stable: those of one leaf stay as they are.
        events.sort_by(|a, b| a.met.t.total_cmp(&b.met.t).then(a.leaf.cmp(&b.leaf)));
        events.is_empty()
    }

    /// Shows `look` where a line crosses a leaf of a whole: a solid is entered and left in turn.
    #[inline(always)]
    fn with_crossings(&self, leaf: u32, solid: &Solid, line: &Line, look: impl FnOnce(&[Met])) {
        if let Solid::Placed(_) = solid {
            look(&self.crossings_of_body(leaf, solid, line));
            return;
        }
        let ray = line.ray;
        let all = self.chord_of_leaf(leaf, solid, line).map(ends_of_chord);
        match &all {
            None => look(&[]),
            Some([enter, leave]) if !leave.t.is_finite() => look(&[*enter]),
            Some([enter, leave])
                if is_grazed(enter, leave) && self.meets_edge(solid, ray, enter, leave) =>
            {
                look(&[]);
            }
            Some(all) => look(all),
        }
    }

    #[inline(never)]
    fn crossings_of_body(&self, leaf: u32, solid: &Solid, line: &Line) -> Crossings {
        let mut all = Crossings::new();
        self.add_crossings_of_leaf(leaf, solid, line, &mut all);
        self.drop_grazed(solid, line.ray, &mut all);
        let mut inside = false;
        if !self.is_sheet(solid) {
            // What is told twice was not crossed.
            all.retain(|met| {
                let is_crossed = met.leaving == inside;
                inside ^= is_crossed;
                is_crossed
            });
        }
        all
    }

    /// Drops what a line enters and leaves at an edge, in one place as far as rounding tells: between solids that
    /// share the edge it would be something, and it is nothing.
    fn drop_grazed(&self, solid: &Solid, ray: &Ray, all: &mut Crossings) {
        let mut at = 0;
        while let [enter, leave, ..] = all[at..] {
            if is_grazed(&enter, &leave) && self.meets_edge(solid, ray, &enter, &leave) {
                all.drain(at..at + 2);
            } else {
                at += 1;
            }
        }
    }

    /// Whether the faces where a line enters and leaves are those of an edge, and not the two sides of something
    /// thin; of what is not there to be seen, nothing tells how it faces.
    #[cold]
    #[inline(never)]
    fn meets_edge(&self, solid: &Solid, ray: &Ray, enter: &Met, leave: &Met) -> bool {
        let surface = |t: f64, leaving| match solid {
            Solid::Box(i) => Some(self.boxes[*i as usize].0.surface(ray, t, leaving)),
            Solid::Placed(i) => Some(self.placed[*i as usize].surface(ray, t, leaving)),
            Solid::Sphere(_) | Solid::Plane(_) | Solid::Ellipsoid(_) | Solid::Whole(_) => None,
        };
        if !(enter.is_seen() && leave.is_seen()) {
            return false;
        }
        let (Some(one), Some(other)) = (surface(enter.t, false), surface(leave.t, true)) else {
            return false;
        };
        one.normal.dot(other.normal).abs() < ALONG
    }

    pub(super) fn is_sheet(&self, solid: &Solid) -> bool {
        matches!(solid, Solid::Placed(i) if self.placed[*i as usize].body.is_sheet())
    }

    /// Where the ray's line crosses the surface of a solid; at −∞ where it comes from inside.
    pub(super) fn crossings(&self, solid: &Solid, ray: &Ray) -> Crossings {
        match solid {
            Solid::Placed(i) => {
                let placed = &self.placed[*i as usize];
                let mut all = placed.crossings_of_part(ray);
                begin_inside(placed, ray, &mut all);
                all
            }
            _ => {
                let ends = self.chord(solid, ray).map(ends_of_chord);
                ends.into_iter().flatten().filter(|met| met.t != f64::INFINITY).collect()
            }
        }
    }

    /// Where the ray's line enters and leaves what is no body.
    #[inline(always)]
    pub(super) fn chord(&self, solid: &Solid, ray: &Ray) -> Option<Chord> {
        match solid {
            Solid::Sphere(sphere) => sphere.chord(ray),
            Solid::Plane(plane) => plane.chord_of_part(ray),
            Solid::Box(i) => self.boxes[*i as usize].0.chord_of_part(ray),
            Solid::Ellipsoid(i) => self.ellipsoids[*i as usize].chord(ray),
            // A body may be crossed more often, and a whole's leaves are no wholes.
            Solid::Placed(_) | Solid::Whole(_) => None,
        }
    }

    /// The crossings with those leaves of a whole that `counts`, in order, as hits.
    pub(super) fn seen_of_whole(
        &self,
        whole: u32,
        ray: &Ray,
        counts: fn(&Entry) -> bool,
    ) -> impl Iterator<Item = Hit> {
        let whole = &self.wholes[whole as usize];
        self.events(whole, ray).into_iter().filter_map(move |event| {
            let leaf = whole.leaf(&event);
            let met = &event.met;
            let seen = met.is_seen() && leaf.sides.shows(met.leaving) && counts(leaf);
            seen.then(|| whole.hit(&event))
        })
    }

    /// The first of these ahead of the ray's start, at `limit` or before.
    #[inline(never)]
    pub(super) fn first_of_whole(
        &self,
        whole: u32,
        line: &Line,
        limit: f64,
        counts: fn(&Entry) -> bool,
    ) -> Option<Hit> {
        let whole = &self.wholes[whole as usize];
        let mut events = Events::new();
        let is_kept = self.gather(whole, line, (0.0, limit), &mut events);
        let is_seen = |event: &Event| {
            let leaf = whole.leaf(event);
            leaf.sides.see(&event.met) && counts(leaf)
        };
        let event = match is_kept {
            true => events.iter().find(|event| is_seen(event)).copied(),
            false => whole.nodes.first(&mut events, is_seen),
        }?;
        (event.met.t <= limit).then(|| whole.hit(&event))
    }
}

/// Adds to the crossings of a line with a body where it enters, if it comes from inside.
fn begin_inside(placed: &Placed, ray: &Ray, all: &mut Crossings) {
    let inside = match all.first() {
        Some(first) => first.leaving && !placed.body.is_sheet(),
        None => placed.body.reach() == f64::INFINITY && placed.holds(ray),
    };
    if inside {
        all.insert(0, FROM_INSIDE);
    }
}

/// All of a line.
pub(super) const EVERYWHERE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

/// Where a line enters what it comes from inside of.
const FROM_INSIDE: Met =
    Met { t: f64::NEG_INFINITY, error: 0.0, leaving: false, part: Met::UNSEEN };

/// Where a line enters and leaves; at ∞ where it does not.
pub(super) fn ends_of_chord(Chord { enter, leave }: Chord) -> [Met; 2] {
    let met = |Crossing { t, error }, leaving| Met { t, error, leaving, part: 0 };
    let enter = if enter.t.is_finite() { met(enter, false) } else { FROM_INSIDE };
    [enter, met(leave, true)]
}

/// Whether a line enters and leaves in one place, as far as rounding tells.
fn is_grazed(enter: &Met, leave: &Met) -> bool {
    let is_one = leave.t - leave.error <= enter.t + enter.error;
    !enter.leaving && leave.leaving && is_one && enter.t.is_finite()
}

/// Adds those crossings of a leaf that are, or begin or end what is, from one place to another.
fn add_events(leaf: u32, sheet: bool, all: &[Met], (low, high): (f64, f64), events: &mut Events) {
    let mut last = None;
    for stretch in all.chunks(if sheet { 1 } else { 2 }) {
        let begin = stretch.first().map_or(f64::INFINITY, |met| met.t);
        let end = match stretch {
            [_, .., end] => end.t,
            [only] if sheet => only.t,
            _ => f64::INFINITY,
        };
        if begin > high || end < low {
            continue;
        }
        for &met in stretch {
            // 0 and −0 are one place: what ends there has begun before.
            let met = Met { t: met.t + 0.0, ..met };
            events.push(Event { met, leaf, sheet, last, shared: false });
            last = Some(met.t);
        }
    }
}
