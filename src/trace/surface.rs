//! Surfaces that rays have met: what they are like, what they show, and where rays go on from them.
//!
//! **In:** rays and their hits, side by side. **Out:** what each surface shows by itself, and the rays that go on.

use super::area::Ground;
use super::batch::{SLICE, Surfaces};
use super::shade::{Flat, Place};
use super::tracer::Tracer;
use super::way::Way;
use super::{Walk, behind, sky, texture};
use crate::color::{Color, Rgb};
use crate::geometry::{self, Hit};
use crate::shape::SurfacePoint;
use crate::world::{Plain, Texture};
use smallvec::SmallVec;

/// A surface of a plain texture that a ray has met.
pub(super) struct Stand<'a, 'b> {
    pub way: &'b Way,
    pub hit: &'b Hit,
    /// Its number among those that are shaded together.
    pub number: usize,
    pub surface: SurfacePoint,
    pub paint: Color,
    pub place: Place<'a>,
    /// What it shows by itself.
    pub local: Rgb,
}

impl<'a> Tracer<'a> {
    /// Shades surfaces side by side: tells what each shows by itself, and adds the rays that go on to the walk's.
    #[inline(never)]
    pub fn shade(&self, walk: &mut Walk, mut surfaces: Surfaces) {
        let (ways, hits) = (surfaces.ways, surfaces.hits);
        let mut stands: SmallVec<[Stand; SLICE]> = SmallVec::new();
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
                Texture::Plain(plain) => stands.push(self.stand(plain, way, hit, number)),
                _ => {
                    let to = surfaces.first + number as u32;
                    let local = self.composite(walk, way, hit, to);
                    surfaces.show(number, local, false);
                    count(walk);
                }
            }
        }
        if self.lights {
            self.light(walk, &mut stands);
        }
        for stand in &mut stands {
            let object = &self.world.objects[stand.hit.object as usize];
            let finish = stand.place.finish;
            if object.double_illuminate || finish.extras.is_some() {
                stand.local += self.lit_behind(walk, stand, object.double_illuminate);
            }
            surfaces.show(stand.number, stand.local, finish.seed);
            if self.secondary && stand.way.level < self.max_trace_level {
                self.scatter(walk, stand, surfaces.first + stand.number as u32);
                count(walk);
            }
        }
        walk.patience.is_over_after(steps, self.watch);
    }

    /// What there is where a ray meets a surface, on the side it comes from.
    #[inline(always)]
    fn stand<'b>(
        &self,
        plain: &'a Plain,
        way: &'b Way,
        hit: &'b Hit,
        number: usize,
    ) -> Stand<'a, 'b> {
        let ray = &way.ray;
        let surface = geometry::surface(self.world, ray, hit);
        let Plain { normal: bumps, finish, .. } = plain;
        let normal = if hit.leaving { -surface.normal } else { surface.normal };
        let paint = texture::color(self, plain, ray, hit, &surface);
        let origin = surface.spawn(normal);
        let (normal, flat) = match geometry::shading_normal(self.world, hit, &surface) {
            None => (normal, None),
            Some(smooth) => {
                let behind = surface.spawn(-normal);
                let smooth = if smooth.dot(ray.direction) > 0.0 { -smooth } else { smooth };
                (smooth, Some(Flat { normal, behind }))
            }
        };
        let (normal, flat, smooth) = match bumps {
            None => (normal, flat, None),
            Some(bumps) => {
                let behind =
                    surface.spawn(if hit.leaving { surface.normal } else { -surface.normal });
                let facing = if hit.leaving { -surface.normal } else { surface.normal };
                let flat = flat.unwrap_or(Flat { normal: facing, behind });
                let bumpy = texture::perturbed(self, bumps, normal, (ray, hit, &surface));
                (bumpy, Some(flat), Some(normal))
            }
        };
        let place = Place {
            finish,
            color: paint.rgb,
            body: paint.body(self.world.settings.clearness),
            point: surface.point,
            origin,
            normal,
            flat,
            smooth,
            to_viewer: -ray.direction,
            within: way.within,
        };
        let local = place.body * finish.emission;
        Stand { way, hit, number, surface, paint, place, local }
    }

    /// What the lights on the other side of a surface add that is lit on `both`, or scatters their light.
    #[cold]
    #[inline(never)]
    fn lit_behind(&self, walk: &mut Walk, stand: &Stand, both: bool) -> Rgb {
        let Stand { place, surface, .. } = stand;
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
