//! What a pixel of a patterned surface costs, beside POV-Ray 3.7 where it is installed.
//!
//! `cargo bench --bench textures` prints the table; with names of scenes behind `--`, those alone. **In:** scenes
//! written here, one text for both programs: a plane that fills the picture, with one light. **Out:** for each
//! scene the least CPU seconds of tracing of both, in alternating runs, as each program reports them. Compare
//! ratios, not the seconds of two runs: the machine may have been busy.

#[allow(dead_code, reason = "each benchmark uses a part")]
#[path = "programs.rs"]
mod programs;

use std::process::ExitCode;

const SIZE: (u32, u32) = (1920, 1080);
const PAIRS: usize = 5;

/// Of how many times POV-Ray's speed a scene is promised.
const OF_PATTERNS: f64 = 3.0;
const OF_LAYERS: f64 = 2.5;

const HEAD: &str = "#version 3.7;
#include \"colors.inc\"
#include \"stones.inc\"
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> right x*16/9 up y direction 1.2*z look_at 0 }
light_source { <-20, 30, -40>, rgb 1 }
#default { finish { ambient 0.1 diffuse 0.8 } }
";

/// The name of a scene, the texture of its plane, and what is promised of it.
const SCENES: [(&str, &str, Option<f64>); 9] = [
    // What all the others cost, too.
    ("plain", "pigment { rgb <0.7, 0.6, 0.5> }", None),
    (
        "granite",
        "pigment { granite color_map { [0 rgb <0.3, 0.2, 0.2>] [0.4 rgb <0.8, 0.7, 0.6>] [1 rgb 1] } }",
        Some(OF_PATTERNS),
    ),
    (
        "marble",
        "pigment { marble turbulence 0.8
           color_map { [0 rgb <0.9, 0.9, 0.8>] [0.7 rgb <0.6, 0.5, 0.5>] [1 rgb 0.2] } }",
        Some(OF_PATTERNS),
    ),
    (
        "wood",
        "pigment { wood turbulence 0.1
           color_map { [0 rgb <0.7, 0.5, 0.3>] [0.8 rgb <0.5, 0.3, 0.1>] [1 rgb <0.3, 0.2, 0.1>] }
           scale 0.3 }",
        Some(OF_PATTERNS),
    ),
    (
        "bozo",
        "pigment { bozo scale 0.3
           color_map { [0 rgb <0.2, 0.4, 0.8>] [0.5 rgb <0.7, 0.8, 1>] [1 rgb 1] } }",
        Some(OF_PATTERNS),
    ),
    (
        "bumps",
        "pigment { rgb <0.7, 0.6, 0.5> } normal { bumps 0.4 scale 0.1 }",
        Some(OF_PATTERNS),
    ),
    (
        "agate",
        "pigment { agate scale 0.5
           color_map { [0 rgb <0.9, 0.8, 0.7>] [0.6 rgb <0.7, 0.4, 0.3>] [1 rgb <0.3, 0.1, 0.1>] } }",
        Some(OF_PATTERNS),
    ),
    ("stone", "texture { T_Stone10 }", Some(OF_LAYERS)),
    ("cracked stone", "texture { T_Grnt0 } texture { T_Crack1 }", Some(OF_LAYERS)),
];

fn main() -> ExitCode {
    let asked: Vec<String> =
        std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let has_povray = programs::povray_version().is_some();
    if !has_povray {
        println!("POV-Ray is not installed (`povray`): nothing to compare with");
    }
    println!("| texture | POV-Ray | here | ns a pixel | POV-Ray / here | promised |");
    println!("|---|---:|---:|---:|---:|---:|");
    for (name, texture, promised) in SCENES {
        if !asked.is_empty() && !asked.iter().any(|word| word == name) {
            continue;
        }
        let (scene, picture) = (folder.path().join("scene.pov"), folder.path().join("picture.png"));
        std::fs::write(&scene, format!("{HEAD}plane {{ z, 0 {texture} }}\n")).expect("written");
        let (mut least_here, mut least_there) = (f64::INFINITY, f64::INFINITY);
        for _ in 0..PAIRS {
            let here = programs::lucarne(&scene, &picture, SIZE, &[]).expect("lucarne's times");
            least_here = least_here.min(here.trace);
            if has_povray {
                let there = programs::povray(&scene, &picture, SIZE, &[]).expect("POV-Ray's times");
                least_there = least_there.min(there.trace);
            }
        }
        let pixels = f64::from(SIZE.0) * f64::from(SIZE.1);
        let each = 1e9 * least_here / pixels;
        let promised = promised.map_or_else(String::new, |promised| format!("{promised:.1}"));
        match has_povray {
            true => println!(
                "| {name} | {least_there:.3} | {least_here:.3} | {each:.0} | {:.2} | {promised} |",
                least_there / least_here
            ),
            false => println!("| {name} | | {least_here:.3} | {each:.0} | | {promised} |"),
        }
    }
    ExitCode::SUCCESS
}
