//! Where rays meet the World: nearest hits and obstructions, and nothing of light.
//!
//! **In:** a [`World`], a [`Ray`]. **Out:** a [`Hit`], or whether something is in the way.
//! **Invariant:** the answer is that of trying every object in any order: the tree finds, the
//! kernels in `shape/` decide. No allocation per ray, no recursion.

mod build;
mod tree;

use std::ops::Range;

use crate::math::Vector;
use crate::shape::{
    Bounds, Box_, Chord, Crossing, Ellipsoid, Plane, Ray, Shape, Sphere, SurfacePoint, sphere,
};
use crate::world::World;
use tree::Tree;

/// Fewer bounded objects than this are tried one after the other: faster, as measured by
/// `cargo bench --bench intersect`.
const TREE_FROM: usize = 8;

/// A World's objects arranged for rays. The shapes are copied in the order in which the tree's
/// leaves name them, so that a leaf's lie side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// The unbounded first, then the leaves in turn.
    entries: Vec<Entry>,
    /// How many are unbounded.
    unbounded: usize,
    tree: Option<Tree>,
    /// With the square of the radius that holds each.
    boxes: Vec<(Box_, f64)>,
    ellipsoids: Vec<Ellipsoid>,
}

/// An object, as far as rays ask.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Entry {
    solid: Solid,
    object: u32,
    sides: Sides,
    casts_shadow: bool,
}

/// What is small stands in the entry itself, so that a leaf is one run of memory; what is not, in
/// a list of [`Geometry`].
#[derive(Debug, Clone, Copy, PartialEq)]
enum Solid {
    Sphere(Sphere),
    Plane(Plane),
    Box(u32),
    Ellipsoid(u32),
}

/// Which crossings of a solid are seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sides {
    Both,
    /// The surface has the seed's finish: seen from outside only.
    Outside,
    /// The same, inside and outside exchanged.
    Inside,
}

/// What shadows a ray: an entry of a [`Geometry`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Occluder(usize);

impl Occluder {
    /// Nothing does.
    pub const NONE: Self = Self(usize::MAX);
}

/// The first surface a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Index into `World::objects`.
    pub object: u32,
    pub crossing: Crossing,
    /// The ray leaves the solid here; where it enters, normal and direction are opposed.
    pub leaving: bool,
}

impl Geometry {
    pub fn build(world: &World) -> Self {
        let (bounded, unbounded): (Vec<u32>, Vec<u32>) =
            (0..world.objects.len() as u32).partition(|&object| bounds(world, object).is_some());
        let (tree, order) = if bounded.len() < TREE_FROM {
            (None, bounded)
        } else {
            let boxes = bounded.iter().filter_map(|&object| bounds(world, object));
            let (tree, order) = build::tree(&boxes.collect::<Vec<_>>());
            (Some(tree), order.into_iter().map(|place| bounded[place as usize]).collect())
        };
        let mut geometry = Self {
            entries: Vec::with_capacity(world.objects.len()),
            unbounded: unbounded.len(),
            tree,
            boxes: Vec::with_capacity(world.boxes.len()),
            ellipsoids: Vec::with_capacity(world.ellipsoids.len()),
        };
        for object in unbounded.into_iter().chain(order) {
            geometry.append(world, object);
        }
        geometry
    }

    fn append(&mut self, world: &World, number: u32) {
        fn copy<T: Copy>(list: &mut Vec<T>, shape: T) -> u32 {
            list.push(shape);
            list.len() as u32 - 1
        }
        let object = &world.objects[number as usize];
        let solid = match object.shape {
            Shape::Sphere(i) => Solid::Sphere(world.spheres[i as usize]),
            Shape::Plane(i) => Solid::Plane(world.planes[i as usize]),
            Shape::Box(i) => {
                let box_ = world.boxes[i as usize];
                Solid::Box(copy(&mut self.boxes, (box_, box_.reach_squared())))
            }
            Shape::Ellipsoid(i) => {
                Solid::Ellipsoid(copy(&mut self.ellipsoids, world.ellipsoids[i as usize]))
            }
        };
        let sides = if !world.materials[object.material as usize].finish.seed {
            Sides::Both
        } else if object.inverse {
            Sides::Inside
        } else {
            Sides::Outside
        };
        let casts_shadow = object.casts_shadow;
        self.entries.push(Entry { solid, object: number, sides, casts_shadow });
    }

