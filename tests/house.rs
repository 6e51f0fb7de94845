//! The rules of the house, as data: which room may use which, and what stays behind its one door.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use lucarne::diagnostic::Code;
use lucarne::vocabulary::{Family, Role, Word};

/// Every room of `src/`, from the ground up, and the rooms it may use. A circle cannot be written.
const ROOMS: &[(&str, &[&str])] = &[
    // ground
    ("math", &[]),
    ("color", &["math"]),
    // words
    ("source", &[]),
    ("vocabulary", &[]),
    ("diagnostic", &["source"]),
    // things
    ("function", &["math"]),
    ("pattern", &["math"]),
    ("shape", &["math"]),
    ("spline", &[]),
    // nouns
    ("scene", &["color", "math", "pattern", "source", "vocabulary"]),
    ("world", &["color", "math", "pattern", "shape", "source"]),
    ("geometry", &["math", "shape", "world"]),
    ("plan", &["color", "math", "pattern", "shape", "source", "world"]),
    ("film", &["color", "math", "plan"]),
    ("picture", &["color", "film"]),
    // verbs
    ("syntax", &["color", "source", "vocabulary", "diagnostic"]),
    (
        "lower",
        &[
            "color",
            "diagnostic",
            // Whether anything is in view.
            "geometry",
            "math",
            "pattern",
            "scene",
            "shape",
            "source",
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
            "pattern",
            "scene",
            "source",
            "syntax",
            "vocabulary",
            "function",
            "spline",
            // `trace()`, `inside()`, `min_extent()` and `max_extent()` look at what was declared.
            "geometry",
            "lower",
            "shape",
            "world",
        ],
    ),
    (
        "trace",
        &["color", "film", "geometry", "math", "pattern", "plan", "shape", "source", "world"],
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
    ("pilot", &["math", "plan", "trace", "world"]),
    ("accuracy", &["color", "film", "geometry", "math", "plan", "trace", "world"]),
    ("lib", &[]),
    // doors: they use the library from outside, as anyone would
    ("cli", &[]),
    ("main", &["cli"]),
];

/// Outside crates, and the places that may name each.
const DOORS: &[(&str, &[&str])] = &[
    ("pest", &["syntax/"]),
    ("pest_derive", &["syntax/"]),
    ("glam", &["math/vector.rs"]),
    ("libm", &["math/elementary.rs"]),
    ("miette", &["diagnostic/render"]),
    ("serde", &["diagnostic/json.rs", "accuracy/json.rs", "cli/"]),
    ("serde_json", &["diagnostic/json.rs", "accuracy/json.rs", "cli/"]),
    ("strsim", &["diagnostic/suggest.rs"]),
    ("stacker", &["evaluate/"]),
    ("image", &["picture"]),
    ("png", &["picture"]),
    ("rayon", &["trace/"]),
    ("clap", &["cli/", "main.rs"]),
    ("indicatif", &["cli/"]),
    ("ctrlc", &["cli/"]),
    ("nix", &["cli/"]),
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

/// Numbers that look like an epsilon or a far limit, by file and by what stands on their line, and
/// why each is neither: none is compared with a length of a scene.
const NUMBERS: &[(&str, &str, &str)] = &[
    ("accuracy/knob.rs", "1e-6", "a weight at which reflections are no longer followed"),
    ("accuracy/table.rs", "0.000_1", "how a number is written"),
    ("evaluate/block/settings.rs", "1_000_000.0", "levels of reflection"),
    ("evaluate/builtin/float.rs", "BORDER", "roundings of a sine or cosine, which is at most 1"),
    ("evaluate/builtin/mod.rs", "1e-5..1e16", "how a number is written in a message"),
    ("evaluate/array.rs", "1e-10", "an index, which is a whole number"),
    (
        "evaluate/builtin/vector.rs",
        "1e-280..1e300",
        "squares that are exact; others are scaled first",
    ),
    ("evaluate/probe.rs", "UNBOUNDED", "what POV-Ray's max_extent answers for a plane"),
    ("evaluate/turn.rs", "1e-9 * step", "relative: of a loop's step"),
    (
        "evaluate/value.rs",
        "1e-10 * a.abs().max(b.abs())",
        "relative: two numbers alike, for a hint",
    ),
    ("geometry/balls.rs", "f64::MAX / 1e20", "squares that may overflow: every object is tried"),
    ("geometry/balls.rs", "radius_squared * (", "relative, and what underflows"),
    ("geometry/balls.rs", "SLACK", "roundings of a square, relative"),
    ("geometry/tree.rs", "FAR", "beyond so many tree sizes every object is tried"),
    ("geometry/tree.rs", "STEEPEST", "stands for 1/0 among slopes"),
    ("geometry/tree.rs", "OUTWARD", "roundings of a box test, relative"),
    ("geometry/tree.rs", "least", "relative: of the tree's size"),
    ("lower/camera.rs", "PARALLEL", "relative: between directions"),
    ("lower/view.rs", "CLEARLY", "relative: to the place of a corner"),
    ("lower/lint.rs", "ROUNDING", "relative: what a warning overlooks in a sum near 1"),
    ("lower/transform.rs", "NEAR_SINGULAR", "a condition number: a length over a length"),
    ("lower/transform.rs", "STEP_ROUNDING", "relative: of a map's numbers"),
    ("math/double.rs", "low: 2.9486522708701687e-19", "digits of π/180"),
    ("math/interval.rs", "const FAR", "radians: intervals that wide hold every angle"),
    ("math/interval.rs", "const TURN", "relative: of an angle"),
    ("math/interval.rs", "const WHOLE", "whole numbers that are exact"),
    ("math/random.rs", "(1u64 << 53)", "the numbers of 53 bits between 0 and 1"),
    ("math/singular.rs", "cosine.abs()", "a cosine: columns that are at right angles"),
    ("math/vector.rs", "134_217_729.0", "splits a number in two halves of bits"),
    ("math/vector.rs", "UNIT_ROUNDOFF", "the roundoff itself"),
    ("math/vector.rs", "debug_assert", "of a length that is 1"),
    ("math/placement.rs", "let centre", "roundings of a map's centre, relative"),
    ("math/placement.rs", "let difference", "roundings of a difference, relative"),
    ("pattern/checker.rs", "WHOLE", "large enough that its neighbours are whole numbers"),
    ("pattern/gradient.rs", "let error", "roundings of a sum, relative"),
    ("pattern/noise/perlin.rs", "ORIGIN", "where POV-Ray's noise has its origin"),
    ("pattern/noise/turbulence.rs", "greatest", "numbers pass through `f32` there, as in POV-Ray"),
    ("plan/print.rs", "1e-3..1e6", "how a number is written"),
    ("shape/box_.rs", "blur", "relative: of the distance"),
    ("shape/box_.rs", "STEEP", "a slope"),
    ("shape/box_.rs", "LEVEL", "a slope"),
    ("shape/mod.rs", "const U", "the roundoff itself"),
    ("shape/plane.rs", "size < t * 16_384.0", "relative: a distance to a distance"),
    ("shape/plane.rs", "error: t / 67_108_864.0", "relative: of the distance"),
    ("shape/sphere.rs", "size / 1_048_576.0", "relative: of the distance and the radius"),
    ("trace/refraction.rs", "CRITICAL", "relative: of a sine, which is at most 1"),
    ("trace/sharpness.rs", "ROUNDED", "roundings of a direction, whose length is 1"),
    ("trace/sharpness.rs", "* centres", "roundings of a map's centres, relative"),
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
            let name = declaration.trim_start_matches("pub(crate) ").strip_prefix("mod ");
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
fn only_the_doors_print_read_disks_or_exit() {
    let mut faults = Vec::new();
    for (file, text) in files("src", &["rs"]) {
        if file.starts_with("cli/") || file == "main.rs" {
            continue;
        }
        let code = code(&text);
        faults.extend(
            DOORS_ONLY
                .iter()
                .filter(|word| code.contains(*word))
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

/// The code without what stands in quotes.
fn unquoted(code: &str) -> String {
    let pieces = code.replace("\\\"", "").replace("'\"'", "");
    pieces.split('"').step_by(2).collect()
}

/// Whether a line has a number so small or so large that it may be an epsilon or a far limit.
fn has_extreme_number(line: &str) -> bool {
    const WORDS: &[&str] =
        &["EPSILON", "MIN_POSITIVE", "f64::MAX", "f32::MAX", "(1u64 <<", "(1u128 <<"];
    let part_of_number = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    let spaced = line.replace("e-", "e\u{2212}").replace("E-", "e\u{2212}");
    let extreme = spaced
        .split(|c: char| !part_of_number(c) && c != '\u{2212}')
        .flat_map(|token| token.split(".."))
        .filter(|token| token.starts_with(|c: char| c.is_ascii_digit()))
        .filter(|token| token.contains(['.', 'e', 'E']))
        .filter_map(|token| token.replace('_', "").replace('\u{2212}', "-").parse::<f64>().ok())
        .any(|number| number != 0.0 && !(1e-3..1e4).contains(&number));
    extreme || WORDS.iter().any(|word| line.contains(word))
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
fn no_length_is_compared_with_an_epsilon_or_a_far_limit() {
    let mut faults = Vec::new();
    let mut used = BTreeSet::new();
    for (file, text) in files("src", &["rs"]) {
        if file.starts_with("cli/") {
            continue;
        }
        let code = unquoted(&code(&text));
        for line in code.lines().filter(|line| has_extreme_number(line)) {
            let reason =
                NUMBERS.iter().position(|(place, part, _)| file == *place && line.contains(part));
            match reason {
                Some(index) => {
                    used.insert(index);
                }
                None => faults.push(format!("{file}: `{}`", line.trim())),
            }
        }
    }
    let unused = (0..NUMBERS.len()).filter(|index| !used.contains(index));
    faults.extend(unused.map(|index| format!("excused, and not there: {:?}", NUMBERS[index])));
    assert_none(faults);
}

#[test]
fn the_reader_of_numbers_finds_the_extreme_ones() {
    for line in [
        "if t > 1e-6 {",
        "t < 1E7",
        "x + 0.000_1",
        "1.0e10 > t",
        "a < f64::EPSILON",
        "t > 20_000.0",
        "1e-5..1e16",
    ] {
        assert!(has_extreme_number(line), "{line}");
    }
    for line in ["t > 0.0", "0.5 * x", "2.0 * b", "1..10", "x.e1", "1_000_000", "0.0011"] {
        assert!(!has_extreme_number(line), "{line}");
    }
    assert_eq!(unquoted("a(\"1e-6\", b)"), "a(, b)");
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

/// Directives that make sense together only, and are shown together.
const SHOWN_TOGETHER: &[&str] =
    &["debug", "warning", "else", "elseif", "end", "break", "case", "range", "ifndef"];

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
