//! The colour of a pigment at a point.
//!
//! **In:** a [`Pigment`], a point in its texture's space. **Out:** a colour between those of its
//! map.

use crate::color::Color;
use crate::math::Vector;
use crate::shape::SurfacePoint;
use crate::world::{Object, Pigment, World};

/// The colour of the object's surface where it was hit.
#[inline(always)]
pub(super) fn on_surface(
    pigment: &Pigment,
    world: &World,
    object: &Object,
    surface: &SurfacePoint,
) -> Color {
    match pigment {
        Pigment::Color(color) => *color,
        Pigment::Patterned { .. } => at(pigment, texture_point(world, object, surface)),
    }
}

/// The colour at a point in the texture's space.
#[inline(never)]
pub(super) fn at(pigment: &Pigment, point: Vector) -> Color {
    match pigment {
        Pigment::Color(color) => *color,
        Pigment::Patterned { pattern, pattern_from_texture, map } => {
            look_up(map, pattern.value(pattern_from_texture.point(point)))
        }
    }
}

/// The hit in the texture's space; on a flat face the coordinates that are constant there are
/// taken as `lower` computed them, not from the rounded hit.
#[inline(always)]
fn texture_point(world: &World, object: &Object, surface: &SurfacePoint) -> Vector {
    let mut point = match object.texture_from_world {
        Some(map) => world.texture_maps[map as usize].point(surface.point),
        None => surface.point,
    };
    if let Some(first) = object.faces {
        let [x, y, z] = world.faces[(first + surface.face) as usize].0;
        point.x = x.unwrap_or(point.x);
        point.y = y.unwrap_or(point.y);
        point.z = z.unwrap_or(point.z);
    }
    point
}

/// The map's colour for `value`: linear between entries, the nearest entry's outside of them. Of
/// several entries with exactly `value` the first counts, but at the map's end the last.
///
/// **Source:** POV-Ray 3.7's behaviour, measured on planes of constant gradient.
fn look_up(map: &[(f64, Color)], value: f64) -> Color {
    match (map.first(), map.last()) {
        (_, Some(last)) if value >= last.0 => last.1,
        (Some(first), _) if value <= first.0 => first.1,
        _ => {
            let above = map.partition_point(|entry| entry.0 < value);
            match map.get(above.wrapping_sub(1)..=above) {
                Some([low, high]) => low.1.lerp(high.1, (value - low.0) / (high.0 - low.0)),
                // Only a map without entries, or a value that is no number, comes here.
                _ => Color::BLACK,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;

    fn gray(value: f64) -> Color {
        Color::opaque(Rgb::gray(value))
    }

    #[test]
    fn a_map_is_linear_between_entries_and_constant_outside() {
        let map = [(0.2, gray(1.0)), (0.6, gray(3.0))];
        let seen = [0.0, 0.2, 0.4, 0.6, 1.0].map(|v| look_up(&map, v).rgb.red);
        assert_eq!(seen, [1.0, 1.0, 2.0, 3.0, 3.0]);
    }

    #[test]
    fn two_entries_of_one_value_make_a_jump() {
        let map = [(0.0, gray(0.0)), (0.5, gray(1.0)), (0.5, gray(5.0)), (1.0, gray(6.0))];
        assert_eq!(look_up(&map, 0.5), gray(1.0));
        assert!(look_up(&map, 0.5000001).rgb.red >= 5.0);
        assert_eq!(look_up(&map[..3], 0.5), gray(5.0));
    }

    #[test]
    fn a_map_of_one_entry_is_that_colour_and_nothing_breaks_on_no_number() {
        assert_eq!(look_up(&[(0.3, gray(2.0))], 0.9), gray(2.0));
        assert_eq!(look_up(&[(0.3, gray(2.0)), (0.4, gray(3.0))], f64::NAN), Color::BLACK);
        assert_eq!(look_up(&[], 0.5), Color::BLACK);
    }
}
