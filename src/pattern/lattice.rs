//! The unit lattice: which cell a coordinate is in.

use super::{NEAR, settled};

/// Returns the lower end of the cell that contains a coordinate. A coordinate that its error cannot separate
/// from an integer is that integer, the lower end of its cell.
#[inline]
pub(super) fn cell(coordinate: f64, error: f64) -> f64 {
    settled(coordinate, error).floor()
}

/// Returns the same for any error less than [`NEAR`] / 4; `None` if the error may matter.
#[inline]
pub(super) fn cell_off_seams(coordinate: f64) -> Option<f64> {
    let off = (coordinate - coordinate.round()).abs();
    (off == 0.0 || off > NEAR).then(|| coordinate.floor())
}

/// Returns the remainder of an integer divided by `count`, from 0 to `count` − 1; 0 for infinity.
#[inline]
pub(super) fn remainder(integer: f64, count: u8) -> u8 {
    let by = f64::from(count);
    // Beyond 2⁵³ the quotient may be rounded to the next integer.
    (integer - by * (integer / by).floor()).clamp(0.0, by - 1.0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remainders_are_never_negative() {
        for integer in -20..20 {
            for count in 2..5 {
                let expected = i32::rem_euclid(integer, count.into());
                assert_eq!(i32::from(remainder(integer.into(), count)), expected);
            }
        }
        for strange in [1e300, -1e300, f64::INFINITY, f64::NAN, 9_007_199_254_740_991.0] {
            assert!(remainder(strange, 3) < 3, "{strange}");
        }
    }
}
