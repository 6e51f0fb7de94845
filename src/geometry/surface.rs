//! What a surface is like where a ray meets it.
//!
//! **In:** a ray and its hit. **Out:** the point, its normals, and how far off they may be.

use super::{Hit, edge};
use crate::math::Vector;
use crate::math::wide::*;
use crate::shape::local::{Facet, Local, Met};
use crate::shape::{
    Chord, Ray, Shape, SurfacePoint, WideFacets, WidePlanes, WidePoints, WideSpheres,
};
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

/// The surfaces at hits of rays side by side.
pub struct SurfacePoints {
    pub points: Rows,
    normals: Rows,
    errors: Row,
    faces: [u32; ROW],
    /// The normals on the sides that the rays come from.
    pub facing: Rows,
    /// The starts of rays that go on from there, on these sides; see [`SurfacePoint::spawn`].
    pub origins: Rows,
}

/// The shapes that are met: spheres, planes, ellipsoids, and flat parts of bodies.
struct Shapes {
    /// Centres of spheres, normals of planes and of flat parts.
    vectors: Rows,
    /// Radii of spheres, distances of planes, turns of flat parts.
    sizes: Row,
    scales: Row,
    /// Points of flat parts.
    corners: Rows,
    /// Numbers of ellipsoids, and of the bodies of flat parts, in the World's lists.
    bodies: [u32; ROW],
    /// A bit for each.
    spheres: u32,
    planes: u32,
    ellipsoids: u32,
    facets: u32,
}

impl SurfacePoints {
    pub const NONE: Self = Self {
        points: Rows::ZERO,
        normals: Rows::ZERO,
        errors: [0.0; ROW],
        faces: [0; ROW],
        facing: Rows::ZERO,
        origins: Rows::ZERO,
    };

    /// Finds the surface of each ray of the mask, as [`surface`] does for one ray.
    #[inline(always)]
    pub fn find(
        &mut self,
        world: &World,
        instructions: Instructions,
        (rays, mask): (&Rays, u32),
        hits: &[Hit],
    ) {
        let mut shapes = Shapes {
            vectors: Rows::ZERO,
            sizes: [0.0; ROW],
            scales: [0.0; ROW],
            corners: Rows::ZERO,
            bodies: [0; ROW],
            spheres: 0,
            planes: 0,
            ellipsoids: 0,
            facets: 0,
        };
        let (mut others, mut distances, mut leaving) = (0, [0.0; ROW], 0);
        for number in numbers(mask) {
            let (hit, bit) = (&hits[number], 1 << number);
            distances[number] = hit.t;
            leaving |= if hit.leaving { bit } else { 0 };
            match world.objects[hit.object as usize].shape {
                Shape::Sphere(i) => {
                    let sphere = &world.spheres[i as usize];
                    shapes.vectors.set(number, sphere.centre);
                    (shapes.sizes[number], shapes.scales[number]) = (sphere.radius, sphere.scale());
                    shapes.spheres |= bit;
                }
                Shape::Plane(i) => {
                    let plane = &world.planes[i as usize];
                    shapes.vectors.set(number, plane.normal.get());
                    shapes.sizes[number] = plane.distance;
                    shapes.planes |= bit;
                }
                Shape::Placed(i) if hit.part != Met::UNKNOWN => {
                    match world.placed[i as usize].body.facet(hit.part) {
                        Some(Facet { corner, normal, turn }) => {
                            shapes.vectors.set(number, normal);
                            shapes.corners.set(number, corner);
                            (shapes.sizes[number], shapes.bodies[number]) = (turn, i);
                            self.faces[number] = hit.part;
                            shapes.facets |= bit;
                        }
                        None => others |= bit,
                    }
                }
                Shape::Ellipsoid(i) => {
                    shapes.bodies[number] = i;
                    shapes.ellipsoids |= bit;
                }
                Shape::Box(_) | Shape::Placed(_) => others |= bit,
            }
        }
        others |= dispatch!(
            instructions.level(),
            simd => self.solve(simd, world, rays, &shapes, &distances)
        ) & mask;
        for number in numbers(others) {
            let point = surface(world, &rays.at(number), &hits[number]);
            self.points.set(number, point.point);
            self.normals.set(number, point.normal);
            (self.errors[number], self.faces[number]) = (point.error, point.face);
        }
        dispatch!(instructions.level(), simd => self.leave(simd, leaving));
    }

