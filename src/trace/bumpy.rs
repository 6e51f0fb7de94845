//! How rays leave a surface whose normal a texture perturbs.
//!
//! The smooth normal, without perturbation, is first turned toward the viewer, and then perturbed; the result
//! is never turned. So bumps are the same from both sides, and a perturbed normal may point away from the
//! viewer. Light is diffused by the cosine between the perturbed normal and the light, if it is positive,
//! even if the light is behind the smooth surface; only shadows of objects keep it away. Highlights are those
//! of the perturbed normal, and zero where it faces away from the light. The angle of a Fresnel reflection is
//! that at the perturbed normal; it is a right angle where that faces away from the viewer, so all is
//! reflected. A ray is refracted at the perturbed normal, turned toward the ray.
//!
//! Each layer of a texture perturbs the smooth normal anew; a texture map blends colours, not normals.
//! `slope` and `aoi` in a pigment see the perturbed normal, in a normal the smooth one.
//!
//! **Source:** measured on POV-Ray 3.7.

use super::reflection::mirrored;
use crate::math::Vector;

/// Returns the direction of the reflected ray. `direction` is that of the ray toward the surface, `smooth` is
/// the normal before perturbation, toward the viewer; all of length 1.
///
/// A ray is mirrored at the perturbed normal. If it would continue below the smooth surface, it is mirrored
/// at that once more; but if the perturbed normal points away from the viewer, the ray is mirrored at the
/// smooth surface only. The same holds for total internal reflection.
pub(super) fn reflected(direction: Vector, perturbed: Vector, smooth: Vector) -> Vector {
    let once = mirrored(direction, perturbed);
    if once.dot(smooth) >= 0.0 {
        once
    } else if direction.dot(perturbed) <= 0.0 {
        mirrored(once, smooth)
    } else {
        mirrored(direction, smooth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::UnitVector;
    use crate::math::random::{Random, tries};

    #[test]
    fn a_reflected_ray_leaves_the_surface() {
        let mut random = Random(4);
        for _ in 0..tries() {
            let (mut smooth, perturbed) = (random.direction().get(), random.direction().get());
            let direction = random.direction().get();
            if direction.dot(smooth) > 0.0 {
                smooth = -smooth;
            }
            let reflected = reflected(direction, perturbed, smooth);
            assert!(reflected.dot(smooth) >= -1e-15, "{direction} {perturbed} {smooth}");
            assert!((reflected.length() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_mirrored_ray_below_the_surface_is_mirrored_there() {
        // Measured on POV-Ray 3.7: a plane tilted by <15, 25, 0> with bumps of size 2, seen along z.
        let smooth =
            UnitVector::from_direction(Vector::new(-0.408_217_9, 0.258_819_05, -0.875_426_1));
        let smooth = smooth.map_or(Vector::Z, UnitVector::get);
        for (perturbed, measured) in [
            (
                Vector::new(-0.869_95, -0.082_78, -0.486_14),
                Vector::new(-0.957_81, -0.009_46, 0.287_14),
            ),
            (
                Vector::new(-0.584_69, 0.657_2, -0.475_64),
                Vector::new(-0.630_05, 0.672_01, 0.389_14),
            ),
        ] {
            let seen = reflected(Vector::Z, perturbed, smooth);
            assert!((seen - measured).abs().max_element() < 5e-5, "{seen} {measured}");
        }
    }
}
