//! Colours and normals of surfaces that are shaded together.
//!
//! **In:** surfaces with their plain textures. **Out:** the colour of each, and the normal by which it is lit.

use super::shade::Flat;
use super::stands::{Shaped, Stands};
use super::texture::{self, Side};
use super::tracer::Tracer;
use crate::geometry::{self, Hit, SurfacePoints};
use crate::math::wide::{Rows, numbers};
use crate::shape::{Ray, Shape};
use crate::world::{Pigment, Plain};

impl<'a> Tracer<'a> {
    /// Finds the colours and normals of surfaces.
    #[inline(always)]
    pub(super) fn paint(&self, stands: &mut Stands<'a, '_, '_>) {
        let (mut patterned, mut bumpy) = (0, 0);
        for number in numbers(stands.mask) {
            match stands.plains[number].map(|plain| &plain.pigment) {
                Some(Pigment::Color(color)) => stands.paints[number] = *color,
                _ => patterned |= 1 << number,
            }
        }
        if patterned != 0 {
            self.paint_patterns(stands, patterned);
        }
        for number in numbers(stands.mask) {
            let Some(plain) = stands.plains[number] else { continue };
            let (ray, hit) = (&stands.ways[number].ray, &stands.hits[number]);
            let body = stands.paints[number].body(stands.clearness);
            stands.bodies[number] = body;
            stands.local[number] = body * plain.finish.emission;
            let shape = self.world.objects[hit.object as usize].shape;
            if (matches!(shape, Shape::Placed(_)) || plain.normal.is_some())
                && let Some(shaped) = self.shaped(plain, (ray, hit), stands.surfaces, number)
            {
                stands.shaped |= 1 << number;
                stands.shapes.push(shaped);
                bumpy |= if plain.normal.is_some() { 1 << number } else { 0 };
            }
        }
        if bumpy != 0 {
            self.perturb(stands, bumpy);
        }
    }

    /// Finds the colours of surfaces with patterns: those of one side of an object together, where they can be.
    #[inline(never)]
    fn paint_patterns(&self, stands: &mut Stands<'a, '_, '_>, patterned: u32) {
        let mut rest = patterned;
        while rest != 0 {
            let first = rest.trailing_zeros() as usize;
            let Some(plain) = stands.plains[first] else { return };
            let Some(together) = plain.pigment.together() else {
                let (ray, hit) = (&stands.ways[first].ray, &stands.hits[first]);
                let surface = stands.surfaces.at(first);
                stands.paints[first] = texture::color(self, plain, ray, hit, &surface);
                rest &= rest - 1;
                continue;
            };
            let side = Side::first(stands.hits, rest, stands.surfaces);
            texture::colors(self, &together, side, &mut stands.paints);
            rest &= !side.mask;
        }
    }

    /// Perturbs the normals of surfaces with bumps, likewise.
    #[inline(never)]
    fn perturb(&self, stands: &mut Stands<'a, '_, '_>, bumpy: u32) {
        let mut rest = bumpy;
        while rest != 0 {
            let first = rest.trailing_zeros() as usize;
            let Some(bumps) = stands.plains[first].and_then(|plain| plain.normal.as_ref()) else {
                return;
            };
            let Some(together) = bumps.together() else {
                let (ray, hit) = (&stands.ways[first].ray, &stands.hits[first]);
                let surface = stands.surfaces.at(first);
                let place = stands.place_of_shape(first);
                let normal = &mut stands.shapes[place].normal;
                *normal = texture::perturbed(self, bumps, *normal, (ray, hit, &surface));
                rest &= rest - 1;
                continue;
            };
            let side = Side::first(stands.hits, rest, stands.surfaces);
            let mut normals = Rows::ZERO;
            for number in numbers(side.mask) {
                normals.set(number, stands.shapes[stands.place_of_shape(number)].normal);
            }
            texture::perturb(self, &together, side, &mut normals);
            for number in numbers(side.mask) {
                let place = stands.place_of_shape(number);
                stands.shapes[place].normal = normals.at(number);
            }
            rest &= !side.mask;
        }
    }

    /// How a surface is lit that is smooth or bumpy, before its bumps perturb its normal.
    #[inline(never)]
    fn shaped(
        &self,
        plain: &Plain,
        (ray, hit): (&Ray, &Hit),
        surfaces: &SurfacePoints,
        number: usize,
    ) -> Option<Shaped> {
        let (surface, facing) = (surfaces.at(number), surfaces.facing.at(number));
        let behind = surface.spawn(-facing);
        let flat = Flat { normal: facing, behind };
        let smooth = geometry::shading_normal(self.world, hit, &surface);
        let normal = match smooth {
            None => facing,
            Some(smooth) if smooth.dot(ray.direction) > 0.0 => -smooth,
            Some(smooth) => smooth,
        };
        match &plain.normal {
            None => smooth.map(|_| Shaped { normal, flat, smooth: None }),
            Some(_) => Some(Shaped { normal, flat, smooth: Some(normal) }),
        }
    }
}
