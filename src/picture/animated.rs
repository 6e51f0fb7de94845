//! Writes animated pictures frame by frame.

use std::io::{Error, Result, Write};

use gif::{Encoder, Frame, Repeat};
use png::EncodingError;

use crate::film::{Channels, Components, Depth, Developer, Film};
use crate::plan::Region;

/// Effort with which the colours of a GIF are chosen: 1 is best, 30 fastest.
const SPEED: i32 = 10;

/// The format of an animated picture file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnimatedFormat {
    /// Animated PNG: 8 bits, lossless.
    Apng,
    /// 256 colours a frame.
    Gif,
}

impl AnimatedFormat {
    /// Returns the format of a file name extension, ignoring case.
    pub fn from_extension(extension: &str) -> Option<Self> {
        match extension.to_lowercase().as_str() {
            "apng" => Some(Self::Apng),
            "gif" => Some(Self::Gif),
            _ => None,
        }
    }
}

/// An animated picture that frames are added to.
///
/// ```
/// use lucarne::picture::animated::{Animated, AnimatedFormat};
/// use lucarne::{RenderOptions, render};
///
/// let frame = |clock| {
///     let declares = &[("clock", clock)];
///     render("background { rgb clock }", &RenderOptions { declares, ..RenderOptions::of_size(8, 6) })
/// };
/// let (mut gif, first) = (Vec::new(), frame(0.0)?);
/// let mut animated = Animated::new(AnimatedFormat::Gif, &first.film, 2, 25.0, &mut gif)?;
/// animated.add(&first.film)?;
/// animated.add(&frame(1.0)?.film)?;
/// animated.finish()?;
/// assert_eq!(&gif[..6], b"GIF89a");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Animated<W: Write>(Kind<W>);

enum Kind<W: Write> {
    Apng(png::Writer<W>),
    Gif { encoder: Encoder<W>, hundredths: u16 },
}

impl<W: Write> Animated<W> {
    /// Begins a picture of so many frames, of the size and channels of this film, with `fps` frames a second.
    ///
    /// # Errors
    ///
    /// What `out` fails with, or a size that the format cannot have.
    pub fn new(format: AnimatedFormat, film: &Film, frames: u32, fps: f64, out: W) -> Result<Self> {
        let Region { width, height, .. } = film.frame.region;
        let seconds = 1.0 / fps;
        Ok(Self(match format {
            AnimatedFormat::Apng => {
                let mut encoder = png::Encoder::new(out, width, height);
                encoder.set_color(match film.channels {
                    Channels::Rgb => png::ColorType::Rgb,
                    Channels::Rgba => png::ColorType::Rgba,
                });
                encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
                encoder.set_animated(frames, 0).map_err(failed)?;
                let thousandths = (1000.0 * seconds).round().clamp(1.0, 65_535.0) as u16;
                encoder.set_frame_delay(thousandths, 1000).map_err(failed)?;
                Kind::Apng(encoder.write_header().map_err(failed)?)
            }
            AnimatedFormat::Gif => {
                let side =
                    |side: u32| u16::try_from(side).map_err(|_| Error::other("too large for GIF"));
                let mut encoder =
                    Encoder::new(out, side(width)?, side(height)?, &[]).map_err(Error::other)?;
                encoder.set_repeat(Repeat::Infinite).map_err(Error::other)?;
                let hundredths = (100.0 * seconds).round().clamp(1.0, 65_535.0) as u16;
                Kind::Gif { encoder, hundredths }
            }
        }))
    }

    /// Adds a frame of the same size.
    pub fn add(&mut self, film: &Film) -> Result<()> {
        let developer = Developer::new(Depth::Eight, film.assumed_gamma, film.pixels.len());
        let Components::Eight(mut pixels) = developer.develop(&film.pixels, film.channels) else {
            return Ok(());
        };
        match &mut self.0 {
            Kind::Apng(writer) => writer.write_image_data(&pixels).map_err(failed),
            Kind::Gif { encoder, hundredths } => {
                let Region { width, height, .. } = film.frame.region;
                let (width, height) = (width as u16, height as u16);
                let mut frame = match film.channels {
                    Channels::Rgb => Frame::from_rgb_speed(width, height, &pixels, SPEED),
                    Channels::Rgba => Frame::from_rgba_speed(width, height, &mut pixels, SPEED),
                };
                frame.delay = *hundredths;
                encoder.write_frame(&frame).map_err(Error::other)
            }
        }
    }

    /// Ends the file.
    pub fn finish(self) -> Result<()> {
        match self.0 {
            Kind::Apng(writer) => writer.finish().map_err(failed),
            Kind::Gif { encoder, .. } => encoder.into_inner().map_err(Error::other)?.flush(),
        }
    }
}

fn failed(error: EncodingError) -> Error {
    match error {
        EncodingError::IoError(error) => error,
        error => Error::other(error),
    }
}

#[cfg(test)]
mod tests {
    use image::AnimationDecoder;
    use image::codecs::png::PngDecoder;

    use super::*;
    use crate::color::{Gamma, Rgb};
    use crate::film::Pixel;
    use crate::plan::Frame;

    fn film(gray: f64) -> Film {
        let mut film = Film::new(Frame::whole(4, 3), Gamma::LINEAR);
        film.pixels.fill(Pixel::new(Rgb::gray(gray), 1));
        film
    }

    #[test]
    fn each_frame_is_there_for_its_time() {
        for format in [AnimatedFormat::Apng, AnimatedFormat::Gif] {
            let mut bytes = Vec::new();
            let mut animated =
                Animated::new(format, &film(0.0), 3, 20.0, &mut bytes).expect("begun");
            for gray in [0.0, 0.25, 1.0] {
                animated.add(&film(gray)).expect("added");
            }
            animated.finish().expect("ended");
            // Gray and milliseconds of each frame.
            let mut frames = Vec::new();
            match format {
                AnimatedFormat::Apng => {
                    let decoder = PngDecoder::new(std::io::Cursor::new(&bytes)).expect("a PNG");
                    for frame in decoder.apng().expect("animated").into_frames() {
                        let frame = frame.expect("a frame");
                        let (time, of) = frame.delay().numer_denom_ms();
                        frames.push((frame.buffer().get_pixel(1, 1).0[0], time / of));
                    }
                }
                AnimatedFormat::Gif => {
                    let mut options = gif::DecodeOptions::new();
                    options.set_color_output(gif::ColorOutput::RGBA);
                    let mut decoder = options.read_info(&bytes[..]).expect("a GIF");
                    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
                        frames.push((frame.buffer[0], 10 * u32::from(frame.delay)));
                    }
                }
            }
            assert_eq!(frames, [(0, 50), (137, 50), (255, 50)], "{format:?}");
        }
    }
}
