//! Bracketed root finding between a position where a function is certainly positive and one where it is
//! certainly negative.
//!
//! **In:** a function that reports the error of its value. **Out:** a root with an error bound.
//! **Invariant:** within the bound, the function's sign is certain on each side; so the bound holds for the
//! exact function, despite rounding.

/// Unit roundoff of `f64`.
const U: f64 = f64::EPSILON / 2.0;

/// A function at one position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    pub value: f64,
    /// The function's slope. If it is wrong or NaN, the root is found as accurately, but later.
    pub slope: f64,
    /// Error bound of `value`.
    pub error: f64,
}

impl Sample {
    /// Returns whether the value is certainly positive.
    pub fn is_outside(&self) -> bool {
        self.value > self.error
    }

    /// Returns whether the value is certainly negative.
    pub fn is_inside(&self) -> bool {
        self.value < -self.error
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    pub t: f64,
    /// Error bound: the true root lies within this distance of `t`.
    pub error: f64,
}

/// Returns the root between `outside`, where the function is certainly positive, and `inside`, where it is
/// certainly negative, in either order. `start` is a guess; `tolerance` is the error that the root may have
/// in addition to that caused by the errors of the samples.
///
/// Uses Newton's method, with bisection where a step would leave the bracket or converges too slowly; then
/// searches outward from the root for the error bound.
///
/// **Source:** W. Press et al., "Numerical Recipes in C", 2nd ed. (1992), § 9.4 (`rtsafe`).
pub fn root(
    sample: impl Fn(f64) -> Sample,
    (outside, inside): (f64, f64),
    start: f64,
    tolerance: f64,
) -> Root {
    let between = |t: f64, a: f64, b: f64| (t - a) * (t - b) < 0.0;
    let (mut above, mut below) = (outside, inside);
    let mut t = if between(start, above, below) { start } else { 0.5 * (above + below) };
    let (mut step, mut step_before) = (f64::INFINITY, f64::INFINITY);
    let mut here = sample(t);
    loop {
        if here.is_outside() {
            above = t;
        } else if here.is_inside() {
            below = t;
        } else {
            break;
        }
        let newton = here.value / here.slope;
        let is_fast = 2.0 * newton.abs() < step_before.abs();
        let next = match between(t - newton, above, below) && is_fast {
            true => t - newton,
            false => 0.5 * (above + below),
        };
        (step_before, step) = (step, next - t);
        if !between(next, above, below) {
            break;
        }
        t = next;
        if step.abs() <= 0.5 * tolerance {
            break;
        }
        here = sample(t);
    }
    // How far one must go from the root until the sign is certain.
    let finest = (4.0 * U * t.abs()).max(tolerance).max(f64::MIN_POSITIVE);
    let least = (2.0 * here.error / here.slope.abs()).max(finest);
    let reach = |end: f64, is_certain: fn(&Sample) -> bool| {
        let (far, way) = ((end - t).abs(), (end - t).signum());
        let mut step = least.min(far);
        if step == far {
            // The slope says nothing: it was 0, or another on this side. Inward, then.
            while 0.5 * step > finest && is_certain(&sample(t + way * (0.5 * step))) {
                step *= 0.5;
            }
            return step;
        }
        while step < far {
            if is_certain(&sample(t + way * step)) {
                return step;
            }
            step = 2.0 * step + f64::MIN_POSITIVE;
        }
        far
    };
    let error = reach(above, Sample::is_outside).max(reach(below, Sample::is_inside));
    Root { t, error: error + 2.0 * U * t.abs() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    /// x³ − a, with an error up to `error`.
    fn cube(a: f64, error: f64) -> impl Fn(f64) -> Sample {
        move |x| Sample { value: x * x * x - a, slope: 3.0 * x * x, error }
    }

    #[test]
    fn a_root_lies_within_its_bound_wherever_the_search_starts() {
        let mut random = Random(7);
        for _ in 0..tries() {
            let meant = random.number(-2.0, 2.0);
            let error = random.size(-14.0, -2.0);
            // What was meant, and off by nearly as much as is claimed.
            let off = random.number(-0.9, 0.9) * error;
            let start = random.number(-5.0, 5.0);
            let root = root(cube(meant * meant * meant + off, error), (3.0, -3.0), start, 0.0);
            assert!((root.t - meant).abs() <= root.error, "{root:?} {meant} {error:e}");
            if meant.abs() > 0.5 {
                assert!(root.error <= 10.0 * error, "{root:?} {meant} {error:e}");
            }
        }
    }

    #[test]
    fn a_root_that_need_not_be_near_is_found_sooner_and_lies_within_its_bound() {
        let mut random = Random(8);
        let count = std::cell::Cell::new(0);
        for _ in 0..1000 {
            let meant = random.number(-2.0, 2.0);
            let cube = cube(meant * meant * meant, 1e-15);
            let start = random.number(-3.0, 3.0);
            let counted = |t| {
                count.set(count.get() + 1);
                cube(t)
            };
            let taken = |tolerance| {
                count.set(0);
                let root = root(counted, (3.0, -3.0), start, tolerance);
                assert!((root.t - meant).abs() <= root.error, "{root:?} {meant} {tolerance}");
                (count.get(), root.error)
            };
            let ((rough, error), (all, _)) = (taken(1e-2), taken(0.0));
            assert!(rough < all, "{rough} {all}");
            assert!(meant.abs() < 0.1 || error < 0.1, "{error} {meant}");
        }
    }

    #[test]
    fn a_slope_that_is_wrong_costs_time_and_no_digits() {
        let wrong = |slope: f64| move |x: f64| Sample { value: x - 0.3, slope, error: 1e-15 };
        for slope in [f64::NAN, 0.0, -1.0, 1e-300, f64::INFINITY] {
            let root = root(wrong(slope), (1.0, -1.0), f64::NAN, 0.0);
            assert!((root.t - 0.3).abs() < 2e-15, "{slope}: {root:?}");
            assert!((root.t - 0.3).abs() <= root.error, "{slope}: {root:?}");
        }
    }
}
