//! What goes on from a surface that is clear, or mirrors by Fresnel's equations: rays behind it and before it.
//!
//! **In:** a hit. **Out:** the next ray, with the others on the stack of those that wait.

use super::media::Border;
use super::path::{Fork, Link, Met, Tracer, passed};
use super::shade::Place;
use super::split::Toward;
use super::way::{Inside, Way};
use super::{Walk, reflection, refraction, texture};
use crate::color::Rgb;
use crate::geometry::Hit;
use crate::shape::Ray;

impl Tracer<'_> {
    /// Goes on from a surface that is clear, or mirrors by Fresnel's equations: what it lets through
    /// goes on behind it, what it mirrors before it, and if both are, that behind it waits. `None`
    /// where nothing goes on, or where the watch wants no more: then nor does any ray that waits.
    ///
    /// Where nothing can go through, what is mirrored has the weight of what else would have gone
    /// through, and comes back whole, in the place of the finish's own reflection.
    /// `max_trace_level` does not count a surface that a ray goes straight through, between equal
    /// indices of refraction.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured to 1/65,535.
    #[inline(never)]
    pub(super) fn part<const COUNTS: bool>(
        &self,
        walk: &mut Walk,
        way: Way,
        met: &Met,
    ) -> Option<Way> {
        let Met { ref hit, ref place, paint, local, .. } = *met;
        let seed = place.finish.seed;
        let clear = self.clear && paint.is_clear();
        if walk.patience.is_over_after(1, self.watch) {
            walk.forks.clear();
            return None;
        }
        walk.coinciding.clear();
        if clear && hit.contested {
            let straight = Ray { origin: met.behind, direction: way.ray.direction };
            let Walk { coinciding, counters, .. } = walk;
            let work = &mut counters.work;
            self.met_by(&way).coinciding(&way.ray, hit, &straight, coinciding, work);
        }
        if COUNTS {
            walk.counters.evaluations.refraction += u64::from(self.bends);
        }
        let border = match self.bends {
            true => walk.media.border(self.world, hit, &walk.coinciding, way.spectrum),
            false => Border::NONE,
        };
        let Border { from, to, .. } = border;
        let faces_away = place.smooth.is_some() && way.ray.direction.dot(place.normal) > 0.0;
        let toward = if faces_away { -place.normal } else { place.normal };
        let bent = refraction::bent(way.ray.direction, toward, from, to);
        // Mirrors are the same for all colours, as in POV-Ray (measured).
        let (of_white, [before, behind]) = match way.spectrum {
            None => (bent, [from, to]),
            Some(_) => {
                let [from, to] = border.indices(self.world, None);
                (refraction::bent(way.ray.direction, toward, from, to), [from, to])
            }
        };
        let fresnel = match of_white {
            Some(bent) if !faces_away => refraction::fresnel(before, behind, bent.cosines),
            _ => 1.0,
        };
        let through = match clear {
            true => self.through(&way, met, &walk.coinciding, fresnel),
            false => None,
        };
        let left = border.left_after(self.world, hit.t);
        if COUNTS {
            walk.counters.evaluations.absorption += u64::from(left != Rgb::WHITE);
        }
        if let Some(through) = through
            && way.spectrum.is_none()
            && let Some(samples) = border.samples(self.world)
        {
            let toward = Toward { normal: toward, fresnel, border, left };
            return self.split::<COUNTS>(walk, way, met, &toward, samples, through);
        }
        let behind = match (through, bent) {
            (Some((weight, _)), None) => {
                walk.counters.total_reflection += 1;
                walk.chain.push(Link::behind(local, left, seed));
                let inside = hit.leaving.then(|| Inside::of(hit));
                return Some(Way { inside, ..way.mirrored(place, weight) });
            }
            (Some((weight, factor)), Some(bent)) => {
                walk.counters.transmission += 1;
                let ray = Ray { origin: met.behind, direction: bent.direction };
                let level = if from == to { way.level } else { way.level + 1 };
                let inside = (from != to && !hit.leaving).then(|| Inside::of(hit));
                Some((Way { ray, weight, level, inside, ..way }, factor * left))
            }
            (None, _) => None,
        };
        match (self.mirrored(way.weight, place, fresnel, local), behind) {
            (None, None) => None,
            (None, Some((behind, factor))) => {
                walk.chain.push(Link::behind(local, factor, seed));
                walk.media.go_through();
                Some(behind)
            }
            (Some((weight, link)), behind) => {
                walk.counters.reflection += 1;
                walk.chain.push(Link { forks: behind.is_some(), ..link });
                if let Some((way, factor)) = behind {
                    let media = walk.media.wait_behind();
                    walk.forks.push(Fork { way, factor, exponent: 1.0, more: false, media });
                }
                let inside = (from != to && hit.leaving).then(|| Inside::of(hit));
                Some(Way { inside, ..way.mirrored(place, weight) })
            }
        }
    }

    /// The weight of the ray behind a clear surface and the part of what it sees that comes back;
    /// `None` where it is cut or nothing comes back.
    fn through(
        &self,
        way: &Way,
        met: &Met,
        coinciding: &[Hit],
        fresnel: f64,
    ) -> Option<(f64, Rgb)> {
        let Place { finish, color, normal, to_viewer, .. } = met.place;
        let own = met.paint.transmittance();
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
