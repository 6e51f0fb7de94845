//! Surfaces that rays have met: what they are like, what they show, and where rays go on from them.
//!
//! **In:** rays and their hits, side by side. **Out:** what each surface shows by itself, and the rays that go on.

use super::area::Ground;
use super::batch::{Back, Onward, SLICE, Surfaces};
use super::media::Within;
use super::painted::Known;
use super::shade::{Flat, Place};
use super::texture::Side;
use super::tracer::Tracer;
use super::way::Way;
use super::{Walk, behind, reflection, sky, texture};
use crate::color::{Color, Rgb};
use crate::geometry::{self, Hit, SurfacePoints};
use crate::math::Vector;
use crate::math::wide::{Rays, Rows, dispatch, numbers};
use crate::shape::{Ray, Shape, SurfacePoint};
use crate::world::{Finish, Pigment, Plain, Texture};
use smallvec::SmallVec;

/// A surface of a plain texture that a ray has met.
pub(super) struct Stand<'a, 'b> {
    pub way: &'b Way,
    pub hit: &'b Hit,
    pub surface: SurfacePoint,
    pub paint: Color,
    pub place: Place<'a>,
}

/// Surfaces of plain textures among those that are shaded together, by their number among these.
pub(super) struct Stands<'a, 'b, 'c> {
    pub ways: &'b [Way],
    pub hits: &'b [Hit],
    /// A bit for each.
    pub mask: u32,
    plains: [Option<&'a Plain>; SLICE],
    surfaces: &'c SurfacePoints,
    paints: [Color; SLICE],
    bodies: [Rgb; SLICE],
    /// Those that are lit by another normal than they lie by.
    pub shaped: u32,
    shapes: SmallVec<[Shaped; SLICE]>,
    /// What each shows by itself.
    pub local: [Rgb; SLICE],
}

/// How a surface is lit by another normal than it lies by.
#[derive(Clone, Copy)]
struct Shaped {
    normal: Vector,
    flat: Flat,
    smooth: Option<Vector>,
}

impl<'a, 'b, 'c> Stands<'a, 'b, 'c> {
    /// Returns the finish of the surface of this number, which is there.
    #[inline(always)]
    pub fn finish(&self, number: usize) -> Option<&'a Finish> {
        self.plains[number].map(|plain| &plain.finish)
    }

    /// Returns the colour of the body of this number: of as much as is not clear.
    #[inline(always)]
    pub fn body(&self, number: usize) -> Rgb {
        self.bodies[number]
    }

    /// Returns the solids that the ray of this number is in.
    #[inline(always)]
    pub fn within(&self, number: usize) -> Within {
        self.ways[number].within
    }

    /// Returns the points of surfaces, where rays start that leave them, and the normals that they lie by.
    pub fn rows(&self) -> (&'c Rows, &'c Rows, &'c Rows) {
        let SurfacePoints { points, origins, facing, .. } = self.surfaces;
        (points, origins, facing)
    }

    /// Returns the place among the shapes of that of this number.
    #[inline(always)]
    fn place_of_shape(&self, number: usize) -> usize {
        (self.shaped & ((1 << number) - 1)).count_ones() as usize
    }

    /// Returns the surface of this number; `None` if it is not there.
    #[inline(always)]
    pub fn at(&self, number: usize) -> Option<Stand<'a, 'b>> {
        let finish = self.finish(number)?;
        let (way, hit) = (&self.ways[number], &self.hits[number]);
        let (surface, paint) = (self.surfaces.at(number), self.paints[number]);
        let mut place = Place {
            finish,
            color: paint.rgb,
            body: self.bodies[number],
            point: surface.point,
            origin: self.surfaces.origins.at(number),
            normal: self.surfaces.facing.at(number),
            flat: None,
            smooth: None,
            to_viewer: -way.ray.direction,
            within: way.within,
        };
        if self.shaped >> number & 1 == 1 {
            let Shaped { normal, flat, smooth } = self.shapes[self.place_of_shape(number)];
            (place.normal, place.flat, place.smooth) = (normal, Some(flat), smooth);
        }
        Some(Stand { way, hit, surface, paint, place })
    }
}

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
            let side = Side::first(hits, layered, &points);
            self.shade_layered(walk, &mut surfaces, side, &mut count);
            layered &= !side.mask;
        }
        let mut stands = Stands {
            ways,
            hits,
            mask,
            plains,
            surfaces: &points,
            paints: [Color::default(); SLICE],
            bodies: [Rgb::BLACK; SLICE],
            shaped: 0,
            shapes: SmallVec::new(),
            local: [Rgb::BLACK; SLICE],
        };
        self.paint(&mut stands);
        if self.lights {
            self.light(walk, &mut stands);
        }
        let mirrors = if self.secondary { self.mirrors(&stands) } else { 0 };
        let mut mirrored = Rows::ZERO;
        if mirrors != 0 {
            let (directions, normals) = (&rays.directions, &points.facing);
            dispatch!(self.geometry.instructions().level(), simd => {
                reflection::mirrored_together(simd, directions, normals, mirrors, &mut mirrored);
            });
        }
        for number in numbers(mask) {
            let Some(finish) = stands.finish(number) else { continue };
            let (way, to) = (&ways[number], surfaces.first + number as u32);
            let object = &self.world.objects[hits[number].object as usize];
            let mut local = stands.local[number];
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
                || (self.clear && stands.paints[number].is_clear())
            {
                local += self.rest(walk, &stands, number, goes_on, to);
            }
            surfaces.show(number, local, finish.seed);
            count(walk);
        }
        walk.patience.is_over_after(steps, self.watch);
    }

    /// Shades the surfaces of a side with layers.
    #[inline(never)]
    fn shade_layered(
        &self,
        walk: &mut Walk,
        surfaces: &mut Surfaces,
        side: Side,
        count: &mut impl FnMut(&Walk),
    ) {
        let object = &self.world.objects[side.hit.object as usize];
        let texture = self.world.coat(object, side.hit.leaving).texture;
        let Texture::Layers(layers) = &self.world.textures[texture as usize] else { return };
        let painted = self.paint_layers(layers, side);
        for number in numbers(side.mask) {
            let (way, hit) = (&surfaces.ways[number], &surfaces.hits[number]);
            let known = Known { painted: &painted, number };
            let local = self.composite(walk, way, hit, surfaces.first + number as u32, known);
            surfaces.show(number, local, false);
            count(walk);
        }
    }

    /// What a surface shows of the light behind it; rays that go on are added to the walk's.
    #[inline(never)]
    fn rest(&self, walk: &mut Walk, stands: &Stands, number: usize, goes_on: bool, to: u32) -> Rgb {
        let Some(stand) = stands.at(number) else { return Rgb::BLACK };
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

    /// Finds the colours and normals of surfaces.
    #[inline(always)]
    fn paint(&self, stands: &mut Stands<'a, '_, '_>) {
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
            let body = stands.paints[number].body(self.world.settings.clearness);
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

    /// Returns a bit for each surface that does nothing but show what it is like and mirror rays.
    #[inline(always)]
    fn mirrors(&self, stands: &Stands) -> u32 {
        let mut mirrors = 0;
        for number in numbers(stands.mask & !stands.shaped) {
            let Some(finish) = stands.finish(number) else { continue };
            let Some(reflection) = &finish.reflection else { continue };
            let object = &self.world.objects[stands.hits[number].object as usize];
            let parts =
                self.bends && reflection.fresnel || self.clear && stands.paints[number].is_clear();
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
