//! The light a surface sends to the viewer by itself and by the lights it sees: everything but what
//! it mirrors and lets through.

use super::Walk;
use super::attenuation::attenuated;
use super::extras::{self, Lit};
use super::highlight::{self, Gloss};
use super::path::Tracer;
use super::shadow::{self, Aim};
use crate::color::Rgb;
use crate::geometry::ANY;
use crate::math::Vector;
use crate::math::power::power;
use crate::world::{Finish, Light};

/// A place on a surface, ready to be lit.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub finish: &'a Finish,
    /// The pigment's.
    pub color: Rgb,
    /// As much of it as is not clear.
    pub body: Rgb,
    pub point: Vector,
    /// Where rays that leave the surface start: `point` moved along `normal` by its error.
    pub origin: Vector,
    /// Of length 1, toward the viewer's side: of a smooth surface the one by which it is lit.
    pub normal: Vector,
    /// Of a smooth surface, which is lit otherwise than it lies.
    pub flat: Option<Flat>,
    /// The normal before a texture perturbed it.
    pub smooth: Option<Vector>,
    /// Of length 1.
    pub to_viewer: Vector,
}

/// How a surface lies that is lit by another normal.
#[derive(Clone, Copy)]
pub(super) struct Flat {
    /// Of length 1, toward the viewer's side.
    pub normal: Vector,
    /// Where rays start that leave the surface on the other side.
    pub behind: Vector,
}

impl Place<'_> {
    /// Where a ray starts: on the side that it leaves to. By its smooth normal a surface may see what lies
    /// behind it.
    #[inline(always)]
    pub fn start(&self, direction: Vector) -> Vector {
        match &self.flat {
            Some(Flat { normal, behind }) if normal.dot(direction) < 0.0 => *behind,
            _ => self.origin,
        }
    }
}

/// `B·emission + Σ I·(B·diffuse·(N·L)^brilliance + Σ lobes)` over the lights that are visible, where B is
/// the body's colour. A surface shines however clear it is.
///
/// A light behind the surface or on the point itself contributes nothing. One in the surface's
/// very plane (N·L = 0) makes a highlight on a seed finish, as the seed's formula says, and none
/// on others, as in POV-Ray.
///
/// Whether the surface faces a light is asked of its point; rays are aimed from where they start,
/// or what they pass near the light would not be where the light is.
#[inline(always)]
pub(super) fn local<const SHADOWS: bool, const KINDS: bool, const COUNTS: bool>(
    tracer: &Tracer,
    walk: &mut Walk,
    place: &Place,
) -> Rgb {
    let Place { finish, body, .. } = *place;
    let mut sum = body * finish.emission;
    if finish.diffuse == 0.0 && finish.lobes.is_empty() {
        return sum;
    }
    for (number, light) in tracer.world.lights.iter().enumerate() {
        let height = shadow::height(&light.kind, place.point, place.normal);
        if !(height > 0.0 || (finish.seed && height == 0.0)) {
            continue;
        }
        let (origin, side) = match &place.flat {
            Some(flat) if shadow::height(&light.kind, place.point, flat.normal) < 0.0 => {
                (flat.behind, Side::Back)
            }
            _ => (place.origin, Side::Front),
        };
        let Some(aim) = shadow::aim(&light.kind, origin) else { continue };
        let cosine = place.normal.dot(aim.to_light).max(0.0);
        let arriving =
            arriving::<SHADOWS, KINDS, COUNTS>(tracer, walk, (number, light), (origin, side), &aim);
        let Some(color) = arriving else { continue };
        if COUNTS {
            count(walk, finish, light);
        }
        let answer = match &finish.extras {
            None => answer(place, light, aim.to_light, cosine),
            Some(extras) => {
                let (to_light, part) = (aim.to_light, walk.part);
                let lit = Lit { light, number, to_light, cosine, part };
                extras::answer(place, extras, finish.diffuse, true, &lit)
            }
        };
        sum += color * answer;
    }
    sum
}

/// Whether a surface answers the lights behind it: if it is lit on both sides, or scatters their light.
#[inline(always)]
pub(super) fn is_lit_behind(finish: &Finish, both: bool) -> bool {
    both || finish.extras.as_ref().is_some_and(|extras| extras.behind != 0.0)
}

