//! Reads picture files, each in its own depth, and with a palette if it has one.
//!
//! **In:** the bytes of a file; its type is found from the bytes. **Out:** a [`Picture`]. **Invariant:** never
//! panics, for any bytes, and allocates no more than a file of this length can hold.
//!
//! **Source:** POV-Ray 3.7 manual, section "Image Map"; behaviour measured on POV-Ray 3.7: a colour that a
//! PNG file without a palette declares transparent is opaque; OpenEXR and some TIFF files hold colours that
//! are multiplied by alpha; a Radiance mantissa stands for the middle of its step.

mod exr_block;

use std::fmt;
use std::io::{self, Cursor};

use image::{DynamicImage, ImageFormat, ImageReader};

use super::tiff;
use crate::color::Gamma;
use crate::texture::image::conversion::Encoding;
use crate::texture::picture::{Picture, Samples};

/// Why a file cannot be read.
#[derive(Debug, Clone, PartialEq)]
pub enum Fault {
    /// It is no picture, or of an unknown type.
    Unknown,
    /// The decoder's message.
    Broken(String),
    Empty,
    /// The file ends in the middle of the picture.
    CutOff,
    /// More pixels than can be held.
    TooLarge {
        width: u64,
        height: u64,
    },
    /// The file is too short to hold that many pixels.
    TooShort {
        width: u64,
        height: u64,
    },
}

/// Continues a sentence about the file.
impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown => f.write_str("its type is not known here"),
            Self::Broken(message) => f.write_str(message),
            Self::Empty => f.write_str("there is no picture in it"),
            Self::CutOff => f.write_str("it ends in the middle of the picture"),
            Self::TooLarge { width, height } => {
                write!(f, "it is too large: {width}×{height} pixels")
            }
            Self::TooShort { width, height } => {
                write!(f, "it is too short for the {width}×{height} pixels that it declares")
            }
        }
    }
}

impl Fault {
    /// Describes a decoder's error; `cause` is the failed read behind it, if any.
    fn of(error: &impl fmt::Display, cause: Option<&io::Error>) -> Self {
        match cause {
            Some(cause) if cause.kind() == io::ErrorKind::UnexpectedEof => Self::CutOff,
            _ => Self::Broken(error.to_string().trim().to_owned()),
        }
    }
}

impl From<png::DecodingError> for Fault {
    fn from(error: png::DecodingError) -> Self {
        let cause = match &error {
            png::DecodingError::IoError(cause) => Some(cause),
            _ => None,
        };
        Self::of(&error, cause)
    }
}

impl From<gif::DecodingError> for Fault {
    fn from(error: gif::DecodingError) -> Self {
        let cause = match &error {
            gif::DecodingError::UnexpectedEof => return Self::CutOff,
            gif::DecodingError::Io(cause) => Some(cause),
            _ => None,
        };
        Self::of(&error, cause)
    }
}

impl From<image::ImageError> for Fault {
    fn from(error: image::ImageError) -> Self {
        let cause = match &error {
            image::ImageError::IoError(cause) => Some(cause),
            _ => None,
        };
        Self::of(&error, cause)
    }
}

/// Maximum number of pixels, so that they can be numbered.
const MOST: u64 = 1 << 30;

/// Number of pixels in a block of an OpenEXR file that is allowed for a file of any length.
const BLOCK: u64 = 1 << 20;

/// The most bytes that one byte of a deflated stream can stand for.
const DEFLATE: u64 = 1032;

/// The most pixels that one byte of a GIF stream can stand for: a code has at least 3 bits, and stands for at
/// most 4096 pixels.
const LZW: u64 = 4096 * 8 / 3;

/// Checks the number of pixels before they are allocated; `density` is the most pixels per byte of the file.
fn check(width: u64, height: u64, bytes: &[u8], density: u64) -> Result<(), Fault> {
    match width.saturating_mul(height) {
        0 => Err(Fault::Empty),
        pixels if pixels > MOST => Err(Fault::TooLarge { width, height }),
        pixels if pixels > (bytes.len() as u64).saturating_mul(density) => {
            Err(Fault::TooShort { width, height })
        }
        _ => Ok(()),
    }
}

/// Returns the type of a file by its first bytes.
pub fn format(bytes: &[u8]) -> Option<ImageFormat> {
    match image::guess_format(bytes) {
        Ok(format) => Some(format),
        Err(_) => is_tga(bytes).then_some(ImageFormat::Tga),
    }
}

