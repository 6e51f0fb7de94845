//! Films hold the light of each pixel; developed, they become images.
//!
//! **In:** the radiance gathered by the tracer. **Out:** an [`Image`]. **Invariant:** the same bits for any
//! number of threads; each pixel has its sample count; pixels not reached are black.

mod curve;
mod develop;
mod first_surface;
pub mod saved;

use crate::color::{Gamma, Rgb};
use crate::plan::{Frame, Region};

pub use develop::{Components, Depth, Developer, Encoding, Image, develop};
pub use first_surface::{Channel, FirstSurface, Surfaces};

/// The traced region, row by row from its top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    /// The picture, and the region of it that this film shows.
    pub frame: Frame,
    /// Transfer function from radiance to linear light.
    pub assumed_gamma: Gamma,
    /// What the picture shows of each pixel.
    pub channels: Channels,
    /// `region.width × region.height` pixels.
    pub pixels: Vec<Pixel>,
}

/// Channels of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Channels {
    /// Red, green and blue.
    #[default]
    Rgb,
    /// With alpha: how much of the pixel is not the background.
    Rgba,
}

impl Channels {
    /// Returns their number.
    pub const fn count(self) -> usize {
        match self {
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }

    /// Returns those of a picture with or without alpha.
    pub const fn with(alpha: bool) -> Self {
        if alpha { Self::Rgba } else { Self::Rgb }
    }
}

/// A pixel of a film. Films are large, so radiance is rounded to `f32` once its samples are summed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pixel {
    radiance: [f32; 3],
    samples: u16,
    /// In 65,535ths.
    opacity: u16,
}

impl Pixel {
    /// `radiance` is the mean of so many samples, of an opaque pixel.
    #[inline]
    pub fn new(radiance: Rgb, samples: u32) -> Self {
        // Finite light stays finite.
        let rounded = |c: f64| (c as f32).clamp(f32::MIN, f32::MAX);
        Self {
            radiance: radiance.components().map(rounded),
            samples: samples.try_into().unwrap_or(u16::MAX),
            opacity: u16::MAX,
        }
    }

    /// Makes an opaque pixel one of which so much is not the background, 0 … 1.
    #[inline]
    pub fn with_opacity(mut self, opacity: f64) -> Self {
        if opacity != 1.0 {
            self.opacity = (opacity * f64::from(u16::MAX) + 0.5) as u16;
        }
        self
    }

    /// Returns the mean of the samples, in the scene's working space.
    #[inline]
    pub fn radiance(self) -> Rgb {
        let [red, green, blue] = self.radiance.map(f64::from);
        Rgb { red, green, blue }
    }

    /// Returns how much of the pixel is not the background, 0 … 1.
    #[inline]
    pub fn opacity(self) -> f64 {
        f64::from(self.opacity) / f64::from(u16::MAX)
    }

    /// Returns its colour divided by alpha, and that alpha: the pixel's opacity, or its brightness if that is more,
    /// up to 1.
    fn straight(self) -> (Rgb, f64) {
        let radiance = self.radiance();
        let alpha = self.opacity().max(radiance.brightness().min(1.0));
        let color = if alpha > 0.0 { radiance * (1.0 / alpha) } else { Rgb::BLACK };
        (color, alpha)
    }

    /// Returns the number of samples: 0 if not reached, 65 535 if as many or more.
    #[inline]
    pub fn samples(self) -> u32 {
        self.samples.into()
    }
}

impl Film {
    /// Peak memory per pixel while tracing: the film, and the variances of edges.
    pub const BYTES_PER_PIXEL: u64 = (size_of::<Pixel>() + size_of::<f32>()) as u64;

    /// Returns a film without alpha whose pixels are not reached.
    pub fn new(frame: Frame, assumed_gamma: Gamma) -> Self {
        let pixels = frame.region.width as usize * frame.region.height as usize;
        let pixels = vec![Pixel::default(); pixels];
        Self { frame, assumed_gamma, channels: Channels::Rgb, pixels }
    }

    /// Returns the index of pixel (`x`, `y`) of the full picture, which must be in the region.
    #[inline]
    pub fn index(&self, x: u32, y: u32) -> usize {
        let region = self.frame.region;
        (y - region.y) as usize * region.width as usize + (x - region.x) as usize
    }

