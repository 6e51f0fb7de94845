//! Smooth edges: which pixels get more than one sample, and where the samples lie.
//!
//! **Invariant:** a pixel's samples depend on it and its eight neighbours alone, so tiles do not
//! show and a region is an exact crop. Samples are averaged as they are, unclamped (as POV-Ray
//! does): the film holds light, not what a display can show.

use super::tiles::Crew;
use crate::color::{Rgb, srgb_encode};
use crate::film::Film;
use crate::plan::Region;

/// Rows of pixels whose edges a thread finds at once.
const ROWS: usize = 32;

/// The pixels that differ from one of their neighbours on a film by more than `threshold`, in opacity or a component as
/// a display would show it.
pub(super) struct Edges {
    region: Region,
    marks: Vec<bool>,
}

impl Edges {
    /// Finds them by one thread.
    pub fn new(film: &Film, threshold: f64) -> Self {
        let mut marks = vec![false; film.pixels.len()];
        mark(film, threshold, 0, &mut marks);
        Self { region: film.frame.region, marks }
    }

    #[inline(never)]
    pub fn found_by(crew: &Crew, film: &Film, threshold: f64) -> Self {
        let mut marks = vec![false; film.pixels.len()];
        let band = ROWS * film.frame.region.width.max(1) as usize;
        crew.bands(&mut marks, band, |number, marks| mark(film, threshold, ROWS * number, marks));
        Self { region: film.frame.region, marks }
    }

    /// Whether pixel (`x`, `y`) is one of them.
    pub fn has(&self, x: u32, y: u32) -> bool {
        let Region { x: left, y: top, width, .. } = self.region;
        self.marks[(y - top) as usize * width as usize + (x - left) as usize]
    }
}

/// Marks the edges in some rows of a film, from row `first` on.
fn mark(film: &Film, threshold: f64, first: usize, marks: &mut [bool]) {
    let width = film.frame.region.width.max(1) as usize;
    let above = first.checked_sub(1).map_or(Vec::new(), |above| shown(film, above));
    // None beyond the film.
    let mut near = [above, shown(film, first), Vec::new()];
    for (line, marks) in (first..).zip(marks.chunks_mut(width)) {
        near[2] = shown(film, line + 1);
        for (column, mark) in marks.iter_mut().enumerate() {
            let here = near[1][column];
            let columns = column.saturating_sub(1)..(column + 2).min(width);
            let mut around = near.iter().filter_map(|line| line.get(columns.clone())).flatten();
            *mark =
                around.any(|there| there.iter().zip(here).any(|(a, b)| (a - b).abs() > threshold));
        }
        near.rotate_left(1);
    }
}

/// A row of a film as a display would show it, with its opacity; nothing beyond the last.
fn shown(film: &Film, line: usize) -> Vec<[f64; 4]> {
    let mut last = (Rgb::BLACK, [0.0; 3]);
    let row = film.rows().nth(line).unwrap_or_default().iter().map(|pixel| {
        let radiance = pixel.radiance();
        // Flat areas are common and the curve is dear.
        if radiance != last.0 {
            let encode = |c| srgb_encode(film.assumed_gamma.linear(c));
            last = (radiance, radiance.components().map(encode));
        }
        let [red, green, blue] = last.1;
        [red, green, blue, pixel.opacity()]
    });
    row.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Gamma;
    use crate::film::Pixel;
    use crate::plan::Frame;
    use crate::trace::{TraceOptions, Unwatched};

    /// A gray film three pixels wide and high.
    fn film(assumed_gamma: Gamma, grays: [f64; 9]) -> Film {
        let mut film = Film::new(Frame::whole(3, 3), assumed_gamma);
        film.pixels = grays.map(|gray| Pixel::new(Rgb::gray(gray), 1)).to_vec();
        film
    }

    #[test]
    fn a_pixel_is_an_edge_when_one_of_its_eight_neighbours_differs() {
        for odd in 0..9 {
            let mut grays = [0.5; 9];
            grays[odd] = 0.6;
            let film = film(Gamma::LINEAR, grays);
            let edges = Edges::new(&film, 0.05);
            assert!(edges.has(1, 1));
            assert_eq!(edges.has(0, 0), [0, 1, 3, 4].contains(&odd));
            assert_eq!(edges.has(2, 1), [1, 2, 4, 5, 7, 8].contains(&odd));
        }
    }

    #[test]
    fn differences_are_those_a_display_shows() {
        let edge = |gamma: f64, a: f64, b: f64| {
            let film = film(Gamma::Power(gamma), [a, a, a, a, a, a, a, a, b]);
            Edges::new(&film, 0.05).has(1, 1)
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
        let whole = Edges::new(&film, 0.05);
        for threads in [1, 3] {
            let crew = Crew::new(&TraceOptions::on_threads(threads), &Unwatched);
            assert_eq!(Edges::found_by(&crew, &film, 0.05).marks, whole.marks);
        }
        assert!(whole.marks.contains(&true) && whole.marks.contains(&false));
    }
}
