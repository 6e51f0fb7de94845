//! Turns the light of a film into the numbers of an image.

use super::curve::Curve;
use super::{Channels, Film, Pixel};
use crate::color::{Gamma, Rgb};
use crate::plan::Region;

/// The image to show: the film's region, row by row from its top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Whether the components include alpha.
    pub channels: Channels,
    /// All components: those of the first pixel, of the second, and so on.
    pub components: Components,
}

/// Red, green, blue and, if asked for, alpha of each pixel of a row or an image.
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
    /// 8 bits, sRGB.
    #[default]
    Eight,
    /// 16 bits, sRGB.
    Sixteen,
    /// Linear light as `f32`.
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
///
/// With alpha, display-referred colours are divided by it, and what is brighter than its alpha allows has more
/// alpha instead; linear light is multiplied by it, and its alpha is as it is.
///
/// **Source:** behaviour of POV-Ray 3.7 with `Output_Alpha`, measured for PNG and OpenEXR.
///
/// ```
/// use lucarne::color::{Gamma, Rgb};
/// use lucarne::film::{Components, Depth, Film, Pixel, develop};
/// use lucarne::plan::Frame;
///
/// let mut film = Film::new(Frame::whole(2, 1), Gamma::LINEAR);
/// film.pixels[1] = Pixel::new(Rgb::new(0.5, 1.0, 7.0), 1);
/// let image = develop(&film, Depth::Eight);
/// assert_eq!(image.components, Components::Eight(vec![0, 0, 0, 188, 255, 255]));
/// ```
pub fn develop(film: &Film, depth: Depth) -> Image {
    let (Region { width, height, .. }, channels) = (film.frame.region, film.channels);
    let developer = Developer::new(depth, film.assumed_gamma, film.pixels.len());
    Image { width, height, channels, components: developer.develop(&film.pixels, channels) }
}

/// How display-referred components encode light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Encoding {
    /// Transfer function from components to linear light.
    pub display: Gamma,
    /// Whether a pixel has one component, its brightness, in place of red, green and blue.
    pub is_gray: bool,
}

/// Colours, with the sRGB transfer function.
impl Default for Encoding {
    fn default() -> Self {
        Self { display: Gamma::Srgb, is_gray: false }
    }
}

/// Converts pixels of films with the same `assumed_gamma` like [`develop`], building its lookup tables only
/// once.
pub struct Developer {
    tones: Tones,
    encoding: Encoding,
}

enum Tones {
    Eight(Curve),
    Sixteen(Curve),
    Linear(Gamma),
}

impl Developer {
    /// `pixels` is the approximate number of pixels to convert.
    pub fn new(depth: Depth, gamma: Gamma, pixels: usize) -> Self {
        Self::with_encoding(depth, gamma, Encoding::default(), pixels)
    }

    /// Converts like [`Developer::new`], but to display-referred components of this encoding. Linear components
    /// are not changed by it.
    pub fn with_encoding(depth: Depth, gamma: Gamma, encoding: Encoding, pixels: usize) -> Self {
        let curve = |last| Curve::new(last, gamma, encoding.display, 3 * pixels);
        let tones = match depth {
            Depth::Eight => Tones::Eight(curve(255)),
            Depth::Sixteen => Tones::Sixteen(curve(65_535)),
            Depth::Linear => Tones::Linear(gamma),
        };
        Self { tones, encoding }
    }

    /// Returns how display-referred components encode light.
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// Returns the type of the components.
    pub fn depth(&self) -> Depth {
        match self.tones {
            Tones::Eight(_) => Depth::Eight,
            Tones::Sixteen(_) => Depth::Sixteen,
            Tones::Linear(_) => Depth::Linear,
        }
    }

    /// Converts some pixels, such as a row.
    pub fn develop(&self, pixels: &[Pixel], channels: Channels) -> Components {
        let alpha = channels == Channels::Rgba;
        let gray = self.encoding.is_gray;
        match &self.tones {
            Tones::Eight(curve) if gray => {
                Components::Eight(grays(pixels, alpha, curve, |n| n as u8))
            }
            Tones::Sixteen(curve) if gray => {
                Components::Sixteen(grays(pixels, alpha, curve, |n| n as u16))
            }
            Tones::Eight(curve) => Components::Eight(codes(pixels, alpha, curve, |n| n as u8)),
            Tones::Sixteen(curve) => Components::Sixteen(codes(pixels, alpha, curve, |n| n as u16)),
            Tones::Linear(gamma) => Components::Linear(match alpha {
                true => each_multiplied(pixels, *gamma),
                false => each(pixels, |c| gamma.linear(c) as f32),
            }),
        }
    }
}

/// Returns the codes by which a display shows pixels.
fn codes<T: Copy + Default>(
    pixels: &[Pixel],
    alpha: bool,
    curve: &Curve,
    narrow: impl Fn(u32) -> T,
) -> Vec<T> {
    let code = |c| narrow(curve.code(c));
    match alpha {
        true => each_straight(pixels, code, |alpha| narrow(curve.of_alpha(alpha))),
        false => each(pixels, code),
    }
}

/// Returns the codes of the brightness of pixels, which is that of the scene's components.
///
/// **Source:** `Grayscale_Output` of POV-Ray 3.7, measured to 1/65,535, also with `assumed_gamma 2.2` and light
/// above 1.
fn grays<T>(pixels: &[Pixel], alpha: bool, curve: &Curve, narrow: impl Fn(u32) -> T) -> Vec<T> {
    let code = |color: Rgb| narrow(curve.code(color.brightness()));
    match alpha {
        true => pixels
            .iter()
            .flat_map(|pixel| {
                let (color, alpha) = pixel.straight();
                [code(color), narrow(curve.of_alpha(alpha))]
            })
            .collect(),
        false => pixels.iter().map(|pixel| code(pixel.radiance())).collect(),
    }
}

fn each<T: Copy + Default>(pixels: &[Pixel], encode: impl Fn(f64) -> T) -> Vec<T> {
    let mut all = vec![T::default(); 3 * pixels.len()];
    for (place, pixel) in all.chunks_exact_mut(3).zip(pixels) {
        let Rgb { red, green, blue } = pixel.radiance();
        place.copy_from_slice(&[encode(red), encode(green), encode(blue)]);
    }
    all
}

/// Returns colours that alpha does not multiply, and their alpha.
fn each_straight<T>(
    pixels: &[Pixel],
    encode: impl Fn(f64) -> T,
    part: impl Fn(f64) -> T,
) -> Vec<T> {
    let straight = |pixel: &Pixel| {
        let (color, alpha) = pixel.straight();
        let [red, green, blue] = color.components().map(&encode);
        [red, green, blue, part(alpha)]
    };
    pixels.iter().flat_map(straight).collect()
}

/// Returns linear light that alpha multiplies, and alpha.
fn each_multiplied(pixels: &[Pixel], gamma: Gamma) -> Vec<f32> {
    let multiplied = |pixel: &Pixel| {
        let (color, part) = pixel.straight();
        let [red, green, blue] = color.components().map(|c| (gamma.linear(c) * part) as f32);
        [red, green, blue, pixel.opacity() as f32]
    };
    pixels.iter().flat_map(multiplied).collect()
}
