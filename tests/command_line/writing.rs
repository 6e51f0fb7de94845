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
