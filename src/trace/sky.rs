//! What a ray sees that leaves the scene.

use super::sharpness::{ROUNDED, Sharpness};
use super::way::Way;
use crate::color::{Clearness, Color, Rgb};
use crate::math::Vector;
use crate::texture::space::Nowhere;
use crate::world::{Backdrop, World};

/// The sky's pigments painted one over the other, the last on top and `background` below all: each
/// shows its colour where it is opaque, times the sky's `emission`, and what lies below untinted through its
/// `transmit` and tinted through its `filter`.
///
/// In old scenes the pigments do not tint each other but all of them the background, and what is tinted once
/// is not let through untinted further down.
///
/// **Source:** POV-Ray 3.7's behaviour, measured for each kind of colour, alone and layered.
#[inline(always)]
pub(super) fn seen(world: &World, sharpness: &Sharpness, direction: Vector) -> Rgb {
    match world.sky {
        Some(_) => over(world, sharpness, direction, world.background),
        None => world.background,
    }
}

/// What a ray sees of the sky in a picture with alpha, and how much of what lies behind the background.
///
/// The ray that mirrors sent sees no alpha.
///
/// **Source:** POV-Ray 3.7's behaviour with `Output_Alpha`, measured for each kind of colour, alone and layered.
#[cold]
pub(super) fn seen_with_alpha(world: &World, sharpness: &Sharpness, way: &Way) -> (Rgb, f64) {
    let Backdrop { color, only_mirrored } = world.backdrop;
    let direction = way.ray.direction;
    match (way.mirrored, only_mirrored) {
        (true, _) => (over(world, sharpness, direction, color.rgb), 0.0),
        (false, true) => (Rgb::BLACK, 1.0),
        (false, false) => {
            let shown = color.rgb * (1.0 - color.filter - color.transmit);
            let pigments = pigments(world, sharpness, direction);
            let clear =
                pigments.fold(color.transmittance(), |clear, top| clear * top.transmittance());
            (over(world, sharpness, direction, shown), clear.brightness())
        }
    }
}

/// The colours of the sky's pigments in a direction.
fn pigments<'a>(
    world: &'a World,
    sharpness: &'a Sharpness,
    direction: Vector,
) -> impl DoubleEndedIterator<Item = Color> + 'a {
    let pigments = world.sky.as_ref().map_or(&[][..], |sky| &sky.pigments);
    pigments.iter().zip(&sharpness.sky).map(move |(pigment, &is_sharp)| {
        let error = Vector::splat(ROUNDED);
        pigment.color(None, &Nowhere { point: direction, error, is_sharp })
    })
}

/// The sky over a background.
#[inline(never)]
fn over(world: &World, sharpness: &Sharpness, direction: Vector, background: Rgb) -> Rgb {
    let emission = world.sky.as_ref().map_or(Rgb::WHITE, |sky| sky.emission);
    let pigments = pigments(world, sharpness, direction);
    if world.settings.clearness == Clearness::Old {
        let all = Color { rgb: Rgb::WHITE, filter: 1.0, transmit: 1.0 };
        let (mut sum, mut above) = (Rgb::BLACK, None::<Color>);
        for top in pigments.rev() {
            let weight = above.map_or(1.0, |above| above.filter + above.transmit);
            sum += top.rgb * emission * ((1.0 - top.filter - top.transmit) * weight);
            let Color { rgb, filter, transmit } = above.unwrap_or(all);
            above = Some(Color {
                rgb: rgb * top.rgb,
                filter: filter * top.filter,
                transmit: transmit * top.transmit,
            });
        }
        let seen = above.map_or(Rgb::WHITE, Color::transmittance);
        return sum + background * seen;
    }
    pigments.fold(background, |below, top| {
        if top.filter == 0.0 && top.transmit == 0.0 {
            return top.rgb * emission;
        }
        let opacity = 1.0 - top.filter - top.transmit;
        top.rgb * emission * opacity + below * top.rgb * top.filter + below * top.transmit
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::{Pigment, Sky};

    #[test]
    fn pigments_cover_what_lies_below_by_filter_and_transmit() {
        let background = Rgb::new(1.0, 0.5, 0.25);
        let rgb = Rgb::new(0.2, 0.4, 0.6);
        let glow = |emission: Rgb, colors: &[Color]| {
            let pigments = colors.iter().copied().map(Pigment::Color).collect();
            let world =
                World { background, sky: Some(Sky { pigments, emission }), ..World::default() };
            seen(&world, &Sharpness::of(&world), Vector::Z)
        };
        let see = |colors: &[Color]| glow(Rgb::WHITE, colors);
        let close =
            |a: Rgb, b: [f64; 3]| a.components().iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert_eq!(see(&[]), background);
        assert_eq!(see(&[Color::WHITE, Color::opaque(rgb)]), rgb);
        // The numbers POV-Ray shows.
        let transmitting = Color { rgb, filter: 0.0, transmit: 0.5 };
        assert!(close(see(&[transmitting]), [0.6, 0.45, 0.425]));
        assert!(close(see(&[transmitting; 2]), [0.4, 0.425, 0.5125]));
        let filtering = Color { rgb, filter: 0.5, transmit: 0.0 };
        assert!(close(see(&[filtering]), [0.2, 0.3, 0.375]));
        let both = Color { rgb, filter: 0.3, transmit: 0.5 };
        assert!(close(see(&[both]), [0.6, 0.39, 0.29]));
        // `emission` multiplies what a pigment shows, and not what is seen through it.
        let emission = Rgb::new(0.5, 1.0, 1.5);
        assert!(close(glow(emission, &[Color::opaque(rgb)]), [0.1, 0.4, 0.9]));
        assert!(close(glow(Rgb::WHITE * 0.5, &[transmitting]), [0.55, 0.35, 0.275]));
        let top = Color { rgb: Rgb::new(0.3, 0.6, 0.1), filter: 0.3, transmit: 0.5 };
        assert!(close(glow(emission, &[Color::opaque(rgb), top]), [0.089, 0.392, 0.507]));
    }
}
