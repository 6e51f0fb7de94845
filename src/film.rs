//! Holds the radiance of each pixel, and converts it to an image.
//!
//! **In:** the radiance gathered by the tracer. **Out:** an [`Image`]. **Invariant:** the same bits for any
//! number of threads; each pixel has its sample count; pixels not reached are black.

use crate::color::{Gamma, Rgb, srgb_decode, srgb_encode};
use crate::math::elementary::pow;
use crate::plan::{Frame, Region};

/// The traced region, row by row from its top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    pub frame: Frame,
    /// Transfer function from radiance to linear light.
    pub assumed_gamma: Gamma,
    /// `region.width × region.height` pixels.
    pub pixels: Vec<Pixel>,
}

/// A pixel of a film. Films are large, so radiance is rounded to `f32` once its samples are summed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pixel {
    radiance: [f32; 3],
    samples: u16,
    coverage: u16,
}

impl Pixel {
    /// `radiance` is the mean of so many samples.
    #[inline]
    pub fn new(radiance: Rgb, samples: u32) -> Self {
        // Finite light stays finite.
        let rounded = |c: f64| (c as f32).clamp(f32::MIN, f32::MAX);
        Self {
            radiance: radiance.components().map(rounded),
            samples: samples.try_into().unwrap_or(u16::MAX),
            coverage: u16::MAX,
        }
    }

    /// Returns the mean of the samples, in the scene's working space.
    #[inline]
    pub fn radiance(self) -> Rgb {
        let [red, green, blue] = self.radiance.map(f64::from);
        Rgb { red, green, blue }
    }

    /// Returns the number of samples: 0 if not reached, 65 535 if as many or more.
    #[inline]
    pub fn samples(self) -> u32 {
        self.samples.into()
    }
}

impl Film {
    /// Peak memory per pixel while tracing: the film, and the marks of edges.
    pub const BYTES_PER_PIXEL: u64 = (size_of::<Pixel>() + size_of::<bool>()) as u64;

    pub fn new(frame: Frame, assumed_gamma: Gamma) -> Self {
        let pixels = frame.region.width as usize * frame.region.height as usize;
        Self { frame, assumed_gamma, pixels: vec![Pixel::default(); pixels] }
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

/// The image to show: the film's region, row by row from its top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    pub width: u32,
    pub height: u32,
    pub components: Components,
}

/// Red, green and blue of each pixel of a row or an image.
#[derive(Debug, Clone, PartialEq)]
pub enum Components {
    /// Display-referred, sRGB transfer function, 0 … 255.
    Eight(Vec<u8>),
    /// Display-referred, sRGB transfer function, 0 … 65535.
    Sixteen(Vec<u16>),
    /// Linear light, 0 … ∞; 1 is the display's white.
    Linear(Vec<f32>),
}

/// Type of the [`Components`] of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Depth {
    #[default]
    Eight,
    Sixteen,
    Linear,
}

impl Depth {
    /// Returns the bytes of a component.
    pub const fn bytes(self) -> usize {
        match self {
            Self::Eight => 1,
            Self::Sixteen => 2,
            Self::Linear => 4,
        }
    }
}

/// Converts a film to an image. Linear light is `assumed_gamma` applied to the radiance. Display-referred
/// values are `255 · sRGB` (or `65535 · sRGB`) of that, rounded to nearest. Negative and undefined light is
/// black.
pub fn develop(film: &Film, depth: Depth) -> Image {
    let Region { width, height, .. } = film.frame.region;
    let developer = Developer::new(depth, film.assumed_gamma, film.pixels.len());
    Image { width, height, components: developer.develop(&film.pixels) }
}

/// Converts pixels of films with the same `assumed_gamma` like [`develop`], building its lookup tables only
/// once.
pub struct Developer(Tones);

enum Tones {
    Eight(Curve),
    Sixteen(Curve),
    Linear(Gamma),
}

impl Developer {
    /// `pixels` is the approximate number of pixels to convert.
    pub fn new(depth: Depth, gamma: Gamma, pixels: usize) -> Self {
        let curve = |last| Curve::new(last, gamma, 3 * pixels);
        Self(match depth {
            Depth::Eight => Tones::Eight(curve(255)),
            Depth::Sixteen => Tones::Sixteen(curve(65_535)),
            Depth::Linear => Tones::Linear(gamma),
        })
    }

    pub fn depth(&self) -> Depth {
        match self.0 {
            Tones::Eight(_) => Depth::Eight,
            Tones::Sixteen(_) => Depth::Sixteen,
            Tones::Linear(_) => Depth::Linear,
        }
    }

    /// Converts some pixels, such as a row.
    pub fn develop(&self, pixels: &[Pixel]) -> Components {
        match &self.0 {
            Tones::Eight(curve) => Components::Eight(each(pixels, |c| curve.code(c) as u8)),
            Tones::Sixteen(curve) => Components::Sixteen(each(pixels, |c| curve.code(c) as u16)),
            Tones::Linear(gamma) => Components::Linear(each(pixels, |c| gamma.linear(c) as f32)),
        }
    }
}

