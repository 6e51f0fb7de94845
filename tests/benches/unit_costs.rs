//! What counted work costs: the unit costs of `src/accuracy/knob.rs`, fitted to CPU seconds.
//!
//! `cargo bench --bench unit_costs`. **In:** every scene of the gallery, each setting of every knob that
//! half a minute is enough for, by `lucarne accuracy --json`. **Out:** the units that are off least, by
//! their share of each picture's seconds; none is negative; and how far off they are. Seconds of a busy
//! machine are the shortest of their runs, and off by more.

use std::path::Path;
use std::process::{Command, ExitCode, Stdio};

use serde_json::Value;

/// What is counted.
const UNITS: [(&str, &str); 6] = [
    ("rays", "camera"),
    ("rays", "shadow"),
    ("rays", "reflection"),
    ("rays", "transmission"),
    ("work", "box_visits"),
    ("work", "solving"),
];
const ASKED: &str = "--size 120x90 --budget 30s --threads 1 --json";

/// A picture: its scene, what was counted, nanoseconds.
struct Picture {
    scene: usize,
    counts: [f64; UNITS.len()],
    nanoseconds: f64,
}

impl Picture {
    fn predicted(&self, units: &[f64; UNITS.len()]) -> f64 {
        self.counts.iter().zip(units).map(|(count, unit)| count * unit).sum()
    }
}

fn main() -> ExitCode {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let gallery = std::fs::read_dir(root.join("scenes/gallery")).expect("the gallery");
    let mut scenes: Vec<_> = gallery.map(|entry| entry.expect("a file").path()).collect();
    scenes.retain(|path| path.extension().is_some_and(|extension| extension == "scene"));
    scenes.sort();
    let mut pictures = Vec::new();
    for (number, scene) in scenes.iter().enumerate() {
        let run = Command::new(env!("CARGO_BIN_EXE_lucarne"))
            .arg("accuracy")
            .arg(scene)
            .args(ASKED.split(' '))
            .stderr(Stdio::inherit())
            .output()
            .expect("it runs");
        let report: Value = serde_json::from_slice(&run.stdout).expect("a report");
        for row in report["rows"].as_array().expect("rows") {
            let counted = |group: &str, name: &str| row[group][name].as_f64().expect("a count");
            // What is mirrored whole is mirrored.
            let count = |(group, name): (&str, &str)| match name {
                "reflection" => counted(group, name) + counted(group, "total_reflection"),
                _ => counted(group, name),
            };
            let seconds = row["cpu_s"].as_array().expect("runs").iter().filter_map(Value::as_f64);
            pictures.push(Picture {
                scene: number,
                counts: UNITS.map(count),
                nanoseconds: 1e9 * seconds.fold(f64::INFINITY, f64::min),
            });
        }
    }
    let units = fitted(&pictures);
    println!("a ray of the camera that meets nothing: {:.0} ns; of that", units[0]);
    for ((_, name), unit) in UNITS.iter().zip(units) {
        println!("{name:12} {:8.3}", unit / units[0]);
    }
    let ratio = |picture: &Picture| picture.nanoseconds / picture.predicted(&units);
    let geometric = |ratios: &[f64]| {
        (ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / ratios.len() as f64).exp()
    };
    for (number, scene) in scenes.iter().enumerate() {
        let mine: Vec<f64> = pictures.iter().filter(|p| p.scene == number).map(ratio).collect();
        let mean = geometric(&mine);
        let off = geometric(
            &mine.iter().map(|ratio| (ratio / mean).max(mean / ratio)).collect::<Vec<_>>(),
        );
        let name = scene.file_stem().unwrap_or_default().to_string_lossy();
        println!(
            "{name:12} {:2} pictures: {mean:.2} times what is predicted, and each off that by {:.1} %",
            mine.len(),
            100.0 * (off - 1.0)
        );
    }
    ExitCode::SUCCESS
}

/// Units, none negative, whose predictions are off least in the mean square of their shares: one after
/// the other is set right until nothing changes.
///
/// **Source:** coordinate descent for non-negative least squares, V. Franc et al., Sequential
/// Coordinate-Wise Algorithm for the Non-negative Least Squares Problem (2005).
fn fitted(pictures: &[Picture]) -> [f64; UNITS.len()] {
    let shares: Vec<[f64; UNITS.len()]> =
        pictures.iter().map(|p| p.counts.map(|count| count / p.nanoseconds)).collect();
    let mut units = [1.0; UNITS.len()];
    for _ in 0..100_000 {
        for unit in 0..UNITS.len() {
            let (mut along, mut square) = (0.0, 0.0);
            for share in &shares {
                let all: f64 = share.iter().zip(units).map(|(share, unit)| share * unit).sum();
                along += share[unit] * (1.0 - all);
                square += share[unit] * share[unit];
            }
            if square > 0.0 {
                units[unit] = (units[unit] + along / square).max(0.0);
            }
        }
    }
    units
}
