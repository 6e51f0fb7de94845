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
fn a_file_has_the_gamma_and_the_gray_that_are_asked_for() {
    let place = place();
    // What POV-Ray writes of <0.1, 0.5, 0.05>, whose brightness is 0.3299.
    let plane = "plane { z, 0 pigment { rgb <0.1, 0.5, 0.05> } finish { ambient 1 diffuse 0 } }";
    let head = "#version 3.7; camera { orthographic location -z look_at 0 }";
    let scene = |gamma| format!("{head} global_settings {{ assumed_gamma {gamma} }} {plane}");
    place.write("linear.pov", &scene("1"));
    place.write("curved.pov", &scene("2.2"));
    for (words, expected) in [
        ("linear.pov", [89, 188, 63]),
        ("linear.pov File_Gamma=1", [26, 128, 13]),
        ("linear.pov File_Gamma=2.2 +FB", [90, 186, 65]),
        ("curved.pov file_gamma=sRGB", [19, 128, 5]),
        ("curved.pov File_Gamma=1.8 +FT", [15, 109, 7]),
    ] {
        let kind = if words.contains("+F") { &words[words.len() - 1..] } else { "N" };
        place.run(&format!("povray {words} +W4 +H3 +Oo")).ends(0, &[]);
        let name = [("N", "o.png"), ("B", "o.bmp"), ("T", "o.tga")].into_iter();
        let name = name.filter(|(one, _)| *one == kind).map(|(_, name)| name).next();
        let read = image::open(place.path(name.expect("a type"))).expect("a picture").into_rgb8();
        let off = read.get_pixel(1, 1).0.into_iter().zip(expected).map(|(a, b)| a.abs_diff(b));
        assert!(off.max() <= Some(1), "{words} {:?}", read.get_pixel(1, 1));
    }
    for (words, gray) in
        [("+FNg", 39_952), ("+FPg", 21_620), ("+FN Grayscale_Output=on File_Gamma=1", 21_620)]
    {
        let name = if words.contains("P") { "g.ppm" } else { "g.png" };
        place.run(&format!("povray linear.pov +W4 +H3 +Og {words}")).ends(0, &[]);
        let read = image::open(place.path(name)).expect("a picture");
        let pixel = read.as_luma16().expect("16 bits of gray").get_pixel(1, 1).0[0];
        assert!(pixel.abs_diff(gray) <= 1, "{words} {pixel}");
    }
    let run = place.run("povray linear.pov +FT Grayscale_Output=on");
    run.ends(1, &["Unsupported combination of options"]);
    place.run("povray linear.pov +FTg").ends(1, &["Failed to parse command-line option"]);
}

#[test]
fn a_header_comes_first_and_a_single_frame_has_its_number() {
    let place = place();
    place.write("head.inc", "#declare Size = 0.5;\n");
    place.write("h.pov", "#version 3.7; camera { location -5*z look_at 0 } sphere { 0, Size }");
    place.run("povray h.pov +W8 +H6").ends(1, &["Parse Error: "]);
    place.run("povray h.pov +W8 +H6 +HIhead.inc").ends(0, &[]);
    place.run("povray a.pov +W8 +H6 +KFI3 +KFF3 +Oone").ends(0, &["Rendering frame 1 of 1\n"]);
    place.run("povray a.pov +W8 +H6 +KFF9 +STP4 +Onine").ends(0, &["Rendering frame 3 of 3\n"]);
    for name in ["h.png", "one3.png", "nine1.png", "nine5.png", "nine9.png"] {
        assert_eq!(size(&place, name), (8, 6), "{name}");
    }
    let wrong = "Fatal error in renderer: Invalid end column or row\n";
    place.run("povray a.pov +W8 +H6 +EC9").ends(1, &[wrong, "Render failed"]);
}

#[test]
fn the_version_of_the_command_line_is_that_of_a_scene_that_names_none() {
    let place = place();
    place.write("none.pov", "camera { location -5*z look_at 0 } light_source { -9*z, rgb 0.5 } sphere { 0, 1 pigment { rgb 0.5 } }");
    let rendered = |words: &str| {
        place.run(&format!("povray none.pov +W4 +H3 +Oo {words}")).ends(0, &[]);
        place.read("o.png")
    };
    let (none, old, new) = (rendered(""), rendered("+MV3.5"), rendered("Version=3.7"));
    assert!(none == old && old != new);
}

