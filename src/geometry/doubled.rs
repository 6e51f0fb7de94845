//! Solids that stand in one place: their surfaces are one, whatever they are made of.
//!
//! **In:** a [`World`], and some of its objects. **Out:** pairs of these. **Invariant:** n objects take n log n
//! steps: only such are compared as have one box around them, or one plane, and of those a few. Two are one where
//! their numbers are, or where each of some lines crosses both at places that their error bounds cannot tell apart.

use std::collections::HashMap;
use std::sync::Arc;

use super::{Extent, Geometry, Solid};
use crate::math::random::Random;
use crate::math::{UnitVector, Vector, reciprocal_power_of_two};
use crate::shape::local::Met;
use crate::shape::{Bounds, Plane, Ray, Rounding, Shape};
use crate::world::{Object, World};

/// Lines through the box around two solids.
const LINES: usize = 32;
/// Different solids with one box around them, of which each other one is compared with all.
const MOST_ALIKE: usize = 8;
/// What an object's numbers are rounded to before they are looked up, in sizes of the largest: far above what
/// rounding makes of one number, and so fine that what differs is told apart.
const GRAIN: f64 = 1.0 / (1u64 << 32) as f64;

/// What the numbers of one plane in two spellings may differ by, relative.
const ROUNDED: f64 = 16.0 * f64::EPSILON;

/// Numbers in grains of the power of two that the largest is near, and that power.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct Key {
    grains: [i64; 6],
    size: u64,
}

impl Key {
    fn of(numbers: [f64; 6]) -> Option<Self> {
        let largest = numbers.into_iter().map(f64::abs).fold(0.0, f64::max);
        // Rounded first, so that what is a little less than a power of two is that.
        let rough = f64::from(largest as f32);
        let scale = reciprocal_power_of_two(rough);
        let grains = numbers.map(|number| (number * scale / GRAIN).round() as i64);
        (rough > 0.0 && rough.is_finite()).then_some(Self { grains, size: scale.to_bits() })
    }

    /// `None` of what has no end and is no plane.
    fn of_object(world: &World, object: u32) -> Option<Self> {
        if let Some(plane) = plane(world, object) {
            let [x, y, z] = plane.normal.get().to_array();
            let place = plane.distance / (1.0 + plane.distance.abs());
            return Self::of([x, y, z, place, 0.0, 2.0]);
        }
        let Bounds { low, high } = Extent::of(world, object, Rounding::Nearest).bounds()?;
        Self::of([low.x, low.y, low.z, high.x, high.y, high.z])
    }
}

/// The plane that an object is, its normal turned so that its largest share is positive.
fn plane(world: &World, object: u32) -> Option<Plane> {
    let Object { shape: Shape::Plane(i), csg_solid: None, .. } = world.objects[object as usize]
    else {
        return None;
    };
    let plane = world.planes[i as usize];
    let normal = plane.normal.get();
    let largest = (0..3).max_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))?;
    Some(if normal[largest] < 0.0 { plane.complement() } else { plane })
}

/// Of some objects, each solid by its first one, those that stand where an earlier one does; with that, first.
pub fn doubled(world: &World, objects: &[u32]) -> Vec<[u32; 2]> {
    let mut alike: HashMap<Key, Vec<u32>> = HashMap::new();
    let mut lines = Lines { world, geometry: None };
    let mut pairs = Vec::new();
    for &object in objects {
        let Some(key) = Key::of_object(world, object) else { continue };
        let others = alike.entry(key).or_default();
        match others.iter().find(|&&other| lines.are_one(other, object)) {
            Some(&other) => pairs.push([other, object]),
            None if others.len() < MOST_ALIKE => others.push(object),
            None => {}
        }
    }
    pairs
}

/// Compares solids by lines through them, for which all are arranged when it is asked first.
struct Lines<'a> {
    world: &'a World,
    /// And where each object stands among its entries.
    geometry: Option<(Geometry, HashMap<u32, usize>)>,
}

impl Lines<'_> {
    fn are_one(&mut self, a: u32, b: u32) -> bool {
        let world = self.world;
        if let (Some(a), Some(b)) = (plane(world, a), plane(world, b)) {
            let apart = (a.normal.get() - b.normal.get()).abs().max_element();
            let distance = (a.distance - b.distance).abs();
            return apart <= ROUNDED && distance <= ROUNDED * a.distance.abs();
        }
        if self.have_one_body(a, b) {
            return true;
        }
        let Some(Bounds { low, high }) = Extent::of(world, a, Rounding::Nearest).bounds() else {
            return false;
        };
        let (geometry, entries) = self.geometry.get_or_insert_with(|| {
            let geometry = Geometry::build(world);
            let entries = geometry.entries.iter().enumerate();
            let entries = entries.map(|(at, entry)| (entry.object, at)).collect();
            (geometry, entries)
        });
        let solid = |object: u32| Some(&geometry.entries[*entries.get(&object)?].solid);
        let (Some(one), Some(other)) = (solid(a), solid(b)) else { return false };
        let mut random = Random::of(31, a.into());
        let mut crossed = 0;
        for _ in 0..LINES {
            let mut any =
                |reach: f64| Vector::from_array([(); 3].map(|()| random.number(-reach, reach)));
            let origin = (low + high) * 0.5 + any(0.5) * (high - low);
            let Some(direction) = UnitVector::from_direction(any(1.0)) else { continue };
            let line = Ray { origin, direction: direction.get() };
            let [one, other] = [one, other].map(|solid| geometry.seen_along(solid, &line));
            let is_one = |(a, b): (&Met, &Met)| (a.t - b.t).abs() <= a.error + b.error;
            if one.len() != other.len() || !one.iter().zip(&other).all(is_one) {
                return false;
            }
            crossed += one.len();
        }
        crossed > 0
    }

    /// Whether two objects are one shape, by its numbers.
    fn have_one_body(&self, a: u32, b: u32) -> bool {
        let world = self.world;
        let [a, b] = [a, b].map(|object| &world.objects[object as usize]);
        if a.csg_solid.is_some() || b.csg_solid.is_some() {
            return false;
        }
        let at = |i: u32| i as usize;
        match (a.shape, b.shape) {
            (Shape::Sphere(a), Shape::Sphere(b)) => world.spheres[at(a)] == world.spheres[at(b)],
            (Shape::Box(a), Shape::Box(b)) => world.boxes[at(a)] == world.boxes[at(b)],
            (Shape::Ellipsoid(a), Shape::Ellipsoid(b)) => {
                world.ellipsoids[at(a)] == world.ellipsoids[at(b)]
            }
            (Shape::Placed(a), Shape::Placed(b)) => {
                let [a, b] = [a, b].map(|i| &world.placed[at(i)]);
                Arc::ptr_eq(&a.body, &b.body) && a.placement == b.placement
            }
            _ => false,
        }
    }
}

impl Geometry {
    /// Where a line crosses what is seen of a solid.
    fn seen_along(&self, solid: &Solid, line: &Ray) -> Vec<Met> {
        let is_seen = |met: &Met| met.is_seen() && met.t.is_finite();
        match solid {
            Solid::Whole(i) => {
                let events = self.events(&self.wholes[*i as usize], line);
                events.iter().map(|event| event.met).filter(is_seen).collect()
            }
            _ => self.crossings(solid, line).into_iter().filter(is_seen).collect(),
        }
    }
}
