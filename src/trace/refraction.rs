//! What becomes of a ray at the border of two media: how it is bent, and how much is reflected.
//!
//! **In:** unit vectors and the indices of refraction on both sides. **Out:** the direction behind
//! the border, the two cosines, Fresnel's reflectance. **Invariant:** equal indices change no bit of
//! a direction; light goes through exactly when `from · sin < to`.

use crate::math::double::{Double, DoubleVector};
use crate::math::{Vector, reciprocal_power_of_two};

/// A ray that goes through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bent {
    /// Of length 1.
    pub direction: Vector,
    /// The sizes of the cosines to the normal before the border and behind it.
    pub cosines: [f64; 2],
}

/// Nearer than this to the critical angle (as `1 − from · sin / to`), rounding could decide.
const CRITICAL: f64 = 1e-6;

/// Snell's law: `direction` meets a border whose `normal` points to where it comes from, out of a
/// medium of index `from` into one of `to`. `None`: all of it is reflected.
///
/// With c the cosine, p = d + c·n the part along the border and s = |d × n| its length, the ray goes
/// on along (from/to)·p − √k·n, where k = (1 − s·from/to)·(1 + s·from/to): no squares of nearly
/// equal size are subtracted, and near the critical angle k is computed in double-double
/// arithmetic.
///
/// **Source:** A. Glassner (ed.), "An Introduction to Ray Tracing" (1989), ch. 4, section 3.
pub(super) fn bent(direction: Vector, normal: Vector, from: f64, to: f64) -> Option<Bent> {
    let cosine = (-direction.dot(normal)).max(0.0);
    if from == to {
        return Some(Bent { direction, cosines: [cosine; 2] });
    }
    let behind = cosine_squared_behind(direction, normal, from, to);
    if behind.is_nan() || behind <= 0.0 {
        return None;
    }
    let behind = behind.min(1.0).sqrt();
    let along = direction + normal * cosine;
    let bent = along * (from / to) - normal * behind;
    Some(Bent { direction: bent / bent.length(), cosines: [cosine, behind] })
}

/// The square of the cosine behind the border; not positive where nothing goes through. The two
/// vectors' lengths need not be 1.
fn cosine_squared_behind(direction: Vector, normal: Vector, from: f64, to: f64) -> f64 {
    let lengths = direction.length() * normal.length();
    let sine = direction.cross(normal).length() / lengths * (from / to);
    let below = 1.0 - sine;
    if below.abs() >= CRITICAL {
        return below * (1.0 + sine);
    }
    // Times a power of two: no square overflows.
    let scale = reciprocal_power_of_two(to);
    let [from, to] = [from, to].map(|index| Double::from(index * scale));
    let (d, n) = (DoubleVector::from(direction), DoubleVector::from(normal));
    let cross = d.cross(n);
    let whole = to * to * d.dot(d) * n.dot(n);
    ((whole - from * from * cross.dot(cross)) / whole).round()
}

