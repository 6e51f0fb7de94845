//! Cone: in local space, √(x² + y²) ≤ |w(z)|, |z| ≤ 1, where the width w goes from 1 at z = −1 to `cap` at z
//! = 1. If `cap` is negative, the solid is two cones that touch at their tips.
//!
//! **Source:** S. Boyd, L. Vandenberghe, *Convex Optimization* (2004), 3.1.3 (a norm less a linear function
//! is convex).

use super::U;
use super::cylinder::{BASE, CAP, SIDE, ends};
use super::local::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;
use crate::math::roots::bracket::{Sample, root};

/// The line is searched from −`FAR` to `FAR`; the cone ends at √2.
const FAR: f64 = 2.0;

/// √(x² + y²) ≤ |w(z)|, |z| ≤ 1, in local space; the width w goes from 1 at z = −1 to `cap` at z = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// Width at z = 1, from −1 to less than 1.
    pub cap: f64,
    /// Whether its ends are invisible; it is still solid.
    pub open: bool,
}

impl Cone {
    /// Decrease in width per unit length along the axis.
    fn slope(&self) -> f64 {
        0.5 * (1.0 - self.cap)
    }

    fn width(&self, z: f64) -> f64 {
        self.cap + self.slope() * (1.0 - z)
    }

    /// Returns where the line is inside the cone that is wide where `side`·w is positive, ignoring the ends.
    ///
    /// Along the line, with e its speed across the axis and m its distance from the axis, the height g =
    /// √(e²(s − c)² + m²) − `side`·w is convex: its minimum follows from g′ = 0, with one root on each side.
    /// **Error:** that of g, which changes by at most √2 times the displacement of a point.
    fn nappe(&self, ray: &LocalRay, side: f64) -> Option<(Met, Met)> {
        let (n, d) = (ray.nearest, ray.direction);
        let narrowing = side * self.slope() * d.z;
        let height = |s: f64| {
            let point = ray.at(s);
            let distance = (point.x * point.x + point.y * point.y).sqrt();
            Sample {
                value: distance - side * self.width(point.z),
                slope: (point.x * d.x + point.y * d.y) / distance + narrowing,
                error: 1.5 * ray.blur_at(s) + 8.0 * U * (2.0 + s.abs()),
            }
        };
        let speed2 = d.x * d.x + d.y * d.y;
        let (along, cross) = (n.x * d.x + n.y * d.y, n.x * d.y - n.y * d.x);
        let steep = speed2 - narrowing * narrowing;
        let deepest = match steep > 0.0 {
            true => (-along - narrowing * cross.abs() / steep.sqrt()) / speed2,
            false => -narrowing.signum() * FAR,
        };
        let deepest = deepest.clamp(-FAR, FAR);
        if !height(deepest).is_inside() {
            return None;
        }
        let width = side * self.width(n.z);
        let half = along + width * narrowing;
        let rest = n.x * n.x + n.y * n.y - width * width;
        let q = -(half + (half * half - steep * rest).max(0.0).sqrt().copysign(half));
        let guesses = (q / steep, rest / q);
        let end = |far: f64, leaving| {
            // Where it is met just there, twice as far tells so.
            let is_told = |far: f64| height(far).is_inside() || height(far).is_outside();
            let far = if is_told(far) { far } else { 2.0 * far };
            let last = height(far);
            if last.is_inside() {
                return Met { t: far * f64::INFINITY, error: 0.0, leaving, part: SIDE };
            } else if !last.is_outside() {
                // Along its side: it may be anywhere up to what is certainly inside.
                return Met { t: far, error: (far - deepest).abs(), leaving, part: SIDE };
            }
            let is_here = (guesses.0 - deepest) * far > 0.0;
            let start = if is_here { guesses.0 } else { guesses.1 };
            let found = root(height, (far, deepest), start, 0.0);
            Met { t: found.t, error: found.error, leaving, part: SIDE }
        };
        Some((end(-FAR, false), end(FAR, true)))
    }
}

impl Local for Cone {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let Some((first, last)) = ends(ray) else { return };
        let seen = |met: Met| match met.part {
            // An end of no width is the tip of its side.
            CAP if self.open && self.cap == 0.0 => Met { part: SIDE, ..met },
            CAP | BASE if self.open => Met { part: Met::UNSEEN, ..met },
            _ => met,
        };
        let chord = |side| {
            let (enter, leave) = self.nappe(ray, side)?;
            let (enter, leave) = (enter.later(first), leave.earlier(last));
            // What rounding cannot tell from a miss is missed.
            let is_told = enter.t + enter.error < leave.t - leave.error;
            is_told.then_some([seen(enter), seen(leave)])
        };
        let (wide, other) = (chord(1.0), if self.cap < 0.0 { chord(-1.0) } else { None });
        match (wide, other) {
            (Some(a), Some(b)) => {
                let ([enter, one], [two, leave]) = if a[0].t < b[0].t { (a, b) } else { (b, a) };
                found.push(enter);
                // At the tip it may be that rounding does not tell the one from the other.
                if one.t < two.t {
                    found.extend([one, two]);
                }
                found.push(leave);
            }
            (one, two) => found.extend(one.into_iter().chain(two).flatten()),
        }
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        match part {
            CAP => Height { value: point.z - 1.0, gradient: Vector::Z, error: U },
            BASE => Height { value: -point.z - 1.0, gradient: -Vector::Z, error: U },
            _ => {
                let (across, width) = (Vector::new(point.x, point.y, 0.0), self.width(point.z));
                let gradient = across.normalize_or(Vector::ZERO)
                    + Vector::Z * self.slope().copysign(width * self.slope());
                let value = across.length() - width.abs();
                Height { value, gradient, error: 8.0 * U * (1.0 + value.abs()) }
            }
        }
    }

    /// Extent of the two ends, whose convex hull contains the cone.
    fn extent(&self, along: Vector) -> (f64, f64) {
        let across = Vector::new(along.x, along.y, 0.0).length();
        let (base, cap) = (-along.z, along.z);
        let narrow = across * self.cap.abs();
        ((base - across).min(cap - narrow), (base + across).max(cap + narrow))
    }

    fn price(&self) -> u64 {
        10
    }

    fn reach(&self) -> f64 {
        std::f64::consts::SQRT_2
    }

    fn numbers(&self) -> String {
        format!(" cap {}{}", self.cap, if self.open { " open" } else { "" })
    }

    fn contains(&self, point: Vector) -> bool {
        let width = self.width(point.z);
        point.x * point.x + point.y * point.y < width * width && point.z.abs() < 1.0
    }
}
