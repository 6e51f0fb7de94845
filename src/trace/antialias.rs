//! Smooth edges: which pixels get more than one sample, and when they have enough.
//!
//! **In:** a film of one sample for each pixel. **Out:** how many a pixel wants. **Invariant:** that depends on the samples
//! of the pixel and on the first ones of those at most two away alone, so tiles do not show and a region is an exact
//! crop. Samples are averaged as they are, unclamped (as POV-Ray does): the film holds light, not what a display can show.

use super::rounds::Sums;
use super::tiles::Crew;
use crate::color::{Gamma, Rgb, srgb_encode};
use crate::film::Film;
use crate::plan::Region;

/// Minimum number of samples of a pixel that has more than one.
pub(crate) const FEW: u32 = 4;
/// Weight of the neighbours' variance, in samples.
const NEIGHBOURS: f64 = 1.0;
/// A pixel gets more samples as long as the next one is expected to lower its square error by more than the square of this
/// fraction of the threshold. Samples thus go where they lower the error of the picture most.
const FRACTION: f64 = 1.0 / 8.0;

/// Rows of pixels whose edges a thread finds at once.
const ROWS: usize = 32;

/// Where the pixels of a film differ.
pub(super) struct Edges {
    region: Region,
    gamma: Gamma,
    threshold: f64,
    most: u32,
    /// The variance of an edge as high as the largest difference of a pixel from a neighbour, in linear light; 0 if no
    /// component differs by more than the threshold, as a display would show it, and neither does the opacity.
    variances: Vec<f32>,
}

impl Edges {
    /// How far a pixel looks around.
    pub const REACH: u32 = 2;

    #[inline(never)]
    pub fn new(crew: &Crew, film: &Film, (threshold, grid): (f64, u32)) -> Self {
        let mut variances = vec![0.0; film.pixels.len()];
        let band = ROWS * film.frame.region.width.max(1) as usize;
        crew.bands(&mut variances, band, |number, variances| {
            find(film, threshold, ROWS * number, variances);
        });
        // Powers of two are spread most evenly.
        let most = 1 << grid.max(1).saturating_mul(grid.max(1)).ilog2();
        let (region, gamma) = (film.frame.region, film.assumed_gamma);
        Self { region, gamma, threshold, most, variances }
    }

    /// Whether the pixel or one of its neighbours differs from one of its own: an edge may pass between centres.
    pub fn are_near(&self, (x, y): (u32, u32)) -> bool {
        let Region { x: left, y: top, width, height } = self.region;
        let around = |at: u32, all: u32| at.saturating_sub(1) as usize..(at + 2).min(all) as usize;
        let columns = around(x - left, width);
        around(y - top, height).any(|line| {
            let row = &self.variances[line * width as usize..];
            row[columns.clone()].iter().any(|&variance| variance > 0.0)
        })
    }

    /// Returns the number of samples that a pixel with these samples should have. Near an edge, the number is doubled as
    /// long as that pays even if the new samples do not differ.
    pub fn wanted(&self, (x, y): (u32, u32), sums: &Sums) -> u32 {
        if sums.count == 1 && !self.are_near((x, y)) {
            return 1;
        }
        let Region { x: left, y: top, width, .. } = self.region;
        let near = self.variances[(y - top) as usize * width as usize + (x - left) as usize];
        let own = f64::from(sums.count) * sums.linear_variance(self.gamma);
        let least = self.threshold * FRACTION * self.threshold * FRACTION;
        let mut count = sums.count.max(FEW.min(self.most));
        while count < self.most {
            let n = f64::from(count);
            if gain(expected(own / n, n, near.into()), n) <= least {
                break;
            }
            count = count.saturating_mul(2).min(self.most);
        }
        count
    }
}

/// Finds the variances of [`Edges`] in some rows of a film, from row `first` on.
fn find(film: &Film, threshold: f64, first: usize, variances: &mut [f32]) {
    let width = film.frame.region.width.max(1) as usize;
    let above = first.checked_sub(1).map_or(Vec::new(), |above| shown(film, above));
    // None beyond the film.
    let mut near = [above, shown(film, first), Vec::new()];
    for (line, variances) in (first..).zip(variances.chunks_mut(width)) {
        near[2] = shown(film, line + 1);
        for (column, variance) in variances.iter_mut().enumerate() {
            let here = near[1][column];
            let columns = column.saturating_sub(1)..(column + 2).min(width);
            let around = || near.iter().filter_map(|line| line.get(columns.clone())).flatten();
            if around().any(|there| there.differs(&here, threshold)) {
                *variance = around().map(|there| there.variance(&here)).fold(0.0, f32::max);
            }
        }
        near.rotate_left(1);
    }
}

/// A row of a film; nothing beyond the last.
fn shown(film: &Film, line: usize) -> Vec<Shown> {
    let mut last = (Rgb::BLACK, Shown::new(Rgb::BLACK, film.assumed_gamma));
    let row = film.rows().nth(line).unwrap_or_default().iter().map(|pixel| {
        let radiance = pixel.radiance();
        // Flat areas are common and the curve is dear.
        if radiance != last.0 {
            last = (radiance, Shown::new(radiance, film.assumed_gamma));
        }
        Shown { opacity: pixel.opacity(), ..last.1 }
    });
    row.collect()
}

/// Returns about by how much one more than `count` samples lowers the square error of their mean. Samples spread evenly
/// over a pixel that an edge crosses have a square error of about variance ÷ count^1.5.
pub(crate) fn gain(variance: f64, count: f64) -> f64 {
    variance / (count * count * count.sqrt())
}

