//! How far a solid extends: nowhere, in a box, or without end.

use smallvec::SmallVec;

use super::polyhedron::{self, HalfSpace};
use crate::shape::csg::Node;
use crate::shape::local::Local;
use crate::shape::{Bounds, Plane, Rounding, Shape};
use crate::world::World;

/// A shape that is a part of a whole by itself.
#[derive(Debug, Clone, Copy)]
struct Leaf {
    object: u32,
    inverse: bool,
}

impl Leaf {
    /// The half space that it is.
    fn half_space(self, world: &World) -> Option<Plane> {
        let Shape::Plane(i) = world.objects[self.object as usize].shape else { return None };
        let plane = world.planes[i as usize];
        Some(if self.inverse { plane.complement() } else { plane })
    }

    /// The half spaces that it is what is in all of; none where it is something else.
    fn half_spaces(self, world: &World) -> impl Iterator<Item = HalfSpace> {
        let faces = match world.objects[self.object as usize].shape {
            Shape::Box(i) if !self.inverse => Some(HalfSpace::of_box(&world.boxes[i as usize])),
            _ => None,
        };
        let plane = self.half_space(world).map(|plane| HalfSpace::of_plane(&plane));
        plane.into_iter().chain(faces.into_iter().flatten())
    }

    fn extent(self, world: &World, rounding: Rounding) -> Extent {
        match self.half_space(world) {
            Some(plane) => Extent(plane.bounds(rounding)),
            None if self.inverse => Extent::EVERYWHERE,
            None => Extent::of_part(world, self.object, rounding),
        }
    }
}

/// A box that holds a solid: one of its sides is negative where the solid is empty, and ∞ where it has no
/// end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent(pub(super) Bounds);

impl Extent {
    const NOWHERE: Self = Self(Bounds::NOWHERE);
    const EVERYWHERE: Self = Self(Bounds::EVERYWHERE);

    /// Of all that there is.
    pub fn of_all(world: &World, rounding: Rounding) -> Self {
        let solids = world.solids().map(|object| Self::of(world, object, rounding));
        solids.filter(|extent| !extent.is_empty()).fold(Self::NOWHERE, Self::or)
    }

    /// Of an object, or the whole that it is a part of.
    pub(super) fn of(world: &World, object: u32, rounding: Rounding) -> Self {
        let Some(whole) = world.objects[object as usize].csg_solid else {
            return Self::of_shape(world, object, rounding);
        };
        let whole = &world.csg_solids[whole as usize];
        let mut leaves = whole.leaves();
        let mut stack: SmallVec<[Self; 16]> = SmallVec::new();
        // Of each of the stack the leaf that it is, if it is one.
        let mut lone: SmallVec<[Option<Leaf>; 16]> = SmallVec::new();
        for node in &whole.nodes {
            let parts = match *node {
                Node::Leaf { .. } => 0,
                Node::Union(count) | Node::Merge(count) | Node::Intersection(count) => count,
                Node::Clip { .. } => 2,
            };
            let parts = lone.drain(lone.len().saturating_sub(parts as usize)..);
            let parts: SmallVec<[Leaf; 16]> = parts.flatten().collect();
            lone.push(None);
            match *node {
                Node::Leaf { inverse } => {
                    let object = leaves.next().unwrap_or_default() as u32;
                    let leaf = Leaf { object, inverse };
                    lone.pop();
                    lone.push(Some(leaf));
                    stack.push(leaf.extent(world, rounding));
                }
                Node::Union(count) | Node::Merge(count) => {
                    combine(&mut stack, count, Self::NOWHERE, Self::or)
                }
                Node::Intersection(count) => {
                    combine(&mut stack, count, Self::EVERYWHERE, Self::and)
                }
                Node::Clip { inverse: false } => {
                    combine(&mut stack, 2, Self::EVERYWHERE, Self::and)
                }
                // Its surface has an end, but what is outside of it has none.
                Node::Clip { inverse: true } => {
                    combine(&mut stack, 2, Self::EVERYWHERE, |_, _| Self::EVERYWHERE)
                }
            }
            if let (Node::Intersection(_) | Node::Clip { inverse: false }, Some(all)) =
                (node, stack.last_mut())
            {
                if all.bounds().is_none() {
                    *all = all.and(Self::clipped(world, &parts, rounding));
                }
                let faces: Vec<HalfSpace> =
                    parts.iter().flat_map(|leaf| leaf.half_spaces(world)).collect();
                let within = polyhedron::bounds(&faces, &all.0, rounding);
                *all = within.map_or(*all, |bounds| all.and(Self(bounds)));
            }
        }
        stack.pop().unwrap_or(Self::NOWHERE)
    }

    /// Of what is in all of some leaves, by the quadrics among them that planes cut.
    fn clipped(world: &World, parts: &[Leaf], rounding: Rounding) -> Self {
        let planes: Vec<Plane> = parts.iter().filter_map(|leaf| leaf.half_space(world)).collect();
        let quadrics =
            parts.iter().filter_map(|leaf| match world.objects[leaf.object as usize].shape {
                Shape::Placed(i) if !leaf.inverse && !planes.is_empty() => {
                    world.placed[i as usize].clipped_bounds(&planes, rounding)
                }
                _ => None,
            });
        quadrics.fold(Self::EVERYWHERE, |all, bounds| all.and(Self(bounds)))
    }

    /// Of all that a part of a whole counts for: what is seen of a disc has an end, what is below it has
    /// none.
    pub(super) fn of_part(world: &World, object: u32, rounding: Rounding) -> Self {
        let shape = world.objects[object as usize].shape;
        match shape {
            Shape::Placed(i) if world.placed[i as usize].body.reach().is_infinite() => {
                Self::EVERYWHERE
            }
            _ => Self::of_shape(world, object, rounding),
        }
    }

    /// Of an object by itself.
    fn of_shape(world: &World, object: u32, rounding: Rounding) -> Self {
        let bounds = match world.objects[object as usize].shape {
            Shape::Sphere(i) => Some(world.spheres[i as usize].bounds(rounding)),
            Shape::Plane(i) => Some(world.planes[i as usize].bounds(rounding)),
            Shape::Box(i) => Some(world.boxes[i as usize].bounds(rounding)),
            Shape::Ellipsoid(i) => Some(world.ellipsoids[i as usize].bounds(rounding)),
            Shape::Placed(i) => world.placed[i as usize].bounds(rounding),
        };
        bounds.map_or(Self::EVERYWHERE, Self)
    }

    fn or(self, Self(other): Self) -> Self {
        Self(self.0.union(&other))
    }

    fn and(self, Self(other): Self) -> Self {
        Self(self.0.intersection(&other))
    }

    /// The box; `None` where the solid has no end.
    pub fn bounds(self) -> Option<Bounds> {
        self.0.is_finite().then_some(self.0)
    }

    pub fn is_empty(self) -> bool {
        self.0.is_empty()
    }
}

/// The last `count` of the stack become one.
fn combine(
    stack: &mut SmallVec<[Extent; 16]>,
    count: u32,
    start: Extent,
    operation: fn(Extent, Extent) -> Extent,
) {
    let first = stack.len().saturating_sub(count as usize);
    let all = stack.drain(first..).fold(start, operation);
    stack.push(all);
}
