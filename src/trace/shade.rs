//! The light a surface sends to the viewer by itself and by the lights it sees: everything but what
//! it mirrors and lets through.

use super::Walk;
use super::attenuation::attenuated;
use super::batch::SLICE;
use super::extras::{self, Lit};
use super::highlight::{self, Gloss};
use super::media::Within;
use super::shadow::{self, Aim};
use super::surface::Stand;
use super::tracer::Tracer;
use crate::color::Rgb;
use crate::math::Vector;
use crate::math::power::power;
use crate::shape::Ray;
use crate::world::{Finish, Light};
use smallvec::SmallVec;

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
pub(super) fn local(tracer: &Tracer, walk: &mut Walk, place: &Place) -> Rgb {
    let mut sum = place.body * place.finish.emission;
    if !answers(place.finish) {
        return sum;
    }
    for (number, light) in tracer.world.lights.iter().enumerate() {
        let Some(lit) = toward(place, light) else { continue };
        let from = (lit.origin, lit.side);
        let arriving = arriving(tracer, walk, (number, light), place.within, from, &lit.aim);
        let Some(color) = arriving else { continue };
        if tracer.counts {
            count(walk, place.finish, light);
        }
        let answer = answered(place, (number, light), lit.aim.to_light, lit.cosine, walk.part);
        sum += color * answer;
    }
    sum
}

/// Whether a finish answers lights before the surface.
#[inline(always)]
fn answers(finish: &Finish) -> bool {
    finish.diffuse != 0.0 || !finish.lobes.is_empty()
}

/// A light as seen from a surface that it may light.
#[derive(Clone, Copy)]
struct Toward {
    /// Where rays toward the light start.
    origin: Vector,
    side: Side,
    aim: Aim,
    /// Of the angle to the normal.
    cosine: f64,
}

/// How a surface lies toward a light; `None` where that is behind it.
#[inline(always)]
fn toward(place: &Place, light: &Light) -> Option<Toward> {
    let height = shadow::height(&light.kind, place.point, place.normal);
    if !(height > 0.0 || (place.finish.seed && height == 0.0)) {
        return None;
    }
    let (origin, side) = match &place.flat {
        Some(flat) if shadow::height(&light.kind, place.point, flat.normal) < 0.0 => {
            (flat.behind, Side::Back)
        }
        _ => (place.origin, Side::Front),
    };
    let aim = shadow::aim(&light.kind, origin)?;
    let cosine = place.normal.dot(aim.to_light).max(0.0);
    Some(Toward { origin, side, aim, cosine })
}

