//! The local space of bodies, in which their equations are simple: rays, crossings and queries.
//!
//! **In:** a [`LocalRay`], a local point. **Out:** all crossings of the entire line, in order; the height
//! over a part of the surface. **Invariant:** entries and exits of closed bodies alternate; where rounding
//! cannot separate a hit from a miss, both crossings are dropped.

use smallvec::SmallVec;

use super::{Crossing, Placed, Ray, U};
use crate::math::Vector;

/// Queries that every body answers in its local space.
pub trait Local {
    /// Adds all crossings of the line with the surface, in order.
    fn crossings(&self, ray: &LocalRay, found: &mut Crossings);

    /// Returns whether `accepts` any of the crossings that may lie in the range `between`.
    fn crosses(&self, ray: &LocalRay, between: (f64, f64), accepts: &dyn Fn(&Met) -> bool) -> bool {
        let mut found = Crossings::new();
        self.first_crossings(ray, between, &mut found);
        found.iter().any(accepts)
    }

    /// Adds, in order, the crossings that may lie in the range `between`; where there are further crossings,
    /// at least up to the first visible one that is certainly behind the start of the range. May add others, which
    /// are certainly outside the range: their bounds may be wide.
    fn first_crossings(&self, ray: &LocalRay, _between: (f64, f64), found: &mut Crossings) {
        self.crossings(ray, found);
    }

    /// As [`Local::first_crossings`] for lines side by side, no more than a row, each with its range: calls `each`
    /// with the number of a line and what it finds, if that is anything.
    fn first_crossings_together(
        &self,
        lines: &[LocalRay],
        between: &[(f64, f64)],
        each: &mut dyn FnMut(usize, &mut Crossings),
    ) {
        first_crossings_one_by_one(self, lines, between, each);
    }

    /// As [`Local::crosses`] for lines side by side: a bit for each.
    fn crosses_together(
        &self,
        lines: &[LocalRay],
        between: &[(f64, f64)],
        accepts: &dyn Fn(usize, &Met) -> bool,
    ) -> u32 {
        crosses_one_by_one(self, lines, between, accepts)
    }

    /// Returns the part of the surface through which the line enters or leaves at `s`, where that is cheap to
    /// determine.
    fn part_at(&self, _ray: &LocalRay, _s: f64, _leaving: bool) -> Option<u32> {
        None
    }

    /// Returns the height of `point` over one part of the surface; valid near that part.
    fn height(&self, part: u32, point: Vector) -> Height;

    /// Returns the plane of a part, where that is flat and its [`Local::height`] is the height over the plane.
    fn facet(&self, _part: u32) -> Option<Facet> {
        None
    }

    /// Returns the minimum and maximum of `along`·P over the visible surface; infinite where it is unbounded.
    fn extent(&self, along: Vector) -> (f64, f64);

    /// Returns [`Local::extent`] without any margin for rounding.
    fn nearest_extent(&self, along: Vector) -> (f64, f64) {
        self.extent(along)
    }

    /// Returns the radius of a sphere around the local origin that contains the body; ∞ where there is none.
    fn reach(&self) -> f64;

    /// Returns whether a point lies inside. A sheet has no inside.
    fn contains(&self, point: Vector) -> bool;

    /// Returns whether a point certainly lies inside: `false` where rounding may decide, or where no caller
    /// asks.
    fn certainly_contains(&self, _point: Vector) -> bool {
        false
    }

    /// Returns the parameters that distinguish it from other bodies of its kind, for display; a blank
    /// precedes each.
    fn numbers(&self) -> String;

    /// Returns whether its crossings are found by iteration, which [`LocalRay::tolerance`] terminates.
    fn is_iterated(&self) -> bool {
        false
    }

    /// Returns the cost of intersecting a line, relative to solving the equation of a sphere. Measured on
    /// 2026-11-22 from render times of one body, per tested line, compared with one sphere; accurate within a
    /// factor of 2.
    fn price(&self) -> u64;

    /// Returns whether it is a sheet: it has no inside, and a ray that passes through is outside before and
    /// after.
    fn is_sheet(&self) -> bool {
        false
    }

    /// Returns the shading normal of a part at a point, of any length and on either side; `None` where it is
    /// the geometric normal.
    fn shading_normal(&self, _part: u32, _point: Vector) -> Option<Vector> {
        None
    }
}

/// Calls `each` with what [`Local::first_crossings`] finds along each line.
pub(super) fn first_crossings_one_by_one(
    body: &(impl Local + ?Sized),
    lines: &[LocalRay],
    between: &[(f64, f64)],
    each: &mut dyn FnMut(usize, &mut Crossings),
) {
    let mut found = Crossings::new();
    for (number, (line, between)) in lines.iter().zip(between).enumerate() {
        body.first_crossings(line, *between, &mut found);
        if !found.is_empty() {
            each(number, &mut found);
            found.clear();
        }
    }
}

/// Returns a bit for each line of which [`Local::crosses`] is true.
pub(super) fn crosses_one_by_one(
    body: &(impl Local + ?Sized),
    lines: &[LocalRay],
    between: &[(f64, f64)],
    accepts: &dyn Fn(usize, &Met) -> bool,
) -> u32 {
    lines.iter().zip(between).enumerate().fold(0, |crossed, (number, (line, between))| {
        let is_crossed = body.crosses(line, *between, &|met| accepts(number, met));
        crossed | u32::from(is_crossed) << number
    })
}

/// The height of a local point over a part of a surface; 0 on the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Height {
    /// Negative inside.
    pub value: f64,
    /// Gradient of the height: outward, of any length but 0.
    pub gradient: Vector,
    /// Bound on the rounding error of `value`, for an exact point.
    pub error: f64,
}

