//! `lucarne povray`, as programs call `povray`.

use std::os::unix::fs::symlink;

use super::*;

const POV: &str = "\
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <4, 8, -6>, rgb 1 }
#debug concat(\"frame \", str(frame_number, 0, 0), \" of \", str(final_frame, 0, 0), \" at \", str(clock, 0, 2), \"\\n\")
sphere { clock*x, 1 pigment { color rgb <1, 0, 0> } }
";

fn place() -> Place {
    let place = Place::new();
    place.write("a.pov", POV);
    place.write("broken.pov", &POV.replace("sphere", "spere"));
    place
}

fn size(place: &Place, name: &str) -> (u32, u32) {
    image::image_dimensions(place.path(name)).expect("a picture")
}

#[test]
fn it_answers_as_povray_does() {
    let place = place();
    let run = place.run("povray +Ia.pov +W40 +H30 -D +A0.2");
    let words =
        ["==== [Parsing...] ====", "==== [Rendering...] ====", "1200 of 1200 pixels (100%)\r\n"];
    let run = run.ends(0, &words).ends(0, &["frame 0 of 0 at 0.00\n", "\nPOV-Ray finished\n"]);
    assert_eq!(run.stdout(), "");
    assert_eq!(size(&place, "a.png"), (40, 30));
    let quiet = place.run("povray +Ia.pov +W40 +H30 -V -GA");
    assert_eq!((quiet.code(), quiet.stderr().as_str()), (0, ""));
}

#[test]
fn a_faulty_scene_is_told_in_its_words_and_then_in_ours() {
    let run = place().run("povray broken.pov +W40 +H30");
    let run = run.ends(1, &["File 'broken.pov' line 6: Parse Error: ", "Render failed\n"]);
    let told = run.stderr();
    let [theirs, ours] = ["Fatal error in parser: Cannot parse input.\n", "unknown-word"]
        .map(|words| told.find(words).expect(words));
    assert!(theirs < ours && told.is_ascii(), "{told}");
    let none = place().run("povray +Inone.pov").ends(1, &["Cannot open input file"]);
    assert!(none.stderr().ends_with("Render failed\n"));
}

#[test]
fn options_that_are_unknown_end_it() {
    for words in ["+Ia.pov +Zfoo", "a.pov none.ini", "a.pov Widht=3"] {
        let run = place().run(&format!("povray {words}"));
        let lines = format!(
            "Problem with option setting\npovray {words}\nFailed to parse command-line option\n"
        );
        assert_eq!((run.code(), run.stderr()), (1, lines));
    }
    place().run("povray").ends(1, &["No input file provided"]);
    place().run("povray --version").ends(0, &["POV-Ray 3.7"]);
    place().run("povray --help").ends(0, &["+KFFn", "Example: povray +Iscene.pov"]);
}

#[test]
fn pictures_have_the_name_and_the_type_that_are_asked_for() {
    let place = place();
    fs::create_dir(place.path("sub")).expect("a folder");
    for (words, name) in [
        ("+FT", "a.tga"),
        ("+FB +Ob", "b.bmp"),
        ("+FJ Output_File_Name=sub/", "sub/a.jpg"),
        ("+FN16 +Oc.jpg", "c.jpg.png"),
        ("+FP +Od.PPM", "d.ppm"),
        ("+FE +UA +Oe.exr", "e.exr"),
    ] {
        place.run(&format!("povray +Ia.pov +W20 +H10 {words}")).ends(0, &["POV-Ray finished"]);
        assert_eq!(size(&place, name), (20, 10), "{name}");
    }
    let before = place.names();
    place.run("povray +Ia.pov +W20 +H10 -F").ends(0, &["POV-Ray finished"]);
    assert_eq!(place.names(), before);
    let run = place.run("povray +Ia.pov +W20 +H10 +O-").ends(0, &["POV-Ray finished"]);
    assert_eq!(&run.0.stdout[1..4], b"PNG");
}

#[test]
fn a_part_of_a_picture_stands_in_all_of_it() {
    let place = place();
    place.run("povray +Ia.pov +W20 +H10 +Owhole").ends(0, &[]);
    let words = "povray +Ia.pov +W20 +H10 +SC8 +EC0.6 +SR3 +ER8 +Opart";
    place.run(words).ends(0, &["rows 3 to 8, columns 8 to 12"]);
    let read = |name| image::open(place.path(name)).expect("a picture").into_rgb8();
    let (whole, part) = (read("whole.png"), read("part.png"));
    for (x, y, pixel) in part.enumerate_pixels() {
        let is_inside = (7..12).contains(&x) && (2..8).contains(&y);
        let expected = if is_inside { *whole.get_pixel(x, y) } else { image::Rgb([0; 3]) };
        assert_eq!(*pixel, expected, "{x} {y}");
    }
    assert!(part.pixels().any(|pixel| pixel.0 != [0; 3]));
}

#[test]
fn an_animation_has_a_picture_for_each_frame() {
    let place = place();
    place.write("film.ini", "; a film\nInput_File_Name=\"a.pov\"\nWidth=20\nHeight=10\nFinal_Frame=10\n[short]\nSubset_Start_Frame=9\n");
    let words = ["Rendering frame 2 of 2\n", "frame 10 of 10 at 1.00"];
    place.run("povray film[short]").ends(0, &words);
    assert_eq!(
        place.names(),
        ["a.pov", "a.scene", "a09.png", "a10.png", "broken.pov", "broken.scene", "film.ini"]
    );
    // A frame alone is the same.
    place.run("povray +Ia.pov +W20 +H10 +K1 +Oalone").ends(0, &[]);
    assert_eq!(place.read("alone.png"), place.read("a10.png"));
}

#[test]
fn files_that_the_scene_reads_are_not_overwritten() {
    let place = place();
    place.run("a.scene --size 8x6 -o map.png").ends(0, &[]);
    let map = place.read("map.png");
    place.write("map.pov", &POV.replace("color rgb <1, 0, 0>", "image_map { png \"map.png\" }"));
    place
        .run("povray map.pov +W8 +H6")
        .ends(1, &["`map.png` is a part of the scene", "Render failed"]);
    assert_eq!(place.read("map.png"), map);
    place.run("map.pov --size 8x6").ends(3, &["is a part of the scene: not overwritten"]);
    place
        .run("povray a.pov +W8 +H6 +GDa.pov")
        .ends(1, &["A stream cannot be written to the scene"]);
    assert_eq!(place.read("a.pov"), POV.as_bytes());
}

#[test]
fn called_by_the_name_povray_it_is_povray() {
    let place = place();
    let link = place.path("povray");
    symlink(env!("CARGO_BIN_EXE_lucarne"), &link).expect("a link");
    let mut run = Command::new(link);
    run.args(["+Ia.pov", "+W8", "+H6", "-D"]).current_dir(place.0.path());
    let output = run.output().expect("runs");
    Run(output).ends(0, &["POV-Ray finished"]);
    assert_eq!(size(&place, "a.png"), (8, 6));
}

#[test]
fn streams_go_to_files_and_scenes_write_below_the_current_folder() {
    let place = place();
    place.write("b.pov", &format!("{POV}#fopen F \"made.inc\" write #write (F, \"#declare A = 1;\") #fclose F\n#include \"made.inc\""));
    place.run("povray +Ib.pov +W8 +H6 -GDdebug.log +GFfatal.log").ends(0, &["POV-Ray finished"]);
    assert_eq!(place.read("debug.log"), b"frame 0 of 0 at 0.00\n");
    assert_eq!(place.read("fatal.log"), b"");
    assert_eq!(place.read("made.inc"), b"#declare A = 1;");
}
