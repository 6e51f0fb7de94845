//! The standard includes of our own: they say what POV-Ray's say.
//!
//! Each scene of `tests/standard/` prints what an include gives; the text beside it is what POV-Ray 3.7
//! printed for the same scene with its own include. (It breaks lines at 80 columns, so blanks do not count.)

use std::fs;
use std::path::{Path, PathBuf};

use lucarne::diagnostic::{Code, Levels};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::{FileError, Files, Found, NoFiles};
use lucarne::standard::TEXTS;
use lucarne::vocabulary::standard_names;

/// Where POV-Ray's own may lie.
const INSTALLED: &str = "/usr/share/povray-3.7/include";

/// POV-Ray's own includes.
struct Installed;

impl Files for Installed {
    fn read(&self, name: &str, _: &str) -> Result<Found, FileError> {
        let path = Path::new(INSTALLED).join(name);
        let bytes = fs::read(&path).map_err(|error| FileError::Unreadable(error.to_string()))?;
        Ok(Found { name: path.display().to_string(), bytes })
    }
}

/// What a scene prints, and the other messages.
fn told(files: &dyn Files, dialect: Dialect, text: &str) -> (String, Vec<String>) {
    let mut options = Options::new(dialect);
    options.levels = Levels::new(true);
    let mut road = Road::new(files, options);
    let file = road.read("a.pov", text.as_bytes().to_vec());
    let ast = road.parse(file);
    road.evaluate(ast);
    let (said, faults): (Vec<_>, Vec<_>) =
        road.diagnostics.iter().partition(|one| one.code == Code::AuthorDebug);
    let said: Vec<&str> = said.iter().map(|one| one.message.as_str()).collect();
    (
        said.concat(),
        faults.iter().map(|one| lucarne::diagnostic::render::short(one, &road.sources)).collect(),
    )
}

fn without_blanks(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace()).collect()
}

/// The scenes, by the include they are about.
fn scenes() -> Vec<(String, String, String)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/standard");
    let mut names: Vec<String> = fs::read_dir(&folder)
        .expect("a folder")
        .filter_map(|entry| entry.expect("an entry").file_name().into_string().ok())
        .filter_map(|name| name.strip_suffix(".pov").map(str::to_owned))
        .collect();
    names.sort();
    let read = |name: String| fs::read_to_string(folder.join(name)).expect("a text");
    names
        .into_iter()
        .map(|name| {
            let (scene, answer) = (read(format!("{name}.pov")), read(format!("{name}.txt")));
            (name, scene, answer)
        })
        .collect()
}

#[test]
fn every_include_answers_as_pov_rays_does() {
    let scenes = scenes();
    assert!(scenes.len() >= 8);
    for (name, scene, answer) in scenes {
        let (said, faults) = told(&NoFiles, Dialect::Pov, &scene);
        assert_eq!(faults, [""; 0], "{name}");
        assert_eq!(without_blanks(&said), without_blanks(&answer), "{name}");
    }
}

#[test]
fn reading_an_include_gives_no_message() {
    for (name, _) in TEXTS {
        for dialect in [Dialect::Pov, Dialect::Scene] {
            let head = "#version 3.7; global_settings { assumed_gamma 1 }";
            let scene =
                format!("{head}\n#include \"{name}\"\n#include \"{name}\"\n#debug \"read\"");
            let (said, faults) = told(&NoFiles, dialect, &scene);
            assert_eq!((said.as_str(), faults), ("read", vec![]), "{name}");
        }
    }
}

/// What is left to POV-Ray's own.
const ABSENT: &[&str] = &[
    // The manual says nothing of it.
    "Circle_Text_Valigned",
    // Its includes tell that they are read; ours have nothing to tell.
    "DEBUG_MCR",
    "Debug_Inc_Stack",
    // Parts of its own.
    "ARRAYS_HybridQuickSortStep",
    "ARRAYS_InsertionSort",
    "ARRAYS_QuickSortSeed",
    "Gauss_Next",
    "HFCreate_",
    "g1",
    "g2",
    "g3",
    "g4",
    "deprecated",
];