/// Command lines as programs write them: those of ASE, vapory, fdray, PyMOL, of modellers, of scripts and of services.
const WRITTEN: [&str; 20] = [
    "povray ase.ini",
    "povray +Ia.pov +H30 +W40 +Q9 +A0.01 +O- +FN",
    "povray +Ia.pov +Oout.png -D +A +W40 +H30 +UA +FN",
    "povray +Ia.pov +Oout.png +W40 +H30 +A -D -V",
    "povray -W40 -H30 -Ia.pov -Oout.png -GA",
    "povray +W40 +H30 +Ia.pov +Oout +FN8 -P +X +D0 +SP64 +EP8",
    "povray a.pov Width=40 Height=30 Antialias=On Antialias_Threshold=0.3 Antialias_Depth=3",
    "povray +FN +W40 +H30 +A0.3 +R3 +AM2 +Q9 +J0.5 -D +L. +Ia.pov",
    "povray -D0 +WT2 +Ia.pov +W40 +H30 Display=Off Pause_When_Done=Off All_Console=Off",
    "povray +Ia.pov +W40 +H30 +KFI1 +KFF3 +KC -D Output_File_Name=frame",
    "povray film.ini[short] +Oclip",
    "povray -Ia.pov +W40 +H30 +SR10 +ER20 +SC1 +EC40 -GD",
    "povray +Ia.pov +W40 +H30 Declare=Angle=30 Declare=Zoom=1.5 +K0.25",
    "povray -Ia.pov +W40 +H30 +FJ85 +Oout",
    "povray +Ia.pov -F +W40 +H30 -D",
    "povray +W40 +H30 +B100 +MB25 -UV -UL Bounding_Method=2 +RVP -C a.pov",
    "povray +Ia.pov +W40 +H30 +Q11 +AG0.4 Work_Threads=2 Render_Block_Size=16 Create_Ini=off",
    "povray Input_File_Name=a.pov Output_File_Type=T Output_File_Name=out Width=40 Height=30",
    "povray +Ia.pov +W40 +H30 -GW +GSstat.txt +GFfatal.txt Verbose=false",
    "povray +Ia.pov +W40 +H30 +FN16 +A0.001 +AM2 Test_Abort=Off Histogram_Type=None",
];

#[test]
fn command_lines_that_programs_write_make_pictures() {
    let place = place();
    place.write(
        "ase.ini",
        "Input_File_Name=a.pov\nOutput_to_File=True\nOutput_File_Type=N\nOutput_Alpha=on\n\
         ; if you adjust Height, and width, you must preserve the ratio\nWidth=40\nHeight=30\n\
         Antialias=True\nAntialias_Threshold=0.1\nDisplay=False\nPause_When_Done=True\n\
         Verbose=False\n",
    );
    place.write(
        "film.ini",
        "Input_File_Name=a.pov\nWidth=40\nHeight=30\nFinal_Frame=9\n[short]\nSubset_End_Frame=2\n",
    );
    for words in WRITTEN {
        let before = place.names();
        let run = place.run(words);
        assert_eq!(run.code(), 0, "{words}: {}", run.stderr());
        let is_there = place.names() != before || !run.0.stdout.is_empty();
        assert!(is_there || words.contains(" -F "), "{words}");
        for name in place.names().into_iter().filter(|name| !before.contains(name)) {
            std::fs::remove_file(place.path(&name)).expect("there");
        }
    }
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

#[test]
fn a_quality_leaves_out_what_the_manual_says() {
    let place = place();
    // A clear and a mirroring square beside each other, lit from the front, before a blue background.
    place.write(
        "q.pov",
        "#version 3.7; global_settings { assumed_gamma 1 } background { rgb z }
        camera { orthographic location -5*z right 4*x up y direction z }
        light_source { -100*z, rgb 1 parallel point_at 0 }
        #default { finish { ambient 0.1 diffuse 0.5 } }
        box { <-2, -1, 0>, <0, 1, 1> pigment { rgbt <1, 0.5, 0.2, 0.5> } }
        box { <0, -1, 0>, <2, 1, 1> pigment { rgb <1, 0.5, 0.2> } finish { reflection 0.5 } }",
    );
    // What POV-Ray shows, linear: ambient and diffuse light, the background through the left one, and in the right one.
    let (clear, through) = ([0.3, 0.15, 0.06], [0.39, 0.19, 0.33]);
    let (plain, mirrored) = ([0.6, 0.3, 0.12], [0.6, 0.3, 0.62]);
    for (quality, left, right) in [
        (9, through, mirrored),
        (8, through, mirrored),
        (7, through, plain),
        (6, through, plain),
        (5, clear, plain),
        (3, clear, plain),
        (1, [0.5, 0.25, 0.1], [1.0, 0.5, 0.2]),
    ] {
        place.run(&format!("povray q.pov +W4 +H1 +Oo File_Gamma=1 +Q{quality}")).ends(0, &[]);
        let read = image::open(place.path("o.png")).expect("a picture").into_rgb8();
        for (x, expected) in [(1, left), (2, right)] {
            for (seen, expected) in read.get_pixel(x, 0).0.into_iter().zip(expected) {
                let off = f64::from(seen) / 255.0 - expected;
                assert!(off.abs() < 0.008, "quality {quality}: {:?}", read.get_pixel(x, 0));
            }
        }
    }
}