    /// The first surface ahead of the ray's start. Of crossings that their error bounds cannot
    /// tell apart, the first-declared object's: with U the least t + 2·error of all, the least
    /// object among those with t ≤ U. So it does not depend on the order of search, and one of two
    /// coinciding faces wins everywhere.
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let mut race = Race::new();
        match &self.tree {
            None => self.run(0..self.entries.len(), ray, &mut race),
            Some(tree) => {
                self.run(0..self.unbounded, ray, &mut race);
                tree.visit(ray, race.limit, |leaf| {
                    self.run(self.places(leaf), ray, &mut race);
                    race.limit
                });
            }
        }
        if race.contested() { self.first_declared(ray, race.limit) } else { race.best }
    }

    #[inline(always)]
    fn run(&self, places: Range<usize>, ray: &Ray, race: &mut Race) {
        for entry in &self.entries[places] {
            if let Some(hit) = self.first_crossing(entry, ray, race.limit) {
                race.enter(hit);
            }
        }
    }

    /// The first-declared object whose first crossing is at `limit` or before.
    #[cold]
    fn first_declared(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        let mut first: Option<Hit> = None;
        let mut look = |places: Range<usize>| {
            for entry in &self.entries[places] {
                if first.is_some_and(|first| first.object < entry.object) {
                    continue;
                }
                first = self.first_crossing(entry, ray, limit).or(first);
            }
            limit
        };
        match &self.tree {
            None => {
                look(0..self.entries.len());
            }
            Some(tree) => {
                look(0..self.unbounded);
                tree.visit(ray, limit, |leaf| look(self.places(leaf)));
            }
        }
        first
    }

    /// Whether a surface that casts shadows is certainly nearer than `distance` (which may be ∞).
    /// Surfaces seen from one side shadow from that side.
    pub fn occluded(&self, ray: &Ray, distance: f64) -> bool {
        self.occluder(ray, distance, Occluder::NONE) != Occluder::NONE
    }

    /// As [`Geometry::occluded`], and by what. `guess` is tried first: what shadowed the last ray
    /// is likely to shadow the next, and any answer but `NONE` is as good as another.
    pub fn occluder(&self, ray: &Ray, distance: f64, guess: Occluder) -> Occluder {
        let shadows = |entry: &Entry| {
            entry.casts_shadow
                && self
                    .first_crossing(entry, ray, distance)
                    .is_some_and(|hit| hit.crossing.t + hit.crossing.error < distance)
        };
        let first = |places: Range<usize>| {
            let start = places.start;
            let found = self.entries[places].iter().position(shadows);
            found.map_or(Occluder::NONE, |place| Occluder(start + place))
        };
        let Some(tree) = &self.tree else { return first(0..self.entries.len()) };
        if self.entries.get(guess.0).is_some_and(shadows) {
            return guess;
        }
        let mut found = first(0..self.unbounded);
        if found == Occluder::NONE {
            let look = |leaf| {
                found = first(self.places(leaf));
                if found == Occluder::NONE { distance } else { f64::NEG_INFINITY }
            };
            tree.visit(ray, distance, look);
        }
        found
    }

    /// Where the entries of a leaf lie.
    #[inline(always)]
    fn places(&self, leaf: Range<usize>) -> Range<usize> {
        leaf.start + self.unbounded..leaf.end + self.unbounded
    }

    /// Where the ray first meets a side of the object that is seen, at `limit` or before.
    #[inline(always)]
    fn first_crossing(&self, entry: &Entry, ray: &Ray, limit: f64) -> Option<Hit> {
        let chord = match &entry.solid {
            Solid::Sphere(Sphere { centre, radius }) => {
                let roots = sphere::roots_ahead(*centre, *radius, ray)?;
                // Behind the start or too far: no error bounds are needed.
                if roots.leave() <= 0.0 || roots.enter() > limit {
                    return None;
                }
                roots.chord()
            }
            Solid::Plane(plane) => plane.chord_ahead(ray)?,
            Solid::Box(i) => {
                let (box_, reach_squared) = &self.boxes[*i as usize];
                if box_.is_out_of_reach(*reach_squared, ray) {
                    return None;
                }
                box_.chord(ray)?
            }
            Solid::Ellipsoid(i) => self.ellipsoids[*i as usize].chord(ray)?,
        };
        let (crossing, leaving) = entry.sides.first_seen(&chord)?;
        (crossing.t <= limit).then_some(Hit { object: entry.object, crossing, leaving })
    }
}