/// Returns the expected variance of a pixel's samples, given that of `count` of them and that `near` it: samples that agree
/// may have missed a feature.
pub(crate) fn expected(variance: f64, count: f64, near: f64) -> f64 {
    (count * variance + NEIGHBOURS * near) / (count + NEIGHBOURS)
}

/// Returns the variance of samples on both sides of an edge in the middle of a pixel, by the square of its height.
pub(crate) fn of_edge(square: f64) -> f64 {
    square / 4.0
}

/// A pixel as a display would show it, and in linear light.
#[derive(Debug, Clone, Copy)]
struct Shown {
    encoded: [f64; 3],
    linear: [f64; 3],
    opacity: f64,
}

impl Shown {
    fn new(radiance: Rgb, gamma: Gamma) -> Self {
        let linear = radiance.components().map(|c| gamma.linear(c).min(1.0));
        Self { encoded: linear.map(srgb_encode), linear, opacity: 1.0 }
    }

    fn differs(&self, other: &Self, threshold: f64) -> bool {
        let mut off = self.encoded.iter().zip(other.encoded).map(|(a, b)| (a - b).abs());
        off.any(|off| off > threshold) || (self.opacity - other.opacity).abs() > threshold
    }

    fn variance(&self, other: &Self) -> f32 {
        let squares = self.linear.iter().zip(other.linear).map(|(a, b)| (a - b) * (a - b));
        let clear = (self.opacity - other.opacity) * (self.opacity - other.opacity);
        of_edge(squares.sum::<f64>() + clear) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Pixel;
    use crate::plan::Frame;
    use crate::trace::sight::Sight;
    use crate::trace::{TraceOptions, Unwatched};

    fn found(threads: usize, film: &Film) -> Edges {
        let crew = Crew::new(&TraceOptions::on_threads(threads), &Unwatched);
        Edges::new(&crew, film, (0.05, 8))
    }

    /// A gray film five pixels wide and high.
    fn edges(assumed_gamma: Gamma, grays: [f64; 25]) -> Edges {
        let mut film = Film::new(Frame::whole(5, 5), assumed_gamma);
        film.pixels = grays.map(|gray| Pixel::new(Rgb::gray(gray), 1)).to_vec();
        found(1, &film)
    }

    #[test]
    fn a_pixel_is_near_an_edge_if_one_at_most_two_away_differs_from_one_at_most_one_away() {
        for odd in 0..25 {
            let mut grays = [0.5; 25];
            grays[odd] = 0.6;
            let edges = edges(Gamma::LINEAR, grays);
            for i in 0..25 {
                let off = |a: usize, b: usize| a.abs_diff(b) <= 2;
                let near = off(i % 5, odd % 5) && off(i / 5, odd / 5);
                assert_eq!(edges.are_near((i as u32 % 5, i as u32 / 5)), near, "{odd} {i}");
            }
        }
    }

    #[test]
    fn differences_are_those_a_display_shows() {
        let edge = |gamma: f64, a: f64, b: f64| {
            let mut grays = [a; 25];
            grays[12] = b;
            edges(Gamma::Power(gamma), grays).are_near((2, 2))
        };
        assert!(edge(1.0, 0.0, 0.02) && !edge(1.0, 0.9, 0.92));
        assert!(!edge(1.0, 5.0, 1.0) && !edge(1.0, -3.0, 0.0), "beyond white and black");
        assert!(!edge(2.2, 0.0, 0.02) && edge(2.2, 0.0, 0.2), "by the scene's gamma");
    }

    #[test]
    fn the_edges_of_a_large_film_are_those_of_its_parts() {
        let mut film = Film::new(Frame::whole(37, 2 * ROWS as u32 + 5), Gamma::LINEAR);
        for (i, pixel) in film.pixels.iter_mut().enumerate() {
            *pixel = Pixel::new(Rgb::gray(f64::from(i % 11 == 0 || i % 37 == 5)), 1);
        }
        let whole = found(1, &film).variances;
        assert_eq!(found(3, &film).variances, whole);
        let mut alone = vec![0.0; whole.len()];
        find(&film, 0.05, 0, &mut alone);
        assert!(alone == whole && whole.contains(&0.75) && whole.contains(&0.0));
    }

    #[test]
    fn a_pixel_wants_more_samples_as_long_as_they_differ_and_no_more_than_the_most() {
        let mut grays = [0.0; 25];
        grays[12] = 1.0;
        let high = edges(Gamma::LINEAR, grays);
        let wanted = |seen: &[f64]| {
            let mut sums = Sums::NONE;
            seen.iter().for_each(|&gray| sums.add(Sight::opaque(Rgb::gray(gray))));
            high.wanted((2, 2), &sums)
        };
        assert_eq!([wanted(&[1.0]), wanted(&[1.0; 16])], [32, 32], "as neighbours differ");
        assert_eq!([wanted(&[1.0; 32]), wanted(&[[0.0, 0.1]; 16].concat())], [32, 32]);
        assert_eq!(wanted(&[[0.0, 1.0]; 16].concat()), 64);
        assert_eq!(wanted(&[[0.0, 1.0]; 32].concat()), 64);
        let flat = edges(Gamma::LINEAR, [0.5; 25]);
        let mut sums = Sums::NONE;
        sums.add(Sight::opaque(Rgb::gray(0.5)));
        assert_eq!(flat.wanted((2, 2), &sums), 1);
    }
}