#[test]
fn every_name_of_an_include_is_declared_by_ours() {
    for (name, _) in TEXTS {
        let declared: Vec<&str> =
            standard_names(name).filter(|name| !ABSENT.contains(name)).collect();
        assert!(!declared.is_empty() || *name == "stdinc.inc", "{name}");
        let ask = |name: &str| format!("#ifndef ({name}) #debug \"{name} \" #end\n");
        let asked: String = declared.iter().map(|name| ask(name)).collect();
        let (missing, _) = told(&NoFiles, Dialect::Pov, &format!("#include \"{name}\"\n{asked}"));
        assert_eq!(missing, "", "{name}");
    }
}

/// All numbers of the includes that are lists of constants, as one text.
fn constants(files: &dyn Files, include: &str) -> String {
    let print = "#macro P(A) #local Q = color A; #debug concat(str(Q.red, 0, 9), \" \", str(Q.green, 0, 9), \
                 \" \", str(Q.blue, 0, 9), \" \", str(Q.filter, 0, 9), \" \", str(Q.transmit, 0, 9), \"\\n\") #end";
    let macros = ["CH2RGB", "CHSL2RGB", "CHSV2RGB", "CRGB2H", "CRGB2HSL", "CRGB2HSV"];
    let is_one = |name: &&str| match include {
        "glass.inc" => name.starts_with("Col_"),
        _ => !macros.contains(name),
    };
    let names = standard_names(include).filter(is_one);
    let asked: String = names.map(|name| format!("#debug \"{name} \" P({name})\n")).collect();
    let scene = format!("#version 3.7;\n#include \"{include}\"\n{print}\n{asked}");
    let (said, faults) = told(files, Dialect::Pov, &scene);
    assert!(faults.len() <= 1, "{faults:?}");
    said
}

#[test]
fn every_colour_and_constant_is_that_of_the_installed_include() {
    if !Path::new(INSTALLED).is_dir() {
        eprintln!("skipped: POV-Ray's includes are not in {INSTALLED}");
        return;
    }
    for (name, _) in TEXTS {
        let text = fs::read(Path::new(INSTALLED).join(name)).expect("installed");
        let text = String::from_utf8_lossy(&text).into_owned();
        let known: Vec<&str> = standard_names(name).collect();
        // Only what begins a line is sure to be declared by the include itself.
        let declared = text.lines().filter_map(|line| line.strip_prefix("#declare "));
        let declared = declared.filter_map(|rest| rest.split(['=', ' ', '[']).next());
        let unknown: Vec<&str> = declared
            .filter(|name| {
                !known.contains(name) && !name.to_lowercase().contains("_inc_") && !name.is_empty()
            })
            .collect();
        assert_eq!(unknown, [""; 0], "{name}: not in the list of its names");
    }
    for (include, fewest) in [("colors.inc", 120), ("consts.inc", 60), ("glass.inc", 100)] {
        let ours = constants(&NoFiles, include);
        assert!(ours.lines().count() > fewest, "{ours}");
        for (ours, theirs) in ours.lines().zip(constants(&Installed, include).lines()) {
            assert_eq!(ours, theirs, "{include}");
        }
    }
}

#[test]
fn the_installed_includes_print_the_same_as_ours() {
    if !Path::new(INSTALLED).is_dir() {
        eprintln!("skipped: POV-Ray's includes are not in {INSTALLED}");
        return;
    }
    for (name, scene, _) in scenes() {
        let ours = told(&NoFiles, Dialect::Pov, &scene).0;
        let theirs = told(&Installed, Dialect::Pov, &scene).0;
        // What of theirs is not built yet (a macro whose parentheses do not pair) says nothing.
        let all: Vec<&str> = ours.lines().collect();
        let other: Vec<&str> = theirs.lines().filter(|line| !all.contains(line)).collect();
        assert_eq!(other, [""; 0], "{name}");
        let fewest = all.len() * 9 / 10;
        assert!(theirs.lines().count() >= fewest, "{name}: {theirs}");
    }
}
