//! Which entries a ray may meet: the unbounded that are ahead, then what the tree or the balls let by.
//!
//! **Invariant:** every entry that is met at the limit or before is shown; more may be.

use std::ops::Range;

use super::span::Span;
use super::whole::together::Known;
use super::work::Tally;
use super::{Entry, Geometry, Sides, Solid, Work, balls};
use crate::bvh::packet::PacketSeeker;
use crate::bvh::{self, Tree};
use crate::math::wide::*;
use crate::shape::{Bounds, First, FirstOfFour, Ray};

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
                let place = first + met.trailing_zeros() as usize;
                met &= met - 1;
                let is_beside = |hull: &Bounds| Span::of_bounds(hull, ray).is_beside(limit);
                if self.hulls[place - self.unbounded].as_ref().is_some_and(is_beside) {
                    continue;
                }
                limit = look(seeker, place);
                if limit == f64::NEG_INFINITY {
                    return;
                }
            }
        }
    }

    /// Not inlined: a search without a tree stays short, and its numbers in registers.
    #[inline(never)]
    fn search_tree<S: Seeker>(&self, tree: &Tree, ray: &Ray, limit: f64, seeker: &mut S) {
        tree.visit(ray, 0.0, limit, &mut Entries { seeker, first: self.unbounded });
    }
}

/// Who looks for something among the entries, for rays side by side.
pub(super) trait RowSeeker<'a> {
    fn geometry(&self) -> &'a Geometry;

    fn rays(&self) -> &'a Rays;

    /// Returns a bit for each ray whose search goes on.
    fn open(&self) -> u32;

    /// Returns how far each ray goes; −∞ where its search has ended.
    fn limits(&self) -> &Row;

    fn tally(&mut self) -> &mut Option<&'a mut Work>;

    /// Returns whether an entry is looked at.
    fn concerns(&self, entry: &Entry) -> bool;

    /// Takes note of where the rays of a group first meet an entry.
    fn take<S: Simd>(&mut self, simd: S, place: usize, group: usize, first: First<S>);

    /// Looks at an entry for the ray of this number alone.
    fn look_alone(&mut self, place: usize, number: usize);

    /// Looks at a body for the rays whose bits are set.
    fn look_together(&mut self, place: usize, body: u32, mask: u32);

    /// Looks at a whole for the ray of this number, of which it is known where it crosses leaves.
    fn look_at_whole(&mut self, place: usize, whole: u32, number: usize, known: &Known);

    /// Looks at the entry of that place for the rays whose bits are set, and perhaps for others.
    #[inline(always)]
    fn look<S: Simd>(&mut self, simd: S, place: usize, mask: u32) {
        let geometry = self.geometry();
        let entry = &geometry.entries[place];
        if !self.concerns(entry) {
            return;
        }
        self.tally().root_solves(mask.count_ones(), || geometry.price(entry));
        let shows = [entry.sides.shows(false), entry.sides.shows(true)];
        match &entry.solid {
            Solid::Plane(plane) => self.look_in_row(simd, place, mask, plane, shows),
            _ if mask.count_ones() == 1 => {
                numbers(mask).for_each(|number| self.look_alone(place, number));
            }
            Solid::Sphere(sphere) => self.look_in_row(simd, place, mask, sphere, shows),
            Solid::Box(_) | Solid::Ellipsoid(_) | Solid::Whole(_) => self.look_apart(place, mask),
            Solid::Placed(i) if entry.sides == Sides::Both => {
                self.look_together(place, *i, mask);
            }
            Solid::Placed(_) => numbers(mask).for_each(|number| self.look_alone(place, number)),
        }
    }

    /// [`Self::look`] at what takes longer, in a function of its own: so the loop over spheres stays short.
    #[inline(never)]
    fn look_apart(&mut self, place: usize, mask: u32) {
        let geometry = self.geometry();
        dispatch!(geometry.instructions.level(), simd => self.look_longer(simd, place, mask));
    }

    #[inline(always)]
    fn look_longer<S: Simd>(&mut self, simd: S, place: usize, mask: u32) {
        let geometry = self.geometry();
        let entry = &geometry.entries[place];
        let shows = [entry.sides.shows(false), entry.sides.shows(true)];
        match &entry.solid {
            Solid::Box(i) => {
                self.look_in_row(simd, place, mask, &geometry.boxes[*i as usize], shows);
            }
            Solid::Ellipsoid(i) => {
                self.look_in_row(simd, place, mask, &geometry.ellipsoids[*i as usize], shows);
            }
            Solid::Whole(i) => {
                let whole = &geometry.wholes[*i as usize];
                let near = whole.may_meet(simd, self.rays(), self.limits(), mask);
                let mut known = Known::new();
                geometry.bring_to_leaves(simd, whole, self.rays(), near, &mut known);
                numbers(near).for_each(|number| self.look_at_whole(place, *i, number, &known));
            }
            Solid::Sphere(_) | Solid::Plane(_) | Solid::Placed(_) => {
                numbers(mask).for_each(|number| self.look_alone(place, number));
            }
        }
    }

    /// Looks at a solid that is solved for four rays at once.
    #[inline(always)]
    fn look_in_row<S: Simd>(
        &mut self,
        simd: S,
        place: usize,
        mask: u32,
        solid: &impl FirstOfFour,
        shows: [bool; 2],
    ) {
        for group in 0..GROUPS {
            if has(mask, group) {
                let ray = self.rays().four(simd, group);
                let limit = four(simd, self.limits(), group);
                let first = solid.first_of_four(simd, &ray, shows, limit);
                self.take(simd, place, group, first);
            }
        }
    }
}

