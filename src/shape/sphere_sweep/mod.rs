//! Sphere sweep: all spheres whose centre and radius follow piecewise polynomials of degree 3.
//!
//! A line intersects a sphere between two positions, which vary continuously as the sphere moves. So the
//! spheres of a range in which the line intersects every one cover a single piece of the line, from the
//! minimum of the entries to the maximum of the exits.
//!
//! **Source:** J. van Wijk, "Ray tracing objects defined by sweeping a sphere", Computers & Graphics 9
//! (1985).

mod along;

use smallvec::SmallVec;

use super::local::{Crossings, Height, Local, LocalRay, Met};
use super::tree::Tree;
use super::{Bounds, U};
use crate::math::Vector;

/// Number of ranges in a segment that a part number distinguishes, in addition to the segment.
const STRETCHES: f64 = 1024.0;
/// Number of adjacent boxes around a segment: a single box would be mostly empty.
const BOXES: u32 = 8;
/// The parameter range of a segment.
const WHOLE: (f64, f64) = (0.0, 1.0);

/// Spheres whose centre and radius are c₀ + c₁u + c₂u² + c₃u³ for u from 0 to 1. A negative radius counts as
/// its absolute value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    pub centre: [Vector; 4],
    pub radius: [f64; 4],
}

impl Segment {
    fn is_straight(&self) -> bool {
        self.centre[2..] == [Vector::ZERO; 2] && self.radius[2..] == [0.0; 2]
    }
}

/// All spheres whose centre and radius follow piecewise polynomials.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereSweep {
    segments: Vec<Segment>,
    /// For each box in the tree, which contains one range of a segment, the index of that segment.
    owners: Vec<u32>,
    tree: Tree,
    reach: f64,
}

fn cubic(c: [f64; 4], u: f64) -> f64 {
    ((c[3] * u + c[2]) * u + c[1]) * u + c[0]
}

/// Returns where c₁ + 2c₂u + 3c₃u² is 0 in a range, and both of its ends.
fn extremes([_, b, c, d]: [f64; 4], (from, to): (f64, f64)) -> impl Iterator<Item = f64> {
    let root = (c * c - 3.0 * d * b).sqrt();
    let q = -(c + root.copysign(c));
    let within = move |u: &f64| from < *u && *u < to;
    [q / (3.0 * d), b / q].into_iter().filter(within).chain([from, to])
}

impl Segment {
    fn centre_at(&self, u: f64) -> Vector {
        let [a, b, c, d] = self.centre;
        ((d * u + c) * u + b) * u + a
    }

    fn radius_at(&self, u: f64) -> f64 {
        cubic(self.radius, u)
    }

    /// Rounding error of a centre or a surface.
    fn rounding(&self) -> f64 {
        let centre: f64 = self.centre.iter().map(|c| c.length()).sum();
        8.0 * U * (centre + self.radius.iter().map(|r| r.abs()).sum::<f64>())
    }

    fn greatest(&self, along: Vector, stretch: (f64, f64)) -> f64 {
        let size = along.length();
        let place = self.centre.map(|c| c.dot(along));
        let reach = |way: f64| {
            let sum = [0, 1, 2, 3].map(|k| place[k] + way * size * self.radius[k]);
            extremes(sum, stretch).map(|u| cubic(sum, u)).fold(f64::NEG_INFINITY, f64::max)
        };
        reach(1.0).max(reach(-1.0)) + size * self.rounding()
    }

    fn bounds(&self, stretch: (f64, f64)) -> Bounds {
        let axes = [Vector::X, Vector::Y, Vector::Z];
        let high = axes.map(|axis| self.greatest(axis, stretch));
        let low = axes.map(|axis| -self.greatest(-axis, stretch));
        Bounds { low: Vector::from_array(low), high: Vector::from_array(high) }
    }

