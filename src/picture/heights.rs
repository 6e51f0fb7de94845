//! Reads pictures as heights.
//!
//! **In:** the bytes of a picture file. **Out:** a height for each pixel, from 0 to less than 1.
//! **Invariant:** never panics, for any bytes. Memory is proportional to the number of pixels, of which there
//! are at most `MOST`; the size is checked before pixels are decoded, except for a GIF, whose decoder has a
//! limit of its own.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.5.1.5 "Height Field": for palettes, the index counts, not the colour;
//! for other colours, red is the high byte and green the low one; grey is used as it is, in 8 or 16 bits.
//! Measured: the largest number, 65535, is at height 65535/65536; a palette index counts 256 times; a colour
//! with 16 bits per component is as high as it is bright; a gamma converts components to light first if the
//! scene specifies one, and never if only the file does. POV-Ray itself reads some grey pictures with 8 bits
//! per component a step of 1/256 too low.

use std::io::Cursor;

use image::{DynamicImage, ImageBuffer, ImageFormat, ImageReader, Pixel};

use crate::color::{Gamma, Rgb};

/// Rows of heights, from top to bottom.
#[derive(Debug, Clone, PartialEq)]
pub struct Heights {
    pub width: usize,
    pub heights: Vec<f32>,
}

/// Maximum number of heights, so that they can be numbered.
const MOST: u64 = 1 << 30;

/// Returns the height for a value from 0 to 1.
pub fn height(share: f64) -> f32 {
    (share * (65535.0 / 65536.0)) as f32
}

/// Conversion of components, 0 to 1.
#[derive(Clone, Copy)]
struct Scale(Gamma);

impl Scale {
    fn grey(self, share: f64) -> f32 {
        height(self.0.linear(share).min(1.0))
    }

    /// Combines a high and a low byte: red counts 256 times as much as green.
    fn pair(self, red: f64, green: f64) -> f32 {
        let [red, green] = [red, green].map(|share| self.0.linear(share).min(1.0));
        height((256.0 * red + green) / 257.0)
    }

    /// Height of a colour by its brightness.
    fn light(self, components: [f64; 3]) -> f32 {
        let [red, green, blue] = components.map(|share| self.0.linear(share).min(1.0));
        height(Rgb { red, green, blue }.brightness())
    }
}

/// Height of a palette index.
fn numbered(number: u8) -> f32 {
    f32::from(number) / 256.0
}

fn eight(component: u8) -> f64 {
    f64::from(component) / 255.0
}

fn sixteen(component: u16) -> f64 {
    f64::from(component) / f64::from(u16::MAX)
}

/// Detects the type of a file from its first bytes; returns its name and its keyword.
pub fn kind_told(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    match image::guess_format(bytes).ok()? {
        ImageFormat::Png => Some(("PNG", "png")),
        ImageFormat::Gif => Some(("GIF", "gif")),
        ImageFormat::Jpeg => Some(("JPEG", "jpeg")),
        ImageFormat::Tiff => Some(("TIFF", "tiff")),
        ImageFormat::OpenExr => Some(("OpenEXR picture", "exr")),
        ImageFormat::Hdr => Some(("Radiance picture", "hdr")),
        _ => None,
    }
}

/// Reads a picture. The type `tga` cannot be detected from the bytes and must be declared by `is_tga`.
///
/// # Errors
/// Describes what is wrong with the bytes.
pub fn read(bytes: &[u8], is_tga: bool, gamma: Gamma) -> Result<Heights, String> {
    let format = if is_tga {
        ImageFormat::Tga
    } else {
        image::guess_format(bytes).map_err(|_| "its type is not known here".to_owned())?
    };
    let scale = Scale(gamma);
    let read = match format {
        ImageFormat::Png => png(bytes, scale)?,
        ImageFormat::Gif => gif(bytes)?,
        _ => other(bytes, format, scale)?,
    };
    let rows = read.heights.len().checked_div(read.width).unwrap_or(0);
    if read.width < 2 || rows < 2 {
        return Err(format!("it is {}×{rows} pixels, and 2×2 are the least", read.width));
    }
    Ok(read)
}

