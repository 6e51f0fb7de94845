//! The rules of the house, as data: which room may use which, and what stays behind its one door.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use lucarne::diagnostic::Code;
use lucarne::vocabulary::{Family, Role, Word};

mod adding;
mod modules;

/// Every room of `src/`, from the ground up, and the rooms it may use. A circle cannot be written.
const ROOMS: &[(&str, &[&str])] = &[
    // ground
    ("math", &[]),
    ("color", &["math"]),
    ("bvh", &["math"]),
    // words
    ("source", &[]),
    ("vocabulary", &[]),
    ("standard", &[]),
    ("diagnostic", &["source"]),
    ("disk", &["diagnostic", "source", "vocabulary"]),
    // things
    ("noise", &["math"]),
    ("pattern", &["math", "noise"]),
    ("spline", &["math"]),
    ("function", &["math", "noise"]),
    ("texture", &["color", "function", "math", "noise", "pattern", "spline"]),
    ("shape", &["bvh", "function", "math", "texture"]),
    // nouns
    ("scene", &["color", "math", "noise", "pattern", "source", "texture", "vocabulary"]),
    ("world", &["color", "math", "noise", "pattern", "shape", "source", "texture"]),
    ("geometry", &["bvh", "math", "shape", "world"]),
    ("plan", &["color", "math", "pattern", "shape", "source", "world"]),
    ("film", &["color", "math", "plan"]),
    // Pictures of textures have an encoding.
    ("picture", &["color", "film", "plan", "texture"]),
    // verbs
    ("mesh_file", &["color", "math", "scene"]),
    ("font", &["scene"]),
    ("syntax", &["color", "source", "vocabulary", "diagnostic"]),
    (
        "lower",
        &[
            "color",
            "diagnostic",
            // Whether anything is in view.
            "geometry",
            "math",
            "noise",
            "pattern",
            "scene",
            "shape",
            "source",
            "texture",
            "vocabulary",
            "world",
        ],
    ),
    (
        "evaluate",
        &[
            "color",
            "diagnostic",
            "math",
            "mesh_file",
            "noise",
            "pattern",
            // Heights are read from pictures.
            "picture",
            "scene",
            "source",
            "standard",
            "syntax",
            "vocabulary",
            "font",
            "function",
            "spline",
            // `trace()`, `inside()`, `min_extent()` and `max_extent()` look at what was declared.
            "geometry",
            "lower",
            "shape",
            "texture",
            "world",
        ],
    ),
    (
        "trace",
        &[
            "color", "film", "geometry", "math", "noise", "pattern", "plan", "shape", "source",
            "texture", "world",
        ],
    ),
    // road
    (
        "road",
        &[
            "diagnostic",
            "evaluate",
            "film",
            "lower",
            "plan",
            "scene",
            "source",
            "syntax",
            "trace",
            "vocabulary",
            "world",
        ],
    ),
    ("render", &["diagnostic", "film", "picture", "plan", "road", "scene", "source", "trace"]),
    ("pilot", &["math", "plan", "trace", "world"]),
    ("accuracy", &["color", "film", "geometry", "math", "plan", "trace", "world"]),
    ("lib", &["diagnostic", "render"]),
    // doors: they use the library from outside, as anyone would
    ("cli", &[]),
    ("main", &["cli"]),
];

/// Outside crates, and the places that may name each.
const DOORS: &[(&str, &[&str])] = &[
    ("pest", &["syntax/"]),
    ("pest_derive", &["syntax/"]),
    ("fearless_simd", &["math/wide.rs"]),
    ("glam", &["math/vector.rs"]),
    ("libm", &["math/elementary.rs"]),
    ("miette", &["diagnostic/render"]),
    ("serde", &["diagnostic/json.rs", "accuracy/json.rs", "cli/"]),
    ("serde_json", &["diagnostic/json.rs", "diagnostic/sarif.rs", "accuracy/json.rs", "cli/"]),
    // Lists that are mostly short, where crossings are found.
    ("rustc_hash", &["lower/"]),
    (
        "smallvec",
        &[
            "bvh/",
            "function/",
            "geometry/",
            "lower/",
            "math/roots/",
            "shape/",
            "texture/",
            "trace/",
        ],
    ),
    ("strsim", &["diagnostic/suggest.rs"]),
    // How wide what miette draws is.
    ("unicode_width", &["diagnostic/cut.rs"]),
    ("stacker", &["evaluate/"]),
    ("gif", &["picture"]),
    ("exr", &["picture"]),
    ("image", &["picture"]),
    ("ttf_parser", &["font/"]),
    ("png", &["picture"]),
    ("gltf", &["mesh_file/glb.rs", "mesh_file/gltf2.rs"]),
    ("ply_rs_bw", &["mesh_file/ply.rs"]),
    ("rayon", &["trace/"]),
    ("stl_io", &["mesh_file/stl.rs"]),
    ("clap", &["cli/", "main.rs"]),
    ("clap_complete", &["cli/"]),
    ("clap_mangen", &["cli/"]),
    ("indicatif", &["cli/"]),
    ("ctrlc", &["cli/"]),
    ("memory_stats", &["cli/stop.rs"]),
    ("nix", &["cli/"]),
    ("similar", &["cli/"]),
    ("tempfile", &["cli/"]),
    ("terminal_size", &["cli/"]),
];

