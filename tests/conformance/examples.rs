//! Every example of POV-Ray runs through, or is told what of it is not built yet: `examples.list` has a line
//! for each, and counts down.
//!
//! A line is the scene and the words it lacks, or `whole`. A scene with other errors has, after `!`, their
//! code and place: of these some are POV-Ray's own errors, and say so after `—`. `LUCARNE_UPDATE=1` writes the list
//! anew, and keeps what is said.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

use serde_json::Value;

use super::{SCENES, files, grown, is_installed, listed};

const LIST: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/conformance/examples.list");

/// What becomes of a scene, as its line has it.
fn outcome(path: &Path) -> String {
    // Some write files, and read them again.
    let place = tempfile::tempdir().expect("a folder");
    let run = Command::new(env!("CARGO_BIN_EXE_lucarne"))
        .args(["check", "--message-format", "json", "--allow-write"])
        .arg(path)
        .current_dir(&place)
        .output()
        .expect("it runs");
    assert!(run.status.code().is_some_and(|code| code < 70), "{path:?}: {:?}", run.status);
    let (mut lacks, mut errors) = (BTreeSet::new(), Vec::new());
    for line in String::from_utf8_lossy(&run.stdout).lines() {
        let told: Value = serde_json::from_str(line).expect("JSON");
        let text = |key: &str| told[key].as_str().unwrap_or_default();
        if text("severity") != "error" {
            continue;
        }
        if text("code") == "not-supported-yet" {
            let word = text("message").split('`').nth(1).unwrap_or(text("message"));
            lacks.insert(word.to_owned());
        } else {
            let place = &told["labels"][0];
            let file = place["file"].as_str().unwrap_or_default();
            let file = match Path::new(file) == path {
                true => String::new(),
                false => format!("{}:", Path::new(file).file_name().unwrap_or_default().display()),
            };
            errors.push(format!("{} {file}{}:{}", text("code"), place["line"], place["column"]));
        }
    }
    if lacks.is_empty() && errors.is_empty() {
        return "whole".to_owned();
    }
    let mut line = lacks.into_iter().collect::<Vec<_>>().join(" ");
    for error in errors {
        let _ = write!(line, " ! {error}");
    }
    line.trim().to_owned()
}

/// All outcomes, by the scene's path below the examples.
fn outcomes(paths: &[PathBuf]) -> BTreeMap<String, String> {
    let (next, found) = (Mutex::new(paths.iter()), Mutex::new(BTreeMap::new()));
    let work = || {
        loop {
            let Some(path) = next.lock().expect("no panic before").next() else { break };
            let name = path.strip_prefix(SCENES).expect("below").display().to_string();
            let line = outcome(path);
            found.lock().expect("no panic before").insert(name, line);
        }
    };
    std::thread::scope(|scope| {
        let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
        (0..cores).for_each(|_| drop(scope.spawn(work)));
    });
    found.into_inner().expect("no panic before")
}

#[test]
fn every_example_is_whole_or_lacks_what_the_list_says() {
    let paths = files(SCENES, &["pov"]);
    if !is_installed("povray-examples", &paths) {
        return;
    }
    let list = std::fs::read_to_string(LIST).unwrap_or_default();
    let listed = listed(&list);
    let found = outcomes(&paths);
    let (mut text, mut wrong, mut more) = (String::new(), String::new(), String::new());
    for (name, outcome) in &found {
        let (was, said) = listed.get(name.as_str()).copied().unwrap_or(("not listed", None));
        let said = said.map_or(String::new(), |said| format!(" — {said}"));
        let _ = writeln!(text, "{name}: {outcome}{said}");
        if was != outcome {
            let _ = writeln!(wrong, "{name}:\n  was {was}\n  now {outcome}");
            if !grown(was, outcome).is_empty() {
                let _ = writeln!(more, "{name}:\n  was {was}\n  now {outcome}");
            }
        }
    }
    let whole = found.values().filter(|outcome| *outcome == "whole").count();
    println!("{whole} of {} examples are whole", found.len());
    if std::env::var_os("LUCARNE_UPDATE").is_some() {
        assert!(more.is_empty(), "an update adds nothing to the list\n{more}");
        std::fs::write(LIST, text).expect("the list is written");
        return;
    }
    assert!(wrong.is_empty(), "`LUCARNE_UPDATE=1` writes the list anew\n{wrong}");
}
