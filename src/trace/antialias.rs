//! Smooth edges: which pixels get more than one sample, and where the samples lie.
//!
//! **Invariant:** a pixel's samples depend on it and its eight neighbours alone, so tiles do not
//! show and a region is an exact crop. Samples are averaged as they are, unclamped (as POV-Ray
//! does): the film holds light, not what a display can show.

use crate::color::{Gamma, Rgb, srgb_encode};
use crate::film::Film;
use crate::plan::Region;

/// The mean of `grid` × `grid` samples by their sum.
pub(super) fn mean(sum: Rgb, grid: u32) -> Rgb {
    if grid == 1 {
        return sum;
    }
    let n = f64::from(grid) * f64::from(grid);
    sum.map(|c| c / n)
}

/// A film as a display would show it, to find its edges in.
pub(super) struct Shown {
    region: Region,
    encoded: Vec<[f64; 3]>,
}

impl Shown {
    #[inline(never)]
    pub fn new(film: &Film) -> Self {
        let mut last = (Rgb::BLACK, [0.0; 3]);
        let encoded = film.radiance.iter().map(|&radiance| {
            // Flat areas are common and the curve is dear.
            if radiance != last.0 {
                last = (radiance, encode(radiance, film.assumed_gamma));
            }
            last.1
        });
        Self { region: film.frame.region, encoded: encoded.collect() }
    }

    /// Whether pixel (`x`, `y`) differs by more than `threshold`, in an encoded component, from
    /// one of its neighbours on the film.
    #[inline(never)]
    pub fn is_edge(&self, x: u32, y: u32, threshold: f64) -> bool {
        let region = self.region;
        let row = region.width as usize;
        let (column, line) = ((x - region.x) as usize, (y - region.y) as usize);
        let here = self.encoded[line * row + column];
        let columns = column.saturating_sub(1)..(column + 2).min(row);
        let lines = line.saturating_sub(1)..(line + 2).min(region.height as usize);
        lines.into_iter().any(|line| {
            self.encoded[line * row + columns.start..line * row + columns.end]
                .iter()
                .any(|there| there.iter().zip(here).any(|(a, b)| (a - b).abs() > threshold))
        })
    }
}

fn encode(radiance: Rgb, assumed_gamma: Gamma) -> [f64; 3] {
    radiance.components().map(|c| srgb_encode(assumed_gamma.linear(c)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Frame;

    /// A gray film three pixels wide and high.
    fn film(assumed_gamma: Gamma, grays: [f64; 9]) -> Film {
        let mut film = Film::new(Frame::whole(3, 3), assumed_gamma);
        film.radiance = grays.map(Rgb::gray).to_vec();
        film
    }

    #[test]
    fn a_pixel_is_an_edge_when_one_of_its_eight_neighbours_differs() {
        for odd in 0..9 {
            let mut grays = [0.5; 9];
            grays[odd] = 0.6;
            let film = film(Gamma::LINEAR, grays);
            let shown = Shown::new(&film);
            assert!(shown.is_edge(1, 1, 0.05));
            assert_eq!(shown.is_edge(0, 0, 0.05), [0, 1, 3, 4].contains(&odd));
            assert_eq!(shown.is_edge(2, 1, 0.05), [1, 2, 4, 5, 7, 8].contains(&odd));
        }
    }

    #[test]
    fn differences_are_those_a_display_shows() {
        let edge = |gamma: f64, a: f64, b: f64| {
            let film = film(Gamma::Power(gamma), [a, a, a, a, a, a, a, a, b]);
            Shown::new(&film).is_edge(1, 1, 0.05)
        };
        assert!(edge(1.0, 0.0, 0.02) && !edge(1.0, 0.9, 0.92));
        assert!(!edge(1.0, 5.0, 1.0) && !edge(1.0, -3.0, 0.0), "beyond white and black");
        assert!(!edge(2.2, 0.0, 0.02) && edge(2.2, 0.0, 0.2), "by the scene's gamma");
    }
}
