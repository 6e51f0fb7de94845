//! `lucarne fmt` changes the layout of a scene, never what it means: the World before is the World after.
//!
//! The examples need the Debian packages `povray-examples` and `povray-includes`; it is said where they are
//! missing, and they must be there with `LUCARNE_CONFORMANCE=required`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use lucarne::diagnostic::{Diagnostics, Levels, Severity};
use lucarne::road::{Options, Road, dialect};
use lucarne::scene::Dialect;
use lucarne::scene::print::dump;
use lucarne::source::{FileError, Files, Found, Source, Sources, decode};
use lucarne::syntax::{ParseOptions, Unformatted, format};
use lucarne::world::World;

const EXAMPLES: &str = "/usr/share/doc/povray/examples";
const INCLUDES: &str = "/usr/share/povray-3.7/include";

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

/// The text in canonical layout, `None` for one with errors; and again, which changes nothing.
#[track_caller]
fn formatted(name: &str, text: &str) -> Option<String> {
    let lay_out = |text: &str| {
        let mut sources = Sources::default();
        let file = sources.add(Source::new(name, text));
        let options = ParseOptions { dialect: dialect(name), ..ParseOptions::default() };
        format(sources.get(file), file, &options, &mut Diagnostics::new(false))
    };
    let once = match lay_out(text) {
        Ok(once) => once,
        Err(Unformatted::Broken) => return None,
        Err(Unformatted::Unsafe) => panic!("{name}: its tokens would change"),
    };
    assert!(
        lay_out(&once).as_deref() == Ok(&once),
        "{name}: formatting twice is not formatting once"
    );
    Some(once)
}

/// Includes, laid out once; fonts, pictures and broken texts as they are.
static LAID_OUT: Mutex<BTreeMap<String, Vec<u8>>> = Mutex::new(BTreeMap::new());

/// The folder of a scene and POV-Ray's own; every file comes as it is, or laid out.
struct Disk {
    formatted: bool,
}

impl Files for Disk {
    fn read(&self, name: &str, from: &str) -> Result<Found, FileError> {
        let here = Path::new(from).parent().unwrap_or(Path::new("."));
        let tried = [here.join(name), Path::new(INCLUDES).join(name)];
        let found = tried.iter().find_map(|path| Some((path, std::fs::read(path).ok()?)));
        let Some((path, bytes)) = found else {
            return Err(FileError::NotFound { searched: Vec::new(), similar: Vec::new() });
        };
        let name = path.display().to_string();
        // A mesh is no scene.
        let is_mesh = ["ply", "obj", "stl", "gltf", "glb"].iter().any(|end| name.ends_with(end));
        if !self.formatted || is_mesh {
            return Ok(Found { name, bytes });
        }
        let mut known = LAID_OUT.lock().expect("no test fails while it holds this");
        let laid_out = known.entry(name.clone()).or_insert_with(|| {
            let is_text = !bytes.contains(&0);
            let text = is_text.then(|| formatted(&name, &decode(bytes.clone()).0)).flatten();
            text.map_or(bytes, String::into_bytes)
        });
        let bytes = laid_out.clone();
        Ok(Found { name, bytes })
    }
}

/// What a scene means: its World, its Scene without places, and the codes of its errors.
#[derive(PartialEq)]
struct Meaning {
    world: World,
    scene: String,
    errors: Vec<&'static str>,
}

fn meaning(name: &str, text: String, formatted: bool) -> Meaning {
    let disk = Disk { formatted };
    let mut options = Options::new(dialect(name));
    options.levels = Levels::new(false);
    options.evaluate.limits.loop_turns = 30_000;
    let mut road = Road::new(&disk, options);
    let file = road.read(name, text.into_bytes());
    let ast = road.parse(file);
    let scene = road.evaluate(ast);
    let dumped = dump(&scene, &road.sources);
    let without_places = dumped.lines().map(|line| line.split("  (").next().unwrap_or(line));
    let shown = without_places.collect::<Vec<_>>().join("\n");
    let (world, _) = road.lower(scene);
    let errors = road.diagnostics.iter().filter(|one| one.severity == Severity::Error);
    let errors = errors.map(|one| one.code.name()).collect();
    Meaning { world, scene: shown, errors }
}

/// Lays out a text and compares; false for one that cannot be read.
fn keeps_its_meaning(name: &str, text: String, faults: &mut Vec<String>) -> bool {
    let Some(laid_out) = formatted(name, &text) else { return false };
    let (before, after) = (meaning(name, text, false), meaning(name, laid_out, true));
    if before != after {
        faults.push(name.to_owned());
    }
    true
}

