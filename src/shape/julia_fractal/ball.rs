//! Ball arithmetic: sets of numbers of an algebra within a radius of a midpoint.
//!
//! **Invariant:** the result contains the exact and the rounded result for every choice of numbers in the
//! operands. The norm of a product is the product of the norms, so balls, unlike boxes, grow no more than the
//! map does.
//!
//! **Source:** J. Rokne, P. Lancaster, "Complex interval arithmetic", Communications of the ACM 14, 1971.

use std::ops::{Add, Mul};

use crate::math::interval::Interval;
use crate::shape::U;

/// Multiplication of numbers with a fixed number of components.
pub trait Multiply {
    fn times(&self, other: &Self) -> Self;
}

/// Complex numbers: real, imaginary.
impl Multiply for [f64; 2] {
    fn times(&self, other: &Self) -> Self {
        let ([a, b], [c, d]) = (self, other);
        [a * c - b * d, a * d + b * c]
    }
}

/// Returns a·b + b·a of quaternions, in which the products of i, j and k with one another cancel.
pub fn symmetric([a, b, c, d]: &[f64; 4], [e, f, g, h]: &[f64; 4]) -> [f64; 4] {
    let (a2, e2) = (2.0 * a, 2.0 * e);
    [2.0 * (a * e - b * f - c * g - d * h), a2 * f + b * e2, a2 * g + c * e2, a2 * h + d * e2]
}

/// Quaternions: real, i, j, k.
impl Multiply for [f64; 4] {
    fn times(&self, other: &Self) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (self, other);
        [
            a * e - b * f - c * g - d * h,
            a * f + b * e + c * h - d * g,
            a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e,
        ]
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball<const N: usize> {
    pub middle: [f64; N],
    pub radius: f64,
}

impl<const N: usize> Ball<N> {
    pub fn new(middle: [f64; N], radius: f64) -> Self {
        Self { middle, radius }
    }

    pub fn point(middle: [f64; N]) -> Self {
        Self { middle, radius: 0.0 }
    }

    /// The ball of all numbers.
    pub const EVERYTHING: Self = Self { middle: [0.0; N], radius: f64::INFINITY };

    /// Returns an upper bound on the norm of the midpoint.
    pub fn size(&self) -> f64 {
        dot(&self.middle, &self.middle).sqrt() * (1.0 + 4.0 * U)
    }

    /// Returns the range of the squared norm.
    pub fn squared(&self) -> Interval {
        self.squared_of(self.size())
    }

    /// Like [`Self::squared`], for a known norm of the midpoint.
    pub fn squared_of(&self, size: f64) -> Interval {
        let low = (size * (1.0 - 16.0 * U) - self.radius).max(0.0);
        let high = size + self.radius;
        Interval { low: low * low * (1.0 - 4.0 * U), high: high * high * (1.0 + 4.0 * U) }
    }

    /// Returns the range of the scalar product.
    pub fn dot(&self, other: &Self) -> Interval {
        let (a, b) = (self.size(), other.size());
        let off =
            a * other.radius + b * self.radius + self.radius * other.radius + 16.0 * U * a * b;
        let off = off * (1.0 + 8.0 * U);
        let middle = dot(&self.middle, &other.middle);
        Interval { low: middle - off, high: middle + off }
    }

    /// Returns a·b + b·a, where `times` is that expression for the midpoints.
    ///
    /// The norms of both midpoints are arguments, so that neither is computed twice.
    pub fn both_ways(
        (a, a_size): (&Self, f64),
        (b, b_size): (&Self, f64),
        times: impl Fn(&[f64; N], &[f64; N]) -> [f64; N],
    ) -> Self {
        let radius = a_size * b.radius
            + b_size * a.radius
            + a.radius * b.radius
            + 16.0 * U * a_size * b_size;
        Self { middle: times(&a.middle, &b.middle), radius: 2.0 * radius * (1.0 + 8.0 * U) }
    }

    /// Returns the sum, for an upper bound `size` on the norm of its midpoint.
    pub fn plus(&self, other: &Self, size: f64) -> Self {
        let middle = std::array::from_fn(|i| self.middle[i] + other.middle[i]);
        let radius = (self.radius + other.radius + 2.0 * U * size) * (1.0 + 4.0 * U);
        Self { middle, radius }
    }

    pub fn times_number(self, by: f64) -> Self {
        let middle = self.middle.map(|component| by * component);
        Self { middle, radius: (by.abs() * self.radius + 2.0 * U * by.abs() * self.size()) }
    }
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl<const N: usize> Add for Ball<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let middle: [f64; N] = std::array::from_fn(|i| self.middle[i] + other.middle[i]);
        self.plus(&other, Self::point(middle).size())
    }
}

impl<const N: usize> Mul for Ball<N>
where
    [f64; N]: Multiply,
{
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.size(), other.size());
        let radius =
            a * other.radius + b * self.radius + self.radius * other.radius + 16.0 * U * a * b;
        Self { middle: self.middle.times(&other.middle), radius: radius * (1.0 + 8.0 * U) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Random, tries};

    fn any<const N: usize>(random: &mut Random) -> Ball<N> {
        let middle = [(); N].map(|()| random.number(-2.0, 2.0));
        Ball { middle, radius: random.size(-9.0, 0.0) }
    }

    /// A number in a ball.
    fn within<const N: usize>(random: &mut Random, ball: &Ball<N>) -> [f64; N] {
        let way = [(); N].map(|()| random.number(-1.0, 1.0));
        let length = Ball::point(way).size();
        std::array::from_fn(|i| ball.middle[i] + way[i] / length * ball.radius * 0.999_999)
    }

    fn holds<const N: usize>(ball: &Ball<N>, number: &[f64; N]) -> bool {
        let off: [f64; N] = std::array::from_fn(|i| number[i] - ball.middle[i]);
        Ball::point(off).size() <= ball.radius
    }

    #[test]
    fn sums_and_products_of_numbers_lie_in_those_of_their_balls() {
        let mut random = Random(7);
        for _ in 0..tries() {
            let (a, b) = (any::<4>(&mut random), any::<4>(&mut random));
            let (p, q) = (within(&mut random, &a), within(&mut random, &b));
            assert!(holds(&(a * b), &p.times(&q)), "{a:?} {b:?}");
            assert!(holds(&(a + b), &std::array::from_fn(|i| p[i] + q[i])));
            let squared = Ball::point(p).size().powi(2);
            assert!(a.squared().low <= squared && squared <= a.squared().high * (1.0 + 16.0 * U));
            assert!(a.dot(&b).contains(dot(&p, &q)));
            let (a, b) = (any::<2>(&mut random), any::<2>(&mut random));
            let (p, q) = (within(&mut random, &a), within(&mut random, &b));
            assert!(holds(&(a * b), &p.times(&q)), "{a:?} {b:?}");
        }
    }

    #[test]
    fn quaternions_have_the_table_that_hamilton_cut_into_a_bridge() {
        let [i, j, k] = [1, 2, 3].map(|at| std::array::from_fn(|n| f64::from(u8::from(n == at))));
        let (i, j, k): ([f64; 4], [f64; 4], [f64; 4]) = (i, j, k);
        let minus_one = [-1.0, 0.0, 0.0, 0.0];
        assert!([i, j, k].iter().all(|unit| unit.times(unit) == minus_one));
        assert_eq!(i.times(&j).times(&k), minus_one);
    }
}
