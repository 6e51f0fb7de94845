//! What a surface sends to the viewer of one light if its finish has one of the rare properties: grain,
//! iridescence, or light from behind.

use super::highlight::{self, Gloss};
use super::shade::{self, Place};
use super::{bumpy, grain, irid, reflection};
use crate::color::Rgb;
use crate::math::Vector;
use crate::world::{Extras, Light};

/// One light, as it falls on a surface.
pub(super) struct Lit<'a> {
    pub light: &'a Light,
    /// Its place among the lights.
    pub number: usize,
    /// Of length 1.
    pub to_light: Vector,
    /// Negative for a light behind the surface.
    pub cosine: f64,
    /// The place of the finish in its texture.
    pub part: u32,
}

/// Returns the part of the light's intensity that goes to the viewer: `diffuse` is the finish's for the side
/// that the light is on, and `shines` is false where no highlight can be.
///
/// Grain takes from the diffuse light of each light a random part of the pigment's colour, up to `crand`,
/// however clear that is. What is left may be negative; it then darkens other light.
///
/// **Source:** POV-Ray 3.7's behaviour, measured: the film to 1/65,535; so is the grain, with the same random
/// numbers, which come from one stream there.
#[inline(never)]
pub(super) fn answer(place: &Place, extras: &Extras, diffuse: f64, shines: bool, lit: &Lit) -> Rgb {
    let Place { finish, color, body, normal, to_viewer, point, .. } = *place;
    let &Lit { light, number, to_light, cosine, part } = lit;
    let mut sum = Rgb::BLACK;
    if diffuse != 0.0 {
        let strength = diffuse * shade::slant(cosine, finish.brilliance);
        sum = body * strength;
        if extras.grain != 0.0 {
            sum += color * (-extras.grain * grain::random(point, number, part));
        }
    }
    if shines && shade::shines(finish, light) {
        sum += highlight::lobes(finish, &Gloss { color, normal, to_viewer, to_light, cosine });
    }
    if let Some(film) = &extras.irid {
        sum = sum * irid::factor(film, point, [cosine, normal.dot(to_viewer)].map(f64::abs));
    }
    sum
}

/// Returns the factor of what a surface mirrors, with the exponent of its reflection.
///
/// **Source:** POV-Ray 3.7's behaviour, measured: as if a light were where the mirrored ray goes. The film
/// changes what is seen there before the exponent of the reflection does.
#[inline(never)]
pub(super) fn mirrored(extras: &Extras, place: &Place, exponent: f64) -> Rgb {
    let Some(film) = &extras.irid else { return Rgb::WHITE };
    let Place { normal, to_viewer, point, .. } = *place;
    let toward = match place.smooth {
        Some(smooth) => bumpy::reflected(-to_viewer, normal, smooth),
        None => to_viewer,
    };
    let cosines = [toward, to_viewer].map(|direction| normal.dot(direction).abs());
    reflection::adapted(irid::factor(film, point, cosines), exponent)
}
