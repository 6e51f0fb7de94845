//! Picture files; the only module that uses `image` and `png`.
//!
//! **In:** an [`Image`]. **Out:** the bytes of a file. **Invariant:** the bytes depend only on the image: no
//! date, no name, no thread order.

mod exr;
pub mod heights;
pub mod read;
mod tiff;

use std::io::Cursor;

use image::{ExtendedColorType, ImageEncoder};

use crate::film::{Depth, Image, Pixels};

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

/// Encodes an image. Fails if the format cannot hold it: it is too large, or of another depth.
pub fn encode(image: &Image, format: Format) -> Result<Vec<u8>, String> {
    let (width, height) = (image.width, image.height);
    let with = |encoder: &mut dyn FnMut(&[u8], ExtendedColorType) -> image::ImageResult<()>| {
        let result = match &image.pixels {
            Pixels::Eight(pixels) => encoder(pixels.as_flattened(), ExtendedColorType::Rgb8),
            Pixels::Linear(pixels) => {
                let bytes: Vec<u8> =
                    pixels.as_flattened().iter().flat_map(|c| c.to_ne_bytes()).collect();
                encoder(&bytes, ExtendedColorType::Rgb32F)
            }
            Pixels::Sixteen(_) => return Err(format!("{format:?} cannot hold 16 bits")),
        };
        result.map_err(|error| error.to_string())
    };
    let mut out = Vec::new();
    match format {
        Format::Png => png(image, &mut out)?,
        Format::Ppm => ppm(image, &mut out)?,
        Format::Jpeg => with(&mut |bytes, color| {
            let encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut out, 92);
            encoder.write_image(bytes, width, height, color)
        })?,
        Format::Qoi => with(&mut |bytes, color| {
            image::codecs::qoi::QoiEncoder::new(&mut out).write_image(bytes, width, height, color)
        })?,
        Format::Hdr => with(&mut |bytes, color| {
            image::codecs::hdr::HdrEncoder::new(&mut out).write_image(bytes, width, height, color)
        })?,
        Format::Exr => with(&mut |bytes, color| {
            image::codecs::openexr::OpenExrEncoder::new(Cursor::new(&mut out))
                .write_image(bytes, width, height, color)
        })?,
    }
    Ok(out)
}

/// Encodes with `png` directly, as `image` writes no sRGB and gAMA chunks.
fn png(image: &Image, out: &mut Vec<u8>) -> Result<(), String> {
    let (depth, bytes) = match &image.pixels {
        Pixels::Eight(pixels) => (png::BitDepth::Eight, pixels.as_flattened().to_vec()),
        Pixels::Sixteen(pixels) => (png::BitDepth::Sixteen, big_endian(pixels)),
        Pixels::Linear(_) => return Err("PNG cannot hold linear light".to_owned()),
    };
    let mut encoder = png::Encoder::new(out, image.width, image.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(depth);
    // A sixth to a third larger than by the usual compression, which takes as long as tracing a simple scene.
    encoder.set_compression(png::Compression::Fast);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    // The curve's nearest power, for readers that know no sRGB.
    encoder.set_source_gamma(png::ScaledFloat::from_scaled(45_455));
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(&bytes)?;
        writer.finish()
    });
    written.map_err(|error| error.to_string())
}

/// Encodes a binary PPM. **Source:** the Netpbm manual, `ppm`.
fn ppm(image: &Image, out: &mut Vec<u8>) -> Result<(), String> {
    let (last, bytes) = match &image.pixels {
        Pixels::Eight(pixels) => (255, pixels.as_flattened().to_vec()),
        Pixels::Sixteen(pixels) => (65_535, big_endian(pixels)),
        Pixels::Linear(_) => return Err("PPM cannot hold linear light".to_owned()),
    };
    out.extend_from_slice(ppm_header(image.width, image.height, last).as_bytes());
    out.extend_from_slice(&bytes);
    Ok(())
}

fn ppm_header(width: u32, height: u32, last: u32) -> String {
    format!("P6\n{width} {height}\n{last}\n")
}

fn big_endian(pixels: &[[u16; 3]]) -> Vec<u8> {
    pixels.as_flattened().iter().flat_map(|c| c.to_be_bytes()).collect()
}

