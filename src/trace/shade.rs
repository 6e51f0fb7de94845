//! The light a surface sends to the viewer by itself and by the lights it sees: everything but
//! reflection.

use super::Walk;
use super::highlight::{self, Gloss};
use super::path::Tracer;
use super::power::power;
use super::shadow;
use crate::color::Rgb;
use crate::math::Vector;
use crate::world::{Finish, Light};

/// A place on a surface, ready to be lit.
pub(super) struct Place<'a> {
    pub finish: &'a Finish,
    /// The pigment's.
    pub color: Rgb,
    pub point: Vector,
    /// Where rays that leave the surface start: `point` moved along `normal` by its error.
    pub origin: Vector,
    /// Of length 1, toward the viewer's side.
    pub normal: Vector,
    /// Of length 1.
    pub to_viewer: Vector,
}

/// `C·glow + Σ I·(C·diffuse·(N·L)^brilliance + Σ lobes)` over the lights that are visible.
///
/// A light behind the surface or on the point itself contributes nothing. One in the surface's
/// very plane (N·L = 0) makes a highlight on a seed finish, as the seed's formula says, and none
/// on others, as in POV-Ray.
///
/// Whether the surface faces a light is asked of its point; rays are aimed from where they start,
/// or what they pass near the light would not be where the light is.
#[inline(always)]
pub(super) fn local<const SHADOWS: bool>(tracer: &Tracer, walk: &mut Walk, place: &Place) -> Rgb {
    let Place { finish, color, .. } = *place;
    let mut sum = color * finish.glow;
    if finish.diffuse == 0.0 && finish.lobes.is_empty() {
        return sum;
    }
    for (number, light) in tracer.world.lights.iter().enumerate() {
        let height = shadow::height(&light.kind, place.point, place.normal);
        if !(height > 0.0 || (finish.seed && height == 0.0)) {
            continue;
        }
        let Some(aim) = shadow::aim(&light.kind, place.origin) else { continue };
        let cosine = place.normal.dot(aim.to_light).max(0.0);
        if SHADOWS
            && light.casts_shadows
            && shadow::shadowed(tracer, walk, number, place.origin, &aim)
        {
            continue;
        }
        sum += light.color * answer(place, light, aim.to_light, cosine);
    }
    sum
}

/// What part of the light's intensity goes to the viewer. A shadowless light makes no highlight
/// on a classic finish. **Source:** POV-Ray manual, section "Shadowless Lights".
#[inline(always)]
fn answer(place: &Place, light: &Light, to_light: Vector, cosine: f64) -> Rgb {
    let Place { finish, color, normal, to_viewer, .. } = *place;
    let mut sum = Rgb::BLACK;
    if finish.diffuse != 0.0 {
        let slant =
            if finish.brilliance == 1.0 { cosine } else { power(cosine, finish.brilliance) };
        sum = color * (finish.diffuse * slant);
    }
    if !finish.lobes.is_empty() && (light.casts_shadows || finish.seed) {
        sum += highlight::lobes(finish, &Gloss { color, normal, to_viewer, to_light, cosine });
    }
    sum
}
