//! Roots against those that are known.

mod exact;

use super::turning::order_without_roots;
use super::*;
use crate::math::random::{Random, tries_in};

/// At most one for each degree.
type Roots = SmallVec<[Root; 6]>;

impl<const ROOM: usize> Polynomial<ROOM> {
    fn all_roots(&self, size: f64, tolerance: f64) -> Roots {
        let between = (f64::NEG_INFINITY, f64::INFINITY);
        let mut all = Roots::new();
        self.roots(&Asked { size, end: f64::INFINITY, tolerance, between }, &mut |root| {
            all.push(root);
            true
        });
        all
    }
}

/// The product of (s − root) for all roots and of (s − a)² + b² for all pairs.
fn product(roots: &[f64], pairs: &[(f64, f64)]) -> Polynomial {
    let (mut values, mut sizes) = ([0.0; MOST + 1], [0.0; MOST + 1]);
    (values[0], sizes[0]) = (1.0, 1.0);
    let mut times = |factor: [f64; 3]| {
        for k in (0..=MOST).rev() {
            let term = |list: &Coefficients, j: usize| if k >= j { list[k - j] } else { 0.0 };
            let all = |list: &Coefficients, factor: [f64; 3]| {
                (0..3).map(|j| factor[j] * term(list, j)).sum::<f64>()
            };
            (values[k], sizes[k]) = (all(&values, factor), all(&sizes, factor.map(f64::abs)));
        }
    };
    roots.iter().for_each(|root| times([-root, 1.0, 0.0]));
    pairs.iter().for_each(|(a, b)| times([a * a + b * b, -2.0 * a, 1.0]));
    Polynomial::new(values, sizes.map(|size| size * 64.0 * U))
}

/// Each root that stands alone is found, within its bound; at most those that do not are missing, in
/// pairs.
fn assert_finds(roots: &[f64], pairs: &[(f64, f64)], size: f64) -> usize {
    let mut roots = roots.to_vec();
    roots.sort_by(f64::total_cmp);
    let polynomial = product(&roots, pairs);
    let found = polynomial.all_roots(size, 0.0);
    assert_eq!(found.len(), assert_fits(&polynomial.all_roots(size, 1e-4 * size), &roots).len());
    assert_eq!(found.len() % 2, roots.len() % 2, "{found:?} {roots:?} {pairs:?}");
    assert_fits(&found, &roots).len()
}

/// The roots found are in order, go up and down in turn, and each has a true one within its bound.
fn assert_fits<'a>(found: &'a Roots, roots: &[f64]) -> &'a Roots {
    for (i, root) in found.iter().enumerate() {
        assert_eq!(root.rising, (found.len() - i) % 2 == 1, "{found:?} {roots:?}");
        let near = roots.iter().any(|true_one| (true_one - root.s).abs() <= root.error);
        assert!(near, "{root:?} {roots:?}");
        assert!(i == 0 || found[i - 1].s <= root.s, "{found:?}");
    }
    found
}

#[test]
fn roots_that_stand_apart_are_all_found() {
    let mut random = Random(71);
    for _ in 0..tries_in(5) {
        let count = 1 + random.below(8);
        let size = random.size(-6.0, 6.0);
        let apart = |i: usize, random: &mut Random| {
            (i as f64 - count as f64 * 0.5 + random.number(0.0, 0.5)) * size
        };
        let roots: Vec<f64> = (0..count).map(|i| apart(i, &mut random)).collect();
        let pair =
            |random: &mut Random| (random.number(-3.0, 3.0) * size, random.number(0.5, 2.0) * size);
        let pairs: Vec<_> = (0..random.below(3)).map(|_| pair(&mut random)).collect();
        let found = assert_finds(&roots, &pairs, size);
        assert_eq!(found, count, "{roots:?} {pairs:?}");
    }
}

/// Coefficients, and the roots with how far they may be off.
type Family<'a> = (&'a [f64], &'a [(f64, f64)]);

#[test]
fn the_families_of_quartic_roots_are_told() {
    let mut random = Random(72);
    for _ in 0..tries_in(5) {
        let size = random.size(-9.0, 9.0);
        let n = |random: &mut Random| random.number(-2.0, 2.0) * size;
        let [a, b, c, d] = [0; 4].map(|_| n(&mut random));
        let pair = (n(&mut random), random.number(0.2, 2.0) * size);
        let other = (n(&mut random), random.number(0.2, 2.0) * size);
        let close = size * random.size(-12.0, -3.0);
        let far = random.size(0.0, 14.0);
        let families: [Family; 9] = [
            (&[a, b, c, d], &[]),
            (&[a, b], &[pair]),
            (&[], &[pair, other]),
            (&[a, a, b, c], &[]),
            (&[a, a, a, b], &[]),
            (&[a, a, a, a], &[]),
            (&[a, a + close, b], &[]),
            (&[a, a * far, b * far, d], &[]),
            (&[0.0, 0.0, a, b], &[]),
        ];
        for (roots, pairs) in families {
            assert_finds(roots, pairs, size);
        }
        assert_eq!(assert_finds(&[a], &[pair], size), 1);
    }
}

