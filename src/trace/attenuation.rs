//! Lights that do not shine everywhere alike: spotlights, cylinders of light, and light that fades.
//!
//! **In:** a light and a place. **Out:** what of its colour comes there. **Invariant:** a light without
//! any of this is not asked.
//!
//! **Source:** POV-Ray 3.7 manual, sections "Spotlights", "Cylindrical Lights" and "Light Fading"; where
//! they leave something open, the program's behaviour, measured to 1/65,535.

use super::shadow::Aim;
use crate::color::Rgb;
use crate::math::Vector;
use crate::math::power::power;
use crate::world::{Attenuation, Beam, Fade, LightKind};

/// What is left of `color` at `point`, from where the light is seen by `aim`; `None` where it is dark.
#[inline(never)]
pub(super) fn attenuated(
    color: Rgb,
    attenuation: &Attenuation,
    kind: &LightKind,
    point: Vector,
    aim: Aim,
) -> Option<Rgb> {
    let beam = attenuation.beam.map_or(1.0, |beam| in_beam(beam, kind, point, &aim));
    let fade = attenuation.fade.map_or(1.0, |fade| faded(fade, aim.reach));
    let left = color * (beam * fade);
    (!left.is_black()).then_some(left)
}

fn in_beam(beam: Beam, kind: &LightKind, point: Vector, aim: &Aim) -> f64 {
    match beam {
        Beam::Cone { .. } if aim.reach <= 0.0 => 0.0,
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
    let smooth = smooth(edge, core, v);
    if v <= 0.0 || smooth == 0.0 {
        return 0.0;
    }
    // A negative one is brightest at the edge, without any bound.
    let tight = if tightness == 0.0 { 1.0 } else { power(v, tightness).min(f64::MAX) };
    tight * smooth
}

/// From 0 at `edge` to 1 at `core`, level at both ends; a step where they are the same.
fn smooth(edge: f64, core: f64, v: f64) -> f64 {
    if v >= core {
        return 1.0;
    }
    let t = ((v - edge) / (core - edge)).max(0.0);
    t * t * (3.0 - 2.0 * t)
}

/// `reach` is negative behind the plane of a parallel light.
fn faded(fade: Fade, reach: f64) -> f64 {
    let part = power(reach.abs() / fade.distance, fade.power);
    if reach >= 0.0 || !fade.signed {
        return 2.0 / (1.0 + part);
    }
    let is_odd = fade.power == fade.power.trunc();
    if is_odd { 2.0 / nonzero(1.0 - part) } else { 0.0 }
}

/// The least denominator of light that grows behind its plane.
const LEAST: f64 = 1e-30;

fn nonzero(x: f64) -> f64 {
    if x.abs() < LEAST { LEAST } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::UnitVector;
    use crate::math::elementary::cos;
    use crate::trace::shadow::aim;

    /// What a white light one unit above a floor leaves x units beside its foot, times N·L.
    fn lit(kind: LightKind, attenuation: Attenuation, x: f64) -> f64 {
        let point = Vector::X * x;
        let aim = aim(&kind, point).expect("not on the light");
        let color = attenuated(Rgb::WHITE, &attenuation, &kind, point, aim);
        color.map_or(0.0, |color| color.red) * aim.to_light.y
    }

    fn spot(radius: f64, falloff: f64, tightness: f64, x: f64) -> f64 {
        let cosine = |degrees: f64| cos(degrees.to_radians());
        let (edge, core) = (cosine(falloff), cosine(radius));
        let beam = Some(Beam::Cone { axis: -UnitVector::Y, edge, core, tightness });
        let kind = LightKind::Point { position: Vector::Y };
        lit(kind, Attenuation { beam, fade: None, fog: false }, x)
    }

    fn cylinder(radius: f64, tightness: f64, x: f64) -> f64 {
        let beam = Some(Beam::Cylinder { radius: 1.0, core: 1.0 - radius, tightness });
        let kind = LightKind::Parallel { position: Vector::Y, to_light: UnitVector::Y };
        lit(kind, Attenuation { beam, fade: None, fog: false }, x)
    }

    fn fading(distance: f64, power: f64, x: f64) -> f64 {
        let fade = Some(Fade { distance, power, signed: false });
        let kind = LightKind::Point { position: Vector::Y };
        lit(kind, Attenuation { beam: None, fade, fog: false }, x)
    }

    /// The numbers on the right are POV-Ray 3.7's, of a picture with 16 bits.
    #[test]
    fn lights_are_as_bright_beside_their_axis_and_far_off_as_those_of_the_other_program() {
        for (ours, theirs) in [
            (spot(30.0, 45.0, 0.0, 0.675), 0.7140),
            (spot(10.0, 30.0, 3.0, 0.475), 0.1554),
            (spot(20.0, 45.0, 0.0, 0.925), 0.0274),
            (spot(30.0, 100.0, 0.0, 0.875), 0.7277),
            (spot(30.0, 30.0, 0.0, 0.025), 0.9997),
            (spot(30.0, 30.0, 0.0, 0.625), 0.0),
            (cylinder(0.5, 0.0, 0.675), 0.7183),
            (cylinder(0.5, 3.0, 0.225), 0.4655),
            (cylinder(1.0, 2.0, 0.425), 0.3306),
            (cylinder(0.5, 0.0, 1.025), 0.0),
            (fading(1.0, 2.0, 0.975), 0.4853),
            (fading(2.0, 3.0, 1.725), 0.5038),
        ] {
            assert!((ours - theirs).abs() < 2e-4, "{ours} is not {theirs}");
        }
    }

    /// As POV-Ray 3.7 shows them, to 1/255.
    #[test]
    fn a_negative_tightness_makes_beams_darkest_in_their_middle() {
        let cosine = 1.0 / (1.0f64 + 0.4 * 0.4).sqrt();
        let times = spot(5.0, 35.0, -10.0, 0.4) / spot(5.0, 35.0, 0.0, 0.4);
        assert!((times * power(cosine, 10.0) - 1.0).abs() < 1e-12, "{times}");
        let times = cylinder(1.0, -3.0, 0.5) / cylinder(1.0, 0.0, 0.5);
        assert!((times - 8.0).abs() < 1e-12, "{times}");
        assert!(spot(5.0, 89.9, -1e9, 3.0).is_finite() && cylinder(1.0, -3.0, 1.0) == 0.0);
    }

    #[test]
    fn a_cylinder_of_light_is_dark_behind_its_plane_and_a_cone_behind_its_tip() {
        let beam = Some(Beam::Cylinder { radius: 1.0, core: 0.0, tightness: 0.0 });
        let kind = LightKind::Parallel { position: -Vector::Y, to_light: UnitVector::Y };
        assert_eq!(lit(kind, Attenuation { beam, fade: None, fog: false }, 0.0), 0.0);
        let beam = Some(Beam::Cone { axis: UnitVector::Y, edge: -1.0, core: -1.0, tightness: 0.0 });
        let kind = LightKind::Point { position: Vector::Y };
        assert_eq!(lit(kind, Attenuation { beam, fade: None, fog: false }, 0.0), 0.0);
    }

    /// The numbers on the right are POV-Ray 3.7's: 0 where light is taken away, too.
    #[test]
    fn light_fades_by_the_signed_distance_from_the_plane_of_a_parallel_light() {
        for (power, reach, theirs) in [
            (1.0, -18.0, -0.77),
            (1.0, -10.0, -2.0),
            (1.0, -3.6, 7.143),
            (1.0, -2.0, 3.333),
            (1.0, 7.6, 0.7937),
            (3.0, -3.6, 3.192),
            (3.0, -0.4, 2.001),
            (1.5, -2.0, 0.0),
            (0.5, -18.0, 0.0),
            (4.721, 4.4, 1.293),
        ] {
            let ours = faded(Fade { distance: 5.0, power, signed: true }, reach);
            assert!((ours - theirs).abs() < 2e-3 * (1.0 + ours.abs()), "{ours} is not {theirs}");
        }
        let pole = faded(Fade { distance: 5.0, power: 1.0, signed: true }, -5.0);
        assert!(pole > 1e9 && pole.is_finite(), "{pole}");
    }

    #[test]
    fn a_parallel_spotlight_is_dark_behind_its_plane_and_whole_before_it() {
        let axis = -UnitVector::Y;
        let beam = Some(Beam::Cone { axis, edge: 0.5, core: 0.9, tightness: 7.0 });
        let shines = |position: Vector| {
            let kind = LightKind::Parallel { position, to_light: UnitVector::Y };
            lit(kind, Attenuation { beam, fade: None, fog: false }, 3.0)
        };
        assert_eq!([shines(Vector::Y), shines(-Vector::Y)], [1.0, 0.0]);
    }

    #[test]
    fn light_at_its_fade_distance_has_its_colour_at_any_scale() {
        for size in [1e-200, 1.0, 1e200] {
            assert_eq!(faded(Fade { distance: size, power: 2.0, signed: false }, size), 1.0);
        }
    }
}
