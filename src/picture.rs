//! Picture files; the only module that uses `image` and `png`.
//!
//! **In:** a [`Film`]. **Out:** the bytes of a file. **Invariant:** the bytes depend only on the image that the
//! film is developed to: no date, no name, no thread order.

mod exr;
pub mod heights;
pub mod read;
mod tiff;

use std::io::{Cursor, Error, Result, Write};

use image::codecs::hdr::HdrEncoder;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::openexr::OpenExrEncoder;
use image::codecs::qoi::QoiEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};
use png::EncodingError;

use crate::film::{Channels, Components, Depth, Developer, Film};
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
    /// Radiance: linear light, 8 bits and a shared exponent.
    Hdr,
    /// OpenEXR: linear light, 32-bit floats.
    Exr,
}

impl Format {
    pub const ALL: [Self; 6] = [Self::Png, Self::Jpeg, Self::Ppm, Self::Qoi, Self::Hdr, Self::Exr];

    /// Returns the file name extensions of this format; the first is the usual one.
    pub fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Png => &["png"],
            Self::Jpeg => &["jpg", "jpeg"],
            Self::Ppm => &["ppm"],
            Self::Qoi => &["qoi"],
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
            (Self::Png | Self::Jpeg | Self::Ppm | Self::Qoi, None | Some(8)) => Some(Depth::Eight),
            (Self::Png | Self::Ppm, Some(16)) => Some(Depth::Sixteen),
            _ => None,
        }
    }

    /// Whether a picture of this format can have an alpha channel.
    pub fn holds_alpha(self) -> bool {
        match self {
            Self::Png | Self::Qoi | Self::Exr => true,
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
            Self::Jpeg | Self::Qoi | Self::Png | Self::Ppm | Self::Hdr | Self::Exr => None,
        }
    }

    /// Returns the memory that [`write()`] takes per pixel, beside a row: the entire image, and the entire file
    /// for a format that is not written from front to back.
    pub const fn bytes_per_pixel(self, channels: Channels) -> u64 {
        let channels = channels.count() as u64;
        match self {
            Self::Png | Self::Ppm => 0,
            Self::Jpeg => channels,
            // The colours of the file may be one byte longer.
            Self::Qoi => channels + (channels + 1),
            Self::Hdr => 4 * channels,
            Self::Exr => 4 * channels + 4 * channels,
        }
    }

    /// Returns a lower bound on the size of the file. Exact for uncompressed formats.
    pub fn least_bytes(self, depth: Depth, width: u32, height: u32) -> u64 {
        let pixels = u64::from(width) * u64::from(height);
        match (self, depth) {
            (Self::Ppm, Depth::Eight) => ppm_header(width, height, 255).len() as u64 + 3 * pixels,
            (Self::Ppm, _) => ppm_header(width, height, 65_535).len() as u64 + 6 * pixels,
            // A header, and a bit for every hundred pixels or so.
            (Self::Png | Self::Jpeg | Self::Qoi | Self::Hdr | Self::Exr, _) => 64 + pixels / 1000,
        }
    }
}

