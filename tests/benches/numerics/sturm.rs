//! Real roots of a polynomial in 320 bits, counted by Sturm's theorem.

use std::cmp::Ordering;

use super::wide::Wide;

/// By Horner's rule; the coefficient of 1 comes first.
fn value(polynomial: &[Wide], t: &Wide) -> Wide {
    polynomial.iter().rev().fold(Wide::zero(), |sum, c| sum * t + c)
}

/// Without powers that are not there.
fn trimmed(mut polynomial: Vec<Wide>) -> Vec<Wide> {
    while polynomial.last().is_some_and(Wide::is_zero) {
        polynomial.pop();
    }
    polynomial
}

/// The polynomial, its derivative, and the negated rest of each division by the next.
fn chain(polynomial: Vec<Wide>) -> Vec<Vec<Wide>> {
    let derivative = polynomial.iter().enumerate().skip(1);
    let derivative = derivative.map(|(k, c)| c * &Wide::of(k as f64)).collect();
    let mut chain = vec![polynomial, derivative];
    loop {
        let [.., dividend, divisor] = chain.as_slice() else { return chain };
        if divisor.len() < 2 {
            return chain;
        }
        let mut rest = dividend.clone();
        while rest.len() >= divisor.len() {
            let shift = rest.len() - divisor.len();
            let (top, lead) = (&rest[rest.len() - 1], &divisor[divisor.len() - 1]);
            let factor = top.clone() / lead;
            for (i, c) in divisor.iter().enumerate() {
                rest[shift + i] = &rest[shift + i] - &(&factor * c);
            }
            rest.pop();
        }
        let rest = trimmed(rest);
        if rest.is_empty() {
            return chain;
        }
        chain.push(rest.iter().map(|c| -c).collect());
    }
}

fn changes(chain: &[Vec<Wide>], t: &Wide) -> usize {
    let signs = chain.iter().map(|polynomial| value(polynomial, t).sign());
    let signs: Vec<Ordering> = signs.filter(|sign| sign.is_ne()).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// Halvings before Newton's steps, which then double the digits.
const HALVINGS: usize = 24;
/// Halvings after which two roots are one.
const ALL: usize = 300;

/// The roots between two places where there is none, in order; such as coincide count as one.
pub fn roots(polynomial: &[Wide], (low, high): &(Wide, Wide)) -> Vec<Wide> {
    let polynomial = trimmed(polynomial.to_vec());
    if polynomial.len() < 2 {
        return Vec::new();
    }
    let chain = chain(polynomial);
    let ends = |t: &Wide| (t.clone(), changes(&chain, t));
    let mut parts = vec![(ends(low), ends(high), 0)];
    let mut found = Vec::new();
    while let Some((low, high, halvings)) = parts.pop() {
        match low.1.saturating_sub(high.1) {
            0 => {}
            1 => found.push(alone(&chain, low.0, high.0)),
            _ if halvings > ALL => found.push(low.0),
            _ => {
                let middle = ends(&middle(&low.0, &high.0));
                parts.push((middle.clone(), high, halvings + 1));
                parts.push((low, middle, halvings + 1));
            }
        }
    }
    found
}

fn middle(low: &Wide, high: &Wide) -> Wide {
    (low + high) * &Wide::of(0.5)
}

/// The root that stands alone between two places.
fn alone(chain: &[Vec<Wide>], mut low: Wide, mut high: Wide) -> Wide {
    let before = changes(chain, &low);
    let start = value(&chain[0], &low).sign();
    // Where it only touches 0, the signs tell nothing.
    let crosses = start != value(&chain[0], &high).sign();
    let mut halve = |times: usize| {
        for _ in 0..times {
            let middle = middle(&low, &high);
            let is_before = match crosses {
                true => value(&chain[0], &middle).sign() == start,
                false => changes(chain, &middle) == before,
            };
            *(if is_before { &mut low } else { &mut high }) = middle;
        }
        (low.clone(), high.clone())
    };
    let (low, high) = halve(HALVINGS);
    let mut t = middle(&low, &high);
    for _ in 0..6 {
        let slope = value(&chain[1], &t);
        if slope.is_zero() {
            break;
        }
        t = &t - &(value(&chain[0], &t) / &slope);
    }
    if low <= t && t <= high { t } else { halve(ALL).0 }
}