    /// Upper bound on the distance of any sphere from the origin: that of the spheres at the four control
    /// points.
    fn reach(&self) -> f64 {
        let [a, b, c, d] = self.centre;
        let [p, q, r, s] = self.radius;
        let centres = [a, a + b / 3.0, a + (b * 2.0 + c) / 3.0, a + b + c + d];
        let radii = [p, p + q / 3.0, p + (2.0 * q + r) / 3.0, p + q + r + s];
        let reach = |(centre, radius): (Vector, f64)| centre.length() + radius.abs();
        centres.into_iter().zip(radii).map(reach).fold(0.0, f64::max) + self.rounding()
    }

    /// Returns the distance of a point from the sphere at u, with its first two derivatives.
    fn distance(&self, point: Vector, u: f64) -> [f64; 3] {
        let ([_, b, c, d], [_, q, r, s]) = (self.centre, self.radius);
        let from = point - self.centre_at(u);
        let length = from.length();
        let unit = from / length;
        let (speed, bend) = ((d * (3.0 * u) + c * 2.0) * u + b, d * (6.0 * u) + c * 2.0);
        let radius = self.radius_at(u);
        let way = radius.signum();
        let (radius_speed, radius_bend) =
            (way * ((3.0 * s * u + 2.0 * r) * u + q), way * (6.0 * s * u + 2.0 * r));
        let along = unit.dot(speed);
        [
            length - radius.abs(),
            -along - radius_speed,
            (speed.length_squared() - along * along) / length - unit.dot(bend) - radius_bend,
        ]
    }

    /// Returns the parameter, near u, of the sphere nearest to a point.
    fn nearest(&self, point: Vector, u: f64) -> f64 {
        let (mut best, mut least) = (u, self.distance(point, u));
        for _ in 0..16 {
            let [value, slope, bend] = least;
            let step = if bend > 0.0 { slope / bend } else { slope.signum() / STRETCHES };
            let next = (best - step).clamp(0.0, 1.0);
            let there = self.distance(point, next);
            if next == best || there[0] >= value || there[0].is_nan() {
                break;
            }
            (best, least) = (next, there);
        }
        best
    }
}

impl SphereSweep {
    /// Builds it from finite segments; `None` if there are none.
    pub fn new(segments: Vec<Segment>) -> Option<Self> {
        if segments.is_empty() {
            return None;
        }
        let part = |i: u32| (f64::from(i) / f64::from(BOXES), f64::from(i + 1) / f64::from(BOXES));
        let boxes = segments.iter().flat_map(|one| (0..BOXES).map(move |i| one.bounds(part(i))));
        let (tree, order) = Tree::build(&boxes.collect::<Vec<_>>());
        let owners = order.into_iter().map(|i| i / BOXES).collect();
        let reach = segments.iter().map(Segment::reach).fold(0.0, f64::max) * (1.0 + 8.0 * U);
        Some(Self { segments, owners, tree, reach })
    }

    /// Returns its extent over the radius of its largest sphere.
    pub fn slenderness(&self) -> f64 {
        let radii = |one: &Segment| {
            extremes(one.radius, WHOLE).map(|u| one.radius_at(u).abs()).fold(0.0, f64::max)
        };
        self.reach / self.segments.iter().map(radii).fold(0.0, f64::max)
    }
}

fn part(segment: usize, u: f64) -> u32 {
    let stretch = (u * STRETCHES).min(STRETCHES - 1.0) as u32;
    // Beyond four million segments all are taken for one.
    (segment as u32).saturating_mul(STRETCHES as u32).saturating_add(stretch).min(Met::UNSEEN - 1)
}

