//! Reference crossings in twice the precision of `f64`, for testing the kernels.
//!
//! **Source:** T. Dekker, "A floating-point technique for extending the available precision", Numerische
//! Mathematik 18 (1971), p. 224; two_sum: D. Knuth, TAOCP vol. 2, §4.2.2.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Box_, Ray};
use crate::math::placement::Placement;
use crate::math::{Matrix, Vector, reciprocal_power_of_two};

/// A sum of two numbers that do not overlap: about 106 bits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Double(pub f64, pub f64);

impl Double {
    pub fn of(x: f64) -> Self {
        Self(x, 0.0)
    }

    fn sum(a: f64, b: f64) -> Self {
        let s = a + b;
        let part = s - a;
        Self(s, (a - (s - part)) + (b - part))
    }

    fn product(a: f64, b: f64) -> Self {
        let p = a * b;
        Self(p, a.mul_add(b, -p))
    }

    pub fn sqrt(self) -> Self {
        if self.0 <= 0.0 {
            return Self(0.0, 0.0);
        }
        let root = self.0.sqrt();
        let rest = self - Self::product(root, root);
        Self::sum(root, rest.0 / (2.0 * root))
    }

    pub fn abs(self) -> Self {
        if self.0 < 0.0 { -self } else { self }
    }
}

impl Double {
    /// Reduces the argument by powers of two, then evaluates the Taylor series at 1/256 of the remainder.
    pub fn exp(self) -> Self {
        let ln_2 = Self(std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17);
        let power = (self.0 / ln_2.0).round();
        if power < -1000.0 {
            return Self::of(0.0);
        }
        let rest = (self - ln_2 * Self::of(power)) * Self::of(1.0 / 256.0);
        let series = (1..16)
            .rev()
            .fold(Self::of(1.0), |sum, k| Self::of(1.0) + rest * sum / Self::of(f64::from(k)));
        let value = (0..8).fold(series, |value, _| value * value);
        let scale = crate::math::double::power_of_two(power as i32);
        Self(value.0 * scale, value.1 * scale)
    }

    /// Logarithm of a positive number, by one Newton step.
    pub fn ln(self) -> Self {
        let near = Self::of(crate::math::elementary::log(self.0));
        near + (self * (-near).exp() - Self::of(1.0))
    }

    /// 0 to any power is 0.
    pub fn pow(self, exponent: Self) -> Self {
        if self.0 <= 0.0 { Self::of(0.0) } else { (self.ln() * exponent).exp() }
    }
}

impl Add for Double {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.0, other.0), Self::sum(self.1, other.1));
        let first = Self::sum(high.0, high.1 + low.0);
        Self::sum(first.0, first.1 + low.1)
    }
}

impl Neg for Double {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Sub for Double {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let p = Self::product(self.0, other.0);
        Self::sum(p.0, p.1 + (self.0 * other.1 + self.1 * other.0))
    }
}

impl Div for Double {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.0 / other.0;
        let rest = self - other * Self::of(first);
        let second = rest.0 / other.0;
        let rest = rest - other * Self::of(second);
        Self::sum(first, second) + Self::of(rest.0 / other.0)
    }
}

pub(super) type Triple = [Double; 3];

pub(super) fn triple(v: Vector) -> Triple {
    [v.x, v.y, v.z].map(Double::of)
}

