//! Pictures as their files hold them, in their own depth.

use super::image::conversion::Encoding;

/// A picture as its file holds it, rows from top to bottom.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    pub width: usize,
    pub height: usize,
    /// 1: grey; 2: grey and alpha; 3: red, green, blue; 4: and alpha. 1 if there is a palette.
    pub channels: usize,
    pub samples: Samples,
    pub encoding: Encoding,
    /// Whether colours are multiplied by alpha.
    pub is_multiplied: bool,
}

/// The numbers of a picture: `channels` for each pixel.
#[derive(Debug, Clone, PartialEq)]
pub enum Samples {
    Eight(Vec<u8>),
    Sixteen(Vec<u16>),
    Float(Vec<f32>),
    /// Each pixel is the index of a colour: red, green, blue and alpha. An index may be beyond the palette.
    Indexed {
        palette: Vec<[u8; 4]>,
        indices: Vec<u8>,
    },
}

impl Picture {
    /// Returns a sample as a share of its greatest value; a float as it is, and finite. 0 for an index, and
    /// beyond the last sample.
    #[inline]
    pub fn share(&self, sample: usize) -> f64 {
        match &self.samples {
            Samples::Eight(s) => f64::from(s.get(sample).copied().unwrap_or(0)) / 255.0,
            Samples::Sixteen(s) => f64::from(s.get(sample).copied().unwrap_or(0)) / 65_535.0,
            Samples::Float(s) => match s.get(sample).copied().unwrap_or(0.0) {
                number if number.is_nan() => 0.0,
                number => number.clamp(f32::MIN, f32::MAX).into(),
            },
            Samples::Indexed { .. } => 0.0,
        }
    }
}
