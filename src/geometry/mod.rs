//! Where rays meet the World: nearest hits and obstructions, and nothing of light.
//!
//! **In:** a [`World`], a [`Ray`]. **Out:** a [`Hit`], or whether something is in the way.
//! **Invariant:** the answer is that of trying every object in any order: the tree finds, the
//! kernels in `shape/` decide. No allocation per ray, no recursion.

mod balls;
mod beside;
mod between;
pub(crate) mod coinciding;
pub(crate) mod doubled;
mod edge;
mod extent;
mod intersection;
mod nearest;
mod occluder;
mod polyhedron;
mod race;
pub(crate) mod reach;
mod search;
mod shades;
mod sides;
mod span;
mod subsets;
mod surface;
mod through;
mod whole;
mod work;

pub(crate) use crate::bvh::shaft::Shaft;
pub use between::Between;
pub use nearest::Hit;
pub use occluder::Occluder;
pub use surface::{SurfacePoints, shading_normal, spread, surface};
pub use work::Work;

use crate::bvh::Tree;
use crate::math::wide::Instructions;
use crate::shape::local::{Local, Met};
use crate::shape::{Bounds, Box_, Ellipsoid, Placed, Plane, Ray, Rounding, Shape, Sphere};
use crate::world::World;
use balls::{Ball, Balls};
use beside::Grain;
pub use extent::Extent;
use sides::Sides;
use whole::together::Line;
use whole::{Part, Whole};

/// Fewer bounded objects need no tree, only [`Balls`] (measured: `cargo bench --bench intersect`).
const TREE_FROM: usize = 8;

/// A World's objects arranged for rays. The shapes are copied in the order in which the tree's
/// leaves name them, so that a leaf's lie side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// The unbounded first, then the leaves in turn.
    entries: Vec<Entry>,
    /// Of each entry.
    grains: Vec<Grain>,
    /// How many are unbounded.
    unbounded: usize,
    tree: Option<Tree>,
    /// Without a tree: around the bounded, four by four.
    balls: Vec<Balls>,
    /// Without a tree: boxes around those bounded that take long to solve for, in their order.
    hulls: Vec<Option<Bounds>>,
    /// With the square of the radius that holds each.
    boxes: Vec<(Box_, f64)>,
    ellipsoids: Vec<Ellipsoid>,
    placed: Vec<Placed>,
    wholes: Vec<Whole>,
    /// Whether it counts what its searches take.
    counts: bool,
    instructions: Instructions,
    /// What the camera's rays meet, where that is not all.
    in_image: Option<Box<Geometry>>,
    /// What mirrored rays meet, likewise.
    in_reflections: Option<Box<Geometry>>,
    /// What stops light, and what stops a part of it, where that is the smaller part.
    opaque: Option<Box<Geometry>>,
    filters: Option<Box<Geometry>>,
    /// The objects that lights shine through.
    projections: Vec<Geometry>,
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
    Placed(u32),
    Whole(u32),
}

impl Geometry {
    /// Returns what a light shines through, by its number.
    pub fn projection(&self, number: u32) -> &Self {
        &self.projections[number as usize]
    }