/// What only the doors may do.
const DOORS_ONLY: &[&str] = &[
    "println!",
    "eprintln!",
    "print!(",
    "eprint!(",
    "std::fs",
    "std::env",
    "process::exit",
    "std::io::std",
];

/// Functions whose last bit depends on the machine: only `math/elementary.rs` wraps them.
const ELEMENTARY: &[&str] = &[
    ".sin()",
    ".cos()",
    ".tan()",
    ".sin_cos()",
    ".asin()",
    ".acos()",
    ".atan()",
    ".atan2(",
    ".sinh()",
    ".cosh()",
    ".tanh()",
    ".powf(",
    ".powi(",
    ".exp()",
    ".exp2()",
    ".ln()",
    ".log(",
    ".log2()",
    ".log10()",
    ".cbrt()",
    ".hypot(",
];

/// "About 400": with what `rustfmt` makes of it.
const LONGEST_FILE: usize = 430;

const EMPTY_NAMES: &[&str] = &[
    "core", "base", "common", "util", "utils", "helper", "helpers", "misc", "types", "manager",
    "engine", "context",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files of a folder with one of these extensions: their path below it, and their text.
fn files(folder: &str, extensions: &[&str]) -> Vec<(String, String)> {
    let top = root().join(folder);
    let mut paths: Vec<PathBuf> = Vec::new();
    let mut folders = vec![top.clone()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap_or_else(|error| panic!("{folder:?}: {error}")) {
            let path = entry.expect("readable").path();
            let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or("");
            if path.is_dir() {
                folders.push(path);
            } else if extensions.contains(&extension) {
                paths.push(path);
            }
        }
    }
    let for_tests = modules_for_tests(&paths);
    // Files of tests live by the rules of tests.
    let is_test = |path: &Path| {
        for_tests.iter().any(|test| path.starts_with(test) || path.with_extension("") == *test)
    };
    paths.retain(|path| !is_test(path));
    paths.sort();
    let name =
        |path: &Path| path.strip_prefix(&top).expect("below").to_string_lossy().replace('\\', "/");
    paths.iter().map(|path| (name(path), fs::read_to_string(path).expect("readable"))).collect()
}

/// The modules declared behind `#[cfg(test)]`, as paths without extension.
fn modules_for_tests(paths: &[PathBuf]) -> Vec<PathBuf> {
    let mut modules = Vec::new();
    for path in
        paths.iter().filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
    {
        let text = fs::read_to_string(path).expect("readable");
        let folder = match path.file_stem().and_then(|stem| stem.to_str()) {
            Some("mod" | "lib" | "main") => path.parent().expect("a folder").to_owned(),
            _ => path.with_extension(""),
        };
        for (at, mark) in text.match_indices(
            "#[cfg(test)]
",
        ) {
            let declaration = text[at + mark.len()..].lines().next().unwrap_or("");
            let name = declaration
                .trim_start_matches("pub(crate) ")
                .trim_start_matches("pub(super) ")
                .strip_prefix("mod ");
            if let Some(name) = name.and_then(|name| name.strip_suffix(';')) {
                modules.push(folder.join(name));
            }
        }
    }
    modules
}

fn room(file: &str) -> &str {
    file.split('/').next().map_or(file, |first| first.strip_suffix(".rs").unwrap_or(first))
}

/// The code of a file: no comments, no tests.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap_or(text);
    text.lines().map(|line| line.split("//").next().unwrap_or(line)).collect::<Vec<_>>().join("\n")
}

