//! Algebraic surfaces: zero sets of polynomials in x, y and z; the inside is where the polynomial is
//! negative.
//!
//! **Invariant:** a line crosses the surface where the polynomial along the line certainly changes its sign,
//! at any distance. The surface may be unbounded, and a line may begin inside; bounds are given only where
//! they are proven.
//!
//! **Source:** P. Hanrahan, "Ray tracing algebraic surfaces", SIGGRAPH 1983, p. 83; roots by
//! `math::roots::polynomial`.

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

use super::local::{Crossings, Height, Local, LocalRay, Met};
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
    /// Coefficients of all xⁱyʲzᵏ with i + j + k ≤ degree; in descending powers of x, then of y, then of z.
    terms: Vec<f64>,
    /// Their absolute values.
    sizes: Vec<f64>,
    /// Number of leading zeros in each row, which holds the terms of one power of x and one of y.
    zeros: Vec<u8>,
    /// Bounds of a quadric, where known.
    closed: Option<Closed>,
    /// Bounds of other surfaces, where known.
    ends: Memory<OnceLock<Option<Ends>>>,
}

impl Algebraic {
    /// Builds a surface; `None` if the degree exceeds 15, or if the number of terms does not match the
    /// degree.
    pub fn new(degree: usize, terms: Vec<f64>) -> Option<Self> {
        let fits = degree <= MOST && terms.len() == count_of_terms(degree);
        let sizes = terms.iter().map(|term| term.abs()).collect();
        let closed = if degree == 2 { Closed::of(&terms) } else { None };
        let zeros = if fits { along::zeros(degree, &terms) } else { Vec::new() };
        fits.then_some(Self { degree, terms, sizes, zeros, closed, ends: Memory::default() })
    }

    /// Returns the bounds, where known, of a surface that is not a quadric.
    fn ends(&self) -> Option<&Ends> {
        if self.degree == 2 {
            return None;
        }
        self.ends.get_or_init(|| Ends::of(self.degree, &self.terms)).as_ref()
    }

    /// Returns its keyword in the scene language.
    pub fn word(&self) -> &'static str {
        match self.degree {
            0..=2 => "quadric",
            3 => "cubic",
            4 => "quartic",
            _ => "poly",
        }
    }

    /// Returns the value and the gradient of the polynomial with these terms at a point.
    fn at(&self, terms: &[f64], point: Vector) -> (f64, Vector) {
        let Vector { x, y, z } = point;
        let mut terms = terms;
        let mut zeros = self.zeros.iter();
        let (mut all, mut slope) = (0.0, Vector::ZERO);
        for i in 0..=self.degree {
            let (mut plane, mut plane_slope) = (0.0, Vector::ZERO);
            for j in 0..=i {
                let (row_terms, rest) = terms.split_at(j + 1);
                terms = rest;
                let zeros = zeros.next().map_or(0, |zeros| usize::from(*zeros));
                let (mut row, mut row_slope) = (0.0, 0.0);
                for term in &row_terms[zeros..] {
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

    /// Returns the height from the value and the gradient at the point itself; the gradient may be 0.
    fn simple_height(&self, point: Vector) -> multiple::Told {
        let (value, gradient) = self.at(&self.terms, point);
        let (size, steepness) = self.at(&self.sizes, point.abs());
        let rounding = self.rounding();
        (Height { value, gradient, error: rounding * size }, rounding * steepness.length())
    }

    /// Maximum number of roundings in a term of a value: two for each factor, and one for each sum that it
    /// passes through.
    fn rounding(&self) -> f64 {
        (5 * self.degree + 8) as f64 * U
    }

    /// Returns the polynomial along a line.
    ///
    /// **Error** of each coefficient: let A be the same polynomial with all absolute values, and A′ that with
    /// the line's blur and turn added to those of its point and direction. The line contributes A′ − A, and
    /// rounding contributes each coefficient of A′ times the rounding of all three.
    fn along_ray<const ROOM: usize>(&self, ray: &LocalRay) -> Polynomial<ROOM> {
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

/// Returns the same line, with s measured from another point on it.
#[cold]
fn about<'a>(ray: &LocalRay<'a>, s: f64) -> LocalRay<'a> {
    let nearest = ray.at(s);
    let blur = ray.blur_at(s) + 2.0 * U * (nearest.length() + s.abs());
    LocalRay { nearest, blur, ..*ray }
}

impl Algebraic {
    /// Adds, in order, the crossings that may lie between two positions, until `is_enough` accepts one.
    fn meet(
        &self,
        ray: &LocalRay,
        between: (f64, f64),
        found: &mut Crossings,
        is_enough: impl Fn(&Met) -> bool,
    ) {
        // Most have few terms: there is little to be cleared and copied.
        match self.degree {
            0..=2 => self.meet_in::<3>(ray, between, found, is_enough),
            3 => self.meet_in::<4>(ray, between, found, is_enough),
            4 => self.meet_in::<5>(ray, between, found, is_enough),
            5..=8 => self.meet_in::<9>(ray, between, found, is_enough),
            _ => self.meet_in::<{ MOST + 1 }>(ray, between, found, is_enough),
        }
    }

    /// [`Self::meet`] with room for so many coefficients.
    fn meet_in<const ROOM: usize>(
        &self,
        ray: &LocalRay,
        (from, to): (f64, f64),
        found: &mut Crossings,
        is_enough: impl Fn(&Met) -> bool,
    ) {
        let (mut line, mut start) = (*ray, 0.0);
        let mut polynomial = self.along_ray::<ROOM>(ray);
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

    /// Its non-zero terms: ` 2·x^2·y`.
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
    /// Its value in twice the precision.
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
