//! Julia fractal: the set where iterating a map hₙ₊₁ = f(hₙ) + p never leaves a ball; a three-dimensional
//! slice of the four-dimensional space of h₀.
//!
//! With a finite number of iterations, the surface is as smooth as the map: it is where the largest norm of
//! h₀, h₁ … equals the radius of the ball. A line is followed by stretches on which no orbit changes between
//! escaping and staying, as Taylor polynomials tell (`taylor.rs`); where these are short, ball arithmetic bounds
//! that norm and its slope over entire pieces of the line. So no thin filament is missed. **Invariant:** a
//! crossing lies between two positions where the bounds, over all lines that may be intended, have opposite
//! signs.
//!
//! **Source:** A. Norton, "Generation and display of geometric fractals in 3-D", Computer Graphics 16
//! (SIGGRAPH 1982); J. Hart, D. Sandin, L. Kauffman, "Ray tracing deterministic 3-D fractals", Computer
//! Graphics 23 (SIGGRAPH 1989). The radius of the ball was measured with POV-Ray 3.7.

mod ball;
mod function;
mod orbit;
mod taylor;

use super::U;
use super::local::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::roots::bracket::{Sample, root};
use crate::math::roots::isolate::{Bounds, Fineness, Search};
use ball::Ball;
pub use function::Function;
use orbit::{Hypercomplex, Orbit, Quaternion};

/// Minimum length of a piece of a line for which nothing is known, relative to the ball's radius.
const FINEST: f64 = 1.0 / 4096.0;
/// Maximum error of a crossing found in such pieces, relative to the ball's radius.
const FAR: f64 = 1.0 / (1 << 30) as f64;

/// Length of a piece of a line that is searched where no stretch is known, relative to the ball's radius;
/// the next piece, if it follows at once, is twice as long.
const SHORTEST: f64 = 1.0 / 32768.0;
/// Length of the first stretch that is tried, relative to the ball's radius.
const FIRST: f64 = 0.25;

/// An uninformative bound, for pieces that are subdivided as finely as those with a bound.
const ANYTHING: f64 = f64::MAX;

/// The iterated function and its algebra.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Algebra {
    /// h², or h³.
    Quaternion {
        is_cube: bool,
    },
    Hypercomplex(Function),
}

/// A slice of the points that stay bounded under an iterated map.
#[derive(Debug, Clone, PartialEq)]
pub struct JuliaFractal {
    /// p.
    pub parameter: [f64; 4],
    pub algebra: Algebra,
    /// Number of h₀, h₁ … that are tested, at least 1.
    pub iterations: u32,
    /// Unit normal of the hyperplane of the slice; its last component is not 0.
    pub normal: [f64; 4],
    /// Distance of the hyperplane from the origin, along the normal.
    pub distance: f64,
}

impl JuliaFractal {
    /// Returns the radius of the ball: a number outside of it never returns. Measured with POV-Ray 3.7.
    pub fn radius(&self) -> f64 {
        match self.algebra {
            Algebra::Quaternion { .. } => (1.0 + Ball::point(self.parameter).size()).min(2.0),
            Algebra::Hypercomplex(_) => 4.0,
        }
    }

    /// Returns whether it is certainly empty because its hyperplane lies outside of the ball.
    pub fn is_beyond(&self) -> bool {
        self.distance.abs() > self.radius() * (1.0 + 16.0 * U)
    }

    /// Maps a direction in the hyperplane to four dimensions.
    fn way(&self, step: Vector, blur: f64) -> Ball<4> {
        let [a, b, c, d] = self.normal;
        let fourth = -(a * step.x + b * step.y + c * step.z) / d;
        let size = step.length() * (1.0 + 8.0 * U);
        Ball::new([step.x, step.y, step.z, fourth], (blur + 8.0 * U * size) / d.abs())
    }

    /// Maps a point to four dimensions, with all points within a distance of it.
    fn lift(&self, point: Vector, within: f64) -> Ball<4> {
        let fourth = self.distance / self.normal[3];
        let height = Ball::new([0.0, 0.0, 0.0, fourth], 2.0 * U * fourth.abs());
        self.way(point, within) + height
    }