/// The rooms named after `crate::`, alone or in braces.
fn uses(code: &str) -> Vec<String> {
    let name = |text: &str| {
        text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>()
    };
    let mut rooms = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        let rest = &code[at + "crate::".len()..];
        let Some(group) = rest.strip_prefix('{') else {
            rooms.push(name(rest));
            continue;
        };
        let (mut depth, mut start) = (0usize, true);
        for (i, c) in group.char_indices() {
            match c {
                '{' => depth += 1,
                '}' if depth == 0 => break,
                '}' => depth -= 1,
                ',' if depth == 0 => start = true,
                c if start && c.is_alphabetic() => {
                    rooms.push(name(&group[i..]));
                    start = false;
                }
                _ => {}
            }
        }
    }
    rooms.retain(|room| !room.is_empty());
    rooms
}

fn assert_none(faults: Vec<String>) {
    assert!(faults.is_empty(), "\n{}\n", faults.join("\n"));
}

#[test]
fn a_room_uses_only_the_rooms_the_table_lists() {
    let table: BTreeMap<&str, &[&str]> = ROOMS.iter().copied().collect();
    let mut faults = Vec::new();
    for (file, text) in files("src", &["rs"]) {
        let room = room(&file);
        let Some(allowed) = table.get(room) else {
            faults.push(format!("{file}: the room `{room}` is not in the table"));
            continue;
        };
        for used in uses(&code(&text)) {
            if used != room && !allowed.contains(&used.as_str()) {
                faults.push(format!("{file}: `{room}` may not use `{used}`"));
            }
        }
    }
    assert_none(faults);
}

#[test]
fn the_table_has_no_circle() {
    for (index, (room, allowed)) in ROOMS.iter().enumerate() {
        for used in *allowed {
            let at =
                ROOMS.iter().position(|(other, _)| other == used).expect("a room of the table");
            assert!(at < index, "`{room}` uses `{used}`, which does not stand below it");
        }
    }
}

#[test]
fn the_reader_of_uses_finds_them_alone_and_in_braces() {
    let text = "use crate::math::{a, b};\nuse crate::{color::Rgb, shape::{Ray, Chord}, world};\ncrate::film::x()";
    assert_eq!(uses(text), ["math", "color", "shape", "world", "film"]);
    assert!(uses(&code("// crate::math\nlet a = 1; // crate::color")).is_empty());
}

#[test]
fn an_outside_crate_is_named_at_its_door_only() {
    let mut faults = Vec::new();
    for (file, text) in files("src", &["rs"]) {
        let code = code(&text);
        for (name, doors) in DOORS {
            let named = code.match_indices(&format!("{name}::")).any(|(at, _)| {
                let before = code[..at].chars().next_back();
                !before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':')
            });
            if named && !doors.iter().any(|door| file.starts_with(door)) {
                faults.push(format!("{file}: names `{name}`, whose door is {doors:?}"));
            }
        }
    }
    assert_none(faults);
}

#[test]
fn every_outside_crate_has_its_doors() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("readable");
    let mut crates = Vec::new();
    let mut is_listed = false;
    for line in manifest.lines() {
        if line.starts_with('[') {
            is_listed = line.ends_with("dependencies]") && !line.contains("dev-");
        } else if let (true, Some((name, _))) = (is_listed, line.split_once(" = ")) {
            crates.push(name.replace('-', "_"));
        }
    }
    assert!(crates.len() > 20, "{crates:?}");
    crates.retain(|name| DOORS.iter().all(|(known, _)| known != name));
    assert_none(crates);
}

#[test]
fn only_the_doors_print_read_disks_or_exit() {
    let mut faults = Vec::new();
    for (file, text) in files("src", &["rs"]) {
        if file.starts_with("cli/") || file == "main.rs" {
            continue;
        }
        // Reads the files that a scene names, for any program.
        let is_disk = file.starts_with("disk");
        let code = code(&text);
        faults.extend(
            DOORS_ONLY
                .iter()
                .filter(|word| code.contains(*word) && !(is_disk && **word == "std::fs"))
                .map(|word| format!("{file}: `{word}`")),
        );
    }
    assert_none(faults);
}

