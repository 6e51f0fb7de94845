//! Superellipsoid: the *gauge* ((|x|^2/e + |y|^2/e)^e/n + |z|^2/n)^n/2 is at most 1. The gauge is
//! proportional to the distance from the origin. `east` is e, `north` is n.
//!
//! Numbers above 1 are raised only to exponents below 1, so that nothing overflows or vanishes, however small
//! the exponents. If both are at most 2, the gauge is a norm and convex. Otherwise, the body is concave
//! toward its axes and a line may cross it often, but only within the *hull*, the body whose exponents are
//! limited to 2. If both are at least 2, the gauge is concave in each octant.

mod norms;

use std::cell::Cell;

use super::U;
use super::local::{Crossings, Height, Local, LocalRay, Met};
use crate::math::Vector;
use crate::math::interval::Interval;
use crate::math::power::Power;
use crate::math::roots::bracket::Root;
use crate::math::roots::convex::{Dip, dip};
use crate::math::roots::monotone::Walk;
use norms::{Norm, Norms};

/// Size, relative to the body's, of the box in which the line is searched.
const AROUND: f64 = 1.0625;

/// First part number of the two sides of plates that are too thin to be separated from their planes, axis by
/// axis.
const PLATES: u32 = 1;

/// Exponents that occur only in the derivatives: p − 1, q − 1 and q − p.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Slopes {
    round: Power,
    tall: Power,
    tall_over_round: Power,
}

/// ((|x|^2/e + |y|^2/e)^e/n + |z|^2/n)^n/2 ≤ 1, in local space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Superellipsoid {
    norms: Norms,
    slopes: Slopes,
    /// The smallest convex body of this kind that contains it.
    hull: Norms,
}

impl Superellipsoid {
    /// Builds a superellipsoid; both exponents must be positive.
    pub fn new(east: f64, north: f64) -> Self {
        let norms = Norms::new(east, north);
        let (p, q) = (norms.round.exponent, norms.tall.exponent);
        let slopes = Slopes {
            round: Power::new(p - 1.0),
            tall: Power::new(q - 1.0),
            tall_over_round: Power::new(q - p),
        };
        Self { norms, slopes, hull: Norms::new(east.min(2.0), north.min(2.0)) }
    }

    /// Minimum and maximum absolute value of each coordinate between two positions; none changes its sign
    /// there.
    fn sizes(ray: &LocalRay, Interval { low, high }: Interval) -> [Vector; 2] {
        let far = high.max(-low);
        let (a, b) = (ray.at(low).abs(), ray.at(high).abs());
        let blur = ray.blur_at(far) + 4.0 * U * (1.0 + far);
        [(a.min(b) - blur).max(Vector::ZERO), a.max(b) + blur]
    }

    /// Range of the gauge less 1: it increases with the absolute value of each coordinate.
    fn range(&self, sizes: [Vector; 2]) -> Interval {
        let [least, most] = sizes.map(|place| self.norms.gauge(place).value);
        let rounding = self.norms.rounding();
        Interval { low: least * (1.0 - rounding) - 1.0, high: most * (1.0 + rounding) - 1.0 }
    }

    /// Range of an expression with the sign of the gauge's slope: with N = (xᵖ + yᵖ)^1/p, N^(q−p)·(xᵖ⁻¹x′ +
    /// yᵖ⁻¹y′) + zᵠ⁻¹z′. `ways` are the signs of the coordinates.
    fn slopes(&self, ray: &LocalRay, ways: Vector, [least, most]: [Vector; 2]) -> Interval {
        // As much as a product of `Power` is rounded at most.
        let wide = |Interval { low, high }: Interval| Interval {
            low: low * (1.0 - 21.0 * U),
            high: high * (1.0 + 21.0 * U),
        };
        let power = |of: Interval, power: Power| wide(of.rising(|x| power.of(x.max(0.0))));
        let slope = |axis: usize, exponent: Power| {
            let way = ray.direction[axis] * ways[axis];
            let speed = Interval { low: way - ray.turn, high: way + ray.turn };
            power(Interval { low: least[axis], high: most[axis] }, exponent) * speed
        };
        let rounding = self.norms.rounding();
        let round = |v: Vector| self.norms.round.of(v.x, v.y).0;
        let round =
            Interval { low: round(least) * (1.0 - rounding), high: round(most) * (1.0 + rounding) };
        let Slopes { round: across, tall, tall_over_round } = self.slopes;
        power(round, tall_over_round) * (slope(0, across) + slope(1, across)) + slope(2, tall)
    }

