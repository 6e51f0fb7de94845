//! What the lights behind a surface add, if it is lit on both sides, or scatters their light.

use super::Walk;
use super::area::{self, AreaLight, Ground};
use super::extras::{self, Lit};
use super::shade::{Place, Side, Toward, answer, arriving, count};
use super::shadow;
use super::tracer::Tracer;
use crate::color::Rgb;
use crate::math::Vector;
use crate::world::{Finish, LightKind};

/// Whether a surface answers the lights behind it: if it is lit on both sides, or scatters their light.
#[inline(always)]
pub(super) fn is_lit_behind(finish: &Finish, both: bool) -> bool {
    both || finish.extras.as_ref().is_some_and(|extras| extras.behind != 0.0)
}

/// What the lights behind a surface add. If it is lit on `both` sides, it answers them as those before it,
/// but for its highlights, which know where the light is.
///
/// **Source:** POV-Ray 3.7's behaviour, measured to 1/10,000.
pub(super) fn from_behind(tracer: &Tracer, walk: &mut Walk, ground: &Ground, both: bool) -> Rgb {
    let mut sum = Rgb::BLACK;
    let Place { finish, .. } = *ground.place;
    let diffuse = match &finish.extras {
        Some(extras) if !both => extras.behind,
        _ => finish.diffuse,
    };
    if diffuse == 0.0 && finish.lobes.is_empty() {
        return sum;
    }
    for (number, light) in tracer.world.lights.iter().enumerate() {
        if !ground.is_lit_by(number) {
            continue;
        }
        let answered = |to_light: Vector, cosine: f64, part: u32| match &finish.extras {
            None => answer(ground.place, light, to_light, cosine),
            Some(extras) => {
                let lit = Lit { light, number, to_light, cosine, part };
                extras::answer(ground.place, extras, diffuse, both, &lit)
            }
        };
        if let Some(of) = AreaLight::illuminating(number, light) {
            let mean = area::mean(tracer, walk, of, ground, |walk, kind| {
                let Toward { origin, aim, cosine, .. } = toward_behind(ground, kind)?;
                let color =
                    area::emitted(tracer, walk, of, ground.place.within, (kind, &aim), origin)?;
                Some(color * answered(aim.to_light, cosine, walk.part))
            });
            sum += mean.unwrap_or(Rgb::BLACK);
            continue;
        }
        let Some(lit) = toward_behind(ground, &light.kind) else { continue };
        let from = (lit.origin, lit.side);
        let arriving = arriving(tracer, walk, (number, light), ground, from, &lit.aim);
        let Some(color) = arriving else { continue };
        if tracer.counts {
            match both {
                true => count(walk, finish, light),
                false => walk.counters.evaluations.diffuse += 1,
            }
        }
        sum += color * answered(lit.aim.to_light, lit.cosine, walk.part);
    }
    sum
}

/// How a surface lies toward a light behind it; `None` where that is before it.
fn toward_behind(&Ground { place, behind, .. }: &Ground, light: &LightKind) -> Option<Toward> {
    let is_behind = shadow::height(light, place.point, place.normal) < 0.0;
    if !is_behind {
        return None;
    }
    // By a perturbed normal it may be behind a surface that faces it.
    let (origin, side) = match &place.flat {
        Some(flat) if shadow::height(light, place.point, flat.normal) > 0.0 => {
            (place.origin, Side::Front)
        }
        _ => (behind, Side::Back),
    };
    let aim = shadow::aim(light, origin)?;
    let cosine = place.normal.dot(aim.to_light).min(0.0);
    Some(Toward { origin, side, aim, cosine })
}
