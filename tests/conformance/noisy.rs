//! What is drawn with noise has the same means as POV-Ray 3.7's: jitter of lights and
//! rainbows, focal blur, `crand`.
//!
//! Pixels differ, as random numbers do; means over blocks of 16×16 pixels agree within the errors that the
//! pixels' differences leave them.

use std::fmt::Write as _;

use image::RgbImage;

use super::drawn::draw::Draw;
use super::drawn::thing::{Look, thing};
use super::drawn::{Drawn, Kind, hold, repeat};

const KIND: Kind = Kind { name: "noisy", count: 8, scene, difference };

/// The side of a picture, and of a block.
const SIDE: u32 = 64;
const BLOCK: u32 = 16;
/// How many standard errors are allowed, and how much rounding to bytes may add.
const ERRORS: f64 = 6.0;
const ROUNDING: f64 = 0.003;

#[test]
fn noise_has_the_same_means() {
    hold(&KIND);
}

#[test]
fn a_number_draws_the_same_noise_again() {
    repeat(&KIND);
}

/// The light of a byte.
fn light(byte: u8) -> f64 {
    lucarne::color::srgb_decode(f64::from(byte) / 255.0)
}

/// Returns the block that differs most; `None` if the means of all agree.
fn difference([ours, theirs]: &[RgbImage; 2]) -> Option<String> {
    let mut worst = (0.0, String::new());
    let blocks = SIDE / BLOCK;
    for (block, channel) in (0..blocks * blocks).flat_map(|b| (0..3).map(move |c| (b, c))) {
        let [left, top] = [block % blocks * BLOCK, block / blocks * BLOCK];
        let pixels = (0..BLOCK * BLOCK).map(|i| (left + i % BLOCK, top + i / BLOCK));
        let at = |picture: &RgbImage, (x, y)| light(picture.get_pixel(x, y).0[channel]);
        let differences: Vec<f64> = pixels.map(|at_| at(ours, at_) - at(theirs, at_)).collect();
        let count = differences.len() as f64;
        let mean = differences.iter().sum::<f64>() / count;
        let variance =
            differences.iter().map(|d| (d - mean) * (d - mean)).sum::<f64>() / (count - 1.0);
        let allowed = ERRORS * (variance / count).sqrt() + ROUNDING;
        let excess = mean.abs() / allowed;
        if excess > worst.0 {
            let told = format!("block {left}, {top}, channel {channel}: {mean:.4} of {allowed:.4}");
            worst = (excess, told);
        }
    }
    (worst.0 > 1.0).then_some(worst.1)
}

fn scene(number: u64) -> Drawn {
    let mut draw = Draw::new(number);
    let draw = &mut draw;
    let kind = draw.dice.below(5);
    let blur = if kind == 1 || kind == 3 { blur(draw) } else { String::new() };
    let mut text = format!(
        "#version 3.7;\nglobal_settings {{ assumed_gamma 1 }}\n\
        camera {{ location <0, 2.5, -6> right x look_at 0 angle 45 {blur}}}\n"
    );
    let area = if kind == 0 || kind == 3 { jitter(draw) } else { String::new() };
    let _ = writeln!(text, "light_source {{ <{}, 6, -3>, rgb 0.7 {area}}}", draw.number(-4.0, 4.0));
    let crand = |draw: &mut Draw| match kind {
        2 => format!("finish {{ diffuse 0.6 ambient 0.2 crand {} }}", draw.number(0.02, 0.5)),
        _ => "finish { diffuse 0.7 ambient 0.1 }".to_owned(),
    };
    let _ = writeln!(
        text,
        "background {{ rgb {} }}\nplane {{ y, -1 pigment {{ rgb {} }} {} }}",
        draw.vector(0.0, 0.5),
        draw.vector(0.3, 0.9),
        crand(draw)
    );
    if kind == 4 {
        text += &rainbow(draw);
    }
    for at in [[-1.4, 0.0, 0.4], [1.2, 0.1, 1.0], [0.2, 0.0, -1.3]] {
        let size = draw.number(0.5, 0.9);
        text += &thing(draw, at, size, Look::Dull, "");
    }
    Drawn { text, size: [SIDE, SIDE] }
}

fn rainbow(draw: &mut Draw) -> String {
    let [angle, width] = [draw.number(3.0, 12.0), draw.number(5.0, 20.0)];
    let [jitter, distance] = [draw.number(0.05, 0.5), draw.number(2.0, 20.0)];
    let colors = draw.entries(4, |draw| draw.color(true));
    format!(
        "rainbow {{ direction <0, -0.3, 1> angle {angle} width {width} jitter {jitter} distance {distance} \
        color_map {{ {colors} }} }}\n"
    )
}

fn jitter(draw: &mut Draw) -> String {
    let [m, n] = [0; 2].map(|_| draw.whole(2, 6));
    let [a, b] = [0; 2].map(|_| draw.number(0.5, 4.0));
    let adaptive = draw.maybe(50, |d| format!(" adaptive {}", d.whole(0, 3)));
    let more = draw.word(&["", "", " circular", " circular orient", " area_illumination"]);
    format!("area_light {a}*x, {b}*z, {m}, {n} jitter{adaptive}{more} ")
}

fn blur(draw: &mut Draw) -> String {
    let samples = draw.whole(5, 60);
    let least = draw.maybe(30, |d| format!("{}, ", d.whole(2, samples)));
    let aperture = draw.number(0.1, 1.0);
    let mut text = format!(
        "aperture {aperture} blur_samples {least}{samples} focal_point <0, 0, {}> ",
        draw.number(-2.0, 2.0)
    );
    if draw.chance(50) {
        let _ = write!(text, "variance {} ", draw.dice.one_of(&[0.0, 0.00001, 0.001]));
    }
    if draw.chance(30) {
        let _ = write!(text, "confidence {} ", draw.number(0.5, 0.99));
    }
    text
}
