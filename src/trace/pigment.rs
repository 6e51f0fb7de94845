//! The colour of a pigment at a point.
//!
//! **In:** a [`Pigment`], a point in its texture's space. **Out:** a colour between those of its
//! map.

use crate::color::Color;
use crate::geometry::{self, Hit};
use crate::math::Vector;
use crate::pattern::Measured;
use crate::shape::{Ray, SurfacePoint};
use crate::world::{Pigment, World};

/// The colour of the object's surface where the ray hit it.
#[inline(always)]
pub(super) fn on_surface(
    pigment: &Pigment,
    world: &World,
    ray: &Ray,
    hit: &Hit,
    surface: &SurfacePoint,
) -> Color {
    match pigment {
        Pigment::Color(color) => *color,
        Pigment::Patterned { .. } => {
            let (point, error) = texture_point(world, ray, hit, surface);
            at(pigment, point, error)
        }
    }
}

/// The colour at a point in the texture's space, which may be off by `error` along each axis.
#[inline(never)]
pub(super) fn at(pigment: &Pigment, point: Vector, error: Vector) -> Color {
    match pigment {
        Pigment::Color(color) => *color,
        Pigment::Patterned { pattern, pattern_from_texture: map, map: colors } => {
            look_up(colors, pattern.value(map.point(point), map.point_error(point, error)))
        }
    }
}

/// The hit in the texture's space, and how far it may be off along each axis; on a flat face the
/// coordinates that are constant there are taken as `lower` computed them, not from the rounded hit.
#[inline(never)]
fn texture_point(world: &World, ray: &Ray, hit: &Hit, surface: &SurfacePoint) -> (Vector, Vector) {
    let object = &world.objects[hit.object as usize];
    let mut point = surface.point;
    let mut error = geometry::spread(world, ray, hit, surface);
    if let Some(map) = object.texture_from_world {
        let map = &world.texture_maps[map as usize];
        (point, error) = (map.point(point), map.point_error(point, error));
    }
    if let Some(first) = object.faces {
        let constants = world.faces[(first + surface.face) as usize].0;
        for (axis, constant) in constants.into_iter().enumerate() {
            if let Some(constant) = constant {
                (point[axis], error[axis]) = (constant, 0.0);
            }
        }
    }
    (point, error)
}

/// The map's colour for a value: linear between entries, the nearest entry's outside of them. A
/// value that its error does not tell from an entry's is that. Of several entries with exactly
/// the value the first counts, but at the map's end the last.
///
/// **Source:** POV-Ray 3.7's behaviour, measured on planes of constant gradient.
fn look_up(map: &[(f64, Color)], Measured { value, error }: Measured) -> Color {
    let near = map.partition_point(|entry| entry.0 < value - error);
    let value = match map.get(near) {
        Some(entry) if entry.0 <= value + error => entry.0,
        _ => value,
    };
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

    fn look_up(map: &[(f64, Color)], value: f64) -> Color {
        super::look_up(map, Measured { value, error: 0.0 })
    }

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
    fn a_value_that_may_be_at_a_jump_is_at_it() {
        let map = [(0.0, gray(0.0)), (0.5, gray(1.0)), (0.5, gray(5.0)), (1.0, gray(6.0))];
        for off in [-9e-13, 0.0, 9e-13] {
            let value = Measured { value: 0.5 + off, error: 1e-12 };
            assert_eq!(super::look_up(&map, value), gray(1.0), "{off}");
        }
        let beyond = Measured { value: 0.5 + 2e-12, error: 1e-12 };
        assert!(super::look_up(&map, beyond).rgb.red >= 5.0);
    }

    #[test]
    fn a_map_of_one_entry_is_that_colour_and_nothing_breaks_on_no_number() {
        assert_eq!(look_up(&[(0.3, gray(2.0))], 0.9), gray(2.0));
        assert_eq!(look_up(&[(0.3, gray(2.0)), (0.4, gray(3.0))], f64::NAN), Color::BLACK);
        assert_eq!(look_up(&[], 0.5), Color::BLACK);
    }
}
