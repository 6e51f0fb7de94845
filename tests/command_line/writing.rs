//! Pictures that cannot, or may not, be written where they should.

use super::*;

#[cfg(unix)]
#[test]
fn a_picture_that_cannot_be_written_is_kept_in_the_temporary_folder() {
    let place = Place::new();
    fs::create_dir(place.path("sub")).expect("a folder");
    fs::create_dir(place.path("tmp")).expect("a folder");
    // The folder is removed while the picture is traced; an interrupt ends the wait for it.
    let interrupted = |delay: &u64| {
        let mut command =
            place.command("a.scene -o sub/big.png --size 4000x4000 --antialias 16 --threads 1");
        command.env("TMPDIR", place.path("tmp")).stderr(Stdio::piped());
        let child = command.spawn().expect("runs");
        std::thread::sleep(std::time::Duration::from_millis(*delay));
        fs::remove_dir_all(place.path("sub")).expect("removed");
        let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        assert!(interrupt.expect("kill").success());
        let run = Run(child.wait_with_output().expect("ends"));
        fs::create_dir(place.path("sub")).expect("a folder");
        // One that was interrupted before the trace began has no picture.
        (run.0.status.code() == Some(3) && run.stderr().contains("is in `")).then_some(run)
    };
    let run = [500, 2000, 8000, 20_000].iter().find_map(interrupted).expect("a trace begins");
    run.ends(
        3,
        &["cannot write `sub/big.partial.png`", "no folder", "the picture is not lost: it is in"],
    );
    let mut kept = fs::read_dir(place.path("tmp")).expect("listed").flatten();
    let kept = kept.next().expect("a picture").path();
    assert!(fs::read(&kept).expect("read").starts_with(b"\x89PNG"));
    let name = kept.file_name().expect("a name").to_string_lossy().into_owned();
    assert!(name.starts_with("big.partial-") && name.ends_with(".png"), "{name}");
}

#[cfg(unix)]
#[test]
fn a_write_protected_picture_is_overwritten_by_force_only_and_permissions_stay() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::new();
    let mode = || fs::metadata(place.path("a.png")).expect("there").permissions().mode() & 0o777;
    let set = |mode| {
        let mode = fs::Permissions::from_mode(mode);
        fs::set_permissions(place.path("a.png"), mode).expect("set");
    };
    place.run("a.scene --size 8x8").ends(0, &[]);
    let first = place.read("a.png");
    set(0o444);
    let said = ["`a.png` is write-protected: not overwritten", "`--force` overwrites it"];
    place.run("a.scene --size 9x9").ends(3, &said);
    assert_eq!((place.read("a.png"), mode()), (first.clone(), 0o444));
    place.run("a.scene --size 9x9 --force").ends(0, &["a.png: 9×9"]);
    assert_ne!(place.read("a.png"), first);
    assert_eq!(mode(), 0o444);
    for kept in [0o600, 0o664] {
        set(kept);
        place.run("a.scene --size 8x8").ends(0, &[]);
        assert_eq!(mode(), kept);
    }
}

#[test]
fn a_write_protected_text_is_neither_fixed_nor_formatted() {
    let place = Place::new();
    place.write("wide.scene", "sphere   { 0,1 }\n");
    for (command, name) in [("check --fix", "broken.scene"), ("fmt", "wide.scene")] {
        let before = place.read(name);
        let mut mode = fs::metadata(place.path(name)).expect("there").permissions();
        mode.set_readonly(true);
        fs::set_permissions(place.path(name), mode).expect("set");
        let said = format!("`{name}` is write-protected: not overwritten");
        place.run(&format!("{command} {name}")).ends(3, &[&said]);
        assert_eq!(place.read(name), before);
    }
}

#[test]
fn alpha_is_written_where_the_format_holds_it_and_refused_where_not() {
    let place = Place::new();
    let alphas = |picture: image::DynamicImage| {
        assert!(picture.color().has_alpha());
        picture.to_rgba8().pixels().map(|pixel| pixel.0[3]).collect::<Vec<_>>()
    };
    for words in ["a.png", "a.png --bits 16", "a.qoi", "a.exr"]
        .iter()
        .chain(&["a.png --max-error 0.2 --force", "a.png --time-budget 1s --force"])
    {
        // A second may be too short to find out the error.
        let code = place.run(&format!("a.scene --size 32x24 --alpha -o {words}")).code();
        assert!(code == 0 || code == 5 && words.contains("budget"), "{words}: {code}");
        let file = words.split(' ').next().expect("a name");
        let alphas = alphas(image::open(place.path(file)).expect("a picture"));
        assert!(alphas[0] == 0 && alphas[32 * 12 + 16] == 255, "{words}: {alphas:?}");
    }
    let run = place.run("a.scene --size 32x24 --alpha -o -").ends(0, &[]);
    let printed = alphas(image::load_from_memory(&run.0.stdout).expect("a picture"));
    assert!(printed[0] == 0 && printed[32 * 12 + 16] == 255);
    place.run("a.scene --size 32x24 -o a.png").ends(0, &[]);
    assert!(!image::open(place.path("a.png")).expect("a picture").color().has_alpha());
    for name in ["jpg", "ppm", "hdr"] {
        let said = format!("a .{name} picture cannot have an alpha channel");
        place.run(&format!("a.scene --alpha -o b.{name}")).ends(2, &[&said, "write a .png"]);
    }
}

