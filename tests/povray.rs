//! What POV-Ray 3.7 renders is a right scene here, with the same picture; what it refuses is an error.
//!
//! `povray/*.scene` hold whole `.pov` scenes in the form of `corpus/mod.rs`. A title begins with POV-Ray's
//! verdict, measured once: `renders:` or `refuses:`. A first line `HEAD` stands for [`HEAD`].
//!
//! Of the messages, `diagnostics` tests the fixes and the traces.
//!
//! * A scene that POV-Ray renders has the expected warnings and no error of ours, but for `not-supported-yet`
//!   and limits. A file `+++ equal.pov` is a scene with the same picture: what POV-Ray reads this one as.
//! * A scene that POV-Ray refuses has the expected messages, and one of them is an error.
//!
//! Where POV-Ray is installed, every sixth case is rendered by both, and all of them with `LUCARNE_LONG` set.

use std::fs;
use std::path::Path;

use lucarne::diagnostic::{Code, Diagnostic, Severity};
use lucarne::road::{Options, Road};
use lucarne::scene::Dialect;
use lucarne::source::Sources;
use lucarne::world::World;

use crate::corpus::{Case, Expected, Includes, assert_none, corpus, said};
use crate::programs::{SAME, Size, is_povray_there, mean_error, ours, theirs};

/// What most cases begin with, in one line.
const HEAD: &str = "#version 3.7; global_settings { assumed_gamma 1 } camera { location <0,2,-6> look_at 0 \
                    angle 45 } light_source { <5,8,-6> rgb 1 }";

/// The file of a case that holds a scene with the same picture.
const EQUAL: &str = "equal.pov";

const FOLDER: &str = "povray";

/// The size of the pictures that both programs make.
const SIZE: Size = [64, 48];

/// The size of ours that stand for equal scenes.
const SMALL: Size = [32, 24];

fn renders(case: &Case) -> bool {
    match case.title.split_once(':') {
        Some(("renders", _)) => true,
        Some(("refuses", _)) => false,
        _ => panic!("{}:{}: the title has no verdict", case.file, case.line),
    }
}

/// The text of a scene, with its `HEAD` written out.
fn written(case: &Case, text: &str) -> Vec<u8> {
    match text.strip_prefix("HEAD\n") {
        Some(rest) => [format!("{HEAD}\n").into_bytes(), case.bytes(rest)].concat(),
        None => case.bytes(text),
    }
}

/// The scene with the same picture.
fn equal(case: &Case) -> Option<Vec<u8>> {
    let (_, text) = case.files.iter().find(|(name, _)| name == EQUAL)?;
    Some(written(case, text))
}

/// What `lucarne check` says of a scene, and its World.
fn compiled(text: Vec<u8>, files: &Includes) -> (World, Vec<Diagnostic>, Sources) {
    let mut road = Road::new(files, Options::new(Dialect::Pov));
    let (world, _) = road.compile("main.pov", text);
    (world, road.diagnostics.iter().cloned().collect(), road.sources)
}

/// Whether an error says nothing of whether the scene is right.
fn may_stop_a_right_scene(code: Code) -> bool {
    code == Code::NotSupportedYet || code.name().ends_with("-limit")
}

fn is_error(told: &Diagnostic) -> bool {
    told.severity == Severity::Error
}

/// Why a case fails; empty when it does not.
fn failures(case: &Case) -> String {
    let files = case.files();
    let (world, told, sources) = compiled(written(case, &case.scene), &files);
    let found = told.iter().map(|one| Expected {
        fixes: Vec::new(),
        via: Vec::new(),
        ..said(one, &sources)
    });
    let mut wrong = case.mismatches(found.collect());
    let is_wrong = |one: &&Diagnostic| is_error(one) && !may_stop_a_right_scene(one.code);
    match renders(case) {
        true => told.iter().filter(is_wrong).for_each(|one| {
            wrong += &format!("  ! POV-Ray renders it: {} is an error\n", one.code.name());
        }),
        false if told.iter().any(|one| is_wrong(&one)) => {}
        false => wrong += "  ! POV-Ray refuses it: no message is an error\n",
    }
    if let Some(equal) = equal(case) {
        let (other, told, _) = compiled(equal, &files);
        for one in told.iter().filter(|one| is_error(one)) {
            wrong += &format!("  ! the equal scene: {}\n", one.message);
        }
        if world != other {
            wrong += &small_difference(case);
        }
    }
    case.report(&wrong)
}

