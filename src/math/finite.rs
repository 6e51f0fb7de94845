//! Finite results for numbers of any size, and rounding to single precision.

use super::{UnitVector, Vector};

/// Limits a number to finite ones; NaN counts as 0.
#[inline]
pub(crate) fn finite(number: f64) -> f64 {
    if number.is_nan() { 0.0 } else { number.clamp(-f64::MAX, f64::MAX) }
}

/// Rounds to single precision, limited to finite numbers; NaN counts as 0.
#[inline]
pub(crate) fn single(number: f64) -> f64 {
    let greatest = f64::from(f32::MAX);
    f64::from(finite(number).clamp(-greatest, greatest) as f32)
}

/// Returns the length of `v`, at most the greatest number.
#[inline]
pub(crate) fn length(v: Vector) -> f64 {
    let squared = v.length_squared();
    // Otherwise a square may have overflowed or lost digits.
    if (1e-200..1e200).contains(&squared) {
        return squared.sqrt();
    }
    let unit = UnitVector::from_direction(v).map_or(Vector::ZERO, UnitVector::get);
    // Halves, so that the product cannot overflow before it is limited.
    finite(2.0 * (unit.dot(v * 0.5)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_is_right_at_any_size() {
        for size in [1e-320, 1e-300, 1e-150, 1e-20, 1.0, 1e90, 1e150, 1e300] {
            let off = length(Vector::new(3.0, -4.0, 12.0) * size) / (13.0 * size) - 1.0;
            assert!(off.abs() < if size < 1e-310 { 1e-3 } else { 1e-15 }, "{size}: {off}");
        }
        assert_eq!(length(Vector::splat(f64::MAX)), f64::MAX);
        assert_eq!(length(Vector::ZERO), 0.0);
    }
}