fn each<T: Copy + Default>(pixels: &[Pixel], encode: impl Fn(f64) -> T) -> Vec<T> {
    let mut all = vec![T::default(); 3 * pixels.len()];
    for (place, pixel) in all.chunks_exact_mut(3).zip(pixels) {
        place.copy_from_slice(&pixel.radiance.map(|c| encode(c.into())));
    }
    all
}

/// Returns the code of a component, 0 … `last`, by definition.
fn code(component: f64, gamma: Gamma, last: u32) -> u32 {
    (srgb_encode(gamma.linear(component)) * f64::from(last)).round() as u32
}

/// Computes [`code`] by table: `steps[k]` is the least component with a code above `k`.
///
/// The definition takes two powers, a search only a few comparisons. Both agree for every number, because
/// the steps are computed with the definition itself.
struct Curve {
    last: u32,
    gamma: Gamma,
    /// Empty if there are so few pixels that computing the steps costs more than it saves.
    steps: Vec<f64>,
    /// For each of `starts.len()` equal parts of 0 … 1, the code of its lower end.
    starts: Vec<u32>,
}

impl Curve {
    fn new(last: u32, gamma: Gamma, wanted: usize) -> Self {
        let mut curve = Self { last, gamma, steps: Vec::new(), starts: Vec::new() };
        // Each step costs about twenty evaluations.
        if wanted / 20 > last as usize {
            curve.steps = (0..last).map(|k| step_above(k, gamma, last)).collect();
            let parts = 16 * (last as usize + 1);
            let mut at = 0;
            curve.starts = (0..parts)
                .map(|part| {
                    let low = part as f64 / parts as f64;
                    at += curve.steps[at..].iter().take_while(|&&step| step <= low).count();
                    at as u32
                })
                .collect();
        }
        curve
    }

    #[inline]
    fn code(&self, component: f64) -> u32 {
        if self.steps.is_empty() {
            return code(component, self.gamma, self.last);
        }
        // Casting clamps below and makes NaN 0.
        let part = (component * self.starts.len() as f64) as usize;
        let Some(&start) = self.starts.get(part) else { return self.last };
        let mut code = start;
        while code < self.last && self.steps[code as usize] <= component {
            code += 1;
        }
        code
    }
}

/// Returns the least component with a code above `k`, by bisection over the bits of a float around the
/// inverse formula.
fn step_above(k: u32, gamma: Gamma, last: u32) -> f64 {
    let above = |bits: u64| code(f64::from_bits(bits), gamma, last) > k;
    let shown = (f64::from(k) + 0.5) / f64::from(last);
    let guess = match gamma {
        Gamma::Power(exponent) => pow(srgb_decode(shown), 1.0 / exponent),
        Gamma::Srgb => shown,
    };
    let guess = guess.to_bits();
    let mut width = 16;
    let (mut low, mut high) = (guess, guess);
    while above(low) {
        low = low.saturating_sub(width);
        width *= 16;
    }
    width = 16;
    while !above(high) {
        high += width;
        width *= 16;
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if above(middle) { high = middle } else { low = middle }
    }
    f64::from_bits(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film(radiance: Vec<Rgb>, assumed_gamma: Gamma) -> Film {
        let frame = Frame::whole(radiance.len() as u32, 1);
        let pixels = radiance.into_iter().map(|radiance| Pixel::new(radiance, 1)).collect();
        Film { frame, assumed_gamma, pixels }
    }

    #[test]
    fn the_table_agrees_with_the_definition_at_and_around_every_step() {
        let powers = [1.0, 2.2, 0.4].map(Gamma::Power);
        let curves = [255, 65_535].into_iter().flat_map(|last| {
            powers.into_iter().chain([Gamma::Srgb]).map(move |gamma| (last, gamma))
        });
        for (last, gamma) in curves {
            let curve = Curve::new(last, gamma, usize::MAX);
            assert_eq!(curve.steps.len(), last as usize);
            assert!(curve.steps.windows(2).all(|pair| pair[0] < pair[1]));
            for &step in &curve.steps {
                for bits in step.to_bits() - 3..step.to_bits() + 3 {
                    let c = f64::from_bits(bits);
                    assert_eq!(curve.code(c), code(c, gamma, last), "{c} {gamma} {last}");
                }
            }
            for i in -10..70_000 {
                let c = f64::from(i) / 65_535.0;
                assert_eq!(curve.code(c), code(c, gamma, last), "{c} {gamma} {last}");
            }
            for c in [f64::NAN, f64::INFINITY, -f64::INFINITY, -0.0, 1e-320, 1.0, 1e300] {
                assert_eq!(curve.code(c), code(c, gamma, last), "{c} {gamma} {last}");
            }
        }
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
    fn a_row_is_developed_like_the_whole() {
        let colors: Vec<Rgb> = (0..60).map(|i| Rgb::new(0.0, 0.5, f64::from(i) / 40.0)).collect();
        let mut film = film(colors, Gamma::Srgb);
        film.frame = Frame::whole(12, 5);
        for depth in [Depth::Eight, Depth::Sixteen, Depth::Linear] {
            let developer = Developer::new(depth, film.assumed_gamma, film.pixels.len());
            assert_eq!(developer.depth(), depth);
            let rows: Vec<_> = film.rows().map(|row| developer.develop(row)).collect();
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