    /// Of some of [`World::solids`], in their order.
    fn of(world: &World, solids: impl Iterator<Item = u32>) -> Self {
        let (bounded, unbounded): (Vec<u32>, Vec<u32>) = solids
            .filter(|&object| !Extent::of(world, object, Rounding::Outward).is_empty())
            .partition(|&object| bounds(world, object).is_some());
        let (tree, order) = if bounded.len() < TREE_FROM {
            (None, bounded)
        } else {
            let boxes = bounded.iter().filter_map(|&object| bounds(world, object));
            let (tree, order) = Tree::build(&boxes.collect::<Vec<_>>());
            (Some(tree), order.into_iter().map(|place| bounded[place as usize]).collect())
        };
        let solids = unbounded.iter().chain(&order);
        let parts = solids.map(|&solid| world.parts(solid).len()).sum();
        let mut geometry = Self {
            entries: Vec::with_capacity(unbounded.len() + order.len()),
            grains: Vec::new(),
            unbounded: unbounded.len(),
            tree,
            balls: Vec::new(),
            hulls: Vec::new(),
            boxes: Vec::with_capacity(world.boxes.len().min(parts)),
            ellipsoids: Vec::with_capacity(world.ellipsoids.len().min(parts)),
            placed: Vec::with_capacity(world.placed.len().min(parts)),
            wholes: Vec::with_capacity(world.csg_solids.len().min(parts)),
            counts: false,
            instructions: Instructions::best(),
            in_image: None,
            in_reflections: None,
            opaque: None,
            filters: None,
            projections: Vec::new(),
        };
        for object in unbounded.into_iter().chain(order) {
            geometry.append(world, object);
        }
        geometry.grains = geometry.entries.iter().map(|entry| geometry.grain(entry)).collect();
        if geometry.tree.is_none() {
            let bounded = geometry.entries[geometry.unbounded..].iter();
            let balls: Vec<Ball> = bounded.map(|entry| geometry.ball(world, entry)).collect();
            geometry.balls = balls.chunks(balls::LANES).map(Balls::new).collect();
            let hull = |entry: &Entry| match entry.solid {
                Solid::Placed(_) => bounds(world, entry.object),
                // The others are solved for as soon, or look at their box themselves.
                Solid::Sphere(_)
                | Solid::Plane(_)
                | Solid::Box(_)
                | Solid::Ellipsoid(_)
                | Solid::Whole(_) => None,
            };
            geometry.hulls = geometry.entries[geometry.unbounded..].iter().map(hull).collect();
        }
        geometry
    }

    /// The same geometry, where a crossing need be found no better than `tolerance` of its solid's size.
    pub fn within_root_tolerance(mut self, tolerance: f64) -> Self {
        self.placed.iter_mut().for_each(|placed| placed.root_tolerance = tolerance);
        self.parts(|part| part.within_root_tolerance(tolerance))
    }

    /// The same geometry, which counts what its searches take.
    pub fn counting(mut self) -> Self {
        self.counts = true;
        self.parts(Self::counting)
    }

    /// Whether it has a tree: rays that start close together are then searched for together in less time.
    pub fn has_tree(&self) -> bool {
        self.tree.is_some()
    }

    pub fn instructions(&self) -> Instructions {
        self.instructions
    }

    /// The same geometry, searched with these instructions.
    pub fn with(mut self, instructions: Instructions) -> Self {
        self.instructions = instructions;
        self.parts(|part| part.with(instructions))
    }

    /// Whether it counts what its searches take.
    pub fn counts(&self) -> bool {
        self.counts
    }

    /// Adds an object, or the whole that it is the first part of.
    fn append(&mut self, world: &World, number: u32) {
        let Some(whole) = world.objects[number as usize].csg_solid else {
            let entry = self.entry(world, number);
            self.entries.push(entry);
            return;
        };
        let whole = &world.csg_solids[whole as usize];
        let leaves: Vec<Entry> =
            whole.leaves().map(|leaf| self.entry(world, leaf as u32)).collect();
        let parts: Vec<Part> = leaves.iter().map(|leaf| Part::of(world, self, leaf)).collect();
        let whole = Whole::new(whole, leaves, &parts, bounds(world, number));
        let entry = Entry {
            solid: Solid::Whole(self.wholes.len() as u32),
            object: number,
            sides: Sides::Both,
            blocks: whole.leaves.iter().any(|leaf| leaf.blocks),
            filters: whole.leaves.iter().any(|leaf| leaf.filters),
            clear: whole.leaves.iter().all(|leaf| leaf.clear),
        };
        self.wholes.push(whole);
        self.entries.push(entry);
    }

    fn entry(&mut self, world: &World, number: u32) -> Entry {
        fn copy<T>(list: &mut Vec<T>, shape: T) -> u32 {
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
            Shape::Placed(i) => {
                Solid::Placed(copy(&mut self.placed, world.placed[i as usize].clone()))
            }
        };
        // A sheet has no outside: it is seen from both.
        let is_sheet = match solid {
            Solid::Placed(i) => self.placed[i as usize].body.is_sheet(),
            Solid::Sphere(_)
            | Solid::Plane(_)
            | Solid::Box(_)
            | Solid::Ellipsoid(_)
            | Solid::Whole(_) => false,
        };
        let sides = if is_sheet || !world.textures_of(object).all(|texture| texture.is_seed()) {
            Sides::Both
        } else if object.inverse {
            Sides::Inside
        } else {
            Sides::Outside
        };
        let clear = world.is_clear(object);
        let (blocks, filters) = (object.casts_shadow && !clear, object.casts_shadow && clear);
        Entry { solid, object: number, sides, blocks, filters, clear }
    }

