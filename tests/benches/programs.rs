//! Runs lucarne, and POV-Ray 3.7 where it is installed, and reads the CPU seconds that they report.

use std::path::Path;
use std::process::{Command, Output};

/// CPU seconds of the stages that both programs have.
#[derive(Debug, Clone, Copy)]
pub struct Cost {
    /// Reading and building what rays search.
    pub prepare: f64,
    pub trace: f64,
    /// Rays of all kinds; 0 where it is not known.
    pub rays: f64,
}

impl Cost {
    /// Returns the least time of each stage.
    pub fn least(costs: impl Iterator<Item = Self>) -> Self {
        let none = Self { prepare: f64::INFINITY, trace: f64::INFINITY, rays: 0.0 };
        costs.fold(none, |least, cost| Self {
            prepare: least.prepare.min(cost.prepare),
            trace: least.trace.min(cost.trace),
            rays: cost.rays,
        })
    }
}

/// Renders a scene with one ray a pixel and on one thread, unless the flags say how many.
///
/// # Errors
/// Returns what the program said where it failed.
pub fn lucarne(
    source: &Path,
    picture: &Path,
    size: (u32, u32),
    flags: &[&str],
) -> Result<Cost, String> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucarne"));
    command.args(["render", "--stats=json"]);
    for own in ["--antialias=off", "--threads=1"] {
        let name = own.split('=').next().unwrap_or(own);
        command.args((!flags.iter().any(|flag| flag.starts_with(name))).then_some(own));
    }
    command.arg(format!("--size={}x{}", size.0, size.1)).args(flags);
    let output = ended(command.arg("-o").args([picture, source]))?;
    let stats: serde_json::Value =
        serde_json::from_slice(&output.stdout).map_err(|error| error.to_string())?;
    let seconds = |key: &str| stats[key].as_f64().ok_or_else(|| format!("no `{key}`"));
    let mut prepare = 0.0;
    for stage in ["parse_cpu_s", "evaluate_cpu_s", "lower_cpu_s", "build_cpu_s"] {
        prepare += seconds(stage)?;
    }
    let rays = stats["rays"].as_object().into_iter().flat_map(|rays| rays.values());
    let rays = rays.filter_map(serde_json::Value::as_f64).sum();
    Ok(Cost { prepare, trace: seconds("trace_cpu_s")?, rays })
}

/// As [`lucarne`], by POV-Ray.
///
/// # Errors
/// Returns what the program said where it failed.
pub fn povray(
    source: &Path,
    picture: &Path,
    size: (u32, u32),
    flags: &[&str],
) -> Result<Cost, String> {
    let mut command = Command::new("povray");
    command.args(["+WT1", "-A", "-D", "+FN", "-V"]).args(flags);
    command.args([format!("+W{}", size.0), format!("+H{}", size.1)]);
    command.arg(format!("+I{}", source.display())).arg(format!("+O{}", picture.display()));
    let output = ended(&mut command)?;
    let report = String::from_utf8_lossy(&output.stderr);
    // Of the line behind the heading: `using 1 thread(s) with 0.132 CPU-seconds total`.
    let seconds = |heading: &str| {
        let part = report.split(heading).nth(1)?.split("with ").nth(1)?;
        part.split(' ').next()?.parse::<f64>().ok()
    };
    let trace = seconds("Trace Time:").ok_or("no time of tracing")?;
    let prepare = ["Parse Time:", "Bounding Time:"].into_iter().filter_map(seconds).sum();
    Ok(Cost { prepare, trace, rays: 0.0 })
}

/// The line in which POV-Ray names itself, if it is installed.
pub fn povray_version() -> Option<String> {
    let output = Command::new("povray").arg("--version").output().ok()?;
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    text.lines().find(|line| line.contains("POV-Ray")).map(str::to_owned)
}

fn ended(command: &mut Command) -> Result<Output, String> {
    let output = command.output().map_err(|error| error.to_string())?;
    match output.status.success() {
        true => Ok(output),
        false => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
    }
}
