//! Rays that are traced together, generation by generation: the camera's, those that go on from where these end, and
//! so forth.
//!
//! **In:** the camera's rays. **Out:** what is seen along each. **Invariant:** what comes back along a
//! ray depends on no other ray. Radiance is folded from the last generation to the first and never accumulated into a
//! throughput, so a clamp at each surface is possible. Nothing grows on the call stack, and memory is bounded by the
//! depth, not by the number of paths: of a generation only so many rays go on at once, far down only one, and the rest
//! waits.

use std::ops::ControlFlow;

use super::Walk;
use super::fog::Veil;
use super::packet::{Packet, Packets};
use super::reflection;
use super::sight::Sight;
use super::tracer::Tracer;
use super::way::Way;
use crate::color::Rgb;
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
}

impl Return {
    const NOTHING: Self = Self { seen: Rgb::BLACK, clamped: false };
}

/// Rays that left the surfaces of the generation before.
#[derive(Debug, Clone, Copy)]
struct Generation {
    /// The first of its [`Return`]s.
    first: usize,
    count: usize,
    /// Rays whose surfaces are shaded.
    shaded: usize,
    /// The first of its packets, which are kept until all are shaded.
    packets: usize,
    /// The solids that are known of rays before it.
    solids: usize,
    /// So many are mirrored: the first.
    mirrored: usize,
}

/// The rays of a batch. Kept from batch to batch for its memory.
#[derive(Debug, Default)]
pub(super) struct Batch {
    returns: Vec<Return>,
    /// Where they go, but for those of the camera's rays.
    backs: Vec<Back>,
    /// What fog does to each; empty without fog.
    veils: Vec<Veil>,
    /// How much of the background's light comes back along each; empty if that is not asked for.
    clear: Vec<f64>,
    /// How much of each is not the background is asked for.
    has_alpha: bool,
    packets: Packets,
    generations: Vec<Generation>,
}

/// Surfaces of a generation, side by side, and what they send back.
pub(super) struct Surfaces<'a> {
    pub packet: &'a Packet,
    /// A bit for each.
    pub mask: u32,
    /// The number of the packet's first ray among those of its generation.
    pub first: u32,
    seen: &'a mut [Return],
    /// Empty if that is not asked for.
    clear: &'a mut [f64],
}

impl Surfaces<'_> {
    /// What the surface of a ray shows by itself; `clamped` as the seed's.
    #[inline(always)]
    pub fn show(&mut self, number: usize, local: Rgb, clamped: bool) {
        self.seen[number] = Return { seen: local, clamped };
    }

    /// What a ray sees that leaves the scene, and how much of what is behind the sky it would see.
    #[cold]
    pub fn show_sky(&mut self, number: usize, (sky, clear): (Rgb, f64)) {
        self.show(number, sky, false);
        self.clear[number] = clear;
    }
}

impl Batch {
    /// Surfaces for whose radiance there is room.
    #[cfg(test)]
    pub fn room(&self) -> usize {
        self.returns.capacity()
    }

    /// Makes the first generation of the camera's rays that are there.
    fn begin(&mut self, count: usize, has_alpha: bool) {
        self.returns.clear();
        self.backs.clear();
        self.veils.clear();
        self.clear.clear();
        self.has_alpha = has_alpha;
        self.generations.clear();
        self.add([0, count], 0, 0);
    }

    /// Adds a generation of the rays that go on before surfaces and behind them.
    fn go_on(&mut self, [onward, behind]: [&Onwards; 2], solids: usize) {
        let packets = self.packets.len();
        self.packets.extend(onward.ways.iter().chain(&behind.ways));
        self.backs.extend_from_slice(&onward.backs);
        self.backs.extend_from_slice(&behind.backs);
        self.add([onward.len(), behind.len()], packets, solids);
    }

    /// Adds a generation of rays, first those that are mirrored, then others.
    fn add(&mut self, [mirrored, others]: [usize; 2], packets: usize, solids: usize) {
        let (first, count) = (self.returns.len(), mirrored + others);
        self.returns.resize(first + count, Return::NOTHING);
        if self.has_alpha {
            self.clear.resize(first + count, 0.0);
        }
        let generation = Generation { first, count, shaded: 0, packets, solids, mirrored };
        self.generations.push(generation);
    }

