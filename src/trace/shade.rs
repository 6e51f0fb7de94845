//! The light a surface sends to the viewer by itself and by the lights it sees: everything but what
//! it mirrors and lets through.

use super::Walk;
use super::area::{self, AreaLight, Ground};
use super::attenuation::attenuated;
use super::extras::{self, Lit};
use super::highlight::{self, Gloss};
use super::media::Within;
use super::shadow::{self, Aim};
use super::tracer::Tracer;
use crate::color::Rgb;
use crate::math::Vector;
use crate::math::power::power;
use crate::world::{Finish, Light, LightKind};

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
    /// The solids that the viewer's ray is in.
    pub within: Within,
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
pub(super) fn local(tracer: &Tracer, walk: &mut Walk, ground: &Ground) -> Rgb {
    let place = ground.place;
    let mut sum = place.body * place.finish.emission;
    if !answers(place.finish) {
        return sum;
    }
    for light in tracer.world.lights.iter().enumerate() {
        if ground.is_lit_by(light.0)
            && let Some(lit) = before(tracer, walk, ground, light)
        {
            sum += lit;
        }
    }
    sum
}

/// What a surface sends to the viewer of a light before it; `None` where the light does not come there.
#[inline(always)]
pub(super) fn before(
    tracer: &Tracer,
    walk: &mut Walk,
    ground: &Ground,
    (number, light): (usize, &Light),
) -> Option<Rgb> {
    let place = ground.place;
    if let Some(of) = AreaLight::illuminating(number, light) {
        return area::mean(tracer, walk, of, ground, |walk, kind| {
            let Toward { origin, aim, cosine, .. } = toward(place, kind)?;
            let color = area::emitted(tracer, walk, of, ground.place.within, (kind, &aim), origin)?;
            let to_light = aim.to_light;
            Some(color * answered(place, (number, light), to_light, cosine, walk.part))
        });
    }
    let lit = toward(place, &light.kind)?;
    let color = arriving(tracer, walk, (number, light), ground, (lit.origin, lit.side), &lit.aim)?;
    if tracer.counts {
        count(walk, place.finish, light);
    }
    let answer = answered(place, (number, light), lit.aim.to_light, lit.cosine, walk.part);
    Some(color * answer)
}

/// Whether a finish answers lights before the surface.
#[inline(always)]
pub(super) fn answers(finish: &Finish) -> bool {
    finish.diffuse != 0.0 || !finish.lobes.is_empty()
}

/// A light as seen from a surface that it may light.
#[derive(Clone, Copy)]
pub(super) struct Toward {
    /// Where rays toward the light start.
    pub origin: Vector,
    pub side: Side,
    pub aim: Aim,
    /// Of the angle to the normal.
    pub cosine: f64,
}

/// How a surface lies toward a light; `None` where that is behind it.
#[inline(always)]
pub(super) fn toward(place: &Place, light: &LightKind) -> Option<Toward> {
    let height = shadow::height(light, place.point, place.normal);
    if !(height > 0.0 || (place.finish.seed && height == 0.0)) {
        return None;
    }
    let (origin, side) = match &place.flat {
        Some(flat) if shadow::height(light, place.point, flat.normal) < 0.0 => {
            (flat.behind, Side::Back)
        }
        _ => (place.origin, Side::Front),
    };
    let aim = shadow::aim(light, origin)?;
    let cosine = place.normal.dot(aim.to_light).max(0.0);
    Some(Toward { origin, side, aim, cosine })
}

/// What part of a light's intensity a surface sends to the viewer.
#[inline(always)]
pub(super) fn answered(
    place: &Place,
    (number, light): (usize, &Light),
    to_light: Vector,
    cosine: f64,
    part: u32,
) -> Rgb {
    match &place.finish.extras {
        None => answer(place, light, to_light, cosine),
        Some(extras) => {
            let lit = Lit { light, number, to_light, cosine, part };
            extras::answer(place, extras, place.finish.diffuse, true, &lit)
        }
    }
}

impl Tracer<'_> {
    /// What of a light's colour goes to a point; `None` where none does.
    #[inline(always)]
    pub(super) fn emitted(
        &self,
        walk: &mut Walk,
        (light, kind): (&Light, &LightKind),
        within: Within,
        point: Vector,
        aim: &Aim,
    ) -> Option<Rgb> {
        let Some(attenuation) = &light.attenuation else { return Some(light.color) };
        if self.counts {
            walk.counters.evaluations.attenuation += 1;
        }
        let color = attenuated(light.color, attenuation, kind, point, *aim)?;
        Some(match attenuation.fog {
            true => color * self.light_through_fog(walk, within, point, aim),
            false => color,
        })
    }

    /// What the clear surfaces between a point and a light let through.
    pub(super) fn filtered(
        &self,
        walk: &mut Walk,
        within: Within,
        origin: Vector,
        aim: &Aim,
    ) -> Rgb {
        if self.counts {
            walk.counters.evaluations.colored_shadows += 1;
        }
        shadow::filtered(self, walk, within, origin, aim)
    }
}

/// The side of a surface, as the viewer sees it, on which a ray toward a light starts.
#[derive(Clone, Copy)]
pub(super) enum Side {
    Front,
    Back,
}

/// What of a light, the `number`th, comes to `origin`; `None` where nothing does. The parts of a texture share
/// one search on each side.
pub(super) fn arriving(
    tracer: &Tracer,
    walk: &mut Walk,
    (number, light): (usize, &Light),
    ground: &Ground,
    (origin, side): (Vector, Side),
    aim: &Aim,
) -> Option<Rgb> {
    shared(walk, (number, side), |walk| {
        searched(tracer, walk, (number, light), ground, origin, aim)
    })
}

/// Returns what is found of a light on a side of the surface: once for all parts of a texture.
pub(super) fn shared(
    walk: &mut Walk,
    (number, side): (usize, Side),
    find: impl FnOnce(&mut Walk) -> Option<Rgb>,
) -> Option<Rgb> {
    let is_part = walk.part > 0;
    let known = walk.arrived.get(number).filter(|_| is_part).and_then(|sides| sides[side as usize]);
    if let Some(known) = known {
        return known;
    }
    let found = find(walk);
    if let Some(sides) = walk.arrived.get_mut(number).filter(|_| is_part) {
        sides[side as usize] = Some(found);
    }
    found
}

fn searched(
    tracer: &Tracer,
    walk: &mut Walk,
    (number, light): (usize, &Light),
    ground: &Ground,
    origin: Vector,
    aim: &Aim,
) -> Option<Rgb> {
    let within = ground.place.within;
    let mut color = tracer.emitted(walk, (light, &light.kind), within, origin, aim)?;
    if let Some(of) = AreaLight::of(number, light) {
        let color = color * area::visible(tracer, walk, of, ground, color);
        return (!color.is_black()).then_some(color);
    }
    let aim = &tracer.shone_through(walk, light, origin, aim)?;
    if tracer.shadows && light.casts_shadows {
        if shadow::shadowed(tracer, walk, number, origin, aim) {
            return None;
        }
        if tracer.filters_shadows {
            color = color * tracer.filtered(walk, within, origin, aim);
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
pub(super) fn answer(place: &Place, light: &Light, to_light: Vector, cosine: f64) -> Rgb {
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
pub(super) fn count(walk: &mut Walk, finish: &Finish, light: &Light) {
    let evaluations = &mut walk.counters.evaluations;
    evaluations.diffuse += u64::from(finish.diffuse != 0.0);
    let lobes = if shines(finish, light) { finish.lobes.len() } else { 0 };
    evaluations.highlights += lobes as u64;
}
