//! What a search was: how many boxes and shapes were looked at.
//!
//! **Invariant:** depends on the rays, their order and the geometry alone. Counted where it is asked
//! for, by searches of their own: one that is not counted has not an instruction for it.

use std::ops::AddAssign;

/// How much work it was to find what rays meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Visits to nodes of the tree of boxes; at each, four boxes together are held against the ray.
    pub box_visits: u64,
    /// How often the equation of a shape was solved for a ray.
    pub root_solves: u64,
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.box_visits += other.box_visits;
        self.root_solves += other.root_solves;
    }
}

/// Takes note of work, or of none.
pub(super) trait Tally {
    const COUNTS: bool;
    fn box_visits(&mut self, count: u64);
    fn root_solve(&mut self);
}

/// Takes note of nothing, and is nothing.
pub(super) struct Uncounted;

impl Tally for Uncounted {
    const COUNTS: bool = false;
    #[inline(always)]
    fn box_visits(&mut self, _: u64) {}
    #[inline(always)]
    fn root_solve(&mut self) {}
}

impl Tally for Work {
    const COUNTS: bool = true;
    #[inline(always)]
    fn box_visits(&mut self, count: u64) {
        self.box_visits += count;
    }
    #[inline(always)]
    fn root_solve(&mut self) {
        self.root_solves += 1;
    }
}

impl<T: Tally> Tally for &mut T {
    const COUNTS: bool = T::COUNTS;
    #[inline(always)]
    fn box_visits(&mut self, count: u64) {
        (**self).box_visits(count);
    }
    #[inline(always)]
    fn root_solve(&mut self) {
        (**self).root_solve();
    }
}
