//! Every file of code is a module of something that is built, and every measured table is read by a test.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::{assert_none, root};

/// All files below a folder with an extension.
fn below(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{folder:?}: {error}"));
    let mut found = Vec::new();
    for path in entries.map(|entry| entry.expect("readable").path()) {
        if path.is_dir() {
            found.extend(below(&path, extension));
        } else if path.extension().is_some_and(|its| its == extension) {
            found.push(path);
        }
    }
    found
}

/// The name in `mod name;`, public or not.
fn declared(line: &str) -> Option<&str> {
    let line = line.trim();
    let line = match line.strip_prefix("pub") {
        Some(rest) if rest.starts_with('(') => rest.split_once(')')?.1.trim_start(),
        Some(rest) => rest.trim_start(),
        None => line,
    };
    line.strip_prefix("mod ")?.strip_suffix(';')
}

/// The files of the modules that a file declares.
fn modules(file: &Path, is_root: bool) -> Vec<PathBuf> {
    let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{file:?}: {error}"));
    let parent = file.parent().expect("a folder");
    let is_mod = is_root || file.file_name().is_some_and(|name| name == "mod.rs");
    let folder = if is_mod { parent.to_owned() } else { file.with_extension("") };
    let mut path = None;
    let mut found = Vec::new();
    for line in text.lines() {
        if let Some(written) = line.trim().strip_prefix("#[path = \"") {
            path = written.strip_suffix("\"]");
        } else if let Some(name) = declared(line) {
            let plain = folder.join(format!("{name}.rs"));
            found.push(match path.take() {
                Some(path) => parent.join(path),
                None if plain.exists() => plain,
                None => folder.join(name).join("mod.rs"),
            });
        }
    }
    found
}

#[test]
fn every_file_of_code_is_a_module() {
    let mut roots = vec![root().join("src/lib.rs"), root().join("src/main.rs")];
    roots.push(root().join("tests/main.rs"));
    // Cargo builds each of these on its own.
    for folder in ["tests/benches", "tests/fuzz/fuzz_targets"] {
        let folder = root().join(folder);
        roots
            .extend(below(&folder, "rs").into_iter().filter(|file| file.parent() == Some(&folder)));
    }
    let real =
        |path: &Path| path.canonicalize().unwrap_or_else(|error| panic!("{path:?}: {error}"));
    let mut reached: BTreeSet<PathBuf> = roots.iter().map(|root| real(root)).collect();
    let mut left: Vec<_> = roots.into_iter().map(|root| (root, true)).collect();
    while let Some((file, is_root)) = left.pop() {
        let new = modules(&file, is_root).into_iter().filter(|module| reached.insert(real(module)));
        left.extend(new.map(|module| (module, false)));
    }
    let all = ["src", "tests"].map(|folder| below(&root().join(folder), "rs"));
    let lost = all.into_iter().flatten().filter(|file| !reached.contains(&real(file)));
    assert_none(lost.map(|file| format!("no module declares {}", file.display())).collect());
}

#[test]
fn every_table_is_read() {
    let code: Vec<String> = below(&root().join("src"), "rs")
        .into_iter()
        .map(|file| fs::read_to_string(file).expect("readable"))
        .collect();
    let lost = below(&root().join("src"), "txt").into_iter().filter(|table| {
        // A licence is for readers.
        if table.file_stem().is_some_and(|name| name.to_string_lossy().ends_with("LICENSE")) {
            return false;
        }
        let folder = table.parent().and_then(Path::file_name).expect("a folder").to_string_lossy();
        let name = table.file_name().expect("a name").to_string_lossy();
        // From beside the table, or from the folder above.
        let is_read = |code: &String| {
            code.split("include_").skip(1).any(|rest| {
                let argument = rest.split(')').next().unwrap_or(rest);
                let path = argument.split('"').nth(1).unwrap_or("");
                path == name || path.ends_with(&format!("{folder}/{name}"))
            })
        };
        !name.contains("LICENSE") && !code.iter().any(is_read)
    });
    assert_none(lost.map(|table| format!("nothing includes {}", table.display())).collect());
}
