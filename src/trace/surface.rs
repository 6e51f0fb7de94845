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
use super::traits::{DOES_MORE, MIRRORS, Masks, SEED};
use super::way::Way;
use super::{Walk, behind, reflection, sky};
use crate::color::Rgb;
use crate::geometry::SurfacePoints;
use crate::math::wide::{Rows, dispatch, numbers};
use crate::shape::Ray;
use crate::world::{Finish, Texture};

impl<'a> Tracer<'a> {
    /// Shades surfaces side by side: tells what each shows by itself, and adds the rays that go on to the walk's.
    #[inline(never)]
    pub fn shade(&self, walk: &mut Walk, mut surfaces: Surfaces) {
        let packet = surfaces.packet;
        let hits = &packet.hits;
        let mut plains = [None; SLICE];
        let (mut mask, mut traits) = (0, Masks::default());
        let (mut layered, mut double) = (0, 0);
        // Surfaces that rays go on from.
        let (mut steps, mut pending) = (0, walk.pending());
        let mut count = |walk: &Walk| {
            steps += u32::from(walk.pending() > pending);
            pending = walk.pending();
        };
        for number in numbers(surfaces.mask) {
            let hit = &hits[number];
            if self.counts {
                let hidden = !std::ptr::eq(self.met_by(&packet.way(number)), self.geometry);
                walk.counters.evaluations.count(self.world, hit.found().as_ref(), hidden);
            }
            if hit.found().is_none() {
                if self.has_alpha {
                    let sky =
                        sky::seen_with_alpha(self.world, &self.sharpness, &packet.way(number));
                    surfaces.show_sky(number, sky);
                } else {
                    let direction = packet.rays.directions.at(number);
                    let sky = sky::seen(self.world, &self.sharpness, direction);
                    surfaces.show(number, sky, false);
                }
                continue;
            }
            let object = &self.world.objects[hit.object as usize];
            let texture = self.world.coat(object, hit.leaving).texture;
            match &self.world.textures[texture as usize] {
                Texture::Plain(plain) => {
                    plains[number] = Some(plain);
                    mask |= 1 << number;
                    traits.add(number, self.traits[texture as usize]);
                    double |= u32::from(object.double_illuminate) << number;
                }
                Texture::Layers(_) => layered |= 1 << number,
                _ => {
                    let to = surfaces.first + number as u32;
                    let way = packet.way(number);
                    let local = self.composite(walk, &way, hit, to, Known::NOTHING);
                    surfaces.show(number, local, false);
                    count(walk);
                }
            }
        }
        if mask | layered == 0 {
            walk.patience.is_over_after(steps, self.watch);
            return;
        }
        let rays = &packet.rays;
        let mut points = SurfacePoints::NONE;
        points.find(self.world, self.geometry.instructions(), (rays, mask | layered), hits);
        while layered != 0 {
            let side = ObjectSide::first(hits, layered, &points);
            self.shade_layered(walk, &mut surfaces, side, &mut count);
            layered &= !side.mask;
        }
        let clearness = self.world.settings.clearness;
        let mut batch = SurfaceBatch::new(packet, plains, (mask, traits), &points, clearness);
        self.paint(&mut batch);
        if self.lights {
            self.light(walk, std::slice::from_mut(&mut batch));
        }
        let mut clear = if self.clear { mask } else { 0 };
        for number in numbers(clear) {
            clear &= !(u32::from(!batch.paints[number].is_clear()) << number);
        }
        let does_more = traits.of(DOES_MORE) | double | clear;
        let simple = traits.of(MIRRORS) & !does_more & !batch.shaped;
        let does_more = does_more | traits.of(MIRRORS) & !simple;
        let mirrors = if self.secondary { simple } else { 0 };
        let mut mirrored = Rows::ZERO;
        if mirrors != 0 {
            let (directions, normals) = (&rays.directions, &points.facing);
            dispatch!(self.geometry.instructions().level(), simd => {
                reflection::mirrored_together(simd, directions, normals, mirrors, &mut mirrored);
            });
        }
        // Of others, no ray goes on, and no light from behind is seen.
        for number in numbers(mirrors | does_more) {
            let to = surfaces.first + number as u32;
            let goes_on = self.secondary && packet.level(number) < self.max_trace_level;
            if does_more >> number & 1 == 1 {
                let rest = self.rest(walk, &batch, number, goes_on, to);
                batch.add(number, rest);
            } else if let Some(finish) = batch.finish(number).filter(|_| goes_on) {
                let origin = points.origins.at(number);
                let ray = Ray { origin, direction: mirrored.at(number) };
                self.mirror(walk, packet.way(number), finish, ray, to);
            }
            count(walk);
        }
        let seed = traits.of(SEED);
        numbers(mask).for_each(|n| surfaces.show(n, batch.local(n), seed >> n & 1 == 1));
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

    /// Adds the mirrored ray of a surface that mirrors the same at all angles to the walk's.
    #[inline(always)]
    fn mirror(&self, walk: &mut Walk, way: Way, finish: &Finish, ray: Ray, to: u32) {
        let Some(reflection) = &finish.reflection else { return };
        let factor = reflection.maximum;
        let Some(weight) = self.weight(way.weight, finish, || factor.largest()) else { return };
        if factor.is_black() {
            return;
        }
        walk.counters.reflection += 1;
        let level = way.level + 1;
        let way = Way { ray, weight, level, mirrored: true, inside: None, ..way };
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
