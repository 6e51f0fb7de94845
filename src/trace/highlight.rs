//! The gloss a light makes on a surface.

use super::metal;
use crate::color::Rgb;
use crate::math::Vector;
use crate::math::power::power;
use crate::world::{Finish, LobeKind};

/// What a surface and the directions it is seen and lit from have to do with a highlight; all
/// directions are unit vectors that point away from the surface.
pub(super) struct Gloss {
    pub color: Rgb,
    pub normal: Vector,
    pub to_viewer: Vector,
    pub to_light: Vector,
    /// `normal · to_light`; negative for a light behind a surface that is lit on both sides.
    pub cosine: f64,
}

/// The part of a light's intensity that the finish's lobes send to the viewer.
///
/// A seed finish has its own colour in full; others tint by `metallic`.
#[inline(never)]
pub(super) fn lobes(finish: &Finish, gloss: &Gloss) -> Rgb {
    let mut sum = Rgb::BLACK;
    for lobe in &finish.lobes {
        let cosine = match lobe.kind {
            LobeKind::Phong => {
                // R·L with R = 2(N·V)N − V.
                let along = gloss.normal.dot(gloss.to_viewer);
                2.0 * along * gloss.cosine - gloss.to_viewer.dot(gloss.to_light)
            }
            LobeKind::Blinn => {
                let bisector = gloss.to_light + gloss.to_viewer;
                gloss.normal.dot(bisector) / bisector.length()
            }
        };
        // Also false where light and viewer are opposite and have no bisector.
        if cosine > 0.0 {
            let strength = lobe.weight * power(cosine, lobe.exponent);
            let tint = if finish.seed {
                gloss.color
            } else {
                metal::tint(gloss.color, lobe.metallic, gloss.cosine)
            };
            sum += tint * strength;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::Lobe;

    fn finish(kind: LobeKind, exponent: f64) -> Finish {
        Finish {
            conserve_energy: false,
            emission: Rgb::BLACK,
            diffuse: 0.0,
            brilliance: 1.0,
            lobes: vec![Lobe { kind, weight: 0.5, exponent, metallic: 0.0 }],
            reflection: None,
            seed: false,
            extras: None,
        }
    }

    fn gloss(to_viewer: Vector, to_light: Vector) -> Gloss {
        let normal = Vector::Y;
        Gloss { color: Rgb::WHITE, normal, to_viewer, to_light, cosine: normal.dot(to_light) }
    }

    #[test]
    fn both_lobes_are_full_in_the_mirrored_direction() {
        let seen = gloss(Vector::new(0.6, 0.8, 0.0), Vector::new(-0.6, 0.8, 0.0));
        for kind in [LobeKind::Phong, LobeKind::Blinn] {
            let light = lobes(&finish(kind, 40.0), &seen).red;
            assert!((light - 0.5).abs() < 1e-13, "{kind:?}: {light}");
        }
    }

    #[test]
    fn phong_falls_off_by_the_mirrored_ray_and_blinn_by_the_bisector() {
        // Viewer straight above, light 60° off: the mirrored ray is 60° away, the bisector 30°.
        let seen = gloss(Vector::Y, Vector::new(0.75f64.sqrt(), 0.5, 0.0));
        assert!((lobes(&finish(LobeKind::Phong, 2.0), &seen).red - 0.5 * 0.25).abs() < 1e-15);
        assert!((lobes(&finish(LobeKind::Blinn, 2.0), &seen).red - 0.5 * 0.75).abs() < 1e-15);
    }

    #[test]
    fn a_light_opposite_the_viewer_makes_no_highlight_and_no_nan() {
        let seen = gloss(Vector::X, -Vector::X);
        assert_eq!(lobes(&finish(LobeKind::Blinn, 1.0), &seen), Rgb::BLACK);
    }
}
