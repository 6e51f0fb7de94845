//! Colours and normals of surfaces that are shaded together.
//!
//! **In:** surfaces with their plain textures. **Out:** the colour of each, and the normal by which it is lit.

use super::shade::Flat;
use super::surface_batch::{ShadingNormal, SurfaceBatch, vector};
use super::texture::{self, ObjectSide};
use super::tracer::Tracer;
use super::traits::{BUMPY, PATTERNED};
use crate::geometry::{self, Hit, SurfacePoints};
use crate::math::wide::{Rows, numbers};
use crate::shape::{Ray, Shape};
use crate::world::{Pigment, Plain};

impl<'a> Tracer<'a> {
    /// Finds the colours and normals of surfaces.
    #[inline(always)]
    pub(super) fn paint(&self, batch: &mut SurfaceBatch<'a, '_, '_>) {
        let [patterned, bumpy] = [PATTERNED, BUMPY].map(|place| batch.traits.of(place));
        if patterned != 0 {
            self.paint_patterns(batch, patterned);
        }
        let mut smooth = 0;
        for number in numbers(batch.mask) {
            let Some(Plain { pigment, finish, .. }) = batch.plains[number] else { continue };
            if let Pigment::Color(color) = pigment {
                batch.paints[number] = *color;
            }
            let body = batch.paints[number].body(batch.clearness);
            batch.bodies.set(number, vector(body));
            batch.local.set(number, vector(body * finish.emission));
            batch.diffuse[number] = finish.diffuse;
            let object = batch.packet.hits[number].object as usize;
            let may_be_smooth = matches!(self.world.objects[object].shape, Shape::Placed(_));
            smooth |= u32::from(may_be_smooth) << number;
        }
        for number in numbers(smooth | bumpy) {
            let Some(plain) = batch.plains[number] else { continue };
            let (ray, hit) = (&batch.packet.rays.at(number), &batch.packet.hits[number]);
            if let Some(shaped) = self.shaped(plain, (ray, hit), batch.surfaces, number) {
                batch.shaped |= 1 << number;
                batch.shapes.push(shaped);
            }
        }
        if bumpy != 0 {
            self.perturb(batch, bumpy);
        }
    }

    /// Finds the colours of surfaces with patterns: those of one side of an object together where possible.
    #[inline(never)]
    fn paint_patterns(&self, batch: &mut SurfaceBatch<'a, '_, '_>, patterned: u32) {
        let mut rest = patterned;
        while rest != 0 {
            let side = ObjectSide::first(&batch.packet.hits, rest, batch.surfaces);
            rest &= !side.mask;
            let first = side.first_number();
            let Some(plain) = batch.plains[first] else { return };
            match plain.pigment.together() {
                Some(together) if !side.is_single() => {
                    texture::colors(self, &together, side, &mut batch.paints);
                }
                _ => {
                    for number in numbers(side.mask) {
                        let (ray, hit) =
                            (&batch.packet.rays.at(number), &batch.packet.hits[number]);
                        let surface = batch.surfaces.at(number);
                        batch.paints[number] = texture::color(self, plain, ray, hit, &surface);
                    }
                }
            }
        }
    }

    /// Perturbs the normals of surfaces with bumps, likewise.
    #[inline(never)]
    fn perturb(&self, batch: &mut SurfaceBatch<'a, '_, '_>, bumpy: u32) {
        let mut rest = bumpy;
        while rest != 0 {
            let side = ObjectSide::first(&batch.packet.hits, rest, batch.surfaces);
            rest &= !side.mask;
            let plain = batch.plains[side.first_number()];
            let Some(bumps) = plain.and_then(|plain| plain.normal.as_deref()) else { return };
            let mut normals = Rows::ZERO;
            for number in numbers(side.mask) {
                normals.set(number, batch.normal(number));
            }
            match bumps.together() {
                Some(together) if !side.is_single() => {
                    texture::perturb(self, &together, side, &mut normals);
                }
                _ => {
                    for number in numbers(side.mask) {
                        let (ray, hit) =
                            (&batch.packet.rays.at(number), &batch.packet.hits[number]);
                        let at = (ray, hit, &batch.surfaces.at(number));
                        let normal = texture::perturbed(self, bumps, normals.at(number), at);
                        normals.set(number, normal);
                    }
                }
            }
            for number in numbers(side.mask) {
                let place = batch.place_of_shape(number);
                batch.shapes[place].normal = normals.at(number);
            }
        }
    }

    /// Returns the shading normal of a smooth or bumpy surface, before its bumps perturb it.
    #[inline(never)]
    fn shaped(
        &self,
        plain: &Plain,
        (ray, hit): (&Ray, &Hit),
        surfaces: &SurfacePoints,
        number: usize,
    ) -> Option<ShadingNormal> {
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
            None => smooth.map(|_| ShadingNormal { normal, flat, smooth: None }),
            Some(_) => Some(ShadingNormal { normal, flat, smooth: Some(normal) }),
        }
    }
}
