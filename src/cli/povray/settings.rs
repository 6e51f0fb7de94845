//! What POV-Ray's options ask for, each by the name that it has in an INI file.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.2 "Command-Line and INI-File Options", and the program, measured.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use lucarne::color::{Clearness, Gamma};
use lucarne::film::{Depth, Encoding};
use lucarne::picture::Format;
use lucarne::plan::{Antialias, Region};
use lucarne::scene::Scene;

use super::inert;
use super::streams::Streams;
use crate::cli::animation::{Edge, FrameRange, LAST};
use crate::cli::output::Output;

/// An option that cannot be understood.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Problem;

/// The options of a run, as far as they change what it does.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    pub input: Option<String>,
    pub width: u32,
    pub height: u32,
    /// First and last column, and first and last row.
    pub columns: (Option<Edge>, Option<Edge>),
    pub rows: (Option<Edge>, Option<Edge>),
    /// Whether the picture is written.
    pub writes: bool,
    pub output: Option<String>,
    pub format: Format,
    /// Bits per component.
    pub bits: u8,
    pub alpha: bool,
    /// The transfer function of the file, and whether it is grey, as asked for. A grey picture has 16 bits.
    encoding: Encoding,
    /// The version of the language before the scene's `#version`.
    pub version: Option<f64>,
    /// Includes other than the scene's own.
    pub folders: Vec<PathBuf>,
    /// A file that the scene includes first.
    pub header: Option<String>,
    pub declares: Vec<(String, f64)>,
    pub clock: f64,
    range: FrameRange,
    pub threads: Option<usize>,
    /// 0 to 11.
    pub quality: u32,
    pub verbose: bool,
    pub streams: Streams,
    /// The names of all options that were set, in small letters.
    pub names: BTreeSet<String>,
    /// Options without effect here; each gets a warning.
    pub ineffective: Vec<String>,
    /// How many INI files include the one that is read.
    pub(super) nesting: u32,
    antialias: bool,
    method: u32,
    threshold: f64,
    depth: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            input: None,
            width: 320,
            height: 240,
            columns: (None, None),
            rows: (None, None),
            writes: true,
            output: None,
            format: Format::Png,
            bits: 8,
            alpha: false,
            encoding: Encoding::default(),
            version: None,
            folders: Vec::new(),
            header: None,
            declares: Vec::new(),
            clock: 0.0,
            range: FrameRange::default(),
            threads: None,
            quality: 9,
            verbose: true,
            streams: Streams::default(),
            names: BTreeSet::new(),
            ineffective: Vec::new(),
            nesting: 0,
            antialias: false,
            method: 1,
            threshold: 0.3,
            depth: 3,
        }
    }
}

impl Settings {
    /// Sets an option by the name that it has in INI files, in any case.
    pub fn set(&mut self, name: &str, value: &str) -> Result<(), Problem> {
        let name = name.to_ascii_lowercase();
        match name.as_str() {
            "width" => self.width = pixels(value)?,
            "height" => self.height = pixels(value)?,
            "start_column" => self.columns.0 = Some(edge(value)?),
            "end_column" => self.columns.1 = Some(edge(value)?),
            "start_row" => self.rows.0 = Some(edge(value)?),
            "end_row" => self.rows.1 = Some(edge(value)?),
            "input_file_name" => self.input = Some(value.to_owned()),
            "output_to_file" => self.writes = switch(value),
            "output_file_name" => self.output = Some(value.to_owned()),
            "output_file_type" => self.format = format(value)?,
            "output_alpha" => self.alpha = switch(value),
            "file_gamma" => self.encoding.display = gamma(value)?,
            "grayscale_output" => self.encoding.is_gray = switch(value),
            "version" => self.version = Some(number(value)?.max(1.0)),
            "bits_per_color" => self.bits = if number(value)? > 8.0 { 16 } else { 8 },
            "antialias" => self.antialias = switch(value),
            "sampling_method" => self.method = whole(value)?,
            "antialias_threshold" => self.threshold = number(value)?.max(0.0),
            "antialias_depth" => self.depth = whole(value)?.clamp(1, 9),
            "include_header" => self.header = Some(value.to_owned()),
            "library_path" => self.folders.push(PathBuf::from(value)),
            "declare" => {
                // A name alone declares nothing.
                if let Some((name, value)) = value.split_once('=') {
                    self.declares.push((name.trim().to_owned(), number(value)?));
                }
            }
            "clock" => self.clock = number(value)?,
            "initial_frame" => self.range.frames.0 = frame(value)?,
            "final_frame" => self.range.frames.1 = frame(value)?,
            "initial_clock" => self.range.clocks.0 = number(value)?,
            "final_clock" => self.range.clocks.1 = number(value)?,
            "cyclic_animation" => self.range.is_cyclic = switch(value),
            "frame_step" => self.range.step = whole(value)?.max(1),
            "subset_start_frame" => self.range.subset.0 = Some(edge(value)?),
            "subset_end_frame" => self.range.subset.1 = Some(edge(value)?),
            "work_threads" => self.threads = Some(whole(value)?.max(1) as usize),
            "quality" => self.quality = whole(value)?.min(11),
            "verbose" => self.verbose = switch(value),
            name if self.streams.set(name, value) => {}
            name if inert::WITHOUT_EFFECT.contains(&name) => {}
            name if inert::INEFFECTIVE.contains(&name) => self.ineffective.push(name.to_owned()),
            // Shell commands are never run.
            name if name.ends_with("_command") => self.ineffective.push(name.to_owned()),
            name if name.ends_with("_return") => {}
            _ => return Err(Problem),
        }
        self.names.insert(name);
        Ok(())
    }

