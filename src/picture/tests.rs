//! What the files of pictures hold, and what is refused.

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

fn decoded(bytes: &[u8], format: Format) -> image::DynamicImage {
    let name = format!("a.{}", format.extensions()[0]);
    let kind = image::ImageFormat::from_path(name).expect("known");
    image::load_from_memory_with_format(bytes, kind).expect("a picture")
}

#[test]
fn lossless_formats_give_back_every_pixel() {
    for (format, bits) in [
        (Format::Png, None),
        (Format::Png, Some(16)),
        (Format::Ppm, None),
        (Format::Ppm, Some(16)),
        (Format::Qoi, None),
        (Format::Tga, None),
        (Format::Bmp, None),
        (Format::Exr, None),
    ] {
        let depth = format.depth(bits).expect("a depth");
        let image = develop(&film(), depth);
        let bytes = encode(&film(), depth, format).expect("encodes");
        let read = decoded(&bytes, format);
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
        let read = decoded(&bytes, format);
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
    for format in [Format::Jpeg, Format::Qoi, Format::Tga, Format::Bmp, Format::Hdr] {
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
