//! A film shared out in tiles among threads.
//!
//! **Invariant:** each pixel is computed by itself and written once a pass, so neither the tiles
//! nor who takes them changes a bit.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::{Counters, Traced, Walk, Watch};
use crate::color::Rgb;
use crate::film::Film;
use crate::plan::Region;

/// Pixels along a tile's side: small enough to share a picture evenly, large enough that handing
/// out costs nothing.
const SIDE: u32 = 32;

/// The threads and who waits for them.
pub(super) struct Crew<'a> {
    /// `None` when the system grants no threads: then the caller's does all.
    pool: Option<rayon::ThreadPool>,
    watch: &'a dyn Watch,
}

impl<'a> Crew<'a> {
    pub fn new(threads: Option<usize>, watch: &'a dyn Watch) -> Self {
        // 0 stands for one a processor; one thread is the caller's own.
        let builder = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0));
        let pool = if threads == Some(1) { None } else { builder.build().ok() };
        Self { pool, watch }
    }

    /// Computes the pixels of `region`, `which.0` being the number of this pass among `which.1`;
    /// `None` leaves a pixel of `film` as it is.
    pub fn pass(
        &self,
        film: Film,
        region: Region,
        which: (usize, usize),
        pixel: impl Fn(&mut Walk, u32, u32) -> Option<(Rgb, u32)> + Sync,
    ) -> Traced {
        let tiles = tiles(region);
        let shared = Mutex::new((film, Counters::default()));
        let (done, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
        let work = |walk: &mut Walk, piece: &mut Vec<Option<(Rgb, u32)>>, tile: &Region| {
            if stopped.load(Ordering::Relaxed) || self.watch.should_stop() {
                stopped.store(true, Ordering::Relaxed);
                return;
            }
            piece.clear();
            piece.extend(pixels(*tile).map(|(x, y)| pixel(walk, x, y)));
            {
                let mut shared = shared.lock().unwrap_or_else(PoisonError::into_inner);
                shared.1 += std::mem::take(&mut walk.counters);
                for (y, row) in (tile.y..).zip(piece.chunks(tile.width as usize)) {
                    for (index, value) in (shared.0.index(tile.x, y)..).zip(row) {
                        if let Some((radiance, samples)) = *value {
                            shared.0.radiance[index] = radiance;
                            shared.0.samples[index] = samples;
                        }
                    }
                }
            }
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            self.watch.progress(which.0 * tiles.len() + done, which.1 * tiles.len());
        };
        let fresh = || (Walk::default(), Vec::new());
        match &self.pool {
            Some(pool) => pool.install(|| {
                tiles
                    .par_iter()
                    .for_each_init(fresh, |(walk, piece), tile| work(walk, piece, tile));
            }),
            None => {
                let (mut walk, mut piece) = fresh();
                tiles.iter().for_each(|tile| work(&mut walk, &mut piece, tile));
            }
        }
        let (film, counters) = shared.into_inner().unwrap_or_else(PoisonError::into_inner);
        Traced { film, counters, complete: !stopped.into_inner() }
    }
}

/// The tiles of a region, row by row.
fn tiles(region: Region) -> Vec<Region> {
    let mut tiles = Vec::new();
    for y in (0..region.height).step_by(SIDE as usize) {
        for x in (0..region.width).step_by(SIDE as usize) {
            tiles.push(Region {
                x: region.x + x,
                y: region.y + y,
                width: SIDE.min(region.width - x),
                height: SIDE.min(region.height - y),
            });
        }
    }
    tiles
}

fn pixels(region: Region) -> impl Iterator<Item = (u32, u32)> {
    let Region { x, y, width, height } = region;
    (y..y + height).flat_map(move |line| (x..x + width).map(move |column| (column, line)))
}
