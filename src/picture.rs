//! Picture files: writes films as PNG, JPEG, OpenEXR and other formats.
//!
//! **In:** a [`Film`]. **Out:** the bytes of a file. **Invariant:** the bytes depend only on the image that the
//! film is developed to: no date, no name, no thread order.

pub mod animated;
mod exr;
pub(crate) mod heights;
pub(crate) mod read;
mod tiff;

use std::io::{Error, Result, Write};

use image::codecs::bmp::BmpEncoder;
use image::codecs::hdr::HdrEncoder;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::qoi::QoiEncoder;
use image::codecs::tga::TgaEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};
use png::EncodingError;

use crate::color::Gamma;
use crate::film::{Channels, Components, Depth, Developer, Film, Surfaces};
use crate::plan::Region;

/// Bytes in a part of a PNG.
const CHUNK: usize = 1 << 16;

/// The format of a picture file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// 8 or 16 bits, lossless, with sRGB and gAMA chunks.
    Png,
    /// 8 bits, lossy.
    Jpeg,
    /// 8 or 16 bits, uncompressed.
    Ppm,
    /// 8 bits, lossless.
    Qoi,
    /// Targa: 8 bits, lossless.
    Tga,
    /// 8 bits, uncompressed.
    Bmp,
    /// Radiance: linear light, 8 bits and a shared exponent.
    Hdr,
    /// OpenEXR: linear light, 32-bit floats.
    Exr,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 8] =
        [Self::Png, Self::Jpeg, Self::Ppm, Self::Qoi, Self::Tga, Self::Bmp, Self::Hdr, Self::Exr];

    /// Returns the file name extensions of this format; the first is the usual one.
    pub fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Png => &["png"],
            Self::Jpeg => &["jpg", "jpeg"],
            Self::Ppm => &["ppm"],
            Self::Qoi => &["qoi"],
            Self::Tga => &["tga"],
            Self::Bmp => &["bmp"],
            Self::Hdr => &["hdr"],
            Self::Exr => &["exr"],
        }
    }

    /// Returns the format of a file name extension, ignoring case.
    pub fn from_extension(extension: &str) -> Option<Self> {
        let lower = extension.to_lowercase();
        Self::ALL.into_iter().find(|format| format.extensions().contains(&lower.as_str()))
    }

    /// Returns the pixel depth that this format requires for the requested number of bits; `None` if it does
    /// not support them.
    pub fn depth(self, bits: Option<u8>) -> Option<Depth> {
        match (self, bits) {
            (Self::Hdr | Self::Exr, None | Some(32)) => Some(Depth::Linear),
            (Self::Hdr | Self::Exr, _) => None,
            (_, None | Some(8)) => Some(Depth::Eight),
            (Self::Png | Self::Ppm, Some(16)) => Some(Depth::Sixteen),
            _ => None,
        }
    }

    /// Whether a picture of this format can have channels beside its colours and alpha.
    pub fn holds_channels(self) -> bool {
        self == Self::Exr
    }

    /// Whether a picture of this format can have an alpha channel.
    pub fn holds_alpha(self) -> bool {
        match self {
            Self::Png | Self::Qoi | Self::Tga | Self::Bmp | Self::Exr => true,
            Self::Jpeg | Self::Ppm | Self::Hdr => false,
        }
    }

    /// Returns why this format cannot hold a picture of this size; `None` if it can.
    pub fn too_large(self, width: u32, height: u32) -> Option<String> {
        match self {
            Self::Jpeg if width.max(height) > 65_535 => {
                Some("a .jpg picture is at most 65535 pixels wide and high".to_owned())
            }
            Self::Qoi if u64::from(width) * u64::from(height) > 400_000_000 => {
                Some("a .qoi picture has at most 400000000 pixels".to_owned())
            }
            Self::Tga if width.max(height) > 65_535 => {
                Some("a .tga picture is at most 65535 pixels wide and high".to_owned())
            }
            // The size of the file has 32 bits.
            Self::Bmp if u64::from(width) * u64::from(height) > 1 << 30 => {
                Some("a .bmp picture has at most 1073741824 pixels".to_owned())
            }
            _ => None,
        }
    }

    /// Returns the memory that [`write()`] takes per pixel, beside a row: the entire image, and the entire file
    /// for a format that is not written from front to back.
    pub const fn bytes_per_pixel(self, channels: Channels) -> u64 {
        let channels = channels.count() as u64;
        match self {
            Self::Png | Self::Ppm => 0,
            Self::Jpeg | Self::Tga | Self::Bmp => channels,
            // The colours of the file may be one byte longer.
            Self::Qoi => channels + (channels + 1),
            Self::Hdr => 4 * channels,
            Self::Exr => 4 * channels + 4 * channels,
        }
    }

    /// Returns a lower bound on the size of the file in colour. Exact for uncompressed formats.
    pub fn least_bytes(self, depth: Depth, width: u32, height: u32) -> u64 {
        let pixels = u64::from(width) * u64::from(height);
        match (self, depth) {
            (Self::Ppm, Depth::Eight) => {
                ppm_header("P6", width, height, 255).len() as u64 + 3 * pixels
            }
            (Self::Ppm, _) => ppm_header("P6", width, height, 65_535).len() as u64 + 6 * pixels,
            // A header, and a bit for every hundred pixels or so.
            _ => 64 + pixels / 1000,
        }
    }
}