    /// Returns the largest squared norm of the orbit, relative to the squared radius, less 1, and its slopes
    /// along the directions. If the orbit certainly escapes, counts only up to the first step that does.
    fn escape<const K: usize>(
        &self,
        h: Ball<4>,
        slopes: [Ball<4>; K],
    ) -> (Interval, [Interval; K]) {
        let parameter = Ball::point(self.parameter);
        match self.algebra {
            Algebra::Quaternion { is_cube } => {
                self.farthest(Quaternion::new(h, slopes, parameter, is_cube))
            }
            Algebra::Hypercomplex(function) => {
                self.farthest(Hypercomplex::new(h, slopes, parameter, function))
            }
        }
    }

    fn farthest<const K: usize>(&self, mut orbit: impl Orbit<K>) -> (Interval, [Interval; K]) {
        let radius = self.radius();
        let over = 1.0 / (radius * radius);
        let scaled = |i: Interval| Interval { low: i.low * over, high: i.high * over };
        let one = Interval::point(1.0);
        let mut farthest: Option<(Interval, [Interval; K])> = None;
        for step in 0..self.iterations {
            let Some((squared, slopes)) = orbit.squared() else {
                let low = farthest.map_or(-1.0, |(known, _)| known.low);
                return (Interval { low, high: f64::INFINITY }, [Interval::EVERYTHING; K]);
            };
            let here = (scaled(squared) - one, slopes.map(scaled));
            if here.0.low > 0.0 {
                return here;
            }
            // Nothing more is told of a ball that holds the origin and what escapes.
            if orbit.grows() && squared.low == 0.0 && here.0.high > 0.0 {
                let low = farthest.map_or(-1.0, |(known, _)| known.low);
                return (Interval { low, high: ANYTHING }, [Interval::EVERYTHING; K]);
            }
            farthest = Some(match farthest {
                Some(known) if known.0.low > here.0.high => known,
                Some(known) if here.0.low <= known.0.high => {
                    let slopes = std::array::from_fn(|way| known.1[way].hull(here.1[way]));
                    (known.0.max(here.0), slopes)
                }
                _ => here,
            });
            if step + 1 < self.iterations {
                orbit = orbit.next();
            }
        }
        farthest.unwrap_or((Interval::point(-1.0), [Interval::point(0.0); K]))
    }

    /// Bounds over a piece of a line, and over all lines that may be intended.
    fn bounds(&self, ray: &LocalRay, s: Interval, with_slope: bool) -> Bounds {
        let (middle, half) = (0.5 * (s.low + s.high), 0.5 * (s.high - s.low));
        let blur = ray.blur_at(s.low.abs().max(s.high.abs()));
        // The middle is rounded, and so is the place there.
        let within = half * (1.0 + 4.0 * U) + blur + 4.0 * U * (middle.abs() + self.radius());
        let start = self.lift(ray.at(middle), within);
        if !with_slope {
            return Bounds { value: self.escape(start, []).0, slope: Interval::EVERYTHING };
        }
        let (value, [slope]) = self.escape(start, [self.way(ray.direction, ray.turn)]);
        Bounds { value, slope }
    }

    /// Evaluates bounds for a search; computes the slope only where the values do not determine the sign.
    fn looked_at(&self, ray: &LocalRay, s: Interval) -> Bounds {
        let bounds = self.bounds(ray, s, false);
        let Interval { low, high } = bounds.value;
        // No slope tells more where the values may be anything.
        let is_told = low > 0.0 || !(0.0..ANYTHING).contains(&high);
        match is_told || s.single().is_some() {
            true => bounds,
            false => self.bounds(ray, s, true),
        }
    }

    fn sample(&self, ray: &LocalRay, s: f64) -> Sample {
        let Bounds { value: Interval { low, high }, slope } =
            self.bounds(ray, Interval::point(s), true);
        Sample {
            value: 0.5 * (low + high),
            slope: 0.5 * (slope.low + slope.high),
            error: 0.5 * (high - low),
        }
    }

    /// Returns the value and its gradient at a point.
    fn at(&self, point: Vector) -> (Interval, Vector) {
        let axes = [Vector::X, Vector::Y, Vector::Z].map(|axis| self.way(axis, 0.0));
        let (value, slopes) = self.escape(self.lift(point, 0.0), axes);
        (value, Vector::from_array(slopes.map(|slope| 0.5 * (slope.low + slope.high))))
    }

