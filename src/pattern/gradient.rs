//! `gradient <direction>`: the fractional part of the distance along a direction.

use crate::math::Vector;

/// The fractional part of `direction · point`, 0 … 1 (0 included, 1 excluded); `direction` has
/// length 1.
///
/// **Source:** POV-Ray manual, section "Gradient".
#[inline]
pub fn value(direction: Vector, point: Vector) -> f64 {
    let along = direction.dot(point);
    let fraction = along - along.floor();
    // A tiny negative number rounds up to 1, which is outside of the half-open range.
    if fraction < 1.0 { fraction } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rises_from_zero_to_one_in_each_unit() {
        let y = Vector::Y;
        assert_eq!(value(y, Vector::new(9.0, 0.25, 7.0)), 0.25);
        assert_eq!(value(y, Vector::new(0.0, -0.25, 0.0)), 0.75);
        assert_eq!(value(y, Vector::new(0.0, 3.0, 0.0)), 0.0);
        assert!(value(y, Vector::new(0.0, -1e-30, 0.0)) < 1.0);
    }
}
