//! The light that surfaces side by side send to the viewer: one light after the other, for all of them.
//!
//! **Invariant:** each surface shows what [`shade::local`] says of it alone.

use super::Walk;
use super::shade::{self, Toward};
use super::shadow::{self, Aim};
use super::surface_batch::{ShadedSurface, SurfaceBatch, vector};
use super::tracer::Tracer;
use super::traits::{ANSWERS, ANSWERS_BY_MORE, SEED};
use crate::color::Rgb;
use crate::math::Vector;
use crate::math::wide::*;
use crate::shape::Ray;
use crate::world::{Light, LightKind};
use smallvec::SmallVec;

/// Surfaces that lights may reach.
struct Grounds<'a> {
    points: &'a Rows,
    normals: &'a Rows,
    /// Where rays toward lights start.
    origins: &'a Rows,
    /// A bit for each that answers lights.
    answers: u32,
    /// Which of these are lit by the formula of the seed.
    seed: u32,
    /// Which are lit by another normal than they lie by: each is aimed at lights by itself.
    shaped: u32,
    /// The bits of those whose rays go together.
    together: SmallVec<[u32; ROW]>,
}

impl<'a> Grounds<'a> {
    #[inline(always)]
    fn of(layers: &[SurfaceBatch<'_, '_, 'a>], by_object: bool) -> Option<Self> {
        let first = layers.first()?;
        let (points, origins, normals) = first.rows();
        let (mut answers, mut seed, mut together) = (0, 0, SmallVec::new());
        let mut objects: SmallVec<[u32; ROW]> = SmallVec::new();
        for layer in layers {
            let answer = layer.mask & layer.traits.of(ANSWERS);
            answers |= answer;
            seed |= answer & layer.traits.of(SEED);
        }
        for number in numbers(if by_object { answers } else { 0 }) {
            let bit = 1 << number;
            let object = first.packet.hits[number].object;
            match objects.iter().position(|known| *known == object) {
                Some(place) => together[place] |= bit,
                None => {
                    objects.push(object);
                    together.push(bit);
                }
            }
        }
        if !by_object && answers != 0 {
            together.push(answers);
        }
        let shaped = first.shaped & answers;
        Some(Self { points, normals, origins, answers, seed, shaped, together })
    }
}

/// Rays from surfaces toward a light.
struct Aims {
    rays: Rays,
    reaches: Row,
    /// Of the angles to the normals.
    cosines: Row,
}

/// Returns the ways from places to a light.
#[inline(always)]
fn way<S: Simd>(simd: S, light: &LightKind, place: WideVector<S>) -> WideVector<S> {
    match *light {
        LightKind::Point { position } => WideVector::splat(simd, position) - place,
        LightKind::Directional { to_light } | LightKind::Parallel { to_light, .. } => {
            WideVector::splat(simd, to_light.get())
        }
    }
}

impl Aims {
    const NONE: Self = Self { rays: Rays::NONE, reaches: [0.0; ROW], cosines: [0.0; ROW] };

    /// Finds what [`shade::toward`] says of surfaces that lie as they are lit.
    #[inline(always)]
    fn find<S: Simd>(&mut self, simd: S, light: &LightKind, grounds: &Grounds) {
        let zero = all(simd, 0.0);
        for group in 0..GROUPS {
            if !has(grounds.answers, group) {
                continue;
            }
            let point = WideVector::of(simd, grounds.points, group);
            let normal = WideVector::of(simd, grounds.normals, group);
            let origin = WideVector::of(simd, grounds.origins, group);
            let height = normal.dot(way(simd, light, point));
            let above = bits(height.simd_gt(zero), group)
                | bits(height.simd_eq(zero), group) & grounds.seed;
            let way = way(simd, light, origin);
            let (to_light, reach, known) = match *light {
                LightKind::Point { .. } => {
                    let square = way.length_squared();
                    let reach = square.sqrt();
                    (way / reach, reach, bits(square.is_normal(), group))
                }
                LightKind::Directional { .. } => (way, all(simd, f64::INFINITY), u32::MAX),
                LightKind::Parallel { position, .. } => {
                    let reach = (WideVector::splat(simd, position) - origin).dot(way);
                    (way, reach, u32::MAX)
                }
            };
            let cosine = normal.dot(to_light);
            let cosine = cosine.simd_gt(zero).select(cosine, zero);
            origin.store(&mut self.rays.origins, group);
            to_light.store(&mut self.rays.directions, group);
            store(reach, &mut self.reaches, group);
            store(cosine, &mut self.cosines, group);
            let lit = above & grounds.answers & !grounds.shaped;
            self.rays.mask |= lit & known;
            for number in numbers(lit & !known) {
                let origin = grounds.origins.at(number);
                if let Some(aim) = shadow::aim(light, origin) {
                    let cosine = grounds.normals.at(number).dot(aim.to_light).max(0.0);
                    self.set(number, origin, aim, cosine);
                }
            }
        }
    }

    fn set(&mut self, number: usize, origin: Vector, Aim { to_light, reach }: Aim, cosine: f64) {
        self.rays.set(number, &Ray { origin, direction: to_light });
        (self.reaches[number], self.cosines[number]) = (reach, cosine);
    }

