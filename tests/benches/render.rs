//! Whole pictures, beside POV-Ray 3.7 where it is installed.
//!
//! `cargo bench --bench render` prints the table of `docs/performance.md`; words behind `--` choose rows. **In:**
//! scenes generated here, one text for both programs. **Out:** CPU seconds of our `--stats json` and of POV-Ray's
//! own report, runs alternating, the rays a second, and how far the two pictures are apart. Ratios of one run can
//! be compared, seconds of two cannot: the machine may have been busy.

#[allow(dead_code, reason = "each benchmark uses a part")]
#[path = "programs.rs"]
mod programs;
#[path = "render/scenes.rs"]
mod scenes;

use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use std::time::Instant;

use programs::Cost;
use scenes::Row;

const SIZE: (u32, u32) = (1920, 1080);
const PAIRS: usize = 5;
const STARTS: usize = 20;

fn main() -> ExitCode {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let povray = programs::povray_version();
    match &povray {
        Some(version) => println!("{version}"),
        None => println!("POV-Ray is not installed (`povray`): nothing to compare with"),
    }
    let words: Vec<String> =
        std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let is_chosen = |row: &Row| words.is_empty() || words.iter().any(|w| row.title.contains(w));
    println!("{}×{}, one ray a pixel, one thread, least of {PAIRS} pairs\n", SIZE.0, SIZE.1);
    println!(
        "| scene | POV-Ray s | here s | ratio | goal | before tracing, ratio | million rays/s | pixels apart |"
    );
    println!("|---|---:|---:|---:|---:|---:|---:|---:|");
    for row in scenes::rows().iter().filter(|row| is_chosen(row)) {
        pair(folder, row, povray.is_some());
    }
    if words.is_empty() {
        starts(folder);
    }
    ExitCode::SUCCESS
}

/// Both programs on one scene, taking turns.
fn pair(folder: &Path, row: &Row, with_povray: bool) {
    let source = folder.join("scene.pov");
    fs::write(&source, &row.scene).expect("a scene written");
    let (ours, theirs) = (folder.join("ours.png"), folder.join("theirs.png"));
    let mut runs = Vec::new();
    for _ in 0..PAIRS {
        let here = programs::lucarne(&source, &ours, SIZE, &[]).expect("lucarne's times");
        let there = || programs::povray(&source, &theirs, SIZE, &[]).expect("POV-Ray's times");
        runs.push((here, with_povray.then(there)));
    }
    let here = Cost::least(runs.iter().map(|(here, _)| *here));
    let there = Cost::least(runs.iter().filter_map(|(_, there)| *there));
    let (trace, prepare) = (here.trace, here.prepare);
    let rays = here.rays / trace / 1e6;
    let Row { title, goal, .. } = row;
    if !with_povray {
        println!("| {title} | | {trace:.3} | | {goal} | | {rays:.1} | |");
        return;
    }
    let ratio = there.trace / trace;
    // POV-Ray tells hundredths of a second.
    let before = match there.prepare > 0.1 {
        true => format!("{:.2}", there.prepare / prepare),
        false => String::new(),
    };
    let their_trace = there.trace;
    let (count, all) = difference(&ours, &theirs);
    let apart = 100.0 * count as f64 / all as f64;
    println!(
        "| {title} | {their_trace:.3} | {trace:.3} | {ratio:.2} | {goal} | {before} | \
         {rays:.1} | {apart:.3} % |"
    );
}

/// Of how many pixels of two pictures, and of how many in all, a component differs by more than 2 of 255.
fn difference(one: &Path, other: &Path) -> (usize, usize) {
    let [one, other] = [one, other].map(|path| image::open(path).expect("a picture").to_rgb8());
    assert_eq!(one.dimensions(), other.dimensions());
    let pixels = one.pixels().zip(other.pixels());
    let apart = pixels.filter(|(a, b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 2));
    (apart.count(), (SIZE.0 * SIZE.1) as usize)
}

/// How long one waits for next to nothing, by the clock.
fn starts(folder: &Path) {
    let tiny = folder.join("tiny.scene");
    fs::write(
        &tiny,
        "camera { location <0, 0, 5> look_at <0, 0, 0> }\nlight_source { <5, 5, 5>, rgb 1 }\n\
         sphere { <0, 0, 0>, 1 pigment { rgb <1, 0.5, 0.2> } }\n",
    )
    .expect("a scene written");
    let small = folder.join("few.pov");
    let few = scenes::rows().into_iter().next().expect("a row");
    fs::write(&small, few.scene).expect("a scene written");
    println!("\nFrom start to finish, by the clock, n = {STARTS}     min   median");
    let row = |what: &str, command: &mut Command| {
        let times = (0..STARTS).map(|_| {
            let start = Instant::now();
            let status = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
            assert!(status.expect("lucarne starts").success(), "{what}");
            start.elapsed().as_secs_f64() * 1e3
        });
        let (least, median) = spread(times);
        println!("  {what:36} {least:6.1} {median:8.1} ms   promised: 20");
    };
    let lucarne = || Command::new(env!("CARGO_BIN_EXE_lucarne"));
    let picture = folder.join("tiny.png");
    row(
        "render a sphere at 64×64",
        lucarne().args(["render", "--size=64x64", "-o"]).args([&picture, &tiny]),
    );
    row("check the scene of few things", lucarne().arg("check").arg(&small));
}

/// The least and the median.
fn spread(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    (values[0], values[values.len() / 2])
}