/// Returns whether a file that starts with these bytes is a picture, in one of our formats or another.
pub fn is_picture(start: &[u8]) -> bool {
    image::guess_format(start).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(depth: Depth) -> Image {
        let (width, height) = (31, 17);
        let values = (0..width * height).map(|i| [i % 256, (i * 7) % 256, (i * 31) % 256]);
        let pixels = match depth {
            Depth::Eight => Pixels::Eight(values.map(|p| p.map(|c| c as u8)).collect()),
            Depth::Sixteen => Pixels::Sixteen(values.map(|p| p.map(|c| c as u16 * 257)).collect()),
            Depth::Linear => Pixels::Linear(values.map(|p| p.map(|c| c as f32 / 16.0)).collect()),
        };
        Image { width, height, pixels }
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
            let image = image(format.depth(bits).expect("a depth"));
            let bytes = encode(&image, format).expect("encodes");
            let read = image::load_from_memory(&bytes).expect("a picture");
            assert_eq!((read.width(), read.height()), (image.width, image.height));
            match &image.pixels {
                Pixels::Eight(p) => assert_eq!(read.to_rgb8().as_raw(), p.as_flattened()),
                Pixels::Sixteen(p) => assert_eq!(read.to_rgb16().as_raw(), p.as_flattened()),
                Pixels::Linear(p) => assert_eq!(read.to_rgb32f().as_raw(), p.as_flattened()),
            }
        }
    }

    #[test]
    fn lossy_formats_give_back_nearly_every_pixel() {
        let linear = image(Depth::Linear);
        let read = encode(&linear, Format::Hdr).expect("encodes");
        let read = image::load_from_memory(&read).expect("a picture").to_rgb32f();
        let Pixels::Linear(pixels) = &linear.pixels else { panic!("not linear") };
        for (seen, true_pixel) in read.pixels().zip(pixels) {
            let largest = true_pixel.iter().fold(0f32, |a, &b| a.max(b));
            for (a, b) in seen.0.iter().zip(true_pixel) {
                assert!((a - b).abs() <= largest / 100.0, "{seen:?} {true_pixel:?}");
            }
        }
        let flat =
            Image { width: 16, height: 16, pixels: Pixels::Eight(vec![[200, 100, 50]; 256]) };
        let read = encode(&flat, Format::Jpeg).expect("encodes");
        let read = image::load_from_memory(&read).expect("a picture").to_rgb8();
        for pixel in read.pixels() {
            assert!(pixel.0.iter().zip([200u8, 100, 50]).all(|(a, b)| a.abs_diff(b) <= 2));
        }
    }

    #[test]
    fn a_png_names_its_curve_and_no_date() {
        let bytes = encode(&image(Depth::Eight), Format::Png).expect("encodes");
        let chunks: Vec<&[u8]> = bytes.windows(4).collect();
        for name in [b"sRGB", b"gAMA"] {
            assert!(chunks.contains(&name.as_slice()));
        }
        for name in [b"tIME", b"tEXt"] {
            assert!(!chunks.contains(&name.as_slice()));
        }
    }

    #[test]
    fn the_same_image_gives_the_same_bytes() {
        for format in Format::ALL {
            let image = image(format.depth(None).expect("a depth"));
            assert_eq!(encode(&image, format), encode(&image, format));
        }
    }

    #[test]
    fn each_file_is_known_as_a_picture_and_a_scene_is_not() {
        for format in Format::ALL {
            let image = image(format.depth(None).expect("a depth"));
            assert!(is_picture(&encode(&image, format).expect("encodes")), "{format:?}");
        }
        assert!(!is_picture(b"sphere { 0, 1 }") && !is_picture(b""));
    }

    #[test]
    fn a_format_refuses_what_it_cannot_hold() {
        assert_eq!(Format::Jpeg.depth(Some(16)), None);
        assert_eq!(Format::Exr.depth(Some(8)), None);
        for format in [Format::Jpeg, Format::Qoi, Format::Hdr] {
            assert!(encode(&image(Depth::Sixteen), format).is_err());
        }
        let wide = Image { width: 70_000, height: 1, pixels: Pixels::Eight(vec![[0; 3]; 70_000]) };
        assert!(encode(&wide, Format::Jpeg).is_err());
        assert!(Format::Jpeg.too_large(wide.width, wide.height).is_some());
    }

    #[test]
    fn no_file_is_smaller_than_said_and_a_ppm_is_as_large() {
        for (format, bits) in Format::ALL
            .map(|format| (format, None))
            .into_iter()
            .chain([(Format::Png, Some(16)), (Format::Ppm, Some(16))])
        {
            let depth = format.depth(bits).expect("a depth");
            let image = image(depth);
            let size = encode(&image, format).expect("encodes").len() as u64;
            let least = format.least_bytes(depth, image.width, image.height);
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
