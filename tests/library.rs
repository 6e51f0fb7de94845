//! The library as another program uses it.

use std::process::Command;

use lucarne::film::Channel;
use lucarne::picture::Format;
use lucarne::plan::Antialias;
use lucarne::trace::Watched;
use lucarne::{Picture, RenderOptions, render};

const SCENE: &str = "camera { location <0, 2, 6> look_at 0 } light_source { <4, 8, 6>, rgb 1 }
    #include \"colors.inc\"
    sphere { clock*x, 1 pigment { Red } } plane { y, -1 pigment { checker rgb 1 rgb 0.1 } }";

#[test]
fn a_picture_of_the_library_has_the_bytes_of_the_programs() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a.scene"), SCENE).expect("written");
    let run = |words: &str| {
        let mut run = Command::new(env!("CARGO_BIN_EXE_lucarne"));
        let run = run.args(words.split(' ')).current_dir(folder.path()).output().expect("runs");
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        std::fs::read(folder.path().join("a.png")).expect("read")
    };
    let options = RenderOptions { name: "a.scene", ..RenderOptions::of_size(80, 60) };
    let rendered = |options: &RenderOptions| {
        let picture = render(SCENE, options).expect("no errors");
        let mut png = Vec::new();
        picture.write(Format::Png, &mut png).expect("written");
        (png, picture)
    };
    let (png, picture) = rendered(&options);
    assert!(png == run("a.scene --size 80x60"));
    assert!(picture.complete && picture.messages.is_empty());
    assert_eq!((picture.rgba8().len(), picture.linear().len()), (4 * 80 * 60, 4 * 80 * 60));
    let clear = RenderOptions {
        alpha: true,
        antialias: Antialias::Off,
        declares: &[("clock", 0.5)],
        threads: Some(1),
        ..options
    };
    assert!(rendered(&clear).0 == run("a.scene --size 80x60 --alpha --antialias off -D clock=0.5"));
}

#[test]
fn a_picture_has_the_channels_that_are_asked_for_and_a_file_that_holds_them_has_them() {
    let channels = [Channel::Object, Channel::Depth];
    let options = RenderOptions { channels: &channels, ..RenderOptions::of_size(21, 15) };
    let picture = render(SCENE, &options).expect("no errors");
    let surfaces = picture.surfaces.as_ref().expect("surfaces");
    let centre = surfaces.pixels[7 * 21 + 10];
    assert_eq!((surfaces.pixels.len(), centre.object), (21 * 15, 2));
    assert!((centre.depth - (40f32.sqrt() - 1.0)).abs() < 1e-5, "{centre:?}");
    let written = |picture: &Picture, format| {
        let mut bytes = Vec::new();
        picture.write(format, &mut bytes).expect("written");
        bytes
    };
    let plain = render(SCENE, &RenderOptions { channels: &[], ..options }).expect("no errors");
    assert_eq!((&plain.surfaces, &plain.film), (&None, &picture.film));
    assert!(written(&plain, Format::Png) == written(&picture, Format::Png));
    let has_depth = |bytes: &[u8]| bytes.windows(3).any(|name| name == b"\0Z\0");
    assert!(has_depth(&written(&picture, Format::Exr)));
    assert!(!has_depth(&written(&plain, Format::Exr)));
    let stopped = Watched::new(|_| false);
    let picture = render(SCENE, &RenderOptions { watch: &stopped, ..options }).expect("no errors");
    assert!(!picture.complete && picture.surfaces.is_none());
}

#[test]
fn messages_are_data_and_text() {
    let text = "sphere { 0, 1 pigmnt { rgb 1 } }";
    let messages = render(text, &RenderOptions { name: "b.pov", ..RenderOptions::default() })
        .expect_err("a mistake");
    assert!(messages.has_errors());
    let first = messages.iter().find(|one| one.is_error()).expect("an error");
    let span = first.primary().expect("a place").span;
    assert_eq!(messages.sources().place(span), "b.pov:1:15");
    assert!(messages.to_string().contains("did you mean `pigment`?"), "{messages}");
    assert!(messages.json_lines().all(|line| line.starts_with('{')));
}

#[test]
fn a_picture_of_no_pixels_and_one_beyond_all_memory_do_no_harm() {
    let picture = render(SCENE, &RenderOptions::of_size(0, 9)).expect("no errors");
    assert!(picture.rgba8().is_empty());
    for format in Format::ALL {
        // There may be no such file, and then an error.
        let _ = picture.write(format, &mut Vec::new());
    }
    let messages =
        render(SCENE, &RenderOptions::of_size(u32::MAX, u32::MAX)).expect_err("too large");
    assert!(messages.lines().any(|line| line.contains("there is no memory")), "{messages}");
}
