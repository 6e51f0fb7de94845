//! Ovus: two spheres on the z axis, of radius `bottom` up from z = −1 and `top` down from z = 1, joined by
//! the surface that an arc tangent to both sweeps around the axis.
//!
//! The centre of the top sphere lies on the bottom one. The radius of the arc is twice that of the larger
//! sphere, and its centre lies beyond the axis: the swept surface is the inner part of a spindle torus. The
//! body is convex, and its normal is continuous.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.5.1.9; the radius of the arc: behaviour of POV-Ray, measured with
//! `trace`.

use super::U;
use super::local::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;
use crate::math::double::Double;
use crate::math::roots::bracket::{Root, Sample};
use crate::math::roots::convex::{Tangent, dip};

/// The line is searched from −`FAR` to `FAR`; the body ends at 1.
const FAR: f64 = 2.0;

/// Error, from rounding, of a normal or of the slope along a line.
const TURN: f64 = 16.0 * U;

/// An egg: two spheres on the z axis, joined by the surface that an arc sweeps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ovus {
    /// The radii of the spheres: `bottom` + `top`/2 is 1, `top` is less than twice `bottom`.
    pub bottom: f64,
    pub top: f64,
    /// Distance of the arc's centre beyond the axis.
    beyond: f64,
    /// Height of the arc's centre.
    centre: f64,
    /// Radius of the arc.
    arc: f64,
}

/// The part of the surface that is nearest.
#[derive(Clone, Copy)]
enum Part {
    Bottom,
    Side,
    Top,
}

impl Ovus {
    /// Builds an ovus from `top` and `bottom` at any scale.
    ///
    /// The distance of the arc's centre from that of each sphere is the difference of their radii. With b and
    /// t the radii of the spheres, the arc's centre is (4bt − t² − 2b²)/2b above that of the bottom sphere
    /// and (2b − t)·√(t(4b − t))/2b beyond the axis if b ≥ t, else (3t² − 4bt + 2b²)/2b and t·√(3(3t − 2b)(2b
    /// − t))/2b.
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

    /// Heights of the centres of the spheres.
    fn centres(&self) -> [f64; 2] {
        [self.bottom - 1.0, 1.0 - self.top]
    }

    /// Returns the part whose normal is along (`out`, `up`).
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

    /// Returns the distance to the surface and the outward direction. Adjacent circles of the profile are
    /// tangent where they join, so either may be used there.
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

    /// Returns the height along a line; it is the distance to the surface, which is convex.
    ///
    /// **Error** of the height: the error of the point, and the roundings of three squares, a root, and the
    /// parameters of the spheres and the arc, which are at most 4.
    fn tangent(&self, ray: &LocalRay) -> impl Fn(f64) -> Tangent {
        let slope_error = TURN + ray.turn;
        move |s: f64| {
            let Height { value, gradient, error } = self.height(0, ray.at(s));
            let error = error + ray.blur_at(s) + 2.0 * U * s.abs();
            Tangent { at: Sample { value, slope: gradient.dot(ray.direction), error }, slope_error }
        }
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

fn met(Root { t, error }: Root, leaving: bool) -> Met {
    Met { t, error, leaving, part: 0 }
}

impl Local for Ovus {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let tangent = self.tangent(ray);
        let Some(dip) = dip(&tangent, (-FAR, FAR), 0.0) else { return };
        let (enter, leave) =
            (dip.enter(&tangent, ray.tolerance), dip.leave(&tangent, ray.tolerance));
        found.extend([met(enter, false), met(leave, true)]);
    }

    fn first_crossings(&self, ray: &LocalRay, (from, _): (f64, f64), found: &mut Crossings) {
        let tangent = self.tangent(ray);
        let Some(dip) = dip(&tangent, (-FAR, FAR), 0.0) else { return };
        if dip.inside() >= from {
            let enter = dip.enter(&tangent, ray.tolerance);
            found.push(met(enter, false));
            if enter.t - enter.error > ray.ahead_of(from) {
                return;
            }
        }
        found.push(met(dip.leave(&tangent, ray.tolerance), true));
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
    /// Its distance in twice the precision.
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
