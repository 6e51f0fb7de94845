//! Surfaces that rays have met: what they are like, what they show, and where rays go on from them.
//!
//! **In:** rays and their hits, side by side. **Out:** what each surface shows by itself, and the rays that go on.

use super::area::Ground;
use super::batch::{Back, Onward, SLICE, Surfaces};
use super::layered::Known;
use super::shade::Flat;
use super::surface_batch::{ShadedSurface, SurfaceBatch};
use super::texture::ObjectSide;
use super::tracer::Tracer;
use super::way::Way;
use super::{Walk, behind, reflection, sky};
use crate::color::Rgb;
use crate::geometry::SurfacePoints;
use crate::math::wide::{Rays, Rows, dispatch, numbers};
use crate::shape::Ray;
use crate::world::{Finish, Texture};

impl<'a> Tracer<'a> {
    /// Shades surfaces side by side: tells what each shows by itself, and adds the rays that go on to the walk's.
    #[inline(never)]
    pub fn shade(&self, walk: &mut Walk, mut surfaces: Surfaces) {
        let (ways, hits) = (surfaces.ways, surfaces.hits);
        let mut plains = [None; SLICE];
        let mut mask = 0;
        let mut layered = 0;
        // Surfaces that rays go on from.
        let (mut steps, mut pending) = (0, walk.pending());
        let mut count = |walk: &Walk| {
            steps += u32::from(walk.pending() > pending);
            pending = walk.pending();
        };
        for (number, (way, hit)) in ways.iter().zip(hits).enumerate() {
            if self.counts {
                let hidden = !std::ptr::eq(self.met_by(way), self.geometry);
                walk.counters.evaluations.count(self.world, hit.found().as_ref(), hidden);
            }
            if hit.found().is_none() {
                let sky = sky::seen(self.world, &self.sharpness, way.ray.direction);
                surfaces.show(number, sky, false);
                continue;
            }
            let object = &self.world.objects[hit.object as usize];
            let texture = self.world.coat(object, hit.leaving).texture;
            match &self.world.textures[texture as usize] {
                Texture::Plain(plain) => (plains[number], mask) = (Some(plain), mask | 1 << number),
                Texture::Layers(_) => layered |= 1 << number,
                _ => {
                    let to = surfaces.first + number as u32;
                    let local = self.composite(walk, way, hit, to, Known::NOTHING);
                    surfaces.show(number, local, false);
                    count(walk);
                }
            }
        }
        if mask | layered == 0 {
            walk.patience.is_over_after(steps, self.watch);
            return;
        }
        let rays = Rays::new(ways.iter().map(|way| &way.ray));
        let mut points = SurfacePoints::NONE;
        points.find(self.world, self.geometry.instructions(), (&rays, mask | layered), hits);
        while layered != 0 {
            let side = ObjectSide::first(hits, layered, &points);
            self.shade_layered(walk, &mut surfaces, side, &mut count);
            layered &= !side.mask;
        }
        let clearness = self.world.settings.clearness;
        let mut batch = SurfaceBatch::new((ways, hits), plains, mask, &points, clearness);
        self.paint(&mut batch);
        if self.lights {
            self.light(walk, std::slice::from_mut(&mut batch));
        }
        let mirrors = if self.secondary { self.mirrors(&batch) } else { 0 };
        let mut mirrored = Rows::ZERO;
        if mirrors != 0 {
            let (directions, normals) = (&rays.directions, &points.facing);
            dispatch!(self.geometry.instructions().level(), simd => {
                reflection::mirrored_together(simd, directions, normals, mirrors, &mut mirrored);
            });
        }
        for number in numbers(mask) {
            let Some(finish) = batch.finish(number) else { continue };
            let (way, to) = (&ways[number], surfaces.first + number as u32);
            let object = &self.world.objects[hits[number].object as usize];
            let mut local = batch.local[number];
            let goes_on = self.secondary && way.level < self.max_trace_level;
            // Of those that are neither, no ray goes on, and no light from behind is seen.
            if mirrors >> number & 1 == 1 {
                if goes_on {
                    let origin = points.origins.at(number);
                    let ray = Ray { origin, direction: mirrored.at(number) };
                    self.mirror(walk, way, finish, ray, to);
                }
            } else if finish.reflection.is_some()
                || finish.extras.is_some()
                || object.double_illuminate
                || (self.clear && batch.paints[number].is_clear())
            {
                local += self.rest(walk, &batch, number, goes_on, to);
            }
            surfaces.show(number, local, finish.seed);
            count(walk);
        }
        walk.patience.is_over_after(steps, self.watch);
    }

    /// What a surface shows of the light behind it; rays that go on are added to the walk's.
    #[inline(never)]
    fn rest(
        &self,
        walk: &mut Walk,
        batch: &SurfaceBatch,
        number: usize,
        goes_on: bool,
        to: u32,
    ) -> Rgb {
        let Some(stand) = batch.at(number) else { return Rgb::BLACK };
        let both = self.world.objects[stand.hit.object as usize].double_illuminate;
        let local = match both || stand.place.finish.extras.is_some() {
            true => self.lit_behind(walk, &stand, both),
            false => Rgb::BLACK,
        };
        if goes_on {
            self.scatter(walk, &stand, to);
        }
        local
    }

    /// Returns a bit for each surface that does nothing but show what it is like and mirror rays.
    #[inline(always)]
    fn mirrors(&self, batch: &SurfaceBatch) -> u32 {
        let mut mirrors = 0;
        for number in numbers(batch.mask & !batch.shaped) {
            let Some(finish) = batch.finish(number) else { continue };
            let Some(reflection) = &finish.reflection else { continue };
            let object = &self.world.objects[batch.hits[number].object as usize];
            let parts =
                self.bends && reflection.fresnel || self.clear && batch.paints[number].is_clear();
            let is_plain = !parts
                && finish.extras.is_none()
                && !object.double_illuminate
                && reflection.minimum == reflection.maximum
                && reflection.metallic == 0.0;
            mirrors |= if is_plain { 1 << number } else { 0 };
        }
        mirrors
    }

    /// Adds the mirrored ray of a surface that mirrors the same at all angles to the walk's.
    #[inline(always)]
    fn mirror(&self, walk: &mut Walk, way: &Way, finish: &Finish, ray: Ray, to: u32) {
        let Some(reflection) = &finish.reflection else { return };
        let most = || reflection::most(reflection, 0.0);
        let Some(weight) = self.weight(way.weight, finish, most) else { return };
        let factor = reflection.maximum;
        if factor.is_black() {
            return;
        }
        walk.counters.reflection += 1;
        let (level, mirrored, inside) = (way.level + 1, true, None);
        let (spectrum, within) = (way.spectrum, way.within);
        let way = Way { ray, weight, level, mirrored, inside, spectrum, within };
        walk.onward.push(Onward { way, back: Back { to, factor, exponent: reflection.exponent } });
    }

    /// What the lights on the other side of a surface add that is lit on `both`, or scatters their light.
    #[cold]
    #[inline(never)]
    fn lit_behind(&self, walk: &mut Walk, stand: &ShadedSurface, both: bool) -> Rgb {
        let ShadedSurface { place, surface, .. } = stand;
        if !behind::is_lit_behind(place.finish, both) {
            return Rgb::BLACK;
        }
        if self.counts {
            walk.counters.evaluations.from_behind += 1;
        }
        let normal = place.flat.map_or(place.normal, |Flat { normal, .. }| normal);
        let lights = self.lights_of(stand.hit.object);
        let ground = Ground { place, behind: surface.spawn(-normal), lights };
        behind::from_behind(self, walk, &ground, both)
    }
}
