//! Whether a point is known so well that its error can only matter near a pattern's seams.
//!
//! **In:** a World. **Out:** for each patterned surface the error, in the World, below which the
//! pattern's coordinates are off by less than a quarter of [`NEAR`].

use crate::geometry::Hit;
use crate::math::placement::Map;
use crate::math::{Matrix, Vector};
use crate::pattern::NEAR;
use crate::shape::{Ray, SurfacePoint};
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
            let map = object.texture_from_world.map(|map| &world.texture_maps[map as usize]);
            bound(&world.materials[object.material as usize].pigment, map)
        };
        // Room for 16u·|P|, as in `SurfacePoint::spread_at_most`.
        let is_sharp = |pigment: &Pigment| ROUNDED + 8.0 * f64::EPSILON < bound(pigment, None);
        Self {
            objects: world.objects.iter().map(object).collect(),
            sky: world.sky.iter().flat_map(|sky| &sky.pigments).map(is_sharp).collect(),
        }
    }

    #[inline(always)]
    pub fn on_surface(&self, ray: &Ray, hit: &Hit, surface: &SurfacePoint) -> bool {
        surface.spread_at_most(ray, hit.t, hit.error) < self.objects[hit.object as usize]
    }
}

/// The least error ρ of a point P, 8ε·|P| included, that may put a coordinate of its pattern off by
/// NEAR/8, ε = 2u: twice as sharp as need be, for the rounding of all this.
///
/// With M₁, c₁ the texture's map and M₂, c₂ the pattern's, m and m₂ the greatest sums of a row of
/// |M₂|·|M₁| and |M₂|, and P′ = M₁·(P − c₁): by [`Map::point_error`], twice, a coordinate is off by
/// m·(ρ + ε·|c₁| + 4ε·|P − c₁|) + m₂·ε·|c₂| + 4ε·|M₂|·|P′ − c₂|, which is at most
/// m·(ρ + 8ε·|P| + 9ε·|c₁|) + 5ε·m₂·|c₂|. Coordinates themselves are below 2⁴⁰ then.
fn bound(pigment: &Pigment, texture_from_world: Option<&Map>) -> f64 {
    let Pigment::Patterned { pattern_from_texture: second, .. } = pigment else { return 0.0 };
    let first = texture_from_world.unwrap_or(&Map::IDENTITY);
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
    use crate::pattern::Pattern;

    #[test]
    fn the_coordinates_of_a_sharp_point_are_off_by_less_than_a_quarter_of_what_is_near() {
        let mut random = Random(6);
        let mut sharp = 0;
        for _ in 0..tries() {
            let mut map = || Map {
                centre: random.point(1.0) * random.size(-6.0, 6.0),
                matrix: random.matrix() * random.size(-6.0, 6.0),
            };
            let (first, second) = (map(), map());
            let pigment = Pigment::Patterned {
                pattern: Pattern::Checker,
                pattern_from_texture: second,
                map: Vec::new(),
            };
            let point = random.point(1.0) * random.size(-6.0, 6.0);
            let error =
                bound(&pigment, Some(&first)) - 8.0 * f64::EPSILON * point.abs().max_element();
            if error > 0.0 {
                sharp += 1;
                let blurred = first.point_error(point, Vector::splat(error));
                let off = second.point_error(first.point(point), blurred).max_element();
                assert!(off < NEAR / 4.0, "{off:e} {first:?} {second:?} {point}");
            }
        }
        assert!(sharp > tries() / 2, "{sharp}");
        assert_eq!(bound(&Pigment::Color(crate::color::Color::BLACK), None), 0.0);
    }
}
