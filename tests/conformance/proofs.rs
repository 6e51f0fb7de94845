//! What the lists say of pictures that differ: told better, POV-Ray 3.7 shows what we do.

use std::path::Path;

use super::pictures::{SIZE, differing};
use super::plain::plain;
use super::{SCENES, files};
use crate::programs::{SAME, is_installed, is_povray_there, mean_error, ours, theirs};

/// Texts of a scene, and what stands in their place.
type Changes = &'static [(&'static str, &'static str)];

struct Proof {
    scene: &'static str,
    /// What is made plain for both, by `plain`.
    items: &'static [(&'static str, &'static str)],
    /// For both.
    both: Changes,
    /// For POV-Ray alone.
    theirs: Changes,
    /// How many pixels may differ, where not FLIP's mean is looked at.
    pixels: Option<usize>,
}

const PROOFS: [Proof; 4] = [
    Proof {
        scene: "objects/fractal1.pov",
        items: &[],
        both: &[],
        theirs: &[("PREC = 15;", "PREC = 150;")],
        pixels: None,
    },
    Proof {
        scene: "objects/fractal2.pov",
        items: &[("texture", "T_Stone11")],
        // Clear, they refract the rest by their thinnest threads.
        both: &[
            ("rgbf <0.8, 0.3, 0.2, 0.9>", "rgb <0.8, 0.3, 0.2>"),
            ("rgbf <0.9, 0.6, 0.2, 0.9>", "rgb <0.9, 0.6, 0.2>"),
        ],
        theirs: &[("PREC = 20;", "PREC = 500;")],
        pixels: None,
    },
    Proof {
        scene: "objects/quartic/lemnisc2.pov",
        items: &[],
        both: &[],
        theirs: &[("bounded_by {", "sturm bounded_by {")],
        pixels: Some(3),
    },
    Proof {
        scene: "textures/finishes/var_reflection.pov",
        items: &[],
        both: &[("<-1, -5, 0.25>, <1, 20000, 0.25>", "<-1, -5, 0.249>, <1, 20000, 0.251>")],
        theirs: &[],
        pixels: None,
    },
];

/// The text, changed in as many places as there are, which are some.
fn changed(text: &str, changes: Changes) -> String {
    changes.iter().fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    })
}

#[test]
fn told_better_povray_shows_what_we_do() {
    if !is_installed("povray-examples", &files(SCENES, &["pov"])) || !is_povray_there() {
        return;
    }
    for Proof { scene, items, both, theirs: alone, pixels } in PROOFS {
        let original = Path::new(SCENES).join(scene);
        let folder = original.parent().expect("below the examples");
        let text = std::fs::read(&original).expect("it is there");
        let text = plain(&String::from_utf8_lossy(&text), items).expect("the items are there");
        let place = tempfile::tempdir().expect("a folder");
        let written = |name: &str, text: &str| {
            let file = place.path().join(name);
            std::fs::write(&file, text).expect("it is written");
            file
        };
        let text = changed(&text, both);
        let mine = ours(&written("ours.pov", &text), folder, SIZE);
        let other = theirs(&written("theirs.pov", &changed(&text, alone)), folder, SIZE);
        let told = |told| panic!("{scene}: {told}");
        let pictures = [mine.unwrap_or_else(told), other.unwrap_or_else(told)];
        let (count, mean) = (differing(&pictures), mean_error(&pictures));
        println!("{scene}: {count} pixels differ, {mean:.4}");
        assert!(pixels.map_or(mean <= SAME, |most| count <= most), "{scene}: {count} {mean}");
    }
}