/// Writes a film as a picture. Fails if it cannot be written, or if the format cannot hold it: it is too
/// large, of another depth, or grey in other formats than PNG and PPM.
pub fn write(
    film: &Film,
    developer: &Developer,
    format: Format,
    out: &mut dyn Write,
) -> Result<()> {
    let Region { width, height, .. } = film.frame.region;
    let is_gray = developer.encoding().is_gray;
    let color = match (developer.depth(), film.channels) {
        _ if is_gray && !matches!(format, Format::Png | Format::Ppm) => {
            return Err(Error::other(format!("{format:?} is not written in grey")));
        }
        _ if film.channels == Channels::Rgba && !format.holds_alpha() => {
            return Err(Error::other(format!("{format:?} cannot hold alpha")));
        }
        (Depth::Eight, Channels::Rgb) => ExtendedColorType::Rgb8,
        (Depth::Eight, Channels::Rgba) => ExtendedColorType::Rgba8,
        (Depth::Sixteen, _) => ExtendedColorType::Rgb16,
        (Depth::Linear, Channels::Rgb) => ExtendedColorType::Rgb32F,
        (Depth::Linear, Channels::Rgba) => ExtendedColorType::Rgba32F,
    };
    let whole = || {
        let pixel = film.channels.count() * developer.depth().bytes();
        let mut whole = Vec::with_capacity(pixel * film.pixels.len());
        rows(film, developer, u16::to_ne_bytes).for_each(|row| whole.extend_from_slice(&row));
        whole
    };
    let written = match format {
        Format::Png => return png(film, developer, out),
        Format::Ppm => return ppm(film, developer, out),
        Format::Exr => return exr::write(film, None, developer, out),
        Format::Jpeg => {
            JpegEncoder::new_with_quality(out, 92).write_image(&whole(), width, height, color)
        }
        Format::Tga => TgaEncoder::new(out).write_image(&whole(), width, height, color),
        Format::Bmp => BmpEncoder::new(&mut &mut *out).write_image(&whole(), width, height, color),
        Format::Qoi => QoiEncoder::new(out).write_image(&whole(), width, height, color),
        Format::Hdr => HdrEncoder::new(out).write_image(&whole(), width, height, color),
    };
    written.map_err(|error| match error {
        ImageError::IoError(error) => error,
        error => Error::other(error),
    })
}

/// Writes a film and its first surfaces as an OpenEXR picture.
pub fn write_with_surfaces(
    film: &Film,
    surfaces: &Surfaces,
    developer: &Developer,
    out: &mut dyn Write,
) -> Result<()> {
    exr::write(film, Some(surfaces), developer, out)
}

/// Returns the bytes that [`write()`] writes.
pub fn encode(film: &Film, depth: Depth, format: Format) -> Result<Vec<u8>> {
    let developer = Developer::new(depth, film.assumed_gamma, film.pixels.len());
    let mut bytes = Vec::new();
    write(film, &developer, format, &mut bytes)?;
    Ok(bytes)
}

