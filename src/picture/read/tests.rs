use super::*;
use crate::math::random::{Random, tries};

fn written(picture: DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).expect("a picture");
    bytes.into_inner()
}

/// A PNG file of 4×1 pixels.
fn png_file(
    color: png::ColorType,
    depth: png::BitDepth,
    data: &[u8],
    set: impl Fn(&mut png::Encoder<&mut Vec<u8>>),
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 4, 1);
    encoder.set_color(color);
    encoder.set_depth(depth);
    set(&mut encoder);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(data).expect("a picture");
    writer.finish().expect("an end");
    bytes
}

fn gif_file() -> Vec<u8> {
    let mut bytes = Vec::new();
    let palette = [255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9];
    let mut encoder = gif::Encoder::new(&mut bytes, 2, 2, &palette).expect("a header");
    let mut frame =
        gif::Frame { width: 2, height: 2, transparent: Some(2), ..gif::Frame::default() };
    frame.buffer = vec![3u8, 1, 0, 2].into();
    encoder.write_frame(&frame).expect("a picture");
    drop(encoder);
    bytes
}

fn rgba() -> DynamicImage {
    let samples = (0..4 * 3 * 4u8).map(|i| i * 5).collect();
    image::RgbaImage::from_raw(4, 3, samples).expect("a picture").into()
}

/// A file of each type and depth.
fn files() -> Vec<(ImageFormat, Vec<u8>)> {
    let picture = rgba();
    let mut files = vec![(ImageFormat::Gif, gif_file())];
    for (format, picture) in [
        (ImageFormat::Png, picture.clone()),
        (ImageFormat::Png, picture.to_luma_alpha16().into()),
        (ImageFormat::Jpeg, picture.to_rgb8().into()),
        (ImageFormat::Tga, picture.clone()),
        (ImageFormat::Tga, picture.to_luma8().into()),
        (ImageFormat::Bmp, picture.clone()),
        (ImageFormat::Pnm, picture.to_rgb8().into()),
        (ImageFormat::Pnm, picture.to_luma16().into()),
        (ImageFormat::Tiff, picture.to_rgb16().into()),
        (ImageFormat::Qoi, picture.clone()),
        (ImageFormat::Hdr, picture.to_rgb32f().into()),
        (ImageFormat::OpenExr, picture.to_rgba32f().into()),
    ] {
        files.push((format, written(picture, format)));
    }
    files
}

#[test]
fn a_file_is_known_by_its_bytes() {
    for (format, bytes) in files() {
        assert_eq!(super::format(&bytes), Some(format));
        let picture = read(&bytes).unwrap_or_else(|fault| panic!("{format:?}: {fault}"));
        let size = if format == ImageFormat::Gif { (2, 2) } else { (4, 3) };
        assert_eq!((picture.width, picture.height), size, "{format:?}");
    }
    assert_eq!(read(b"sphere { 0, 1 } plane { y, 0 } light_source { 3, 1 }"), Err(Fault::Unknown));
    assert_eq!(read(b""), Err(Fault::Unknown));
}

#[test]
fn samples_keep_their_depth() {
    let read = |picture: DynamicImage, format| read(&written(picture, format)).expect("a picture");
    let picture = rgba();
    for format in [ImageFormat::Png, ImageFormat::Tga, ImageFormat::Qoi] {
        let read = read(picture.clone(), format);
        assert_eq!(read.channels, 4);
        assert_eq!(read.samples, Samples::Eight(picture.to_rgba8().into_raw()), "{format:?}");
    }
    let grey = picture.to_luma16();
    for format in [ImageFormat::Png, ImageFormat::Pnm, ImageFormat::Tiff] {
        let read = read(grey.clone().into(), format);
        assert_eq!(read.channels, 1);
        assert_eq!(read.samples, Samples::Sixteen(grey.as_raw().clone()), "{format:?}");
    }
    let read = read(picture.to_rgba32f().into(), ImageFormat::OpenExr);
    assert!(read.channels == 4 && read.is_multiplied && read.encoding == Encoding::Light);
    assert_eq!(read.samples, Samples::Float(picture.to_rgba32f().into_raw()));
}

