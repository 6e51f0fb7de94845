//! Rays that are traced together, generation by generation: the camera's, those that go on from where these end, and
//! so forth.
//!
//! **In:** the camera's rays. **Out:** the radiance that comes back along each. **Invariant:** what comes back along a
//! ray depends on no other ray. Radiance is folded from the last generation to the first and never accumulated into a
//! throughput, so a clamp at each surface is possible. Nothing grows on the call stack, and memory is bounded by the
//! depth, not by the number of paths: of a generation only so many rays go on at once, far down only one, and the rest
//! waits.

use std::ops::ControlFlow;

use super::Walk;
use super::fog::Veil;
use super::reflection;
use super::tracer::Tracer;
use super::way::Way;
use crate::color::Rgb;
use crate::geometry::{Hit, TOGETHER};
use crate::math::wide::{ROW, Rays, numbers};

/// The camera's rays that are traced together, and about the most of a generation.
const MOST: usize = 64;
/// Surfaces that are shaded together.
pub(super) const SLICE: usize = ROW;
/// So many generations have all their rays in memory; deeper ones follow one ray at a time.
const SIDE_BY_SIDE: usize = 64;

/// A ray that goes on from a surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Onward {
    pub way: Way,
    pub back: Back,
}

/// Rays that go on from surfaces.
#[derive(Debug, Default)]
pub(super) struct Onwards {
    ways: Vec<Way>,
    backs: Vec<Back>,
}

impl Onwards {
    pub fn len(&self) -> usize {
        self.ways.len()
    }

    #[inline(always)]
    pub fn push(&mut self, Onward { way, back }: Onward) {
        self.ways.push(way);
        self.backs.push(back);
    }

    /// Adds a ray. It is one with a ray of the same direction among those from `since` on, which are few: each is
    /// compared.
    pub fn join(&mut self, new: Onward, since: usize) {
        let same = |(way, back): &(&mut Way, &mut Back)| {
            back.exponent == 1.0
                && new.back.exponent == 1.0
                && way.spectrum == new.way.spectrum
                && way.ray.direction == new.way.ray.direction
        };
        match self.ways[since..].iter_mut().zip(&mut self.backs[since..]).find(same) {
            Some((way, back)) => {
                back.factor += new.back.factor;
                way.weight = way.weight.max(new.way.weight);
            }
            None => self.push(new),
        }
    }

    fn clear(&mut self) {
        self.ways.clear();
        self.backs.clear();
    }
}

/// How the radiance that comes back along a ray is added to what comes back from the surface that it left.
#[derive(Debug, Clone, Copy)]
pub(super) struct Back {
    /// The number of the surface among those of its generation.
    pub to: u32,
    pub factor: Rgb,
    pub exponent: f64,
}

/// What comes back along a ray: at first what the surface shows by itself.
#[derive(Debug, Clone, Copy)]
struct Return {
    seen: Rgb,
    /// The seed's clamp applies.
    clamped: bool,
    back: Back,
}

impl Return {
    /// Of a ray of the camera.
    const NOTHING: Self = Self {
        seen: Rgb::BLACK,
        clamped: false,
        back: Back { to: 0, factor: Rgb::WHITE, exponent: 1.0 },
    };
}

/// Rays that left the surfaces of the generation before.
#[derive(Debug, Clone, Copy)]
struct Generation {
    /// The first of its [`Return`]s.
    first: usize,
    count: usize,
    /// Rays whose surfaces are shaded.
    shaded: usize,
    /// Where its rays are kept until they are shaded.
    rays: usize,
    /// The solids that are known of rays before it.
    solids: usize,
}

/// The rays of a batch. Kept from batch to batch for its memory.
#[derive(Debug, Default)]
pub(super) struct Batch {
    returns: Vec<Return>,
    /// What fog does to each; empty without fog.
    veils: Vec<Veil>,
    ways: Vec<Way>,
    hits: Vec<Hit>,
    generations: Vec<Generation>,
}

/// Surfaces of a generation, side by side, and what they send back.
pub(super) struct Surfaces<'a> {
    pub ways: &'a [Way],
    pub hits: &'a [Hit],
    /// The number of the first among those of its generation.
    pub first: u32,
    seen: &'a mut [Return],
}

