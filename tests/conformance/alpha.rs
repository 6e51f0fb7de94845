//! Pictures with alpha are those of POV-Ray 3.7 with `Output_Alpha`.

use std::path::Path;
use std::process::Command;

use image::Rgba;

use crate::programs::is_povray_there;

const SIZE: (u32, u32) = (32, 24);
/// How much alpha, and a component times alpha, may differ.
const ROUNDING: f64 = 1e-4;

const HEAD: &str =
    "global_settings { assumed_gamma 1 } camera { location <0, 0, -5> look_at 0 angle 40 }
light_source { <-3, 4, -9>, rgb 1 }
";

/// What stands before each background.
const THINGS: &str = "
sphere { <-1, 0.5, 0>, 0.6 pigment { rgb <1, 0.5, 0.25> } }
sphere { <0.3, 0.6, 0>, 0.6 pigment { rgbt <1, 0.5, 0.25, 0.4> } finish { ambient 0.2 } }
sphere { <1.4, 0.5, 0>, 0.5 pigment { rgbf <0.9, 0.5, 0.2, 0.7> } finish { phong 0.8 } }
sphere { <-1, -0.7, 0>, 0.6 pigment { rgbft <0.9, 0.8, 0.2, 0.4, 0.5> } interior { ior 1.5 }
  finish { reflection { 0, 1 fresnel } conserve_energy } }
box { <-0.4, -1.2, -0.1>, <0.6, -0.2, 0> pigment { rgbt <0.2, 0.5, 0.9, 0.6> }
  finish { reflection 0.3 ambient 0.1 } }
box { <0.7, -1.2, -0.3>, <1.7, -0.2, 0.3> texture { pigment { rgbt <1, 0, 0, 0.5> } }
  texture { pigment { rgbf <0.2, 1, 0.3, 0.6> } } }
plane { -z, -4 pigment { checker rgbt <1, 1, 1, 0.8>, rgb <0.2, 0.3, 0.4> scale 1.5 } }
";

const BACKGROUNDS: [&str; 8] = [
    "",
    "background { rgb <0.2, 0.4, 0.8> }",
    "background { rgbt <0.2, 0.4, 0.8, 1> }",
    "background { rgbft <0.2, 0.4, 0.8, 0.3, 0.5> }",
    "sky_sphere { pigment { gradient y color_map { [0 rgb <0.2, 0.4, 0.8>] [1 rgbt <1, 1, 1, 0.7>] } } }",
    "background { rgbt <1, 0.9, 0.5, 0.4> } sky_sphere { pigment { rgbf <0.9, 0.5, 0.3, 0.5> }
       pigment { rgbft <0.5, 0.6, 0.9, 0.25, 0.3> } }",
    "fog { distance 7 color rgb <0.5, 0.6, 0.7> }",
    "fog { distance 4 color rgbft <0.5, 0.6, 0.7, 0.3, 0.2> } fog { distance 9 color rgbt <0.9, 0.6, 0.2, 0.5> }",
];

type Picture = image::ImageBuffer<Rgba<u16>, Vec<u16>>;

/// The picture that a program writes.
fn picture(run: &mut Command, file: &Path) -> Picture {
    let told = run.output().expect("it runs");
    let said = String::from_utf8_lossy(&told.stderr).into_owned();
    image::open(file).unwrap_or_else(|_| panic!("{said}")).into_rgba16()
}

/// The pictures of the scene by both programs.
fn pictures(text: &str) -> [Picture; 2] {
    let place = tempfile::tempdir().expect("a folder");
    let file = |name: &str| place.path().join(name);
    std::fs::write(file("a.pov"), text).expect("written");
    let (width, height) = SIZE;
    let mut ours = Command::new(env!("CARGO_BIN_EXE_lucarne"));
    ours.args(["render", "a.pov", "-o", "ours.png", "--bits", "16", "--alpha"]);
    ours.args(["--antialias", "off", "--size", &format!("{width}x{height}")]);
    let mut theirs = Command::new("povray");
    theirs.args(["+Ia.pov", "+Otheirs.png", "+FN16", "+UA", "-D", "-GA", "-A", "File_Gamma=sRGB"]);
    theirs.args([format!("+W{width}"), format!("+H{height}")]);
    let ours = picture(ours.current_dir(&place), &file("ours.png"));
    [ours, picture(theirs.current_dir(&place), &file("theirs.png"))]
}

/// Red, green and blue in linear light, times alpha; and alpha.
fn parts(Rgba([red, green, blue, alpha]): Rgba<u16>) -> [f64; 4] {
    let part = |code: u16| f64::from(code) / 65_535.0;
    let multiplied = |code: u16| lucarne::color::srgb_decode(part(code)) * part(alpha);
    [multiplied(red), multiplied(green), multiplied(blue), part(alpha)]
}

/// The worst difference, and both pixels there.
fn worst([ours, theirs]: &[Picture; 2]) -> (f64, [[f64; 4]; 2]) {
    assert_eq!(ours.dimensions(), theirs.dimensions());
    let pairs = ours.pixels().zip(theirs.pixels()).map(|(a, b)| [parts(*a), parts(*b)]);
    let off =
        |[a, b]: &[[f64; 4]; 2]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let worst = pairs.map(|pair| (off(&pair), pair)).max_by(|a, b| a.0.total_cmp(&b.0));
    worst.expect("pixels")
}

#[test]
fn alpha_is_povrays_before_every_background() {
    if !is_povray_there() {
        return;
    }
    for version in ["#version 3.7;", "#version 3.5;"] {
        for background in BACKGROUNDS {
            let text = format!("{version}\n{HEAD}{THINGS}{background}");
            let pictures = pictures(&text);
            let (off, [ours, theirs]) = worst(&pictures);
            let said = format!("{off}: {ours:?} {theirs:?}\n{text}");
            assert!(off <= ROUNDING, "{said}");
            // A picture that is everywhere opaque, or nowhere, would show nothing.
            let alphas = || pictures[0].pixels().map(|pixel| pixel.0[3]);
            let is_opaque = background == BACKGROUNDS[1] && version.contains("3.7");
            assert!(alphas().any(|alpha| alpha == 65_535), "{text}");
            assert_eq!(alphas().all(|alpha| alpha == 65_535), is_opaque, "{text}");
        }
    }
}
