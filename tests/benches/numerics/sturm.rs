//! Real roots of a polynomial in 320 bits, counted by Sturm's theorem.

use std::cmp::Ordering;

use crate::wide::Wide;

fn value(polynomial: &[Wide], t: &Wide) -> Wide {
    polynomial.iter().rev().fold(Wide::zero(), |sum, c| sum * t + c)
}

/// The polynomial, its derivative, and the negated rest of each division by the next.
fn chain(polynomial: &[Wide]) -> Vec<Vec<Wide>> {
    let derivative = polynomial.iter().enumerate().skip(1);
    let derivative = derivative.map(|(k, c)| c * &Wide::of(k as f64)).collect();
    let mut chain = vec![polynomial.to_vec(), derivative];
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
        chain.push(rest.iter().map(|c| -c).collect());
    }
}

fn changes(chain: &[Vec<Wide>], t: &Wide) -> usize {
    let signs = chain.iter().map(|polynomial| value(polynomial, t).sign());
    let signs: Vec<Ordering> = signs.filter(|sign| sign.is_ne()).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// The least root between two places where there is none, if there is one, and how many there are.
pub fn least_root(polynomial: &[Wide], (low, high): &(Wide, Wide)) -> (Option<Wide>, usize) {
    let chain = chain(polynomial);
    let (mut low, mut high) = (low.clone(), high.clone());
    let (before, after) = (changes(&chain, &low), changes(&chain, &high));
    let count = before.saturating_sub(after);
    if count == 0 {
        return (None, 0);
    }
    let half = Wide::of(0.5);
    // Until it stands alone, and is known to the digits of an `f64`.
    for _ in 0..60 {
        let middle = (&low + &high) * &half;
        if changes(&chain, &middle) < before {
            high = middle;
        } else {
            low = middle;
        }
    }
    let mut t = (low + &high) * &half;
    for _ in 0..3 {
        let slope = value(&chain[1], &t);
        if !slope.is_zero() {
            t = &t - &(value(polynomial, &t) / &slope);
        }
    }
    (Some(t), count)
}