impl Sides {
    #[inline(always)]
    fn first_seen(self, chord: &Chord) -> Option<(Crossing, bool)> {
        let enters = || chord.enter.is_ahead().then_some((chord.enter, false));
        let leaves = || chord.leave.is_ahead().then_some((chord.leave, true));
        match self {
            Self::Both => enters().or_else(leaves),
            Self::Outside => enters(),
            Self::Inside => leaves(),
        }
    }
}

/// The nearest crossing so far, and whether another may be as near.
struct Race {
    best: Option<Hit>,
    best_t: f64,
    /// The least t among the others.
    rival_t: f64,
    /// The least t + 2·error: what is farther is certainly not first.
    limit: f64,
}

impl Race {
    fn new() -> Self {
        let beyond = f64::INFINITY;
        Self { best: None, best_t: beyond, rival_t: beyond, limit: beyond }
    }

    #[inline(always)]
    fn enter(&mut self, hit: Hit) {
        let Crossing { t, error } = hit.crossing;
        self.limit = self.limit.min(t + 2.0 * error);
        if t < self.best_t {
            self.rival_t = self.best_t;
            (self.best, self.best_t) = (Some(hit), t);
        } else {
            self.rival_t = self.rival_t.min(t);
        }
    }

    fn contested(&self) -> bool {
        self.best.is_some() && self.rival_t <= self.limit
    }
}

/// A box around an object; `None` when it is unbounded.
pub fn bounds(world: &World, object: u32) -> Option<Bounds> {
    match world.objects[object as usize].shape {
        Shape::Sphere(i) => Some(world.spheres[i as usize].bounds()),
        Shape::Plane(_) => None,
        Shape::Box(i) => Some(world.boxes[i as usize].bounds()),
        Shape::Ellipsoid(i) => Some(world.ellipsoids[i as usize].bounds()),
    }
}

/// Whether a point lies inside an object: outside of its shape, if it is `inverse`.
pub fn contains(world: &World, object: u32, point: Vector) -> bool {
    let object = &world.objects[object as usize];
    let inside = match object.shape {
        Shape::Sphere(i) => world.spheres[i as usize].contains(point),
        Shape::Plane(i) => world.planes[i as usize].contains(point),
        Shape::Box(i) => world.boxes[i as usize].contains(point),
        Shape::Ellipsoid(i) => world.ellipsoids[i as usize].contains(point),
    };
    inside != object.inverse
}

/// The surface at a hit of `ray`; its normal points out of the solid, whichever way the ray goes.
#[inline]
pub fn surface(world: &World, ray: &Ray, hit: &Hit) -> SurfacePoint {
    let Hit { object, crossing, leaving } = hit;
    match world.objects[*object as usize].shape {
        Shape::Sphere(i) => world.spheres[i as usize].surface(ray, crossing.t),
        Shape::Plane(i) => world.planes[i as usize].surface(ray, crossing.t),
        Shape::Box(i) => world.boxes[i as usize].surface(ray, crossing, *leaving),
        Shape::Ellipsoid(i) => world.ellipsoids[i as usize].surface(ray, crossing.t),
    }
}

#[cfg(test)]
mod tests;
