//! Bernstein coefficients of a polynomial over a box; their minimum and maximum bound the polynomial.
//!
//! **In:** terms, a box; the axis along which to halve a net. **Out:** the sign that the polynomial certainly
//! has in the box; its variation along each axis. **Invariant:** each coefficient is within the net's error
//! bound, which grows with each halving.
//!
//! **Source:** J. Garloff, "The Bernstein algorithm", Interval Computations 2 (1993), pp. 154–168; halving by
//! P. de Casteljau's algorithm.

use super::super::U;

/// A coefficient, and the powers of the three coordinates.
pub type Term = (f64, [usize; 3]);
/// The range along each axis.
pub type Sides = [(f64, f64); 3];

/// Maximum number of roundings of a coefficient of the first net, relative to the size of its terms: 40 for
/// each of its three factors, 16 in each of three sums.
const ROUNDINGS: f64 = 256.0;
/// Minimum width of a cell, relative to the first box's half width. A power of two, so that the sides of all
/// cells are exact.
const NARROWEST: f64 = 1.0 / 1_099_511_627_776.0;

/// A polynomial over a part of a box.
#[derive(Debug, Clone)]
pub struct Net {
    /// Number of coefficients along each axis: one more than the highest power.
    counts: [usize; 3],
    /// The last axis is the innermost.
    values: Vec<f64>,
    /// The first box.
    first: Sides,
    /// The part of the first box, which goes from −1 to 1 along each axis.
    shares: Sides,
    /// Upper bound of all coefficients: the sum of the maxima of the terms in the first box.
    size: f64,
    /// Maximum number of roundings of a coefficient, relative to `size`.
    rounded: f64,
}

impl Net {
    pub fn new(terms: &[Term], sides: Sides) -> Self {
        let greatest = |axis: usize| terms.iter().map(|(_, powers)| powers[axis]).max();
        let counts = [0, 1, 2].map(|axis| greatest(axis).unwrap_or(0) + 1);
        let [x, y, z] = [0, 1, 2].map(|axis| powers(counts[axis], sides[axis]));
        let plane = counts[1] * counts[2];
        // Of each power of x, and of each of x and y, the sum of what is left of the terms.
        let mut rows = vec![0.0; counts[0] * plane];
        for &(term, [i, j, k]) in terms {
            let row = &mut rows[i * plane + j * counts[2]..][..counts[2]];
            add(row, &z[k], |factor| term * factor);
        }
        let mut planes = vec![0.0; counts[0] * plane];
        for (at, row) in rows.chunks_exact(counts[2]).enumerate() {
            let (i, j) = (at / counts[1], at % counts[1]);
            let sums = planes[i * plane..][..plane].chunks_exact_mut(counts[2]);
            for (sum, factor) in sums.zip(&y[j]) {
                add(sum, row, |value| value * factor);
            }
        }
        let mut values = vec![0.0; counts[0] * plane];
        for (i, part) in planes.chunks_exact(plane).enumerate() {
            for (sum, factor) in values.chunks_exact_mut(plane).zip(&x[i]) {
                add(sum, part, |value| value * factor);
            }
        }
        let far = sides.map(|(low, high)| low.abs().max(high.abs()));
        let size = terms.iter().map(|(term, powers)| {
            let factors = far.iter().zip(powers);
            factors.fold(term.abs(), |all, (far, n)| (0..*n).fold(all, |all, _| all * far))
        });
        let is_finite = values.iter().all(|value: &f64| value.is_finite());
        let size = if is_finite { size.sum() } else { f64::INFINITY };
        let shares = [(-1.0, 1.0); 3];
        Self { counts, values, first: sides, shares, size, rounded: ROUNDINGS }
    }

    /// Returns its position, within three roundings of the first box's sides.
    pub fn sides(&self) -> Sides {
        std::array::from_fn(|axis| {
            let (low, high) = self.first[axis];
            let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
            let place = |share: f64| middle + half * share;
            (place(self.shares[axis].0), place(self.shares[axis].1))
        })
    }

