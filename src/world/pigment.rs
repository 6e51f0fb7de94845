//! Evaluates the colour of a pigment at a point in its texture's space.
//!
//! **Out:** a colour between those of its map.

use super::Pigment;
use crate::color::Color;
use crate::math::Vector;
use crate::pattern::Measured;

/// Returns the colour at a point in the texture's space, which may be off by `error` along each axis. `error`
/// is called for a sharp point only near a seam of the pattern or of its map, and otherwise always (see
/// `trace::sharpness`).
#[inline(always)]
pub fn at(
    pigment: &Pigment,
    point: Vector,
    is_sharp: bool,
    error: impl FnOnce() -> Vector,
) -> Color {
    match pigment {
        Pigment::Color(color) => *color,
        // A point alone does not identify the face.
        Pigment::Faces(colors) => colors.first().copied().unwrap_or(Color::BLACK),
        Pigment::Patterned { pattern, pattern_from_texture: map, map: colors } => {
            let place = map.point(point);
            let off_seams = if is_sharp { pattern.value_off_seams(place) } else { None };
            if let Some(color) = off_seams.and_then(|measured| look_up(colors, measured)) {
                return color;
            }
            let Measured { value, error } = pattern.value(place, map.point_error(point, error()));
            let value = entry_at(colors, value, error).unwrap_or(value);
            look_up(colors, Measured { value, error: 0.0 }).unwrap_or(Color::BLACK)
        }
    }
}

/// Returns the value of the first map entry that is within the error of `value`.
fn entry_at(map: &[(f64, Color)], value: f64, error: f64) -> Option<f64> {
    let near = map.partition_point(|entry| entry.0 < value - error);
    map.get(near).map(|entry| entry.0).filter(|&entry| entry <= value + error)
}

/// Returns the map's colour for a value: linear between entries, constant beyond the first and the last. Of
/// several entries with exactly this value the first counts, but at the map's end the last. `None` if an
/// entry lies within the value's error, or the value is NaN.
///
/// **Source:** POV-Ray 3.7's behaviour, measured on planes of constant gradient.
#[inline(always)]
fn look_up(map: &[(f64, Color)], Measured { value, error }: Measured) -> Option<Color> {
    let (first, last) = (map.first()?, map.last()?);
    if value - error >= last.0 {
        return Some(last.1);
    }
    if value + error <= first.0 {
        return Some(first.1);
    }
    let above = map.partition_point(|entry| entry.0 < value);
    let [low, high] = map.get(above.wrapping_sub(1)..=above)? else { return None };
    let is_told = error == 0.0 || (value - error > low.0 && value + error < high.0);
    is_told.then(|| low.1.lerp(high.1, (value - low.0) / (high.0 - low.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;

    fn look_up(map: &[(f64, Color)], value: f64) -> Option<Color> {
        super::look_up(map, Measured { value, error: 0.0 })
    }

    fn gray(value: f64) -> Color {
        Color::opaque(Rgb::gray(value))
    }

    #[test]
    fn a_map_is_linear_between_entries_and_constant_outside() {
        let map = [(0.2, gray(1.0)), (0.6, gray(3.0))];
        let seen = [0.0, 0.2, 0.4, 0.6, 1.0].map(|v| look_up(&map, v).map(|c| c.rgb.red));
        assert_eq!(seen, [1.0, 1.0, 2.0, 3.0, 3.0].map(Some));
    }

    #[test]
    fn two_entries_of_one_value_make_a_jump() {
        let map = [(0.0, gray(0.0)), (0.5, gray(1.0)), (0.5, gray(5.0)), (1.0, gray(6.0))];
        assert_eq!(look_up(&map, 0.5), Some(gray(1.0)));
        assert!(look_up(&map, 0.5000001).is_some_and(|color| color.rgb.red >= 5.0));
        assert_eq!(look_up(&map[..3], 0.5), Some(gray(5.0)));
    }

    #[test]
    fn a_value_that_may_be_at_a_jump_is_at_it() {
        let map = [(0.0, gray(0.0)), (0.5, gray(1.0)), (0.5, gray(5.0)), (1.0, gray(6.0))];
        for off in [-9e-13, 0.0, 9e-13] {
            assert_eq!(entry_at(&map, 0.5 + off, 1e-12), Some(0.5), "{off}");
        }
        assert_eq!(entry_at(&map, 0.5 + 2e-12, 1e-12), None);
    }

    #[test]
    fn a_value_that_may_be_at_an_entry_has_no_colour_before_that_is_known() {
        let map = [(0.2, gray(0.0)), (0.5, gray(1.0)), (0.5, gray(5.0)), (0.8, gray(6.0))];
        for value in [0.0, 0.15, 0.19, 0.21, 0.3, 0.49, 0.51, 0.6, 0.79, 0.81, 0.9] {
            let told = super::look_up(&map, Measured { value, error: 0.02 });
            let is_near = map.iter().any(|entry| (entry.0 - value).abs() < 0.02);
            assert_eq!(told, look_up(&map, value).filter(|_| !is_near), "{value}");
        }
    }

    #[test]
    fn a_map_of_one_entry_is_that_colour_and_nothing_breaks_on_no_number() {
        assert_eq!(look_up(&[(0.3, gray(2.0))], 0.9), Some(gray(2.0)));
        assert_eq!(look_up(&[(0.3, gray(2.0)), (0.4, gray(3.0))], f64::NAN), None);
        assert_eq!(look_up(&[], 0.5), None);
    }
}
