//! How the time for tracing grows: with objects, triangles, parts of a solid, lights, depth, pixels and threads.
//!
//! `cargo bench --bench growth` prints the table of `docs/performance.md`; words behind `--` choose rows. **In:** scenes
//! of several sizes, generated here, one text for both programs. **Out:** for each size the least CPU seconds of
//! tracing, by lucarne and by POV-Ray 3.7 where it is installed, and the exponent of the power of the size that fits
//! them best. Of threads it is the time by the clock, as a ratio to that of one.

#[allow(dead_code, reason = "each benchmark uses a part")]
#[path = "programs.rs"]
mod programs;
#[allow(dead_code, reason = "only the scenes of several sizes are used")]
#[path = "render/scenes.rs"]
mod scenes;

use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

const SIZE: (u32, u32) = (960, 540);
const RUNS: usize = 3;

/// What grows, to which sizes, and the scene of a size; pixels and threads grow by themselves.
struct Growth {
    of: &'static str,
    sizes: &'static [usize],
    scene: fn(usize) -> String,
}

const ROWS: [Growth; 6] = [
    Growth { of: "spheres", sizes: &[1_000, 10_000, 100_000, 1_000_000], scene: scenes::spheres },
    Growth { of: "triangles", sizes: &[2_500, 25_000, 250_000, 1_000_000], scene: triangles },
    Growth { of: "parts of a difference", sizes: &[10, 30, 100, 300], scene: scenes::drilled },
    Growth { of: "lights", sizes: &[1, 10, 100], scene: scenes::lights },
    Growth { of: "`max_trace_level` of glass", sizes: &[2, 4, 8, 16], scene: glass },
    Growth {
        of: "pixels",
        sizes: &[32_400, 129_600, 518_400, 2_073_600],
        scene: |_| scenes::few(),
    },
];

fn triangles(count: usize) -> String {
    scenes::mesh((count as f64 / 4.0).sqrt() as usize)
}

fn glass(depth: usize) -> String {
    scenes::glass(depth as u32)
}

fn main() -> ExitCode {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let words: Vec<String> =
        std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let is_chosen = |of: &str| words.is_empty() || words.iter().any(|word| of.contains(word));
    let has_povray = programs::povray_version().is_some();
    println!("| number of | sizes | here s | exponent | POV-Ray s | exponent |");
    println!("|---|---|---|---:|---|---:|");
    for Growth { of, sizes, scene } in ROWS.iter().filter(|row| is_chosen(row.of)) {
        let costs = sizes.iter().map(|&size| {
            let pixels = if *of == "pixels" { size_of(size) } else { SIZE };
            traced(folder, &scene(size), pixels, has_povray)
        });
        let costs: Vec<[f64; 2]> = costs.collect();
        let columns = [0, 1].map(|program| {
            let seconds = || costs.iter().map(move |cost| cost[program]);
            let points: Vec<_> = sizes.iter().map(|&size| size as f64).zip(seconds()).collect();
            let all: Vec<_> = seconds().map(|seconds| format!("{seconds:.3}")).collect();
            format!("{} | {:.2}", all.join(", "), exponent(&points))
        });
        let [here, there] = columns;
        let there = if has_povray { there } else { " | ".to_owned() };
        let sizes: Vec<_> = sizes.iter().map(usize::to_string).collect();
        println!("| {of} | {} | {here} | {there} |", sizes.join(", "));
    }
    if is_chosen("threads") {
        threads(folder);
    }
    ExitCode::SUCCESS
}

/// A picture of 16:9 with so many pixels.
fn size_of(pixels: usize) -> (u32, u32) {
    let height = (pixels as f64 * 9.0 / 16.0).sqrt().round();
    ((height * 16.0 / 9.0).round() as u32, height as u32)
}

/// The least CPU seconds of tracing, here and by POV-Ray.
fn traced(folder: &Path, text: &str, size: (u32, u32), has_povray: bool) -> [f64; 2] {
    let (scene, picture) = (folder.join("scene.pov"), folder.join("picture.png"));
    std::fs::write(&scene, text).expect("a scene written");
    let runs = (0..RUNS).map(|_| {
        let here = programs::lucarne(&scene, &picture, size, &[]).expect("lucarne's times");
        let there = has_povray
            .then(|| programs::povray(&scene, &picture, size, &[]).expect("POV-Ray's times"));
        [here.trace, there.map_or(f64::INFINITY, |there| there.trace)]
    });
    runs.fold([f64::INFINITY; 2], |[a, b], [here, there]| [a.min(here), b.min(there)])
}

/// The slope of the straight line that fits the logarithms best.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|point| point.0.ln()), mean(|point| point.1.ln()));
    let slope = |(above, below): (f64, f64), point: &(f64, f64)| {
        let (right, up) = (point.0.ln() - x, point.1.ln() - y);
        (above + right * up, below + right * right)
    };
    let (above, below) = points.iter().fold((0.0, 0.0), slope);
    above / below
}

/// How much sooner more threads are done with 32 glass bodies, which take long.
fn threads(folder: &Path) {
    let (scene, picture) = (folder.join("scene.pov"), folder.join("picture.png"));
    std::fs::write(&scene, scenes::glass(10)).expect("a scene written");
    let most = std::thread::available_parallelism().map_or(1, usize::from);
    let least = |threads: usize| {
        let flag = format!("--threads={threads}");
        let times = (0..RUNS).map(|_| {
            let start = Instant::now();
            programs::lucarne(&scene, &picture, SIZE, &[&flag]).expect("lucarne's times");
            start.elapsed().as_secs_f64()
        });
        times.fold(f64::INFINITY, f64::min)
    };
    let one = least(1);
    for threads in (2..=most).filter(|threads| threads.is_power_of_two()) {
        let several = least(threads);
        println!("| threads | 1, {threads} | {one:.3}, {several:.3} | ×{:.2} |", one / several);
    }
}
