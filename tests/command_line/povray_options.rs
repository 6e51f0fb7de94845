//! What the options of `lucarne povray` do to pictures. Expected pixels are those of POV-Ray 3.7.

use super::*;

const HEAD: &str = "#version 3.7; global_settings { assumed_gamma 1 }\n";

/// One colour, in a scene of any gamma.
const BACK: &str = "\
#version 3.7;
global_settings { assumed_gamma AG }
camera { location -z look_at 0 }
background { rgb <0.5, 0.25, 0.1> }
";

/// Everything that a quality may leave out.
const ALL: &str = "\
camera { location <0, 1, -6> look_at 0 }
light_source { <4, 8, -6>, rgb 1 area_light 4*x, 4*z, 4, 4 }
fog { distance 30 rgb <0.5, 0.6, 0.7> }
plane { y, -1 pigment { checker rgb 1 rgb <0.9, 0.1, 0.1> quick_color rgb <0.1, 0.2, 0.9> } }
sphere { <-1.7, 0, 0>, 1 pigment { rgb <0.2, 0.5, 0.2> } finish { reflection 0.5 phong 0.5 } }
sphere { <0.4, 0, -1>, 0.7 pigment { rgbf <0.9, 0.8, 0.5, 0.7> } interior { ior 1.3 } }
box { <1.3, -1, -0.5>, <2.6, 0.6, 1> pigment { rgb <0.8, 0.5, 0.2> } normal { bumps 0.5 scale 0.2 } }
";

/// The samples of the first pixel of a picture with 16 bits.
fn samples(place: &Place, name: &str) -> Vec<u16> {
    match image::open(place.path(name)).expect("a picture") {
        image::DynamicImage::ImageLuma16(picture) => picture.into_raw(),
        image::DynamicImage::ImageRgb16(picture) => picture.into_raw(),
        other => panic!("{name}: {:?}", other.color()),
    }
}

#[test]
fn file_gamma_and_gray_change_the_codes_as_in_povray() {
    let place = Place::new();
    place.write("back.pov", BACK);
    for (gamma, words, expected) in [
        ("1", "+FN16", &[48192, 35199, 22884][..]),
        ("1", "+FN16 File_Gamma=sRGB", &[48192, 35199, 22884]),
        ("1", "+FN16 File_Gamma=1", &[32768, 16384, 6554]),
        ("1", "+FN16 File_Gamma=2.2", &[47824, 34899, 23011]),
        ("1", "+FNg", &[38674]),
        ("1", "+FN8 Grayscale_Output=on File_Gamma=1", &[20129]),
        ("1", "+FP16 File_Gamma=1.8", &[44590, 30339, 18236]),
        ("1", "+FPg", &[20129]),
        ("2.2", "+FN16", &[33021, 15797, 4772]),
        ("2.2", "+FN16 File_Gamma=1", &[14263, 3104, 413]),
        ("2.2", "+FN16 File_Gamma=2.2", &[32768, 16384, 6554]),
        ("2.2", "+FNg", &[19827]),
        ("2.2", "+FNg File_Gamma=1", &[4883]),
        ("2.2", "+FP16 File_Gamma=1.8", &[28090, 12040, 3929]),
        ("2.2", "+FP16 Grayscale_Output=on", &[20129]),
    ] {
        let name = if words.contains("+FP") { "back.ppm" } else { "back.png" };
        let words = format!("povray +Iback.pov +W1 +H1 Declare=AG={gamma} {words}");
        place.run(&words).ends(0, &["POV-Ray finished"]);
        assert_eq!(samples(&place, name), expected, "{words}");
    }
    // Without gamma, colours are in the file as they are.
    place.write("old.pov", &BACK.lines().skip(2).collect::<String>());
    place.run("povray +Iold.pov +W1 +H1 +FN16 File_Gamma=1").ends(0, &[]);
    assert_eq!(samples(&place, "old.png"), [32768, 16384, 6554]);
    place
        .run("povray +Iback.pov +FT Grayscale_Output=on")
        .ends(1, &["Problem with option setting", "Unsupported combination of options\n"]);
}

#[test]
fn each_quality_leaves_out_what_it_leaves_out_in_povray() {
    let place = Place::new();
    place.write("a.pov", &format!("{HEAD}{ALL}"));
    // A mirror, glass, bumps, shadow, and the floor.
    let points = [(4, 6), (7, 7), (12, 6), (6, 8), (15, 9)];
    for (quality, same, expected) in [
        (0, 1, "7cbc7c 597cf3 e7bc7c 597cf3 597cf3"),
        (2, 3, "517d51 425dbb 9e8053 445fbe 4864c8"),
        (4, 4, "517d51 425dbb 9e8053 2f3f69 4864c8"),
        (5, 5, "517d51 3c53a2 9e8053 3c53a0 4864c8"),
        (6, 7, "517d51 b2b0aa 9e8053 aa3b38 c84848"),
        (8, 8, "a1855e b2b0aa 977a4f aa3b38 c84848"),
        (9, 11, "a59985 b4b6b5 9e8d79 ae686c c66d72"),
    ] {
        place.run(&format!("povray a.pov +W16 +H12 +Q{quality}")).ends(0, &["POV-Ray finished"]);
        let picture = image::open(place.path("a.png")).expect("a picture").into_rgb8();
        let colors = points.map(|(x, y)| {
            let [r, g, b] = picture.get_pixel(x, y).0;
            format!("{r:02x}{g:02x}{b:02x}")
        });
        assert_eq!(colors.join(" "), expected, "+Q{quality}");
        let before = place.read("a.png");
        place.run(&format!("povray a.pov +W16 +H12 +Q{same}")).ends(0, &[]);
        assert_eq!(before, place.read("a.png"), "+Q{same}");
    }
}