    fn aim(&self, number: usize) -> Aim {
        Aim { to_light: self.rays.directions.at(number), reach: self.reaches[number] }
    }
}

/// Adds the light that bodies scatter to what surfaces show.
#[inline(always)]
fn scatter<S: Simd>(simd: S, batch: &mut SurfaceBatch, lit: u32, colors: &Rows, cosines: &Row) {
    for group in 0..GROUPS {
        if !has(lit, group) {
            continue;
        }
        let part = four(simd, &batch.diffuse, group) * four(simd, cosines, group).abs();
        let body = WideVector::of(simd, &batch.bodies, group) * part;
        let ([a, b, c], [x, y, z]) = (WideVector::of(simd, colors, group).0, body.0);
        let sum = WideVector::of(simd, &batch.local, group);
        let new = sum + WideVector([a * x, b * y, c * z]);
        new.or(mask(simd, lit, group), sum).store(&mut batch.local, group);
    }
}

impl Tracer<'_> {
    /// Adds to the radiance of surfaces by themselves the light that they scatter to the viewer, for all layers of the
    /// same surfaces together. The first layer is visible at all of them, and all have its shading normals.
    #[inline(never)]
    pub(super) fn light(&self, walk: &mut Walk, layers: &mut [SurfaceBatch]) {
        let Some(grounds) = Grounds::of(layers, self.geometry.has_tree()) else { return };
        debug_assert!(layers.iter().all(|layer| {
            let mask = layer.mask;
            mask & !layers[0].mask == 0 && layer.shaped & mask == layers[0].shaped & mask
        }));
        for (number, light) in self.world.lights.iter().enumerate() {
            if !light.is_plain() || !self.world.light_sets.is_empty() {
                for batch in layers.iter_mut() {
                    self.light_one_by_one(walk, batch, (number, light));
                }
            } else if grounds.answers != 0 {
                self.light_together(walk, layers, &grounds, (number, light));
            }
        }
    }

    #[inline(always)]
    fn light_together(
        &self,
        walk: &mut Walk,
        layers: &mut [SurfaceBatch],
        grounds: &Grounds,
        (number, light): (usize, &Light),
    ) {
        let Some(first) = layers.first() else { return };
        let (kind, level) = (&light.kind, self.geometry.instructions().level());
        let mut aims = Aims::NONE;
        dispatch!(level, simd => aims.find(simd, kind, grounds));
        for surface in numbers(grounds.shaped) {
            if let Some(stand) = first.at(surface)
                && let Some(toward) = shade::toward(&stand.place, kind)
            {
                let Toward { origin, aim, cosine, .. } = toward;
                aims.set(surface, origin, aim, cosine);
            }
        }
        let color = vector(light.color);
        let mut colors = Rows([[color.x; ROW], [color.y; ROW], [color.z; ROW]]);
        if light.attenuation.is_some() {
            for surface in numbers(aims.rays.mask) {
                let (within, origin) = (first.within(surface), aims.rays.origins.at(surface));
                match self.emitted(walk, (light, kind), within, origin, &aims.aim(surface)) {
                    Some(color) => colors.set(surface, vector(color)),
                    None => aims.rays.mask &= !(1 << surface),
                }
            }
        }
        let lit = aims.rays.mask;
        let mut shadowed = 0;
        if self.shadows && light.casts_shadows {
            for together in &grounds.together {
                aims.rays.mask = lit & together;
                if aims.rays.mask != 0 {
                    let (rays, reaches) = (&aims.rays, &aims.reaches);
                    shadowed |= shadow::shadowed_together(self, walk, number, rays, reaches);
                }
            }
        }
        let mut lit = lit & !shadowed;
        if self.filters_shadows && light.casts_shadows {
            for surface in numbers(lit) {
                let (within, origin) = (first.within(surface), aims.rays.origins.at(surface));
                let through = self.filtered(walk, within, origin, &aims.aim(surface));
                let color = colors.at(surface) * vector(through);
                colors.set(surface, color);
                lit &= if color == Vector::ZERO { !(1 << surface) } else { u32::MAX };
            }
        }
        for batch in layers {
            let lit = lit & batch.mask & batch.traits.of(ANSWERS);
            if self.counts {
                let finishes = numbers(lit).filter_map(|surface| batch.finish(surface));
                finishes.for_each(|finish| shade::count(walk, finish, light));
            }
            let (more, cosines) = (lit & batch.traits.of(ANSWERS_BY_MORE), &aims.cosines);
            dispatch!(level, simd => scatter(simd, batch, lit & !more, &colors, cosines));
            for surface in numbers(more) {
                let Some(ShadedSurface { place, .. }) = batch.at(surface) else { continue };
                let to_light = aims.rays.directions.at(surface);
                let light = (number, light);
                let answer = shade::answered(&place, light, to_light, cosines[surface], 0);
                let Vector { x: red, y: green, z: blue } = colors.at(surface);
                batch.add(surface, Rgb { red, green, blue } * answer);
            }
        }
    }
}