/// Reads a Fractint potential file: a GIF of twice the width, whose left half holds the high bytes and whose
/// right half the low ones.
///
/// **Source:** measured on POV-Ray 3.7, on `mtmand.pot` and random pictures; an odd width is an error there,
/// too.
///
/// # Errors
/// Describes what is wrong with the bytes.
pub fn read_potential(bytes: &[u8]) -> Result<Heights, String> {
    let Heights { width: both, heights: halves } = gif(bytes)?;
    let width = both / 2;
    if both % 2 != 0 {
        return Err(format!("it is {both} pixels wide, and has no two halves"));
    }
    let rows = halves.len().checked_div(both).unwrap_or(0);
    if width < 2 || rows < 2 {
        return Err(format!("it is {width}×{rows} heights, and 2×2 are the least"));
    }
    let row = |row: &[f32]| {
        let (high, low) = (row[..width].to_vec(), row[width..].to_vec());
        high.into_iter().zip(low).map(|(high, low)| high + low / 256.0).collect::<Vec<_>>()
    };
    Ok(Heights { width, heights: halves.chunks_exact(both).flat_map(row).collect() })
}

fn fits(width: u32, height: u32) -> Result<(), String> {
    match u64::from(width) * u64::from(height) <= MOST {
        true => Ok(()),
        false => Err(format!("it is too large: {width}×{height} pixels")),
    }
}

fn png(bytes: &[u8], scale: Scale) -> Result<Heights, String> {
    use png::{BitDepth, ColorType, Decoder, Transformations};
    let told = |error: png::DecodingError| error.to_string();
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(told)?;
    let (width, rows) = (reader.info().width, reader.info().height);
    fits(width, rows)?;
    let size = reader.output_buffer_size().ok_or("it is too large")?;
    let mut data = vec![0; size];
    let info = reader.next_frame(&mut data).map_err(told)?;
    let depth = info.bit_depth as usize;
    let samples = info.color_type.samples();
    let mut heights = Vec::with_capacity(width as usize * rows as usize);
    for row in data.chunks_exact(info.line_size).take(rows as usize) {
        for pixel in 0..width as usize {
            let sample = |i: usize| -> u16 {
                let bit = (pixel * samples + i) * depth;
                let byte = |at: usize| row.get(at).copied().unwrap_or(0);
                match info.bit_depth {
                    BitDepth::Sixteen => u16::from_be_bytes([byte(bit / 8), byte(bit / 8 + 1)]),
                    _ => {
                        let shift = 8 - depth - bit % 8;
                        u16::from(byte(bit / 8) >> shift) & ((1 << depth) - 1)
                    }
                }
            };
            let most = f64::from((1u32 << depth) - 1);
            let share = |i: usize| f64::from(sample(i)) / most;
            heights.push(match info.color_type {
                ColorType::Indexed => numbered(sample(0) as u8),
                ColorType::Grayscale | ColorType::GrayscaleAlpha => scale.grey(share(0)),
                ColorType::Rgb | ColorType::Rgba if info.bit_depth == BitDepth::Sixteen => {
                    scale.light([0, 1, 2].map(share))
                }
                ColorType::Rgb | ColorType::Rgba => scale.pair(share(0), share(1)),
            });
        }
    }
    Ok(Heights { width: width as usize, heights })
}

fn gif(bytes: &[u8]) -> Result<Heights, String> {
    let told = |error: gif::DecodingError| error.to_string();
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::Indexed);
    let mut decoder = options.read_info(bytes).map_err(told)?;
    let frame = decoder.read_next_frame().map_err(told)?;
    let frame = frame.ok_or("there is no picture in it")?;
    fits(frame.width.into(), frame.height.into())?;
    let heights = frame.buffer.iter().map(|&number| numbered(number)).collect();
    Ok(Heights { width: frame.width.into(), heights })
}

