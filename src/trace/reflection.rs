//! How much of what the mirrored ray sees a surface passes on.

use super::metal;
use crate::color::Rgb;
use crate::math::Vector;
use crate::math::elementary::pow;
use crate::math::power::power;
use crate::math::wide::*;
use crate::world::Reflection;

/// The factor by which a surface of `color` reflects, seen at the angle of `cosine` to its normal:
/// `minimum + (maximum − minimum)·(1 − cosine)^falloff`, tinted by `metallic`; where the reflection
/// goes by Fresnel's equations, `fresnel` stands for the power.
///
/// **Source:** POV-Ray manual, section "Reflection"; measured to 1/65535.
#[inline(always)]
pub(super) fn reflectance(reflection: &Reflection, color: Rgb, cosine: f64, fresnel: f64) -> Rgb {
    match reflection.minimum == reflection.maximum && reflection.metallic == 0.0 {
        true => reflection.maximum,
        false => varying(reflection, color, cosine, fresnel),
    }
}

#[inline(never)]
fn varying(reflection: &Reflection, color: Rgb, cosine: f64, fresnel: f64) -> Rgb {
    // Negative where a perturbed normal faces away: then there is more than the maximum, as in POV-Ray 3.7
    // (measured).
    let cosine = cosine.min(1.0);
    let Reflection { minimum, maximum, falloff, metallic, .. } = *reflection;
    let plain = if minimum == maximum {
        maximum
    } else {
        let grazing = if reflection.fresnel { fresnel } else { power(1.0 - cosine, falloff) };
        maximum * grazing + minimum * (1.0 - grazing)
    };
    if metallic == 0.0 { plain } else { plain * metal::tint(color, metallic, cosine) }
}

/// The largest component that reflectances may have, before they are tinted: at any angle, or at
/// this one where the reflection goes by Fresnel's equations.
///
/// **Source:** POV-Ray 3.7's behaviour, measured: where `adc_bailout` cuts mirrored rays.
#[inline]
pub(super) fn most(reflection: &Reflection, fresnel: f64) -> f64 {
    let Reflection { minimum, maximum, .. } = *reflection;
    if reflection.fresnel {
        return (maximum * fresnel + minimum * (1.0 - fresnel)).largest();
    }
    minimum.largest().max(maximum.largest())
}

/// What arrives of `seen` before the factor: each component raised to 1 / `exponent`.
///
/// **Source:** POV-Ray 3.7's behaviour, measured with exponents 2 and ½.
#[inline(always)]
pub(super) fn adapted(seen: Rgb, exponent: f64) -> Rgb {
    if exponent == 1.0 {
        return seen;
    }
    seen.map(|c| if c > 0.0 { pow(c, 1.0 / exponent) } else { 0.0 })
}

/// The part of `seen` that is reflected. A component of weight zero is absent, not multiplied:
/// what is seen may be infinite.
#[inline(always)]
pub(super) fn passed_on(reflectance: Rgb, seen: Rgb) -> Rgb {
    let part = |weight: f64, light: f64| if weight == 0.0 { 0.0 } else { weight * light };
    Rgb::new(
        part(reflectance.red, seen.red),
        part(reflectance.green, seen.green),
        part(reflectance.blue, seen.blue),
    )
}

/// The mirrored direction.
#[inline(always)]
pub(super) fn mirrored(direction: Vector, normal: Vector) -> Vector {
    let mirrored = direction - normal * (2.0 * direction.dot(normal));
    // Without this the length's rounding errors would add up along a path.
    mirrored / mirrored.length()
}

/// [`mirrored`] for the bits of a mask.
#[inline(always)]
pub(super) fn mirrored_together<S: Simd>(
    simd: S,
    directions: &Rows,
    normals: &Rows,
    mask: u32,
    mirrored: &mut Rows,
) {
    for group in 0..GROUPS {
        if !has(mask, group) {
            continue;
        }
        let direction = WideVector::of(simd, directions, group);
        let normal = WideVector::of(simd, normals, group);
        let turned = direction - normal * (all(simd, 2.0) * direction.dot(normal));
        (turned / turned.length_squared().sqrt()).store(mirrored, group);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VARIABLE: Reflection = Reflection {
        fresnel: false,
        minimum: Rgb::gray(0.2),
        maximum: Rgb::new(0.9, 0.6, 0.5),
        falloff: 2.0,
        exponent: 1.0,
        metallic: 0.0,
    };

    #[test]
    fn reflection_goes_from_minimum_head_on_to_maximum_grazing() {
        assert_eq!(reflectance(&VARIABLE, Rgb::WHITE, 1.0, 0.0), VARIABLE.minimum);
        assert_eq!(reflectance(&VARIABLE, Rgb::WHITE, 0.0, 0.0), VARIABLE.maximum);
        let between = reflectance(&VARIABLE, Rgb::WHITE, 0.5, 0.0);
        assert!((between.red - (0.2 + 0.7 * 0.25)).abs() < 1e-15);
    }

    #[test]
    fn a_metallic_reflection_has_the_surfaces_colour_head_on() {
        let reflection = Reflection { metallic: 1.0, ..VARIABLE };
        assert_eq!(
            reflectance(&reflection, Rgb::new(1.0, 0.5, 0.0), 1.0, 0.0),
            Rgb::new(0.2, 0.1, 0.0)
        );
    }

    #[test]
    fn a_component_that_is_not_reflected_stays_black_however_bright_it_is() {
        let reflected = passed_on(Rgb::new(0.5, 0.0, 1.0), Rgb::gray(f64::INFINITY));
        assert_eq!(reflected, Rgb::new(f64::INFINITY, 0.0, f64::INFINITY));
    }

    #[test]
    fn the_exponent_is_a_root_as_in_pov_ray() {
        assert_eq!(adapted(Rgb::new(0.25, 0.0, -1.0), 2.0), Rgb::new(0.5, 0.0, 0.0));
        assert_eq!(adapted(Rgb::gray(0.3), 1.0), Rgb::gray(0.3));
    }

    #[test]
    fn a_mirrored_direction_keeps_its_length_over_many_turns() {
        let mut direction = Vector::new(0.5, -0.7, 0.1).normalize();
        for turn in 0..100_000 {
            let normal = Vector::new(1.0, f64::from(turn % 17), f64::from(turn % 23)).normalize();
            direction = mirrored(direction, normal);
        }
        assert!((direction.length() - 1.0).abs() < 1e-15);
    }
}