    /// Returns the sign of the polynomial throughout; `None` if it may change, or if rounding hides it.
    pub fn sign(&self) -> Option<bool> {
        let slack = self.size * (self.rounded * U) + f64::MIN_POSITIVE;
        let least = -greatest(&self.values, &self.values, |value, _| -value);
        let most = greatest(&self.values, &self.values, |value, _| value);
        match (least > slack, most < -slack) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }

    /// Returns whether the polynomial changes sign between the corners, whose values are coefficients.
    pub fn is_crossed(&self) -> bool {
        let mut signs = [false; 2];
        for corner in 0..8 {
            let end = |axis: usize| (corner >> axis & 1) * (self.counts[axis] - 1);
            let place = (end(0) * self.counts[1] + end(1)) * self.counts[2] + end(2);
            signs[usize::from(self.values[place] > 0.0)] = true;
        }
        signs == [true; 2]
    }

    /// Returns the axis along which neighbours differ most; `None` if it is too narrow to be halved.
    pub fn steepest(&self) -> Option<usize> {
        let is_wide = |axis: &usize| self.shares[*axis].1 - self.shares[*axis].0 > NARROWEST;
        let changes = (0..3).filter(is_wide).map(|axis| (axis, self.change(axis)));
        changes.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(axis, _)| axis)
    }

    /// Maximum difference of neighbours along an axis.
    fn change(&self, axis: usize) -> f64 {
        let stride = self.stride(axis);
        let lines = self.values.chunks_exact(self.counts[axis] * stride);
        lines.fold(0.0, |most: f64, line| {
            let last = line.len() - stride;
            most.max(greatest(&line[stride..], &line[..last], |a, b| (a - b).abs()))
        })
    }

    fn stride(&self, axis: usize) -> usize {
        self.counts[axis + 1..].iter().product()
    }

    /// Cost of halving it: an upper bound on the number of additions.
    pub fn price(&self) -> u64 {
        let longest = self.counts.into_iter().max().unwrap_or(1);
        (self.values.len() * longest / 2) as u64
    }

    /// Returns its two halves along an axis.
    pub fn halves(self, axis: usize) -> [Self; 2] {
        let (count, stride) = (self.counts[axis], self.stride(axis));
        let (mut lower, mut upper) = (self.clone(), self);
        let lines = upper.values.chunks_exact_mut(count * stride);
        for (upper, lower) in lines.zip(lower.values.chunks_exact_mut(count * stride)) {
            for level in 1..count {
                draw_together(&mut upper[..(count + 1 - level) * stride], stride);
                lower[level * stride..][..stride].copy_from_slice(&upper[..stride]);
            }
        }
        let (low, high) = lower.shares[axis];
        let middle = 0.5 * (low + high);
        lower.shares[axis].1 = middle;
        upper.shares[axis] = (middle, high);
        lower.rounded += count as f64;
        upper.rounded += count as f64;
        [lower, upper]
    }
}

/// Replaces each row but the last by the mean of itself and the next.
fn draw_together(rows: &mut [f64], stride: usize) {
    if stride == 1 {
        for place in 1..rows.len() {
            rows[place - 1] = 0.5 * (rows[place - 1] + rows[place]);
        }
        return;
    }
    let mut rows = rows.chunks_exact_mut(stride);
    let Some(mut row) = rows.next() else { return };
    for next in rows {
        for (value, next) in row.iter_mut().zip(&*next) {
            *value = 0.5 * (*value + next);
        }
        row = next;
    }
}

/// Maximum of a function over pairs, computed four at a time, so that none waits for the previous one.
fn greatest(a: &[f64], b: &[f64], of: impl Fn(f64, f64) -> f64) -> f64 {
    let mut most = [f64::NEG_INFINITY; 4];
    let mut take = |a: &[f64], b: &[f64]| {
        for (most, (a, b)) in most.iter_mut().zip(a.iter().zip(b)) {
            let value = of(*a, *b);
            *most = if value > *most { value } else { *most };
        }
    };
    let (fours, others) = (a.chunks_exact(4), b.chunks_exact(4));
    let (rest, other_rest) = (fours.remainder(), others.remainder());
    fours.zip(others).for_each(|(a, b)| take(a, b));
    take(rest, other_rest);
    most.into_iter().fold(f64::NEG_INFINITY, f64::max)
}

