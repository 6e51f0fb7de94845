//! Multiple: which way a surface faces where its function has several roots in one, so that its gradient is 0
//! there as well.
//!
//! **In:** the function and its gradient near a point. **Out:** the mean gradient around the point, at the least
//! distance where it is more than rounding. **Invariant:** what faces away on both sides, as at the tip of a cone
//! or where two sheets cross, faces no way.
//!
//! Of f = hⁿ with an odd n the gradient n·hⁿ⁻¹·∇h goes one way on both sides of the surface, as that of h; what
//! h is bent by changes its sign from one side of the point to the other, and leaves the mean as it is.

use super::body::Height;
use crate::math::Vector;

/// So often the distance is doubled.
const DOUBLED: u32 = 24;

/// The gradient is more than rounding where the value rises by so many errors within the distance, and the
/// gradient is so many times its own.
const TOLD: (f64, f64) = (16.0, 1024.0);

/// Of that distance, so many times the surface may be off that has up to eleven roots in one: the value rises so
/// much faster farther out.
const FARTHEST: f64 = 4.0;

/// Of how far off a point is: where rounding moves the surface by as much, one gradient may not tell where it is.
pub(super) const MOVED: f64 = 1.0 / 1_048_576.0;

/// Where rounding may have moved the surface of hⁿ to, the gradient is other by more than this part of itself: by
/// (1 + 1/n)ⁿ⁻¹ - 1 of it at least, 7/9 where n is 3.
const STEADY: f64 = 0.75;

/// Of how far off a point is: the least distance at which the gradient is asked for.
pub(super) const NEAREST: f64 = 1.0 / 67_108_864.0;

/// A height, and how far its gradient may be off.
pub(super) type Told = (Height, f64);

const UNKNOWN: Height = Height { value: 0.0, gradient: Vector::ZERO, error: f64::INFINITY };

/// Whether the gradient stays nearly as it is where the surface may be; of roots that are many in one it does not.
#[cold]
pub(super) fn is_steady(
    point: Vector,
    height: &Height,
    sample: impl Fn(Vector) -> Option<Told>,
) -> bool {
    let Height { gradient, error, .. } = *height;
    let steepness = gradient.length();
    let step = gradient / steepness * (error / steepness);
    let is_near = |place| {
        sample(place)
            .is_some_and(|(there, _)| (there.gradient - gradient).length() < STEADY * steepness)
    };
    is_near(point + step) && is_near(point - step)
}

/// The height near `point`, which is 0 as far as is told: by the gradient at the least distance from `nearest` on
/// that tells one. `sample` is `None` where nothing is known.
#[cold]
pub(super) fn height(
    point: Vector,
    nearest: f64,
    sample: impl Fn(Vector) -> Option<Told>,
) -> Option<Height> {
    let mut far = nearest;
    for _ in 0..DOUBLED {
        let (mut sum, mut lengths) = (Vector::ZERO, 0.0);
        let (mut error, mut turn) = (0.0_f64, 0.0_f64);
        for way in [Vector::X, Vector::Y, Vector::Z] {
            for place in [point - way * far, point + way * far] {
                let (there, off) = sample(place).unwrap_or((UNKNOWN, f64::INFINITY));
                sum += there.gradient;
                lengths += there.gradient.length();
                (error, turn) = (error.max(there.error), turn.max(off));
            }
        }
        if lengths == 0.0 && turn == 0.0 {
            return None;
        }
        let gradient = sum / 6.0;
        let steepness = gradient.length();
        let is_told = steepness * far >= TOLD.0 * error && steepness >= TOLD.1 * turn;
        if is_told && steepness > 0.0 {
            let is_one_way = 2.0 * sum.length() >= lengths;
            let error = FARTHEST * far * steepness;
            return is_one_way.then_some(Height { value: 0.0, gradient, error });
        }
        far *= 2.0;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    const LEAST: f64 = 1e-16;

    /// (r² − 1)ⁿ, as if it were a sum of terms that are rounded.
    fn power_of_ball(n: i32) -> impl Fn(Vector) -> Option<Told> {
        move |p: Vector| {
            let h = p.length_squared() - 1.0;
            let gradient = p * (2.0 * f64::from(n) * h.powi(n - 1));
            Some((Height { value: h.powi(n), gradient, error: LEAST }, LEAST))
        }
    }

    #[test]
    fn a_ball_of_many_roots_faces_as_a_ball_and_is_as_far_off_as_is_said() {
        let mut random = Random(5);
        for _ in 0..tries() {
            for (n, most) in [(3, 1e-4), (5, 1e-2), (7, 1e-1)] {
                let out = random.direction().get();
                // As far off as the value does not tell.
                let off = random.number(-0.5, 0.5) * LEAST.powf(1.0 / f64::from(n));
                let found = height(out * (1.0 + off), NEAREST, power_of_ball(n)).expect("a ball");
                let steepness = found.gradient.length();
                let turn = (found.gradient / steepness - out).length();
                assert!(turn <= most, "{n}: {turn}");
                assert!(off.abs() <= found.error / steepness, "{n}: {off} {found:?}");
                assert!(found.error / steepness <= 10.0 * most, "{n}: {found:?}");
            }
        }
    }

    #[test]
    fn what_faces_away_on_both_sides_and_what_is_level_face_no_way() {
        let of = |gradient: fn(Vector) -> Vector| {
            let sample =
                |p| Some((Height { value: 0.0, gradient: gradient(p), error: LEAST }, LEAST));
            height(Vector::ZERO, NEAREST, sample)
        };
        assert_eq!(of(|p| Vector::new(p.x, -p.y, 0.0)), None);
        assert_eq!(of(|p| Vector::new(p.x, -p.y, p.z)), None);
        assert_eq!(of(|_| Vector::ZERO), None);
    }
}
