//! What a surface is like where a ray meets it.
//!
//! **In:** a ray and its hit. **Out:** the point, its normals, and how far off they may be.

use super::{Hit, edge};
use crate::math::Vector;
use crate::shape::local::Met;
use crate::shape::{Chord, Ray, Shape, SurfacePoint};
use crate::world::World;

/// The surface at a hit of `ray`; its normal points out of the solid, whichever way the ray goes.
#[inline(always)]
pub fn surface(world: &World, ray: &Ray, hit: &Hit) -> SurfacePoint {
    let Hit { object, t, leaving, part, .. } = *hit;
    let shape = world.objects[object as usize].shape;
    match shape {
        Shape::Sphere(i) => world.spheres[i as usize].surface(ray, t),
        Shape::Plane(i) => world.planes[i as usize].surface(ray, t),
        Shape::Box(i) => edge::surface(world, ray, hit, &world.boxes[i as usize]),
        Shape::Ellipsoid(i) => world.ellipsoids[i as usize].surface(ray, t),
        Shape::Placed(i) => {
            let placed = &world.placed[i as usize];
            match part {
                Met::UNKNOWN => placed.surface(ray, t, leaving),
                _ => placed.surface_of_part(part, ray, t, leaving),
            }
        }
    }
}

/// The unit normal by which the surface at a hit is lit, on either side; `None` where that is its own.
#[inline(always)]
pub fn shading_normal(world: &World, hit: &Hit, surface: &SurfacePoint) -> Option<Vector> {
    let shape = world.objects[hit.object as usize].shape;
    match shape {
        Shape::Placed(i) => world.placed[i as usize].shading_normal(surface),
        Shape::Sphere(_) | Shape::Plane(_) | Shape::Box(_) | Shape::Ellipsoid(_) => None,
    }
}

/// How far a surface's point may be along each axis from where the ray was meant to meet it; no
/// distance where that is not known.
#[inline(never)]
pub fn spread(world: &World, ray: &Ray, hit: &Hit, surface: &SurfacePoint) -> Vector {
    let shape = world.objects[hit.object as usize].shape;
    let (chord, is_flat) = match shape {
        Shape::Sphere(i) => (world.spheres[i as usize].chord(ray), false),
        Shape::Plane(i) => (world.planes[i as usize].chord(ray), true),
        Shape::Box(i) => (world.boxes[i as usize].chord(ray), true),
        Shape::Ellipsoid(i) => (world.ellipsoids[i as usize].chord(ray), false),
        Shape::Placed(i) => {
            let met = world.placed[i as usize].crossing_at(ray, hit.t, hit.leaving);
            let spread = |met: Met| surface.spread(ray, hit.t, &met.crossing(), false);
            return met.map_or(Vector::ZERO, spread);
        }
    };
    // A part of a CSG solid may be crossed where the shape alone is missed.
    chord.map_or(Vector::ZERO, |Chord { enter, leave }| {
        surface.spread(ray, hit.t, if hit.leaving { &leave } else { &enter }, is_flat)
    })
}
