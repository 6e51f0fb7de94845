//! Lights that do not shine everywhere alike: spotlights, cylinders of light, and light that fades.
//!
//! **In:** a light and a place. **Out:** what of its colour comes there. **Invariant:** a light without
//! any of this is not asked.
//!
//! **Source:** POV-Ray 3.7 manual, sections "Spotlights", "Cylindrical Lights" and "Light Fading"; where
//! they leave something open, the program's behaviour, measured to 1/65,535.

use super::power::power;
use super::shadow::Aim;
use crate::color::Rgb;
use crate::math::Vector;
use crate::world::{Attenuation, Beam, Fade, LightKind};

/// What is left of `color` at `point`, from where the light is seen by `aim`; `None` where it is dark.
#[inline(never)]
pub(super) fn attenuated(
    color: Rgb,
    attenuation: &Attenuation,
    kind: &LightKind,
    point: Vector,
    aim: &Aim,
) -> Option<Rgb> {
    let beam = attenuation.beam.map_or(1.0, |beam| in_beam(beam, kind, point, aim));
    let fade = attenuation.fade.map_or(1.0, |fade| faded(fade, aim.reach.abs()));
    let left = color * (beam * fade);
    (!left.is_black()).then_some(left)
}

fn in_beam(beam: Beam, kind: &LightKind, point: Vector, aim: &Aim) -> f64 {
    match beam {
        Beam::Cone { axis, edge, core, tightness } => {
            beam_at(-axis.get().dot(aim.to_light), (edge, core), tightness)
        }
        Beam::Cylinder { radius, core, tightness } => {
            let LightKind::Parallel { position, .. } = *kind else { return 1.0 };
            if aim.reach <= 0.0 {
                return 0.0;
            }
            let off = (point - position) + aim.to_light * aim.reach;
            beam_at(1.0 - off.length() / radius, (0.0, core), tightness)
        }
    }
}

/// `v^tightness · s(edge, core; v)`, v being 1 on the axis and less beside it; 0 where v ≤ 0.
fn beam_at(v: f64, (edge, core): (f64, f64), tightness: f64) -> f64 {
    if v <= 0.0 {
        return 0.0;
    }
    let tight = if tightness > 0.0 { power(v, tightness) } else { 1.0 };
    tight * smooth(edge, core, v)
}

/// From 0 at `edge` to 1 at `core`, level at both ends; a step where they are the same.
fn smooth(edge: f64, core: f64, v: f64) -> f64 {
    if v >= core {
        return 1.0;
    }
    let t = ((v - edge) / (core - edge)).max(0.0);
    t * t * (3.0 - 2.0 * t)
}

fn faded(fade: Fade, distance: f64) -> f64 {
    2.0 / (1.0 + power(distance / fade.distance, fade.power))
}
