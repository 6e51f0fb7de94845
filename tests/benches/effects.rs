//! What an effect costs where nothing calls for it: instructions of the frame loop, in the shipped program
//! and in the same source built with one kernel alone.
//!
//! `cargo bench --bench effects`, with valgrind installed. **In:** scenes of `scenes/`. **Out:** a table,
//! and exit code 1 where a row differs by more than 0.1 %. With `LUCARNE_SHAPES=1` the other programs also have
//! code for those shapes alone that their scenes hold, and each of them has a bar of its own.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::sync::mpsc;
use std::time::Instant;
use std::{fs, thread};

/// The most that a row may differ, in per cent.
const BAR: f64 = 0.1;

/// A program to measure against: its kernel, the shapes of its scenes, and these, below `scenes/`.
struct Alone {
    kernel: &'static str,
    shapes: &'static [&'static str],
    scenes: &'static [&'static str],
    /// The most that a row may differ where the program has those shapes alone: of each solid that is looked at
    /// it has to be asked which it is.
    bar_of_shapes: f64,
}

const ALONE: [Alone; 4] = [
    Alone {
        kernel: "bare",
        shapes: &["sphere", "box"],
        scenes: &["seed/ambient", "atmosphere/background"],
        bar_of_shapes: 0.5,
    },
    Alone {
        kernel: "shadows",
        shapes: &["sphere", "plane", "box"],
        scenes: &["directives/for", "transforms/rotate"],
        bar_of_shapes: 0.5,
    },
    Alone {
        kernel: "shadows+secondary",
        shapes: &["sphere", "plane", "box"],
        scenes: &["gallery/first", "finishes/reflection", "seed/mirror"],
        bar_of_shapes: 0.5,
    },
    Alone {
        kernel: "shadows+secondary+bodies",
        shapes: &["plane", "body", "torus"],
        scenes: &["shapes/torus"],
        bar_of_shapes: 5.0,
    },
];

/// The function whose instructions are counted, with all that it calls.
const FRAME: &str = "lucarne::trace::frame";

fn main() -> ExitCode {
    if Command::new("valgrind").arg("--version").stdout(Stdio::null()).status().is_err() {
        println!("valgrind is not installed: no instructions counted");
        return ExitCode::SUCCESS;
    }
    let start = Instant::now();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let shipped = folder.path().join("shipped");
    fs::copy(env!("CARGO_BIN_EXE_lucarne"), &shipped).expect("the program copied");
    println!("Instructions of the frame loop at 160×120, one ray a pixel, one thread.\n");
    println!("| scene | kernel | shipped | alone | more | at most |\n|---|---|---|---|---|---|");
    let mut is_within = true;
    // One program is built while the one before it is measured.
    let (send, built) = mpsc::channel();
    thread::scope(|scope| {
        let folder = folder.path();
        scope.spawn(move || {
            for alone in ALONE {
                let program = build(folder, &alone);
                if send.send((alone, program)).is_err() {
                    return;
                }
            }
        });
        for (Alone { kernel, scenes, bar_of_shapes, .. }, alone) in built {
            let bar = if with_few_shapes() { bar_of_shapes } else { BAR };
            for name in scenes {
                let scene = root().join(format!("scenes/{name}.scene"));
                let [shipped, alone] =
                    [&shipped, &alone].map(|program| instructions(folder, program, &scene));
                let more = 100.0 * (shipped as f64 / alone as f64 - 1.0);
                is_within &= more.abs() <= bar;
                let [shipped, alone] = [shipped, alone].map(grouped);
                println!("| {name} | {kernel} | {shipped} | {alone} | {more:.4} % | {bar} % |");
            }
        }
    });
    println!("\nIt took {:.0} s.", start.elapsed().as_secs_f64());
    if is_within {
        return ExitCode::SUCCESS;
    }
    println!("A row differs by more than it may.");
    ExitCode::FAILURE
}

/// In groups of three digits.
fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let comma = |i: usize| i > 0 && (digits.len() - i).is_multiple_of(3);
    let parts = digits.char_indices().map(|(i, digit)| {
        let before = if comma(i) { "," } else { "" };
        format!("{before}{digit}")
    });
    parts.collect()
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Whether the programs to measure against have their scenes' shapes alone.
fn with_few_shapes() -> bool {
    std::env::var_os("LUCARNE_SHAPES").is_some()
}

/// The program with one kernel alone. The flags are given to this crate only, and what it takes to build is
/// kept where the shipped program's is: the dependencies are built once.
fn build(folder: &Path, Alone { kernel, shapes, .. }: &Alone) -> PathBuf {
    let shipped = Path::new(env!("CARGO_BIN_EXE_lucarne"));
    let shared = shipped.ancestors().nth(2).expect("target/release/lucarne");
    let target = shared.join("one-kernel");
    fs::create_dir_all(&target).expect("a folder");
    let wrapper = target.join(format!("rustc-{kernel}"));
    let shapes = match with_few_shapes() {
        true => shapes.iter().map(|shape| format!(" --cfg 'lucarne_shape=\"{shape}\"'")).collect(),
        false => String::new(),
    };
    let few = if with_few_shapes() { " --cfg lucarne_only_shapes" } else { "" };
    let kernel_flag = format!("--cfg 'lucarne_only_kernel=\"{kernel}\"'");
    let script = format!("#!/bin/sh\nexec \"$@\" {kernel_flag}{few}{shapes}\n");
    fs::write(&wrapper, script).expect("a script written");
    executable(&wrapper);
    let status = Command::new(env!("CARGO"))
        .args(["build", "--quiet", "--release", "--bin", "lucarne", "--target-dir"])
        .arg(&target)
        .env("CARGO_BUILD_BUILD_DIR", shared)
        .env("RUSTC_WORKSPACE_WRAPPER", &wrapper)
        .current_dir(root())
        .status()
        .expect("cargo runs");
    assert!(status.success(), "no program with the kernel {kernel} alone");
    let program = folder.join(kernel);
    fs::copy(target.join("release/lucarne"), &program).expect("the program copied");
    program
}

#[cfg(unix)]
fn executable(script: &Path) {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(script, fs::Permissions::from_mode(0o755)).expect("made executable");
}

#[cfg(not(unix))]
fn executable(_: &Path) {}

/// Instructions of the frame loop.
fn instructions(folder: &Path, program: &Path, scene: &Path) -> u64 {
    let counts = folder.join("counts");
    let output = Command::new("valgrind")
        .arg("--tool=callgrind")
        .arg(format!("--toggle-collect={FRAME}"))
        .arg(format!("--callgrind-out-file={}", counts.display()))
        .arg(program)
        .args(["render", "--size", "160x120", "--antialias", "off", "--threads", "1", "-o"])
        .arg(folder.join("picture.png"))
        .arg(scene)
        .output()
        .expect("valgrind runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = fs::read_to_string(&counts).expect("counts");
    let total = text.lines().find_map(|line| line.strip_prefix("summary: "));
    let total = total.and_then(|n| n.trim().parse().ok()).expect("a sum of instructions");
    assert!(total > 1_000_000, "{total} instructions: `{FRAME}` was not found");
    total
}
