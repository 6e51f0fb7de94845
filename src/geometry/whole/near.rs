//! Which rays may meet a whole, and which of its leaves.
//!
//! **Invariant:** none that is met is left out; what is met in vain costs time only.

use std::ops::Range;

use super::super::balls;
use super::super::span::Span;
use super::{FOURS, Whole};
use crate::math::wide::*;
use crate::shape::Ray;

impl Whole {
    /// Of rays side by side those that may meet it ahead of their starts, each at its limit or before: a bit for each.
    #[inline(always)]
    pub fn may_meet<S: Simd>(&self, simd: S, rays: &Rays, limits: &Row, mask: u32) -> u32 {
        let mut met = 0;
        for group in 0..GROUPS {
            if has(mask, group) {
                let ray = rays.four(simd, group);
                let mut may_meet = match &self.bounds {
                    Some(bounds) => Span::may_meet(simd, bounds, &ray, four(simd, limits, group)),
                    None => Mask::splat(simd, true),
                };
                let mut inside = self.inside;
                while inside != 0 {
                    let leaf = inside.trailing_zeros() as usize;
                    let (balls, lane) = (leaf / balls::LANES, leaf % balls::LANES);
                    may_meet &= self.balls[balls].met_by_four(simd, lane, &ray);
                    inside &= inside - 1;
                }
                met |= bits(may_meet, group);
            }
        }
        met & mask
    }

    /// Of rays side by side those whose lines may meet one of the first leaves: a bit for each.
    #[inline(always)]
    pub fn near_leaf<S: Simd>(&self, simd: S, leaf: usize, rays: &Rays, mask: u32) -> u32 {
        let (balls, lane) = (&self.balls[leaf / balls::LANES], leaf % balls::LANES);
        let mut met = 0;
        for group in 0..GROUPS {
            if has(mask, group) {
                let ray = rays.four(simd, group);
                met |= bits(balls.met_by_four_lines(simd, lane, &ray), group);
            }
        }
        met & mask
    }

    /// A bit for each leaf that the line of a ray may meet; of the first ones only.
    #[inline(always)]
    pub(super) fn near(&self, ray: &Ray) -> u32 {
        let near = |group: usize| self.balls[group].met_by_line(ray) << (group * balls::LANES);
        (0..FOURS).fold(0, |all, group| all | near(group))
    }

    /// Shows `look` those leaves at least that the line of a ray may meet from one place to another.
    pub fn search_within(&self, ray: &Ray, (low, high): (f64, f64), mut look: impl FnMut(u32)) {
        self.always.iter().for_each(|&leaf| look(leaf));
        if let Some((tree, order)) = &self.tree {
            let mut show = |places: Range<usize>, limit| {
                order[places].iter().for_each(|&leaf| look(leaf));
                limit
            };
            let (ray, limit) = match tree.space.moved_to(ray, low) {
                Some(ray) => (ray, high - low),
                None => (tree.space.before(ray), f64::INFINITY),
            };
            tree.visit(&ray, 0.0, limit, &mut show);
        }
    }
}