/// What differs between our small pictures of a case and of its equal scene.
fn small_difference(case: &Case) -> String {
    let place = tempfile::tempdir().expect("a folder");
    let [scene, equal] = ["main.pov", EQUAL].map(|name| laid_out(case, place.path()).join(name));
    let folder = equal.parent().expect("a folder");
    match (ours(&scene, folder, SMALL), ours(&equal, folder, SMALL)) {
        (Ok(one), Ok(other)) if one == other => String::new(),
        (Ok(one), Ok(other)) => {
            let pixels = one.pixels().zip(other.pixels());
            let count = pixels.filter(|(one, other)| one != other).count();
            format!("  ! {count} of {} pixels differ from the equal scene\n", one.pixels().len())
        }
        (Err(told), _) | (_, Err(told)) => format!("  ! no picture: {told}\n"),
    }
}

/// Writes the files of a case into a folder below this one, so that there is one above it, too.
fn laid_out(case: &Case, place: &Path) -> std::path::PathBuf {
    let folder = place.join("scene");
    fs::create_dir_all(&folder).expect("a folder");
    for (name, text) in &case.files {
        fs::write(folder.join(name), written(case, text)).expect("written");
    }
    fs::write(folder.join("main.pov"), written(case, &case.scene)).expect("written");
    folder
}

#[test]
fn what_povray_renders_is_right_here_and_what_it_refuses_is_an_error() {
    let corpus = corpus(FOLDER);
    assert_none(corpus.iter().map(failures));
    let count = corpus.iter().filter(|case| renders(case)).count();
    assert!(count >= 60 && corpus.len() - count >= 60, "{count} of {}", corpus.len());
}

#[test]
fn every_opinion_is_shown_as_a_warning_on_a_scene_that_povray_renders() {
    let corpus = corpus(FOLDER);
    let mut shown = Vec::new();
    for case in corpus.iter().filter(|case| renders(case)) {
        let (_, told, _) = compiled(written(case, &case.scene), &case.files());
        shown.extend(told.iter().filter(|one| !is_error(one)).map(|one| one.code));
    }
    let opinions = Code::ALL.iter().filter(|code| code.is_opinion());
    let missing: Vec<&str> =
        opinions.filter(|code| !shown.contains(code)).map(|code| code.name()).collect();
    assert!(missing.is_empty(), "no case below tests/povray shows as a warning: {missing:?}");
}

/// How POV-Ray's verdict on a case, or its picture, differs from what the case says.
fn difference(case: &Case) -> String {
    let place = tempfile::tempdir().expect("a folder");
    let folder = laid_out(case, place.path());
    let scene = folder.join("main.pov");
    let theirs = theirs(&scene, &folder, SIZE);
    let wrong = match (renders(case), theirs) {
        (false, Err(_)) => String::new(),
        (false, Ok(_)) => "  ! POV-Ray renders it\n".to_owned(),
        (true, Err(told)) => format!("  ! no picture: {told}\n"),
        (true, Ok(theirs)) => {
            let (_, told, _) = compiled(written(case, &case.scene), &case.files());
            match told.iter().any(is_error) {
                // It is not built yet.
                true => String::new(),
                false => {
                    match ours(&scene, &folder, SIZE).map(|ours| mean_error(&[ours, theirs])) {
                        Ok(error) if error <= SAME => String::new(),
                        Ok(error) => format!("  ! the pictures differ: {error:.3}\n"),
                        Err(told) => format!("  ! no picture: {told}\n"),
                    }
                }
            }
        }
    };
    case.report(&wrong)
}

#[test]
fn povray_renders_and_refuses_what_the_titles_say_and_shows_the_same() {
    if !is_povray_there() {
        return;
    }
    let step = if std::env::var_os("LUCARNE_LONG").is_some() { 1 } else { 6 };
    assert_none(corpus(FOLDER).iter().step_by(step).map(difference));
}
