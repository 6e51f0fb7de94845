//! Span: the part of a line that a whole may lie in, by the leaves in which all of it lies.
//!
//! **Invariant:** no place of the whole is outside of it by more than the errors of its ends.
//!
//! **Source:** S. Roth, "Ray casting for modeling solids", Computer Graphics and Image Processing 18 (1982).

use crate::math::Vector;
use crate::math::wide::*;
use crate::shape::csg::Node;
use crate::shape::local::Met;
use crate::shape::{Bounds, Crossing, Ray};

/// Stands for 1/0.
const STEEPEST: f64 = 1e300;
/// What is met with a box in `f64` is rounded by far less of how far off and how large it is.
const BLUR: f64 = 1.0 / (1u64 << 40) as f64;
/// By so many errors of its ends, and such a share of how far off they are, a span reaches beyond itself: what
/// its ends cannot be told from lies within, too.
const ERRORS: f64 = 1024.0;
const BESIDE: f64 = 1.0 / (1u64 << 20) as f64;

/// From where a line enters something to where it leaves that.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Span {
    pub enter: Crossing,
    pub leave: Crossing,
}

impl Span {
    pub const ALL: Self = Self { enter: Crossing::BEFORE_ALL, leave: Crossing::BEYOND_ALL };

    /// Of a box.
    #[inline]
    pub fn of_bounds(Bounds { low, high }: &Bounds, ray: &Ray) -> Self {
        let steepest = Vector::splat(STEEPEST);
        let reciprocal = ray.direction.recip().clamp(-steepest, steepest);
        let blur = (ray.origin.abs() + low.abs().max(high.abs())) * BLUR;
        let (a, b) =
            ((*low - blur - ray.origin) * reciprocal, (*high + blur - ray.origin) * reciprocal);
        let crossing = |t| Crossing { t, error: 0.0 };
        Self { enter: crossing(a.min(b).max_element()), leave: crossing(a.max(b).min_element()) }
    }

    /// Of four rays those that may meet a box ahead of their starts, at a limit or before.
    #[inline(always)]
    pub fn may_meet<S: Simd>(
        simd: S,
        Bounds { low, high }: &Bounds,
        ray: &WideRay<S>,
        limit: Wide<S>,
    ) -> Mask<S> {
        let (WideVector(origins), WideVector(directions)) = (ray.origin, ray.direction);
        let (mut enter, mut leave) = (all(simd, f64::NEG_INFINITY), all(simd, f64::INFINITY));
        for axis in 0..3 {
            let (origin, steepest) = (origins[axis], all(simd, STEEPEST));
            let reciprocal = (all(simd, 1.0) / directions[axis]).min(steepest).max(-steepest);
            let size = all(simd, low[axis].abs().max(high[axis].abs()));
            let blur = (origin.abs() + size) * all(simd, BLUR);
            let a = (all(simd, low[axis]) - blur - origin) * reciprocal;
            let b = (all(simd, high[axis]) + blur - origin) * reciprocal;
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        let beside = all(simd, BESIDE) * (enter.abs() + leave.abs());
        let is_behind = (leave + beside).simd_lt(all(simd, 0.0));
        !(enter.simd_gt(leave) | is_behind | (enter - beside).simd_gt(limit))
    }

    /// From the first of a solid's crossings, which are told in turn, to the last; `inverse` is what is outside
    /// of the solid.
    #[inline]
    pub fn of_crossings(all: &[Met], inverse: bool) -> Self {
        let nowhere = Self { enter: Crossing::BEYOND_ALL, leave: Crossing::BEFORE_ALL };
        let from = |met: Option<&Met>| met.map_or(Crossing::BEYOND_ALL, Met::crossing);
        let ends_inside = !all.len().is_multiple_of(2);
        match (all, inverse) {
            ([], false) => nowhere,
            ([], true) => Self::ALL,
            ([first, .., last], false) if !ends_inside => {
                Self { enter: first.crossing(), leave: last.crossing() }
            }
            ([first, ..], false) => Self { enter: first.crossing(), ..Self::ALL },
            ([first, rest @ ..], true) => Self {
                enter: if first.t.is_finite() { Crossing::BEFORE_ALL } else { from(rest.first()) },
                leave: if ends_inside { from(all.last()) } else { Crossing::BEYOND_ALL },
            },
        }
    }

    #[inline]
    pub fn and(self, other: Self) -> Self {
        Self {
            enter: if other.enter.t > self.enter.t { other.enter } else { self.enter },
            leave: if other.leave.t < self.leave.t { other.leave } else { self.leave },
        }
    }

    /// Whether it certainly ends before it begins.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.enter.t - self.enter.error > self.leave.t + self.leave.error
    }

    /// Whether it certainly is behind a ray's start or beyond a limit, or is nowhere.
    #[inline]
    pub fn is_beside(&self, limit: f64) -> bool {
        let (low, high) = self.reach();
        self.is_empty() || high < 0.0 || low > limit
    }

    /// From where to where lies what may be of any weight in it.
    #[inline]
    pub fn reach(&self) -> (f64, f64) {
        let far = |end: &Crossing| if end.t.is_finite() { end.t.abs() } else { 0.0 };
        let beside = BESIDE * (far(&self.enter) + far(&self.leave));
        (
            self.enter.t - ERRORS * self.enter.error - beside,
            self.leave.t + ERRORS * self.leave.error + beside,
        )
    }
}

/// A leaf in which all of a whole lies; outside of it, if it is `inverse`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Around {
    pub leaf: u32,
    pub inverse: bool,
}

/// The leaves in which all of a whole lies, and whether they are all that it is.
pub(super) fn around(nodes: &[Node]) -> (Vec<Around>, bool) {
    let mut leaves = 0;
    // Of what stands for itself so far the leaves.
    let mut stack: Vec<Option<Around>> = Vec::new();
    for (place, &node) in nodes.iter().enumerate() {
        let parts = match node {
            Node::Leaf { inverse } => {
                stack.push(Some(Around { leaf: leaves, inverse }));
                leaves += 1;
                continue;
            }
            Node::Union(count) | Node::Merge(count) | Node::Intersection(count) => count,
            Node::Clip { .. } => 2,
        };
        let parts = stack.drain(stack.len().saturating_sub(parts as usize)..);
        if place + 1 == nodes.len() {
            let count = parts.len();
            let found: Vec<Around> = parts.flatten().collect();
            return match node {
                Node::Intersection(_) if found.len() == count => (found, true),
                Node::Intersection(_) | Node::Clip { inverse: false } => (found, false),
                Node::Leaf { .. }
                | Node::Union(_)
                | Node::Merge(_)
                | Node::Clip { inverse: true } => (Vec::new(), false),
            };
        }
        drop(parts);
        stack.push(None);
    }
    (Vec::new(), false)
}
