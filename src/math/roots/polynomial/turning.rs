//! Extrema of a polynomial: the roots of its derivative, found recursively from the last derivative up.
//!
//! **Source:** C. Yuksel, "High-performance polynomial root finding for graphics", Proceedings of the ACM on
//! Computer Graphics 5 (2022).

use smallvec::SmallVec;

use super::{Change, MOST, U, root_near, value};

/// Returns the lowest order of a derivative that certainly has a constant sign in a range: its Bernstein
/// coefficients, which are the differences of those of the polynomial, have one sign.
///
/// **Source:** G. Farin, *Curves and Surfaces for CAGD* (2002), ch. 5.
pub(super) fn order_without_roots(values: &[f64], low: f64, high: f64) -> usize {
    let degree = values.len() - 1;
    let mut forms = [0.0; MOST + 1];
    let forms = &mut forms[..=degree];
    forms.copy_from_slice(values);
    for first in 0..degree {
        for k in (first..degree).rev() {
            forms[k] += low * forms[k + 1];
        }
    }
    let (mut power, mut choices) = (1.0, 1.0);
    for (k, form) in forms.iter_mut().enumerate() {
        *form *= power / choices;
        power *= high - low;
        choices *= (degree - k) as f64 / (k + 1) as f64;
    }
    for first in 1..=degree {
        for k in (first..=degree).rev() {
            forms[k] += forms[k - 1];
        }
    }
    let mut rounding = 64.0 * U * forms.iter().fold(0.0, |most: f64, form| most.max(form.abs()));
    for order in 1..degree {
        for k in 0..=degree - order {
            forms[k] = forms[k + 1] - forms[k];
        }
        let forms = &forms[..=degree - order];
        rounding *= 2.0;
        let rises = forms.iter().all(|form| *form > rounding);
        if rises || forms.iter().all(|form| *form < -rounding) {
            return order;
        }
    }
    degree
}

/// Error of a turning point, relative to itself. As the polynomial is level there, its value is off by the square
/// of that, which is less than rounding.
const FINE: f64 = 1.0 / 68_719_476_736.0;

/// Returns the changes of sign of c + b·s + a·s² in a range, in order; `None` where squares overflow or vanish.
fn of_parabola([c, b, a]: [f64; 3], low: f64, high: f64) -> Option<SmallVec<[f64; 8]>> {
    let (square, product) = (b * b, 4.0 * a * c);
    let size = square.max(product.abs());
    if !(size > f64::MIN_POSITIVE / U && size < f64::MAX) {
        return None;
    }
    if square <= product {
        return Some(SmallVec::new());
    }
    let half = -0.5 * (b + (square - product).sqrt().copysign(b));
    let (one, other) = (half / a, c / half);
    let both = if one < other { [one, other] } else { [other, one] };
    Some(both.into_iter().filter(|s| low < *s && *s < high).collect())
}

/// Returns the roots of the derivative in a range, in order, to about `FINE`.
pub fn turning_points(values: &[f64], low: f64, high: f64) -> SmallVec<[f64; 8]> {
    let degree = values.len() - 1;
    let mut points: SmallVec<[f64; 8]> = SmallVec::new();
    // Derivatives of falling order, from the first below one that has no roots; each over the factorial of its
    // order, which has the same ones. That of a parabola, a formula may do without.
    for order in (1..order_without_roots(values, low, high)).rev() {
        let mut derivative = [0.0; MOST + 1];
        let mut share = 1.0;
        for j in order..=degree {
            derivative[j - order] = share * values[j];
            share *= (j + 1) as f64 / (j + 1 - order) as f64;
        }
        let derivative = &derivative[..=degree - order];
        if let [c, b, a] = *derivative
            && let Some(both) = of_parabola([c, b, a], low, high)
        {
            points = both;
            continue;
        }
        let mut found: SmallVec<[f64; 8]> = SmallVec::new();
        let (mut from, mut below) = (low, value(derivative, low));
        for &to in points.iter().chain([&high]) {
            let above = value(derivative, to);
            if above == 0.0 && to < high {
                found.push(to);
            } else if (below < 0.0 && above > 0.0) || (below > 0.0 && above < 0.0) {
                let change = Change { low: from, high: to, rising: above > 0.0 };
                found.push(root_near(derivative, f64::NAN, change, 0.0, FINE));
            }
            (from, below) = (to, above);
        }
        points = found;
    }
    points
}
