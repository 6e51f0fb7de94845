//! The colour of a pigment where a ray meets its surface.
//!
//! **In:** a [`Pigment`], and what the ray met. **Out:** the pigment's colour at that point of its
//! texture's space.

use super::path::Tracer;
use crate::color::Color;
use crate::geometry::{self, Hit};
use crate::math::Vector;
use crate::shape::{Ray, Shape, SurfacePoint};
use crate::world::pigment::at;
use crate::world::{Pigment, World};

/// The colour of the object's surface where the ray hit it.
#[inline(always)]
pub(super) fn on_surface(
    tracer: &Tracer,
    pigment: &Pigment,
    ray: &Ray,
    hit: &Hit,
    surface: &SurfacePoint,
) -> Color {
    match pigment {
        Pigment::Color(color) => *color,
        Pigment::Patterned { .. } | Pigment::Faces(_) => {
            patterned(tracer, pigment, *ray, *hit, *surface)
        }
    }
}

/// The ray and what it met come as copies: pointed to, they would lie in memory for surfaces of one
/// colour, too.
#[inline(never)]
fn patterned(
    tracer: &Tracer,
    pigment: &Pigment,
    ray: Ray,
    hit: Hit,
    surface: SurfacePoint,
) -> Color {
    let world = tracer.world;
    if let Pigment::Faces(colors) = pigment {
        return of_face(world, colors, &hit, &surface);
    }
    let is_sharp = tracer.sharpness.on_surface(&ray, &hit, &surface);
    let error = || texture_error(world, &ray, &hit, &surface);
    at(pigment, texture_point(world, &hit, &surface), is_sharp, error)
}

/// The colours of the corners of the face that was hit, as much of each as they are near.
fn of_face(world: &World, colors: &[Color], hit: &Hit, surface: &SurfacePoint) -> Color {
    let Shape::Placed(placed) = world.objects[hit.object as usize].shape else {
        return Color::BLACK;
    };
    let Some(paint) = world.placed[placed as usize].paint(surface) else { return Color::BLACK };
    let mut sum = Color::default();
    for (index, weight) in paint {
        let Some(color) = colors.get(index as usize).filter(|_| weight > 0.0) else { continue };
        sum.rgb += color.rgb * weight;
        sum.filter += color.filter * weight;
        sum.transmit += color.transmit * weight;
    }
    sum
}

/// The hit in the texture's space; on a flat face the coordinates that are constant there are taken
/// as `lower` computed them, not from the rounded hit.
#[inline]
fn texture_point(world: &World, hit: &Hit, surface: &SurfacePoint) -> Vector {
    let object = &world.objects[hit.object as usize];
    let mut point = surface.point;
    if let Some(map) = object.texture_from_world {
        point = world.texture_maps[map as usize].point(point);
    }
    if let Some(first) = object.faces {
        let constants = world.faces[(first + surface.face) as usize].0;
        for (axis, constant) in constants.into_iter().enumerate() {
            point[axis] = constant.unwrap_or(point[axis]);
        }
    }
    point
}

/// How far [`texture_point`] may be off along each axis.
#[cold]
#[inline(never)]
fn texture_error(world: &World, ray: &Ray, hit: &Hit, surface: &SurfacePoint) -> Vector {
    let object = &world.objects[hit.object as usize];
    let mut error = geometry::spread(world, ray, hit, surface);
    if let Some(map) = object.texture_from_world {
        error = world.texture_maps[map as usize].point_error(surface.point, error);
    }
    if let Some(first) = object.faces {
        let constants = world.faces[(first + surface.face) as usize].0;
        for (axis, constant) in constants.into_iter().enumerate() {
            error[axis] = if constant.is_some() { 0.0 } else { error[axis] };
        }
    }
    error
}