impl Geometry {
    /// [`Self::search`] for rays side by side.
    #[inline(always)]
    pub(super) fn search_together<'a>(&self, seeker: &mut impl RowSeeker<'a>) {
        dispatch!(self.instructions.level(), simd => self.search_row(simd, seeker));
    }

    #[inline(always)]
    fn search_row<'a, S: Simd>(&self, simd: S, seeker: &mut impl RowSeeker<'a>) {
        let rays = seeker.rays();
        for (place, entry) in self.entries[..self.unbounded].iter().enumerate() {
            let mask = seeker.open() & entry.ahead_of(simd, rays);
            if mask != 0 {
                seeker.look(simd, place, mask);
            }
        }
        let Some(tree) = &self.tree else {
            for place in self.unbounded..self.entries.len() {
                let bounded = place - self.unbounded;
                let (group, lane) = (bounded / balls::LANES, bounded % balls::LANES);
                let mut met = 0;
                for rays_of in 0..GROUPS {
                    if has(seeker.open(), rays_of) {
                        let ray = rays.four(simd, rays_of);
                        let mut near = self.balls[group].met_by_four(simd, lane, &ray);
                        if let Some(hull) = &self.hulls[bounded]
                            && near.any_true()
                        {
                            let limit = four(simd, seeker.limits(), rays_of);
                            near &= Span::may_meet(simd, hull, &ray, limit);
                        }
                        met |= bits(near, rays_of);
                    }
                }
                let mask = seeker.open() & met;
                if mask != 0 {
                    seeker.look(simd, place, mask);
                }
            }
            return;
        };
        tree.visit_together(rays, 0.0, &mut PacketEntries { geometry: seeker.geometry(), seeker });
    }
}

/// Shows the seeker of rays the entries of the tree's leaves, one by one.
struct PacketEntries<'s, 'a, S> {
    seeker: &'s mut S,
    geometry: &'a Geometry,
}

impl<'a, K: RowSeeker<'a>> PacketEntries<'_, 'a, K> {
    #[inline(always)]
    fn look<S: Simd>(&mut self, simd: S, pieces: Range<usize>, mask: u32) {
        for piece in pieces {
            let mask = mask & self.seeker.open();
            if mask != 0 {
                self.seeker.look(simd, self.geometry.unbounded + piece, mask);
            }
        }
    }
}

impl<'a, K: RowSeeker<'a>> PacketSeeker for PacketEntries<'_, 'a, K> {
    #[inline(always)]
    fn leaf(&mut self, mask: u32, pieces: Range<usize>) {
        dispatch!(self.geometry.instructions.level(), simd => self.look(simd, pieces, mask));
    }

    #[inline(always)]
    fn limits(&self) -> &Row {
        self.seeker.limits()
    }

    #[inline(always)]
    fn instructions(&self) -> Instructions {
        self.geometry.instructions
    }

    #[inline(always)]
    fn node(&mut self) {
        self.seeker.tally().box_visit();
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

    /// [`Self::is_ahead`] of rays side by side: a bit for each.
    #[inline(always)]
    fn ahead_of<S: Simd>(&self, simd: S, rays: &Rays) -> u32 {
        let Solid::Plane(plane) = &self.solid else { return rays.mask };
        let mut ahead = 0;
        for group in 0..GROUPS {
            ahead |= bits(plane.is_ahead_of_four(simd, &rays.four(simd, group)), group);
        }
        ahead
    }
}
