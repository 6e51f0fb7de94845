//! Area lights: many places that light comes from instead of one, which makes soft shadows.
//!
//! **In:** a light with an [`Area`], and a place on a surface. **Out:** the part of the light that comes there.
//! **Invariant:** it depends on the place and the light alone; random numbers are numbered by both and by the
//! node or sample.
//!
//! Light comes from the nodes of the scene's [`grid`], or from samples [`spread`] over its area. [`Sight`] looks at
//! either from a place, many at once.

mod grid;
mod panel;
mod sight;
mod spread;

pub(super) use grid::Nodes;
pub(super) use panel::Panel;

use super::Walk;
use super::media::Within;
use super::shade::{self, Place, Side};
use super::shadow::{self, Aim};
use super::surface_batch::{ShadedSurface, SurfaceBatch};
use super::tracer::Tracer;
use crate::color::Rgb;
use crate::math::Vector;
use crate::math::wide::numbers;
use crate::world::{Area, Beam, Light, LightKind};
use panel::Source;
use sight::Sight;

/// A light with an area, and its number.
#[derive(Clone, Copy)]
pub(super) struct AreaLight<'a> {
    pub number: usize,
    pub light: &'a Light,
    pub area: &'a Area,
}

impl<'a> AreaLight<'a> {
    /// Returns a light, if it has an area.
    #[inline(always)]
    pub fn of(number: usize, light: &'a Light) -> Option<Self> {
        light.area.as_ref().map(|area| Self { number, light, area })
    }

    /// Returns a light, if it illuminates by all of its nodes.
    #[inline(always)]
    pub fn illuminating(number: usize, light: &'a Light) -> Option<Self> {
        Self::of(number, light).filter(|of| of.area.illuminates)
    }
}

/// Where on a surface the light falls.
pub(super) struct Ground<'a> {
    pub place: &'a Place<'a>,
    /// Where rays start on the other side.
    pub behind: Vector,
    /// The lights of its object; `None` if all are.
    pub lights: Option<&'a [u32]>,
}

impl Ground<'_> {
    /// Returns whether a light lights the object.
    #[inline(always)]
    pub fn is_lit_by(&self, light: usize) -> bool {
        self.lights.is_none_or(|lights| lights.contains(&(light as u32)))
    }

    /// Returns where a ray starts.
    fn start(&self, direction: Vector) -> Vector {
        let normal = self.place.flat.map_or(self.place.normal, |flat| flat.normal);
        if normal.dot(direction) < 0.0 { self.behind } else { self.place.origin }
    }
}

/// Returns what part of a light comes from all of its area to a surface; `color` is the light without shadows.
#[inline(never)]
pub(super) fn visible(
    tracer: &Tracer,
    walk: &mut Walk,
    of: AreaLight,
    ground: &Ground,
    color: Rgb,
) -> Rgb {
    if tracer.counts {
        walk.counters.evaluations.area_lights += 1;
    }
    let casts = tracer.shadows && of.light.casts_shadows;
    if !casts && of.light.through.is_none() {
        return Rgb::WHITE;
    }
    let Some(panel) = tracer.panels.get(of.number).and_then(Option::as_ref) else {
        return Rgb::WHITE;
    };
    let Some(sight) = Sight::new(tracer, walk, of, ground, panel) else { return Rgb::WHITE };
    match &panel.source {
        Source::Spread(spread) => spread::visible(&sight, walk, spread, color),
        Source::Grid(start) => grid::visible(&sight, walk, start, color),
    }
}

/// Returns the mean of what a surface answers to each node of a light, without shadows, times the part of the light
/// that comes to it; `None` where that is nothing.
#[inline(never)]
pub(super) fn mean(
    tracer: &Tracer,
    walk: &mut Walk,
    of: AreaLight,
    ground: &Ground,
    mut answer: impl FnMut(&mut Walk, &LightKind) -> Option<Rgb>,
) -> Option<Rgb> {
    let panel = tracer.panels.get(of.number).and_then(Option::as_ref)?;
    let facing = panel.facing(of, ground.place.point);
    let (mut sum, mut count) = (Rgb::BLACK, 0);
    panel.each(&facing, |position| {
        sum += answer(walk, &of.kind_at(position)).unwrap_or(Rgb::BLACK);
        count += 1;
    });
    if sum.is_black() {
        return None;
    }
    if tracer.counts {
        walk.counters.evaluations.diffuse += count;
    }
    let visible = shade::shared(walk, (of.number, Side::Front), |walk| {
        Some(visible(tracer, walk, of, ground, of.light.color))
    });
    Some(sum * (1.0 / count as f64) * visible?)
}

/// Returns the light of one node without shadows, as it comes to a point. A node of a cylinder of light has the
/// beam of the light's position (measured).
pub(super) fn emitted(
    tracer: &Tracer,
    walk: &mut Walk,
    of: AreaLight,
    within: Within,
    (kind, aim): (&LightKind, &Aim),
    origin: Vector,
) -> Option<Rgb> {
    let beam = of.light.attenuation.and_then(|attenuation| attenuation.beam);
    if !matches!(beam, Some(Beam::Cylinder { .. })) {
        return tracer.emitted(walk, (of.light, kind), within, origin, aim);
    }
    let aim = shadow::aim(&of.light.kind, origin)?;
    tracer.emitted(walk, (of.light, &of.light.kind), within, origin, &aim)
}

impl<'a> Tracer<'a> {
    /// Returns the lights of an object; `None` if all are.
    #[inline(always)]
    pub(super) fn lights_of(&self, object: u32) -> Option<&'a [u32]> {
        if self.world.light_sets.is_empty() {
            return None;
        }
        let set = self.world.objects[object as usize].lights;
        Some(&self.world.light_sets[set as usize])
    }

    /// Adds to what surfaces show what they send to the viewer of a light that is not simple: an area light, or one
    /// that does not light all objects.
    #[inline(never)]
    pub(super) fn light_one_by_one(
        &self,
        walk: &mut Walk,
        batch: &mut SurfaceBatch,
        (number, light): (usize, &Light),
    ) {
        for of in numbers(batch.mask) {
            let Some(ShadedSurface { hit, place, surface, .. }) = batch.at(of) else { continue };
            let normal = place.flat.map_or(place.normal, |flat| flat.normal);
            let behind = place.flat.map_or_else(|| surface.spawn(-normal), |flat| flat.behind);
            let ground = Ground { place: &place, behind, lights: self.lights_of(hit.object) };
            if self.counts && ground.lights.is_some() {
                walk.counters.evaluations.light_groups += 1;
            }
            if shade::answers(place.finish)
                && ground.is_lit_by(number)
                && let Some(lit) = shade::before(self, walk, &ground, (number, light))
            {
                batch.add(of, lit);
            }
        }
    }
}

#[cfg(test)]
mod tests;
