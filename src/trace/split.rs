//! A ray of all colours that becomes several rays, each of one colour, at a surface next to a dispersive interior.

use super::media::Border;
use super::onward::{self, Onward};
use super::path::{Link, Met, Tracer};
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
}

impl Tracer<'_> {
    /// Goes on from a surface that a ray of all colours goes through, as `samples` rays of one colour each. The
    /// surface's own reflection is added even where all light is thrown back.
    ///
    /// **Source:** POV-Ray 3.7's behaviour, measured.
    #[cold]
    pub(super) fn split<const COUNTS: bool>(
        &self,
        walk: &mut Walk,
        way: Way,
        met: &Met,
        toward: &Toward,
        samples: u32,
        (weight, factor): (f64, Rgb),
    ) -> Option<Way> {
        let Met { ref hit, ref place, local, .. } = *met;
        let Toward { normal, fresnel, border, left } = *toward;
        if COUNTS {
            walk.counters.evaluations.dispersion += 1;
        }
        let (mut before, mut behind) = (Vec::new(), Vec::new());
        if let Some((weight, link)) = self.mirrored(way.weight, place, fresnel, local) {
            let inside = (border.from != border.to && hit.leaving).then(|| Inside::of(hit));
            let way = Way { inside, ..way.mirrored(place, weight) };
            let Link { factor, exponent, .. } = link;
            before.push(Onward { way, factor, exponent, behind: false });
        }
        for sample in 0..samples {
            let spectrum = Some(dispersion::position(sample, samples));
            let factor = factor * dispersion::color(sample, samples) * left;
            let [from, to] = border.indices(self.world, spectrum);
            match refraction::bent(way.ray.direction, normal, from, to) {
                Some(bent) => {
                    let ray = Ray { origin: met.behind, direction: bent.direction };
                    let level = if from == to { way.level } else { way.level + 1 };
                    let inside = (from != to && !hit.leaving).then(|| Inside::of(hit));
                    let way = Way { ray, weight, level, inside, spectrum, ..way };
                    behind.push(Onward { way, factor, exponent: 1.0, behind: true });
                }
                // It is of all colours again: the total reflections are one ray.
                None => {
                    walk.counters.total_reflection += 1;
                    let inside = hit.leaving.then(|| Inside::of(hit));
                    let way = Way { inside, ..way.mirrored(place, weight) };
                    let new = Onward { way, factor, exponent: 1.0, behind: false };
                    onward::add(&mut before, 0, new);
                }
            }
        }
        before.append(&mut behind);
        onward::go_on(walk, local, place.finish.seed, before)
    }
}
