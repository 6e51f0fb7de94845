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
use super::packet::Packet;
use super::rainbow;
use super::shadow::Aim;
use super::tracer::Tracer;
use crate::color::Rgb;
use crate::geometry::Hit;
use crate::math::Vector;
use crate::math::wide::numbers;
use crate::shape::Ray;

impl Tracer<'_> {
    /// Adds the veils between the starts of rays and what they meet: rainbows, and fog before them, in whatever order
    /// they are written. There is none for a ray in a solid that fog does not fill.
    pub(super) fn veil(&self, walk: &mut Walk, packet: &Packet, all: &mut Vec<Veil>) {
        let (fogs, rainbows) = (&self.world.fogs, &self.world.rainbows);
        let rays = &packet.rays;
        let mask = match self.follows_media {
            true => walk.media.in_fog(self.solids(), packet),
            false => rays.mask,
        };
        if self.counts {
            let count = u64::from(mask.count_ones());
            walk.counters.evaluations.fog += count * fogs.len() as u64;
            walk.counters.evaluations.rainbows += count * rainbows.len() as u64;
        }
        let length = |hit: &Hit| hit.found().map_or(fog::SKY, |hit| hit.t);
        let lengths = std::array::from_fn(|number| length(&packet.hits[number]));
        let first = all.len();
        all.resize(first + rays.mask.count_ones() as usize, Veil::NONE);
        let veils = &mut all[first..];
        fog::add(fogs, self.geometry.instructions(), (rays, mask), &lengths, veils);
        if !rainbows.is_empty() {
            for number in numbers(mask) {
                let Ray { origin, direction } = rays.at(number);
                if let Some(veil) = rainbow::veil(rainbows, origin, direction, lengths[number]) {
                    veils[number] = veils[number].before(veil);
                }
            }
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
            let ray = Ray { origin: ray.at(from), ..ray };
            fog::veil(fogs, self.geometry.instructions(), &ray, to - from).through
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
