//! lucarne beside POV-Ray: what it makes of the scenes and includes that ship with it.
//!
//! Needs the Debian packages `povray-examples` and `povray-includes`; says so where they are missing,
//! and fails there with `LUCARNE_CONFORMANCE=required`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::programs::is_installed;

mod alpha;
mod cameras;
mod drawn;
mod examples;
mod lights;
mod noisy;
mod pictures;
mod plain;
mod proofs;
mod sky;
mod syntax;
mod textures;

const SCENES: &str = "/usr/share/doc/povray/examples";
const INCLUDES: &str = "/usr/share/povray-3.7/include";

/// All files below a folder with one of these extensions, sorted.
fn files(folder: &str, extensions: &[&str]) -> Vec<PathBuf> {
    fn walk(folder: &Path, extensions: &[&str], found: &mut Vec<PathBuf>) {
        let Ok(entries) = std::fs::read_dir(folder) else { return };
        for entry in entries.flatten() {
            let path = entry.path();
            if path.is_dir() {
                walk(&path, extensions, found);
            } else if path.extension().is_some_and(|e| extensions.iter().any(|&x| e == x)) {
                found.push(path);
            }
        }
    }
    let mut found = Vec::new();
    walk(Path::new(folder), extensions, &mut found);
    found.sort();
    found
}

/// A list's lines by scene: what becomes of it, and what is said of that after `—`.
fn listed(list: &str) -> BTreeMap<&str, (&str, Option<&str>)> {
    let lines = list.lines().filter_map(|line| line.split_once(": "));
    lines
        .map(|(name, rest)| match rest.split_once(" — ") {
            Some((outcome, said)) => (name, (outcome, Some(said))),
            None => (name, (rest, None)),
        })
        .collect()
}

/// What stands on a line of a list now and did not before. An update takes away and adds nothing: a line
/// that must grow is taken out of the list by hand first, and what is wrong is said behind it.
fn grown<'a>(was: &str, now: &'a str) -> Vec<&'a str> {
    let before: BTreeSet<&str> = was.split_whitespace().collect();
    let number = |text: &str| text.parse::<f64>().ok();
    let is_new = |word: &&str| {
        let lower = number(word).zip(number(was)).is_some_and(|(now, was)| now <= was);
        !["same", "whole"].contains(word) && !before.contains(word) && !lower
    };
    match was {
        "not listed" => Vec::new(),
        _ => now.split_whitespace().filter(is_new).collect(),
    }
}

#[test]
fn a_list_shrinks_and_never_grows() {
    assert_eq!(grown("bozo fog", "fog"), [""; 0]);
    assert_eq!(grown("bozo", "whole"), [""; 0]);
    assert_eq!(grown("whole", "bozo"), ["bozo"]);
    assert_eq!(grown("bozo", "bozo ! wrong-type 1:2"), ["!", "wrong-type", "1:2"]);
    assert_eq!(grown("0.07", "0.06"), [""; 0]);
    assert_eq!(grown("0.06", "0.07"), ["0.07"]);
    assert_eq!(grown("same", "0.06"), ["0.06"]);
    assert_eq!(grown("same", "same without normal bumps"), ["without", "normal", "bumps"]);
    assert_eq!(grown("not listed", "0.2"), [""; 0]);
}
