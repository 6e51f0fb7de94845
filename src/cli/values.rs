//! Parses the values of flags.
//!
//! **In:** the text of one value. **Out:** the value, or a sentence that says what was expected.

use std::ops::RangeInclusive;
use std::time::SystemTime;

use clap::ValueEnum;
use lucarne::accuracy::{KNOBS, Metric};
use lucarne::diagnostic::Code;
use lucarne::diagnostic::suggest::closest;
use lucarne::film::Channel;
use lucarne::plan::{Antialias, Region, Samples};
use lucarne::vocabulary::Word;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Limit {
    LoopTurns,
    MacroDepth,
    IncludeDepth,
    Nesting,
    Objects,
    Memory,
    String,
    Pixels,
}

/// Selection of warnings for `--allow`, `--warn` and `--deny`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Warnings {
    All,
    Of(Code),
}

pub fn warning(text: &str) -> Result<Warnings, String> {
    if text == "all" {
        return Ok(Warnings::All);
    }
    match Code::from_name(text) {
        Some(code) if code.may_warn() => Ok(Warnings::Of(code)),
        Some(_) => Err(format!("it is never a warning; the codes of warnings are:{}", levelled())),
        None => {
            let names = Code::ALL.iter().filter(|code| code.may_warn()).map(|code| code.name());
            Err(match closest(text, names) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("expected `all`, or the code of a warning:{}", levelled()),
            })
        }
    }
}

/// Returns the codes that have a level, in alphabetical order, in indented lines of at most 78 columns.
fn levelled() -> String {
    let mut names: Vec<&str> =
        Code::ALL.iter().filter(|code| code.may_warn()).map(|code| code.name()).collect();
    names.sort_unstable();
    let (mut list, mut column) = (String::new(), usize::MAX);
    for name in names {
        if column.saturating_add(name.len() + 1) > 78 {
            list.push_str("\n   ");
            column = 3;
        }
        list.push(' ');
        list.push_str(name);
        column += name.len() + 1;
    }
    list
}

pub fn size(text: &str) -> Result<(u32, u32), String> {
    let wrong =
        || "expected WIDTHxHEIGHT in pixels, such as 640x480, each from 1 to 1000000".to_owned();
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(wrong)?;
    let side = |text: &str| match text.trim().parse::<u32>() {
        Ok(side @ 1..=1_000_000) => Ok(side),
        _ => Err(wrong()),
    };
    Ok((side(width)?, side(height)?))
}

pub fn region(text: &str) -> Result<Region, String> {
    let wrong = || "expected LEFT,TOP,WIDTH,HEIGHT in pixels, such as 0,0,320,240".to_owned();
    let numbers: Vec<u32> = text
        .split(',')
        .map(|part| part.trim().parse().map_err(|_| wrong()))
        .collect::<Result<_, _>>()?;
    match numbers[..] {
        [x, y, width @ (1..), height @ (1..)] => Ok(Region { x, y, width, height }),
        _ => Err(wrong()),
    }
}

pub fn antialias(text: &str) -> Result<Antialias, String> {
    // Also accepts the notation of tables: `3×3`.
    let side = text.split_once(['x', '×']).filter(|(a, b)| a == b).map_or(text, |(side, _)| side);
    match (text, side.parse::<u32>()) {
        ("off", _) | (_, Ok(1)) => Ok(Antialias::Off),
        ("adaptive", _) => Ok(Antialias::default()),
        (_, Ok(n @ 2..=64)) => Ok(Antialias::Grid(n)),
        _ => adaptive(text).ok_or_else(|| {
            "expected `off`, `adaptive`, `adaptive:0.02:8`, or a number from 1 to 64".to_owned()
        }),
    }
}

fn adaptive(text: &str) -> Option<Antialias> {
    let (threshold, grid) = adaptive_to(text, 2..=64)?;
    Some(Antialias::Adaptive { threshold, grid })
}

/// Parses `adaptive:THRESHOLD:N`.
fn adaptive_to(text: &str, counts: RangeInclusive<u32>) -> Option<(f64, u32)> {
    let (threshold, count) = text.strip_prefix("adaptive:")?.split_once(':')?;
    let threshold = threshold.parse().ok().filter(|t: &f64| (0.0..=1.0).contains(t))?;
    Some((threshold, count.parse().ok().filter(|n| counts.contains(n))?))
}