impl Surfaces<'_> {
    /// What the surface of a ray shows by itself; `clamped` as the seed's.
    #[inline(always)]
    pub fn show(&mut self, number: usize, local: Rgb, clamped: bool) {
        let Return { seen, clamped: is_clamped, .. } = &mut self.seen[number];
        (*seen, *is_clamped) = (local, clamped);
    }
}

impl Batch {
    /// Surfaces for whose radiance there is room.
    #[cfg(test)]
    pub fn room(&self) -> usize {
        self.returns.capacity()
    }

    /// Makes the first generation of the rays that are there.
    fn begin(&mut self) {
        self.returns.clear();
        self.veils.clear();
        self.hits.clear();
        self.generations.clear();
        self.add(self.ways.len(), std::iter::empty(), 0);
    }

    /// Adds a generation whose rays are the last of the list.
    fn add(&mut self, count: usize, backs: impl Iterator<Item = Back>, solids: usize) {
        let (first, rays) = (self.returns.len(), self.ways.len() - count);
        self.returns.resize(first + count, Return::NOTHING);
        self.returns[first..].iter_mut().zip(backs).for_each(|(one, back)| {
            one.back.to = back.to;
            one.back.factor = back.factor;
            one.back.exponent = back.exponent;
        });
        self.generations.push(Generation { first, count, shaded: 0, rays, solids });
    }

    /// The surfaces that are shaded next, at most `slice`.
    fn next(&mut self, slice: usize) -> Option<Surfaces<'_>> {
        let Generation { first, count, shaded, rays, .. } = *self.generations.last()?;
        let next = shaded..count.min(shaded + slice);
        if next.is_empty() {
            return None;
        }
        self.generations.last_mut()?.shaded = next.end;
        let kept = rays + next.start..rays + next.end;
        Some(Surfaces {
            ways: &self.ways[kept.clone()],
            hits: &self.hits[kept],
            first: next.start as u32,
            seen: &mut self.returns[first + next.start..first + next.end],
        })
    }

    /// Forgets the rays of the last generation if they are all shaded.
    fn forget_shaded(&mut self) {
        if let Some(&Generation { count, shaded, rays, .. }) = self.generations.last()
            && shaded == count
        {
            self.ways.truncate(rays);
            self.hits.truncate(rays);
        }
    }

    /// Folds the last generation into the one before; returns what it may forget of solids, or `None` if it is the
    /// first.
    fn fold(&mut self) -> Option<usize> {
        let Generation { first, solids, .. } = self.generations.pop()?;
        let (before, last) = self.returns.split_at_mut(first);
        last.iter_mut().filter(|one| one.clamped).for_each(|one| one.seen = one.seen.at_most_one());
        if !self.veils.is_empty() {
            for (one, Veil { through, added }) in last.iter_mut().zip(&self.veils[first..]) {
                one.seen = *added + reflection::passed_on(*through, one.seen);
            }
            self.veils.truncate(first);
        }
        let to = self.generations.last()?.first;
        for Return { seen, back: Back { to: place, factor, exponent }, .. } in last {
            let adapted = reflection::adapted(*seen, *exponent);
            before[to + *place as usize].seen += reflection::passed_on(*factor, adapted);
        }
        self.returns.truncate(first);
        Some(solids)
    }
}

impl<'a> Tracer<'a> {
    /// Shows `look` the radiance seen along each of the camera's rays, in their order; stops early where the watch
    /// wants no more. `fill` puts the next rays into a row, until there are none.
    pub fn each_seen(
        &self,
        walk: &mut Walk,
        mut fill: impl FnMut(&mut Rays),
        mut look: impl FnMut(Rgb),
    ) {
        let mut batch = std::mem::take(&mut walk.batch);
        let mut rays = Rays::NONE;
        loop {
            fill(&mut rays);
            for number in numbers(rays.mask) {
                batch.ways.push(Way::from_camera(rays.at(number), batch.ways.len() as u32));
            }
            let (is_last, is_full) = (rays.mask == 0, batch.ways.len() + ROW > MOST);
            if is_full || is_last && !batch.ways.is_empty() {
                let goes_on = self.gather(walk, &mut batch, &mut look);
                if goes_on.is_break() {
                    break;
                }
            }
            if is_last {
                break;
            }
        }
        batch.ways.clear();
        walk.batch = batch;
    }