    /// Returns where the line is in the box around the body; `None` where its blur hides that.
    fn around(&self, ray: &LocalRay) -> Option<(f64, f64)> {
        let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let (place, speed) = (ray.nearest[axis], ray.direction[axis]);
            if speed == 0.0 {
                if place.abs() > AROUND {
                    return None;
                }
                continue;
            }
            let (a, b) = ((-AROUND - place) / speed, (AROUND - place) / speed);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        let blur = ray.blur_at(enter.abs().max(leave.abs()));
        (enter < leave && 4.0 * blur < AROUND - 1.0).then_some((enter, leave))
    }

    /// Returns where the line enters or leaves a convex body.
    fn end(&self, ray: &LocalRay, dip: &Dip, leaving: bool) -> Met {
        let tangent = |s| self.norms.tangent(ray, s);
        let Root { t, error } = match leaving {
            false => dip.enter(tangent, ray.tolerance),
            true => dip.leave(tangent, ray.tolerance),
        };
        Met { t, error, leaving, part: 0 }
    }

    /// Returns an enclosure of where the line is in the hull; the line is certainly outside at both ends.
    fn in_hull(&self, ray: &LocalRay) -> Option<Dip> {
        dip(|s| self.hull.tangent(ray, s), self.around(ray)?, 0.0)
    }

    /// Finds the crossings of a body that is not convex, octant by octant: those that may lie in a range, up
    /// to the first that is certainly behind its start.
    fn hollow(&self, ray: &LocalRay, (from, to): (f64, f64), found: &mut Crossings) {
        let Some((low, high)) = self.in_hull(ray).map(|dip| dip.around()) else { return };
        if low > to || high < from {
            return;
        }
        let ahead = ray.ahead_of(from);
        let is_enough = Cell::new(false);
        let zero = |axis: usize| -ray.nearest[axis] / ray.direction[axis];
        let mut ends = [low, zero(0), zero(1), zero(2), high];
        ends.sort_unstable_by(f64::total_cmp);
        let sample = |s: f64| self.norms.tangent(ray, s).at;
        let mut walk = Walk::new(sample, ray.tolerance);
        let mut note = |Root { t, error }: Root, leaving: bool| {
            is_enough.set(is_enough.get() || t - error > ahead);
            found.push(Met { t, error, leaving, part: 0 });
        };
        walk.note(low, true, &mut note);
        let mut end = low;
        for pair in ends.windows(2) {
            let (begin, to) = (pair[0].max(low), pair[1].min(high));
            if is_enough.get() || begin.partial_cmp(&to) != Some(std::cmp::Ordering::Less) {
                continue;
            }
            end = to;
            if ray.ahead_of(to) < from {
                walk.advance(to, &mut note);
                continue;
            }
            let ways = ray.at(0.5 * (begin + to)).signum();
            let speeds = ray.direction * ways;
            // Away from all three planes, or toward them, the gauge grows or falls.
            let goes_one_way = speeds.min_element() > ray.turn || speeds.max_element() < -ray.turn;
            // What is concave is nowhere less than at both of its ends.
            let has_one_root = || {
                let is_concave = self.norms.is_concave();
                is_concave && (walk.sign_at(begin) == Some(true) || sample(to).is_outside())
            };
            if !goes_one_way && !has_one_root() {
                let value = |piece| self.range(Self::sizes(ray, piece));
                let slope = |piece| self.slopes(ray, ways, Self::sizes(ray, piece));
                walk.through((begin, to), value, slope, &mut note);
            } else if to < high {
                walk.advance(to, &mut note);
            }
        }
        if !is_enough.get() {
            walk.note(high, true, &mut note);
            end = high;
        }
        self.plates(ray, (low, end), found);
    }

    /// Adds the crossings with plates. If the exponents are large, the body is a plate in the plane of two
    /// axes, so thin that no third coordinate except 0 is inside; a line through that plane crosses it
    /// nevertheless.
    fn plates(&self, ray: &LocalRay, (low, high): (f64, f64), found: &mut Crossings) {
        let walked = found.len();
        for axis in 0..3 {
            let s = -ray.nearest[axis] / ray.direction[axis];
            let blur = ray.blur_at(s) + 4.0 * U * (1.0 + s.abs());
            if !(low < s && s < high) {
                continue;
            }
            let mut place = ray.at(s).abs() + blur;
            place[axis] = 0.0;
            let is_in = self.norms.gauge(place).value * (1.0 + self.norms.rounding()) < 1.0;
            let error = blur / ray.direction[axis].abs();
            let (walked, _) = found.split_at(walked);
            let is_met = walked.iter().any(|met| (met.t - s).abs() <= met.error + error);
            let before = walked.iter().rev().find(|met| met.t <= s);
            if !is_in || is_met || before.is_some_and(|met| !met.leaving) {
                continue;
            }
            // The side that the line comes from, and the other.
            let side = 2 * axis as u32 + u32::from(ray.direction[axis] < 0.0);
            found.push(Met { t: s, error, leaving: false, part: PLATES + side });
            found.push(Met { t: s, error, leaving: true, part: PLATES + (side ^ 1) });
        }
        if found.len() > walked {
            // Stable: what is entered and left in one place is entered first.
            found.sort_by(|a, b| a.t.total_cmp(&b.t));
        }
    }
}