    fn ball(&self, world: &World, entry: &Entry) -> Ball {
        match entry.solid {
            Solid::Sphere(Sphere { centre, radius }) => Ball::new(centre, radius * radius),
            Solid::Box(i) => {
                let (box_, reach_squared) = self.boxes[i as usize];
                Ball::new(box_.centre, reach_squared)
            }
            Solid::Placed(_) | Solid::Whole(_) => {
                let own = match entry.solid {
                    Solid::Placed(i) => self.placed[i as usize].ball(),
                    _ => None,
                };
                let own = own.map(|(centre, reach)| Ball::new(centre, reach * reach));
                let around = bounds(world, entry.object).map(|Bounds { low, high }| {
                    Ball::new((low + high) * 0.5, (high - low).length_squared() * 0.25)
                });
                let size = |ball: &Ball| ball.reach_squared;
                let least =
                    own.into_iter().chain(around).min_by(|a, b| size(a).total_cmp(&size(b)));
                least.unwrap_or(Ball::EVERYWHERE)
            }
            Solid::Plane(_) | Solid::Ellipsoid(_) => Ball::EVERYWHERE,
        }
    }

    /// Where the ray first meets a side of the object that is seen, at `limit` or before, and whether
    /// it leaves the solid there. The error bound is the tightest or, at less cost, an easy one.
    #[inline(always)]
    fn first_crossing<const BOUND: bool>(
        &self,
        entry: &Entry,
        ray: &Ray,
        limit: f64,
    ) -> Option<Hit> {
        let hit = |met| Some(entry.hit(met));
        let chord = match &entry.solid {
            Solid::Sphere(sphere) => {
                let roots = sphere.roots_ahead(ray)?;
                // Behind the start or too far: no error bounds are needed.
                if roots.leave() <= 0.0 || roots.enter() > limit {
                    return None;
                }
                let leaving = entry.sides == Sides::Inside;
                let t = if leaving { roots.leave() } else { roots.enter() };
                if BOUND == EASY
                    && let Some(crossing) = roots.roughly(t)
                {
                    return if t <= limit { hit(Met::of(crossing, leaving)) } else { None };
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
                    return hit(Met::of(crossing, leaving));
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
            Solid::Placed(i) => return hit(self.first_met(*i, entry.sides, ray, limit)?),
            Solid::Whole(i) => {
                return self.first_of_whole(*i, &Line::alone(ray), limit, |_| true);
            }
        };
        entry.sides.first_seen(&chord).filter(|met| met.t <= limit).and_then(hit)
    }

    #[inline(never)]
    fn first_met(&self, i: u32, sides: Sides, ray: &Ray, limit: f64) -> Option<Met> {
        self.first_of(i, sides, ray, limit, &self.placed[i as usize].first_crossings(ray, limit))
    }

    /// The first crossing that is seen among the first ones of a body.
    #[inline(always)]
    fn first_of(&self, i: u32, sides: Sides, ray: &Ray, limit: f64, first: &[Met]) -> Option<Met> {
        let placed = &self.placed[i as usize];
        let met = match first.iter().find(|met| sides.see(met)) {
            Some(met) => *met,
            // A body ends its search at the first that is seen from either side; from here it is not.
            None if sides != Sides::Both && first.iter().any(|met| met.crossing().is_ahead()) => {
                placed.crossings(ray).into_iter().find(|met| sides.see(met))?
            }
            None => return None,
        };
        (met.t <= limit).then(|| placed.shared(ray, &met))
    }
}

/// Which error bound of a crossing is wanted.
const EASY: bool = false;
const TIGHT: bool = true;

/// A box around an object, or the whole that it is a part of; `None` when it is unbounded.
pub fn bounds(world: &World, object: u32) -> Option<Bounds> {
    Extent::of(world, object, Rounding::Outward).bounds()
}

/// A box that holds all that an object counts for as a part of a whole; `None` where that has no end.
pub fn bounds_of_part(world: &World, object: u32) -> Option<Bounds> {
    Extent::of_part(world, object, Rounding::Outward).bounds()
}

#[cfg(test)]
mod tests;
