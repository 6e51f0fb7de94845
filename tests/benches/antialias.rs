//! How much faster adaptive antialiasing is than a regular grid of samples that leaves the same error.
//!
//! `cargo bench --bench antialias` prints the table of `docs/accuracy.md`; words behind `--` choose scenes. **In:** scenes
//! of the gallery at 320×240. **Out:** of the default, the error, camera rays a pixel and CPU seconds of tracing on one
//! thread, the least of three runs; and by how much more of both a grid takes, interpolated between grids. The error is
//! that from two halves of 256 random samples of each pixel, whose own noise is subtracted.

#[allow(dead_code, reason = "each benchmark uses a part")]
#[path = "programs.rs"]
mod programs;

use std::path::Path;
use std::process::ExitCode;

use lucarne::plan::{Antialias, Frame, Plan, PlanOptions, plan};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::NoFiles;
use lucarne::trace::{Sampling, Seen, TraceOptions, Unwatched, aims, geometry, pixels, trace};
use lucarne::world::{Origins, World};

const SCENES: [&str; 10] = [
    "first",
    "chess",
    "city",
    "glass",
    "mirror_room",
    "sponge",
    "sphereflake",
    "flange",
    "valley",
    "apothecary",
];
const SIZE: (u32, u32) = (320, 240);
const GRIDS: [u32; 7] = [2, 3, 4, 5, 6, 8, 12];
const RUNS: usize = 3;
/// Samples along the side of a pixel, for each half of the reference.
const SIDE: u32 = 16;

fn main() -> ExitCode {
    let words: Vec<String> =
        std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    println!("| scene | RMSE | camera rays a pixel | CPU s | a grid: rays | CPU time |");
    println!("|---|---:|---:|---:|---:|---:|");
    for name in SCENES {
        if words.is_empty() || words.iter().any(|word| word == name) {
            let scene = Scene::new(name);
            let grids = GRIDS.map(|side| scene.point(Antialias::Grid(side), &side.to_string()));
            let own = scene.point(Antialias::default(), "adaptive");
            let [rays, seconds] = [1, 2].map(|of| interpolated(&grids, own[0], of) / own[of]);
            let [error, own_rays, own_seconds] = own;
            println!(
                "| {name} | {error:.5} | {own_rays:.2} | {own_seconds:.3} | {rays:.1}× | {seconds:.1}× |"
            );
        }
    }
    ExitCode::SUCCESS
}

/// A scene and its true picture.
struct Scene {
    path: String,
    world: World,
    origins: Origins,
    halves: [Vec<[f64; 3]>; 2],
}

impl Scene {
    fn new(name: &str) -> Self {
        let root = env!("CARGO_MANIFEST_DIR");
        let path = format!("{root}/scenes/gallery/{name}.scene");
        let text = std::fs::read(&path).expect("a scene");
        let mut road = Road::new(&NoFiles, Options::new(Dialect::Scene));
        let (world, origins) = road.compile(&path, text);
        let off = planned(&world, &origins, Antialias::Off);
        let places: Vec<_> = off.frame.region.places().collect();
        let threads = TraceOptions::default();
        let geometry = geometry(&world, &off, &threads);
        let halves = [1, 2].map(|seed| {
            let aims = aims(&places, Sampling::Jittered { side: SIDE, seed });
            let (seen, _) = pixels(&world, &geometry, &off, &aims, &threads, &Unwatched);
            let color = |seen: Option<Seen>| {
                let mean = seen.expect("not stopped").mean.radiance;
                mean.components().map(|c| world.settings.assumed_gamma.linear(c).min(1.0))
            };
            seen.into_iter().map(color).collect()
        });
        Self { path, world, origins, halves }
    }

    /// Returns the error, the camera's rays a pixel and the CPU seconds.
    fn point(&self, antialias: Antialias, flag: &str) -> [f64; 3] {
        let plan = planned(&self.world, &self.origins, antialias);
        let traced = trace(&self.world, &plan, &TraceOptions::default(), &Unwatched);
        let count = traced.film.pixels.len() as f64;
        let gamma = self.world.settings.assumed_gamma;
        let colors =
            traced.film.radiances().map(|c| c.components().map(|c| gamma.linear(c).min(1.0)));
        let halves = self.halves[0].iter().zip(&self.halves[1]);
        let squares: f64 = colors
            .zip(halves)
            .flat_map(|(x, (a, b))| (0..3).map(move |i| (x[i] - a[i]) * (x[i] - b[i])))
            .sum();
        let flags = [format!("--antialias={flag}")];
        let flags: Vec<&str> = flags.iter().map(String::as_str).collect();
        let folder = tempfile::tempdir().expect("a temporary folder");
        let picture = folder.path().join("ours.png");
        let run = |_| programs::lucarne(Path::new(&self.path), &picture, SIZE, &flags);
        let runs = (0..RUNS).map(|number| run(number).expect("it renders"));
        let seconds = programs::Cost::least(runs).trace;
        [(squares / count / 3.0).max(0.0).sqrt(), traced.counters.camera as f64 / count, seconds]
    }
}

fn planned(world: &World, origins: &Origins, antialias: Antialias) -> Plan {
    let frame = Frame::whole(SIZE.0, SIZE.1);
    plan(world, origins, &PlanOptions { antialias, ..PlanOptions::new(frame) })
}

/// Returns what a grid takes that leaves this error: between two, errors and what they take are powers of each other.
fn interpolated(grids: &[[f64; 3]], error: f64, of: usize) -> f64 {
    let next = grids.iter().position(|grid| grid[0] < error).unwrap_or(grids.len() - 1).max(1);
    let [coarse, fine] = [next - 1, next].map(|i| [grids[i][0].ln(), grids[i][of].ln()]);
    let share = (error.ln() - coarse[0]) / (fine[0] - coarse[0]);
    (coarse[1] + share * (fine[1] - coarse[1])).exp()
}
