//! The gauge of a superellipsoid: two norms, one inside the other, and their rounding.

use crate::math::Vector;
use crate::math::power::Power;
use crate::math::roots::bracket::Sample;
use crate::math::roots::convex::Tangent;
use crate::shape::U;
use crate::shape::local::LocalRay;

/// Upper limit of a gauge; larger values are clamped.
const MOST: f64 = 1e100;

/// The exponents of a gauge, and its two norms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Norms {
    pub east: f64,
    pub north: f64,
    /// Norm of x and y, with p = 2/e.
    pub round: Norm,
    /// Norm of that and z, with q = 2/n.
    pub tall: Norm,
}

/// The norm (aᵖ + bᵖ)^1/p for a, b ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Norm {
    /// p.
    pub exponent: f64,
    power: Power,
    root: Power,
}

impl Norm {
    /// Builds the norm with 1/p = `share`.
    pub fn new(share: f64) -> Self {
        let exponent = 1.0 / share;
        Self { exponent, power: Power::new(exponent), root: Power::new(share) }
    }

    /// Returns the norm, and the fraction of the sum that each of the two contributes.
    pub fn of(self, a: f64, b: f64) -> (f64, [f64; 2]) {
        let (most, least) = if a > b { (a, b) } else { (b, a) };
        if most == 0.0 {
            return (0.0, [0.5, 0.5]);
        }
        let part = self.power.of(least / most);
        let size = (most * self.root.of(1.0 + part)).min(MOST);
        let (greater, lesser) = (1.0 / (1.0 + part), part / (1.0 + part));
        (size, if a > b { [greater, lesser] } else { [lesser, greater] })
    }
}

/// The gauge at a point with no negative coordinate, and the fraction that each coordinate contributes.
pub(super) struct Gauge {
    pub value: f64,
    parts: Vector,
}

impl Norms {
    pub fn new(east: f64, north: f64) -> Self {
        Self { east, north, round: Norm::new(0.5 * east), tall: Norm::new(0.5 * north) }
    }

    pub fn is_convex(&self) -> bool {
        self.east.max(self.north) <= 2.0
    }

    /// Returns whether the gauge is concave in each octant.
    pub fn is_concave(&self) -> bool {
        self.east.min(self.north) >= 2.0
    }

    pub fn gauge(&self, Vector { x, y, z }: Vector) -> Gauge {
        let (round, [of_x, of_y]) = self.round.of(x, y);
        let (value, [of_round, of_z]) = self.tall.of(round, z);
        Gauge { value, parts: Vector::new(of_round * of_x, of_round * of_y, of_z) }
    }

    /// Relative rounding error of a gauge. With 1/p = e/2, the power of the ratio is off by 2p + 5 roundings
    /// and is at most half of the sum; the root of the sum is off by e/2 times as many plus 1, and by 5 + e/2
    /// of its own; likewise for the second norm.
    pub fn rounding(&self) -> f64 {
        U * (16.0 + 4.0 * self.east + 4.0 * self.north)
    }

    /// Error that the line's blur causes in a gauge. A norm of vectors of length `blur` is at most √3 times
    /// that.
    fn blurred(&self, place: Vector, Gauge { value, parts }: Gauge, blur: f64) -> f64 {
        if self.is_convex() {
            return 2.0 * blur;
        }
        // Its logarithm's slope along the logarithm of a coordinate is that one's part of it. While none is
        // moved by much, no part changes by as much as half, and this is less than twice too much.
        let moved = Vector::splat(blur) / place;
        let changed = moved.max_element() * (self.round.exponent + self.tall.exponent);
        if moved.is_finite() && changed < 0.0625 {
            return 2.0 * value * parts.dot(moved);
        }
        let more = self.gauge(place + blur).value;
        let less = self.gauge((place - blur).max(Vector::ZERO)).value;
        (more - value).max(value - less)
    }

    pub fn at(&self, point: Vector) -> (f64, Vector, Vector) {
        let place = point.abs();
        let Gauge { value, parts } = self.gauge(place);
        let slope = |axis: usize| match place[axis] {
            0.0 => 0.0,
            size => (value * (parts[axis] / size)).min(MOST).copysign(point[axis]),
        };
        (value, Vector::new(slope(0), slope(1), slope(2)), parts)
    }

    pub fn tangent(&self, ray: &LocalRay, s: f64) -> Tangent {
        let point = ray.at(s);
        let (value, gradient, parts) = self.at(point);
        let blur = ray.blur_at(s) + 2.0 * U * s.abs();
        let error =
            self.rounding() * value + self.blurred(point.abs(), Gauge { value, parts }, blur);
        let slope = gradient.dot(ray.direction);
        // A power with the exponent p is off by p roundings of its base, and there are no two parts that
        // are both of some size but near an edge.
        let (p, q) = (self.round.exponent, self.tall.exponent);
        let edges = p * parts.x.min(parts.y) + q * parts.z.min(1.0 - parts.z);
        let slope_error = (U * (32.0 + 16.0 * edges) + 2.0 * ray.turn).min(4.0);
        Tangent { at: Sample { value: value - 1.0, slope, error }, slope_error }
    }
}