fn add(sum: &mut [f64], more: &[f64], times: impl Fn(f64) -> f64) {
    for (sum, more) in sum.iter_mut().zip(more) {
        *sum += times(*more);
    }
}

/// Coefficients of 1, x, x², … from `low` to `high`, each of the degree of the last: bᵢ(xᵃ) = Σⱼ C(i, j)·C(n
/// − i, a − j) / C(n, a) · highʲ·lowᵃ⁻ʲ, which is a mean of products of a ends.
fn powers(count: usize, (low, high): (f64, f64)) -> Vec<Vec<f64>> {
    let mut choices = vec![vec![1.0]];
    while choices.len() < count {
        let last: &Vec<f64> = &choices[choices.len() - 1];
        let inner = last.windows(2).map(|pair| pair[0] + pair[1]);
        choices.push([1.0].into_iter().chain(inner).chain([1.0]).collect());
    }
    let powers = |x: f64| -> Vec<f64> {
        std::iter::successors(Some(1.0), |power| Some(power * x)).take(count).collect()
    };
    let (lows, highs) = (powers(low), powers(high));
    let degree = count - 1;
    let coefficient = |a: usize, i: usize| {
        let from = (a + i).saturating_sub(degree);
        let means = (from..=a.min(i)).map(|j| {
            let share = choices[i][j] * choices[degree - i][a - j] / choices[degree][a];
            share * (highs[j] * lows[a - j])
        });
        means.sum()
    };
    (0..count).map(|a| (0..count).map(|i| coefficient(a, i)).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries_in};
    use crate::math::terms::exponents;

    fn value(terms: &[Term], place: [f64; 3]) -> f64 {
        let term = |(term, powers): &Term| {
            let factors = place.iter().zip(powers);
            let factors = factors.flat_map(|(x, n)| std::iter::repeat_n(x, *n));
            term * factors.product::<f64>()
        };
        terms.iter().map(term).sum()
    }

    #[test]
    fn a_net_and_its_halves_hold_all_values_and_have_those_of_the_corners() {
        let mut random = Random(71);
        for case in 0..tries_in(200) {
            let degree = 1 + random.below(5);
            let terms: Vec<Term> =
                exponents(degree).map(|powers| (random.number(-1.0, 1.0), powers)).collect();
            let sides: Sides = std::array::from_fn(|_| {
                let [a, b] = [0; 2].map(|_| random.number(-2.0, 2.0));
                (a.min(b), a.max(b))
            });
            let mut net = Net::new(&terms, sides);
            for _ in 0..random.below(6) {
                let axis = random.below(3);
                let [lower, upper] = net.halves(axis);
                net = if random.below(2) == 0 { lower } else { upper };
            }
            let slack = 2.0 * net.size * net.rounded * U;
            let least = net.values.iter().fold(f64::INFINITY, |least, v| least.min(*v));
            let most = net.values.iter().fold(f64::NEG_INFINITY, |most, v| most.max(*v));
            for _ in 0..10 {
                let place = net.sides().map(|(low, high)| random.number(low, high));
                let value = value(&terms, place);
                let held = least - slack <= value && value <= most + slack;
                assert!(held, "{case}: {least} {value} {most}");
                assert!(net.sign().is_none_or(|above| above == (value > 0.0)), "{case}: {value}");
            }
            let corner = value(&terms, net.sides().map(|(low, _)| low));
            assert!((net.values[0] - corner).abs() <= slack, "{case}");
            let corner = value(&terms, net.sides().map(|(_, high)| high));
            let last = net.values[net.values.len() - 1];
            assert!((last - corner).abs() <= slack, "{case}");
        }
    }

    #[test]
    fn what_rounding_hides_has_no_sign() {
        // (x − 1)⁴, from 1 on.
        let terms = [1.0, -4.0, 6.0, -4.0, 1.0].into_iter().zip((0..=4).rev());
        let terms: Vec<Term> = terms.map(|(term, power)| (term, [power, 0, 0])).collect();
        let net = |low: f64| Net::new(&terms, [(low, 2.0), (0.0, 0.0), (0.0, 0.0)]);
        assert_eq!(net(1.0 + 1e-5).sign(), None);
        assert_eq!(net(1.1).sign(), Some(true));
    }
}
