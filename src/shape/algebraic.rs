//! Algebraic surface: where a polynomial in x, y and z is 0; inside it is negative.
//!
//! **Invariant:** a line crosses it where the polynomial along the line certainly changes its sign,
//! however far away. It may have no end, and begin inside; where it has one, that is proven.
//!
//! **Source:** P. Hanrahan, "Ray tracing algebraic surfaces", SIGGRAPH 1983, p. 83; the roots as
//! `math::roots::polynomial` finds them.

mod along;
mod clipped;
mod closed;
mod ends;
mod net;
mod nowhere;

use std::fmt::Write;
use std::sync::OnceLock;

use along::Line;
pub use clipped::HalfSpace;
use closed::Closed;
use ends::Ends;

use super::body::{Crossings, Height, Local, LocalRay, Met};
use super::{Memory, U, multiple};
use crate::math::Vector;
use crate::math::roots::polynomial::{Asked, MOST, Polynomial};
use crate::math::terms::{count_of_terms, exponents};

const ENDLESS: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

/// A polynomial in x, y and z.
#[derive(Debug, Clone, PartialEq)]
pub struct Algebraic {
    /// 2 … 15.
    degree: usize,
    /// Of all xⁱyʲzᵏ with i + j + k ≤ degree; by falling powers of x, then of y, then of z.
    terms: Vec<f64>,
    /// Their absolute values.
    sizes: Vec<f64>,
    /// How many zeros come first of each row: of the terms of one power of x and one of y.
    zeros: Vec<u8>,
    /// Where it ends, if that is known: of a quadric.
    closed: Option<Closed>,
    /// Likewise, of others.
    ends: Memory<OnceLock<Option<Ends>>>,
}

impl Algebraic {
    /// `None` where the degree is more than 15, or the number of terms not that of the degree.
    pub fn new(degree: usize, terms: Vec<f64>) -> Option<Self> {
        let fits = degree <= MOST && terms.len() == count_of_terms(degree);
        let sizes = terms.iter().map(|term| term.abs()).collect();
        let closed = if degree == 2 { Closed::of(&terms) } else { None };
        let zeros = if fits { along::zeros(degree, &terms) } else { Vec::new() };
        fits.then_some(Self { degree, terms, sizes, zeros, closed, ends: Memory::default() })
    }

    /// Where it ends, if that is known and it is no quadric.
    fn ends(&self) -> Option<&Ends> {
        if self.degree == 2 {
            return None;
        }
        self.ends.get_or_init(|| Ends::of(self.degree, &self.terms)).as_ref()
    }

    /// What the language calls it.
    pub fn word(&self) -> &'static str {
        match self.degree {
            0..=2 => "quadric",
            3 => "cubic",
            4 => "quartic",
            _ => "poly",
        }
    }

    /// The value at a point and its gradient, for the polynomial of these terms.
    fn at(&self, terms: &[f64], point: Vector) -> (f64, Vector) {
        let Vector { x, y, z } = point;
        let mut terms = terms.iter();
        let (mut all, mut slope) = (0.0, Vector::ZERO);
        for i in 0..=self.degree {
            let (mut plane, mut plane_slope) = (0.0, Vector::ZERO);
            for j in 0..=i {
                let (mut row, mut row_slope) = (0.0, 0.0);
                for term in terms.by_ref().take(j + 1) {
                    row_slope = row_slope * z + row;
                    row = row * z + term;
                }
                plane_slope = plane_slope * y + Vector::new(0.0, plane, row_slope);
                plane = plane * y + row;
            }
            slope = slope * x + plane_slope + Vector::new(all, 0.0, 0.0);
            all = all * x + plane;
        }
        (all, slope)
    }

    /// By the value and the gradient at the point itself, which may be 0.
    fn simple_height(&self, point: Vector) -> multiple::Told {
        let (value, gradient) = self.at(&self.terms, point);
        let (size, steepness) = self.at(&self.sizes, point.abs());
        let rounding = self.rounding();
        (Height { value, gradient, error: rounding * size }, rounding * steepness.length())
    }

    /// How often a term of a value is rounded at most: each factor twice, each of the sums it is carried
    /// through once.
    fn rounding(&self) -> f64 {
        (5 * self.degree + 8) as f64 * U
    }

    /// The polynomial along a line.
    ///
    /// **Error** of each coefficient: with A the same of all absolute values, and A′ that with the line's
    /// blur and turn added to those of its point and direction, A′ − A for the line, and each coefficient
    /// of A′ times the rounding of the three.
    fn along_ray(&self, ray: &LocalRay) -> Polynomial {
        let LocalRay { nearest, direction, blur, turn, .. } = *ray;
        let (place, way) = (nearest.abs(), direction.abs());
        let line =
            Line { starts: [nearest, place, place + blur], steps: [direction, way, way + turn] };
        let [values, least, mut errors] = self.along(&line);
        for (most, least) in errors.iter_mut().zip(least) {
            *most = (*most - least).max(0.0) + 3.0 * self.rounding() * *most;
        }
        Polynomial::new(values, errors)
    }
}

/// The same line, from another place of it on.
#[cold]
fn about<'a>(ray: &LocalRay<'a>, s: f64) -> LocalRay<'a> {
    let nearest = ray.at(s);
    let blur = ray.blur_at(s) + 2.0 * U * (nearest.length() + s.abs());
    LocalRay { nearest, blur, ..*ray }
}