impl Local for SphereSweep {
    /// Adds the pieces of the line that lie in segments; pieces that touch are merged.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings) {
        let mut pieces: SmallVec<[(Met, Met); 8]> = SmallVec::new();
        let mut near: SmallVec<[u32; 16]> = SmallVec::new();
        self.tree.along(ray, ray.blur_at(self.reach) + 4.0 * U, |run| {
            near.extend_from_slice(&self.owners[run]);
        });
        near.sort_unstable();
        near.dedup();
        for number in near {
            let number = number as usize;
            along::pieces(&self.segments[number], ray, |[enter, leave]| {
                let met = |place: along::Place, leaving| Met {
                    t: place.s,
                    error: place.error,
                    leaving,
                    part: part(number, place.u),
                };
                pieces.push((met(enter, false), met(leave, true)));
            });
        }
        pieces.sort_unstable_by(|a, b| a.0.t.total_cmp(&b.0.t).then(a.0.part.cmp(&b.0.part)));
        let mut pieces = pieces.into_iter();
        let Some(mut last) = pieces.next() else { return };
        for (enter, leave) in pieces {
            if enter.t - enter.error <= last.1.t + last.1.error {
                last = (last.0.earlier(enter), last.1.later(leave));
            } else {
                found.extend([last.0, last.1]);
                last = (enter, leave);
            }
        }
        found.extend([last.0, last.1]);
    }

    fn height(&self, part: u32, point: Vector) -> Height {
        let number = (part / STRETCHES as u32) as usize;
        let Some(segment) = self.segments.get(number) else {
            return Height { value: 0.0, gradient: Vector::Y, error: 0.0 };
        };
        let stretch = f64::from(part % STRETCHES as u32);
        let u = segment.nearest(point, (stretch + 0.5) / STRETCHES);
        let from = point - segment.centre_at(u);
        let length = from.length();
        Height {
            value: length - segment.radius_at(u).abs(),
            gradient: from / length,
            error: segment.rounding() + 4.0 * U * length,
        }
    }

    fn extent(&self, along: Vector) -> (f64, f64) {
        let greatest = |along: Vector| {
            self.tree.greatest(along, |run| {
                let owners = self.owners[run].iter().map(|&owner| &self.segments[owner as usize]);
                let reach = owners.map(|segment| segment.greatest(along, WHOLE));
                reach.fold(f64::NEG_INFINITY, f64::max)
            })
        };
        (-greatest(-along), greatest(along))
    }

    fn price(&self) -> u64 {
        let of_one = |segment: &Segment| if segment.is_straight() { 3 } else { 17 };
        30 + self.segments.iter().map(of_one).sum::<u64>()
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn numbers(&self) -> String {
        format!(" of {}", self.segments.len())
    }

    /// Determined by a line through the point.
    fn contains(&self, point: Vector) -> bool {
        let (nearest, direction) = (Vector::new(0.0, point.y, point.z), Vector::X);
        let ray = LocalRay::exact(nearest, direction);
        let mut found = Crossings::new();
        self.crossings(&ray, &mut found);
        found.iter().filter(|met| met.t < point.x).count() % 2 == 1
    }

    fn is_iterated(&self) -> bool {
        true
    }
}

#[cfg(test)]
impl SphereSweep {
    /// The distance to the nearest sphere in twice the precision; which sphere is nearest is determined in
    /// `f64`.
    pub(super) fn exactly(&self, point: super::exact::Triple) -> super::exact::Double {
        use super::exact::{Double, dot, minus, triple};
        const LOOKS: usize = 257;
        let n = Double::of;
        let near = Vector::new(point[0].0, point[1].0, point[2].0);
        let distance = |segment: &Segment, u: Double| {
            let [a, b, c, d] = segment.centre.map(triple);
            let centre = [0, 1, 2].map(|i| ((d[i] * u + c[i]) * u + b[i]) * u + a[i]);
            let [p, q, r, s] = segment.radius.map(n);
            let from = minus(point, centre);
            dot(from, from).sqrt() - (((s * u + r) * u + q) * u + p).abs()
        };
        let mut best = n(1000.0);
        for segment in &self.segments {
            let value_at = |u: f64| segment.distance(near, u)[0];
            let place = |k: usize| k as f64 / (LOOKS - 1) as f64;
            let values: [f64; LOOKS] = std::array::from_fn(|k| value_at(place(k)));
            let (mut at, mut least) = (0.0, f64::INFINITY);
            for k in 0..LOOKS {
                let around = &values[k.saturating_sub(1)..LOOKS.min(k + 2)];
                if around.iter().any(|value| *value < values[k]) {
                    continue;
                }
                let u = segment.nearest(near, place(k));
                let value = value_at(u);
                if value < least {
                    (at, least) = (u, value);
                }
            }
            // What is left of the slope is of the second order.
            let value = distance(segment, n(at));
            if (value - best).0 < 0.0 {
                best = value;
            }
        }
        best
    }
}
