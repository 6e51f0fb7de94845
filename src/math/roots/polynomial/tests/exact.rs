//! Quartics of exact coefficients against Sturm's sequence in exact arithmetic.
//!
//! **Source:** J. C. F. Sturm (1835), as in G. Collins, R. Loos, "Real zeros of polynomials", in *Computer
//! Algebra* (1982); the cases: `docs/numerics.md`, row 27.

use std::cmp::Ordering;

use dashu_float::{FBig, round::mode::Zero};

use super::*;
use crate::math::elementary::cbrt;

type Exact = FBig<Zero, 2>;

fn exactly(values: &[f64]) -> Vec<Exact> {
    let exact = |value: &f64| Exact::try_from(*value).expect("a finite number");
    values.iter().map(|value| exact(value).with_precision(0).value()).collect()
}

fn sign(value: &Exact) -> i8 {
    match value.partial_cmp(&Exact::ZERO) {
        Some(Ordering::Less) => -1,
        Some(Ordering::Greater) => 1,
        _ => 0,
    }
}

fn without_leading_zeros(mut values: Vec<Exact>) -> Vec<Exact> {
    while values.last().is_some_and(|last| sign(last) == 0) {
        values.pop();
    }
    values
}

/// A positive multiple of what is left of `a` divided by `b`, negated.
fn rest_negated(mut a: Vec<Exact>, b: &[Exact]) -> Vec<Exact> {
    let Some(lead) = b.last() else { return Vec::new() };
    while a.len() >= b.len() {
        let (top, shift) = (a[a.len() - 1].clone(), a.len() - b.len());
        let by = if sign(lead) > 0 { top } else { -top };
        let stretch = if sign(lead) > 0 { lead.clone() } else { -lead.clone() };
        for (k, value) in a.iter_mut().enumerate() {
            *value = &*value * &stretch;
            if k >= shift {
                *value = &*value - &by * &b[k - shift];
            }
        }
        a = without_leading_zeros(a);
    }
    a.into_iter().map(|value| -value).collect()
}

/// How many real roots there are, each counted once.
fn count_of_roots(values: &[f64]) -> usize {
    let first = without_leading_zeros(exactly(values));
    let factor = |k: usize| exactly(&[k as f64]).remove(0);
    let slope = first.iter().enumerate().skip(1).map(|(k, value)| value * factor(k)).collect();
    let mut sequence = vec![first, slope];
    while let [.., before, last] = &sequence[..]
        && !last.is_empty()
    {
        let next = rest_negated(before.clone(), last);
        sequence.push(next);
    }
    let changes = |behind: bool| {
        let ends = sequence.iter().filter_map(|values| {
            let odd = values.len() % 2 == 0;
            values.last().map(|lead| if odd && !behind { -sign(lead) } else { sign(lead) })
        });
        let ends: Vec<i8> = ends.collect();
        ends.windows(2).filter(|pair| pair[0] != pair[1]).count()
    };
    changes(false) - changes(true)
}

/// |p(s)| over Σ |cₖ·sᵏ|.
fn depth(values: &[f64], s: f64) -> f64 {
    let s = exactly(&[s]).remove(0);
    let (mut sum, mut size) = (Exact::ZERO, Exact::ZERO);
    let mut power = exactly(&[1.0]).remove(0);
    for value in exactly(values) {
        let term = value * &power;
        size += if sign(&term) < 0 { -term.clone() } else { term.clone() };
        sum += term;
        power *= &s;
    }
    if sign(&size) == 0 {
        return 0.0;
    }
    let few = |value: Exact| value.with_precision(64).value();
    (few(sum) / few(size)).to_f64().value().abs()
}

/// The least depth where the polynomial turns: of a double root 0, and of two roots δ apart about δ²/4.
fn shallowest(values: &[f64]) -> f64 {
    let reversed: Vec<f64> = values.iter().rev().copied().collect();
    let near = turning_points(values, -1.0, 1.0).into_iter();
    let far = turning_points(&reversed, -1.0, 1.0).into_iter().map(|w| 1.0 / w);
    let places = near.chain(far.filter(|s| s.is_finite()));
    places.map(|s| depth(values, s)).fold(f64::INFINITY, f64::min)
}