/// The part of unpolarised light that is reflected where a ray goes through, by the sizes of its
/// cosines before the border and behind it; 0 between equal media, 1 at a grazing angle.
///
/// **Source:** A. Fresnel (1823), as in E. Hecht, "Optics", section 4.6. POV-Ray 3.7's `fresnel`
/// agrees within 1/65,535, from outside and from inside.
pub(super) fn fresnel(from: f64, to: f64, [before, behind]: [f64; 2]) -> f64 {
    if from == to {
        return 0.0;
    }
    if before == 0.0 {
        return 1.0;
    }
    let ratio = from / to;
    let across = (ratio * before - behind) / (ratio * before + behind);
    let along = (ratio * behind - before) / (ratio * behind + before);
    0.5 * (across * across + along * along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::UnitVector;
    use crate::math::elementary::pow;
    use crate::math::random::{Random, tries};

    /// A ray that falls on the plane y = 0, at `sine` to its normal.
    fn falling(sine: f64) -> Vector {
        Vector::new(sine, -(1.0 - sine * sine).sqrt(), 0.0)
    }

    /// Directions and normals that meet at all angles, most of them grazing.
    fn meetings() -> impl Iterator<Item = (Vector, Vector)> {
        let mut random = Random(40);
        (0..tries()).map(move |_| {
            let n = random.direction().get();
            let v = match random.below(3) {
                0 => random.direction().get(),
                1 => random.structured_direction().get(),
                _ => n.cross(random.direction().get()) - n * random.size(-18.0, 0.0),
            };
            let d = UnitVector::from_direction(v).unwrap_or(UnitVector::X).get();
            (if d.dot(n) < 0.0 { d } else { -d }, n)
        })
    }

    #[test]
    fn equal_indices_change_no_bit_of_a_direction() {
        for (d, n) in meetings() {
            for index in [1.0, 1.33, 1e-300, 1e300] {
                let bent = bent(d, n, index, index).expect("goes through");
                assert_eq!(
                    bent.direction.to_array().map(f64::to_bits),
                    d.to_array().map(f64::to_bits)
                );
                assert_eq!(fresnel(index, index, bent.cosines), 0.0);
            }
        }
    }

    #[test]
    fn sines_behave_as_snell_says_and_the_bent_ray_stays_in_the_plane() {
        for (d, n) in meetings() {
            for (from, to) in [(1.0, 1.5), (1.5, 1.0), (1.33, 2.4), (1.0, 1.000_001)] {
                let Some(bent) = bent(d, n, from, to) else {
                    assert!(from * d.cross(n).length() >= to * (1.0 - 1e-15));
                    continue;
                };
                let (before, behind) = (d.cross(n) * from, bent.direction.cross(n) * to);
                assert!((before - behind).length() < 1e-15 * from.max(to));
                assert!((bent.direction.length() - 1.0).abs() < 4e-16);
                assert!(bent.direction.dot(n) < 0.0);
            }
        }
    }

    #[test]
    fn light_goes_through_exactly_when_the_ratio_times_the_sine_is_below_1() {
        // Sine 3/5, cosine 4/5: an exact right triangle.
        let triangles =
            [(3.0, 4.0, 5.0), (5.0, 12.0, 13.0), (8.0, 15.0, 17.0), (119.0, 120.0, 169.0)];
        for (side, height, longest) in triangles {
            let d = Vector::new(side, -height, 0.0);
            for scale in [1.0, 0.25, f64::from_bits(423 << 52), f64::from_bits(1623 << 52)] {
                // Critical is from/to = longest/side, here exactly so.
                let (from, to): (f64, f64) = (longest * scale, side * scale);
                assert!(cosine_squared_behind(d, Vector::Y, from, to) <= 0.0);
                assert!(cosine_squared_behind(d, Vector::Y, from.next_up(), to) < 0.0);
                assert!(cosine_squared_behind(d, Vector::Y, from.next_down(), to) > 0.0);
                assert!(cosine_squared_behind(d, Vector::Y, from, to.next_up()) > 0.0);
                assert!(cosine_squared_behind(d, Vector::Y, from, to.next_down()) < 0.0);
            }
        }
    }

    #[test]
    fn near_the_critical_angle_the_cosine_is_right_to_the_last_digits() {
        // from = 1 + δ, sine = 1/(1 + 2δ) …: k = 1 − (from·sine)², exactly by double-double numbers.
        for exponent in 1..15 {
            let delta = pow(10.0, -f64::from(exponent));
            let d = falling(1.0 - delta);
            let length = DoubleVector::from(d).dot(DoubleVector::from(d));
            let sine = Double::from(d.x) * Double::from(d.x) / length;
            let exact = (Double::ONE - Double::from(1.000_001 * 1.000_001) * sine).round();
            let from = (1.000_001f64 * 1.000_001).sqrt();
            let exact_from = Double::from(from) * Double::from(from) * sine;
            let exact = if from == 1.000_001 { (Double::ONE - exact_from).round() } else { exact };
            let found = cosine_squared_behind(d, Vector::Y, from, 1.0);
            assert!(
                (found - exact).abs() <= 4e-10 * exact.abs() + 1e-30,
                "{delta}: {found} {exact}"
            );
        }
    }

    #[test]
    fn what_is_reflected_and_what_goes_through_come_to_all() {
        for (d, n) in meetings() {
            for (from, to) in [(1.0, 1.5), (1.5, 1.0), (2.4, 1.33), (1.0, 1.0 + 1e-12), (1.0, 50.0)]
            {
                let Some(Bent { cosines: [a, b], .. }) = bent(d, n, from, to) else { continue };
                let reflected = fresnel(from, to, [a, b]);
                let all = 4.0 * from * a * to * b;
                let (across, along) = (from * a + to * b, from * b + to * a);
                let through = 0.5 * (all / (across * across) + all / (along * along));
                assert!((reflected + through - 1.0).abs() <= 4.0 * f64::EPSILON, "{from} {to} {a}");
                assert!((0.0..=1.0).contains(&reflected));
            }
        }
    }

    #[test]
    fn reflectance_head_on_and_grazing_is_what_the_books_say() {
        assert!((fresnel(1.0, 1.5, [1.0, 1.0]) - 0.04).abs() < 1e-16);
        let grazing = bent(falling(1.0), Vector::Y, 1.0, 1.5).expect("goes in");
        assert_eq!(fresnel(1.0, 1.5, grazing.cosines), 1.0);
        // Brewster's angle: tan = 1.5, and only light across the plane is reflected.
        let sine = 1.5 / 3.25f64.sqrt();
        let bent = bent(falling(sine), Vector::Y, 1.0, 1.5).expect("goes in");
        let across = (1.0 - 2.25) / (1.0 + 2.25);
        assert!((fresnel(1.0, 1.5, bent.cosines) - 0.5 * across * across).abs() < 1e-15);
    }

    #[test]
    fn a_path_is_the_same_both_ways_and_a_slab_keeps_the_direction() {
        for (d, n) in meetings() {
            for (from, to) in [(1.0, 1.5), (1.0, 2.4), (1.33, 1.5)] {
                let inside = bent(d, n, from, to).expect("goes in");
                // So flat the way back is at the critical angle: rounding decides.
                if inside.cosines[0] < 1e-7 {
                    continue;
                }
                let back = bent(-inside.direction, -n, to, from).expect("comes out again");
                // Near grazing the sine says little about the angle.
                let bound = 2e-15 / inside.cosines[0].max(1e-8);
                assert!((back.direction + d).length() < bound, "{d} {n}");
                let beyond = bent(inside.direction, n, to, from).expect("leaves");
                assert!((beyond.direction - d).length() < bound, "{d} {n}");
                let there = fresnel(from, to, inside.cosines);
                let again = fresnel(to, from, [inside.cosines[1], inside.cosines[0]]);
                assert!((there - again).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn no_index_and_no_angle_makes_a_number_that_is_none() {
        for from in [1e-300, 1e-8, 1.0, 1e8, 1e300] {
            for to in [1e-300, 1e-8, 1.0, 1e8, 1e300] {
                for sine in [0.0, 1e-300, 1e-9, 0.5, 1.0 - 1e-16, 1.0] {
                    if let Some(bent) = bent(falling(sine), Vector::Y, from, to) {
                        assert!(bent.direction.is_finite());
                        let reflected = fresnel(from, to, bent.cosines);
                        assert!((0.0..=1.0).contains(&reflected), "{from} {to} {sine}");
                    }
                }
            }
        }
    }
}