    /// Returns the radiance of the pixel with this index.
    #[inline]
    pub fn radiance(&self, index: usize) -> Rgb {
        self.pixels[index].radiance()
    }

    /// Returns the radiance of each pixel.
    pub fn radiances(&self) -> impl ExactSizeIterator<Item = Rgb> {
        self.pixels.iter().map(|pixel| pixel.radiance())
    }

    /// Returns the number of samples of each pixel.
    pub fn samples(&self) -> impl ExactSizeIterator<Item = u32> {
        self.pixels.iter().map(|pixel| pixel.samples())
    }

    /// Returns the rows of pixels, from the top.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[Pixel]> {
        self.pixels.chunks(self.frame.region.width.max(1) as usize)
    }

    /// Replaces the pixels of a part, with what it holds of them; `None` if it is not a part of this film.
    pub fn place(&mut self, part: &Self) -> Option<()> {
        let (all, Region { x, y, width, height }) = (self.frame, part.frame.region);
        let frame = Frame { region: all.region, ..part.frame };
        let right = all.region.x.checked_add(all.region.width)?;
        let bottom = all.region.y.checked_add(all.region.height)?;
        let fits = x >= all.region.x
            && y >= all.region.y
            && x.checked_add(width)? <= right
            && y.checked_add(height)? <= bottom;
        let is_alike = self.channels == part.channels && self.assumed_gamma == part.assumed_gamma;
        if frame != all || !fits || !is_alike {
            return None;
        }
        for (line, row) in (y..).zip(part.rows()) {
            let start = self.index(x, line);
            self.pixels[start..start + width as usize].copy_from_slice(row);
        }
        Some(())
    }

    /// Returns the film of the whole picture: pixels outside of the region are not reached.
    pub fn framed(self) -> Self {
        let whole = Frame::whole(self.frame.width, self.frame.height);
        if self.frame.region == whole.region {
            return self;
        }
        let mut all = Self { channels: self.channels, ..Self::new(whole, self.assumed_gamma) };
        // It is a part, by its own frame.
        let _ = all.place(&self);
        all
    }

    /// Returns the part of the film in `region`, which must lie within its own.
    ///
    /// Moves the rows in place instead of allocating a second film, as films are large.
    pub fn crop(mut self, region: Region) -> Self {
        if region == self.frame.region {
            return self;
        }
        let row = region.width as usize;
        let mut to = 0;
        for y in region.y..region.y + region.height {
            let from = self.index(region.x, y);
            self.pixels.copy_within(from..from + row, to);
            to += row;
        }
        self.pixels.truncate(to);
        self.frame.region = region;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film(radiance: Vec<Rgb>, assumed_gamma: Gamma) -> Film {
        let frame = Frame::whole(radiance.len() as u32, 1);
        let pixels = radiance.into_iter().map(|radiance| Pixel::new(radiance, 1)).collect();
        Film { pixels, ..Film::new(frame, assumed_gamma) }
    }

    #[test]
    fn small_and_large_films_are_shown_alike() {
        let colors: Vec<Rgb> = (0..100).map(|i| Rgb::gray(f64::from(i) / 99.0)).collect();
        let many: Vec<Rgb> = colors.iter().copied().cycle().take(100 * 300).collect();
        let eight = |colors| match develop(&film(colors, Gamma::LINEAR), Depth::Eight).components {
            Components::Eight(eight) => eight,
            other => panic!("not 8 bits: {other:?}"),
        };
        assert_eq!(eight(colors), eight(many)[3 * 29_900..]);
    }

    #[test]
    fn gamma_turns_the_working_space_into_linear_light() {
        let image =
            develop(&film(vec![Rgb::new(0.5, -1.0, 4.0)], Gamma::Power(2.0)), Depth::Linear);
        assert_eq!(image.components, Components::Linear(vec![0.25, 0.0, 16.0]));
    }

    #[test]
    fn known_colours_have_known_numbers() {
        let colors = vec![Rgb::new(0.0, 1.0, 0.5), Rgb::new(f64::NAN, 7.0, 0.215_860_5)];
        let film = film(colors, Gamma::LINEAR);
        let eight = develop(&film, Depth::Eight).components;
        assert_eq!(eight, Components::Eight(vec![0, 255, 188, 0, 255, 128]));
        let Components::Sixteen(sixteen) = develop(&film, Depth::Sixteen).components else {
            panic!("not 16 bits")
        };
        assert_eq!(sixteen[..3], [0, 65_535, 48_192]);
    }

    #[test]
    fn a_pixel_takes_sixteen_bytes_and_keeps_what_it_holds_finite() {
        assert_eq!(size_of::<Pixel>(), 16);
        let pixel = Pixel::new(Rgb::new(0.1, 1e300, -1e300), 1 << 20);
        let Rgb { red, green, blue } = pixel.radiance();
        assert!((red - 0.1).abs() <= 0.1 * f64::from(f32::EPSILON) / 2.0, "{red}");
        assert_eq!((green, blue), (f32::MAX.into(), f32::MIN.into()));
        assert_eq!(pixel.samples(), 65_535);
        assert_eq!(Pixel::new(pixel.radiance(), 9), Pixel { samples: 9, ..pixel });
    }

    #[test]
    fn alpha_divides_what_a_display_shows_and_multiplies_linear_light() {
        let quarter = f64::from(1u16 << 14) / 65_535.0;
        let clear = Pixel::new(Rgb::new(quarter, 0.5 * quarter, 0.0), 1).with_opacity(quarter);
        // Brighter than alpha allows: a highlight on clear glass.
        let bright = Pixel::new(Rgb::gray(0.6), 1).with_opacity(0.0);
        let pixels = vec![clear, bright, Pixel::default()];
        let film = |assumed_gamma| Film {
            channels: Channels::Rgba,
            pixels: pixels.clone(),
            ..Film::new(Frame::whole(3, 1), assumed_gamma)
        };
        let eight = develop(&film(Gamma::LINEAR), Depth::Eight).components;
        let expected = vec![255, 188, 0, 64, 255, 255, 255, 153, 0, 0, 0, 0];
        assert_eq!(eight, Components::Eight(expected));
        let linear = |gamma| match develop(&film(gamma), Depth::Linear).components {
            Components::Linear(linear) => linear,
            other => panic!("not linear: {other:?}"),
        };
        let close =
            |a: &[f32], b: [f64; 4]| a.iter().zip(b).all(|(a, b)| (f64::from(*a) - b).abs() < 1e-6);
        let straight = linear(Gamma::LINEAR);
        assert!(close(&straight[..4], [quarter, 0.5 * quarter, 0.0, quarter]), "{straight:?}");
        assert!(close(&straight[4..8], [0.6, 0.6, 0.6, 0.0]), "{straight:?}");
        // The curve is that of colours which alpha does not multiply.
        let squared = linear(Gamma::Power(2.0));
        assert!(close(&squared[..4], [quarter, 0.25 * quarter, 0.0, quarter]), "{squared:?}");
    }

    #[test]
    fn a_row_is_developed_like_the_whole() {
        let colors: Vec<Rgb> = (0..60).map(|i| Rgb::new(0.0, 0.5, f64::from(i) / 40.0)).collect();
        let mut film = film(colors, Gamma::Srgb);
        film.frame = Frame::whole(12, 5);
        for depth in [Depth::Eight, Depth::Sixteen, Depth::Linear] {
            let developer = Developer::new(depth, film.assumed_gamma, film.pixels.len());
            assert_eq!(developer.depth(), depth);
            let rows: Vec<_> =
                film.rows().map(|row| developer.develop(row, film.channels)).collect();
            assert_eq!(rows.len(), 5);
            let mut bits = Vec::new();
            for row in rows {
                match row {
                    Components::Eight(row) => bits.extend(row.into_iter().map(u32::from)),
                    Components::Sixteen(row) => bits.extend(row.into_iter().map(u32::from)),
                    Components::Linear(row) => bits.extend(row.into_iter().map(f32::to_bits)),
                }
            }
            let whole: Vec<u32> = match develop(&film, depth).components {
                Components::Eight(whole) => whole.into_iter().map(u32::from).collect(),
                Components::Sixteen(whole) => whole.into_iter().map(u32::from).collect(),
                Components::Linear(whole) => whole.into_iter().map(f32::to_bits).collect(),
            };
            assert_eq!(bits, whole);
        }
    }
}