#[test]
fn elementary_functions_are_called_through_one_room_only() {
    let mut faults = Vec::new();
    for (file, text) in files("src", &["rs"]) {
        if file == "math/elementary.rs" {
            continue;
        }
        let code = code(&text);
        faults.extend(
            ELEMENTARY
                .iter()
                .filter(|call| code.contains(*call))
                .map(|call| format!("{file}: `{call}`")),
        );
    }
    assert_none(faults);
}

/// What stands at the top beside files whose names begin with a dot.
const TOP: &[&str] = &[
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "README.md",
    "docs",
    "grammar",
    "scenes",
    "src",
    "target",
    "tests",
];

#[test]
fn the_top_level_holds_what_it_is_meant_to() {
    let ignored = fs::read_to_string(root().join(".gitignore")).expect("readable");
    let is_ignored = |name: &str| match name.rsplit_once('.') {
        Some((_, kind @ ("png" | "scene"))) => ignored.contains(&format!("/*.{kind}\n")),
        _ => ignored.contains(&format!("/{name}\n")),
    };
    let entries = fs::read_dir(root()).expect("readable");
    let names = entries.map(|one| one.expect("readable").file_name().into_string().expect("UTF-8"));
    let stray = |name: &String| {
        !name.starts_with('.') && !TOP.contains(&name.as_str()) && !is_ignored(name)
    };
    assert_none(names.filter(stray).collect());
}

#[test]
fn files_stay_short() {
    // Tables and tests are read by the row.
    let long = files("src", &["rs"]).into_iter().filter(|(file, text)| {
        let by_the_row = file.ends_with("tests.rs") || file.contains("tests/");
        !by_the_row && file != "vocabulary/words.rs" && text.lines().count() > LONGEST_FILE
    });
    assert_none(
        long.map(|(file, text)| format!("{file}: {} lines", text.lines().count())).collect(),
    );
}

#[test]
fn every_file_opens_with_its_one_idea() {
    let faults = files("src", &["rs"]).into_iter().filter(|(_, text)| !text.starts_with("//! "));
    assert_none(faults.map(|(file, _)| file).collect());
}

#[test]
fn no_room_is_named_after_nothing() {
    let empty = |part: &str| EMPTY_NAMES.contains(&part.strip_suffix(".rs").unwrap_or(part));
    let faults = files("src", &["rs"]).into_iter().filter(|(file, _)| file.split('/').any(empty));
    assert_none(faults.map(|(file, _)| file).collect());
}

#[test]
fn every_diagnostic_code_has_a_page() {
    let missing =
        |code: &&Code| !root().join(format!("docs/diagnostics/{}.md", code.name())).exists();
    assert_none(Code::ALL.iter().filter(missing).map(|code| code.name().to_owned()).collect());
}

#[test]
fn the_page_of_an_opinion_says_where_it_is_a_warning() {
    let says = "In a `.pov` that POV-Ray renders all the same, it is a warning";
    let is_silent =
        |code: &&Code| !code.page().split_whitespace().collect::<Vec<_>>().join(" ").contains(says);
    let opinions = Code::ALL.iter().filter(|code| code.is_opinion());
    assert_none(opinions.filter(is_silent).map(|code| code.name().to_owned()).collect());
}

/// Directives that make sense together only, and are shown together.
const SHOWN_TOGETHER: &[&str] = &[
    "debug",
    "warning",
    "render",
    "statistics",
    "else",
    "elseif",
    "end",
    "break",
    "case",
    "range",
    "ifndef",
    "read",
    "write",
    "append",
    "fclose",
];

#[test]
fn every_built_word_has_an_example_among_the_scenes() {
    let scenes = files("scenes", &["scene", "inc"]);
    let words: BTreeSet<&str> = scenes
        .iter()
        .flat_map(|(_, text)| text.split(|c: char| !c.is_alphanumeric() && c != '_'))
        .collect();
    let stems: BTreeSet<&str> = scenes
        .iter()
        .filter_map(|(file, _)| file.rsplit('/').next()?.strip_suffix(".scene"))
        .collect();
    let mut faults = Vec::new();
    for word in Word::ALL.iter().filter(|word| word.is_built()) {
        let name = word.name();
        // Functions share a scene a family, which need not show each.
        let function = matches!(word.role(), Role::Function { .. });
        if !function && !words.contains(name) {
            faults.push(format!("`{name}` is in no scene below scenes/"));
        }
        let wants_its_own =
            matches!(word.family(), Family::Shape | Family::Csg | Family::Directive);
        if wants_its_own && !SHOWN_TOGETHER.contains(&name) && !stems.contains(name) {
            faults.push(format!("`{name}` has no scene `{name}.scene` of its own"));
        }
    }
    assert_none(faults);
}