/// Parses the samples of a light or a lens.
pub fn samples(text: &str) -> Result<Samples, String> {
    const COUNTS: RangeInclusive<u32> = 1..=65_536;
    let adaptive = || adaptive_to(text, COUNTS);
    match (text, text.parse::<u32>()) {
        ("scene", _) => Ok(Samples::Scene),
        (_, Ok(count)) if COUNTS.contains(&count) => Ok(Samples::Fixed(count)),
        _ => match adaptive() {
            Some((threshold, most)) => Ok(Samples::Adaptive { threshold, most }),
            None => {
                Err("expected `scene`, `adaptive:0.05:64`, or a number from 1 to 65536".to_owned())
            }
        },
    }
}

/// Parses a number, or a fraction such as `1/255`.
fn fraction(text: &str) -> Option<f64> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    match text.split_once('/') {
        Some((parts, of)) => Some(number(parts)? / number(of)?),
        None => number(text),
    }
}

/// Parses a ray weight from 0 to 1, such as `0.004` or `1/255`.
pub fn weight(text: &str) -> Result<f64, String> {
    let weight = fraction(text).filter(|weight| (0.0..=1.0).contains(weight));
    weight.ok_or_else(|| "expected a number from 0 to 1, such as 0.01 or 1/255".to_owned())
}

/// Parses a recursion depth or an iteration count, at least 1.
pub fn depth(text: &str) -> Result<u32, String> {
    let depth = text.parse().ok().filter(|&depth| depth > 0);
    depth.ok_or_else(|| format!("expected a whole number from 1 to {}", u32::MAX))
}

pub fn seed(text: &str) -> Result<u64, String> {
    let seed = text.parse().ok();
    seed.ok_or_else(|| format!("expected a whole number from 0 to {}", u64::MAX))
}

pub fn threads(text: &str) -> Result<u16, String> {
    let threads = text.parse().ok().filter(|threads| (1..=1024).contains(threads));
    threads.ok_or_else(|| "expected a whole number from 1 to 1024".to_owned())
}

pub fn tolerance(text: &str) -> Result<f64, String> {
    let tolerance = fraction(text).filter(|tolerance| (0.0..=0.1).contains(tolerance));
    tolerance.ok_or_else(|| "expected a number from 0 to 0.1, such as 1e-6".to_owned())
}

/// Parses an error bound above 0 and at most 1: `0.01`, `1%` or `2/255`.
pub fn error(text: &str) -> Result<f64, String> {
    let error = match text.trim().strip_suffix('%') {
        Some(percent) => percent.trim().parse().ok().map(|percent: f64| percent / 100.0),
        None => fraction(text),
    };
    let error = error.filter(|&error| error > 0.0 && error <= 1.0);
    error.ok_or_else(|| {
        "expected an error above 0 and at most 1, such as 0.01, 1% or 2/255".to_owned()
    })
}

/// Parses a duration and returns it in seconds: `90`, `90s`, `1.5m`, `2h` or `500ms`.
pub fn seconds(text: &str) -> Result<f64, String> {
    let units = [("ms", 0.001), ("s", 1.0), ("m", 60.0), ("h", 3600.0)];
    let (number, unit) = units
        .iter()
        .find_map(|(name, unit)| Some((text.strip_suffix(name)?, *unit)))
        .unwrap_or((text, 1.0));
    let seconds = number.parse().ok().map(|n: f64| n * unit);
    let seconds = seconds.filter(|s| s.is_finite() && *s > 0.0 && *s <= 1e9);
    seconds.ok_or_else(|| {
        "expected a time, such as 500ms, 60s or 5m; a number alone is seconds".to_owned()
    })
}

/// Parses a size of memory and returns it in bytes: `2G`, `1.5 GiB`, `500M` or `500MB`. Units are powers of 1024.
pub fn bytes(text: &str) -> Result<u64, String> {
    let lower = text.trim().to_ascii_lowercase();
    let plain = lower.trim_end_matches('b').trim_end_matches('i');
    let units = [("k", 10), ("m", 20), ("g", 30), ("t", 40)];
    let size = units.iter().find_map(|(name, power)| {
        let number: f64 = plain.strip_suffix(name)?.trim().parse().ok()?;
        Some(number * f64::from(1 << (power / 2)) * f64::from(1 << (power / 2)))
    });
    let size = size.filter(|size| size.is_finite() && *size >= 1.0 && *size < 1e18);
    let size =
        size.ok_or_else(|| "expected a size with its unit, such as 500M or 2G".to_owned())?;
    Ok(size as u64)
}

