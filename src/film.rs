//! Light gathered, pixel by pixel.
//!
//! **Invariant:** the same bits for any number of threads; a pixel knows its samples.

use crate::color::Rgb;
use crate::plan::Frame;

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
}
