//! A film shared out in tiles among threads.
//!
//! **Invariant:** each pixel is computed by itself and written once a pass, so neither the tiles
//! nor who takes them changes a bit.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::{Counters, TraceOptions, Traced, Walk, Watch};
use crate::film::{Film, Pixel};
use crate::plan::Region;

/// Pixels along a tile's side: small enough to share a picture evenly, large enough that handing
/// out costs nothing.
const SIDE: u32 = 32;
/// Pixels along the side of a block, whose rays go together: `BLOCK`² are at most those of a packet.
const BLOCK: usize = 4;
/// Rows of blocks that are computed at once: as many pixels as a batch has rays, in a tile of [`SIDE`].
const BLOCKS: usize = 2;
/// Things of a list that a thread takes at once.
const PART: usize = 16;

/// The threads and who waits for them.
pub struct Crew<'a> {
    /// `None` when the system grants no threads: then the caller's does all.
    pool: Option<rayon::ThreadPool>,
    /// Of a tile, in pixels.
    side: usize,
    watch: &'a dyn Watch,
}

impl<'a> Crew<'a> {
    pub fn new(options: &TraceOptions, watch: &'a dyn Watch) -> Self {
        let threads = options.threads;
        // 0 stands for one a processor; one thread is the caller's own.
        let builder = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0));
        let pool = if threads == Some(1) { None } else { builder.build().ok() };
        Self { pool, side: options.tile_side.unwrap_or(SIDE).max(1) as usize, watch }
    }

    /// Computes something for each thing of a list, some of them at once and begun in the list's order, and the work it
    /// was; `None` for those that were not done when the watch stopped it.
    pub(super) fn each<I: Sync, T: Clone + Send>(
        &self,
        list: &[I],
        some: impl Fn(&mut Walk, &[I]) -> Vec<Option<T>> + Sync,
    ) -> (Vec<Option<T>>, Counters) {
        let (done, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
        let work = |(number, part): (usize, &[I])| {
            let mut walk = Walk::default();
            walk.patience.is_over = stopped.load(Ordering::Relaxed);
            walk.patience.ask(self.watch);
            let values = match walk.patience.is_over {
                true => vec![None; part.len()],
                false => some(&mut walk, part),
            };
            stopped.fetch_or(walk.patience.is_over, Ordering::Relaxed);
            let done = done.fetch_add(part.len(), Ordering::Relaxed) + part.len();
            self.watch.progress(done, list.len());
            (number, values, walk.counters)
        };
        let parts = list.chunks(PART).enumerate();
        let mut parts: Vec<_> = match &self.pool {
            // Each thread takes the next part, so that what is done is the list's first.
            Some(pool) => pool.install(|| parts.par_bridge().map(work).collect()),
            None => parts.map(work).collect(),
        };
        parts.sort_unstable_by_key(|&(number, ..)| number);
        let mut all = Vec::with_capacity(list.len());
        let mut counters = Counters::default();
        for (_, values, these) in parts {
            all.extend(values);
            counters += these;
        }
        (all, counters)
    }

    /// Computes parts of a list, `length` values long but for the last, each by its number.
    pub(super) fn bands<T: Send>(
        &self,
        list: &mut [T],
        length: usize,
        one: impl Fn(usize, &mut [T]) + Sync,
    ) {
        let one = |(number, part): (usize, &mut [T])| one(number, part);
        match &self.pool {
            Some(pool) => pool.install(|| list.par_chunks_mut(length).enumerate().for_each(one)),
            None => list.chunks_mut(length).enumerate().for_each(one),
        }
    }

    /// Computes a value for each number below `count`, `length` of them at once; `None` if the watch stopped it.
    pub fn map<T: Clone + Default + Send>(
        &self,
        count: usize,
        length: usize,
        one: impl Fn(usize) -> T + Sync,
    ) -> Option<Vec<T>> {
        let mut values = vec![T::default(); count];
        self.bands(&mut values, length, |number, values| {
            if !self.watch.should_stop() {
                let numbered = (number * length..).zip(values);
                numbered.for_each(|(number, value)| *value = one(number));
            }
        });
        (!self.watch.should_stop()).then_some(values)
    }

    /// Computes the pixels of `film`, `which.0` being the number of this pass among `which.1`: `sample` changes those at
    /// the places of a list. Neighbours are next to each other in the list.
    pub(super) fn pass(
        &self,
        mut film: Film,
        which: (usize, usize),
        sample: impl Fn(&mut Walk, &[(u32, u32)], &mut [Pixel]) + Sync,
    ) -> Traced {
        self.watch.begins(which.0, &film);
        let tiles = tiles(&mut film, self.side);
        let total = tiles.len();
        let counters = Mutex::new(Counters::default());
        let (done, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
        let work = |walk: &mut Walk, mut tile: Tile| {
            if stopped.load(Ordering::Relaxed) || self.watch.should_stop() {
                stopped.store(true, Ordering::Relaxed);
                return;
            }
            walk.occluders.clear();
            let (mut places, mut pixels) = (Vec::new(), Vec::new());
            let strips = (tile.y..).step_by(BLOCK * BLOCKS);
            for (y, rows) in strips.zip(tile.rows.chunks_mut(BLOCK * BLOCKS)) {
                // A strip may take long; what is done of the tile is kept.
                if walk.patience.is_over || (y > tile.y && self.watch.should_stop()) {
                    stopped.store(true, Ordering::Relaxed);
                    break;
                }
                let width = rows.first().map_or(0, |row| row.len());
                places.clear();
                pixels.clear();
                for top in (0..rows.len()).step_by(BLOCK) {
                    for left in (0..width).step_by(BLOCK) {
                        let lines = top..rows.len().min(top + BLOCK);
                        let columns = || left..width.min(left + BLOCK);
                        places.extend(lines.flat_map(|line| {
                            columns().map(move |column| (tile.x + column as u32, y + line as u32))
                        }));
                    }
                }
                let of = |place: (u32, u32)| ((place.1 - y) as usize, (place.0 - tile.x) as usize);
                let at = places.iter().map(|&place| of(place));
                pixels.extend(at.clone().map(|(row, column)| rows[row][column]));
                sample(walk, &places, &mut pixels);
                for ((row, column), &pixel) in at.zip(&pixels) {
                    rows[row][column] = pixel;
                }
            }
            match walk.patience.is_over || stopped.load(Ordering::Relaxed) {
                true => stopped.store(true, Ordering::Relaxed),
                false => self.watch.traced(which.0, (tile.x, tile.y), &tile.rows),
            }
            *counters.lock().unwrap_or_else(PoisonError::into_inner) +=
                std::mem::take(&mut walk.counters);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            self.watch.progress(which.0 * total + done, which.1 * total);
        };
        match &self.pool {
            Some(pool) => {
                pool.install(|| tiles.into_par_iter().for_each_init(Walk::default, work));
            }
            None => {
                let mut walk = Walk::default();
                tiles.into_iter().for_each(|tile| work(&mut walk, tile));
            }
        }
        let counters = counters.into_inner().unwrap_or_else(PoisonError::into_inner);
        Traced { film, counters, complete: !stopped.into_inner() }
    }
}

/// A square of the film, less at its edges.
struct Tile<'film> {
    /// Its top left pixel.
    x: u32,
    y: u32,
    rows: Vec<&'film mut [Pixel]>,
}

/// The tiles of a film, row by row.
fn tiles(film: &mut Film, side: usize) -> Vec<Tile<'_>> {
    let Region { x, y, width, height } = film.frame.region;
    let width = width.max(1) as usize;
    let mut rows = film.pixels.chunks_mut(width);
    let mut tiles = Vec::new();
    for y in (y..y + height).step_by(side) {
        let first = tiles.len();
        tiles.extend((x..).step_by(side).take(width.div_ceil(side)).map(|x| Tile {
            x,
            y,
            rows: Vec::new(),
        }));
        for row in rows.by_ref().take(side) {
            let pieces = row.chunks_mut(side);
            tiles[first..].iter_mut().zip(pieces).for_each(|(tile, piece)| tile.rows.push(piece));
        }
    }
    tiles
}