    /// Returns the surface of this number.
    #[inline(always)]
    pub fn at(&self, number: usize) -> SurfacePoint {
        SurfacePoint {
            point: self.points.at(number),
            normal: self.normals.at(number),
            error: self.errors[number],
            face: self.faces[number],
        }
    }

    /// Returns the face of the surface of this number; see [`SurfacePoint::face`].
    #[inline(always)]
    pub fn face(&self, number: usize) -> u32 {
        self.faces[number]
    }

    /// Finds the points of spheres, planes, ellipsoids and flat parts; returns a bit for each of which it cannot.
    #[inline(always)]
    fn solve<S: Simd>(
        &mut self,
        simd: S,
        world: &World,
        rays: &Rays,
        shapes: &Shapes,
        distances: &Row,
    ) -> u32 {
        let mut unsure = 0;
        for group in 0..GROUPS {
            let (ray, t) = (rays.four(simd, group), four(simd, distances, group));
            let (vector, size) =
                (WideVector::of(simd, &shapes.vectors, group), four(simd, &shapes.sizes, group));
            if has(shapes.spheres, group) {
                let scale = four(simd, &shapes.scales, group);
                let spheres = WideSpheres { centre: vector, radius: size, scale };
                let found = spheres.surface(simd, &ray, t);
                unsure |= self.store(simd, group, shapes.spheres, found);
            }
            if has(shapes.planes, group) {
                let planes = WidePlanes { normal: vector, distance: size };
                let found = planes.surface(simd, &ray, t);
                unsure |= self.store(simd, group, shapes.planes, found);
            }
        }
        // Those of one ellipsoid, or of one body, together.
        let first = |some: u32| shapes.bodies[some.trailing_zeros() as usize % ROW];
        let same_as = |body: u32, some: u32| {
            let is_same = |number: &usize| shapes.bodies[*number] == body;
            numbers(some).filter(is_same).fold(0, |all, number| all | 1 << number)
        };
        let mut ellipsoids = shapes.ellipsoids;
        while ellipsoids != 0 {
            let number = first(ellipsoids);
            let same = same_as(number, ellipsoids);
            let ellipsoid = &world.ellipsoids[number as usize];
            for group in 0..GROUPS {
                if has(same, group) {
                    let (ray, t) = (rays.four(simd, group), four(simd, distances, group));
                    let found = ellipsoid.surface_of_four(simd, &ray, t);
                    unsure |= self.store(simd, group, same, found);
                }
            }
            ellipsoids &= !same;
        }
        let mut facets = shapes.facets;
        while facets != 0 {
            let number = first(facets);
            let same = same_as(number, facets);
            let placed = &world.placed[number as usize];
            for group in 0..GROUPS {
                if has(same, group) {
                    let facets = WideFacets {
                        corner: WideVector::of(simd, &shapes.corners, group),
                        normal: WideVector::of(simd, &shapes.vectors, group),
                        turn: four(simd, &shapes.sizes, group),
                    };
                    let (ray, t) = (rays.four(simd, group), four(simd, distances, group));
                    let found = facets.surface(simd, placed, &ray, t);
                    unsure |= self.store(simd, group, same, found);
                }
            }
            facets &= !same;
        }
        unsure
    }

    /// Replaces the points of `solved`; returns a bit for each of which it takes more to tell.
    #[inline(always)]
    fn store<S: Simd>(&mut self, simd: S, group: usize, solved: u32, found: WidePoints<S>) -> u32 {
        let mask = mask(simd, solved, group);
        let WidePoints { point, normal, error, unsure } = found;
        point.or(mask, WideVector::of(simd, &self.points, group)).store(&mut self.points, group);
        normal.or(mask, WideVector::of(simd, &self.normals, group)).store(&mut self.normals, group);
        store(mask.select(error, four(simd, &self.errors, group)), &mut self.errors, group);
        bits(unsure, group) & solved
    }

    /// Finds the sides that rays come from.
    #[inline(always)]
    fn leave<S: Simd>(&mut self, simd: S, leaving: u32) {
        for group in 0..GROUPS {
            let leaving = mask(simd, leaving, group);
            let normal = WideVector::of(simd, &self.normals, group);
            let error = four(simd, &self.errors, group);
            let origin =
                WideVector::of(simd, &self.points, group) + normal * leaving.select(-error, error);
            origin.store(&mut self.origins, group);
            (-normal).or(leaving, normal).store(&mut self.facing, group);
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
