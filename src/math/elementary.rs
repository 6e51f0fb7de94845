//! Elementary functions, by `libm`, with the same bits on every machine.
//!
//! **Invariant:** no other module calls `f64::sin`, `powf`, `exp` and similar functions (`sqrt`, `abs` and
//! `floor` are exact everywhere and need no wrapper).

pub use libm::{
    acos, acosh, asin, asinh, atan, atan2, atanh, cbrt, ceil, cos, cosh, erf, exp, floor, fmod,
    hypot, log, log10, pow, sin, sinh, tan, tanh,
};

/// π / 180, which converts degrees to radians.
pub const RADIANS_PER_DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Returns the sine and cosine of an angle in degrees; exact (0, ±1) at multiples of 90°.
///
/// The angle is reduced to −45° … 45° in degrees, where `fmod` is exact, so the error is that of the kernels:
/// less than 1 unit in the last place, plus one rounding of the angle.
pub fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let turn = fmod(degrees, 360.0);
    let quarter = (turn / 90.0).round();
    let rest = (turn - quarter * 90.0) * RADIANS_PER_DEGREE;
    let (s, c) = (sin(rest), cos(rest));
    match (quarter as i64).rem_euclid(4) {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        assert_eq!(sin_cos_degrees(90.0), (1.0, 0.0));
        assert_eq!(sin_cos_degrees(-90.0), (-1.0, 0.0));
        assert_eq!(sin_cos_degrees(180.0), (0.0, -1.0));
        assert_eq!(sin_cos_degrees(360_000_270.0), (-1.0, 0.0));
    }

    #[test]
    fn sixty_degrees_have_the_cosine_one_half() {
        let (s, c) = sin_cos_degrees(60.0);
        assert!((c - 0.5).abs() < 2e-16 && (s - 0.75f64.sqrt()).abs() < 2e-16);
    }
}
