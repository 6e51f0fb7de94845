//! Selects the pixels to audit: spread over the picture, at random, without repetition.
//!
//! **Invariant:** every pixel of the picture is equally likely; sets from one call are disjoint.

use crate::math::random::Random;
use crate::plan::Region;

/// Approximate number of pixels in a set, if the picture has enough.
pub const WANTED: u32 = 4096;

/// Returns `count` sets of about `wanted` pixels each: one pixel per set from each square of a lattice, in
/// the lattice's order. Sets of small pictures have fewer pixels, as a square has at least `count`.
///
/// **Source:** jittered (stratified) sampling; a square that extends beyond the border keeps its empty part
/// in the draw, which makes all pixels equally likely.
pub fn sets(region: Region, wanted: u32, count: usize, seed: u64) -> Vec<Vec<(u32, u32)>> {
    let pixels = region.pixels();
    let least = (count as f64).sqrt().ceil() as u32;
    let side = ((pixels / f64::from(wanted.max(1))).sqrt().floor() as u32).max(least).max(1);
    let mut random = Random::of(seed, 0);
    let mut sets = vec![Vec::new(); count];
    for top in (0..region.height).step_by(side as usize) {
        for left in (0..region.width).step_by(side as usize) {
            let mut drawn: Vec<usize> = Vec::with_capacity(count);
            let parts = side as usize * side as usize;
            while drawn.len() < count {
                let place = random.below(parts);
                if !drawn.contains(&place) {
                    drawn.push(place);
                }
            }
            for (set, place) in sets.iter_mut().zip(drawn) {
                let x = left + (place % side as usize) as u32;
                let y = top + (place / side as usize) as u32;
                if x < region.width && y < region.height {
                    set.push((region.x + x, region.y + y));
                }
            }
        }
    }
    sets
}

/// Returns a set in an order such that every prefix is spread over the picture like the full set.
pub fn shuffled(mut set: Vec<(u32, u32)>, seed: u64) -> Vec<(u32, u32)> {
    let mut random = Random::of(seed, 1);
    for last in (1..set.len()).rev() {
        set.swap(last, random.below(last + 1));
    }
    set
}

/// Returns the values, one per pixel of a list, in an order that keeps neighbouring pixels close together.
///
/// **Source:** G. Morton, A Computer Oriented Geodetic Data Base (1966): interleaves the bits of both
/// coordinates.
pub fn by_place<T>(list: &[(u32, u32)], values: Vec<T>) -> Vec<T> {
    let spread = |c: u32| (0..32).fold(0u64, |bits, i| bits | u64::from(c >> i & 1) << (2 * i));
    let mut placed: Vec<(u64, T)> =
        list.iter().map(|&(x, y)| spread(x) | spread(y) << 1).zip(values).collect();
    placed.sort_by_key(|placed| placed.0);
    placed.into_iter().map(|placed| placed.1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn sets_are_disjoint_inside_the_region_and_about_as_large_as_wanted() {
        for (width, height) in [(640, 480), (33, 17), (1000, 3), (5, 4)] {
            let region = Region { x: 7, y: 9, width, height };
            let sets = sets(region, 1000, 3, 1);
            let all: Vec<_> = sets.iter().flatten().copied().collect();
            let different: BTreeSet<_> = all.iter().copied().collect();
            assert_eq!(all.len(), different.len());
            let inside =
                |&(x, y): &(u32, u32)| (7..7 + width).contains(&x) && (9..9 + height).contains(&y);
            assert!(all.iter().all(inside));
            if width == 640 {
                assert!(sets.iter().all(|set| (1000..1200).contains(&set.len())));
            }
        }
    }

    #[test]
    fn one_set_of_a_small_picture_is_all_of_it() {
        let region = Region { x: 0, y: 0, width: 20, height: 10 };
        assert_eq!(sets(region, WANTED, 1, 3)[0].len(), 200);
    }

    #[test]
    fn every_pixel_is_as_likely_as_any_other() {
        // Squares of 3 × 3 on 10 × 7 pixels hang over two borders.
        let region = Region { x: 0, y: 0, width: 10, height: 7 };
        let mut times = vec![0u32; 70];
        for seed in 0..9000 {
            for &(x, y) in &sets(region, 7, 2, seed)[1] {
                times[(y * 10 + x) as usize] += 1;
            }
        }
        // 1000 ± 30 each.
        assert!(times.iter().all(|&times| (860..1140).contains(&times)), "{times:?}");
    }

    #[test]
    fn a_seed_gives_its_own_pixels() {
        let region = Region { x: 0, y: 0, width: 64, height: 48 };
        assert_eq!(sets(region, 100, 2, 5), sets(region, 100, 2, 5));
        assert_ne!(sets(region, 100, 2, 5), sets(region, 100, 2, 6));
    }

    #[test]
    fn in_their_places_neighbours_stand_close_together() {
        let region = Region { x: 0, y: 0, width: 320, height: 240 };
        let list = shuffled(sets(region, 768, 1, 5).remove(0), 5);
        let mean_step = |list: &[(u32, u32)]| {
            let step = |pair: &[(u32, u32)]| {
                f64::from(pair[0].0.abs_diff(pair[1].0) + pair[0].1.abs_diff(pair[1].1))
            };
            list.windows(2).map(step).sum::<f64>() / list.len() as f64
        };
        let placed = by_place(&list, list.clone());
        // Squares are 10 pixels wide; anywhere is 180 pixels away.
        assert!(mean_step(&list) > 150.0 && mean_step(&placed) < 25.0, "{}", mean_step(&placed));
        assert_eq!(placed.len(), list.len());
    }
}