/// Returns the bytes of each row, with the bytes of components of 16 bits in this order.
fn rows(
    film: &Film,
    developer: &Developer,
    order: impl Fn(u16) -> [u8; 2],
) -> impl Iterator<Item = Vec<u8>> {
    film.rows().map(move |row| match developer.develop(row, film.channels) {
        Components::Eight(bytes) => bytes,
        Components::Sixteen(all) => bytes(&all, &order),
        Components::Linear(all) => bytes(&all, f32::to_ne_bytes),
    })
}

fn bytes<T: Copy, const N: usize>(all: &[T], order: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    let mut bytes = vec![0; N * all.len()];
    for (place, &one) in bytes.chunks_exact_mut(N).zip(all) {
        place.copy_from_slice(&order(one));
    }
    bytes
}

/// Encodes with `png` directly, as `image` writes no sRGB and gAMA chunks.
fn png(film: &Film, developer: &Developer, out: &mut dyn Write) -> Result<()> {
    let Region { width, height, .. } = film.frame.region;
    let mut encoder = png::Encoder::new(out, width, height);
    let encoding = developer.encoding();
    encoder.set_color(match (film.channels, encoding.is_gray) {
        (Channels::Rgb, false) => png::ColorType::Rgb,
        (Channels::Rgba, false) => png::ColorType::Rgba,
        (Channels::Rgb, true) => png::ColorType::Grayscale,
        (Channels::Rgba, true) => png::ColorType::GrayscaleAlpha,
    });
    encoder.set_depth(match developer.depth() {
        Depth::Eight => png::BitDepth::Eight,
        Depth::Sixteen => png::BitDepth::Sixteen,
        Depth::Linear => return Err(Error::other("PNG cannot hold linear light")),
    });
    // A sixth to a third larger than by the usual compression, which takes as long as tracing a simple scene.
    encoder.set_compression(png::Compression::Fast);
    let power = match encoding.display {
        Gamma::Srgb => {
            encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
            // The curve's nearest power, for readers that know no sRGB.
            2.2
        }
        Gamma::Power(power) => power,
    };
    let scaled = (100_000.0 / power).round() as u32;
    encoder.set_source_gamma(png::ScaledFloat::from_scaled(scaled.max(1)));
    let failed = |error| match error {
        EncodingError::IoError(error) => error,
        error => Error::other(error),
    };
    let mut writer = encoder.write_header().map_err(failed)?;
    let mut stream = writer.stream_writer_with_size(CHUNK).map_err(failed)?;
    for row in rows(film, developer, u16::to_be_bytes) {
        stream.write_all(&row)?;
    }
    stream.finish().and_then(|()| writer.finish()).map_err(failed)
}

/// Encodes a binary PPM, or a PGM if it is grey. **Source:** the Netpbm manual, `ppm` and `pgm`.
fn ppm(film: &Film, developer: &Developer, out: &mut dyn Write) -> Result<()> {
    let last = match developer.depth() {
        Depth::Eight => 255,
        Depth::Sixteen => 65_535,
        Depth::Linear => return Err(Error::other("PPM cannot hold linear light")),
    };
    let Region { width, height, .. } = film.frame.region;
    let kind = if developer.encoding().is_gray { "P5" } else { "P6" };
    out.write_all(ppm_header(kind, width, height, last).as_bytes())?;
    rows(film, developer, u16::to_be_bytes).try_for_each(|row| out.write_all(&row))
}

fn ppm_header(kind: &str, width: u32, height: u32, last: u32) -> String {
    format!("{kind}\n{width} {height}\n{last}\n")
}

/// Returns whether a file that starts with these bytes is a picture, in one of our formats or another.
pub fn is_picture(start: &[u8]) -> bool {
    image::guess_format(start).is_ok() || is_tga(start)
}

/// A TGA has no mark, but no text starts with such numbers: whether there is a palette, the kind of pixels, and their bits.
///
/// **Source:** Truevision TGA File Format Specification 2.0, 1991, fields 2, 3 and 5.5.
fn is_tga(start: &[u8]) -> bool {
    matches!(start.get(1..3), Some([0 | 1, 1..=3 | 9..=11]))
        && matches!(start.get(16), Some(8 | 15 | 16 | 24 | 32))
}

#[cfg(test)]
mod tests;
