//! Ovus: two balls on the z axis, `bottom` up from z = −1 and `top` down from z = 1, and what an arc that
//! touches both from outside draws around that axis.
//!
//! The top ball's centre lies on the bottom one. The arc's radius is twice that of the greater ball, its
//! centre lies beyond the axis: the surface it draws is the inner part of a spindle torus. The whole is
//! convex, and its normal turns steadily.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.5.1.9; the arc's radius by POV-Ray's behaviour, asked by `trace`.

use super::U;
use super::body::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;
use crate::math::double::Double;
use crate::math::roots::bracket::{Root, Sample};
use crate::math::roots::convex::{Tangent, chord};

/// The line is followed so far to each side; the body ends at 1.
const FAR: f64 = 2.0;

/// How far rounding may turn a normal, or the slope along a line.
const TURN: f64 = 16.0 * U;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ovus {
    /// The radii of the balls: `bottom` + `top`/2 is 1, `top` less than twice `bottom`.
    pub bottom: f64,
    pub top: f64,
    /// How far the centre of the arc lies beyond the axis.
    beyond: f64,
    /// How high.
    centre: f64,
    /// The radius of the arc.
    arc: f64,
}

/// Which part of the surface is nearest.
#[derive(Clone, Copy)]
enum Part {
    Bottom,
    Side,
    Top,
}

impl Ovus {
    /// `top` and `bottom` at any size.
    ///
    /// The arc's centre is as far from those of the balls as its radius is greater than theirs. With b and
    /// t the radii, it is (4bt − t² − 2b²)/2b above that of the bottom ball and (2b − t)·√(t(4b − t))/2b
    /// beyond the axis where b ≥ t, else (3t² − 4bt + 2b²)/2b and t·√(3(3t − 2b)(2b − t))/2b.
    pub fn new(bottom: Double, top: Double) -> Self {
        let n = Double::from;
        let half = bottom + top * n(0.5);
        let (b, t) = (bottom / half, top / half);
        let is_bottom_greater = (t - b).round() <= 0.0;
        let twice = n(2.0) * b;
        let slack = twice - t;
        let (above, beyond, arc) = if is_bottom_greater {
            let beyond = slack * (t * (n(4.0) * b - t)).sqrt();
            (n(4.0) * b * t - t * t - n(2.0) * b * b, beyond, twice)
        } else {
            let beyond = t * (n(3.0) * (n(3.0) * t - twice) * slack).sqrt();
            (n(3.0) * t * t - n(4.0) * b * t + n(2.0) * b * b, beyond, n(2.0) * t)
        };
        Self {
            bottom: b.round(),
            top: t.round(),
            beyond: (beyond / twice).round(),
            centre: (above / twice + b - Double::ONE).round(),
            arc: arc.round(),
        }
    }

    /// Heights of the balls' centres.
    fn centres(&self) -> [f64; 2] {
        [self.bottom - 1.0, 1.0 - self.top]
    }

    /// Which part has a normal along (`out`, `up`).
    fn faces(&self, out: f64, up: f64) -> Part {
        let [low, high] = self.centres().map(|end| self.beyond * up - (end - self.centre) * out);
        if low < 0.0 {
            Part::Bottom
        } else if high > 0.0 {
            Part::Top
        } else {
            Part::Side
        }
    }

    /// The distance to the surface, and the way out. Two of the circles that it is made of touch where they
    /// join, so it does not matter much which of them is taken there.
    fn distance(&self, point: Vector) -> (f64, Vector) {
        let across = Vector::new(point.x, point.y, 0.0);
        let radius = across.length();
        let [low, high] = self.centres();
        let from = |end: f64| {
            let from = across + Vector::Z * (point.z - end);
            (from, from.length())
        };
        let side = |end: f64| self.beyond * (point.z - end) - (end - self.centre) * radius;
        if side(low) < 0.0 {
            let (out, length) = from(low);
            return (length - self.bottom, out / length);
        }
        if side(high) > 0.0 {
            let (out, length) = from(high);
            return (length - self.top, out / length);
        }
        let (out, up) = (radius + self.beyond, point.z - self.centre);
        let length = (out * out + up * up).sqrt();
        let away = across / radius.max(f64::MIN_POSITIVE);
        (length - self.arc, (away * out + Vector::Z * up) / length)
    }

    fn greatest(&self, along: Vector) -> f64 {
        let out = Vector::new(along.x, along.y, 0.0).length();
        let [low, high] = self.centres();
        match self.faces(out, along.z) {
            Part::Bottom => low * along.z + self.bottom * along.length(),
            Part::Top => high * along.z + self.top * along.length(),
            Part::Side => self.centre * along.z - self.beyond * out + self.arc * along.length(),
        }
    }
}

impl Local for Ovus {
    /// The height over it is its distance, which is convex.
    ///
    /// **Error** of the height: how far the point may be off, and the roundings of three squares, a root and
    /// the numbers of the balls and the arc, whose greatest is 4.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let slope_error = TURN + ray.turn;
        let tangent = |s: f64| {
            let Height { value, gradient, error } = self.height(0, ray.at(s));
            let error = error + ray.blur_at(s) + 2.0 * U * s.abs();
            Tangent { at: Sample { value, slope: gradient.dot(ray.direction), error }, slope_error }
        };
        let Some([enter, leave]) = chord(tangent, (-FAR, FAR), ray.tolerance) else { return };
        let met = |Root { t, error }, leaving| Met { t, error, leaving, part: 0 };
        found.extend([met(enter, false), met(leave, true)]);
    }

    fn part_at(&self, _: &LocalRay, _: f64, _: bool) -> Option<u32> {
        Some(0)
    }

    fn height(&self, _: u32, point: Vector) -> Height {
        let (value, gradient) = self.distance(point);
        Height { value, gradient, error: 16.0 * U * (2.0 + point.length()) }
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        (-self.greatest(-along), self.greatest(along))
    }

    fn price(&self) -> u64 {
        20
    }

    fn reach(&self) -> f64 {
        1.0
    }

    fn numbers(&self) -> String {
        format!(" bottom {} top {}", self.bottom, self.top)
    }

    fn is_iterated(&self) -> bool {
        true
    }

    fn contains(&self, point: Vector) -> bool {
        self.distance(point).0 < 0.0
    }
}

#[cfg(test)]
impl Ovus {
    /// Its distance in twice the digits.
    pub(super) fn exactly(&self, [x, y, z]: super::exact::Triple) -> super::exact::Double {
        use super::exact::Double;
        let n = Double::of;
        let radius = (x * x + y * y).sqrt();
        let [low, high] = [n(self.bottom) - n(1.0), n(1.0) - n(self.top)];
        let side = |end: Double| n(self.beyond) * (z - end) - (end - n(self.centre)) * radius;
        let (out, up, size) = if side(low).0 < 0.0 {
            (radius, z - low, self.bottom)
        } else if side(high).0 > 0.0 {
            (radius, z - high, self.top)
        } else {
            (radius + n(self.beyond), z - n(self.centre), self.arc)
        };
        (out * out + up * up).sqrt() - n(size)
    }
}
