//! What an effect costs where nothing calls for it: instructions of the frame loop, in the shipped program
//! and in the same source built with one kernel alone.
//!
//! `cargo bench --bench effects`, with valgrind installed. **In:** scenes of `scenes/`. **Out:** a table,
//! and exit code 1 where a row differs by more than 0.1 %.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

/// The most that a row may differ, in parts of the whole.
const BAR: f64 = 1e-3;

/// Each kernel, and scenes below `scenes/` that it traces.
const SCENES: [(&str, &[&str]); 4] = [
    ("bare", &["seed/ambient", "atmosphere/background"]),
    ("shadows", &["directives/for", "transforms/rotate"]),
    ("secondary", &["seed/mirror"]),
    ("shadows+secondary", &["gallery/first", "finishes/reflection", "seed/mirror"]),
];

/// The function whose instructions are counted, with all that it calls.
const FRAME: &str = "lucarne::trace::frame";

fn main() -> ExitCode {
    if Command::new("valgrind").arg("--version").stdout(Stdio::null()).status().is_err() {
        println!("valgrind is not installed: no instructions counted");
        return ExitCode::SUCCESS;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let shipped = folder.path().join("shipped");
    fs::copy(env!("CARGO_BIN_EXE_lucarne"), &shipped).expect("the program copied");
    println!("instructions of the frame loop, 160×120, one ray a pixel, one thread");
    println!("{:24}{:20}{:>14}{:>14}{:>10}", "scene", "kernel", "shipped", "alone", "more");
    let mut worst = 0.0f64;
    for (kernel, scenes) in SCENES {
        let alone = build(folder.path(), kernel);
        for scene in scenes {
            let path = folder.path().join("a.scene");
            let mut text =
                fs::read_to_string(root().join(format!("scenes/{scene}.scene"))).expect("a scene");
            if kernel == "secondary" {
                // No scene of ours has mirrors and no shadow: this one has none any more.
                text =
                    format!("{}\n", text.replace("light_source", "#declare Lamp = light_source"));
            }
            fs::write(&path, text).expect("a scene written");
            let [shipped, alone] =
                [&shipped, &alone].map(|program| instructions(folder.path(), program, &path));
            let more = shipped as f64 / alone as f64 - 1.0;
            worst = worst.max(more.abs());
            println!("{scene:24}{kernel:20}{shipped:14}{alone:14}{:9.4} %", 100.0 * more);
        }
    }
    println!("largest difference {:.4} %, promised {} %", 100.0 * worst, 100.0 * BAR);
    if worst <= BAR { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The program with one kernel alone. The flag is given to this crate only, so that its dependencies are
/// built once.
fn build(folder: &Path, kernel: &str) -> PathBuf {
    let wrapper = folder.join(format!("rustc-{kernel}"));
    let script = format!("#!/bin/sh\nexec \"$@\" --cfg 'lucarne_only_kernel=\"{kernel}\"'\n");
    fs::write(&wrapper, script).expect("a script written");
    executable(&wrapper);
    let target = root().join("target/one-kernel");
    let status = Command::new(env!("CARGO"))
        .args(["build", "--quiet", "--release", "--bin", "lucarne", "--target-dir"])
        .arg(&target)
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