/// Writes a film as a picture. Fails if it cannot be written, or if the format cannot hold it: it is too
/// large, or of another depth.
pub fn write(
    film: &Film,
    developer: &Developer,
    format: Format,
    out: &mut dyn Write,
) -> Result<()> {
    let Region { width, height, .. } = film.frame.region;
    let color = match (developer.depth(), film.channels) {
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
        Format::Jpeg => {
            JpegEncoder::new_with_quality(out, 92).write_image(&whole(), width, height, color)
        }
        Format::Qoi => QoiEncoder::new(out).write_image(&whole(), width, height, color),
        Format::Hdr => HdrEncoder::new(out).write_image(&whole(), width, height, color),
        Format::Exr => {
            let mut file = Cursor::new(Vec::new());
            OpenExrEncoder::new(&mut file)
                .write_image(&whole(), width, height, color)
                .and_then(|()| Ok(out.write_all(file.get_ref())?))
        }
    };
    written.map_err(|error| match error {
        ImageError::IoError(error) => error,
        error => Error::other(error),
    })
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
    encoder.set_color(match film.channels {
        Channels::Rgb => png::ColorType::Rgb,
        Channels::Rgba => png::ColorType::Rgba,
    });
    encoder.set_depth(match developer.depth() {
        Depth::Eight => png::BitDepth::Eight,
        Depth::Sixteen => png::BitDepth::Sixteen,
        Depth::Linear => return Err(Error::other("PNG cannot hold linear light")),
    });
    // A sixth to a third larger than by the usual compression, which takes as long as tracing a simple scene.
    encoder.set_compression(png::Compression::Fast);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    // The curve's nearest power, for readers that know no sRGB.
    encoder.set_source_gamma(png::ScaledFloat::from_scaled(45_455));
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

/// Encodes a binary PPM. **Source:** the Netpbm manual, `ppm`.
fn ppm(film: &Film, developer: &Developer, out: &mut dyn Write) -> Result<()> {
    let last = match developer.depth() {
        Depth::Eight => 255,
        Depth::Sixteen => 65_535,
        Depth::Linear => return Err(Error::other("PPM cannot hold linear light")),
    };
    let Region { width, height, .. } = film.frame.region;
    out.write_all(ppm_header(width, height, last).as_bytes())?;
    rows(film, developer, u16::to_be_bytes).try_for_each(|row| out.write_all(&row))
}

fn ppm_header(width: u32, height: u32, last: u32) -> String {
    format!("P6\n{width} {height}\n{last}\n")
}

/// Returns whether a file that starts with these bytes is a picture, in one of our formats or another.
pub fn is_picture(start: &[u8]) -> bool {
    image::guess_format(start).is_ok()
}

#[cfg(test)]
mod tests {
    use std::io::ErrorKind;

    use super::*;
    use crate::color::{Gamma, Rgb};
    use crate::film::{Pixel, develop};
    use crate::plan::Frame;

    /// A film with many colours.
    fn film() -> Film {
        let frame = Frame::whole(31, 17);
        let parts = |i: u32| [i % 256, (i * 7) % 256, (i * 31) % 256].map(|c| f64::from(c) / 255.0);
        let colors = (0..31 * 17).map(parts).map(|[r, g, b]| Rgb::new(r, g, b));
        let pixel = |color: Rgb| Pixel::new(color, 1).with_opacity(1.0 - color.blue);
        let pixels = colors.map(pixel).collect();
        Film { pixels, ..Film::new(frame, Gamma::LINEAR) }
    }

    #[test]
    fn lossless_formats_give_back_every_pixel() {
        for (format, bits) in [
            (Format::Png, None),
            (Format::Png, Some(16)),
            (Format::Ppm, None),
            (Format::Ppm, Some(16)),
            (Format::Qoi, None),
            (Format::Exr, None),
        ] {
            let depth = format.depth(bits).expect("a depth");
            let image = develop(&film(), depth);
            let bytes = encode(&film(), depth, format).expect("encodes");
            let read = image::load_from_memory(&bytes).expect("a picture");
            assert_eq!((read.width(), read.height()), (image.width, image.height));
            match image.components {
                Components::Eight(all) => assert_eq!(read.to_rgb8().into_raw(), all),
                Components::Sixteen(all) => assert_eq!(read.to_rgb16().into_raw(), all),
                Components::Linear(all) => assert_eq!(read.to_rgb32f().into_raw(), all),
            }
            let film = Film { channels: Channels::Rgba, ..film() };
            let clear = encode(&film, depth, format);
            assert_eq!(clear.is_ok(), format.holds_alpha(), "{format:?}");
            let Ok(bytes) = clear else { continue };
            let read = image::load_from_memory(&bytes).expect("a picture");
            match develop(&film, depth).components {
                Components::Eight(all) => assert_eq!(read.to_rgba8().into_raw(), all),
                Components::Sixteen(all) => assert_eq!(read.to_rgba16().into_raw(), all),
                Components::Linear(all) => assert_eq!(read.to_rgba32f().into_raw(), all),
            }
        }
    }

    #[test]
    fn lossy_formats_give_back_nearly_every_pixel() {
        let read = encode(&film(), Depth::Linear, Format::Hdr).expect("encodes");
        let read = image::load_from_memory(&read).expect("a picture").to_rgb32f();
        for (seen, color) in read.pixels().zip(film().radiances()) {
            for (a, b) in seen.0.iter().zip(color.components()) {
                assert!((f64::from(*a) - b).abs() <= color.largest() / 100.0, "{seen:?} {color}");
            }
        }
        let mut flat = film();
        flat.pixels.fill(Pixel::new(Rgb::new(0.6, 0.1, 0.03), 1));
        let read = encode(&flat, Depth::Eight, Format::Jpeg).expect("encodes");
        let read = image::load_from_memory(&read).expect("a picture").to_rgb8();
        let Components::Eight(all) = develop(&flat, Depth::Eight).components else { panic!() };
        assert_eq!(read.len(), all.len());
        assert!(read.iter().zip(&all).all(|(a, b)| a.abs_diff(*b) <= 2));
    }

    #[test]
    fn a_png_names_its_curve_and_no_date() {
        let bytes = encode(&film(), Depth::Eight, Format::Png).expect("encodes");
        let chunks: Vec<&[u8]> = bytes.windows(4).collect();
        for name in [b"sRGB", b"gAMA"] {
            assert!(chunks.contains(&name.as_slice()));
        }
        for name in [b"tIME", b"tEXt"] {
            assert!(!chunks.contains(&name.as_slice()));
        }
    }

    #[test]
    fn the_same_film_gives_the_same_bytes_and_each_is_known_as_a_picture() {
        for format in Format::ALL {
            let depth = format.depth(None).expect("a depth");
            let bytes = encode(&film(), depth, format).expect("encodes");
            assert_eq!(encode(&film(), depth, format).expect("encodes"), bytes);
            assert!(is_picture(&bytes), "{format:?}");
        }
        assert!(!is_picture(b"sphere { 0, 1 }") && !is_picture(b""));
    }

    #[test]
    fn a_format_refuses_what_it_cannot_hold() {
        assert_eq!(Format::Jpeg.depth(Some(16)), None);
        assert_eq!(Format::Exr.depth(Some(8)), None);
        for format in [Format::Jpeg, Format::Qoi, Format::Hdr] {
            assert!(encode(&film(), Depth::Sixteen, format).is_err());
        }
        for format in [Format::Png, Format::Ppm] {
            assert!(encode(&film(), Depth::Linear, format).is_err());
        }
        let film = Film { channels: Channels::Rgba, ..film() };
        for format in Format::ALL {
            let depth = format.depth(None).expect("a depth");
            assert_eq!(encode(&film, depth, format).is_ok(), format.holds_alpha(), "{format:?}");
        }
        let wide = Film::new(Frame::whole(70_000, 1), Gamma::LINEAR);
        assert!(encode(&wide, Depth::Eight, Format::Jpeg).is_err());
        assert!(Format::Jpeg.too_large(70_000, 1).is_some());
    }

    #[test]
    fn the_error_of_the_writer_is_returned() {
        struct Full;
        impl Write for Full {
            fn write(&mut self, _: &[u8]) -> Result<usize> {
                Err(ErrorKind::StorageFull.into())
            }
            fn flush(&mut self) -> Result<()> {
                Ok(())
            }
        }
        for format in Format::ALL {
            let depth = format.depth(None).expect("a depth");
            let developer = Developer::new(depth, Gamma::LINEAR, 0);
            let error = write(&film(), &developer, format, &mut Full).expect_err("full");
            assert_eq!(error.kind(), ErrorKind::StorageFull, "{format:?}");
        }
    }

    #[test]
    fn no_file_is_smaller_than_said_and_a_ppm_is_as_large() {
        for (format, bits) in Format::ALL
            .map(|format| (format, None))
            .into_iter()
            .chain([(Format::Png, Some(16)), (Format::Ppm, Some(16))])
        {
            let depth = format.depth(bits).expect("a depth");
            let size = encode(&film(), depth, format).expect("encodes").len() as u64;
            let least = format.least_bytes(depth, 31, 17);
            assert!(least <= size, "{format:?}: {least} {size}");
            assert!(format != Format::Ppm || least == size, "{least} {size}");
        }
    }

    #[test]
    fn extensions_are_known_in_any_case() {
        assert_eq!(Format::from_extension("PNG"), Some(Format::Png));
        assert_eq!(Format::from_extension("jpeg"), Some(Format::Jpeg));
        assert_eq!(Format::from_extension("gif"), None);
    }
}