/// How many of `paths` were laid out; none may mean anything else after it.
fn compare(paths: &[PathBuf]) -> usize {
    let (next, done) = (Mutex::new(paths.iter()), Mutex::new((0, Vec::new())));
    let work = || {
        loop {
            let Some(path) = next.lock().expect("no panic before").next() else { break };
            let Ok(bytes) = std::fs::read(path) else { continue };
            let (text, _) = decode(bytes);
            let mut faults = Vec::new();
            let kept = keeps_its_meaning(&path.display().to_string(), text, &mut faults);
            let mut done = done.lock().expect("no panic before");
            done.0 += usize::from(kept);
            done.1.append(&mut faults);
        }
    };
    std::thread::scope(|scope| {
        let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
        (0..cores).for_each(|_| drop(scope.spawn(work)));
    });
    let (laid_out, faults) = done.into_inner().expect("no panic before");
    assert!(faults.is_empty(), "these mean something else:\n{}", faults.join("\n"));
    laid_out
}

#[test]
fn every_scene_of_ours_means_the_same_after_it() {
    let mut paths = Vec::new();
    files(Path::new("scenes"), &["scene"], &mut paths);
    files(Path::new("tests/cases"), &["scene"], &mut paths);
    let laid_out = compare(&paths);
    assert!(laid_out > 100 && laid_out + 2 >= paths.len(), "{laid_out} of {}", paths.len());
}

#[test]
fn the_scenes_here_are_laid_out_already() {
    let mut paths = Vec::new();
    files(Path::new("scenes"), &["scene", "inc"], &mut paths);
    for path in paths {
        let (name, text) = (path.display().to_string(), std::fs::read_to_string(&path).unwrap());
        assert_eq!(formatted(&name, &text), Some(text), "lucarne fmt {name}");
    }
}

/// The broken scenes of `diagnostics/`, as far as they can be read.
#[test]
fn every_readable_case_of_the_diagnostics_means_the_same_after_it() {
    let mut paths = Vec::new();
    files(Path::new("tests/diagnostics"), &["scene"], &mut paths);
    let (mut faults, mut laid_out) = (Vec::new(), 0);
    for path in &paths {
        let text = std::fs::read_to_string(path).expect("readable");
        for (n, case) in text.split("=== ").skip(1).enumerate() {
            let lines = case.lines().skip(1);
            let lines =
                lines.take_while(|line| !line.starts_with("---") && !line.starts_with("+++"));
            let scene = lines.collect::<Vec<_>>().join("\n");
            let extension = if case.lines().next().is_some_and(|t| t.contains("(pov)")) {
                "pov"
            } else {
                "scene"
            };
            let name = format!("{}-{n}.{extension}", path.display());
            laid_out += usize::from(keeps_its_meaning(&name, scene, &mut faults));
        }
    }
    assert!(faults.is_empty(), "these mean something else:\n{}", faults.join("\n"));
    assert!(laid_out > 300, "only {laid_out}");
}

fn installed(paths: &[PathBuf]) -> bool {
    if paths.is_empty() {
        let required =
            std::env::var_os("LUCARNE_CONFORMANCE").is_some_and(|value| value == "required");
        assert!(!required, "the examples are not installed");
        println!("not checked: the packages are not installed");
    }
    !paths.is_empty()
}

#[test]
fn every_example_means_the_same_after_it() {
    let mut paths = Vec::new();
    files(Path::new(EXAMPLES), &["pov"], &mut paths);
    if installed(&paths) {
        let laid_out = compare(&paths);
        // One is a form to be filled in.
        assert_eq!(laid_out, paths.len() - 1);
        assert!(laid_out >= 395, "only {laid_out}");
    }
}

#[test]
fn every_include_is_laid_out() {
    let mut paths = Vec::new();
    files(Path::new(EXAMPLES), &["inc"], &mut paths);
    files(Path::new(INCLUDES), &["inc", "map"], &mut paths);
    if installed(&paths) {
        for path in &paths {
            let text = decode(std::fs::read(path).expect("readable")).0;
            let name = path.display().to_string();
            assert!(formatted(&name, &text).is_some(), "{name} has errors");
        }
        assert!(paths.len() > 80);
    }
}

#[test]
fn a_word_of_a_block_of_ours_is_no_function() {
    let text = "finish { kd 0.8 ks(0.1) phong_exponent 6 }";
    assert_eq!(dialect("a.scene"), Dialect::Scene);
    assert_eq!(
        formatted("a.scene", text).as_deref(),
        Some("finish { kd 0.8 ks (0.1) phong_exponent 6 }\n")
    );
}