/// The plane of a flat part of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facet {
    /// A point of the plane.
    pub corner: Vector,
    /// Outward, of length about 1.
    pub normal: Vector,
    /// Angular error of the normal, from rounding.
    pub turn: f64,
}

impl Facet {
    pub fn height(&self, point: Vector) -> Height {
        let off = point - self.corner;
        let error = (self.turn + 4.0 * U) * off.length() + U * point.length();
        Height { value: self.normal.dot(off), gradient: self.normal, error }
    }
}

/// A ray's line in the local space of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalRay<'a> {
    /// The point of the line nearest to the local origin; s is 0 here.
    pub nearest: Vector,
    /// Unit direction.
    pub direction: Vector,
    /// At s, the intended line lies within `blur + turn · |s|` of this one.
    pub blur: f64,
    /// See `blur`.
    pub turn: f64,
    /// Error that crossings may have, reported in [`Met::error`]; 0 requests the full precision of the
    /// arithmetic.
    pub tolerance: f64,
    /// The ray and the placed body; `None` for a line that has no counterpart in world space.
    pub in_world: Option<InWorld<'a>>,
}

/// A ray in world space, and the placed body that it is tested against.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InWorld<'a> {
    pub ray: &'a Ray,
    pub placed: &'a Placed,
}

impl LocalRay<'_> {
    /// Returns a line without uncertainty.
    pub fn exact(nearest: Vector, direction: Vector) -> Self {
        Self { nearest, direction, blur: 0.0, turn: 0.0, tolerance: 0.0, in_world: None }
    }

    pub fn at(&self, s: f64) -> Vector {
        self.nearest + self.direction * s
    }

    /// Returns the position from which a crossing is certainly ahead of the ray's start, where `from` is the
    /// start passed to `first_crossings`: `Seen::place` puts that as far before the start as the start may be
    /// off. If all crossings are asked for, as from −∞, none is ahead.
    pub fn ahead_of(&self, from: f64) -> f64 {
        if !from.is_finite() {
            return f64::INFINITY;
        }
        from + 4.0 * (self.blur + self.turn * self.nearest.length() + 8.0 * U * from.abs())
    }

    /// Returns how far the intended line may be from this one at s.
    pub fn blur_at(&self, s: f64) -> f64 {
        self.blur + self.turn * s.abs()
    }
}

/// A crossing of a line and a body's surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Met {
    /// Distance along the line: s in local space, t for a ray in world space.
    pub t: f64,
    /// Error bound: the true crossing lies within this distance of `t`.
    pub error: f64,
    /// Whether the line leaves the body; for a sheet, whether it goes in the direction that the surface
    /// faces.
    pub leaving: bool,
    /// The part of the surface, as passed to [`Local::height`].
    pub part: u32,
}

impl Met {
    /// Part number of invisible surface, such as the ends of an open cylinder: the solid ends here, and a ray
    /// that hits nothing else continues.
    pub const UNSEEN: u32 = u32::MAX;

    /// Part number where it is not known which part is crossed.
    pub const UNKNOWN: u32 = u32::MAX - 1;

    pub fn is_seen(&self) -> bool {
        self.part != Self::UNSEEN
    }

    /// Returns a crossing of a surface that has no parts, or of an unknown one.
    #[inline(always)]
    pub fn of(Crossing { t, error }: Crossing, leaving: bool) -> Self {
        Self { t, error, leaving, part: Self::UNKNOWN }
    }

    pub fn crossing(&self) -> Crossing {
        Crossing { t: self.t, error: self.error }
    }

    /// Returns the one farther along; where rounding may have swapped the two, the error bound covers both.
    pub(super) fn later(self, other: Self) -> Self {
        let (late, early) = if other.t > self.t { (other, self) } else { (self, other) };
        Self { error: late.error.max(early.error - (late.t - early.t)), ..late }
    }

    /// Returns the one less far along; where rounding may have swapped the two, the error bound covers both.
    pub(super) fn earlier(self, other: Self) -> Self {
        let (early, late) = if other.t < self.t { (other, self) } else { (self, other) };
        Self { error: early.error.max(late.error - (late.t - early.t)), ..early }
    }
}

/// Crossings in order. Most bodies have few, which need no allocation.
pub type Crossings = SmallVec<[Met; 6]>;

/// Entry and exit of a line through something solid.
pub(super) type Span = (Met, Met);

/// Adds the entries and exits of the union of `spans`, which are in any order. Spans that overlap, or touch
/// within rounding, are merged; where a visible and an invisible surface coincide within rounding, the
/// visible one is reported.
pub(super) fn unite(spans: &mut [Span], found: &mut Crossings) {
    spans.sort_by(|a, b| a.0.t.total_cmp(&b.0.t));
    let Some((&(mut enter, mut leave), rest)) = spans.split_first() else { return };
    let is_there = |met: &Met, seen: &Met| {
        !met.is_seen() && seen.is_seen() && (met.t - seen.t).abs() <= met.error + seen.error
    };
    for &(next, end) in rest {
        if next.t - next.error > leave.t + leave.error {
            found.extend([enter, leave]);
            (enter, leave) = (next, end);
            continue;
        }
        // Rounding may have swapped them, and the bound says so.
        let (other, first) = if is_there(&enter, &next) { (enter, next) } else { (next, enter) };
        enter = Met { error: first.error.max(first.t - other.t + other.error), ..first };
        let ends_later = is_there(&leave, &end) || (end.t > leave.t && !is_there(&end, &leave));
        let (other, last) = if ends_later { (leave, end) } else { (end, leave) };
        leave = Met { error: last.error.max(other.t - last.t + other.error), ..last };
    }
    found.extend([enter, leave]);
}
