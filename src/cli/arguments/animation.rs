//! The arguments about an animation: its frames, their clocks and their speed.

use clap::Args;

use crate::cli::animation::{Edge, FrameRange, LAST};

/// Frames of an animation, instead of a still.
#[derive(Debug, Args)]
pub struct AnimationArguments {
    /// Render frames A to B of an animation, or every STEPth of them (for example `--frames 1..24`): numbered
    /// pictures (OUT01.png …), an animated .apng or .gif, or PPM pictures one after the other on standard
    /// output. `clock` runs from 0 to 1
    #[arg(long, value_name = "A..B[/STEP]", value_parser = frames)]
    frames: Option<(u32, u32, u32)>,
    /// Clocks of the first and the last frame
    #[arg(long, value_name = "A..B", value_parser = clocks, default_value = "0..1", requires = "frames")]
    #[arg(allow_hyphen_values = true)]
    clocks: (f64, f64),
    /// The frame that would follow the last is the first again
    #[arg(long, requires = "frames")]
    cyclic: bool,
    /// Frames per second of an animated picture
    #[arg(long, value_name = "N", value_parser = fps, default_value = "25", requires = "frames")]
    pub fps: f64,
    /// Only render frames A to B of these: their numbers and clocks stay
    #[arg(long, value_name = "A..B", value_parser = part, requires = "frames")]
    only: Option<(u32, u32)>,
}

impl AnimationArguments {
    /// Returns the animation, if one was asked for.
    pub fn range(&self) -> Option<FrameRange> {
        let (first, last, step) = self.frames?;
        let subset = self.only.map_or((None, None), |(first, last)| {
            (Some(Edge::Number(first)), Some(Edge::Number(last)))
        });
        let (clocks, is_cyclic) = (self.clocks, self.cyclic);
        Some(FrameRange { frames: (first, last), clocks, is_cyclic, subset, step })
    }
}

fn frames(text: &str) -> Result<(u32, u32, u32), String> {
    let wrong = || "expected frames such as `1..24`, or `1..24/2` for every other".to_owned();
    let (range, step) = text.split_once('/').unwrap_or((text, "1"));
    let (first, last) = part(range).map_err(|_| wrong())?;
    match step.parse() {
        Ok(step @ 1..) => Ok((first, last, step)),
        _ => Err(wrong()),
    }
}

fn part(text: &str) -> Result<(u32, u32), String> {
    let wrong = "expected two numbers of frames up to 999999, such as `1..24`";
    let numbers = text.split_once("..").and_then(|(first, last)| {
        Some((first.trim().parse().ok()?, last.trim_start_matches('=').trim().parse().ok()?))
    });
    numbers.filter(|(first, last)| first <= last && *last <= LAST).ok_or_else(|| wrong.to_owned())
}

fn clocks(text: &str) -> Result<(f64, f64), String> {
    let wrong = "expected two clocks, such as `0..1`";
    let numbers = text.split_once("..").and_then(|(first, last)| {
        let of = |text: &str| text.trim().parse().ok().filter(|clock: &f64| clock.is_finite());
        Some((of(first)?, of(last)?))
    });
    numbers.ok_or_else(|| wrong.to_owned())
}

fn fps(text: &str) -> Result<f64, String> {
    let fps = text.parse().ok().filter(|fps| (0.02..=1000.0).contains(fps));
    fps.ok_or_else(|| "expected a number of frames per second, 0.02 to 1000".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_and_clocks_are_read() {
        assert_eq!(frames("1..24"), Ok((1, 24, 1)));
        assert_eq!(frames("0..=10/5"), Ok((0, 10, 5)));
        assert_eq!(clocks("-1..0.5"), Ok((-1.0, 0.5)));
        for wrong in ["", "5", "5..1", "1..2/0", "a..b", "1..2/x"] {
            assert!(frames(wrong).is_err(), "{wrong}");
        }
        assert!(clocks("0..inf").is_err() && fps("0").is_err() && fps("25") == Ok(25.0));
    }
}
