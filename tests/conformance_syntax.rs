//! Every scene and include that ships with POV-Ray is read without a syntax error.
//!
//! Needs the Debian packages `povray-examples` and `povray-includes`; says so where they are missing.

use std::path::{Path, PathBuf};

use lucarne::diagnostic::{Diagnostics, Severity};
use lucarne::scene::Dialect;
use lucarne::source::{Source, Sources, decode};
use lucarne::syntax::{ParseOptions, parse};

const SCENES: &str = "/usr/share/doc/povray/examples";
const INCLUDES: &str = "/usr/share/povray-3.7/include";

/// A form to be filled in, not a scene; POV-Ray rejects it too.
const TEMPLATES: &[&str] = &["template.pov"];

fn files(folder: &Path, extensions: &[&str], found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            files(&path, extensions, found);
        } else if path.extension().is_some_and(|e| extensions.iter().any(|&x| e == x)) {
            found.push(path);
        }
    }
    found.sort();
}

/// The messages of each file that has errors.
fn errors(paths: &[PathBuf]) -> Vec<(PathBuf, Vec<String>)> {
    let mut bad = Vec::new();
    for path in paths {
        let Ok(bytes) = std::fs::read(path) else { continue };
        let (text, _) = decode(bytes);
        let mut sources = Sources::default();
        let file = sources.add(Source::new(path.display().to_string(), text));
        let source = sources.get(file);
        let mut diagnostics = Diagnostics::new(false);
        let options = ParseOptions { dialect: Dialect::Pov, ..ParseOptions::default() };
        parse(source, file, &options, &mut diagnostics);
        let messages: Vec<String> = diagnostics
            .iter()
            .filter(|d| d.severity == Severity::Error)
            .map(|d| {
                let place = d.primary().map(|l| source.position(l.span.start as usize));
                let line = place.map_or(0, |p| p.line);
                format!("line {line}: {} [{}]", d.message, d.code.name())
            })
            .collect();
        if !messages.is_empty() {
            bad.push((path.clone(), messages));
        }
    }
    bad
}

fn check(package: &str, folder: &str, extensions: &[&str], at_least: usize) {
    let mut paths = Vec::new();
    files(Path::new(folder), extensions, &mut paths);
    if paths.is_empty() {
        println!("not checked: the package `{package}` is not installed");
        return;
    }
    let bad = errors(&paths);
    let is_template = |path: &Path| TEMPLATES.iter().any(|t| path.ends_with(t));
    let (templates, faults): (Vec<_>, Vec<_>) = bad.iter().partition(|(p, _)| is_template(p));
    println!(
        "{package}: {} of {} files without a syntax error",
        paths.len() - bad.len(),
        paths.len()
    );
    for (path, messages) in &faults {
        println!("{}:", path.display());
        for message in messages.iter().take(4) {
            println!("    {message}");
        }
    }
    assert!(faults.is_empty(), "{} files have errors", faults.len());
    assert!(templates.len() <= TEMPLATES.len());
    assert!(paths.len() >= at_least, "only {} files found", paths.len());
}

#[test]
fn every_example_scene_is_read_without_an_error() {
    check("povray-examples", SCENES, &["pov"], 396);
}

#[test]
fn every_include_of_the_examples_is_read_without_an_error() {
    check("povray-examples", SCENES, &["inc"], 1);
}

#[test]
fn every_standard_include_is_read_without_an_error() {
    check("povray-includes", INCLUDES, &["inc", "map"], 40);
}
