//! How far a solid extends: nowhere, in a box, or without end.

use smallvec::SmallVec;

use crate::math::Vector;
use crate::shape::body::Local;
use crate::shape::csg::Node;
use crate::shape::{Bounds, Plane, Shape};
use crate::world::World;

/// A shape that is a part of a whole by itself.
#[derive(Debug, Clone, Copy)]
struct Leaf {
    object: u32,
    inverse: bool,
}

/// A box that holds a solid: one of its sides is negative where the solid is empty, and ∞ where it has no
/// end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extent(Bounds);

impl Extent {
    const NOWHERE: Self = Self(Bounds { low: Vector::INFINITY, high: Vector::NEG_INFINITY });
    const EVERYWHERE: Self = Self(Bounds { low: Vector::NEG_INFINITY, high: Vector::INFINITY });

    /// Of an object, or the whole that it is a part of.
    pub fn of(world: &World, object: u32) -> Self {
        let Some(whole) = world.objects[object as usize].whole else {
            return Self::of_shape(world, object);
        };
        let whole = &world.wholes[whole as usize];
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
                    lone.pop();
                    lone.push(Some(Leaf { object, inverse }));
                    stack.push(match inverse {
                        true => Self::EVERYWHERE,
                        false => Self::of_part(world, object),
                    });
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
                && all.bounds().is_none()
            {
                *all = all.and(Self::clipped(world, &parts));
            }
        }
        stack.pop().unwrap_or(Self::NOWHERE)
    }

    /// Of what is in all of some leaves, by the quadrics among them that planes cut.
    fn clipped(world: &World, parts: &[Leaf]) -> Self {
        let planes =
            parts.iter().filter_map(|leaf| match world.objects[leaf.object as usize].shape {
                Shape::Plane(i) => {
                    let Plane { normal, distance } = world.planes[i as usize];
                    Some(match leaf.inverse {
                        true => Plane { normal: -normal, distance: -distance },
                        false => Plane { normal, distance },
                    })
                }
                _ => None,
            });
        let planes: Vec<Plane> = planes.collect();
        let quadrics =
            parts.iter().filter_map(|leaf| match world.objects[leaf.object as usize].shape {
                Shape::Placed(i) if !leaf.inverse && !planes.is_empty() => {
                    world.placed[i as usize].clipped_bounds(&planes)
                }
                _ => None,
            });
        quadrics.fold(Self::EVERYWHERE, |all, bounds| all.and(Self(bounds)))
    }

    /// Of all that a part of a whole counts for: what is seen of a disc has an end, what is below it has
    /// none.
    pub fn of_part(world: &World, object: u32) -> Self {
        let shape = world.objects[object as usize].shape;
        match shape {
            Shape::Placed(i) if world.placed[i as usize].body.reach().is_infinite() => {
                Self::EVERYWHERE
            }
            _ => Self::of_shape(world, object),
        }
    }

    /// Of an object by itself.
    pub fn of_shape(world: &World, object: u32) -> Self {
        let bounds = match world.objects[object as usize].shape {
            Shape::Sphere(i) => Some(world.spheres[i as usize].bounds()),
            Shape::Plane(_) => None,
            Shape::Box(i) => Some(world.boxes[i as usize].bounds()),
            Shape::Ellipsoid(i) => Some(world.ellipsoids[i as usize].bounds()),
            Shape::Placed(i) => world.placed[i as usize].bounds(),
        };
        bounds.map_or(Self::EVERYWHERE, Self)
    }

    fn or(self, other: Self) -> Self {
        Self(self.0.union(&other.0))
    }

    fn and(self, Self(other): Self) -> Self {
        let Self(Bounds { low, high }) = self;
        Self(Bounds { low: low.max(other.low), high: high.min(other.high) })
    }

    /// The box; `None` where the solid has no end.
    pub fn bounds(self) -> Option<Bounds> {
        let Self(Bounds { low, high }) = self;
        (low.is_finite() && high.is_finite()).then_some(self.0)
    }

    pub fn is_empty(self) -> bool {
        self.0.low.cmpgt(self.0.high).any()
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