    /// Returns the antialiasing that comes nearest: both look at neighbours first. POV-Ray's first method then takes n × n
    /// samples, and its second up to 2ⁿ × 2ⁿ where they differ.
    pub fn antialias(&self) -> Antialias {
        let grid = match self.method {
            _ if !self.antialias => return Antialias::Off,
            2 => 1 << self.depth.min(5),
            _ => self.depth,
        };
        Antialias::Adaptive { threshold: self.threshold, grid }
    }

    /// Returns the frames of an animation; `None` for a still. Measured: a first frame behind the last one is the only one,
    /// and one frame is an animation if its number is above 1.
    pub fn frames(&self) -> Option<FrameRange> {
        let (first, last) = self.range.frames;
        let range = FrameRange { frames: (first, last.max(first)), ..self.range.clone() };
        (range.frames.1 > 1 || !range.is_still()).then_some(range)
    }

    /// Returns how the picture of a scene encodes light. Measured: a scene for older versions without `assumed_gamma`,
    /// and a PGM, have the scene's numbers in the file as they are, whatever gamma was asked for.
    pub fn encoding(&self, scene: &Scene) -> Encoding {
        let is_old = scene.settings.clearness == Clearness::Old;
        let display = match (is_old && scene.settings.assumed_gamma == Gamma::Srgb, self.format) {
            (true, _) => Gamma::Srgb,
            (false, Format::Ppm) if self.encoding.is_gray => scene.settings.assumed_gamma,
            _ => self.encoding.display,
        };
        Encoding { display, ..self.encoding }
    }

    /// Returns the part of the picture that is rendered; fails with `start` or `end` if that is outside of the picture.
    pub fn region(&self) -> Result<Region, &'static str> {
        let part = |(first, last): (Option<Edge>, Option<Edge>), all: u32| {
            let first = first.map_or(0, |edge| edge.first(all));
            let last = last.map_or(all, |edge| edge.end(all));
            match () {
                () if first >= all => Err("start"),
                () if last == 0 || last > all => Err("end"),
                () => Ok((first, last.max(first + 1))),
            }
        };
        let ((left, right), (top, bottom)) =
            (part(self.columns, self.width)?, part(self.rows, self.height)?);
        Ok(Region { x: left, y: top, width: right - left, height: bottom - top })
    }

    /// Returns where the picture of a scene goes: beside the scene, unless another place or name was asked for.
    pub fn output(&self, scene: &Path, frame_number: Option<u32>) -> Output {
        let asked = self.output.as_deref();
        if asked == Some("-") {
            return Output::Stdout;
        }
        let extension = self.format.extensions()[0];
        let stem = scene.file_stem().unwrap_or_default();
        let path = match asked {
            None => scene.with_file_name(stem),
            Some(folder) if folder.ends_with(['/', '\\']) || Path::new(folder).is_dir() => {
                Path::new(folder).join(stem)
            }
            Some(path) => {
                let suffix = format!(".{extension}");
                let is_there = path.to_lowercase().ends_with(&suffix);
                let end = path.len() - if is_there { suffix.len() } else { 0 };
                PathBuf::from(&path[..end])
            }
        };
        let stem = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let name = match frame_number.zip(self.frames()) {
            Some((number, range)) => range.name(&stem, number),
            None => stem,
        };
        let path = path.with_file_name(format!("{name}.{extension}"));
        Output::File { path, format: self.format }
    }

    /// Whether a picture of this format can be as it is asked for.
    pub fn is_supported(&self) -> bool {
        !self.encoding.is_gray || matches!(self.format, Format::Png | Format::Ppm)
    }

    /// Returns the numbers that a component of a pixel has in the file.
    pub fn depth(&self) -> Depth {
        let bits = if self.encoding.is_gray { 16 } else { self.bits };
        let asked = self.format.depth(Some(bits));
        asked.or(self.format.depth(None)).unwrap_or_default()
    }
}

