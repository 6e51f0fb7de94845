//! Points and directions in three dimensions; the only file that uses `glam`.
//!
//! **In/Out:** plain values. **Invariant:** the length of a [`UnitVector`] is 1 within 2 units in the last
//! place.

use std::ops::Neg;

/// A point, a direction or a size in `f64`.
pub type Vector = glam::DVec3;

/// A 3×3 matrix in `f64`, stored by columns; it multiplies column vectors: `m * v`.
pub type Matrix = glam::DMat3;

/// Four `f32` lanes, for the boxes of a tree.
pub type Lanes = glam::Vec4;

/// The sum from which the rounding of a scalar product is bounded.
pub trait AbsDot {
    /// Returns Σ |aᵢ·bᵢ|; the rounding error of `dot` is at most 3 roundoffs of it.
    fn abs_dot(self, other: Self) -> f64;
}

impl AbsDot for Vector {
    #[inline]
    fn abs_dot(self, other: Self) -> f64 {
        self.abs().dot(other.abs())
    }
}

/// Formats a vector as in the scene language: `<1, 2, 3>`, each number in the shortest form that parses to
/// the same value.
pub fn written(v: Vector) -> String {
    // Adding zero turns −0 into 0.
    format!("<{}, {}, {}>", v.x + 0.0, v.y + 0.0, v.z + 0.0)
}

/// A vector of length 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitVector(Vector);

impl UnitVector {
    pub const X: Self = Self(Vector::X);
    pub const Y: Self = Self(Vector::Y);
    pub const Z: Self = Self(Vector::Z);

    /// Returns the direction of `v`; `None` if `v` is zero or not finite.
    ///
    /// `v` is first scaled by a power of two, so that no square overflows or underflows. Multiplying `v` by a
    /// power of two therefore changes no bit of the result, and a vector along an axis stays exact.
    #[inline]
    pub fn from_direction(v: Vector) -> Option<Self> {
        // No square that counts overflows or underflows: the scaling would change no bit.
        let squared = v.length_squared();
        if (1e-30..1e30).contains(&squared) {
            return Some(Self(v / squared.sqrt()));
        }
        Self::from_direction_of_any_size(v)
    }

    #[cold]
    fn from_direction_of_any_size(v: Vector) -> Option<Self> {
        let largest = v.abs().max_element();
        if largest == 0.0 || !v.is_finite() {
            return None;
        }
        let scaled = v * reciprocal_power_of_two(largest);
        // A second scaling: the first may have been limited by the range of exponents.
        let scaled = scaled * reciprocal_power_of_two(scaled.abs().max_element());
        Some(Self(scaled / scaled.length()))
    }

    /// Wraps a vector that is already of length 1; the caller has just normalized it.
    #[inline]
    pub fn from_unit(v: Vector) -> Self {
        debug_assert!((v.length_squared() - 1.0).abs() < 1e-12, "not a unit vector: {v}");
        Self(v)
    }

    #[inline]
    pub fn get(self) -> Vector {
        self.0
    }
}

impl Neg for UnitVector {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// Returns a power of two near `1 / largest`, within the range of normal numbers: the product of the two is
/// in ½ … 2, unless that range prevents it.
pub(crate) fn reciprocal_power_of_two(largest: f64) -> f64 {
    let exponent = ((largest.to_bits() >> 52) & 0x7ff) as i64 - 1023;
    f64::from_bits(((1023 - exponent).clamp(1, 2046) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    #[test]
    fn a_direction_is_normalised_at_any_size() {
        for exponent in [-320, -300, -200, 0, 200, 300] {
            let size = format!("1e{exponent}").parse::<f64>().expect("a number");
            let unit =
                UnitVector::from_direction(Vector::new(3.0, 4.0, 0.0) * size).expect("not zero");
            let error = (unit.get() - Vector::new(0.6, 0.8, 0.0)).length();
            assert!(error < if exponent < -310 { 1e-2 } else { 1e-15 }, "{size}: {unit:?}");
        }
        assert_eq!(UnitVector::from_direction(Vector::ZERO), None);
        assert_eq!(UnitVector::from_direction(Vector::new(f64::NAN, 0.0, 0.0)), None);
    }

    #[test]
    fn scaling_changes_no_bit_of_a_direction() {
        let mut random = Random(8);
        for _ in 0..tries() {
            let v = random.point(1.0) * random.size(-14.0, 14.0);
            let bits = |unit: Option<UnitVector>| unit.map(|u| u.0.to_array().map(f64::to_bits));
            let scaled = UnitVector::from_direction_of_any_size(v);
            assert_eq!(bits(UnitVector::from_direction(v)), bits(scaled), "{v}");
        }
    }

    #[test]
    fn a_direction_along_an_axis_stays_exact() {
        assert_eq!(
            UnitVector::from_direction(Vector::new(0.0, -7.3e-200, 0.0)),
            Some(-UnitVector::Y)
        );
    }
}