// ── animations ──

const FILM: &str = "\
camera { location <0, 1, 6> look_at 0 }
light_source { <4, 8, 6>, rgb 1 }
sphere { clock*x, 1 pigment { color rgb <1, 0, 0> } }
#if (frame_number > 0) #debug concat(str(frame_number, 0, 0), \" of \", str(final_frame, 0, 0), \"\\n\") #end
#warning \"the same in all frames\"
";

#[test]
fn frames_are_numbered_pictures_with_the_bytes_of_each_alone() {
    let place = Place::new();
    place.write("film.scene", FILM);
    let run = place.run("film.scene --size 32x24 --frames 1..11/5 --clocks 0..2 -o f.png");
    let run = run.ends(0, &["1 of 11\n", "6 of 11\n", "f11.png: 32×24"]);
    assert_eq!(run.stderr().matches("author-warning").count(), 1, "{}", run.stderr());
    let pictures: Vec<String> =
        place.names().into_iter().filter(|name| name.ends_with(".png")).collect();
    assert_eq!(pictures, ["f01.png", "f06.png", "f11.png"]);
    place.run("film.scene --size 32x24 -D clock=1 -o alone.png").ends(0, &[]);
    assert_eq!(place.read("alone.png"), place.read("f06.png"));
    let part = "film.scene --size 32x24 --frames 1..11 --only 6..6 --clocks 0..2 -o part.png";
    place.run(part).ends(0, &["part06.png"]);
    assert_eq!(place.read("part06.png"), place.read("f06.png"));
}

#[test]
fn an_animated_picture_has_all_frames_and_so_has_standard_output() {
    let place = Place::new();
    place.write("film.scene", FILM);
    for name in ["f.gif", "f.apng"] {
        let words = format!("film.scene --size 32x24 --frames 1..3 --cyclic --fps 10 -o {name}");
        place.run(&words).ends(0, &["frame 3 of 3", &format!("{name}: 3 frames")]);
    }
    let mut gif = gif::DecodeOptions::new()
        .read_info(fs::File::open(place.path("f.gif")).expect("there"))
        .expect("a GIF");
    let mut frames = 0;
    while let Some(frame) = gif.read_next_frame().expect("a frame") {
        assert_eq!((frame.width, frame.height, frame.delay), (32, 24, 10));
        frames += 1;
    }
    assert_eq!(frames, 3);
    let apng = place.read("f.apng");
    assert_eq!(apng.windows(4).filter(|name| *name == b"fcTL").count(), 3);
    let raw = place.run("film.scene --size 32x24 --frames 1..3 -o -").ends(0, &["frame 3 of 3"]);
    assert_eq!(raw.0.stdout.len(), 3 * (b"P6\n32 24\n255\n".len() + 3 * 32 * 24));
    place.run("film.scene --frames 1..3 --only 5..6").ends(2, &["leaves none of the frames"]);
    place.run("film.scene --frames 1..3 --alpha -o -").ends(2, &["cannot have an alpha channel"]);
    place.write("notes.gif", "my notes");
    place
        .run("film.scene --frames 1..3 -o notes.gif")
        .ends(3, &["is not a picture: not overwritten"]);
    // A frame with a mistake ends it, and leaves no half of a file.
    place.write("half.scene", &format!("{FILM} #if (frame_number = 2) spere #end"));
    place.run("half.scene --size 32x24 --frames 1..3 -o half.gif").ends(1, &["frame 1 of 3"]);
    assert!(!place.names().iter().any(|name| name.starts_with("half.gif")), "{:?}", place.names());
    for wrong in ["5..1", "1", "1..2/0"] {
        place.run(&format!("film.scene --frames {wrong}")).ends(2, &["expected frames such as"]);
    }
}
