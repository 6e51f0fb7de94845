//! Closed formulas for the roots of a parabola or a cubic.
//!
//! **Out:** all changes of sign, in order, each with an approximate position and between two positions with
//! certain signs. **Invariant:** a result is returned only if the signs at the extrema, and beyond all roots,
//! prove that there are no others.

use smallvec::SmallVec;

use super::{Change, Polynomial, U, value};
use crate::math::elementary::cbrt;

/// The approximate position of each change, and the positions that it lies between.
pub type Guesses = SmallVec<[(f64, Change); 3]>;

impl<const ROOM: usize> Polynomial<ROOM> {
    /// Returns the changes of sign; `None` if the degree is not 2 or 3, or if the signs at the ends or the
    /// extrema are inconclusive.
    pub(super) fn by_formula(&self) -> Option<Guesses> {
        match self.degree {
            2 => self.of_parabola(),
            3 => self.of_cubic(),
            _ => None,
        }
    }

    fn of_parabola(&self) -> Option<Guesses> {
        let [c, b, a, ..] = self.values[..] else { return None };
        let opens_up = a > 0.0;
        let outside = if opens_up { 1 } else { -1 };
        let middle = -0.5 * b / a;
        let discriminant = b * b - 4.0 * a * c;
        let root = discriminant.max(0.0).sqrt();
        // Both half as far beyond each root as they are apart.
        let width = root / a.abs();
        let (low, high) = (middle - width, middle + width);
        if self.sign(low) != outside || self.sign(high) != outside {
            return None;
        }
        if self.sign(middle) != -outside {
            return Some(Guesses::new());
        }
        // The farther root first: nothing cancels.
        let q = -0.5 * (b + root.copysign(b));
        let (one, other) = (q / a, c / q);
        let (first, last) = if one < other { (one, other) } else { (other, one) };
        let sides = [
            (first, Change { low, high: middle, rising: !opens_up }),
            (last, Change { low: middle, high, rising: opens_up }),
        ];
        (first.is_finite() && last.is_finite()).then(|| sides.into_iter().collect())
    }

    /// Changes of sign of a cubic. Shifted to its inflection and scaled by the distance of its extrema from
    /// there, it is y³ ∓ 3y + 2r.
    ///
    /// **Source:** W. Press and others, *Numerical Recipes in C* (1992), § 5.6 (Cardano's formula); the three
    /// roots by their distance from where two of them would coincide.
    fn of_cubic(&self) -> Option<Guesses> {
        let [_, c, b, a, ..] = self.values[..] else { return None };
        let middle = -b / (3.0 * a);
        let turn = middle * middle - c / (3.0 * a);
        let width = turn.abs().sqrt();
        let r = 0.5 * value(&self.values[..=3], middle) / (a * width * turn.abs());
        let outside = if a > 0.0 { 1 } else { -1 };
        let place = |y: f64| middle + width * y;
        let sign = |y: f64| self.sign(place(y)) * outside;
        let change = |low: f64, guess: f64, high: f64| {
            let rising = sign(low) < 0;
            let change = Change { low: place(low), high: place(high), rising: rising == (a > 0.0) };
            (sign(low) * sign(high) < 0).then_some((place(guess), change))
        };
        let one = |root: Option<(f64, Change)>| root.map(|root| Guesses::from_iter([root]));
        let far = |square: f64| cbrt(r.abs() + square.sqrt());
        if turn < 0.0 {
            let far = far(r * r + 1.0);
            let y = (1.0 / far - far).copysign(-r);
            let reach = 1.0 + 2.0 * y.abs();
            return one(change(-reach, y, reach));
        }
        // Where it turns is off by rounding, and there it goes this much farther than where it was looked at.
        let off = 8.0 * U * (middle.abs() + width + (middle * middle + (c / a).abs()) / width);
        let farther = 3.0 * a.abs() * width * off * off;
        let sign_of_turn = |y: f64| self.sign_beyond(farther, place(y)) * outside;
        match (sign_of_turn(-1.0), sign_of_turn(1.0)) {
            (1, -1) => {
                let [first, second, third] = three_roots(r);
                let roots = [
                    change(-2.25, first, -1.0)?,
                    change(-1.0, second, 1.0)?,
                    change(1.0, third, 2.25)?,
                ];
                Some(Guesses::from_iter(roots))
            }
            (before, behind) if before * behind > 0 => {
                let far = far(r * r - 1.0);
                let y = far + 1.0 / far;
                if before > 0 {
                    one(change(-2.0 * y, -y, -1.0))
                } else {
                    one(change(1.0, y, 2.0 * y))
                }
            }
            _ => None,
        }
    }
}

/// Returns the roots of y³ − 3y + 2r for |r| ≤ 1, in order, to about 1/100.
fn three_roots(r: f64) -> [f64; 3] {
    // At 1 two of them meet in 1.
    let apart = (1.0 - r.abs()).max(0.0).sqrt();
    let alone = -1.732 - 0.268 * r.abs();
    let (near, far) =
        (1.0 - apart * (0.8165 + 0.1835 * apart), 1.0 + apart * (0.8165 - 0.0844 * apart));
    if r < 0.0 { [-far, -near, -alone] } else { [alone, near, far] }
}
