//! Where rays meet the World: nearest hits and obstructions, and nothing of light.
//!
//! **In:** a [`World`], a [`Ray`]. **Out:** a [`Hit`], or whether something is in the way.
//! **Invariant:** the answer is that of trying every object in any order: the tree finds, the
//! kernels in `shape/` decide. No allocation per ray, no recursion.

mod balls;
mod build;
mod single;
mod through;
mod tree;

use crate::math::Vector;
use crate::shape::{
    Bounds, Box_, Chord, Crossing, Ellipsoid, Plane, Ray, Shape, Sphere, SurfacePoint, sphere,
};
use crate::world::World;
use balls::{Ball, Balls};
use tree::Tree;

/// Fewer bounded objects than this need no tree, only [`Balls`]: faster, as measured by
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
    /// Without a tree: around the bounded, four by four.
    balls: Vec<Balls>,
    /// With the square of the radius that holds each.
    boxes: Vec<(Box_, f64)>,
    ellipsoids: Vec<Ellipsoid>,
    /// Shapes are met in single precision.
    single: bool,
}

/// An object, as far as rays ask.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Entry {
    solid: Solid,
    object: u32,
    sides: Sides,
    /// It stops light.
    blocks: bool,
    /// It stops part of the light, or none: it casts a shadow and is clear.
    filters: bool,
    /// Light goes through, at least in places.
    clear: bool,
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
    /// Distance along the ray.
    pub t: f64,
    /// The ray leaves the solid here; where it enters, normal and direction are opposed.
    pub leaving: bool,
    /// Error bounds could not tell it from a crossing of another object.
    pub contested: bool,
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
            balls: Vec::new(),
            boxes: Vec::with_capacity(world.boxes.len()),
            ellipsoids: Vec::with_capacity(world.ellipsoids.len()),
            single: false,
        };
        for object in unbounded.into_iter().chain(order) {
            geometry.append(world, object);
        }
        if geometry.tree.is_none() {
            let bounded = geometry.entries[geometry.unbounded..].iter();
            let balls: Vec<Ball> = bounded.map(|entry| geometry.ball(&entry.solid)).collect();
            geometry.balls = balls.chunks(balls::LANES).map(Balls::new).collect();
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
        let clear = world.materials[object.material as usize].pigment.is_clear();
        let (blocks, filters) = (object.casts_shadow && !clear, object.casts_shadow && clear);
        self.entries.push(Entry { solid, object: number, sides, blocks, filters, clear });
    }

    fn ball(&self, solid: &Solid) -> Ball {
        match *solid {
            Solid::Sphere(Sphere { centre, radius }) => Ball::new(centre, radius * radius),
            Solid::Box(i) => {
                let (box_, reach_squared) = self.boxes[i as usize];
                Ball::new(box_.centre, reach_squared)
            }
            Solid::Plane(_) | Solid::Ellipsoid(_) => Ball::EVERYWHERE,
        }
    }

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
    fn end_of_first(&self, ray: &Ray) -> f64 {
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

    /// Shows `seeker` every entry that the ray may meet at `limit` or before.
    #[inline(always)]
    fn search(&self, ray: &Ray, limit: f64, seeker: &mut impl Seeker) {
        let mut limit = limit;
        for place in 0..self.unbounded {
            if self.entries[place].is_ahead(ray) {
                limit = look(seeker, place);
                if limit == f64::NEG_INFINITY {
                    return;
                }
            }
        }
        if let Some(tree) = &self.tree {
            self.search_tree(tree, ray, limit, seeker);
            return;
        }
        for (group, balls) in self.balls.iter().enumerate() {
            let first = self.unbounded + group * balls::LANES;
            let mut met = balls.met(ray);
            while met != 0 {
                if look(seeker, first + met.trailing_zeros() as usize) == f64::NEG_INFINITY {
                    return;
                }
                met &= met - 1;
            }
        }
    }

    /// Not inlined: a search without a tree stays short, and its numbers in registers.
    #[inline(never)]
    fn search_tree(&self, tree: &Tree, ray: &Ray, limit: f64, seeker: &mut impl Seeker) {
        tree.visit(ray, limit, |leaf, limit| {
            let mut limit = limit;
            for place in leaf.start + self.unbounded..leaf.end + self.unbounded {
                limit = seeker.look(place);
                if limit == f64::NEG_INFINITY {
                    break;
                }
            }
            limit
        });
    }

    /// Where the ray first meets a side of the object that is seen, at `limit` or before, and whether
    /// it leaves the solid there. The error bound is the tightest or, at less cost, an easy one.
    #[inline(always)]
    fn first_crossing<const BOUND: bool>(
        &self,
        entry: &Entry,
        ray: &Ray,
        limit: f64,
    ) -> Option<(Crossing, bool)> {
        let chord = match &entry.solid {
            Solid::Sphere(Sphere { centre, radius }) => {
                let roots = sphere::roots_ahead(*centre, *radius, ray)?;
                // Behind the start or too far: no error bounds are needed.
                if roots.leave() <= 0.0 || roots.enter() > limit {
                    return None;
                }
                let leaving = entry.sides == Sides::Inside;
                let t = if leaving { roots.leave() } else { roots.enter() };
                if BOUND == EASY
                    && let Some(crossing) = roots.roughly(t)
                {
                    return (t <= limit).then_some((crossing, leaving));
                }
                roots.chord()
            }
            Solid::Plane(plane) => {
                let (speed, t) = plane.pass(ray)?;
                let leaving = speed > 0.0;
                if t > limit || !entry.sides.shows(leaving) {
                    return None;
                }
                if BOUND == EASY
                    && let Some(crossing) = plane.roughly(ray, speed, t)
                {
                    return Some((crossing, leaving));
                }
                plane.chord(ray)?
            }
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
        (crossing.t <= limit).then_some((crossing, leaving))
    }
}

impl Entry {
    /// `false` when the ray certainly meets nothing of it.
    #[inline(always)]
    fn is_ahead(&self, ray: &Ray) -> bool {
        match &self.solid {
            Solid::Plane(plane) => plane.is_ahead(ray),
            Solid::Sphere(_) | Solid::Box(_) | Solid::Ellipsoid(_) => true,
        }
    }
}

impl Sides {
    /// Whether a surface is seen where a ray leaves the solid, or enters it.
    #[inline(always)]
    fn shows(self, leaving: bool) -> bool {
        match self {
            Self::Both => true,
            Self::Outside => !leaving,
            Self::Inside => leaving,
        }
    }

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

/// Which error bound of a crossing is wanted.
const EASY: bool = false;
const TIGHT: bool = true;

/// Who looks for something among the entries.
///
/// A trait and not a closure: its one method is inlined into each of the search's loops.
trait Seeker {
    /// Looks at the entry of that place; returns the limit from then on (−∞ ends the search).
    fn look(&mut self, place: usize) -> f64;
}

impl<F: FnMut(usize) -> f64> Seeker for F {
    #[inline(always)]
    fn look(&mut self, place: usize) -> f64 {
        self(place)
    }
}

/// As `seeker.look(place)`, not inlined: where little is looked at, the search itself is short.
#[inline(never)]
fn look(seeker: &mut impl Seeker, place: usize) -> f64 {
    seeker.look(place)
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
#[inline(always)]
pub fn surface(world: &World, ray: &Ray, hit: &Hit) -> SurfacePoint {
    let Hit { object, t, leaving, .. } = *hit;
    match world.objects[object as usize].shape {
        Shape::Sphere(i) => world.spheres[i as usize].surface(ray, t),
        Shape::Plane(i) => world.planes[i as usize].surface(ray, t),
        Shape::Box(i) => world.boxes[i as usize].surface(ray, t, leaving),
        Shape::Ellipsoid(i) => world.ellipsoids[i as usize].surface(ray, t),
    }
}

#[cfg(test)]
mod tests;
