//! Films as bytes: what a render that was stopped, or is a part of another, leaves on disk.
//!
//! **Invariant:** what [`load`] returns is what [`save`] was given, to the bit, or an error: the bytes end with a sum over
//! all of them.

use std::fmt;
use std::io::{Result, Write};

use super::{Channels, Film, Pixel};
use crate::color::Gamma;
use crate::plan::{Frame, Region};

const FIRST_LINE: &str = "lucarne film 1 ";
/// Bytes of a pixel.
const PIXEL: usize = 16;

/// What films are saved for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// To go on from: the films of the passes so far.
    Checkpoint,
    /// To be merged: a finished part of a picture.
    Part,
}

impl Purpose {
    fn name(self) -> &'static str {
        match self {
            Self::Checkpoint => "checkpoint",
            Self::Part => "part",
        }
    }
}

/// Films, and what they are of.
#[derive(Debug, Clone, PartialEq)]
pub struct Saved {
    /// What they are for.
    pub purpose: Purpose,
    /// Equal for films of the same picture.
    pub key: u64,
    /// The part of the picture that is to be rendered in all.
    pub region: Region,
    /// One for each pass that has begun.
    pub films: Vec<Film>,
}

/// Why bytes are no films.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Damage {
    /// They are something else, or of another version.
    Foreign,
    /// They are incomplete, or were changed.
    Broken,
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Foreign => "it is not a film of this version of lucarne",
            Self::Broken => "it is incomplete or was changed",
        })
    }
}

/// A sum over bytes that differs if they do, but by chance.
///
/// **Source:** G. Fowler, L. Noll, K. Vo: FNV-1a, 64 bits (IETF draft-eastlake-fnv).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Digest {
    /// Adds bytes to the sum.
    pub fn add(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Returns the sum.
    pub fn get(self) -> u64 {
        self.0
    }
}

/// Text that is added.
impl fmt::Write for Digest {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.add(text.as_bytes());
        Ok(())
    }
}

/// Writes films.
///
/// ```
/// use lucarne::film::saved::{Damage, Purpose, Saved, load, save};
/// use lucarne::{color::Gamma, film::Film, plan::Frame};
///
/// let film = Film::new(Frame::whole(8, 6), Gamma::LINEAR);
/// let saved = Saved { purpose: Purpose::Part, key: 1, region: film.frame.region, films: vec![film] };
/// let mut bytes = Vec::new();
/// save(&saved, &mut bytes)?;
/// assert_eq!(load(&bytes), Ok(saved));
/// assert_eq!(load(&bytes[1..]), Err(Damage::Foreign));
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn save(saved: &Saved, out: &mut dyn Write) -> Result<()> {
    let Saved { purpose, key, region: Region { x, y, width, height }, films } = saved;
    let purpose = purpose.name();
    let mut digest = Digest::default();
    let mut write = |bytes: &[u8]| {
        digest.add(bytes);
        out.write_all(bytes)
    };
    write(
        format!("{FIRST_LINE}{purpose}\nkey {key:x}\nregion {x} {y} {width} {height}\n").as_bytes(),
    )?;
    for film in films {
        let Frame { width, height, region: Region { x, y, width: w, height: h } } = film.frame;
        let alpha = u8::from(film.channels == Channels::Rgba);
        let gamma = match film.assumed_gamma {
            Gamma::Srgb => "srgb".to_owned(),
            Gamma::Power(power) => format!("{:x}", power.to_bits()),
        };
        write(format!("film {width} {height} {x} {y} {w} {h} {alpha} {gamma}\n").as_bytes())?;
    }
    write(b"\n")?;
    for film in films {
        for row in film.rows() {
            write(&row.iter().flat_map(bytes).collect::<Vec<u8>>())?;
        }
    }
    out.write_all(&digest.get().to_le_bytes())
}

/// Reads films.
///
/// # Errors
///
/// See [`Damage`].
pub fn load(bytes: &[u8]) -> std::result::Result<Saved, Damage> {
    if !bytes.starts_with(FIRST_LINE.as_bytes()) {
        return Err(Damage::Foreign);
    }
    let (content, sum) = bytes.split_last_chunk::<8>().ok_or(Damage::Broken)?;
    let mut digest = Digest::default();
    digest.add(content);
    if digest.get() != u64::from_le_bytes(*sum) {
        return Err(Damage::Broken);
    }
    read(content).ok_or(Damage::Broken)
}