    /// Traces a batch of the camera's rays, and shows `look` what comes back along them.
    fn gather(
        &self,
        walk: &mut Walk,
        batch: &mut Batch,
        look: &mut impl FnMut(Rgb),
    ) -> ControlFlow<()> {
        let count = batch.ways.len();
        walk.counters.camera += count as u64;
        batch.begin();
        self.follow(walk, batch);
        batch.ways.clear();
        if walk.patience.is_over_after(count as u32, self.watch) {
            return ControlFlow::Break(());
        }
        batch.returns.iter().for_each(|one| look(one.seen));
        ControlFlow::Continue(())
    }

    /// Follows the rays of a batch from generation to generation, and folds what comes back.
    #[inline(never)]
    fn follow(&self, walk: &mut Walk, batch: &mut Batch) {
        if self.follows_media {
            walk.media.start(&batch.ways);
        }
        self.advance(walk, batch);
        loop {
            let (slice, most) = match batch.generations.len() <= SIDE_BY_SIDE {
                true => (self.slice, MOST),
                false => (1, 1),
            };
            while let Some(surfaces) = batch.next(slice) {
                self.shade(walk, surfaces);
                if walk.pending() >= most {
                    break;
                }
            }
            if walk.patience.is_over {
                walk.onward.clear();
                walk.behind.clear();
                return;
            }
            let count = walk.pending();
            if count > 0 {
                batch.forget_shaded();
                batch.ways.extend_from_slice(&walk.onward.ways);
                batch.ways.extend_from_slice(&walk.behind.ways);
                let backs = walk.onward.backs.iter().chain(&walk.behind.backs).copied();
                batch.add(count, backs, walk.media.known());
                walk.onward.clear();
                walk.behind.clear();
                self.advance(walk, batch);
                continue;
            }
            match batch.fold() {
                Some(solids) => walk.media.forget(solids),
                None => return,
            }
        }
    }

    /// Takes the rays of the last generation to what they meet, through what lies between.
    fn advance(&self, walk: &mut Walk, batch: &mut Batch) {
        self.intersect(walk, batch);
        if self.world.camera.meshes.is_some() && batch.generations.len() == 1 {
            self.see_near(&mut batch.hits);
        }
        if self.has_fog {
            let Some(&Generation { rays: first, .. }) = batch.generations.last() else { return };
            let rays = batch.ways[first..].iter().zip(&batch.hits[first..]);
            batch.veils.extend(rays.map(|(way, hit)| self.veil(walk, way, hit)));
        }
    }

    /// Finds what the rays of the last generation meet.
    fn intersect(&self, walk: &mut Walk, batch: &mut Batch) {
        let Batch { ways, hits, .. } = batch;
        let work = &mut walk.counters.work;
        while hits.len() < ways.len() {
            let next = &ways[hits.len()..];
            let met_by = self.met_by(&next[0]);
            let next = &next[..next.len().min(TOGETHER)];
            let other = next.iter().position(|way| !std::ptr::eq(self.met_by(way), met_by));
            let together = next[..other.unwrap_or(next.len())].iter().map(|way| &way.ray);
            met_by.nearest_together(&Rays::new(together), hits, work);
        }
        // A ray that starts inside of an object leaves that first, even where it starts in an edge, too near to the
        // other face to tell.
        if self.bends {
            let Some(&Generation { rays: first, .. }) = batch.generations.last() else { return };
            for (way, hit) in batch.ways[first..].iter().zip(&mut batch.hits[first..]) {
                let Some(inside) = way.inside.filter(|_| !hit.leaving) else { continue };
                let left = self.met_by(way).left_at_start(
                    &way.ray,
                    inside.object,
                    inside.off,
                    hit.t,
                    work,
                );
                *hit = left.unwrap_or(*hit);
            }
        }
    }
}
