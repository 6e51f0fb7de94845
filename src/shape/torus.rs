//! Torus: in local space, √((ρ − `major`)² + z²) ≤ `minor`, ρ = √(x² + y²). If `minor` exceeds `major`, the
//! tube intersects itself, and the surface inside of it is omitted.
//!
//! The crossings of a line are the roots of a polynomial of degree 4, whose coefficients have the size of
//! `major`². For a thin tube that is too large, so no polynomial is formed: the height over the surface is
//! split into pieces with one root each.
//!
//! **Source:** for where it is convex, S. Boyd, L. Vandenberghe, "Convex Optimization" (2004), 3.1.3 and
//! 3.1.4.

use super::U;
use super::local::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;
use crate::math::elementary::cbrt;
use crate::math::roots::bracket::{Sample, root};

/// The line is searched from −`FAR` to `FAR`; the torus ends at 1.
const FAR: f64 = 2.0;

/// √((ρ − `major`)² + z²) ≤ `minor`, ρ = √(x² + y²), in local space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    /// Distance from the axis to the middle of the tube.
    pub major: f64,
    /// Radius of the tube; `major` + `minor` is 1.
    pub minor: f64,
}

/// A line, and the torus that it is intersected with. With s measured from the closest approach to the
/// centre, h = (ρ − R)² + z² − r² = s² + n² + R² − r² − 2Rρ, where ρ = √(e²(s − c)² + m²) is convex: half of
/// h′ is s − R·ρ′, and half of h″ is 1 − R·e²m²/ρ³. So h is convex except where ρ³ < R·e²m², around c.
struct Line<'a> {
    torus: &'a Torus,
    ray: &'a LocalRay<'a>,
    /// e², with e the line's speed across the axis.
    speed2: f64,
    /// −c·e².
    along: f64,
    /// (e·m)².
    cross2: f64,
}

/// Points where the line is certainly inside, on either side of the maximum of h, and a point between them
/// where it is certainly outside.
struct Parts {
    left: Option<Found>,
    crest: Option<f64>,
    right: Option<Found>,
}

/// Values at one point of the line.
struct Place {
    /// Height over the surface, and its slope.
    height: Sample,
    /// h, and half of its first two derivatives.
    h: f64,
    turn: f64,
    bend: f64,
}

/// Whether to search for a minimum or a maximum of h.
#[derive(Clone, Copy, PartialEq)]
enum Seek {
    Dip,
    Crest,
}

impl<'a> Line<'a> {
    fn new(torus: &'a Torus, ray: &'a LocalRay<'a>) -> Self {
        let (n, d) = (ray.nearest, ray.direction);
        let cross = n.x * d.y - n.y * d.x;
        let speed2 = d.x * d.x + d.y * d.y;
        Self { torus, ray, speed2, along: n.x * d.x + n.y * d.y, cross2: cross * cross }
    }

    fn parts(&self) -> Parts {
        let Self { speed2, cross2, .. } = *self;
        let speed = speed2.sqrt();
        let major = self.torus.major;
        // Where h begins to be concave: ρ there, and the share of ρ² that is not m².
        let rho = cbrt(major * cross2);
        let share = if rho > 0.0 { 1.0 - cross2 / speed2 / (rho * rho) } else { 1.0 };
        let all_convex = || {
            let right = self.seek(Seek::Dip, (-FAR, FAR), 0.0);
            Parts { left: None, crest: None, right }
        };
        let is_concave = speed2 > 0.0 && share >= 0.0;
        if !is_concave {
            return all_convex();
        }
        let (middle, half) = (-self.along / speed2, rho * share.sqrt() / speed);
        let (begin, end) = (middle - half, middle + half);
        // Half of h′ falls from the one to the other.
        let steepest = major * speed * share.sqrt();
        let (before, after) = (begin + steepest, end - steepest);
        // It cannot rise; rounding says so where all that is concave is a point.
        if before <= 0.0 && after >= 0.0 {
            return all_convex();
        }
        let seek = |is_there, piece, start| {
            if is_there { self.seek(Seek::Dip, piece, start) } else { None }
        };
        let left = seek(before > 0.0, (-FAR, begin), -major * speed);
        let right = seek(after < 0.0, (end, FAR), major * speed);
        let both = before > 0.0 && after < 0.0 && (left.is_some() || right.is_some());
        let crest = if both { self.seek(Seek::Crest, (begin, end), middle) } else { None };
        Parts { left, crest: crest.map(|crest| crest.s), right }
    }

    /// Returns the values at `s`.
    ///
    /// **Error** of the height, which is a distance to a circle: the error of the point, and the roundings of
    /// three squares and two roots.
    fn place(&self, s: f64) -> Place {
        let Torus { major, minor } = *self.torus;
        let (point, direction) = (self.ray.at(s), self.ray.direction);
        let rho = (point.x * point.x + point.y * point.y).sqrt();
        // On the axis ρ has no slope.
        let slope = (point.x * direction.x + point.y * direction.y) / rho.max(f64::MIN_POSITIVE);
        let off = rho - major;
        let middle = (off * off + point.z * point.z).sqrt();
        let value = middle - minor;
        let turn = off * slope + point.z * direction.z;
        let error = self.ray.blur_at(s) + 8.0 * U * (1.0 + s.abs());
        Place {
            height: Sample { value, slope: turn / middle, error },
            h: value * (middle + minor),
            turn,
            bend: 1.0 - major * self.cross2 / (rho * rho * rho),
        }
    }