#[test]
fn what_touches_zero_is_no_root_and_what_crosses_it_thrice_at_once_is_one() {
    assert!(product(&[1.0, 1.0], &[]).all_roots(1.0, 0.0).is_empty());
    assert!(product(&[0.3; 4], &[]).all_roots(1.0, 0.0).is_empty());
    let thrice = product(&[0.3; 3], &[]).all_roots(1.0, 0.0);
    assert_eq!(thrice.len(), 1);
    assert!((thrice[0].s - 0.3).abs() <= thrice[0].error && thrice[0].error < 1e-3);
}

#[test]
fn the_line_has_no_end() {
    for far in [1e3, 1e9, 1e12] {
        let found = product(&[-far, 0.5, far], &[]).all_roots(1.0, 0.0);
        assert_eq!(found.len(), 3, "{far}: {found:?}");
        assert!((found[2].s - far).abs() <= found[2].error && found[2].error < far * 1e-12);
        assert!((found[0].s + far).abs() <= found[0].error && found[0].error < far * 1e-12);
    }
}

#[test]
fn nothing_is_found_of_what_may_be_zero_everywhere() {
    assert!(Polynomial::new([0.0; 16], [0.0; 16]).all_roots(1.0, 0.0).is_empty());
    assert!(Polynomial::new([1e-17; 16], [1e-16; 16]).all_roots(1.0, 0.0).is_empty());
    assert!(Polynomial::new([f64::NAN; 16], [0.0; 16]).all_roots(1.0, 0.0).is_empty());
    assert!(Polynomial::new([1e300; 16], [0.0; 16]).all_roots(f64::INFINITY, 0.0).is_empty());
}

#[test]
fn fifteen_roots_are_found() {
    let roots: Vec<f64> = (-7..=7).map(|i| f64::from(i) * 0.5).collect();
    assert_eq!(assert_finds(&roots, &[], 1.0), 15);
}

#[test]
fn a_polynomial_turns_where_its_derivative_is_zero_whichever_orders_are_left_out() {
    let mut random = Random(72);
    let (mut turned, mut even) = (0, 0);
    for _ in 0..tries_in(5) {
        let count = random.below(5);
        let apart = |i: usize, random: &mut Random| i as f64 - 1.0 + random.number(0.0, 0.5);
        let turns: Vec<f64> = (0..count).map(|i| apart(i, &mut random)).collect();
        let pairs = [(random.number(-1.0, 2.0), random.number(0.1, 2.0))];
        let derivative = product(&turns, &pairs[..random.below(2)]);
        let term = |k: usize| if k == 0 { 0.0 } else { derivative.values[k - 1] / k as f64 };
        let values: Vec<f64> = (0..=derivative.degree + 1).map(term).collect();
        let found = turning_points(&values, -0.75, 0.75);
        let expected: Vec<f64> = turns.into_iter().filter(|turn| turn.abs() < 0.75).collect();
        assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
        let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-10;
        assert!(found.iter().zip(&expected).all(near), "{found:?} {expected:?}");
        turned += found.len();
        even += usize::from(order_without_roots(&values, -0.75, 0.75) == 1);
    }
    assert!(turned > 1000 && even > 100, "{turned} {even}");
}

#[test]
fn a_polynomial_has_the_same_roots_with_room_for_more_terms() {
    let mut random = Random(87);
    let mut found = 0;
    for _ in 0..tries_in(4) {
        let roots: Vec<f64> = (0..random.below(5)).map(|_| random.number(-1.0, 1.0)).collect();
        let wide = product(&roots, &[]);
        let values: [f64; 5] = std::array::from_fn(|k| wide.values[k]);
        let narrow = Polynomial {
            values,
            slack: std::array::from_fn(|k| wide.slack[k]),
            degree: wide.degree,
        };
        let size = random.size(-1.0, 1.0);
        assert_eq!(narrow.all_roots(size, 0.0), wide.all_roots(size, 0.0), "{wide:?}");
        found += wide.all_roots(size, 0.0).len();
    }
    assert!(found > tries_in(4), "{found}");
}
