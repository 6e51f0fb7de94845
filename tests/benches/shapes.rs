//! What a ray costs by shape, beside POV-Ray: the scenes of `scenes/shapes`, each rendered by both.
//!
//! `cargo bench --bench shapes` prints the table of `docs/numerics.md`; with words of shapes behind `--`,
//! those alone. Needs `povray`. A scene is read by both as a `.pov`, so that they show the same picture, at
//! 640×480 without antialiasing on one thread; seconds are those of the processor for tracing, without reading
//! and without what prepares the scene, as each program counts them, the least of three runs, or one that takes [`LONG`].

#[allow(dead_code, reason = "each benchmark uses a part")]
#[path = "programs.rs"]
mod programs;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

const SIZE: (u32, u32) = (640, 480);
const RUNS: usize = 3;
/// Seconds of a run that stands alone.
const LONG: f64 = 5.0;

/// What POV-Ray reads otherwise, and how it is written for both.
const FOR_BOTH: [(&str, &str); 5] = [
    ("], #end", "] #end"),
    ("), #end", ") #end"),
    ("text { \"", "text { ttf \"DejaVuSerif.ttf\" \""),
    ("text {\n  \"", "text {\n  ttf \"DejaVuSerif.ttf\" \""),
    ("bicubic_patch {\n  <", "bicubic_patch {\n  type 1 u_steps 4 v_steps 4 flatness 0\n  <"),
];
const HEAD: &str = "#version 3.7; global_settings { assumed_gamma 1 }\n";

fn main() -> ExitCode {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let asked: Vec<String> =
        std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let scenes = std::fs::read_dir(root.join("scenes/shapes")).expect("the scenes");
    let mut scenes: Vec<PathBuf> = scenes.map(|entry| entry.expect("a file").path()).collect();
    scenes.retain(|path| path.extension().is_some_and(|extension| extension == "scene"));
    scenes.sort();
    println!("| shape | POV-Ray | here | here / POV-Ray |\n|---|---:|---:|---:|");
    let mut rows = Vec::new();
    for path in scenes {
        let word = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        // POV-Ray reads no files of meshes.
        if word == "mesh_file" || (!asked.is_empty() && !asked.contains(&word)) {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a scene");
        let text = FOR_BOTH.iter().fold(text, |text, (from, to)| text.replace(from, to));
        let place = tempfile::tempdir().expect("a folder");
        let scene = place.path().join("both.pov");
        std::fs::write(&scene, format!("{HEAD}{text}")).expect("written");
        let least = |seconds: &dyn Fn() -> Option<f64>| {
            let mut least = seconds()?;
            for _ in 1..if least < LONG { RUNS } else { 1 } {
                least = least.min(seconds()?);
            }
            Some(least)
        };
        let fonts = root.join("src/font");
        let [theirs, ours] = [true, false].map(|there| least(&|| seconds(&scene, &fonts, there)));
        match (theirs, ours) {
            (Some(theirs), Some(ours)) => rows.push((ours / theirs, word, theirs, ours)),
            (theirs, ours) => {
                eprintln!("{word}: no seconds of POV-Ray's {theirs:?}, or here {ours:?}")
            }
        }
    }
    rows.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (ratio, word, theirs, ours) in rows {
        println!("| {word} | {theirs:.2} | {ours:.2} | {ratio:.2} |");
    }
    ExitCode::SUCCESS
}

/// CPU seconds of tracing by lucarne or, if `there`, by POV-Ray; `None` where that fails.
fn seconds(scene: &Path, fonts: &Path, there: bool) -> Option<f64> {
    let (picture, fonts) = (scene.with_extension("png"), fonts.display());
    let cost = match there {
        true => programs::povray(scene, &picture, SIZE, &[&format!("+L{fonts}")]),
        false => programs::lucarne(scene, &picture, SIZE, &[&format!("-I{fonts}")]),
    };
    cost.map(|cost| cost.trace).ok()
}
