//! Textures drawn at random look as POV-Ray 3.7 shows them.
//!
//! A draw is *same* if the mean of FLIP's errors is at most [`SAME`], or if few pixels differ visibly; at least
//! 97 % must be. Twelve are drawn; `LUCARNE_LONG=N` draws N times as many. `LUCARNE_SEED=NUMBER` draws one
//! again, and with `LUCARNE_LONG` begins there. `LUCARNE_PICTURES=FOLDER` keeps scenes that differ, with both
//! pictures.
//!
//! What is not drawn, as POV-Ray 3.7 is at fault (measured at 64×48, of 3072 pixels):
//!
//! * `aoi` and `slope` in a blend of textures, whose entry has a normal. There the angle depends on how the
//!   object is turned: `gradient y texture_map { [0 pigment { aoi }] }` on a sphere is the same turned by
//!   `<47, -49, -56>` and not; with `normal { wood 0.0001 }` in the entry, turning changes 919 pixels, which is
//!   all of the sphere.
//! * `conserve_energy` with a picture shown `once`. Outside of the picture, the light seen through is not
//!   reduced: a mirror of 0.2 over a background of <0.8, 0.6, 0.4> shows 245, 185, 123, and the same with
//!   `rgbt 1` shows 205, 154, 102.
//! * `fresnel` without an `ior`, over a normal: where the normal leans away from the viewer, the quotient has
//!   no value; 160 pixels of a sphere differ, and none with `ior 1.4`.
//! * `filter all` or `transmit all` of a picture with alpha: both together exceed 1, so what the surface
//!   itself shows is less than nothing, and a reflection's `exponent` has no value for that; 714 pixels of a
//!   sphere differ, and none of a picture without alpha.
//! * A second `noise_generator` in a pigment, also after the default's: the bits of both numbers count
//!   together, so `noise_generator 2 noise_generator 1` is 3.
//!
//! Nor is `interpolate` drawn for a `material_map`, where lucarne interpolates the numbers of textures in
//! another way.

mod draw;
mod files;
mod pattern;
mod scene;
mod surface;

use std::fmt::Write as _;
use std::path::Path;

use image::RgbImage;

use crate::flip;
use crate::programs::{Size, is_povray_there, ours, theirs};

const SIZE: Size = [96, 72];

/// The mean of FLIP's errors up to which two pictures are the same.
const SAME: f32 = 0.02;
/// The difference of a channel above which pixels differ visibly, and the share of such pixels that is allowed.
const VISIBLE: u8 = 12;
const FEW: f64 = 0.005;

const DRAWS: u64 = 12;

/// The numbers of the draws.
fn numbers() -> std::ops::Range<u64> {
    let number = |name: &str| std::env::var(name).ok().map(|n| n.parse::<u64>().expect("a number"));
    let (first, times) = (number("LUCARNE_SEED"), number("LUCARNE_LONG"));
    let count = if first.is_some() && times.is_none() { 1 } else { DRAWS * times.unwrap_or(1) };
    let first = first.unwrap_or(0);
    first..first + count
}

/// Returns how much two pictures differ; `None` if they are the same.
fn difference(pictures: &[RgbImage; 2]) -> Option<String> {
    let mean = flip::mean(&flip::errors(pictures));
    let [ours, theirs] = pictures;
    let pairs = ours.pixels().zip(theirs.pixels());
    let differ = |(a, b): &(&image::Rgb<u8>, &image::Rgb<u8>)| {
        a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > VISIBLE)
    };
    let share = pairs.filter(differ).count() as f64 / f64::from(SIZE[0] * SIZE[1]);
    let is_same = mean <= SAME || share <= FEW;
    (!is_same).then(|| format!("FLIP {mean:.4}, {:.1} % of the pixels", 100.0 * share))
}

/// Draws a scene in both; `None` if they show the same.
fn failure(number: u64, folder: &Path) -> Option<String> {
    let text = scene::scene(number);
    let scene = folder.join("drawn.pov");
    std::fs::write(&scene, &text).expect("it is written");
    let pictures =
        ours(&scene, folder, SIZE).and_then(|ours| Ok([ours, theirs(&scene, folder, SIZE)?]));
    let told = match &pictures {
        Ok(pictures) => difference(pictures)?,
        Err(told) => format!("no picture: {told}"),
    };
    if let (Some(folder), Ok(pictures)) = (std::env::var_os("LUCARNE_PICTURES"), &pictures) {
        let folder = Path::new(&folder);
        std::fs::write(folder.join(format!("{number}.pov")), &text).expect("the folder is there");
        for (picture, whose) in pictures.iter().zip(["ours", "theirs"]) {
            picture
                .save(folder.join(format!("{number}.{whose}.png")))
                .expect("the folder is there");
        }
    }
    Some(format!("LUCARNE_SEED={number}: {told}\n{text}"))
}

#[test]
fn textures_drawn_at_random_look_the_same() {
    if !is_povray_there() {
        return;
    }
    let place = tempfile::tempdir().expect("a folder");
    files::write(place.path());
    let (mut differing, mut report) = (0, String::new());
    let numbers = numbers();
    for number in numbers.clone() {
        if let Some(told) = failure(number, place.path()) {
            differing += 1;
            let _ = writeln!(report, "{told}");
        }
    }
    let count = numbers.end - numbers.start;
    println!("{differing} of {count} differ\n{report}");
    assert!(100 * differing <= 3 * count, "{differing} of {count} differ\n{report}");
}

#[test]
fn a_number_draws_the_same_scene_again() {
    for number in 0..200 {
        let drawn = scene::scene(number);
        assert_eq!(drawn, scene::scene(number));
        assert_ne!(drawn, scene::scene(number + 1));
    }
}
