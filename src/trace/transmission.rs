//! What goes on from a surface that is clear, or mirrors by Fresnel's equations: rays behind it and before it.
//!
//! **In:** a hit. **Out:** the next ray, with the others on the stack of those that wait.

use super::batch::{Back, Onward};
use super::media::Border;
use super::shade::{Flat, Place};
use super::split::Toward;
use super::surface_batch::ShadedSurface;
use super::tracer::Tracer;
use super::way::{Inside, Way};
use super::{Walk, extras, reflection, refraction, texture};
use crate::color::Rgb;
use crate::geometry::Hit;
use crate::math::Vector;
use crate::shape::Ray;
use crate::world::Finish;

impl ShadedSurface<'_, '_> {
    /// Where rays start that go on behind the surface.
    pub(super) fn behind(&self) -> Vector {
        match self.place.flat {
            Some(Flat { behind, .. }) => behind,
            None => self.surface.spawn(-self.place.normal),
        }
    }
}

impl Tracer<'_> {
    /// Adds the rays that go on from a surface to the walk's; what they see goes back `to` the surface of that number.
    #[inline(always)]
    pub(super) fn scatter(&self, walk: &mut Walk, stand: &ShadedSurface, to: u32) {
        let ShadedSurface { way, place, paint, .. } = stand;
        let by_fresnel = |finish: &Finish| finish.reflection.as_ref().is_some_and(|r| r.fresnel);
        if (self.clear && paint.is_clear()) || (self.bends && by_fresnel(place.finish)) {
            self.part(walk, stand, to);
            return;
        }
        if let Some((weight, back)) = self.mirrored(way.weight, place, 0.0, to) {
            walk.counters.reflection += 1;
            walk.onward.push(Onward { way: way.mirrored(place, weight), back });
        }
    }

    /// The weight of the mirrored ray, and what comes back of what it sees; `None` where it is cut or nothing does.
    #[inline(always)]
    pub(super) fn mirrored(
        &self,
        weight: f64,
        place: &Place,
        fresnel: f64,
        to: u32,
    ) -> Option<(f64, Back)> {
        let reflection = place.finish.reflection.as_ref()?;
        let most = || reflection::most(reflection, fresnel);
        let weight = self.weight(weight, place.finish, most)?;
        let cosine = place.normal.dot(place.to_viewer);
        let factor = reflection::reflectance(reflection, place.color, cosine, fresnel);
        let factor = match &place.finish.extras {
            None => factor,
            Some(extras) => factor * extras::mirrored(extras, place, reflection.exponent),
        };
        let back = Back { to, factor, exponent: reflection.exponent };
        (!factor.is_black()).then_some((weight, back))
    }

    /// Goes on from a surface that is clear, or mirrors by Fresnel's equations: with what it lets through behind it,
    /// and with what it mirrors before it.
    ///
    /// Where nothing can go through, what is mirrored has the weight of what else would have gone
    /// through, and comes back whole, in the place of the finish's own reflection.
    /// `max_trace_level` does not count a surface that a ray goes straight through, between equal
    /// indices of refraction.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured to 1/65,535.
    #[inline(never)]
    fn part(&self, walk: &mut Walk, stand: &ShadedSurface, to: u32) {
        let &ShadedSurface { way, hit, ref place, paint, .. } = stand;
        let clear = self.clear && paint.is_clear();
        let behind = stand.behind();
        walk.coinciding.clear();
        if clear && hit.contested {
            let straight = Ray { origin: behind, direction: way.ray.direction };
            let Walk { coinciding, counters, .. } = walk;
            let work = &mut counters.work;
            self.met_by(&way).coinciding(&way.ray, hit, &straight, coinciding, work);
        }
        if self.counts {
            walk.counters.evaluations.refraction += u64::from(self.bends);
        }
        let border = match self.follows_media {
            true => walk.media.border(self.solids(), &way, hit, &walk.coinciding),
            false => Border::none(way.within),
        };
        let Border { from, to: after, .. } = border;
        let faces_away = place.smooth.is_some() && way.ray.direction.dot(place.normal) > 0.0;
        let toward = if faces_away { -place.normal } else { place.normal };
        let bent = refraction::bent(way.ray.direction, toward, from, after);
        // Mirrors are the same for all colours, as in POV-Ray (measured).
        let (of_white, indices) = match way.spectrum {
            None => (bent, [from, after]),
            Some(_) => {
                let indices = border.indices(self.world, None);
                (refraction::bent(way.ray.direction, toward, indices[0], indices[1]), indices)
            }
        };
        let fresnel = match of_white {
            Some(bent) if !faces_away => refraction::fresnel(indices[0], indices[1], bent.cosines),
            _ => 1.0,
        };
        let through = match clear {
            true => self.through(stand, &walk.coinciding, fresnel),
            false => None,
        };
        let left = border.left_after(self.world, hit.t);
        if self.counts {
            walk.counters.evaluations.absorption += u64::from(left != Rgb::WHITE);
        }
        let [within, within_behind] = border.within;
        let mirrored = |weight| Way { within, ..way.mirrored(place, weight) };
        if let Some(through) = through
            && way.spectrum.is_none()
            && let Some(samples) = border.samples(self.world)
        {
            let toward = Toward { normal: toward, fresnel, border, left, behind };
            self.split(walk, stand, &toward, samples, through, to);
            return;
        }
        let reflected = self.mirrored(way.weight, place, fresnel, to);
        match (through, bent) {
            (Some((weight, _)), None) => {
                walk.counters.total_reflection += 1;
                let inside = hit.leaving.then(|| Inside::of(hit));
                let back = Back { to, factor: left, exponent: 1.0 };
                walk.onward.push(Onward { way: Way { inside, ..mirrored(weight) }, back });
                return;
            }
            (Some((weight, factor)), Some(bent)) => {
                walk.counters.transmission += 1;
                let ray = Ray { origin: behind, direction: bent.direction };
                let level = if from == after { way.level } else { way.level + 1 };
                let inside = (from != after && !hit.leaving).then(|| Inside::of(hit));
                let way = Way { ray, weight, level, inside, within: within_behind, ..way };
                let back = Back { to, factor: factor * left, exponent: 1.0 };
                walk.behind.push(Onward { way, back });
            }
            (None, _) => {}
        }
        if let Some((weight, back)) = reflected {
            walk.counters.reflection += 1;
            let inside = (from != after && hit.leaving).then(|| Inside::of(hit));
            walk.onward.push(Onward { way: Way { inside, ..mirrored(weight) }, back });
        }
    }

    /// The weight of the ray behind a clear surface and the part of what it sees that comes back;
    /// `None` where it is cut or nothing comes back.
    fn through(
        &self,
        stand: &ShadedSurface,
        coinciding: &[Hit],
        fresnel: f64,
    ) -> Option<(f64, Rgb)> {
        let ShadedSurface { way, paint, .. } = stand;
        let Place { finish, color, normal, to_viewer, .. } = stand.place;
        let own = paint.transmittance();
        let others = coinciding.iter().map(|hit| texture::transmittance(self, &way.ray, hit));
        let mut factor = others.fold(own, |factor, other| factor * other);
        if finish.conserve_energy
            && let Some(reflection) = &finish.reflection
        {
            let cosine = normal.dot(to_viewer);
            let mirrored = reflection::reflectance(reflection, color, cosine, fresnel);
            factor = factor * mirrored.map(|part| 1.0 - part);
        }
        let weight = self.weight(way.weight, finish, || factor.largest())?;
        let too_dark = !finish.seed && factor.brightness().abs() < self.adc_bailout;
        // `refraction` takes no part in the cut (measured).
        let factor = if too_dark { Rgb::BLACK } else { factor * passed(finish) };
        (!factor.is_black()).then_some((weight, factor))
    }
}

/// The old factor of what is seen through a surface.
pub(super) fn passed(finish: &Finish) -> f64 {
    finish.extras.as_ref().map_or(1.0, |extras| extras.passed)
}
