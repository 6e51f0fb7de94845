//! Programs that call `povray`, unchanged: with lucarne in its place they get the same pictures.
//!
//! `LUCARNE_PYTHON` names the interpreter that has their packages; `python3` is tried, too.

use std::path::Path;
use std::process::Command;

use crate::flip;
use crate::programs::{SAME, is_povray_there};

/// An interpreter that can do this.
fn python(this: &str) -> Option<String> {
    let asked = std::env::var("LUCARNE_PYTHON").ok();
    let known = ["python3", "/usr/bin/python3"].map(str::to_owned);
    asked.into_iter().chain(known).find(|python| {
        let tried = Command::new(python).args(["-c", this]).output();
        tried.is_ok_and(|tried| tried.status.success())
    })
}

/// Runs a client with each program, and compares its pictures. `this` is what it needs.
fn gets_the_same_pictures(client: &str, this: &str, pictures: &[&str]) {
    let Some(python) = python(this).filter(|_| is_povray_there()) else {
        println!("not checked: {client} is not installed");
        return;
    };
    let script =
        Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/clients/{client}_scenes.py"));
    let path = std::env::var("PATH").expect("a path");
    let ours = tempfile::tempdir().expect("a folder");
    let link = ours.path().join("bin");
    std::fs::create_dir(&link).expect("a folder");
    std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_lucarne"), link.join("povray")).expect("a link");
    let ours_first = format!("{}:{path}", link.display());
    let theirs = tempfile::tempdir().expect("a folder");
    for (folder, path) in [(&ours, &ours_first), (&theirs, &path)] {
        let mut run = Command::new(&python);
        let run = run.arg(&script).current_dir(folder.path()).env("PATH", path);
        let told = run.output().expect("it runs");
        let said = String::from_utf8_lossy(&told.stderr);
        assert!(told.status.success(), "{client}: {said}");
    }
    for name in pictures {
        // Where it is clear, on gray.
        let read = |folder: &Path| {
            let picture = image::open(folder.join(name)).expect("a picture").into_rgba8();
            image::RgbImage::from_fn(picture.width(), picture.height(), |x, y| {
                let [r, g, b, a] = picture.get_pixel(x, y).0.map(u32::from);
                image::Rgb([r, g, b].map(|c| ((c * a + 128 * (255 - a)) / 255) as u8))
            })
        };
        let error = flip::mean(&flip::errors(&[read(ours.path()), read(theirs.path())]));
        println!("{client} {name}: {error:.4}");
        assert!(error < SAME, "{client} {name}: {error}");
    }
}

#[test]
fn ase_gets_the_same_pictures() {
    gets_the_same_pictures("ase", "import ase", &["1.png", "2.png"]);
}

#[test]
fn vapory_gets_the_same_pictures() {
    gets_the_same_pictures("vapory", "import vapory, PIL", &["1.png", "2.png"]);
}

#[test]
fn fdray_gets_the_same_pictures() {
    gets_the_same_pictures("fdray", "import fdray, PIL", &["1.png"]);
}

#[test]
fn vtk_gets_the_same_pictures() {
    gets_the_same_pictures("vtk", "import vtk", &["1.png"]);
}

#[test]
fn pymol_gets_the_same_pictures() {
    gets_the_same_pictures("pymol", "import pymol", &["1.png"]);
}

#[test]
fn open_babel_gets_the_same_pictures() {
    let this = "import glob, shutil; assert shutil.which('obabel') and glob.glob('/usr/share/openbabel/*/babel_povray3.inc')";
    gets_the_same_pictures("obabel", this, &["1.png"]);
}