/// Returns whether the bytes start like a Targa file, which has no signature.
///
/// **Source:** Truevision TGA file format specification 2.0, the header.
fn is_tga(bytes: &[u8]) -> bool {
    let Some(&[_, has_map, kind, _, _, _, _, map_bits, _, _, _, _, w0, w1, h0, h1, bits, flags]) =
        bytes.first_chunk::<18>()
    else {
        return false;
    };
    let kind_fits = match kind {
        1 | 9 => has_map == 1 && matches!(map_bits, 15 | 16 | 24 | 32) && matches!(bits, 8 | 16),
        2 | 10 => has_map <= 1 && matches!(bits, 15 | 16 | 24 | 32),
        3 | 11 => has_map <= 1 && matches!(bits, 8 | 16),
        _ => false,
    };
    kind_fits && w0 | w1 != 0 && h0 | h1 != 0 && flags & 0xc0 == 0
}

/// Reads a picture.
pub fn read(bytes: &[u8]) -> Result<Picture, Fault> {
    match format(bytes).ok_or(Fault::Unknown)? {
        ImageFormat::Png => png(bytes),
        ImageFormat::Gif => gif(bytes),
        format => other(bytes, format),
    }
}

fn png(bytes: &[u8]) -> Result<Picture, Fault> {
    use png::{BitDepth, ColorType, Decoder, Transformations};
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::IDENTITY);
    let mut reader = decoder.read_info()?;
    let info = reader.info();
    let (width, height) = (u64::from(info.width), u64::from(info.height));
    let pixel_bits = info.bits_per_pixel() as u64;
    check(width, height, bytes, (DEFLATE * 8).div_ceil(pixel_bits.max(1)))?;
    let (is_srgb, gama) = (info.srgb.is_some(), info.gama_chunk.map(|gamma| gamma.into_scaled()));
    let palette = info.palette.as_ref().map(|palette| palette.to_vec()).unwrap_or_default();
    let alphas = info.trns.as_ref().map(|alphas| alphas.to_vec()).unwrap_or_default();
    let size = reader.output_buffer_size().ok_or(Fault::TooLarge { width, height })?;
    let mut data = vec![0; size];
    let info = reader.next_frame(&mut data)?;
    let (width, height) = (width as usize, height as usize);
    let channels = info.color_type.samples();
    let depth = info.bit_depth as usize;
    let samples = match (info.color_type, info.bit_depth) {
        (ColorType::Indexed, _) => {
            let rgb = palette.as_chunks::<3>().0.iter().enumerate();
            let color = |(i, &[r, g, b]): (usize, &[u8; 3])| {
                [r, g, b, alphas.get(i).copied().unwrap_or(255)]
            };
            let indices = unpacked(&data, info.line_size, width, depth, 1);
            Samples::Indexed { palette: rgb.map(color).collect(), indices }
        }
        (_, BitDepth::Sixteen) => {
            let pairs = data.as_chunks::<2>().0;
            Samples::Sixteen(pairs.iter().map(|&pair| u16::from_be_bytes(pair)).collect())
        }
        (_, BitDepth::Eight) => Samples::Eight(data),
        _ => {
            let scale = (255 / ((1u16 << depth) - 1)) as u8;
            Samples::Eight(unpacked(&data, info.line_size, width, depth, scale))
        }
    };
    let encoding = match (is_srgb, gama) {
        (true, _) => Encoding::Stated(Gamma::Srgb),
        (false, Some(scaled)) if scaled > 0 => {
            Encoding::Stated(Gamma::Power(100_000.0 / f64::from(scaled)))
        }
        _ => Encoding::Display,
    };
    Ok(Picture { width, height, channels, samples, encoding, is_multiplied: false })
}

/// Returns samples of at most 8 bits, one in a byte, times `scale`.
fn unpacked(data: &[u8], line: usize, width: usize, depth: usize, scale: u8) -> Vec<u8> {
    let sample = |row: &[u8], i: usize| {
        let byte = row.get(i * depth / 8).copied().unwrap_or(0);
        let shift = 8 - depth - i * depth % 8;
        ((u16::from(byte) >> shift) & ((1 << depth) - 1)) as u8 * scale
    };
    let rows = data.chunks_exact(line.max(1));
    rows.flat_map(|row| (0..width).map(move |i| sample(row, i))).collect()
}