impl Algebraic {
    /// In order, the crossings that may lie between two places, as long as `is_enough` says so of none.
    fn meet(
        &self,
        ray: &LocalRay,
        (from, to): (f64, f64),
        found: &mut Crossings,
        is_enough: impl Fn(&Met) -> bool,
    ) {
        let (mut line, mut start) = (*ray, 0.0);
        let mut polynomial = self.along_ray(ray);
        if let Some(vertex) = polynomial.doubtful_vertex() {
            // Of planes that are close together, or of a flat ellipsoid, the terms are small between its sides.
            line = about(ray, vertex);
            (polynomial, start) = (self.along_ray(&line), vertex);
        }
        let (size, end) = match self.ends() {
            Some(ends) => {
                let end = ends.half_chord(line.nearest.length() - line.blur);
                (2.0 * end, end)
            }
            None => (line.nearest.length().max(1.0), f64::INFINITY),
        };
        let between = (from - start, to - start);
        let asked = Asked { size, end, tolerance: ray.tolerance, between };
        polynomial.roots(&asked, &mut |root| {
            let t = start + root.s;
            let error = root.error + if start == 0.0 { 0.0 } else { U * t.abs() };
            let met = Met { t, error, leaving: root.rising, part: 0 };
            found.push(met);
            !is_enough(&met)
        });
    }
}

impl Local for Algebraic {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        self.meet(ray, ENDLESS, found, |_| false);
    }

    fn first_crossings(&self, ray: &LocalRay, (from, to): (f64, f64), found: &mut Crossings) {
        let ahead = ray.ahead_of(from);
        self.meet(ray, (from, to), found, |met| met.t - met.error > ahead);
    }

    fn part_at(&self, _: &LocalRay, _: f64, _: bool) -> Option<u32> {
        Some(0)
    }

    fn height(&self, _: u32, point: Vector) -> Height {
        let (height, _) = self.simple_height(point);
        let far = Some(point.length()).filter(|far| *far > 0.0).unwrap_or(1.0);
        if height.gradient.length() * (multiple::MOVED * far) > height.error {
            return height;
        }
        let sample = |place| Some(self.simple_height(place));
        if multiple::is_steady(point, &height, sample) {
            return height;
        }
        if let Some(height) = multiple::height(point, multiple::NEAREST * far, sample) {
            return height;
        }
        if height.gradient == Vector::ZERO {
            // The tip of a cone, or the place where two sheets cross: it faces no way, or any.
            return Height { value: 0.0, gradient: Vector::Y, error: height.error.sqrt() };
        }
        height
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        match (&self.closed, self.ends()) {
            (Some(closed), _) => closed.extent(along),
            (None, Some(ends)) => ends.extent(along),
            (None, None) => ENDLESS,
        }
    }

    fn nearest_extent(&self, along: Vector) -> (f64, f64) {
        match (&self.closed, self.ends()) {
            (Some(closed), _) => closed.nearest_extent(along),
            (None, Some(ends)) => ends.nearest_extent(along),
            (None, None) => ENDLESS,
        }
    }

    fn is_iterated(&self) -> bool {
        true
    }

    fn price(&self) -> u64 {
        4 * self.terms.len() as u64 - 18
    }

    fn reach(&self) -> f64 {
        match (&self.closed, self.ends()) {
            (Some(closed), _) => closed.reach(),
            (None, Some(ends)) if ends.is_solid => ends.reach(),
            (None, _) => f64::INFINITY,
        }
    }

    /// Its terms but those that are 0: ` 2·x^2·y`.
    fn numbers(&self) -> String {
        let mut out = String::new();
        for (term, powers) in self.terms.iter().zip(exponents(self.degree)) {
            if *term == 0.0 {
                continue;
            }
            // Writing to a string does not fail.
            let _ = write!(out, " {term}");
            for (axis, power) in ["x", "y", "z"].into_iter().zip(powers) {
                let _ = match power {
                    0 => Ok(()),
                    1 => write!(out, "·{axis}"),
                    _ => write!(out, "·{axis}^{power}"),
                };
            }
        }
        out
    }

    fn contains(&self, point: Vector) -> bool {
        self.at(&self.terms, point).0 < 0.0
    }

    fn certainly_contains(&self, point: Vector) -> bool {
        let (size, _) = self.at(&self.sizes, point.abs());
        self.at(&self.terms, point).0 < -self.rounding() * size
    }
}

#[cfg(test)]
impl Algebraic {
    /// Its value in twice the digits.
    pub(super) fn exactly(&self, point: super::exact::Triple) -> super::exact::Double {
        use super::exact::Double;
        let powers_of = |x: Double| {
            let next = |power: &Double| Some(*power * x);
            std::iter::successors(Some(Double::of(1.0)), next).take(self.degree + 1).collect()
        };
        let powers_of: [Vec<Double>; 3] = point.map(powers_of);
        let terms = self.terms.iter().zip(exponents(self.degree)).filter(|(term, _)| **term != 0.0);
        let value = |(term, powers): (&f64, [usize; 3])| {
            let factors = powers_of.iter().zip(powers).map(|(powers, n)| powers[n]);
            factors.fold(Double::of(*term), |all, factor| all * factor)
        };
        terms.map(value).fold(Double::of(0.0), |all, term| all + term)
    }
}
