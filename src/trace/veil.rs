//! Where fog and rainbows are on the way of a ray: between its start and its end, outside of solids that fog does not
//! fill.
//!
//! **Invariant:** they veil what comes back along a ray, and all else is as without them. They change no ray's weight,
//! and dim only lights of `media_attenuation`.
//!
//! **Source:** POV-Ray 3.7's behaviour, measured for rays of the camera, mirrored, refracted and to lights.

use super::Walk;
use super::fog::{self, Veil};
use super::media::Within;
use super::rainbow;
use super::shadow::Aim;
use super::tracer::Tracer;
use super::way::Way;
use crate::color::Rgb;
use crate::geometry::Hit;
use crate::math::Vector;
use crate::shape::Ray;

impl Tracer<'_> {
    /// Returns the veil between a ray's start and what it meets: rainbows, and fog before them, in whatever order they
    /// are written. None if the ray is in a solid that fog does not fill.
    pub(super) fn veil(&self, walk: &mut Walk, way: &Way, hit: &Hit) -> Veil {
        let (fogs, rainbows) = (&self.world.fogs, &self.world.rainbows);
        if self.follows_media && !walk.media.is_in_fog(self.solids(), way.within) {
            return Veil::NONE;
        }
        if self.counts {
            walk.counters.evaluations.fog += fogs.len() as u64;
            walk.counters.evaluations.rainbows += rainbows.len() as u64;
        }
        let length = hit.found().map_or(fog::SKY, |hit| hit.t);
        let Ray { origin, direction } = way.ray;
        let fog = fog::veil(fogs, origin, direction, length);
        match rainbow::veil(rainbows, origin, direction, length) {
            Some(rainbow) => fog.before(rainbow),
            None => fog,
        }
    }

    /// Returns the part of light that fog leaves on its way from a light to `origin`, which is `within` solids: clear
    /// solids that it goes through contain none, unless they are hollow.
    #[cold]
    #[inline(never)]
    pub(super) fn light_through_fog(
        &self,
        walk: &mut Walk,
        within: Within,
        origin: Vector,
        aim: &Aim,
    ) -> Rgb {
        let fogs = &self.world.fogs;
        if self.counts {
            walk.counters.evaluations.fog += fogs.len() as u64;
        }
        let ray = Ray { origin, direction: aim.to_light };
        let length = aim.reach.abs().min(fog::SKY);
        let left = |from: f64, to: f64| {
            let start = ray.origin + ray.direction * from;
            fog::veil(fogs, start, ray.direction, to - from).through
        };
        if !self.follows_media {
            return left(0.0, length);
        }
        walk.coinciding.clear();
        if self.filters_shadows {
            let Walk { coinciding, counters, .. } = walk;
            self.geometry.filters(&ray, aim.reach, coinciding, &mut counters.work);
        }
        let Walk { coinciding, media, .. } = walk;
        media.fog_to_light(self.solids(), within, coinciding, length, left)
    }
}
