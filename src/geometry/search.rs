//! Which entries a ray may meet: the unbounded that are ahead, then what the tree or the balls let by.
//!
//! **Invariant:** every entry that is met at the limit or before is shown; more may be.

use std::ops::Range;

use super::work::Tally;
use super::{Entry, Geometry, Solid, balls};
use crate::bvh::packet::{self, PacketSeeker};
use crate::bvh::{self, Tree};
use crate::shape::Ray;

/// Who looks for something among the entries.
///
/// A trait and not a closure: its method is inlined into each of the search's loops.
pub(super) trait Seeker {
    type Tally: Tally;

    /// Looks at the entry of that place; returns the limit from then on (−∞ ends the search).
    fn look(&mut self, place: usize) -> f64;

    fn tally(&mut self) -> &mut Self::Tally;
}

/// Looks at each by a function of the place and the tally.
pub(super) struct Each<T, F>(pub T, pub F);

impl<T: Tally, F: FnMut(usize, &mut T) -> f64> Seeker for Each<T, F> {
    type Tally = T;

    #[inline(always)]
    fn look(&mut self, place: usize) -> f64 {
        (self.1)(place, &mut self.0)
    }

    #[inline(always)]
    fn tally(&mut self) -> &mut T {
        &mut self.0
    }
}

/// As `seeker.look(place)`, not inlined: where little is looked at, the search itself is short.
#[inline(never)]
fn look(seeker: &mut impl Seeker, place: usize) -> f64 {
    seeker.look(place)
}

impl Geometry {
    /// Shows `seeker` every entry that the ray may meet at `limit` or before.
    #[inline(always)]
    pub(super) fn search(&self, ray: &Ray, limit: f64, seeker: &mut impl Seeker) {
        let mut limit = limit;
        for place in 0..self.unbounded {
            if self.entries[place].is_ahead(ray) {
                limit = look(seeker, place);
                if limit == f64::NEG_INFINITY {
                    return;
                }
            }
        }
        if let Some(tree) = &self.tree {
            self.search_tree(tree, ray, limit, seeker);
            return;
        }
        for (group, balls) in self.balls.iter().enumerate() {
            let first = self.unbounded + group * balls::LANES;
            let mut met = balls.met(ray);
            while met != 0 {
                if look(seeker, first + met.trailing_zeros() as usize) == f64::NEG_INFINITY {
                    return;
                }
                met &= met - 1;
            }
        }
    }

    /// Not inlined: a search without a tree stays short, and its numbers in registers.
    #[inline(never)]
    fn search_tree<S: Seeker>(&self, tree: &Tree, ray: &Ray, limit: f64, seeker: &mut S) {
        tree.visit(ray, 0.0, limit, &mut Entries { seeker, first: self.unbounded });
    }
}

impl Geometry {
    /// [`Self::search`] for each of up to [`packet::MOST`] rays that go much the same way, each with its seeker and
    /// its limit; a ray of limit −∞ is left out.
    pub(super) fn search_together(
        &self,
        rays: &[&Ray],
        mut limits: [f64; packet::MOST],
        seekers: &mut [impl Seeker],
    ) {
        let Some(tree) = &self.tree else {
            for ((ray, limit), seeker) in rays.iter().zip(limits).zip(seekers) {
                if limit > f64::NEG_INFINITY {
                    self.search(ray, limit, seeker);
                }
            }
            return;
        };
        for ((ray, seeker), limit) in rays.iter().zip(&mut *seekers).zip(&mut limits) {
            for place in 0..self.unbounded {
                if *limit > f64::NEG_INFINITY && self.entries[place].is_ahead(ray) {
                    *limit = look(seeker, place);
                }
            }
        }
        let mut packet = PacketEntries { seekers, first: self.unbounded };
        tree.visit_together(rays, &mut limits, &mut packet);
    }
}

/// Shows the seeker of each ray the entries of the tree's leaves, one by one.
struct PacketEntries<'a, S> {
    seekers: &'a mut [S],
    /// The place of the tree's first piece.
    first: usize,
}

impl<S: Seeker> PacketSeeker for PacketEntries<'_, S> {
    #[inline(always)]
    fn leaf(&mut self, ray: usize, pieces: Range<usize>, mut limit: f64) -> f64 {
        for piece in pieces {
            limit = self.seekers[ray].look(self.first + piece);
            if limit == f64::NEG_INFINITY {
                break;
            }
        }
        limit
    }

    #[inline(always)]
    fn node(&mut self) {
        // Of all rays together.
        self.seekers[0].tally().box_visit();
    }
}

/// Shows a seeker the entries of the tree's leaves, one by one.
struct Entries<'a, S> {
    seeker: &'a mut S,
    /// The place of the tree's first piece.
    first: usize,
}

impl<S: Seeker> bvh::Seeker for Entries<'_, S> {
    #[inline(always)]
    fn leaf(&mut self, pieces: Range<usize>, mut limit: f64) -> f64 {
        for piece in pieces {
            limit = self.seeker.look(self.first + piece);
            if limit == f64::NEG_INFINITY {
                break;
            }
        }
        limit
    }

    #[inline(always)]
    fn node(&mut self) {
        self.seeker.tally().box_visit();
    }
}

impl Entry {
    /// `false` when the ray certainly meets nothing of it.
    #[inline(always)]
    fn is_ahead(&self, ray: &Ray) -> bool {
        match &self.solid {
            Solid::Plane(plane) => plane.is_ahead(ray),
            Solid::Sphere(_)
            | Solid::Box(_)
            | Solid::Ellipsoid(_)
            | Solid::Placed(_)
            | Solid::Whole(_) => true,
        }
    }
}
