//! Surface orientation at multiple roots, where the gradient of the function vanishes on the surface.
//!
//! **In:** the function and its gradient near a point. **Out:** the mean gradient around the point, at the
//! smallest distance at which it exceeds rounding. **Invariant:** there is no orientation where the surface
//! faces away on both sides, as at the tip of a cone or where two sheets cross.
//!
//! If f = hⁿ with an odd n, the gradient n·hⁿ⁻¹·∇h has the same direction as ∇h on both sides of the surface.
//! The curvature of h changes sign from one side of the point to the other and cancels in the mean.

use super::local::Height;
use crate::math::Vector;

/// Maximum number of times that the distance is doubled.
const DOUBLED: u32 = 24;

/// The gradient exceeds rounding where the value rises by this many errors within the distance, and where the
/// gradient is this many times its own error.
const TOLD: (f64, f64) = (16.0, 1024.0);

/// Error of the surface's position, as a multiple of the distance, for up to eleven coincident roots: farther
/// out, the value rises that much faster.
const FARTHEST: f64 = 4.0;

/// Relative to the point's distance: where rounding moves the surface by this much, a single gradient may not
/// locate it.
pub(super) const MOVED: f64 = 1.0 / 1_048_576.0;

/// At a multiple root, the gradient where rounding may have moved the surface of hⁿ to differs by more than
/// this fraction of itself: by at least (1 + 1/n)ⁿ⁻¹ - 1, which is 7/9 for n = 3.
const STEADY: f64 = 0.75;

/// Relative to the point's distance: the smallest distance at which the gradient is sampled.
pub(super) const NEAREST: f64 = 1.0 / 67_108_864.0;

/// A height, and the error bound of its gradient.
pub(super) type Told = (Height, f64);

const UNKNOWN: Height = Height { value: 0.0, gradient: Vector::ZERO, error: f64::INFINITY };

/// Returns whether the gradient stays nearly constant across the uncertainty of the surface; at multiple
/// roots it does not.
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

/// Returns the height near `point`, where it is 0 within its error, from the mean gradient at the smallest
/// conclusive distance not below `nearest`. `sample` returns `None` where the function is unknown.
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

    /// (r² − 1)ⁿ, with the rounding error of a sum of terms.
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
