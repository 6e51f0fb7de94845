//! Scenes drawn at random and rendered by both programs, and how the pictures are compared.
//!
//! A draw is *same* if the mean of FLIP's errors is at most [`SAME`], or if few pixels differ visibly; at least
//! 97 % must be. Each test draws a few; `LUCARNE_LONG=N` draws N times as many. `LUCARNE_SEED=NUMBER` draws one
//! again, and with `LUCARNE_LONG` begins there. `LUCARNE_PICTURES=FOLDER` keeps scenes that differ, with both
//! pictures.

use std::fmt::Write as _;
use std::path::Path;

use image::RgbImage;

use crate::flip;
use crate::programs::{Size, is_povray_there, ours, theirs};

pub mod draw;
mod files;
pub mod thing;

/// The usual size.
pub const SIZE: Size = [96, 72];

/// The mean of FLIP's errors up to which two pictures are the same.
const SAME: f32 = 0.02;
/// The difference of a channel above which pixels differ visibly, and the share of such pixels that is allowed.
const VISIBLE: u8 = 12;
const FEW: f64 = 0.005;

/// A scene, and the size of its picture.
#[derive(Debug, PartialEq)]
pub struct Drawn {
    pub text: String,
    pub size: Size,
}

/// A kind of scenes.
pub struct Kind {
    /// What is drawn at random; pictures that are kept have this name.
    pub name: &'static str,
    /// How many a test draws.
    pub count: u64,
    pub scene: fn(u64) -> Drawn,
    /// Returns how much two pictures differ; `None` if they are the same.
    pub difference: fn(&[RgbImage; 2]) -> Option<String>,
}

/// Returns the numbers of the draws.
fn numbers(count: u64) -> std::ops::Range<u64> {
    let number = |name: &str| std::env::var(name).ok().map(|n| n.parse::<u64>().expect("a number"));
    let (first, times) = (number("LUCARNE_SEED"), number("LUCARNE_LONG"));
    let count = if first.is_some() && times.is_none() { 1 } else { count * times.unwrap_or(1) };
    let first = first.unwrap_or(0);
    first..first + count
}

/// Returns how much two pictures differ; `None` if they look the same.
pub fn difference(pictures: &[RgbImage; 2]) -> Option<String> {
    let mean = flip::mean(&flip::errors(pictures));
    let [ours, theirs] = pictures;
    let pairs = ours.pixels().zip(theirs.pixels());
    let differ = |(a, b): &(&image::Rgb<u8>, &image::Rgb<u8>)| {
        a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > VISIBLE)
    };
    let share = pairs.filter(differ).count() as f64 / f64::from(ours.width() * ours.height());
    let is_same = mean <= SAME || share <= FEW;
    (!is_same).then(|| format!("FLIP {mean:.4}, {:.1} % of the pixels", 100.0 * share))
}

/// Draws a scene in both; `None` if they show the same.
fn failure(kind: &Kind, number: u64, folder: &Path) -> Option<String> {
    let Drawn { text, size } = (kind.scene)(number);
    let scene = folder.join("drawn.pov");
    std::fs::write(&scene, &text).expect("it is written");
    let pictures =
        ours(&scene, folder, size).and_then(|ours| Ok([ours, theirs(&scene, folder, size)?]));
    let told = match &pictures {
        Ok(pictures) => (kind.difference)(pictures)?,
        Err(told) => format!("no picture: {told}"),
    };
    if let Some(folder) = std::env::var_os("LUCARNE_PICTURES") {
        let file = |ending| Path::new(&folder).join(format!("{}.{number}.{ending}", kind.name));
        std::fs::write(file("pov"), &text).expect("the folder is there");
        for (picture, ending) in pictures.iter().flatten().zip(["ours.png", "theirs.png"]) {
            picture.save(file(ending)).expect("the folder is there");
        }
    }
    Some(format!("LUCARNE_SEED={number}: {told}\n{text}"))
}

/// Draws scenes of a kind in both; at least 97 % must be the same.
pub fn hold(kind: &Kind) {
    if !is_povray_there() {
        return;
    }
    let place = tempfile::tempdir().expect("a folder");
    files::write(place.path());
    let (mut differing, mut report) = (0, String::new());
    let numbers = numbers(kind.count);
    for number in numbers.clone() {
        if let Some(told) = failure(kind, number, place.path()) {
            differing += 1;
            let _ = writeln!(report, "{told}");
        }
    }
    let count = numbers.end - numbers.start;
    println!("{}: {differing} of {count} differ\n{report}", kind.name);
    assert!(100 * differing <= 3 * count, "{differing} of {count} differ\n{report}");
}

/// Asserts that a number draws the same scene again, and another number another.
pub fn repeat(kind: &Kind) {
    for number in 0..200 {
        let drawn = (kind.scene)(number);
        assert_eq!(drawn, (kind.scene)(number));
        assert_ne!(drawn, (kind.scene)(number + 1));
    }
}
