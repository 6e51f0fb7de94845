//! How fast text becomes a tree: megabytes of scene text a CPU second.
//!
//! `cargo bench --bench syntax`. **In:** the `.pov` and `.inc` files that the Debian packages
//! `povray-examples` and `povray-includes` install (skipped, and said so, where they are missing),
//! and runs of numbers and vectors made here. **Out:** a table of the fastest and the median of
//! several passes.

use std::fs;
use std::path::{Path, PathBuf};

use lucarne::diagnostic::Diagnostics;
use lucarne::source::{FileId, Source, decode};
use lucarne::syntax::{ParseOptions, parse};
use lucarne::vocabulary::Dialect;
use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::time::TimeValLike;

const PASSES: usize = 9;

fn main() {
    println!("CPU time of {PASSES} passes       MB    MB/s: best   median");
    let examples = texts(&["/usr/share/doc/povray/examples", "/usr/share/povray-3.7/include"]);
    if examples.is_empty() {
        println!("POV-Ray's examples are not installed (`povray-examples`): not read");
    } else {
        row("POV-Ray's examples", &examples, 5.0);
    }
    let numbers = (0..200_000).map(|i| format!("{:.6},\n", value(i))).collect();
    row("a run of numbers", &[numbers], 30.0);
    let vectors = (0..100_000).map(|i| {
        format!("<{:.6}, {:.6}, {:.6}>,\n", value(3 * i), value(3 * i + 1), value(3 * i + 2))
    });
    row("a run of vectors", &[vectors.collect()], 30.0);
    let whole = (0..300_000).map(|i| format!("{}, ", i * 7 % 100_003)).collect();
    row("a run of whole numbers", &[whole], 30.0);
}

/// Numbers as a mesh has them.
fn value(i: u32) -> f64 {
    f64::from(i.wrapping_mul(2_654_435_761)) / 2f64.powi(27) - 16.0
}

fn row(what: &str, texts: &[String], promised: f64) {
    let megabytes = texts.iter().map(String::len).sum::<usize>() as f64 / 1e6;
    let sources: Vec<Source> =
        texts.iter().map(|text| Source::new("bench.pov", text.clone())).collect();
    let options = ParseOptions { dialect: Dialect::Pov, ..ParseOptions::default() };
    let mut speeds: Vec<f64> = (0..PASSES)
        .map(|_| {
            let before = cpu_seconds();
            for source in &sources {
                std::hint::black_box(parse(
                    source,
                    FileId(0),
                    &options,
                    &mut Diagnostics::new(false),
                ));
            }
            megabytes / (cpu_seconds() - before)
        })
        .collect();
    speeds.sort_by(f64::total_cmp);
    let (best, median) = (speeds[PASSES - 1], speeds[PASSES / 2]);
    println!("{what:24} {megabytes:8.2} {best:12.1} {median:8.1}   promised: {promised}");
}

fn cpu_seconds() -> f64 {
    let usage = getrusage(UsageWho::RUSAGE_SELF).expect("the system counts");
    (usage.user_time() + usage.system_time()).num_microseconds() as f64 / 1e6
}

/// The scene files in folders and all folders in them, in order.
fn texts(folders: &[&str]) -> Vec<String> {
    let mut waiting: Vec<PathBuf> = folders.iter().map(PathBuf::from).collect();
    let mut files = Vec::new();
    while let Some(folder) = waiting.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                waiting.push(path);
            } else if is_scene(&path) {
                files.push(path);
            }
        }
    }
    files.sort();
    files.iter().filter_map(|file| fs::read(file).ok()).map(|bytes| decode(bytes).0).collect()
}

fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "pov" || extension == "inc")
}