/// What may round otherwise on another processor. A fused operation that is written out rounds alike
/// on all, but is slow on some: only numbers of twice the digits are made so.
const FUSED: &[&str] = &[
    "mul_add",
    "fma(",
    "fmaf(",
    "algebraic_",
    "fadd_fast",
    "fmul_fast",
    "target_feature",
    "target_arch",
    "::arch::",
];

#[test]
fn row_72_nothing_is_fused_nor_left_to_a_processor() {
    let mut faults = Vec::new();
    for (file, text) in files("src", &["rs"]) {
        let code = code(&text);
        let allowed = |word: &str| file == "math/double.rs" && word == "mul_add";
        let fused = FUSED.iter().filter(|word| code.contains(*word) && !allowed(word));
        faults.extend(fused.map(|word| format!("{file}: `{word}`")));
    }
    assert_none(faults);
    assert!(code("let a = b.mul_add(c, d);").contains(FUSED[0]));
}

/// The test of a snapshot, and the case that the test was run on, if it has several.
fn test_and_case(snapshot: &str) -> (&str, Option<&str>) {
    let name = snapshot.rsplit('/').next().unwrap_or(snapshot).trim_end_matches(".snap");
    let (name, case) = name.split_once('@').map_or((name, None), |(name, case)| (name, Some(case)));
    (name.rsplit_once("__").map_or(name, |(_, test)| test), case)
}

#[test]
fn every_snapshot_is_of_a_test() {
    let texts = ["src/syntax/tests.rs", "tests/snapshots.rs"];
    let texts = texts.map(|file| fs::read_to_string(root().join(file)).expect("readable")).concat();
    let is_lone = |(file, _): &(String, String)| {
        let (test, case) = test_and_case(file);
        let is_case = case.is_none_or(|case| root().join("tests/cases").join(case).exists());
        // A test of its own, or an entry of the macro `snapshots!`.
        let is_test = [format!("fn {test}("), format!("    {test}: ")];
        !is_case || !is_test.iter().any(|text| texts.contains(text))
    };
    let snapshots = ["src", "tests"].map(|folder| files(folder, &["snap", "new"])).into_iter();
    let lone = snapshots.flatten().filter(is_lone);
    assert_none(lone.map(|(file, _)| format!("{file}: no test makes it")).collect());
    assert_eq!(test_and_case("a/b__tests__some.snap"), ("some", None));
    assert_eq!(test_and_case("a/b__tests__each@some.scene.snap"), ("each", Some("some.scene")));
}

/// Phrases that make prose hard to read, and stand where a subject and a verb belong.
const STUMBLES: &[&str] = &[
    "that which",
    "of which nothing",
    "to be said of",
    "is told of",
    "So are ",
    "So is it",
    "Of each ",
    "Of all ",
    "of them none",
    "is no point",
];

/// Rooms that are redrawn soon, and reworded then.
const NOT_YET_PLAIN: &[&str] = &["trace/", "geometry/", "syntax/habits/"];

#[test]
fn pages_and_comments_are_plain() {
    let readme = fs::read_to_string(root().join("README.md")).expect("readable");
    let pages = files("docs", &["md"]).into_iter().chain([("README.md".to_owned(), readme)]);
    let is_plain = |file: &str| !NOT_YET_PLAIN.iter().any(|room| file.starts_with(room));
    let comment =
        |line: &&str| ["//!", "///"].iter().any(|sign| line.trim_start().starts_with(sign));
    let comments = files("src", &["rs"]).into_iter().filter(|(file, _)| is_plain(file));
    let comments = comments
        .map(|(file, text)| (file, text.lines().filter(comment).collect::<Vec<_>>().join("\n")));
    let faults = pages.chain(comments).flat_map(|(file, text)| {
        let found = STUMBLES.iter().filter(|phrase| text.contains(**phrase));
        found.map(|phrase| format!("{file}: \"{phrase}\"")).collect::<Vec<_>>()
    });
    assert_none(faults.collect());
}
