//! A ray of all colours that becomes several rays, each of one colour, at a surface next to a dispersive interior.

use super::batch::{Back, Onward};
use super::media::Border;
use super::surface_batch::ShadedSurface;
use super::tracer::Tracer;
use super::way::{Inside, Way};
use super::{Walk, dispersion, refraction};
use crate::color::Rgb;
use crate::math::Vector;
use crate::shape::Ray;

/// How a surface lies toward a ray that it splits.
pub(super) struct Toward {
    pub normal: Vector,
    pub fresnel: f64,
    pub border: Border,
    /// The part of the light behind it that is left after the way to it.
    pub left: Rgb,
    /// Where rays start that go on behind it.
    pub behind: Vector,
}

impl Tracer<'_> {
    /// Goes on from a surface that a ray of all colours goes through, as `samples` rays of one colour each. The
    /// surface's own reflection is added even where all light is thrown back.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured.
    #[cold]
    pub(super) fn split(
        &self,
        walk: &mut Walk,
        stand: &ShadedSurface,
        toward: &Toward,
        samples: u32,
        (weight, factor): (f64, Rgb),
        to: u32,
    ) {
        let &ShadedSurface { way, hit, ref place, .. } = stand;
        let Toward { normal, fresnel, border, left, behind } = *toward;
        let Border { from, to: after, within: [within, within_behind], .. } = border;
        if self.counts {
            walk.counters.evaluations.dispersion += 1;
        }
        let (since, since_behind) = (walk.onward.len(), walk.behind.len());
        if let Some((weight, back)) = self.mirrored(way.weight, place, fresnel, to) {
            let inside = (from != after && hit.leaving).then(|| Inside::of(hit));
            let way = Way { inside, within, ..way.mirrored(place, weight) };
            walk.onward.push(Onward { way, back });
        }
        for sample in 0..samples {
            let spectrum = Some(dispersion::position(sample, samples));
            let factor = factor * dispersion::color(sample, samples) * left;
            let back = Back { to, factor, exponent: 1.0 };
            let [from, after] = border.indices(self.world, spectrum);
            match refraction::bent(way.ray.direction, normal, from, after) {
                Some(bent) => {
                    let ray = Ray { origin: behind, direction: bent.direction };
                    let level = if from == after { way.level } else { way.level + 1 };
                    let inside = (from != after && !hit.leaving).then(|| Inside::of(hit));
                    let within = within_behind;
                    let way = Way { ray, weight, level, inside, spectrum, within, ..way };
                    walk.behind.push(Onward { way, back });
                }
                // It is of all colours again: the total reflections are one ray.
                None => {
                    walk.counters.total_reflection += 1;
                    let inside = hit.leaving.then(|| Inside::of(hit));
                    let way = Way { inside, within, ..way.mirrored(place, weight) };
                    walk.onward.join(Onward { way, back }, since);
                }
            }
        }
        walk.counters.reflection += (walk.onward.len() - since) as u64;
        walk.counters.transmission += (walk.behind.len() - since_behind) as u64;
    }
}