pub fn knob(text: &str) -> Result<&'static str, String> {
    // `adc_bailout`, as spelled in scenes, is `adc-bailout` here.
    let asked = text.trim().replace('_', "-");
    let mut names = KNOBS.iter().map(|knob| knob.name);
    names.find(|&name| name == asked).ok_or_else(|| {
        let names: Vec<_> = KNOBS.iter().map(|knob| knob.name).collect();
        format!("the knobs are {}", names.join(", "))
    })
}

pub fn declare(text: &str) -> Result<(String, f64), String> {
    let (name, value) =
        text.split_once('=').ok_or("expected NAME=VALUE, such as Radius=1.5".to_owned())?;
    let (name, value) = (name.trim(), value.trim());
    let letter = |c: char| c.is_ascii_alphabetic() || c == '_';
    if !name.starts_with(letter) || !name.chars().all(|c| letter(c) || c.is_ascii_digit()) {
        return Err(format!("`{name}` is not a name: letters, digits and `_`, no digit first"));
    }
    // `#declare` rejects these, too; only `clock` can be set from outside.
    if name != "clock" && Word::from_name(name).is_some() {
        return Err(format!("`{name}` is a word of the language, and cannot be declared"));
    }
    let number = match value {
        "true" | "yes" | "on" => Some(1.0),
        "false" | "no" | "off" => Some(0.0),
        // Rust also reads `inf` and `nan`.
        _ => value.parse().ok().filter(|number: &f64| number.is_finite()),
    };
    Ok((name.to_owned(), number.ok_or_else(|| format!("`{value}` is not a number"))?))
}

pub fn limit(text: &str) -> Result<(Limit, u64), String> {
    let (name, value) =
        text.split_once('=').ok_or("expected NAME=N, such as objects=10000000".to_owned())?;
    let limit = Limit::from_str(name, true).map_err(|_| {
        "the limits are loop-turns, macro-depth, include-depth, nesting, objects, memory, string, pixels"
            .to_owned()
    })?;
    let number = value.trim().parse().map_err(|_| format!("`{value}` is not a whole number"))?;
    Ok((limit, number))
}

/// Error metric, as named on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum MetricArgument {
    /// Root mean square over pixels and color channels
    #[default]
    Rmse,
    /// 99th percentile: exceeded by one pixel in a hundred
    P99,
    /// Fraction of pixels with an error above 2/255
    Bad,
}

impl From<MetricArgument> for Metric {
    fn from(metric: MetricArgument) -> Self {
        match metric {
            MetricArgument::Rmse => Self::Rmse,
            MetricArgument::P99 => Self::P99,
            MetricArgument::Bad => Self::Bad,
        }
    }
}

/// A channel of first surfaces, as named on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ChannelArgument {
    /// Distance from the start of the ray (channel Z); infinite where there is no surface
    Depth,
    /// Unit normal by which the surface is lit, in the axes of the scene (normal.X, normal.Y, normal.Z)
    Normal,
    /// Colour of the pigment in linear light, before any light falls on it (albedo.R, albedo.G, albedo.B)
    Albedo,
    /// Number of the object or light at the top level of the scene, from 1 (object); 0 where there is no surface
    Object,
}

impl From<ChannelArgument> for Channel {
    fn from(channel: ChannelArgument) -> Self {
        match channel {
            ChannelArgument::Depth => Self::Depth,
            ChannelArgument::Normal => Self::Normal,
            ChannelArgument::Albedo => Self::Albedo,
            ChannelArgument::Object => Self::Object,
        }
    }
}