/// What the lights behind a surface add. If it is lit on `both` sides, it answers them as those before it,
/// but for its highlights, which know where the light is. `behind` is where rays start on that side.
///
/// **Source:** POV-Ray 3.7's behaviour, measured to 1/10,000.
pub(super) fn from_behind<const SHADOWS: bool, const COUNTS: bool>(
    tracer: &Tracer,
    walk: &mut Walk,
    place: &Place,
    behind: Vector,
    both: bool,
) -> Rgb {
    let mut sum = Rgb::BLACK;
    let finish = place.finish;
    let diffuse = match &finish.extras {
        Some(extras) if !both => extras.behind,
        _ => finish.diffuse,
    };
    for (number, light) in tracer.world.lights.iter().enumerate() {
        let is_behind = shadow::height(&light.kind, place.point, place.normal) < 0.0;
        if !is_behind || (diffuse == 0.0 && finish.lobes.is_empty()) {
            continue;
        }
        // By a perturbed normal it may be behind a surface that faces it.
        let (origin, side) = match &place.flat {
            Some(flat) if shadow::height(&light.kind, place.point, flat.normal) > 0.0 => {
                (place.origin, Side::Front)
            }
            _ => (behind, Side::Back),
        };
        let Some(aim) = shadow::aim(&light.kind, origin) else { continue };
        let cosine = place.normal.dot(aim.to_light).min(0.0);
        let arriving =
            arriving::<SHADOWS, ANY, COUNTS>(tracer, walk, (number, light), (origin, side), &aim);
        let Some(color) = arriving else { continue };
        if COUNTS {
            match both {
                true => count(walk, finish, light),
                false => walk.counters.evaluations.diffuse += 1,
            }
        }
        let answer = match &finish.extras {
            None => answer(place, light, aim.to_light, cosine),
            Some(extras) => {
                let (to_light, part) = (aim.to_light, walk.part);
                let lit = Lit { light, number, to_light, cosine, part };
                extras::answer(place, extras, diffuse, both, &lit)
            }
        };
        sum += color * answer;
    }
    sum
}

/// The side of a surface, as the viewer sees it, on which a ray toward a light starts.
#[derive(Clone, Copy)]
enum Side {
    Front,
    Back,
}

/// What of a light, the `number`th, comes to `origin`; `None` where nothing does. The parts of a texture share
/// one search on each side.
#[inline(always)]
fn arriving<const SHADOWS: bool, const KINDS: bool, const COUNTS: bool>(
    tracer: &Tracer,
    walk: &mut Walk,
    (number, light): (usize, &Light),
    (origin, side): (Vector, Side),
    aim: &Aim,
) -> Option<Rgb> {
    let is_part = walk.part > 0;
    let known = walk.arrived.get(number).filter(|_| is_part).and_then(|sides| sides[side as usize]);
    if let Some(known) = known {
        return known;
    }
    let found = searched::<SHADOWS, KINDS, COUNTS>(tracer, walk, (number, light), origin, aim);
    if let Some(sides) = walk.arrived.get_mut(number).filter(|_| is_part) {
        sides[side as usize] = Some(found);
    }
    found
}

#[inline(always)]
fn searched<const SHADOWS: bool, const KINDS: bool, const COUNTS: bool>(
    tracer: &Tracer,
    walk: &mut Walk,
    (number, light): (usize, &Light),
    origin: Vector,
    aim: &Aim,
) -> Option<Rgb> {
    let mut color = light.color;
    if let Some(attenuation) = &light.attenuation {
        if COUNTS {
            walk.counters.evaluations.attenuation += 1;
        }
        color = attenuated(color, attenuation, &light.kind, origin, *aim)?;
    }
    if SHADOWS && light.casts_shadows {
        if shadow::shadowed::<KINDS>(tracer, walk, number, origin, aim) {
            return None;
        }
        if tracer.filters_shadows {
            if COUNTS {
                walk.counters.evaluations.colored_shadows += 1;
            }
            color = color * shadow::filtered(tracer, walk, origin, aim);
            if color.is_black() {
                return None;
            }
        }
    }
    Some(color)
}

/// What part of the light's intensity goes to the viewer. A shadowless light makes no highlight
/// on a classic finish. **Source:** POV-Ray manual, section "Shadowless Lights".
#[inline(always)]
fn answer(place: &Place, light: &Light, to_light: Vector, cosine: f64) -> Rgb {
    let Place { finish, color, body, normal, to_viewer, .. } = *place;
    let mut sum = Rgb::BLACK;
    if finish.diffuse != 0.0 {
        sum = body * (finish.diffuse * slant(cosine, finish.brilliance));
    }
    if shines(finish, light) {
        sum += highlight::lobes(finish, &Gloss { color, normal, to_viewer, to_light, cosine });
    }
    sum
}

/// `|cosine|^brilliance`.
#[inline(always)]
pub(super) fn slant(cosine: f64, brilliance: f64) -> f64 {
    let slant = cosine.abs();
    if brilliance == 1.0 { slant } else { power(slant, brilliance) }
}

/// Whether a light makes highlights on a finish.
#[inline(always)]
pub(super) fn shines(finish: &Finish, light: &Light) -> bool {
    !finish.lobes.is_empty() && (light.casts_shadows || finish.seed)
}

/// What [`answer`] evaluates.
fn count(walk: &mut Walk, finish: &Finish, light: &Light) {
    let evaluations = &mut walk.counters.evaluations;
    evaluations.diffuse += u64::from(finish.diffuse != 0.0);
    let lobes = if shines(finish, light) { finish.lobes.len() } else { 0 };
    evaluations.highlights += lobes as u64;
}
