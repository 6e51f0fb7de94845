//! Every example that is whole looks as POV-Ray 3.7 shows it: `pictures.list` has a line for each.
//!
//! Both render it at 160×120 without antialiasing. A line is the scene and `same`, where the mean of FLIP's
//! errors is at most `SAME`, or that mean; after `—` it says why. Each sixth is tried, all with
//! `LUCARNE_LONG` set. `LUCARNE_UPDATE=1` tries all, writes the list anew, and keeps what is said;
//! `LUCARNE_PICTURES=FOLDER` keeps the pictures that differ: ours, theirs, and FLIP's map.
//!
//! **Source:** P. Andersson et al., "FLIP: a difference evaluator for alternating images", Proceedings of the
//! ACM on Computer Graphics and Interactive Techniques 3 (2020).

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use image::RgbImage;

use super::plain::plain;
use super::{SCENES, grown, listed};
use crate::flip;
use crate::programs::{SAME, Size, is_installed, is_povray_there, ours, theirs};

const LIST: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/conformance/pictures.list");
const EXAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/conformance/examples.list");

const WIDTH: u32 = 160;
const HEIGHT: u32 = 120;

pub(crate) const SIZE: Size = [WIDTH, HEIGHT];

/// The pictures of both, ours first.
fn both(scene: &Path, folder: &Path) -> Result<[RgbImage; 2], String> {
    Ok([ours(scene, folder, SIZE)?, theirs(scene, folder, SIZE)?])
}

/// How many pixels of two pictures differ.
pub(crate) fn differing([ours, theirs]: &[RgbImage; 2]) -> usize {
    ours.pixels().zip(theirs.pixels()).filter(|(ours, theirs)| ours != theirs).count()
}

/// What becomes of a scene, as its line has it.
fn outcome(scene: &Path, folder: &Path, name: &str) -> String {
    let pictures = match both(scene, folder) {
        Ok(pictures) => pictures,
        Err(told) => return format!("no picture: {told}"),
    };
    let errors = flip::errors(&pictures);
    let mean = flip::mean(&errors);
    println!("{name}: {mean:.4}");
    if mean <= SAME {
        return "same".to_owned();
    }
    if let Some(folder) = std::env::var_os("LUCARNE_PICTURES") {
        let gray = |error: &f32| [(error * 255.0) as u8; 3];
        let map = errors.iter().flat_map(gray).collect();
        let map = RgbImage::from_raw(WIDTH, HEIGHT, map).expect("as large");
        let mut all = RgbImage::new(3 * WIDTH, HEIGHT);
        for (place, one) in pictures.iter().chain([&map]).enumerate() {
            image::imageops::replace(&mut all, one, i64::from(WIDTH) * place as i64, 0);
        }
        let file = Path::new(&folder).join(name.replace('/', "_")).with_extension("png");
        all.save(file).expect("the folder is there");
    }
    format!("{mean:.2}")
}

/// A `bounded_by` that cuts is a hint here, so it is what the pictures differ by: the list says so of each that
/// has one, and without it both are the same to the last pixel.
#[test]
fn without_a_bound_that_cuts_not_one_pixel_differs() {
    if !is_installed("povray-examples", &super::files(SCENES, &["pov"])) || !is_povray_there() {
        return;
    }
    let list = std::fs::read_to_string(LIST).unwrap_or_default();
    let listed = listed(&list);
    let cut =
        listed.iter().filter(|(_, (_, said))| said.is_some_and(|s| s.contains("`bounded_by`")));
    let mut count = 0;
    for (name, _) in cut {
        let original = Path::new(SCENES).join(name);
        let text = std::fs::read(&original).expect("it is there");
        let place = tempfile::tempdir().expect("a folder");
        let scene = place.path().join("unbound.pov");
        let text = plain(&String::from_utf8_lossy(&text), &[("bound", "bounded_by")]);
        std::fs::write(&scene, text.expect("it has one")).expect("it is written");
        let folder = original.parent().expect("below the examples");
        let pictures = both(&scene, folder).unwrap_or_else(|told| panic!("{name}: {told}"));
        assert_eq!(differing(&pictures), 0, "{name}");
        count += 1;
    }
    assert!(count > 0);
}

/// The examples that are whole, by their path below all of them.
fn whole() -> Vec<String> {
    let list = std::fs::read_to_string(EXAMPLES).unwrap_or_default();
    list.lines().filter_map(|line| Some(line.split_once(": whole")?.0.to_owned())).collect()
}

#[test]
fn every_example_that_is_whole_looks_as_the_list_says() {
    let paths: Vec<PathBuf> = super::files(SCENES, &["pov"]);
    if !is_installed("povray-examples", &paths) {
        return;
    }
    if !is_povray_there() {
        return;
    }
    let list = std::fs::read_to_string(LIST).unwrap_or_default();
    let listed = listed(&list);
    let is_set = |name: &str| std::env::var_os(name).is_some();
    let update = is_set("LUCARNE_UPDATE");
    let step = if update || is_set("LUCARNE_LONG") { 1 } else { 6 };
    let (mut text, mut wrong, mut more) = (String::new(), String::new(), String::new());
    for name in whole().iter().step_by(step) {
        let scene = Path::new(SCENES).join(name);
        let found = outcome(&scene, scene.parent().expect("below the examples"), name);
        let (was, said) = listed.get(name.as_str()).copied().unwrap_or(("not listed", None));
        let said = said.map_or(String::new(), |said| format!(" — {said}"));
        let _ = writeln!(text, "{name}: {found}{said}");
        if was != found {
            let _ = writeln!(wrong, "{name}:\n  was {was}\n  now {found}");
            if !grown(was, &found).is_empty() {
                let _ = writeln!(more, "{name}:\n  was {was}\n  now {found}");
            }
        }
    }
    if update {
        assert!(more.is_empty(), "an update adds nothing to the list\n{more}");
        std::fs::write(LIST, text).expect("the list is written");
        return;
    }
    assert!(wrong.is_empty(), "`LUCARNE_UPDATE=1` writes the list anew\n{wrong}");
}