fn other(bytes: &[u8], format: ImageFormat, scale: Scale) -> Result<Heights, String> {
    let told = |error: image::ImageError| error.to_string();
    let reader = ImageReader::with_format(Cursor::new(bytes), format);
    let (width, rows) = reader.into_dimensions().map_err(told)?;
    fits(width, rows)?;
    let picture = ImageReader::with_format(Cursor::new(bytes), format).decode().map_err(told)?;
    let width = picture.width() as usize;
    let heights = match picture {
        DynamicImage::ImageLuma8(picture) => each(&picture, |[grey]| scale.grey(eight(grey))),
        DynamicImage::ImageLumaA8(picture) => each(&picture, |[grey, _]| scale.grey(eight(grey))),
        DynamicImage::ImageLuma16(picture) => each(&picture, |[grey]| scale.grey(sixteen(grey))),
        DynamicImage::ImageLumaA16(picture) => {
            each(&picture, |[grey, _]| scale.grey(sixteen(grey)))
        }
        DynamicImage::ImageRgb16(picture) => each(&picture, |rgb| scale.light(rgb.map(sixteen))),
        DynamicImage::ImageRgba16(picture) => {
            each(&picture, |[r, g, b, _]| scale.light([r, g, b].map(sixteen)))
        }
        DynamicImage::ImageRgb8(picture) => {
            each(&picture, |[red, green, _]| scale.pair(eight(red), eight(green)))
        }
        DynamicImage::ImageRgba8(picture) => {
            each(&picture, |[red, green, _, _]| scale.pair(eight(red), eight(green)))
        }
        // Light as numbers.
        others => {
            each(&others.into_rgb32f(), |[red, green, _]| scale.pair(red.into(), green.into()))
        }
    };
    Ok(Heights { width, heights })
}

