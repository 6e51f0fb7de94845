//! Smooth edges: which pixels get more than one sample, and where the samples lie.
//!
//! **Invariant:** a pixel's samples depend on it and its eight neighbours alone, so tiles do not
//! show and a region is an exact crop. Samples are averaged as they are, unclamped (as POV-Ray
//! does): the film holds light, not what a display can show.

use crate::color::{Rgb, srgb_encode};
use crate::film::Film;
use crate::math::elementary::pow;

/// The mean of the `grid` × `grid` samples that `sample` gives, in a fixed order.
pub(super) fn mean(grid: u32, mut sample: impl FnMut(u32, u32) -> Rgb) -> Rgb {
    let mut sum = Rgb::BLACK;
    for j in 0..grid {
        for i in 0..grid {
            sum += sample(i, j);
        }
    }
    let n = f64::from(grid) * f64::from(grid);
    sum.map(|c| c / n)
}

/// A film as a display would show it, to find its edges in.
pub(super) struct Shown<'a> {
    film: &'a Film,
    encoded: Vec<[f64; 3]>,
}

impl<'a> Shown<'a> {
    pub fn new(film: &'a Film) -> Self {
        let mut last = (Rgb::BLACK, [0.0; 3]);
        let encoded = film.radiance.iter().map(|&radiance| {
            // Flat areas are common and the curve is dear.
            if radiance != last.0 {
                last = (radiance, encode(radiance, film.assumed_gamma));
            }
            last.1
        });
        Self { film, encoded: encoded.collect() }
    }

    /// Whether pixel (`x`, `y`) differs by more than `threshold`, in an encoded component, from
    /// one of its neighbours on the film.
    pub fn is_edge(&self, x: u32, y: u32, threshold: f64) -> bool {
        let region = self.film.frame.region;
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

fn encode(radiance: Rgb, assumed_gamma: f64) -> [f64; 3] {
    radiance.components().map(|c| {
        let linear = if assumed_gamma == 1.0 { c } else { pow(c.max(0.0), assumed_gamma) };
        srgb_encode(linear)
    })
}