#[test]
fn palettes_are_kept_with_their_transparency() {
    let colors = [255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9];
    let bytes =
        png_file(png::ColorType::Indexed, png::BitDepth::Two, &[0b01_11_00_10], |encoder| {
            encoder.set_palette(colors.to_vec());
            encoder.set_trns(vec![255, 128]);
        });
    let palette = vec![[255, 0, 0, 255], [0, 255, 0, 128], [0, 0, 255, 255], [9, 9, 9, 255]];
    let indices = vec![1, 3, 0, 2];
    assert_eq!(read(&bytes).map(|p| p.samples), Ok(Samples::Indexed { palette, indices }));

    let palette = vec![[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 0], [9, 9, 9, 255]];
    let indices = vec![3, 1, 0, 2];
    assert_eq!(read(&gif_file()).map(|p| p.samples), Ok(Samples::Indexed { palette, indices }));
}

#[test]
fn grey_of_few_bits_reaches_from_black_to_white() {
    let bytes = png_file(png::ColorType::Grayscale, png::BitDepth::Two, &[0b00_01_10_11], |_| {});
    assert_eq!(read(&bytes).map(|p| p.samples), Ok(Samples::Eight(vec![0, 85, 170, 255])));
}

#[test]
fn the_gamma_of_a_png_is_what_its_chunks_say() {
    let encoding = |set: &dyn Fn(&mut png::Encoder<&mut Vec<u8>>)| {
        let bytes = png_file(png::ColorType::Grayscale, png::BitDepth::Eight, &[0; 4], set);
        read(&bytes).expect("a picture").encoding
    };
    let half = png::ScaledFloat::from_scaled(50_000);
    assert_eq!(encoding(&|_| {}), Encoding::Display);
    let stated = encoding(&|encoder| encoder.set_source_gamma(half));
    assert_eq!(stated, Encoding::Stated(Gamma::Power(2.0)));
    let both = encoding(&|encoder| {
        encoder.set_source_gamma(half);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    });
    assert_eq!(both, Encoding::Stated(Gamma::Srgb));
}

/// Results of POV-Ray 3.7.
#[test]
fn a_radiance_mantissa_is_the_middle_of_its_step() {
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 3\n".to_vec();
    bytes.extend([128, 2, 50, 128, 255, 0, 254, 128, 0, 0, 0, 0]);
    let steps = [128.5, 2.5, 50.5, 255.5, 0.5, 254.5, 0.0, 0.0, 0.0];
    let wanted = Samples::Float(steps.map(|step: f32| step / 256.0).to_vec());
    assert_eq!(read(&bytes).map(|p| p.samples), Ok(wanted));
}

#[test]
fn bytes_that_are_broken_are_a_fault_and_nothing_panics() {
    let mut random = Random(19);
    let files = files();
    for (format, bytes) in &files {
        let whole = read(bytes);
        for length in 0..bytes.len() {
            // What is behind the picture may be missing.
            let part = read(&bytes[..length]);
            assert!(part.is_err() || part == whole, "{format:?} {length}");
        }
    }
    for _ in 0..tries() {
        let mut bytes = files[random.below(files.len())].1.clone();
        for _ in 0..=random.below(3) {
            let at = random.below(bytes.len());
            bytes[at] = [0, 0xff, random.below(256) as u8][random.below(3)];
        }
        let _ = read(&bytes);
    }
}

#[test]
fn a_file_cannot_declare_more_pixels_than_it_can_hold() {
    let mut bytes = gif_file();
    // The size of the frame follows its separator and its position.
    let at = bytes.iter().rposition(|&byte| byte == b',').expect("a frame") + 5;
    bytes[at..at + 4].fill(0x7f);
    bytes[6..10].fill(0xff);
    assert_eq!(read(&bytes), Err(Fault::TooShort { width: 0x7f7f, height: 0x7f7f }));

    let tga = [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 24, 0];
    assert_eq!(read(&tga), Err(Fault::TooLarge { width: 65_535, height: 65_535 }));
    let pnm = read(b"P6 30000 20000 255\n123456789");
    assert_eq!(pnm, Err(Fault::TooShort { width: 30_000, height: 20_000 }));
}
