//! What is seen along rays of the camera.

use std::ops::{Add, AddAssign};

use crate::color::Rgb;
use crate::film::Pixel;

/// What is seen along a ray of the camera, or its sum or mean over several.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    pub radiance: Rgb,
    /// How much of it is not the background, 0 … 1; 1 if that is not asked for.
    pub opacity: f64,
}

impl Sight {
    /// Where there is no ray, and before any is added.
    pub const NOTHING: Self = Self { radiance: Rgb::BLACK, opacity: 0.0 };

    pub const fn opaque(radiance: Rgb) -> Self {
        Self { radiance, opacity: 1.0 }
    }

    /// Returns the mean by the sum of so many.
    pub fn mean(self, count: f64) -> Self {
        if count == 1.0 {
            return self;
        }
        Self { radiance: self.radiance.map(|c| c / count), opacity: self.opacity / count }
    }

    /// Returns the pixel that this is the mean of so many samples of.
    #[inline]
    pub fn pixel(self, samples: u32) -> Pixel {
        Pixel::new(self.radiance, samples).with_opacity(self.opacity)
    }
}

impl From<Pixel> for Sight {
    fn from(pixel: Pixel) -> Self {
        Self { radiance: pixel.radiance(), opacity: pixel.opacity() }
    }
}

impl Add for Sight {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { radiance: self.radiance + other.radiance, opacity: self.opacity + other.opacity }
    }
}

impl AddAssign for Sight {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