/// Coefficients of nine kinds of roots, and of each set of coefficients that are 0.
fn family(random: &mut Random, kind: usize) -> [f64; 5] {
    let n = |random: &mut Random| random.number(-2.0, 2.0);
    let [a, b, c, d] = [0; 4].map(|_| n(random));
    let pair = (n(random), random.number(0.2, 2.0));
    let other = (n(random), random.number(0.2, 2.0));
    let (close, far) = (random.size(-12.0, -3.0), random.size(0.0, 14.0));
    let of = |roots: &[f64], pairs: &[(f64, f64)]| {
        let values = product(roots, pairs).values;
        [0, 1, 2, 3, 4].map(|k| values[k])
    };
    match kind {
        0 => of(&[a, b, c, d], &[]),
        1 => of(&[a, b], &[pair]),
        2 => of(&[], &[pair, other]),
        3 => of(&[a, a, b, c], &[]),
        4 => of(&[a, a, a, b], &[]),
        5 => of(&[a, a, a, a], &[]),
        6 => of(&[a, a + close, b, c], &[]),
        7 => of(&[a, a * far, b * cbrt(far), d], &[]),
        8 => of(&[a, b], &[(c, close)]),
        _ => [0, 1, 2, 3, 4].map(|k| match (kind >> k) & 1 {
            0 => 0.0,
            _ => n(random) * [1.0, random.size(-7.0, 7.0)][random.below(2)],
        }),
    }
}

#[test]
fn quartics_of_every_kind_and_scale_have_as_many_roots_as_sturm_counts() {
    let mut random = Random(2707);
    let (mut told, mut roots) = (0, 0);
    for at in 0..tries_in(10) {
        let kind = if at % 2 == 0 { random.below(9) } else { 32 + random.below(32) };
        let values = family(&mut random, kind);
        let depth_of_turns = shallowest(&values);
        // s/2ᵏ, all of it times what keeps the middle one.
        let power = [random.below(601) as i32 - 300, 0, 300, -300][random.below(4)];
        let scaled: Vec<f64> =
            (0..5).map(|k| values[k as usize] * power_of_two(power * (2 - k))).collect();
        let mut coefficients = [0.0; MOST + 1];
        coefficients[..5].copy_from_slice(&scaled);
        let polynomial = Polynomial::new(coefficients, [0.0; MOST + 1]);
        let found = polynomial.all_roots(power_of_two(power), 0.0);
        for root in &found {
            // Three roots at 0 at once are come as near as this, and have no other size to be held against.
            let is_zero = root.s.abs() < power_of_two(power - 64);
            let left = depth(&scaled, root.s);
            let message = || format!("{left:e} {root:?} {values:?} 2^{power}");
            assert!(is_zero || left < 16.0 * f64::EPSILON, "{}", message());
            assert!(root.s.abs() <= root.error || !is_zero || values[0] != 0.0, "{}", message());
        }
        // Two roots that stand 10⁻⁷ apart, as far as rounding the coefficients leaves them where they are.
        let known = count_of_roots(&values);
        if depth_of_turns > 0.25e-14 {
            assert_eq!(
                found.len(),
                known,
                "{kind} 2^{power} {depth_of_turns:e} {values:?} {found:?}"
            );
            (told, roots) = (told + 1, roots + known);
        } else {
            assert!(found.len() <= known, "{kind} 2^{power} {values:?} {found:?}");
        }
    }
    assert!(told > tries_in(20) && roots > told, "{told} {roots}");
}

#[test]
fn sturm_counts_what_is_known() {
    assert_eq!(count_of_roots(&[-1.0, 0.0, 0.0, 0.0, 1.0]), 2);
    assert_eq!(count_of_roots(&[-16.0, 0.0, 0.0, 0.0, 1.0]), 2);
    assert_eq!(count_of_roots(&[-2.0, 0.0, 1.0, 0.0, 1.0]), 2);
    assert_eq!(count_of_roots(&[-5.0, 4.0, 0.0, 0.0, 1.0]), 2);
    assert_eq!(count_of_roots(&[24.0, -50.0, 35.0, -10.0, 1.0]), 4);
    assert_eq!(count_of_roots(&[1.0, -2.0, 1.0]), 1);
    assert_eq!(count_of_roots(&[0.0, 0.0, 3.0]), 1);
    assert_eq!(count_of_roots(&[3.0]), 0);
}
