//! Pictures read as heights.
//!
//! **In:** the bytes of a picture file. **Out:** a height for each pixel, 0 to less than 1. **Invariant:** no
//! bytes make it panic, or take more memory than the picture.
//!
//! **Source:** POV-Ray 3.7 manual, 3.4.5.1.5 "Height Field": the number of a colour in its palette counts, and
//! not the colour; of other colours red is the high byte and green the low one; grey is itself, in 8 or 16
//! bits. That the greatest number, 65535, is 65535/65536 high, and a colour of a palette 256 times its number,
//! was measured. Of grey pictures of 8 bits POV-Ray itself reads some a step of 1/256 too low.

use std::io::Cursor;

use image::{DynamicImage, ImageFormat, ImageReader};

/// Rows of heights, the uppermost first.
#[derive(Debug, Clone, PartialEq)]
pub struct Heights {
    pub width: usize,
    pub heights: Vec<f32>,
}

/// More heights than can be numbered are none.
const MOST: u64 = 1 << 30;

/// The height of a number of 16 bits; exact.
fn height(number: u16) -> f32 {
    f32::from(number) / 65536.0
}

fn of_pair(high: u8, low: u8) -> f32 {
    height(u16::from(high) << 8 | u16::from(low))
}

/// Reads a picture; one of type `tga` tells so by nothing but the word for it.
///
/// # Errors
/// What is wrong with the bytes.
pub fn read(bytes: &[u8], is_tga: bool) -> Result<Heights, String> {
    let format = if is_tga {
        ImageFormat::Tga
    } else {
        image::guess_format(bytes).map_err(|_| "its type is not known here".to_owned())?
    };
    let read = match format {
        ImageFormat::Png => png(bytes)?,
        ImageFormat::Gif => gif(bytes)?,
        _ => other(bytes, format)?,
    };
    let rows = read.heights.len().checked_div(read.width).unwrap_or(0);
    if read.width < 2 || rows < 2 {
        return Err(format!("it is {}×{rows} pixels, and 2×2 are the least", read.width));
    }
    Ok(read)
}

fn fits(width: u32, height: u32) -> Result<(), String> {
    match u64::from(width) * u64::from(height) <= MOST {
        true => Ok(()),
        false => Err(format!("it is too large: {width}×{height} pixels")),
    }
}

fn png(bytes: &[u8]) -> Result<Heights, String> {
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
            let full = |number: u16| match info.bit_depth {
                BitDepth::Sixteen => number,
                _ => (u32::from(number) * 65535 / ((1 << depth) - 1)) as u16,
            };
            heights.push(match info.color_type {
                ColorType::Indexed => height(sample(0) << 8),
                ColorType::Grayscale | ColorType::GrayscaleAlpha => height(full(sample(0))),
                ColorType::Rgb | ColorType::Rgba if info.bit_depth == BitDepth::Sixteen => {
                    height(sample(0))
                }
                ColorType::Rgb | ColorType::Rgba => of_pair(sample(0) as u8, sample(1) as u8),
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
    let heights = frame.buffer.iter().map(|&number| of_pair(number, 0)).collect();
    Ok(Heights { width: frame.width.into(), heights })
}

fn other(bytes: &[u8], format: ImageFormat) -> Result<Heights, String> {
    let told = |error: image::ImageError| error.to_string();
    let reader = ImageReader::with_format(Cursor::new(bytes), format);
    let (width, rows) = reader.into_dimensions().map_err(told)?;
    fits(width, rows)?;
    let picture = ImageReader::with_format(Cursor::new(bytes), format).decode().map_err(told)?;
    let width = picture.width() as usize;
    let heights = match picture {
        DynamicImage::ImageLuma8(picture) => {
            picture.pixels().map(|p| of_pair(p.0[0], p.0[0])).collect()
        }
        DynamicImage::ImageLumaA8(picture) => {
            picture.pixels().map(|p| of_pair(p.0[0], p.0[0])).collect()
        }
        DynamicImage::ImageLuma16(picture) => picture.pixels().map(|p| height(p.0[0])).collect(),
        DynamicImage::ImageLumaA16(picture) => picture.pixels().map(|p| height(p.0[0])).collect(),
        DynamicImage::ImageRgb8(picture) => {
            picture.pixels().map(|p| of_pair(p.0[0], p.0[1])).collect()
        }
        DynamicImage::ImageRgba8(picture) => {
            picture.pixels().map(|p| of_pair(p.0[0], p.0[1])).collect()
        }
        // Light as a number: no more than 16 bits of it are asked for, as of all others.
        others => {
            let grey = others.into_luma16();
            grey.pixels().map(|p| height(p.0[0])).collect()
        }
    };
    Ok(Heights { width, heights })
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
            let read = read(&bytes, format == ImageFormat::Tga).expect("heights");
            assert_eq!((read.width, &read.heights[..]), (2, &wanted[..]), "{format:?}");
        }
        let bytes = written(DynamicImage::ImageLuma16(sixteen), ImageFormat::Png);
        assert_eq!(read(&bytes, false).expect("heights").heights, wanted);
    }

    #[test]
    fn red_is_the_high_byte_and_green_the_low_one() {
        let colors = vec![30, 128, 7, 0, 0, 9, 255, 255, 255, 1, 2, 3];
        let picture = image::RgbImage::from_raw(2, 2, colors).expect("a picture");
        for format in [ImageFormat::Png, ImageFormat::Pnm, ImageFormat::Tga] {
            let bytes = written(picture.clone().into(), format);
            let read = read(&bytes, format == ImageFormat::Tga).expect("heights");
            let wanted = [7808.0, 0.0, 65535.0, 258.0].map(|number: f32| number / 65536.0);
            assert_eq!(read.heights, wanted, "{format:?}");
        }
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
        assert_eq!(read(&bytes, false).expect("heights").heights, wanted);

        let mut bytes = Vec::new();
        let mut encoder = gif::Encoder::new(&mut bytes, 2, 2, &[9; 768]).expect("a header");
        let mut frame = gif::Frame { width: 2, height: 2, ..gif::Frame::default() };
        frame.buffer = vec![5u8, 200, 0, 255].into();
        encoder.write_frame(&frame).expect("a picture");
        drop(encoder);
        let wanted = [5.0, 200.0, 0.0, 255.0].map(|number: f32| number / 256.0);
        assert_eq!(read(&bytes, false).expect("heights").heights, wanted);
    }

    #[test]
    fn bytes_that_are_no_picture_are_an_error() {
        let picture = image::GrayImage::from_raw(2, 2, vec![0, 10, 128, 255]).expect("a picture");
        let bytes = written(picture.into(), ImageFormat::Png);
        for length in [0, 1, 7, 20, 40] {
            assert!(read(&bytes[..length], false).is_err(), "{length}");
            assert!(read(&bytes[..length], true).is_err(), "{length}");
        }
        let small = image::GrayImage::from_raw(4, 1, vec![0; 4]).expect("a picture");
        let told = read(&written(small.into(), ImageFormat::Png), false);
        assert_eq!(told, Err("it is 4×1 pixels, and 2×2 are the least".to_owned()));
    }
}