#[test]
fn below_quality_2_there_are_only_colours_and_of_layers_the_lowest() {
    let place = Place::new();
    let objects = "\
        sphere { -x, 1 texture { pigment { rgb <0.2, 0.5, 0.2> } } texture { pigment { rgbt <1, 0, 0, 0.5> } } }
        sphere { 1.5*x, 1 pigment { rgbt <0.8, 0.5, 0.2, 0.6> } finish { ambient 0.5 } }";
    place.write("a.pov", &format!("{HEAD}camera {{ location -5*z look_at 0 }} {objects}"));
    place.run("povray a.pov +W16 +H12 +Q1").ends(0, &[]);
    let picture = image::open(place.path("a.png")).expect("a picture").into_rgb8();
    assert_eq!(picture.get_pixel(5, 6).0, [124, 188, 124]);
    assert_eq!(picture.get_pixel(11, 6).0, [231, 188, 124]);
}

#[test]
fn a_version_holds_until_the_scene_has_its_own() {
    let place = Place::new();
    let debug = "#debug concat(\"version \", str(version, 0, 2), \"\\n\")\nsphere { 0, 1 }\n";
    place.write("old.pov", debug);
    place.write("new.pov", &format!("{HEAD}{debug}"));
    place.run("povray old.pov +W8 +H6 +MV3.5").ends(0, &["version 3.50", "`assumed_gamma`"]);
    place.run("povray old.pov +W8 +H6 Version=0.5").ends(0, &["version 1.00"]);
    place.run("povray old.pov +W8 +H6").ends(0, &["version 3.70", "no `#version`"]);
    place.run("povray new.pov +W8 +H6 +MV3.5").ends(0, &["version 3.70"]);
    assert!(!place.run("povray old.pov +W8 +H6 +MV3.7").stderr().contains("no `#version`"));
}

#[test]
fn a_header_is_included_before_the_scene() {
    let place = Place::new();
    place.write("head.inc", "#declare Radius = 1;\n");
    place.write("a.pov", "sphere { 0, Radius }\nsphere { 0, None }\n");
    place.run("povray a.pov +W8 +H6 +HIhead.inc").ends(1, &["File 'a.pov' line 2: Parse Error: "]);
    place.write("a.pov", "sphere { 0, Radius }\n");
    place.run("povray a.pov +W8 +H6 Include_Header=head.inc").ends(0, &["POV-Ray finished"]);
    place.run("povray a.pov +W8 +H6 +HInone.inc").ends(1, &["none.inc", "Render failed"]);
}

#[test]
fn parts_beyond_the_picture_are_errors() {
    let place = Place::new();
    place.write("a.pov", HEAD);
    for (words, edge) in [("+SC9", "start"), ("+SR7", "start"), ("+EC9", "end"), ("+ER0", "end")] {
        let told = format!("Fatal error in renderer: Invalid {edge} column or row\n");
        place.run(&format!("povray a.pov +W8 +H6 {words}")).ends(1, &[&told, "Render failed"]);
    }
    place.run("povray a.pov +W8 +H6 +SC8 +ER6").ends(0, &["POV-Ray finished"]);
}

#[test]
fn a_single_frame_with_a_number_is_an_animation() {
    let place = Place::new();
    place.write("a.pov", &format!("{HEAD}#debug str(frame_number, 0, 0)\n"));
    place.run("povray a.pov +W8 +H6 +KFI3 +KFF1").ends(0, &["Rendering frame 1 of 1\n", "\n3===="]);
    place.run("povray a.pov +W8 +H6 +KFF4 +STP2").ends(0, &["Rendering frame 2 of 2\n"]);
    let pictures = place.names().into_iter().filter(|name| name.ends_with(".png"));
    assert_eq!(pictures.collect::<Vec<_>>(), ["a1.png", "a3.png"]);
}

#[test]
fn a_closed_pipe_is_no_error() {
    let place = Place::new();
    place.write("a.pov", HEAD);
    for words in ["povray a.pov +W300 +H300 +FP +O-", "a.scene --size 300x300 -o -"] {
        let mut child = place
            .command(words)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it runs");
        drop(child.stdout.take());
        let run = Run(child.wait_with_output().expect("it ends"));
        assert_eq!(run.code(), 0, "{words}: {}", run.stderr());
        assert!(!run.stderr().contains("panic"), "{words}: {}", run.stderr());
    }
}
