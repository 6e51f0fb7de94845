//! The sight of an area light from a place: which of many rays toward it are free.

use super::super::Walk;
use super::super::shadow::{self, Aim};
use super::super::tracer::Tracer;
use super::panel::{Facing, Panel};
use super::{AreaLight, Ground};
use crate::color::Rgb;
use crate::geometry::{Between, Shaft};
use crate::math::Vector;
use crate::math::bounds::Bounds;
use crate::math::wide::*;
use crate::shape::Ray;
use crate::world::LightKind;

/// An area light, and a place that it may light.
pub(super) struct Sight<'a, 'b> {
    tracer: &'b Tracer<'a>,
    pub of: AreaLight<'b>,
    ground: &'b Ground<'b>,
    pub panel: &'b Panel,
    pub facing: Facing<'b>,
    casts: bool,
    /// What may shadow its rays; `None` if that is not known to be little.
    between: Option<Between>,
}

/// Visibility of some positions of an area light.
pub(super) enum Seen {
    /// A bit for each position that is visible; the others are occluded.
    Plain(u32),
    Filtered(Box<[Rgb; ROW]>),
}

impl<'a, 'b> Sight<'a, 'b> {
    /// Returns `None` if all of the light comes.
    pub fn new(
        tracer: &'b Tracer<'a>,
        walk: &mut Walk,
        of: AreaLight<'b>,
        ground: &'b Ground<'b>,
        panel: &'b Panel,
    ) -> Option<Self> {
        let casts = tracer.shadows && of.light.casts_shadows;
        let is_point = matches!(of.light.kind, LightKind::Point { .. });
        let looks = casts && is_point && of.light.through.is_none();
        let between = (looks && ground.is_before(&panel.bounds)).then(|| {
            let shaft = Shaft { from: ground.place.origin, to: panel.bounds };
            tracer.geometry.between(&shaft, &mut walk.counters.work)
        });
        let between = between.flatten();
        // Nothing can shadow any of the light.
        if between.as_ref().is_some_and(Between::is_empty) {
            return None;
        }
        let facing = panel.facing(of, ground.place.point);
        Some(Self { tracer, of, ground, panel, facing, casts, between })
    }

    /// Looks at the first `count` of some positions of the light.
    #[inline(never)]
    pub fn look(&self, walk: &mut Walk, positions: &Rows, count: usize) -> Seen {
        let Self { tracer, of, casts, .. } = *self;
        // Of no meaning any more, as all of the batch.
        if walk.patience.is_over_after(count as u32, tracer.watch) {
            return Seen::Plain(0);
        }
        let all = (1u32 << count) - 1;
        let (mut rays, mut reaches) = (Rays::NONE, [0.0; ROW]);
        let odd = match of.light.kind {
            LightKind::Point { .. } => {
                let level = tracer.geometry.instructions().level();
                dispatch!(level, simd => self.aim(simd, positions, all, &mut rays, &mut reaches))
            }
            _ => all,
        };
        for number in numbers(odd) {
            if let Some((origin, aim)) = self.aimed(positions.at(number)) {
                rays.set(number, &Ray { origin, direction: aim.to_light });
                reaches[number] = aim.reach;
            }
        }
        let mut missed = 0;
        if of.light.through.is_some() {
            for number in numbers(rays.mask) {
                let Ray { origin, direction: to_light } = rays.at(number);
                let aim = Aim { to_light, reach: reaches[number] };
                match tracer.shone_through(walk, of.light, origin, &aim) {
                    Some(aim) => reaches[number] = aim.reach,
                    None => missed |= 1 << number,
                }
            }
            rays.mask &= !missed;
        }
        let shadowed = match (casts, &self.between) {
            (false, _) => 0,
            (true, Some(between)) => {
                shadow::shadowed_between(tracer, walk, of.number, between, (&rays, &reaches))
            }
            (true, None) => shadow::shadowed_together(tracer, walk, of.number, &rays, &reaches),
        };
        let lit = all & !(shadowed | missed);
        let filters = casts
            && tracer.filters_shadows
            && self.between.as_ref().is_none_or(|between| between.filters);
        if !filters {
            return Seen::Plain(lit);
        }
        let mut factors = Box::new([Rgb::BLACK; ROW]);
        for number in numbers(lit) {
            factors[number] = Rgb::WHITE;
            if rays.mask >> number & 1 == 1 {
                let Ray { origin, direction: to_light } = rays.at(number);
                let aim = Aim { to_light, reach: reaches[number] };
                factors[number] = tracer.filtered(walk, self.ground.place.within, origin, &aim);
            }
        }
        Seen::Filtered(factors)
    }

    /// Aims at a position; `None` if it is the place itself.
    fn aimed(&self, position: Vector) -> Option<(Vector, Aim)> {
        let kind = self.of.kind_at(position);
        // The side is that of the surface's point, and the aim that of where the ray starts.
        let toward = shadow::aim(&kind, self.ground.place.point)?;
        let origin = self.ground.start(toward.to_light);
        Some((origin, shadow::aim(&kind, origin)?))
    }

    /// Aims at positions as [`Self::aimed`] does; returns a bit for each that it has to aim at instead.
    #[inline(always)]
    fn aim<S: Simd>(
        &self,
        simd: S,
        positions: &Rows,
        mask: u32,
        rays: &mut Rays,
        reaches: &mut Row,
    ) -> u32 {
        let ground = self.ground;
        let point = WideVector::splat(simd, ground.place.point);
        let normal = WideVector::splat(simd, ground.normal());
        let before = WideVector::splat(simd, ground.place.origin);
        let behind = WideVector::splat(simd, ground.behind);
        let mut known = 0;
        for group in 0..GROUPS {
            if !has(mask, group) {
                continue;
            }
            let position = WideVector::of(simd, positions, group);
            let toward = position - point;
            let is_behind = normal.dot(toward).simd_lt(all(simd, 0.0));
            let origin = behind.or(is_behind, before);
            let way = position - origin;
            let (square, whole) = (way.length_squared(), toward.length_squared());
            let reach = square.sqrt();
            origin.store(&mut rays.origins, group);
            (way / reach).store(&mut rays.directions, group);
            store(reach, reaches, group);
            known |= bits(square.is_normal() & whole.is_normal(), group);
        }
        rays.mask = known & mask;
        mask & !known
    }
}

impl Ground<'_> {
    /// Returns the normal that decides on which side rays start.
    fn normal(&self) -> Vector {
        self.place.flat.map_or(self.place.normal, |flat| flat.normal)
    }

    /// Returns whether a box is on the side of the surface that the viewer sees.
    fn is_before(&self, bounds: &Bounds) -> bool {
        let (normal, point) = (self.normal(), self.place.point);
        let nearest = |axis: usize| match normal[axis] < 0.0 {
            true => normal[axis] * (bounds.high[axis] - point[axis]),
            false => normal[axis] * (bounds.low[axis] - point[axis]),
        };
        nearest(0) + nearest(1) + nearest(2) > 0.0
    }
}
