//! `irid`: the colours of a thin film on a surface, which depend on the angles of view and of light.

use crate::color::Rgb;
use crate::math::Vector;
use crate::math::elementary::cos;
use crate::noise::Turbulence;
use crate::texture::Irid;

/// Returns the film's thickness at a point of the world: `thickness · (1 + turbulence · (2·T − 1))`, T
/// turbulence of 5 octaves. Neither the object's nor the texture's transforms take part.
///
/// **Source:** POV-Ray 3.7's behaviour, measured to 1/10,000 at 300 points.
fn thickness_at(irid: &Irid, point: Vector) -> f64 {
    if irid.turbulence == 0.0 {
        return irid.thickness;
    }
    let number = Turbulence::new(2.0, 0.5, 5.0).number(irid.generator, point);
    irid.thickness * (1.0 + irid.turbulence * (2.0 * number - 1.0))
}

/// Returns the factor by which a film changes what its surface sends back of one light, diffuse light and
/// highlights alike: `1 + amount · cos(2π · thickness · (cos_light + cos_view)/wavelength)`. The cosines are
/// those between the perturbed normal and the directions to the light and to the viewer. It may be negative.
///
/// **Source:** POV-Ray 3.7's behaviour, measured to 1/65,535 over angles, thicknesses and wavelengths.
pub(super) fn factor(irid: &Irid, point: Vector, [light, view]: [f64; 2]) -> Rgb {
    let Irid { amount, wavelengths, .. } = *irid;
    let way = thickness_at(irid, point) * (light + view);
    let part = |wavelength: f64| {
        let phase = std::f64::consts::TAU * (way / wavelength);
        if phase.is_finite() { 1.0 + amount * cos(phase) } else { 1.0 }
    };
    wavelengths.map(part)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::NoiseGenerator;

    const WAVELENGTHS: Rgb = Rgb::new(0.70, 0.52, 0.48);

    /// The point's x (y = 0.7, z = 0.3) and the relative change of thickness per turbulence, by generator.
    const MEASURED: &str = include_str!("measured/irid.txt");

    fn film(amount: f64, thickness: f64) -> Irid {
        let generator = NoiseGenerator::default();
        Irid { amount, thickness, turbulence: 0.0, wavelengths: WAVELENGTHS, generator }
    }

    #[test]
    fn a_films_colours_are_the_ones_pov_ray_shows() {
        // White light on a surface of which it shows half, seen head-on with an amount of ¼.
        let seen = |thickness, light, [r, g, b]: [f64; 3]| {
            let made = factor(&film(0.25, thickness), Vector::ZERO, [light, 1.0]) * (0.25 * light);
            assert!((made + Rgb::new(-r, -g, -b)).largest() < 1e-5, "{made}");
        };
        seen(0.0, 1.0, [0.31250, 0.31250, 0.31250]);
        seen(0.5, 1.0, [0.19368276, 0.30534829, 0.30412757]);
        seen(1.0, 1.0, [0.28897536, 0.28551156, 0.28125429]);
        seen(0.5, 0.5, [0.15315480, 0.09578088, 0.09613184]);
        seen(1.0, 0.5, [0.14448768, 0.14839399, 0.14709697]);
    }

    #[test]
    fn turbulence_changes_the_thickness_as_in_pov_ray() {
        let mut compared = 0;
        for line in MEASURED.lines().filter(|line| !line.starts_with('#')) {
            let numbers: Vec<f64> = line.split(' ').filter_map(|n| n.parse().ok()).collect();
            let point = Vector::new(numbers[0], 0.7, 0.3);
            let generators =
                [NoiseGenerator::RangeCorrected, NoiseGenerator::Plateaus, NoiseGenerator::Perlin];
            for (generator, seen) in generators.into_iter().zip(&numbers[1..]) {
                let film = Irid { turbulence: 0.5, generator, ..film(0.9, 2.0) };
                let thickness = thickness_at(&film, point);
                let made = (thickness / 2.0 - 1.0) / 0.5;
                assert!((made - seen).abs() < 2e-3, "{generator:?} {point}: {made}, not {seen}");
                compared += 1;
            }
        }
        assert!(compared > 100);
    }

    #[test]
    fn no_numbers_break_it() {
        for wavelength in [0.0, -1.0, 1e-300, 1e300] {
            for thickness in [0.0, -1.0, 1e300, f64::NAN] {
                let wavelengths = Rgb::gray(wavelength);
                let film = Irid { wavelengths, ..film(0.5, thickness) };
                let made = factor(&film, Vector::ZERO, [1.0, 0.5]);
                assert!(made.is_finite(), "{wavelength} {thickness}");
            }
        }
    }
}
