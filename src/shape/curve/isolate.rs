//! Isolates the roots of a polynomial that is given by its Bézier coefficients.
//!
//! **In:** the coefficients, for u from 0 to 1, and an error bound of each. **Out:** intervals with one root.
//! **Invariant:** the signs at both ends of an interval are certain, and there is exactly one root between them.

/// An interval in which a polynomial has one root.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Isolated<const N: usize> {
    pub from: f64,
    pub to: f64,
    /// The Bézier coefficients between them.
    pub coefficients: [f64; N],
}

impl<const N: usize> Isolated<N> {
    /// Whether the polynomial is positive at its end.
    #[inline]
    pub fn rises(&self) -> bool {
        self.coefficients[N - 1] > 0.0
    }

    /// Returns the ends, first that where the polynomial is positive.
    #[inline]
    pub fn ends(&self) -> (f64, f64) {
        if self.rises() { (self.to, self.from) } else { (self.from, self.to) }
    }

    /// Returns where the root would be if the polynomial were linear.
    #[inline]
    pub fn on_chord(&self) -> f64 {
        let (first, last) = (self.coefficients[0], self.coefficients[N - 1]);
        self.from + (self.to - self.from) * (first / (first - last))
    }
}

impl Isolated<4> {
    /// Returns about where the root is. **Method:** three Newton steps from the root of the chord.
    #[inline]
    pub fn near_root(&self) -> f64 {
        let [a, b, c, d] = self.coefficients;
        let (linear, quadratic, cubic) =
            (3.0 * (b - a), 3.0 * ((c - b) - (b - a)), (d - a) - 3.0 * (c - b));
        let step = |t: f64| {
            let value = a + t * (linear + t * (quadratic + t * cubic));
            let slope = linear + t * (2.0 * quadratic + t * 3.0 * cubic);
            (t - value / slope).clamp(0.0, 1.0)
        };
        self.from + (self.to - self.from) * step(step(step(a / (a - d))))
    }
}

/// Number of times that an interval is halved. Affects only the running time.
const HALVINGS: u32 = 7;

/// Calls `found` with an interval for each root, in order. Returns `false` where the coefficients leave doubt, as
/// beside a double root; what was found until then is to be dropped. `error` must include 64 roundings of the greatest
/// coefficient, for halving.
///
/// **Method:** a polynomial has at most as many roots as its Bézier coefficients have changes of sign, and one if
/// they have one; else halves of it are looked at (de Casteljau).
#[inline]
pub fn isolate<const N: usize>(
    coefficients: [f64; N],
    error: f64,
    found: &mut impl FnMut(&Isolated<N>),
) -> bool {
    let whole = Isolated { from: 0.0, to: 1.0, coefficients };
    match changes(&whole, error) {
        Changes::None => true,
        Changes::One => {
            found(&whole);
            true
        }
        Changes::Several => isolate_halves(&whole, error, HALVINGS, found),
        Changes::Untold => false,
    }
}

enum Changes {
    None,
    One,
    Several,
    /// The sign at an end is uncertain.
    Untold,
}

#[inline(always)]
fn changes<const N: usize>(part: &Isolated<N>, error: f64) -> Changes {
    let all = &part.coefficients;
    let (is_above, is_below) = (|value: &f64| *value > error, |value: &f64| *value < -error);
    if all.iter().all(is_above) || all.iter().all(is_below) {
        return Changes::None;
    }
    let is_told = |value: &f64| is_above(value) || is_below(value);
    if !(is_told(&all[0]) && is_told(&all[N - 1])) {
        return Changes::Untold;
    }
    let changes = (1..N).filter(|i| is_above(&all[i - 1]) != is_above(&all[*i])).count();
    if changes == 1 && all.iter().all(is_told) { Changes::One } else { Changes::Several }
}

#[inline(never)]
fn isolate_halves<const N: usize>(
    part: &Isolated<N>,
    error: f64,
    halvings: u32,
    found: &mut impl FnMut(&Isolated<N>),
) -> bool {
    if halvings == 0 {
        return false;
    }
    halves(part).iter().all(|half| match changes(half, error) {
        Changes::None => true,
        Changes::One => {
            found(half);
            true
        }
        Changes::Several => isolate_halves(half, error, halvings - 1, found),
        Changes::Untold => false,
    })
}

#[inline]
fn halves<const N: usize>(part: &Isolated<N>) -> [Isolated<N>; 2] {
    let middle = 0.5 * (part.from + part.to);
    let (mut before, mut behind) = (*part, *part);
    for step in 0..N {
        before.coefficients[step] = behind.coefficients[0];
        for i in 0..N - 1 - step {
            behind.coefficients[i] = 0.5 * (behind.coefficients[i] + behind.coefficients[i + 1]);
        }
    }
    before.to = middle;
    behind.from = middle;
    [before, behind]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    /// Evaluates by de Casteljau's scheme.
    fn value<const N: usize>(mut coefficients: [f64; N], u: f64) -> f64 {
        for step in 1..N {
            for i in 0..N - step {
                coefficients[i] += u * (coefficients[i + 1] - coefficients[i]);
            }
        }
        coefficients[0]
    }

    #[test]
    fn each_root_is_alone_in_its_interval() {
        let mut random = Random(5);
        let mut several = 0;
        for _ in 0..tries() {
            let coefficients: [f64; 7] = std::array::from_fn(|_| random.number(-1.0, 1.0));
            let mut found = Vec::new();
            if !isolate(coefficients, 1e-12, &mut |part| found.push(*part)) {
                continue;
            }
            several += u32::from(found.len() > 1);
            let is_above = |u: f64| value(coefficients, u) > 0.0;
            let places = || (0..=1000).map(|i| f64::from(i) / 1000.0);
            let changes =
                places().zip(places().skip(1)).filter(|(a, b)| is_above(*a) != is_above(*b));
            assert!(found.len() >= changes.count(), "{coefficients:?} {found:?}");
            for part in &found {
                let (above, below) = part.ends();
                assert!(is_above(above) && !is_above(below), "{coefficients:?} {part:?}");
                let middle = 0.5 * (part.from + part.to);
                let off = value(part.coefficients, 0.5) - value(coefficients, middle);
                assert!(off.abs() < 1e-14, "{coefficients:?} {part:?}");
            }
        }
        assert!(several > 0);
    }

    #[test]
    fn a_double_root_is_told_to_neither_side() {
        // (u − 1/3)², ± less than the error.
        for off in [-1e-12, 0.0, 1e-12] {
            let square = [1.0 / 9.0 + off, -2.0 / 9.0 + off, 4.0 / 9.0 + off];
            assert!(!isolate(square, 1e-11, &mut |_| {}));
        }
        assert!(isolate(
            [1.0 / 9.0 + 0.01, -2.0 / 9.0 + 0.01, 4.0 / 9.0 + 0.01],
            1e-11,
            &mut |_| { panic!("it has none") }
        ));
    }

    #[test]
    fn coefficients_that_are_no_numbers_tell_nothing() {
        assert!(!isolate([1.0, f64::NAN, 1.0], 1e-9, &mut |_| {}));
        assert!(!isolate([1.0, 1.0], f64::NAN, &mut |_| {}));
    }
}