    /// The surfaces that are shaded next, at most `slice`, of one packet.
    fn next(&mut self, slice: usize) -> Option<Surfaces<'_>> {
        let Generation { first, count, shaded, packets, .. } = *self.generations.last()?;
        let start = shaded / ROW * ROW;
        let end = count.min(shaded + slice).min(start + ROW);
        if end == shaded {
            return None;
        }
        self.generations.last_mut()?.shaded = end;
        let bits = |to: usize| (1 << (to - start)) - 1;
        let list = first + start..first + end;
        Some(Surfaces {
            packet: self.packets.at(packets + start / ROW),
            mask: bits(end) & !bits(shaded),
            first: start as u32,
            seen: &mut self.returns[list.clone()],
            clear: self.clear.get_mut(list).unwrap_or_default(),
        })
    }

    /// Forgets the rays of the last generation if they are all shaded.
    fn forget_shaded(&mut self) {
        if let Some(&Generation { count, shaded, packets, .. }) = self.generations.last()
            && shaded == count
        {
            self.packets.truncate(packets);
        }
    }

    /// Folds the last generation into the one before; returns what it may forget of solids, or `None` if it is the
    /// first.
    fn fold(&mut self) -> Option<usize> {
        let Generation { first, packets, solids, mirrored, .. } = self.generations.pop()?;
        self.packets.truncate(packets);
        if self.has_alpha {
            self.fold_clear(first, mirrored);
        }
        let (before, last) = self.returns.split_at_mut(first);
        last.iter_mut().filter(|one| one.clamped).for_each(|one| one.seen = one.seen.at_most_one());
        if !self.veils.is_empty() {
            for (one, Veil { through, added }) in last.iter_mut().zip(&self.veils[first..]) {
                one.seen = *added + reflection::passed_on(*through, one.seen);
            }
            self.veils.truncate(first);
        }
        let to = self.generations.last()?.first;
        let backs = self.backs.len() - last.len();
        for (Return { seen, .. }, back) in last.iter().zip(&self.backs[backs..]) {
            let adapted = reflection::adapted(*seen, back.exponent);
            before[to + back.to as usize].seen += reflection::passed_on(back.factor, adapted);
        }
        self.returns.truncate(first);
        self.backs.truncate(backs);
        Some(solids)
    }

    /// Folds how clear the rays of the last generation are. Mirrors show the background, but nothing through it.
    #[cold]
    #[inline(never)]
    fn fold_clear(&mut self, first: usize, mirrored: usize) {
        let (before, last) = self.clear.split_at_mut(first);
        if !self.veils.is_empty() {
            for (one, Veil { through, .. }) in last.iter_mut().zip(&self.veils[first..]) {
                *one *= through.brightness();
            }
        }
        let Some(to) = self.generations.last().map(|before| before.first) else { return };
        let backs = &self.backs[self.backs.len() - last.len()..];
        for (clear, back) in last.iter().zip(backs).skip(mirrored) {
            before[to + back.to as usize] += back.factor.brightness() * clear;
        }
        self.clear.truncate(first);
    }
}

impl<'a> Tracer<'a> {
    /// Shows `look` what is seen along each of the camera's rays, in their order; stops early where the watch
    /// wants no more. `fill` puts the next rays into a row, from its first place on and as many as there is room for,
    /// until there are none.
    pub fn each_seen(
        &self,
        walk: &mut Walk,
        mut fill: impl FnMut(&mut Rays),
        mut look: impl FnMut(Sight),
    ) {
        let mut batch = std::mem::take(&mut walk.batch);
        let mut count = 0;
        loop {
            let Packet { rays, .. } = batch.packets.of_camera();
            fill(rays);
            let more = rays.mask.count_ones() as usize;
            count += more;
            if count + ROW > MOST || more == 0 && count > 0 {
                let goes_on = self.gather(walk, &mut batch, count, &mut look);
                count = 0;
                if goes_on.is_break() {
                    break;
                }
            }
            if more == 0 {
                break;
            }
        }
        batch.packets.clear();
        walk.batch = batch;
    }

    /// Traces a batch of the camera's rays, and shows `look` what comes back along them.
    fn gather(
        &self,
        walk: &mut Walk,
        batch: &mut Batch,
        count: usize,
        look: &mut impl FnMut(Sight),
    ) -> ControlFlow<()> {
        walk.counters.camera += count as u64;
        batch.begin(count, self.has_alpha);
        self.follow(walk, batch);
        batch.packets.clear();
        if walk.patience.is_over_after(count as u32, self.watch) {
            return ControlFlow::Break(());
        }
        match self.has_alpha {
            false => batch.returns.iter().for_each(|one| look(Sight::opaque(one.seen))),
            true => {
                for (one, clear) in batch.returns.iter().zip(&batch.clear) {
                    look(Sight { radiance: one.seen, opacity: 1.0 - clear.clamp(0.0, 1.0) });
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Follows the rays of a batch from generation to generation, and folds what comes back.
    #[inline(never)]
    fn follow(&self, walk: &mut Walk, batch: &mut Batch) {
        if self.follows_media {
            walk.media.start(batch.packets.from(0));
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
            if walk.pending() > 0 {
                batch.forget_shaded();
                batch.go_on([&walk.onward, &walk.behind], walk.media.known());
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
        let Some(&Generation { packets: first, .. }) = batch.generations.last() else { return };
        let sees_near = self.world.camera.meshes.is_some() && batch.generations.len() == 1;
        for packet in batch.packets.from(first) {
            self.intersect(walk, packet);
            if sees_near {
                self.see_near(&mut packet.hits);
            }
            if self.has_fog {
                self.veil(walk, packet, &mut batch.veils);
            }
        }
    }

    /// Finds what rays meet.
    fn intersect(&self, walk: &mut Walk, packet: &mut Packet) {
        let work = &mut walk.counters.work;
        let [directly, mirrored] = self.met();
        let mask = packet.rays.mask;
        let apart = if std::ptr::eq(directly, mirrored) { 0 } else { packet.mirrored() };
        for (met, mask) in [(directly, mask & !apart), (mirrored, apart)] {
            if mask != 0 {
                packet.rays.mask = mask;
                met.nearest_together(&packet.rays, &mut packet.hits, work);
            }
        }
        packet.rays.mask = mask;
        // A ray that starts inside of an object leaves that first, even where it starts in an edge, too near to the
        // other face to tell.
        if self.bends {
            for number in numbers(mask) {
                let (way, hit) = (packet.way(number), packet.hits[number]);
                let Some(inside) = way.inside.filter(|_| !hit.leaving) else { continue };
                let met = self.met_by(&way);
                let left = met.left_at_start(&way.ray, inside.object, inside.off, hit.t, work);
                packet.hits[number] = left.unwrap_or(hit);
            }
        }
    }
}