/// What part of a light's intensity a surface sends to the viewer.
#[inline(always)]
fn answered(
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

/// A ray from a surface toward a light.
pub(super) struct Arriving {
    /// The number of the surface.
    stand: usize,
    pub ray: Ray,
    /// What is not nearer than this casts no shadow.
    pub reach: f64,
    /// Of the angle to the normal.
    cosine: f64,
    /// What of the light's colour comes there if nothing is between.
    color: Rgb,
}

impl Tracer<'_> {
    /// Adds to what surfaces show what they send to the viewer of each light: [`local`] for many, one light after
    /// the other.
    #[inline(never)]
    pub(super) fn light(&self, walk: &mut Walk, stands: &mut [Stand]) {
        let mut rays: SmallVec<[Arriving; SLICE]> = SmallVec::new();
        for (number, light) in self.world.lights.iter().enumerate() {
            let mut object = u32::MAX;
            for stand in 0..stands.len() {
                // Rays from one object are close together.
                if stands[stand].hit.object != object {
                    object = stands[stand].hit.object;
                    self.arrive(walk, stands, (number, light), &mut rays);
                }
                let place = &stands[stand].place;
                if !answers(place.finish) {
                    continue;
                }
                let Some(toward) = toward(place, light) else { continue };
                let from = (toward.origin, &toward.aim);
                let color = self.emitted(walk, light, place.within, from.0, from.1);
                let Some(color) = color else { continue };
                let Toward { origin, aim: Aim { to_light, reach }, cosine, .. } = toward;
                let ray = Ray { origin, direction: to_light };
                rays.push(Arriving { stand, ray, reach, cosine, color });
            }
            self.arrive(walk, stands, (number, light), &mut rays);
        }
    }

    /// Adds to what surfaces show what they send to the viewer of a light, where nothing opaque is in the way.
    #[inline(always)]
    fn arrive(
        &self,
        walk: &mut Walk,
        stands: &mut [Stand],
        (number, light): (usize, &Light),
        rays: &mut SmallVec<[Arriving; SLICE]>,
    ) {
        let shadowed = match self.shadows && light.casts_shadows {
            true => shadow::shadowed_together(self, walk, number, rays),
            false => 0,
        };
        for (place, arriving) in rays.iter().enumerate() {
            if shadowed >> place & 1 == 0 {
                self.lit(walk, &mut stands[arriving.stand], (number, light), arriving);
            }
        }
        rays.clear();
    }

    /// Adds to what a surface shows what it sends to the viewer of a light that no opaque surface keeps away.
    #[inline(always)]
    fn lit(
        &self,
        walk: &mut Walk,
        Stand { place, local, .. }: &mut Stand,
        (number, light): (usize, &Light),
        arriving: &Arriving,
    ) {
        let &Arriving { ray, reach, cosine, mut color, .. } = arriving;
        let to_light = ray.direction;
        if self.filters_shadows && light.casts_shadows {
            let aim = Aim { to_light, reach };
            color = color * self.filtered(walk, place.within, ray.origin, &aim);
            if color.is_black() {
                return;
            }
        }
        if self.counts {
            count(walk, place.finish, light);
        }
        *local += color * answered(place, (number, light), to_light, cosine, 0);
    }

    /// What of a light's colour goes to a point; `None` where none does.
    #[inline(always)]
    fn emitted(
        &self,
        walk: &mut Walk,
        light: &Light,
        within: Within,
        point: Vector,
        aim: &Aim,
    ) -> Option<Rgb> {
        let Some(attenuation) = &light.attenuation else { return Some(light.color) };
        if self.counts {
            walk.counters.evaluations.attenuation += 1;
        }
        let color = attenuated(light.color, attenuation, &light.kind, point, *aim)?;
        Some(match attenuation.fog {
            true => color * self.light_through_fog(walk, within, point, aim),
            false => color,
        })
    }

    /// What the clear surfaces between a point and a light let through.
    fn filtered(&self, walk: &mut Walk, within: Within, origin: Vector, aim: &Aim) -> Rgb {
        if self.counts {
            walk.counters.evaluations.colored_shadows += 1;
        }
        shadow::filtered(self, walk, within, origin, aim)
    }
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
pub(super) fn from_behind(
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
        let from = (origin, side);
        let arriving = arriving(tracer, walk, (number, light), place.within, from, &aim);
        let Some(color) = arriving else { continue };
        if tracer.counts {
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
fn arriving(
    tracer: &Tracer,
    walk: &mut Walk,
    (number, light): (usize, &Light),
    within: Within,
    (origin, side): (Vector, Side),
    aim: &Aim,
) -> Option<Rgb> {
    let is_part = walk.part > 0;
    let known = walk.arrived.get(number).filter(|_| is_part).and_then(|sides| sides[side as usize]);
    if let Some(known) = known {
        return known;
    }
    let found = searched(tracer, walk, (number, light), within, origin, aim);
    if let Some(sides) = walk.arrived.get_mut(number).filter(|_| is_part) {
        sides[side as usize] = Some(found);
    }
    found
}

fn searched(
    tracer: &Tracer,
    walk: &mut Walk,
    (number, light): (usize, &Light),
    within: Within,
    origin: Vector,
    aim: &Aim,
) -> Option<Rgb> {
    let mut color = tracer.emitted(walk, light, within, origin, aim)?;
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