/// Returns a number, whatever stands behind its digits.
pub fn number(value: &str) -> Result<f64, Problem> {
    let value = value.trim();
    let of_number = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E');
    let digits = value.find(|c| !of_number(c)).map_or(value, |end| &value[..end]);
    (0..=digits.len())
        .rev()
        .find_map(|end| digits[..end].parse().ok())
        .filter(|value: &f64| value.is_finite())
        .ok_or(Problem)
}

/// Returns a transfer function: a power, or that of sRGB.
fn gamma(value: &str) -> Result<Gamma, Problem> {
    if value.trim().eq_ignore_ascii_case("srgb") {
        return Ok(Gamma::Srgb);
    }
    number(value).and_then(|power| if power > 0.0 { Ok(Gamma::Power(power)) } else { Err(Problem) })
}

fn edge(value: &str) -> Result<Edge, Problem> {
    let value = number(value)?;
    Ok(match value < 1.0 {
        true => Edge::Fraction(value.max(0.0)),
        false => Edge::Number(value as u32),
    })
}

/// Returns a number without its decimals.
fn whole(value: &str) -> Result<u32, Problem> {
    Ok(number(value)? as u32)
}

fn frame(value: &str) -> Result<u32, Problem> {
    whole(value).and_then(|frame| if frame <= LAST { Ok(frame) } else { Err(Problem) })
}

fn pixels(value: &str) -> Result<u32, Problem> {
    match whole(value)? {
        0 => Err(Problem),
        pixels => Ok(pixels),
    }
}

/// Returns whether a switch is on: `on`, 1, and words that begin as `yes` and `true` do; all others are off.
pub fn switch(value: &str) -> bool {
    let value = value.trim().to_ascii_lowercase();
    matches!(value.as_str(), "on" | "1") || value.starts_with(['y', 't'])
}

fn format(value: &str) -> Result<Format, Problem> {
    match value.trim().to_ascii_uppercase().as_bytes().first() {
        Some(b'N') => Ok(Format::Png),
        Some(b'P') => Ok(Format::Ppm),
        Some(b'T' | b'C') => Ok(Format::Tga),
        Some(b'J') => Ok(Format::Jpeg),
        Some(b'B') => Ok(Format::Bmp),
        Some(b'E') => Ok(Format::Exr),
        Some(b'H') => Ok(Format::Hdr),
        _ => Err(Problem),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_cut_and_names_are_known_in_any_case() {
        let mut settings = Settings::default();
        for (name, value) in [("WIDTH", "640.9"), ("Height", "480x"), ("Declare", "A = 2.5")] {
            assert_eq!(settings.set(name, value), Ok(()), "{name}");
        }
        assert_eq!((settings.width, settings.height), (640, 480));
        for (value, is_on) in
            [("on", true), ("Yes", true), ("true", true), ("no", false), ("2", false)]
        {
            assert_eq!(settings.set("output_alpha", value), Ok(()));
            assert_eq!(settings.alpha, is_on, "{value}");
        }
        assert_eq!(settings.declares, [("A".to_owned(), 2.5)]);
        for (name, value) in [
            ("widht", "1"),
            ("width", ""),
            ("width", "0"),
            ("file_gamma", "on"),
            ("file_gamma", "0"),
            ("declare", "A=\"b\""),
            ("output_file_type", "S"),
        ] {
            assert_eq!(settings.set(name, value), Err(Problem), "{name}={value}");
        }
    }

    #[test]
    fn one_frame_is_an_animation_if_its_number_is_above_1() {
        let frames = |first, last| {
            let range = FrameRange { frames: (first, last), ..FrameRange::default() };
            Settings { range, ..Settings::default() }.frames().map(|range| range.frames)
        };
        assert_eq!([frames(1, 1), frames(0, 0), frames(1, 0)], [None; 3]);
        assert_eq!([frames(3, 3), frames(3, 1)], [Some((3, 3)); 2]);
        assert_eq!(frames(0, 1), Some((0, 1)));
    }

    #[test]
    fn parts_begin_and_end_at_pixels_or_fractions() {
        let edge = |value| edge(value).expect("an edge");
        assert_eq!((edge("4").first(10), edge("8").end(10)), (3, 8));
        assert_eq!((edge("0.3").first(10), edge("0.5").end(10)), (3, 5));
    }

    #[test]
    fn antialiasing_is_off_unless_it_is_asked_for() {
        let mut settings = Settings::default();
        assert_eq!(settings.antialias(), Antialias::Off);
        settings.set("antialias", "on").expect("known");
        assert_eq!(settings.antialias(), Antialias::Adaptive { threshold: 0.3, grid: 3 });
        settings.set("sampling_method", "2").expect("known");
        settings.set("antialias_threshold", "0.1").expect("known");
        assert_eq!(settings.antialias(), Antialias::Adaptive { threshold: 0.1, grid: 8 });
    }
}
