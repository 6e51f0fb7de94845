//! Orbits: the iterates of a map of four-component numbers, and their derivatives along directions from the
//! start.
//!
//! **Invariant:** every iterate contains the result for each number of the initial ball.

use super::ball::{Ball, symmetric};
use super::function::Function;
use crate::math::interval::Interval;
use crate::shape::U;

/// An orbit with `K` directions from the start: one along a line, three for the gradient.
pub trait Orbit<const K: usize>: Copy {
    /// Returns whether every iterate after a ball that contains both the origin and escaping numbers also
    /// contains both.
    fn grows(&self) -> bool;

    /// Returns the squared norm, and its slopes along the directions; `None` if nothing is known.
    fn squared(&self) -> Option<(Interval, [Interval; K])>;

    /// Applies the map.
    fn next(&self) -> Self;
}

/// The map h² + p or h³ + p of quaternions.
#[derive(Debug, Clone, Copy)]
pub struct Quaternion<const K: usize> {
    h: Ball<4>,
    slopes: [Ball<4>; K],
    parameter: Ball<4>,
    is_cube: bool,
    /// Upper bounds on the norms of the midpoints.
    size: f64,
    parameter_size: f64,
}

impl<const K: usize> Quaternion<K> {
    pub fn new(h: Ball<4>, slopes: [Ball<4>; K], parameter: Ball<4>, is_cube: bool) -> Self {
        let (size, parameter_size) = (h.size(), parameter.size());
        Self { h, slopes, parameter, is_cube, size, parameter_size }
    }
}

impl<const K: usize> Orbit<K> for Quaternion<K> {
    fn grows(&self) -> bool {
        true
    }

    fn squared(&self) -> Option<(Interval, [Interval; K])> {
        let squared = self.h.squared_of(self.size);
        let is_known = self.h.radius.is_finite() && squared.is_finite();
        is_known.then(|| (squared, self.slopes.map(|slope| twice(self.h.dot(&slope)))))
    }

    fn next(&self) -> Self {
        let Self { h, size, slopes, parameter, parameter_size, is_cube } = *self;
        let (power, slopes, power_size) = match is_cube {
            false => {
                let slopes = slopes
                    .map(|slope| Ball::both_ways((&h, size), (&slope, slope.size()), symmetric));
                // Twice the square: halving is exact.
                let twice = Ball::both_ways((&h, size), (&h, size), symmetric);
                let square = Ball::new(twice.middle.map(|part| 0.5 * part), 0.5 * twice.radius);
                (square, slopes, size * size)
            }
            true => {
                let square = h * h;
                let slopes = slopes.map(|slope| square * slope + h * slope * h + slope * square);
                (square * h, slopes, size * size * size)
            }
        };
        let h = power.plus(&parameter, (power_size + parameter_size) * (1.0 + 64.0 * U));
        Self { h, size: h.size(), slopes, ..*self }
    }
}

/// The map f(h) + p of hypercomplex numbers: two independent complex numbers.
///
/// **Source:** G. Price, *An Introduction to Multicomplex Spaces and Functions* (1991), chapter 1 (the
/// idempotent representation).
#[derive(Debug, Clone, Copy)]
pub struct Hypercomplex<const K: usize> {
    pub halves: [Half<K>; 2],
    pub function: Function,
}

#[derive(Debug, Clone, Copy)]
pub struct Half<const K: usize> {
    h: Ball<2>,
    slopes: [Ball<2>; K],
    parameter: Ball<2>,
}

impl<const K: usize> Hypercomplex<K> {
    pub fn new(h: Ball<4>, slopes: [Ball<4>; K], parameter: Ball<4>, function: Function) -> Self {
        let halves = [1.0, -1.0].map(|sign| Half {
            h: half(h, sign),
            slopes: slopes.map(|slope| half(slope, sign)),
            parameter: half(parameter, sign),
        });
        Self { halves, function }
    }
}

/// Half of x + iy + jz + kw, where ij = k and i² = j² = −1 = −k²: (x ∓ w) + (y ± z)i.
fn half(number: Ball<4>, sign: f64) -> Ball<2> {
    let [x, y, z, w] = number.middle;
    // Each component adds two: the farthest that both can go is √2 times the radius.
    let moved = Ball::new([x, y], std::f64::consts::SQRT_2 * number.radius * (1.0 + 4.0 * U));
    moved + Ball::point([-sign * w, sign * z])
}

impl<const K: usize> Orbit<K> for Hypercomplex<K> {
    fn grows(&self) -> bool {
        matches!(self.function, Function::Sqr | Function::Cube)
    }

    /// Half the sum of the squares of the two halves.
    fn squared(&self) -> Option<(Interval, [Interval; K])> {
        let [a, b] = &self.halves;
        let sum = a.h.squared() + b.h.squared();
        let is_known = a.h.radius.is_finite() && b.h.radius.is_finite() && sum.is_finite();
        is_known.then(|| {
            let slopes =
                std::array::from_fn(|way| a.h.dot(&a.slopes[way]) + b.h.dot(&b.slopes[way]));
            (Interval { low: 0.5 * sum.low, high: 0.5 * sum.high }, slopes)
        })
    }

    fn next(&self) -> Self {
        let halves = self.halves.map(|Half { h, slopes, parameter }| {
            let (value, derivative) = self.function.of(h);
            Half { h: value + parameter, slopes: slopes.map(|slope| derivative * slope), parameter }
        });
        Self { halves, ..*self }
    }
}

fn twice(Interval { low, high }: Interval) -> Interval {
    Interval { low: 2.0 * low, high: 2.0 * high }
}
