//! Whether a point is known so well that its error can only matter near a pattern's seams.
//!
//! **In:** a World. **Out:** for each patterned surface the error, in the World, below which the
//! pattern's coordinates are off by less than a quarter of [`NEAR`].

use crate::geometry::Hit;
use crate::math::placement::Map;
use crate::math::{Matrix, Vector};
use crate::pattern::NEAR;
use crate::texture::space::Start;
use crate::texture::{Pattern, Source, Space, Step};
use crate::world::{Object, Pigment, World};

/// What rounding may add to the components of a direction of length 1.
pub(super) const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// The bounds below which points are sharp.
#[derive(Debug)]
pub(super) struct Sharpness {
    /// One for each object.
    objects: Vec<f64>,
    /// Whether directions are sharp, for each of the sky's pigments.
    pub sky: Vec<bool>,
}

impl Sharpness {
    pub fn of(world: &World) -> Self {
        let object = |object: &Object| {
            let mut least = f64::INFINITY;
            let lining = object.lining.map(|lining| world.linings[lining as usize]);
            let outer = (object.texture, object.places);
            let both = [Some(outer), lining.map(|lining| (lining.texture, lining.places))];
            for (texture, places) in both.into_iter().flatten() {
                let map = |slot| places.map(|first| world.texture_maps[(first + slot) as usize]);
                world.textures[texture as usize].for_each_space(&mut |space, pattern| {
                    least = least.min(bound(space, pattern, map));
                });
            }
            if least.is_finite() { least } else { 0.0 }
        };
        // Room for 16u·|P|, as in `SurfacePoint::spread_at_most`.
        let is_sharp = |pigment: &Pigment| {
            let mut least = f64::INFINITY;
            pigment.for_each_space(&mut |space, pattern| {
                least = least.min(bound(space, pattern, |_| None));
            });
            least.is_finite() && ROUNDED + 8.0 * f64::EPSILON < least
        };
        Self {
            objects: world.objects.iter().map(object).collect(),
            sky: world.sky.iter().flat_map(|sky| &sky.pigments).map(is_sharp).collect(),
        }
    }

    /// The error below which a point of the object that is hit is sharp; 0 if none is.
    #[inline(always)]
    pub fn sharp_below(&self, hit: &Hit) -> f64 {
        self.objects[hit.object as usize]
    }
}

/// The least error ρ of a point P, 8ε·|P| included, that may put a coordinate of its pattern off by
/// NEAR/8, ε = 2u: twice as sharp as need be, for the rounding of all this.
///
/// With M₁, c₁ the texture's map and M₂, c₂ the pattern's, m and m₂ the greatest sums of a row of
/// |M₂|·|M₁| and |M₂|, and P′ = M₁·(P − c₁): by [`Map::point_error`], twice, a coordinate is off by
/// m·(ρ + ε·|c₁| + 4ε·|P − c₁|) + m₂·ε·|c₂| + 4ε·|M₂|·|P′ − c₂|, which is at most
/// m·(ρ + 8ε·|P| + 9ε·|c₁|) + 5ε·m₂·|c₂|. Coordinates themselves are below 2⁴⁰ then.
///
/// A pattern without seams is always sharp. A node with other steps, or inside of another, is never: its error
/// is computed.
fn bound(
    space: &Space,
    pattern: Option<&Pattern>,
    texture_from_world: impl Fn(u32) -> Option<Map>,
) -> f64 {
    let has_seams = match pattern.map(|pattern| &pattern.source) {
        Some(Source::Kind(kind)) => kind.has_seams(),
        Some(Source::Image(_)) => true,
        _ => false,
    };
    if !has_seams {
        return f64::INFINITY;
    }
    let first = match space.start {
        Start::Slot(slot) => texture_from_world(slot).unwrap_or(Map::IDENTITY),
        Start::Outer => Map::IDENTITY,
        Start::Uv | Start::UvTurned(_) => return 0.0,
    };
    let second = match space.steps[..] {
        [] => Map::IDENTITY,
        [Step::Map(map)] => map,
        _ => return 0.0,
    };
    let m2 = second.matrix.abs();
    let stretch = greatest_row(m2 * first.matrix.abs());
    let centres = 9.0 * stretch * first.centre.abs().max_element()
        + 5.0 * greatest_row(m2) * second.centre.abs().max_element();
    (NEAR / 8.0 - f64::EPSILON * centres) / stretch
}

fn greatest_row(matrix: Matrix) -> f64 {
    (matrix * Vector::ONE).max_element()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};
    use crate::pattern::{Checker, Kind, Setting, Wave};

    #[test]
    fn the_coordinates_of_a_sharp_point_are_off_by_less_than_a_quarter_of_what_is_near() {
        let mut random = Random(6);
        let mut sharp = 0;
        for _ in 0..tries() {
            let mut map = || {
                let centre = random.point(1.0) * random.size(-6.0, 6.0);
                Map::new(centre, random.matrix() * random.size(-6.0, 6.0))
            };
            let (first, second) = (map(), map());
            let space = Space { start: Start::Slot(0), steps: vec![Step::Map(second)] };
            let pattern = Pattern {
                source: Source::Kind(Kind::Checker(Checker {})),
                setting: Setting::default(),
                wave: Wave::default(),
            };
            let point = random.point(1.0) * random.size(-6.0, 6.0);
            let error = bound(&space, Some(&pattern), |_| Some(first))
                - 8.0 * f64::EPSILON * point.abs().max_element();
            if error > 0.0 {
                sharp += 1;
                let blurred = first.point_error(point, Vector::splat(error));
                let off = second.point_error(first.point(point), blurred).max_element();
                assert!(off < NEAR / 4.0, "{off:e} {first:?} {second:?} {point}");
            }
        }
        assert!(sharp > tries() / 2, "{sharp}");
    }
}