/// Returns the current time in days since the start of the year 2000.
pub fn now() -> f64 {
    const SECONDS_TO_2000: f64 = 946_684_800.0;
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    (now.as_secs_f64() - SECONDS_TO_2000) / 86400.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_regions_are_read() {
        assert_eq!(size("64x48"), Ok((64, 48)));
        for wrong in ["0x1", "64", "64x", "x", "-1x4", "1e3x3", "2000000x1"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
        assert_eq!(region("1, 2,3,4"), Ok(Region { x: 1, y: 2, width: 3, height: 4 }));
        for wrong in ["1,2,3", "1,2,0,4", "1,2,3,4,5", "a,b,c,d"] {
            assert!(region(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn antialias_is_off_a_number_or_adaptive() {
        assert_eq!(antialias("off"), Ok(Antialias::Off));
        assert_eq!(antialias("1"), Ok(Antialias::Off));
        assert_eq!(antialias("3"), Ok(Antialias::Grid(3)));
        assert_eq!(antialias("adaptive"), Ok(Antialias::default()));
        let fine = Antialias::Adaptive { threshold: 0.02, grid: 6 };
        assert_eq!(antialias("adaptive:0.02:6"), Ok(fine));
        for wrong in
            ["adaptive:", "adaptive:0.02", "adaptive:2:6", "adaptive:0.1:1", "adaptive:x:3"]
        {
            assert!(antialias(wrong).is_err(), "{wrong}");
        }
        assert!(antialias("0").is_err() && antialias("on").is_err() && antialias("65").is_err());
    }

    #[test]
    fn samples_are_the_scenes_a_number_or_adaptive() {
        assert_eq!(samples("scene"), Ok(Samples::Scene));
        assert_eq!(samples("64"), Ok(Samples::Fixed(64)));
        let fine = Samples::Adaptive { threshold: 0.02, most: 256 };
        assert_eq!(samples("adaptive:0.02:256"), Ok(fine));
        for wrong in ["", "0", "-4", "65537", "adaptive", "adaptive:2:6", "adaptive:0.1:0", "off"] {
            assert!(samples(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn times_have_units_and_errors_are_parts_of_white() {
        let times = [("90", 90.0), ("90s", 90.0), ("1.5m", 90.0), ("2h", 7200.0), ("500ms", 0.5)];
        for (text, expected) in times {
            assert_eq!(seconds(text), Ok(expected));
        }
        for wrong in ["", "s", "-1s", "0", "inf", "nan", "1e99", "3d"] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
        let sizes = [("2G", 2 << 30), ("1.5 GiB", 3 << 29), ("500mb", 500 << 20), ("4k", 4096)];
        for (text, expected) in sizes {
            assert_eq!(bytes(text), Ok(expected));
        }
        for wrong in ["", "2", "G", "-1G", "nanG", "1e30G", "0M", "2X", "infT"] {
            assert!(bytes(wrong).is_err(), "{wrong}");
        }
        assert_eq!(error("0.01"), Ok(0.01));
        assert_eq!((error("1%"), error("1.5 %")), (Ok(0.01), Ok(0.015)));
        assert_eq!((error("2/255"), error("1 / 4")), (Ok(2.0 / 255.0), Ok(0.25)));
        for wrong in
            ["0", "2", "x", "", "%", "0%", "101%", "-1%", "1/0", "0/0", "/255", "2/", "3/2", "1/2%"]
        {
            assert!(error(wrong).is_err(), "{wrong}");
        }
        assert_eq!(weight("0"), Ok(0.0));
        assert_eq!((weight("1/64"), weight("1/255")), (Ok(0.015625), Ok(1.0 / 255.0)));
        for wrong in ["-1", "nan", "1/0", "0/0", "2/1", "1/", "/2", "1/2/3"] {
            assert!(weight(wrong).is_err(), "{wrong}");
        }
        assert_eq!((depth("1"), depth("4294967295")), (Ok(1), Ok(u32::MAX)));
        assert_eq!((threads("1"), threads("1024")), (Ok(1), Ok(1024)));
        for wrong in ["0", "-1", "1.5", "", "4294967296"] {
            assert!(depth(wrong).is_err() && threads(wrong).is_err(), "{wrong}");
        }
        assert_eq!(knob("depth"), Ok("depth"));
        assert!(knob("depht").is_err_and(|sentence| sentence.contains("antialias, depth")));
    }

    #[test]
    fn a_declaration_is_a_name_and_a_finite_number() {
        assert_eq!(declare("A_1=-2.5e3"), Ok(("A_1".to_owned(), -2500.0)));
        assert_eq!(declare("clock=0.5"), Ok(("clock".to_owned(), 0.5)));
        assert_eq!(declare("On=yes"), Ok(("On".to_owned(), 1.0)));
        for wrong in ["A", "1A=2", "=2", "A=", "A=inf", "A=nan", "A=b", "A b=2", "sphere=1", "x=2"]
        {
            assert!(declare(wrong).is_err(), "{wrong}");
        }
    }
}
