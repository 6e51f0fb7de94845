//! What a search was: how many boxes and shapes were looked at.
//!
//! **Invariant:** depends on the rays, their order and the geometry alone. Counted where it is asked
//! for, by searches of their own: one that is not counted has not an instruction for it.

use std::ops::AddAssign;

use super::{Entry, Geometry, Solid};
use crate::shape::local::Local;

/// How much work it was to find what rays meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Visits to nodes of the tree of boxes; at each, four boxes together are held against the ray.
    pub box_visits: u64,
    /// How often the equation of a shape was solved for a ray.
    pub root_solves: u64,
    /// What that took, in equations of a sphere: see `Local::price`.
    pub solving: u64,
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.box_visits += other.box_visits;
        self.root_solves += other.root_solves;
        self.solving += other.solving;
    }
}

/// Takes note of work, or of none.
pub(super) trait Tally {
    fn box_visit(&mut self);
    /// Of a shape of this price, which is asked for where it is counted.
    #[inline(always)]
    fn root_solve(&mut self, price: impl FnOnce() -> u64) {
        self.root_solves(1, price);
    }
    /// Of a shape of this price, for so many rays.
    fn root_solves(&mut self, count: u32, price: impl FnOnce() -> u64);
}

/// Takes note of nothing, and is nothing.
pub(super) struct Uncounted;

impl Tally for Uncounted {
    #[inline(always)]
    fn box_visit(&mut self) {}
    #[inline(always)]
    fn root_solves(&mut self, _: u32, _: impl FnOnce() -> u64) {}
}

impl Tally for Work {
    #[inline(always)]
    fn box_visit(&mut self) {
        self.box_visits += 1;
    }
    #[inline(always)]
    fn root_solves(&mut self, count: u32, price: impl FnOnce() -> u64) {
        self.root_solves += u64::from(count);
        self.solving += u64::from(count) * price();
    }
}

/// Takes note where work is counted; for searches whose code would be long twice.
impl Tally for Option<&mut Work> {
    #[inline(always)]
    fn box_visit(&mut self) {
        if let Some(work) = self {
            work.box_visit();
        }
    }
    #[inline(always)]
    fn root_solves(&mut self, count: u32, price: impl FnOnce() -> u64) {
        if let Some(work) = self {
            work.root_solves(count, price);
        }
    }
}

impl<T: Tally> Tally for &mut T {
    #[inline(always)]
    fn box_visit(&mut self) {
        (**self).box_visit();
    }
    #[inline(always)]
    fn root_solves(&mut self, count: u32, price: impl FnOnce() -> u64) {
        (**self).root_solves(count, price);
    }
}

impl Geometry {
    /// What it takes to find where a ray meets an object, in equations of a sphere.
    pub(super) fn price(&self, entry: &Entry) -> u64 {
        match entry.solid {
            Solid::Sphere(_) | Solid::Plane(_) | Solid::Box(_) => 1,
            Solid::Ellipsoid(_) => 3,
            Solid::Placed(i) => self.placed[i as usize].body.price(),
            Solid::Whole(i) => self.wholes[i as usize].price,
        }
    }
}