fn read(content: &[u8]) -> Option<Saved> {
    let end = content.windows(2).position(|two| two == b"\n\n")?;
    let header = std::str::from_utf8(&content[..end]).ok()?;
    let mut pixels = content[end + 2..].as_chunks::<PIXEL>().0.iter();
    let mut lines = header.lines();
    let purpose = lines.next()?.strip_prefix(FIRST_LINE)?;
    let purpose =
        [Purpose::Checkpoint, Purpose::Part].into_iter().find(|one| one.name() == purpose)?;
    let key = u64::from_str_radix(lines.next()?.strip_prefix("key ")?, 16).ok()?;
    let mut words = lines.next()?.strip_prefix("region ")?.split(' ');
    let mut number = || words.next()?.parse::<u32>().ok();
    let region = Region { x: number()?, y: number()?, width: number()?, height: number()? };
    let mut films = Vec::new();
    for line in lines {
        let mut words = line.strip_prefix("film ")?.split(' ');
        let mut number = || words.next()?.parse::<u32>().ok();
        let (width, height) = (number()?, number()?);
        let part = Region { x: number()?, y: number()?, width: number()?, height: number()? };
        let channels = Channels::with(number()? == 1);
        let assumed_gamma = match words.next()? {
            "srgb" => Gamma::Srgb,
            power => Gamma::Power(f64::from_bits(u64::from_str_radix(power, 16).ok()?)),
        };
        let count = part.width as usize * part.height as usize;
        let list: Vec<Pixel> = pixels.by_ref().take(count).map(pixel).collect();
        if list.len() < count {
            return None;
        }
        let frame = Frame { width, height, region: part };
        films.push(Film { frame, assumed_gamma, channels, pixels: list });
    }
    Some(Saved { purpose, key, region, films })
}

fn bytes(pixel: &Pixel) -> [u8; PIXEL] {
    let mut bytes = [0; PIXEL];
    for (place, component) in bytes.chunks_exact_mut(4).zip(pixel.radiance) {
        place.copy_from_slice(&component.to_le_bytes());
    }
    bytes[12..14].copy_from_slice(&pixel.samples.to_le_bytes());
    bytes[14..].copy_from_slice(&pixel.opacity.to_le_bytes());
    bytes
}

fn pixel(bytes: &[u8; PIXEL]) -> Pixel {
    let component = |i: usize| f32::from_le_bytes(std::array::from_fn(|k| bytes[4 * i + k]));
    let short = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
    Pixel { radiance: [0, 1, 2].map(component), samples: short(12), opacity: short(14) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;

    fn saved() -> (Saved, Vec<u8>) {
        let region = Region { x: 3, y: 1, width: 4, height: 2 };
        let mut film = Film::new(Frame { width: 9, height: 5, region }, Gamma::Power(2.2));
        for (i, pixel) in film.pixels.iter_mut().enumerate() {
            *pixel = Pixel::new(Rgb::gray(0.1 * i as f64), i as u32).with_opacity(0.3);
        }
        let other = Film { channels: Channels::Rgba, ..Film::new(Frame::whole(2, 2), Gamma::Srgb) };
        let saved = Saved { purpose: Purpose::Part, key: 77, region, films: vec![film, other] };
        let mut bytes = Vec::new();
        save(&saved, &mut bytes).expect("written");
        (saved, bytes)
    }

    #[test]
    fn what_is_loaded_is_what_was_saved() {
        let (saved, bytes) = saved();
        assert_eq!(load(&bytes), Ok(saved));
    }

    #[test]
    fn bytes_that_are_cut_or_changed_are_refused() {
        let (_, bytes) = saved();
        for end in 0..bytes.len() {
            assert!(load(&bytes[..end]).is_err(), "{end}");
        }
        for at in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] ^= 4;
            assert!(load(&changed).is_err(), "{at}");
        }
        assert_eq!(load(b"P6\n1 1\n255\nabc"), Err(Damage::Foreign));
    }
}