/// Returns the height of each pixel.
fn each<P: Pixel, const N: usize>(
    picture: &ImageBuffer<P, Vec<P::Subpixel>>,
    height: impl Fn([P::Subpixel; N]) -> f32,
) -> Vec<f32> {
    let components = |pixel: &P| <[P::Subpixel; N]>::try_from(pixel.channels()).ok();
    picture.pixels().filter_map(components).map(height).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(picture: DynamicImage, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).expect("a picture");
        bytes.into_inner()
    }

    #[test]
    fn grey_is_its_own_height_in_8_and_16_bits() {
        let eight = image::GrayImage::from_raw(2, 2, vec![0, 10, 128, 255]).expect("a picture");
        let sixteen =
            image::ImageBuffer::from_raw(2, 2, vec![0u16, 2570, 32896, 65535]).expect("a picture");
        let wanted = [0.0, 2570.0, 32896.0, 65535.0].map(|number: f32| number / 65536.0);
        for format in [ImageFormat::Png, ImageFormat::Pnm, ImageFormat::Tga] {
            let bytes = written(eight.clone().into(), format);
            let read = read(&bytes, format == ImageFormat::Tga, Gamma::LINEAR).expect("heights");
            assert_eq!((read.width, &read.heights[..]), (2, &wanted[..]), "{format:?}");
        }
        let bytes = written(DynamicImage::ImageLuma16(sixteen), ImageFormat::Png);
        assert_eq!(read(&bytes, false, Gamma::LINEAR).expect("heights").heights, wanted);
    }

    #[test]
    fn red_is_the_high_byte_and_green_the_low_one() {
        let colors = vec![30, 128, 7, 0, 0, 9, 255, 255, 255, 1, 2, 3];
        let picture = image::RgbImage::from_raw(2, 2, colors).expect("a picture");
        for format in [ImageFormat::Png, ImageFormat::Pnm, ImageFormat::Tga] {
            let bytes = written(picture.clone().into(), format);
            let read = read(&bytes, format == ImageFormat::Tga, Gamma::LINEAR).expect("heights");
            let wanted = [7808.0, 0.0, 65535.0, 258.0].map(|number: f32| number / 65536.0);
            assert_eq!(read.heights, wanted, "{format:?}");
        }
    }

    /// Results of POV-Ray's `trace` for such pictures, in 65,536ths.
    #[test]
    fn a_gamma_that_is_named_turns_numbers_into_light() {
        let heights = |picture: DynamicImage, gamma| {
            let read = read(&written(picture, ImageFormat::Png), false, gamma).expect("heights");
            [1, 2, 3].map(|i| f64::from(read.heights[i]) * 65536.0)
        };
        let close = |found: [f64; 3], povray: [f64; 3]| {
            assert!(
                found.iter().zip(povray).all(|(a, b)| (a - b - 0.5).abs() <= 0.51),
                "{found:?}"
            );
        };
        let grey = image::ImageBuffer::from_raw(2, 2, vec![0u16, 50 * 257, 128 * 257, 254 * 257]);
        let grey: DynamicImage = DynamicImage::ImageLuma16(grey.expect("a picture"));
        close(heights(grey.clone(), Gamma::LINEAR), [12850.0, 32896.0, 65278.0]);
        close(heights(grey, Gamma::Power(2.2)), [1818.0, 14386.0, 64970.0]);
        let pairs = [0, 50, 128, 254].map(|red| [red, 100, 0]);
        let pairs = image::RgbImage::from_raw(2, 2, pairs.concat()).expect("a picture");
        close(heights(pairs.clone().into(), Gamma::LINEAR), [12900.0, 32868.0, 65124.0]);
        close(heights(pairs.into(), Gamma::Power(2.2)), [1844.0, 14362.0, 64750.0]);
        let light = [0, 50, 128, 254].map(|red: u16| [red * 257, 25700, 7]);
        let light = image::ImageBuffer::from_raw(2, 2, light.concat()).expect("a picture");
        let light = DynamicImage::ImageRgb16(light);
        close(heights(light.clone(), Gamma::LINEAR), [18954.0, 24908.0, 34525.0]);
        close(heights(light, Gamma::Power(2.2)), [5462.0, 9195.0, 24219.0]);
    }

    #[test]
    fn the_number_of_a_colour_in_its_palette_counts() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Four);
        encoder.set_palette(vec![255; 48]);
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(&[0x5f, 0x01]).expect("a picture");
        writer.finish().expect("an end");
        let wanted = [5.0, 15.0, 0.0, 1.0].map(|number: f32| number / 256.0);
        assert_eq!(read(&bytes, false, Gamma::LINEAR).expect("heights").heights, wanted);

        let mut bytes = Vec::new();
        let mut encoder = gif::Encoder::new(&mut bytes, 2, 2, &[9; 768]).expect("a header");
        let mut frame = gif::Frame { width: 2, height: 2, ..gif::Frame::default() };
        frame.buffer = vec![5u8, 200, 0, 255].into();
        encoder.write_frame(&frame).expect("a picture");
        drop(encoder);
        let wanted = [5.0, 200.0, 0.0, 255.0].map(|number: f32| number / 256.0);
        assert_eq!(read(&bytes, false, Gamma::LINEAR).expect("heights").heights, wanted);
    }

    /// POV-Ray's heights for this file are 27591, 12509, 34831 and 29963 of 65,536.
    #[test]
    fn a_potential_file_has_its_high_bytes_left_and_its_low_ones_right() {
        let mut bytes = Vec::new();
        let mut encoder = gif::Encoder::new(&mut bytes, 4, 2, &[9; 768]).expect("a header");
        let mut frame = gif::Frame { width: 4, height: 2, ..gif::Frame::default() };
        frame.buffer = vec![107u8, 48, 199, 221, 136, 117, 15, 11].into();
        encoder.write_frame(&frame).expect("a picture");
        drop(encoder);
        let wanted = [27591.0, 12509.0, 34831.0, 29963.0].map(|number: f32| number / 65536.0);
        let read = read_potential(&bytes).expect("heights");
        assert_eq!((read.width, &read.heights[..]), (2, &wanted[..]));
    }

    #[test]
    fn bytes_that_are_no_picture_are_an_error() {
        let picture = image::GrayImage::from_raw(2, 2, vec![0, 10, 128, 255]).expect("a picture");
        let bytes = written(picture.into(), ImageFormat::Png);
        for length in [0, 1, 7, 20, 40] {
            assert!(read(&bytes[..length], false, Gamma::LINEAR).is_err(), "{length}");
            assert!(read(&bytes[..length], true, Gamma::LINEAR).is_err(), "{length}");
        }
        let small = image::GrayImage::from_raw(4, 1, vec![0; 4]).expect("a picture");
        let told = read(&written(small.into(), ImageFormat::Png), false, Gamma::LINEAR);
        assert_eq!(told, Err("it is 4×1 pixels, and 2×2 are the least".to_owned()));
    }
}