/// Reads the first frame.
fn gif(bytes: &[u8]) -> Result<Picture, Fault> {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::Indexed);
    options.set_memory_limit(gif::MemoryLimit::Unlimited);
    let mut decoder = options.read_info(bytes)?;
    let frame = decoder.next_frame_info()?.ok_or(Fault::Empty)?;
    let (width, height) = (frame.width, frame.height);
    let transparent = frame.transparent.map(usize::from);
    check(width.into(), height.into(), bytes, LZW)?;
    let palette = decoder.palette()?.as_chunks::<3>().0.iter().enumerate();
    let alpha = |i: usize| if transparent == Some(i) { 0 } else { 255 };
    let palette = palette.map(|(i, &[r, g, b])| [r, g, b, alpha(i)]).collect();
    let mut indices = vec![0; decoder.buffer_size()];
    decoder.read_into_buffer(&mut indices)?;
    Ok(Picture {
        width: width.into(),
        height: height.into(),
        channels: 1,
        samples: Samples::Indexed { palette, indices },
        encoding: Encoding::Display,
        is_multiplied: false,
    })
}

fn other(bytes: &[u8], format: ImageFormat) -> Result<Picture, Fault> {
    // The most pixels per byte: a JPEG block of 64 takes a bit; a run of BMP may be 255 pixels, and its end may
    // leave out the rest; TIFF may deflate single bits, and OpenEXR at least three channels of two bytes.
    let (encoding, density) = match format {
        ImageFormat::Jpeg => (Encoding::Display, 512),
        ImageFormat::Bmp => (Encoding::Display, 1024),
        ImageFormat::Tga | ImageFormat::Qoi => (Encoding::Display, 64),
        ImageFormat::Tiff => (Encoding::Plain, DEFLATE * 8),
        ImageFormat::OpenExr => (Encoding::Light, DEFLATE / 6),
        ImageFormat::Hdr => (Encoding::Light, 1024),
        _ => (Encoding::Plain, 8),
    };
    if format == ImageFormat::Jpeg && !has_end(bytes) {
        return Err(Fault::CutOff);
    }
    let reader = ImageReader::with_format(Cursor::new(bytes), format);
    let (width, height) = reader.into_dimensions()?;
    check(width.into(), height.into(), bytes, density)?;
    if format == ImageFormat::OpenExr {
        let pixels = exr_block::most_in_block(bytes, width);
        if pixels > BLOCK.max(bytes.len() as u64 * density) {
            return Err(Fault::Broken("it declares too large a block".to_owned()));
        }
    }
    let mut limits = image::Limits::default();
    // Four floats, twice, and something for tables.
    limits.max_alloc = Some(u64::from(width) * u64::from(height) * 32 + (1 << 20));
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    let picture = reader.decode()?;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let (channels, mut samples) = match picture {
        DynamicImage::ImageLuma8(p) => (1, Samples::Eight(p.into_raw())),
        DynamicImage::ImageLumaA8(p) => (2, Samples::Eight(p.into_raw())),
        DynamicImage::ImageRgb8(p) => (3, Samples::Eight(p.into_raw())),
        DynamicImage::ImageRgba8(p) => (4, Samples::Eight(p.into_raw())),
        DynamicImage::ImageLuma16(p) => (1, Samples::Sixteen(p.into_raw())),
        DynamicImage::ImageLumaA16(p) => (2, Samples::Sixteen(p.into_raw())),
        DynamicImage::ImageRgb16(p) => (3, Samples::Sixteen(p.into_raw())),
        DynamicImage::ImageRgba16(p) => (4, Samples::Sixteen(p.into_raw())),
        DynamicImage::ImageRgb32F(p) => (3, Samples::Float(p.into_raw())),
        other => (4, Samples::Float(other.into_rgba32f().into_raw())),
    };
    if let (ImageFormat::Hdr, Samples::Float(numbers)) = (format, &mut samples) {
        numbers.as_chunks_mut::<3>().0.iter_mut().for_each(half_a_step_up);
    }
    let is_multiplied = match format {
        ImageFormat::OpenExr => true,
        ImageFormat::Tiff => tiff::is_multiplied(bytes),
        _ => false,
    };
    Ok(Picture { width, height, channels, samples, encoding, is_multiplied })
}

/// Returns whether a JPEG file has an end behind the start of its last scan; the decoder would fill up what is
/// missing.
fn has_end(bytes: &[u8]) -> bool {
    let last = |marker: u8| bytes.windows(2).rposition(|pair| pair == [0xff, marker]);
    last(0xd9) > last(0xda)
}

/// Moves a Radiance pixel to the middle of its step: its largest component is 128 to 255 steps.
fn half_a_step_up(pixel: &mut [f32; 3]) {
    let largest = pixel.iter().fold(0f32, |largest, &c| largest.max(c));
    if largest > 0.0 && largest.is_finite() {
        // 2ᵉ ≤ largest < 2ᵉ⁺¹.
        let exponent = f32::from_bits(largest.to_bits() & 0x7f80_0000);
        *pixel = pixel.map(|c| c + exponent / 256.0);
    }
}

#[cfg(test)]
mod tests;
