//! The interval where a convex function is negative; there is at most one.
//!
//! **In:** a convex function and its slope, both with their errors; two positions where it is positive.
//! **Out:** the two roots between them, each with an error bound. **Invariant:** the result is empty only if
//! no position between them is certainly negative, within rounding.
//!
//! **Source:** J. Kelley, "The cutting-plane method for solving convex programs", Journal of the SIAM 8
//! (1960), in one dimension: the function is nowhere below its tangents.

use super::bracket::{Root, Sample, root};

/// The tangent of a convex function at one position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tangent {
    pub at: Sample,
    /// Error bound of the slope.
    pub slope_error: f64,
}

type Place = (f64, Tangent);

/// A position where the function is certainly negative, with the nearest known positions on both sides where
/// it is certainly positive, and the tangents there, where they are known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dip {
    before: (f64, Option<Tangent>),
    inside: f64,
    behind: (f64, Option<Tangent>),
}

/// Returns where the function is negative, if anywhere between two positions where it is certainly positive;
/// looks at `guess` first.
pub fn dip(tangent: impl Fn(f64) -> Tangent, (low, high): (f64, f64), guess: f64) -> Option<Dip> {
    // The nearest places that are certainly positive.
    let (mut outer_before, mut outer_behind) = ((low, None), (high, None));
    let (mut before, mut behind) = (None, None);
    let mut width = high - low;
    let mut next = if low < guess && guess < high { guess } else { low + 0.5 * width };
    loop {
        let here = tangent(next);
        if here.at.is_inside() {
            return Some(Dip { before: outer_before, inside: next, behind: outer_behind });
        }
        // A slope of 0, or none, is as low as it goes.
        let (end, outer_end) = match here.at.slope {
            slope if slope > 0.0 => (&mut behind, &mut outer_behind),
            slope if slope < 0.0 => (&mut before, &mut outer_before),
            _ => return None,
        };
        *end = Some((next, here));
        if here.at.is_outside() {
            *outer_end = (next, Some(here));
        }
        let first = before.unwrap_or_else(|| (low, tangent(low)));
        let last = behind.unwrap_or_else(|| (high, tangent(high)));
        (before, behind) = (Some(first), Some(last));
        next = between(first, last, &mut width)?;
    }
}

impl Dip {
    /// Returns an interval that certainly contains all negative values.
    pub fn around(&self) -> (f64, f64) {
        (self.before.0, self.behind.0)
    }

    /// Returns a position where the function is negative.
    pub fn inside(&self) -> f64 {
        self.inside
    }

    /// Returns where the function becomes negative.
    pub fn enter(&self, tangent: impl Fn(f64) -> Tangent, tolerance: f64) -> Root {
        self.end(self.before, tangent, tolerance)
    }

    /// Returns where the function becomes positive again.
    pub fn leave(&self, tangent: impl Fn(f64) -> Tangent, tolerance: f64) -> Root {
        self.end(self.behind, tangent, tolerance)
    }

    fn end(
        &self,
        (outside, known): (f64, Option<Tangent>),
        tangent: impl Fn(f64) -> Tangent,
        tolerance: f64,
    ) -> Root {
        let Tangent { at, .. } = known.unwrap_or_else(|| tangent(outside));
        // From outside, Newton's step does not reach beyond the root.
        let start = outside - at.value / at.slope;
        root(|s| tangent(s).at, (outside, self.inside), start, tolerance)
    }
}

/// Returns the next position to evaluate: the intersection of the two tangents, or the middle if that
/// converges too slowly. `None` if the function cannot be negative between the two.
fn between((a, at_a): Place, (b, at_b): Place, width: &mut f64) -> Option<f64> {
    let (down, up) = (-at_a.at.slope, at_b.at.slope);
    // How far it may be below its value at each, at most.
    let least = |tangent: Tangent, slope: f64, length: f64| {
        let steepest = (slope + tangent.slope_error).max(0.0);
        tangent.at.value - tangent.at.error - steepest * length.max(0.0)
    };
    let length = b - a;
    let cross = a + (at_a.at.value - at_b.at.value + up * length) / (down + up);
    if least(at_a, down, cross - a) > 0.0 && least(at_b, up, b - cross) > 0.0 {
        return None;
    }
    let middle = a + 0.5 * length;
    let is_slow = length > 0.5 * *width;
    *width = length;
    let next = if is_slow || !(a < cross && cross < b) { middle } else { cross };
    (a < next && next < b).then_some(next)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::elementary::pow;
    use crate::math::random::{Random, tries};

    /// |x − c|ᵖ − `depth`, flatter on one side; with an error up to `error`.
    fn valley(random: &mut Random, depth: f64, error: f64) -> (f64, impl Fn(f64) -> Tangent) {
        let power = [1.0, 1.5, 2.0, 4.0, 9.0][random.below(5)];
        let lean = [1.0, random.size(-4.0, 0.0)][random.below(2)];
        let centre = random.number(-1.0, 1.0);
        let sample = move |x: f64| {
            let off = x - centre;
            let side = if off < 0.0 { -1.0 } else { lean };
            let value = side.abs() * pow(off.abs(), power) - depth;
            let slope = side * power * pow(off.abs(), power - 1.0);
            Tangent { at: Sample { value, slope, error }, slope_error: 1e-14 }
        };
        (centre, sample)
    }

    #[test]
    fn a_piece_that_is_certainly_negative_is_found_between_its_ends() {
        let mut random = Random(11);
        for _ in 0..tries() {
            let depth = random.size(-10.0, -1.0);
            let error = depth * random.size(-6.0, -0.5);
            let guess = random.number(-9.5, 9.5);
            let (centre, sample) = valley(&mut random, depth, error);
            if !(sample(-9.0).at.is_outside() && sample(9.0).at.is_outside()) {
                continue;
            }
            let dip = dip(&sample, (-9.0, 9.0), guess).expect("negative at the centre");
            let (enter, leave) = (dip.enter(&sample, 0.0), dip.leave(&sample, 0.0));
            assert!(enter.t < centre && centre < leave.t, "{enter:?} {centre} {leave:?}");
            for (root, way) in [(enter, -1.0), (leave, 1.0)] {
                let out = sample(root.t + way * root.error).at;
                let within = sample(root.t - way * root.error).at;
                assert!(out.value >= 0.0 && within.value <= 0.0, "{root:?} {out:?} {within:?}");
            }
        }
    }

    #[test]
    fn nothing_is_found_where_all_is_positive() {
        let mut random = Random(12);
        for _ in 0..tries() {
            let height = random.size(-14.0, 0.0);
            let guess = random.number(-9.5, 9.5);
            let (_, sample) = valley(&mut random, -height, height * 0.5);
            assert_eq!(dip(&sample, (-9.0, 9.0), guess), None);
        }
    }
}
