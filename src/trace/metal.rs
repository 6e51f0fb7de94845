//! How a metal tints what it reflects: by its own colour head-on, not at all at a grazing angle.

use crate::color::Rgb;
use crate::math::elementary::acos;

/// The tint of light of incidence `cosine` by a surface of `color`; `metallic` 0 tints nothing.
pub(super) fn tint(color: Rgb, metallic: f64, cosine: f64) -> Rgb {
    if metallic == 0.0 {
        return Rgb::WHITE;
    }
    let strength = metallic * (1.0 - fresnel(cosine));
    color.map(|c| 1.0 + strength * (c - 1.0))
}

/// Strauss's approximation of the Fresnel reflectance: 0 head-on, 1 at a grazing angle.
///
/// **Source:** P. Strauss, "A realistic lighting model for computer animators", IEEE Computer
/// Graphics and Applications 10(6), 1990, with its constant 1.12. POV-Ray 3.7's `metallic` agrees
/// within 1/10,000, for highlights at the angle of the light and for reflections at that of view; so it
/// does where the light is behind the surface (`cosine` < 0, measured to 1/1,000).
fn fresnel(cosine: f64) -> f64 {
    const K: f64 = 1.12;
    const AT_ZERO: f64 = 1.0 / (K * K);
    const AT_ONE: f64 = 1.0 / ((1.0 - K) * (1.0 - K));
    let x = acos(cosine.clamp(-1.0, 1.0)) * std::f64::consts::FRAC_2_PI;
    ((1.0 / ((x - K) * (x - K)) - AT_ZERO) / (AT_ONE - AT_ZERO)).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_metal_tints_fully_head_on_and_not_at_all_grazing() {
        let gold = Rgb::new(1.0, 0.5, 0.25);
        assert_eq!(tint(gold, 1.0, 1.0), gold);
        assert!((tint(gold, 1.0, 0.0).blue - 1.0).abs() < 1e-12);
        assert_eq!(tint(gold, 0.0, 1.0), Rgb::WHITE);
        assert_eq!(tint(gold, 0.5, 1.0), Rgb::new(1.0, 0.75, 0.625));
    }

    #[test]
    fn the_tint_between_is_the_one_pov_ray_shows() {
        // Cosines on an orthographic sphere and the green and blue POV-Ray's highlight had there.
        let gold = Rgb::new(1.0, 0.5, 0.25);
        for (cosine, green, blue) in
            [(0.3186088309337746, 0.5626, 0.3439), (0.6615891888682057, 0.5158, 0.2737)]
        {
            let tint = tint(gold, 1.0, cosine);
            assert!((tint.green - green).abs() < 1e-4 && (tint.blue - blue).abs() < 1e-4);
        }
    }
}
