//! Light gathered, pixel by pixel.
//!
//! **Invariant:** the same bits for any number of threads; a pixel knows its samples.

use crate::color::Rgb;
use crate::plan::{Frame, Region};

/// The traced region, row by row from its top left. Radiance is the mean of a pixel's samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    pub frame: Frame,
    /// The scene's `assumed_gamma`: `radiance ^ assumed_gamma` is linear light.
    pub assumed_gamma: f64,
    /// `region.width × region.height` values, in the scene's working space.
    pub radiance: Vec<Rgb>,
    /// How many samples each pixel got; 0 for one that was not reached.
    pub samples: Vec<u32>,
}

impl Film {
    pub fn new(frame: Frame, assumed_gamma: f64) -> Self {
        let pixels = frame.region.width as usize * frame.region.height as usize;
        Self { frame, assumed_gamma, radiance: vec![Rgb::BLACK; pixels], samples: vec![0; pixels] }
    }

    /// Where pixel (`x`, `y`) of the whole picture lies in the lists; it must be in the region.
    #[inline]
    pub fn index(&self, x: u32, y: u32) -> usize {
        let region = self.frame.region;
        (y - region.y) as usize * region.width as usize + (x - region.x) as usize
    }

    /// The part of it in `region`, which must lie in its own.
    pub fn crop(&self, region: Region) -> Self {
        let mut part = Self::new(Frame { region, ..self.frame }, self.assumed_gamma);
        for y in region.y..region.y + region.height {
            let to = part.index(region.x, y);
            let from = self.index(region.x, y);
            let row = region.width as usize;
            part.radiance[to..to + row].copy_from_slice(&self.radiance[from..from + row]);
            part.samples[to..to + row].copy_from_slice(&self.samples[from..from + row]);
        }
        part
    }
}
