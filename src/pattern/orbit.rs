//! The orbit of a complex number under an iterated map, and the numbers that the fractal patterns derive from
//! it.
//!
//! **Source:** POV-Ray manual, section "Fractal Pattern"; what it leaves open is measured on POV-Ray 3.7.

use crate::math::elementary::fmod;
use crate::math::finite::finite;
use crate::math::interval::Interval;

/// Limit of iterations, which bounds the time for a point of the set.
const MOST: f64 = 16_777_216.0;

/// A complex number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Complex {
    pub re: f64,
    pub im: f64,
}

impl Complex {
    pub fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    #[inline]
    pub fn norm_squared(self) -> f64 {
        self.re * self.re + self.im * self.im
    }

    #[inline]
    pub fn plus(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }

    #[inline]
    pub fn plus_real(self, real: f64) -> Self {
        Self { re: self.re + real, im: self.im }
    }

    #[inline]
    pub fn scaled(self, factor: f64) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }

    #[inline]
    pub fn times(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }

    #[inline]
    pub fn squared(self) -> Self {
        Self { re: self.re * self.re - self.im * self.im, im: 2.0 * self.re * self.im }
    }

    /// Returns the quotient; `None` for a divisor whose square is 0.
    #[inline]
    pub fn over(self, other: Self) -> Option<Self> {
        let squared = other.norm_squared();
        let real = self.re * other.re + self.im * other.im;
        let imaginary = self.im * other.re - self.re * other.im;
        (squared != 0.0).then(|| Self { re: real / squared, im: imaginary / squared })
    }

    /// Returns the power for an exponent of at least 1.
    #[inline]
    pub fn power(self, exponent: u32) -> Self {
        match exponent {
            2 => self.squared(),
            4 => self.squared().squared(),
            _ => (1..exponent).fold(self, |power, _| power.times(self)),
        }
    }
}

/// The orbit of a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Orbit {
    /// The number of iterations before the one that left the set; `None` if none did.
    left_after: Option<u32>,
    last: Complex,
    /// The least absolute value in it, squared.
    least: f64,
}

impl Orbit {
    /// Iterates `step` from `start` until `leaves`, or until `step` has no result. `least` is an upper bound
    /// of the squared absolute values.
    ///
    /// Most orbits that stay end in a cycle of rounded numbers. A point repeated exactly is recognized by
    /// comparison with a saved one, which is replaced at each power of two; the rest is then known.
    ///
    /// **Source:** R. P. Brent, "An improved Monte Carlo factorization algorithm", BIT 20, 1980, for the
    /// cycles.
    pub fn follow(
        start: Complex,
        mut least: f64,
        iterations: u32,
        step: impl Fn(Complex) -> Option<Complex>,
        leaves: impl Fn(Complex, f64) -> bool,
    ) -> Self {
        let mut last = start;
        let (mut saved, mut saved_at) = (start, 0);
        for count in 0..iterations {
            let Some(next) = step(last) else { break };
            last = next;
            let squared = last.norm_squared();
            if leaves(last, squared) {
                return Self { left_after: Some(count), last, least };
            }
            least = least.min(squared);
            let done = count + 1;
            if last == saved {
                let rest = (iterations - done) % (done - saved_at);
                last = (0..rest).try_fold(last, |last, _| step(last)).unwrap_or(last);
                break;
            }
            if done.is_power_of_two() {
                (saved, saved_at) = (last, done);
            }
        }
        Self { left_after: None, last, least }
    }
}

/// How an orbit becomes a number: `exterior` for an orbit that leaves, `interior` for one that does not, each
/// with its type and factor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reading {
    pub exterior: [f64; 2],
    pub interior: [f64; 2],
}

impl Reading {
    /// Returns the number for an orbit of at most `iterations`.
    pub fn value(&self, orbit: &Orbit, iterations: f64) -> f64 {
        let Orbit { last: Complex { re, im }, least, left_after } = *orbit;
        let value = match left_after {
            Some(count) => {
                let [kind, factor] = self.exterior;
                let count = f64::from(count);
                match kind as u8 {
                    0 => factor,
                    1 => count / iterations,
                    2 => factor * re,
                    3 => factor * im,
                    4 => factor * (re * re),
                    5 => factor * (im * im),
                    6 => factor * (re * re + im * im).sqrt(),
                    7 => remainder(count, factor) / factor,
                    _ => remainder(count, factor + 1.0) / factor,
                }
            }
            None => {
                let [kind, factor] = self.interior;
                match kind as u8 {
                    0 => factor,
                    1 => factor * least.sqrt(),
                    2 => factor * re,
                    3 => factor * im,
                    4 => factor * (re * re),
                    5 => factor * (im * im),
                    // The manual says the absolute value; this is what POV-Ray 3.7 returns.
                    _ => re * re + factor * (im * im),
                }
            }
        };
        if value.is_nan() { 0.0 } else { value.clamp(f64::MIN, f64::MAX) }
    }

    /// Returns an interval that contains all values.
    pub fn range(&self) -> Interval {
        let ([exterior, outer], [interior, inner]) = (self.exterior, self.interior);
        let outer = match exterior as u8 {
            0 => Interval::point(outer),
            1 => Interval { low: 0.0, high: 1.0 },
            _ => UNBOUNDED,
        };
        let inner = match interior as u8 {
            0 => Interval::point(inner),
            _ => UNBOUNDED,
        };
        outer.hull(inner)
    }

    /// Returns the same with types that exist, truncated, and finite factors.
    pub fn canonical(self) -> Self {
        let known = |[kind, factor]: [f64; 2], default: f64, greatest: f64| {
            let kind = kind.trunc();
            let kind = if (0.0..=greatest).contains(&kind) { kind } else { default };
            [kind, finite(factor)]
        };
        Self { exterior: known(self.exterior, 1.0, 8.0), interior: known(self.interior, 0.0, 6.0) }
    }
}

/// Returns the remainder of a number of iterations. Only the integer part of the divisor counts; below 0 it is
/// more than any number, and so the number remains. 0 by 0, where POV-Ray 3.7 stops.
///
/// **Source:** POV-Ray 3.7's behaviour, measured.
fn remainder(count: f64, by: f64) -> f64 {
    match by.trunc() {
        0.0 => 0.0,
        ..0.0 => count,
        by => fmod(count, by),
    }
}

const UNBOUNDED: Interval = Interval { low: f64::MIN, high: f64::MAX };

/// Truncates a number of iterations and clamps it to 0 … 2²⁴.
pub(super) fn canonical_iterations(iterations: f64) -> f64 {
    finite(iterations).clamp(0.0, MOST).trunc()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_changes_no_result() {
        // From 0 this visits 0.5, then 0 … 3 in turn.
        let step = |z: Complex| {
            Some(Complex::new(if z.re == 0.5 { 0.0 } else { (z.re + 1.0) % 4.0 }, 0.0))
        };
        let start = Complex::new(0.5, 0.0);
        for iterations in 1..100 {
            let orbit = Orbit::follow(start, 9.0, iterations, step, |_, _| false);
            assert_eq!(orbit.last.re, f64::from((iterations - 1) % 4), "{iterations}");
            assert_eq!((orbit.least, orbit.left_after), (0.0, None));
        }
    }
}