pub(super) fn minus(a: Triple, b: Triple) -> Triple {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn dot(a: Triple, b: Triple) -> Double {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the discriminant b² − a·c of a·t² + 2·b·t + c, and the roots in order if it is positive.
fn quadratic(a: Double, b: Double, c: Double) -> (Double, Option<[Double; 2]>) {
    let discriminant = b * b - a * c;
    if discriminant.0 <= 0.0 {
        return (discriminant, None);
    }
    let root = discriminant.sqrt();
    let q = if b.0 > 0.0 { -b - root } else { root - b };
    let (one, other) = (q / a, c / q);
    (discriminant, Some(if b.0 > 0.0 { [one, other] } else { [other, one] }))
}

/// Returns h² in units of r², and the crossings of a ray with a sphere. The direction is used as it is, not
/// as if its length were 1. All values are first scaled by a power of two.
pub(super) fn sphere(centre: Vector, radius: f64, ray: &Ray) -> (f64, Option<[Double; 2]>) {
    let scale = reciprocal_power_of_two(radius);
    let start = minus(triple(ray.origin * scale), triple(centre * scale));
    let direction = triple(ray.direction);
    let radius = Double::of(radius * scale);
    let c = dot(start, start) - radius * radius;
    let (discriminant, roots) = quadratic(dot(direction, direction), dot(start, direction), c);
    let up = Double::of(1.0 / scale);
    let share = discriminant / (radius * radius);
    (share.0, roots.map(|roots| roots.map(|t| t * up)))
}

/// Returns the crossing of the line with the plane.
pub(super) fn plane(normal: Vector, distance: f64, ray: &Ray) -> Double {
    let normal = triple(normal);
    (Double::of(distance) - dot(normal, triple(ray.origin))) / dot(normal, triple(ray.direction))
}

pub(super) fn above_plane(normal: Vector, distance: f64, point: Vector) -> f64 {
    (dot(triple(normal), triple(point)) - Double::of(distance)).0
}

/// Outward distance of a point from a sphere.
pub(super) fn above_sphere(centre: Vector, radius: f64, point: Vector) -> f64 {
    let scale = reciprocal_power_of_two(radius);
    let start = minus(triple(point * scale), triple(centre * scale));
    (dot(start, start).sqrt() - Double::of(radius * scale)).0 / scale
}

/// Returns the entry and exit of the line through three slabs; the line misses if the exit precedes the
/// entry.
pub(super) fn slabs(box_: &Box_, ray: &Ray) -> [Double; 2] {
    let start = minus(triple(ray.origin), triple(box_.centre));
    let less = |a: Double, b: Double| (a - b).0 < 0.0;
    let (mut enter, mut leave) = (Double::of(f64::NEG_INFINITY), Double::of(f64::INFINITY));
    for (normal, half_width) in box_.normals.iter().zip(box_.half_widths) {
        let normal = triple(normal.get());
        let (place, speed) = (dot(normal, start), dot(normal, triple(ray.direction)));
        let half = Double::of(if speed.0 < 0.0 { -half_width } else { half_width });
        if speed.0 == 0.0 {
            if place.abs().0 > half_width {
                return [Double::of(1.0), Double::of(-1.0)];
            }
            continue;
        }
        let (near, far) = ((-half - place) / speed, (half - place) / speed);
        if enter.0 == f64::NEG_INFINITY || less(enter, near) {
            enter = near;
        }
        if leave.0 == f64::INFINITY || less(far, leave) {
            leave = far;
        }
    }
    [enter, leave]
}

/// Outward distance of a point from the plane of a given face.
pub(super) fn above_face(box_: &Box_, face: u32, point: Vector) -> f64 {
    let axis = (face / 2) as usize;
    let place = dot(triple(box_.normals[axis].get()), minus(triple(point), triple(box_.centre)));
    let place = if face.is_multiple_of(2) { place } else { -place };
    (place - Double::of(box_.half_widths[axis])).0
}

pub(super) fn local(matrix: &Matrix, v: Triple) -> Triple {
    let rows = matrix.transpose();
    [rows.x_axis, rows.y_axis, rows.z_axis].map(|row| dot(triple(row), v))
}

/// Returns the equivalent of [`sphere`] for the set |L·(P − C)| = 1.
pub(super) fn ellipsoid(placement: &Placement, ray: &Ray) -> (f64, Option<[Double; 2]>) {
    let matrix = &placement.local_from_world;
    let start = local(matrix, minus(triple(ray.origin), triple(placement.centre)));
    let direction = local(matrix, triple(ray.direction));
    let a = dot(direction, direction);
    let (discriminant, roots) =
        quadratic(a, dot(start, direction), dot(start, start) - Double::of(1.0));
    ((discriminant / a).0, roots)
}

/// Returns |L·(P − C)| − 1.
pub(super) fn above_ellipsoid(placement: &Placement, point: Vector) -> f64 {
    let place = minus(triple(point), triple(placement.centre));
    let place = local(&placement.local_from_world, place);
    (dot(place, place).sqrt() - Double::of(1.0)).0
}