impl Local for Superellipsoid {
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        if !self.norms.is_convex() {
            return self.hollow(ray, (f64::NEG_INFINITY, f64::INFINITY), found);
        }
        let Some(dip) = self.in_hull(ray) else { return };
        found.extend([false, true].map(|leaving| self.end(ray, &dip, leaving)));
    }

    fn first_crossings(&self, ray: &LocalRay, (from, to): (f64, f64), found: &mut Crossings) {
        if !self.norms.is_convex() {
            return self.hollow(ray, (from, to), found);
        }
        let Some(dip) = self.in_hull(ray) else { return };
        let (before, behind) = dip.around();
        if before > to || behind < from {
            return;
        }
        if dip.inside() >= from {
            let enter = self.end(ray, &dip, false);
            found.push(enter);
            if enter.t - enter.error > ray.ahead_of(from) {
                return;
            }
        }
        found.push(self.end(ray, &dip, true));
    }

    fn part_at(&self, ray: &LocalRay, s: f64, _: bool) -> Option<u32> {
        // Plates are met in the planes of the axes alone.
        let near = 8.0 * ray.blur_at(s) + 64.0 * U * (1.0 + s.abs());
        (self.norms.is_convex() || ray.at(s).abs().min_element() > near).then_some(0)
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        if let Some(side) = part.checked_sub(PLATES) {
            let axis = (side / 2).min(2) as usize;
            let sign = if side % 2 == 0 { -1.0 } else { 1.0 };
            return Height {
                value: sign * point[axis],
                gradient: Vector::AXES[axis] * sign,
                error: U * point.length(),
            };
        }
        let (value, gradient, _) = self.norms.at(point);
        Height { value: value - 1.0, gradient, error: self.norms.rounding() * value }
    }

    /// The dual norm; for a body that is not convex, that of the smallest convex body of this kind around it.
    ///
    /// **Source:** S. Boyd, L. Vandenberghe, *Convex Optimization* (2004), A.1.6: 1/p + 1/p′ = 1.
    fn extent(&self, along: Vector) -> (f64, f64) {
        let dual = |exponent: f64| (1.0 - 0.5 * exponent).max(0.0);
        let Vector { x, y, z } = along.abs();
        let (east, north) = (dual(self.norms.east), dual(self.norms.north));
        let half = largest(largest(x, y, east), z, north);
        (-half, half)
    }

    fn price(&self) -> u64 {
        260
    }

    fn reach(&self) -> f64 {
        // The farthest of (a·u, v) with uᵖ + vᵖ = 1, by Hölder's inequality.
        let farthest = |a: f64, exponent: f64| {
            let share = 0.5 - 0.5 * exponent;
            if share > 0.0 { largest(a, 1.0, share) } else { a.max(1.0) }
        };
        farthest(farthest(1.0, self.norms.east), self.norms.north) * (1.0 + 16.0 * U)
    }

    fn numbers(&self) -> String {
        format!(" {} {}", self.norms.east, self.norms.north)
    }

    fn is_iterated(&self) -> bool {
        true
    }

    fn contains(&self, point: Vector) -> bool {
        self.norms.gauge(point.abs()).value < 1.0
    }
}

/// Returns (aᵖ + bᵖ)^1/p for 1/p = `share`; the larger of the two if that is 0.
fn largest(a: f64, b: f64, share: f64) -> f64 {
    if share > 0.0 { Norm::new(share).of(a, b).0 } else { a.max(b) }
}

#[cfg(test)]
impl Superellipsoid {
    /// The gauge, less 1, in twice the precision.
    pub(super) fn exactly(&self, [x, y, z]: super::exact::Triple) -> super::exact::Double {
        use super::exact::Double;
        let one = Double::of(1.0);
        let norm = |a: Double, b: Double, exponent: f64| {
            let (most, least) = if (a - b).0 > 0.0 { (a, b) } else { (b, a) };
            if most.0 == 0.0 {
                return most;
            }
            let share = Double::of(exponent) * Double::of(0.5);
            most * (one + (least / most).pow(one / share)).pow(share)
        };
        norm(norm(x.abs(), y.abs(), self.norms.east), z.abs(), self.norms.north) - one
    }
}