    /// Finds the crossings from a position on the line on; unless `all` is set, only up to the first that is
    /// certainly behind it.
    fn search(&self, ray: &LocalRay, from: f64, all: bool, found: &mut Crossings) {
        let radius = self.radius();
        let blur = ray.blur_at(radius);
        // There its ball is outside as a whole.
        let far = radius + (256.0 * U * radius + 16.0 * blur) / self.normal[3].abs();
        let reach = (far * far - ray.nearest.length_squared()).sqrt();
        if reach.is_nan() || from >= reach {
            return;
        }
        let least = 8.0 * (blur + U * radius);
        let fineness = Fineness { resolution: FINEST * radius, least };
        let mut search = Search::new(|s| self.looked_at(ray, s), fineness);
        // With what lies around the place from which on it is searched.
        let mut place = (from - 64.0 * least).max(-reach);
        let mut told = 0;
        // How long the next stretch may be, and the next piece where there is none.
        let (mut most, mut piece) = (FIRST * radius, SHORTEST * radius);
        while place < reach {
            let (next, is_told) = match self.stretch(ray, place, most) {
                Some((far, escapes)) if far > 0.25 * piece => {
                    most = if far < most { 2.0 * far } else { 4.0 * most };
                    piece = SHORTEST * radius;
                    let next = (place + far).min(reach);
                    search.certain(place, next, !escapes);
                    (next, true)
                }
                Some(_) if most > piece => {
                    most *= 0.25;
                    continue;
                }
                stretch => {
                    let next = if stretch.is_some() { (place + piece).min(reach) } else { reach };
                    search.begin(place, next, Interval::EVERYTHING);
                    piece *= 2.0;
                    most = 2.0 * piece;
                    (next, false)
                }
            };
            let mut goes_on = true;
            while goes_on {
                goes_on = !is_told && search.goes_on();
                for change in &search.found().all[told..] {
                    let (outside, inside) = match change.rising {
                        true => (change.after, change.before),
                        false => (change.before, change.after),
                    };
                    let root =
                        root(|s| self.sample(ray, s), (outside, inside), f64::NAN, ray.tolerance);
                    let leaving = change.rising;
                    found.push(Met { t: root.t, error: root.error, leaving, part: 0 });
                    if !all && root.t - root.error > ray.ahead_of(from) {
                        return;
                    }
                }
                told = search.found().all.len();
            }
            place = next;
        }
    }
}

impl Local for JuliaFractal {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        self.search(ray, f64::NEG_INFINITY, true, found);
    }

    fn first_crossings(&self, ray: &LocalRay, (from, _): (f64, f64), found: &mut Crossings) {
        self.search(ray, from, false, found);
    }

    fn part_at(&self, _: &LocalRay, _: f64, _: bool) -> Option<u32> {
        Some(0)
    }

    fn height(&self, _: u32, point: Vector) -> Height {
        let (Interval { low, high }, gradient) = self.at(point);
        let (value, steepness) = (0.5 * (low + high), gradient.length());
        if value.abs() <= FINEST * steepness && steepness.is_finite() {
            return Height { value, gradient, error: 0.5 * (high - low) };
        }
        // Where the map is steeper than numbers tell, the point is as near as its crossing was found.
        let outward = if point == Vector::ZERO { Vector::Y } else { point };
        let gradient = if steepness > 0.0 && steepness.is_finite() { gradient } else { outward };
        Height { value: 0.0, gradient, error: FAR * gradient.length() }
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let far = self.reach() * along.length() * (1.0 + 8.0 * U);
        (-far, far)
    }

    /// Not measured: assumed from similar shapes.
    fn price(&self) -> u64 {
        40 * u64::from(self.iterations)
    }

    fn reach(&self) -> f64 {
        self.radius()
    }

    fn numbers(&self) -> String {
        let Self { parameter: [x, y, z, w], algebra, iterations, normal: [a, b, c, d], distance } =
            self;
        format!(
            " <{x}, {y}, {z}, {w}> {algebra:?}, {iterations} iterations, slice <{a}, {b}, {c}, {d}> {distance}"
        )
    }

    fn is_iterated(&self) -> bool {
        true
    }

    fn contains(&self, point: Vector) -> bool {
        let (Interval { low, high }, _) = self.at(point);
        0.5 * (low + high) < 0.0
    }
}