    fn height(&self, s: f64) -> Sample {
        self.place(s).height
    }

    /// Searches between `low` and `high` for a point where the line is certainly inside (dip) or outside
    /// (crest). `None` if there is no such point, within rounding. h must be convex in that range for a dip,
    /// and concave for a crest.
    fn seek(&self, what: Seek, (mut low, mut high): (f64, f64), start: f64) -> Option<Found> {
        let mut s = if low < start && start < high { start } else { 0.5 * (low + high) };
        let mut step = f64::INFINITY;
        loop {
            let Place { height, h, turn, bend } = self.place(s);
            let (is_found, down, beyond) = match what {
                Seek::Dip => (height.is_inside(), turn, height.is_outside()),
                Seek::Crest => (height.is_outside(), -turn, height.is_inside()),
            };
            if is_found {
                return Some(Found { s, h, turn, bend });
            }
            if down > 0.0 {
                high = s;
            } else {
                low = s;
            }
            // A dip is no deeper than the tangent goes down in what is left.
            let left = if down > 0.0 { s - low } else { high - s };
            if beyond && h.abs() > 2.0 * turn.abs() * left {
                return None;
            }
            let middle = 0.5 * (low + high);
            let newton = s - turn / bend;
            let is_fast = 2.0 * (newton - s).abs() < step && low < newton && newton < high;
            let next = if is_fast { newton } else { middle };
            step = (next - s).abs();
            // Nothing lies between them, or rounding leads no further.
            if !(low < next && next < high) || step <= U * s.abs() {
                return None;
            }
            s = next;
        }
    }

    fn met(&self, outside: f64, inside: &Found, leaving: bool) -> Met {
        let start = inside.guess((outside - inside.s).signum());
        let found = root(|s| self.height(s), (outside, inside.s), start, self.ray.tolerance);
        Met { t: found.t, error: found.error, leaving, part: 0 }
    }
}

/// A point found by [`Line::seek`], with h and half of its first two derivatives.
struct Found {
    s: f64,
    h: f64,
    turn: f64,
    bend: f64,
}

impl Found {
    /// Returns where h would be 0 if it were a parabola, in the direction `way`.
    fn guess(&self, way: f64) -> f64 {
        let root = (self.turn * self.turn - self.bend * self.h).sqrt();
        self.s + (way * root - self.turn) / self.bend
    }
}

impl Torus {
    /// Adds the crossings that may lie behind `from`, until `is_enough` accepts one. The minima of h inside,
    /// and the maximum between them outside, divide the line into pieces with one root each, which are then
    /// bracketed.
    fn meet(
        &self,
        ray: &LocalRay,
        from: f64,
        found: &mut Crossings,
        is_enough: impl Fn(&Met) -> bool,
    ) {
        let line = Line::new(self, ray);
        let Parts { left, crest, right } = line.parts();
        let left_end = crest.or(right.is_none().then_some(FAR));
        let right_start = crest.or(left.is_none().then_some(-FAR));
        let (left, right) = (left.as_ref(), right.as_ref());
        let ends = [
            (Some(-FAR), left, false),
            (left_end, left, true),
            (right_start, right, false),
            (Some(FAR), right, true),
        ];
        for (outside, dip, leaving) in ends {
            if let (Some(outside), Some(dip)) = (outside, dip)
                && outside.max(dip.s) >= from
            {
                let met = line.met(outside, dip, leaving);
                found.push(met);
                if is_enough(&met) {
                    return;
                }
            }
        }
    }
}

impl Local for Torus {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        self.meet(ray, f64::NEG_INFINITY, found, |_| false);
    }

    fn first_crossings(&self, ray: &LocalRay, (from, _): (f64, f64), found: &mut Crossings) {
        let ahead = ray.ahead_of(from);
        self.meet(ray, from, found, |met| met.t - met.error > ahead);
    }

    fn part_at(&self, _: &LocalRay, _: f64, _: bool) -> Option<u32> {
        Some(0)
    }

    fn height(&self, _: u32, point: Vector) -> Height {
        let across = Vector::new(point.x, point.y, 0.0);
        let off = across.length() - self.major;
        let middle = (off * off + point.z * point.z).sqrt();
        let gradient = across.normalize_or(Vector::ZERO) * off + Vector::Z * point.z;
        Height {
            value: middle - self.minor,
            gradient: gradient / middle,
            error: 8.0 * U * (1.0 + middle),
        }
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let half =
            self.major * Vector::new(along.x, along.y, 0.0).length() + self.minor * along.length();
        (-half, half)
    }

    fn is_iterated(&self) -> bool {
        true
    }

    fn price(&self) -> u64 {
        19
    }

    fn reach(&self) -> f64 {
        self.major + self.minor
    }

    fn numbers(&self) -> String {
        format!(" major {} minor {}", self.major, self.minor)
    }

    fn contains(&self, point: Vector) -> bool {
        self.height(0, point).value < 0.0
    }
}
