//! Both programs and what they make of a scene; `conformance` and `povray` hold the pictures side by side.

use std::path::{Path, PathBuf};
use std::process::Command;

use image::RgbImage;

use crate::flip;

/// The mean of FLIP's errors up to which two pictures are the same.
pub const SAME: f32 = 0.05;

/// Width and height in pixels.
pub type Size = [u32; 2];

/// Whether a package is there, by the files it brings; where it must be, it is a failure if not.
pub fn is_installed(package: &str, files: &[PathBuf]) -> bool {
    if files.is_empty() {
        let required = std::env::var_os("LUCARNE_CONFORMANCE").is_some_and(|v| v == "required");
        assert!(!required, "the package `{package}` is not installed");
        println!("not checked: the package `{package}` is not installed");
    }
    !files.is_empty()
}

/// Whether there is a POV-Ray to run.
pub fn is_povray_there() -> bool {
    let is_there = Command::new("povray").arg("--version").output().is_ok();
    is_there || is_installed("povray", &[])
}

/// A picture by one of the two, or what it said instead.
fn picture(run: &mut Command, file: &Path) -> Result<RgbImage, String> {
    let told = run.output().expect("it runs");
    let lines = String::from_utf8_lossy(&told.stderr).into_owned();
    let last = || lines.lines().rev().take(8).collect::<Vec<_>>().join(" / ");
    let picture = image::open(file).map_err(|_| last())?.into_rgb8();
    if told.status.success() { Ok(picture) } else { Err(last()) }
}

/// Our picture of a scene; what it names lies in that folder.
pub fn ours(scene: &Path, folder: &Path, [width, height]: Size) -> Result<RgbImage, String> {
    let place = tempfile::tempdir().expect("a folder");
    let file = place.path().join("ours.png");
    let mut run = Command::new(env!("CARGO_BIN_EXE_lucarne"));
    run.current_dir(&place).arg("render").arg(scene).arg("-o").arg(&file).arg("-I").arg(folder);
    run.args(["--size", &format!("{width}x{height}"), "--antialias", "off", "--allow-write"]);
    picture(&mut run, &file)
}

/// POV-Ray's.
pub fn theirs(scene: &Path, folder: &Path, [width, height]: Size) -> Result<RgbImage, String> {
    let place = tempfile::tempdir().expect("a folder");
    let file = place.path().join("theirs.png");
    let mut run = Command::new("povray");
    run.current_dir(&place).args(["-D", "-GA", "-A"]).args([
        format!("+I{}", scene.display()),
        format!("+O{}", file.display()),
        format!("+L{}", folder.display()),
        format!("+W{width}"),
        format!("+H{height}"),
    ]);
    picture(&mut run, &file).map_err(|told| format!("POV-Ray: {told}"))
}

/// The mean of FLIP's errors.
pub fn mean_error(pictures: &[RgbImage; 2]) -> f32 {
    flip::mean(&flip::errors(pictures))
}
