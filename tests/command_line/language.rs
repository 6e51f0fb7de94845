//! In which language a main file is read.

use super::*;

const POV: &str = "\
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <4, 8, -6>, rgb 1 }
sphere { <1, 0, 0>, 1 pigment { color rgb <1, 0, 0> } }
";

/// Runs the program with the text on standard input.
fn with_input(place: &Place, words: &str, text: &str) -> Run {
    place.write("input", text);
    let input = fs::File::open(place.path("input")).expect("there");
    Run(place.command(words).stdin(input).output().expect("runs"))
}

#[test]
fn a_scene_for_povray_makes_the_same_picture_under_any_name() {
    let place = Place::new();
    place.write("a.pov", POV);
    place.run("a.pov -o pov.ppm --size 16x12").ends(0, &[]);
    place.run("a.pov -o other.ppm --size 16x12 --language scene").ends(0, &[]);
    assert_ne!(place.read("pov.ppm"), place.read("other.ppm"));
    let said = ["as POV-Ray's language, because it has `#version`", "`--language scene`"];
    for name in ["a.txt", "a.pov.bak", "a.pov~", "plain"] {
        place.write(name, POV);
        let run = place.run(&format!("render {name} -o x.ppm --size 16x12")).ends(0, &said);
        assert_eq!(run.stderr().matches("note: ").count(), 1, "{}", run.stderr());
        assert_eq!(place.read("x.ppm"), place.read("pov.ppm"), "{name}");
    }
    with_input(&place, "- -o x.ppm --size 16x12", POV).ends(0, &said);
    assert_eq!(place.read("x.ppm"), place.read("pov.ppm"));
    let run = with_input(&place, "- -o x.ppm --size 16x12 --language scene", POV).ends(0, &[]);
    assert!(!run.stderr().contains("note: "), "{}", run.stderr());
    assert_eq!(place.read("x.ppm"), place.read("other.ppm"));
    // Nothing in it is POV-Ray's alone.
    let text = POV[POV.find("camera").expect("there")..].replace("-6>", "0 - 6>");
    let said = ["`standard input` as lucarne's own language; `--language pov`"];
    with_input(&place, "- -o x.ppm --size 16x12", &text).ends(0, &said);
    with_input(&place, "- -o x.ppm --size 16x12 --language pov", &text).ends(0, &[]);
    place.write("a.pov", &text);
    place.run("a.pov -o pov.ppm --size 16x12").ends(0, &[]);
    assert_eq!(place.read("x.ppm"), place.read("pov.ppm"));
}

#[test]
fn every_command_reads_the_same_language_and_says_so_once() {
    let place = Place::new();
    place.write("a.txt", POV);
    for command in ["check", "check --fix", "plan", "show", "accuracy --size 16x12 --budget 1s"] {
        let run = place.run(&format!("{command} a.txt"));
        let said = run.stderr();
        assert_eq!(said.matches("note: reading `a.txt` as POV-Ray's").count(), 1, "{said}");
        let run = place.run(&format!("{command} a.txt --language scene"));
        assert!(!run.stderr().contains("note: reading"), "{}", run.stderr());
    }
    for name in ["a.scene", "a.pov"] {
        place.write(name, POV);
        let run = place.run(&format!("check {name}")).ends(0, &[]);
        assert!(!run.stderr().contains("note: "), "{}", run.stderr());
    }
    // What is a warning in a `.scene` alone.
    place.write("u.pov", &format!("{POV}#declare Unused = 1;\n"));
    place.run("check u.pov").ends(0, &["no messages"]);
    place.run("check u.pov --language scene").ends(0, &["unused-declaration"]);
    place.run("check u.pov --language english").ends(2, &["pov", "scene"]);
    place.run("fmt u.pov --language pov --check").ends(0, &[]);
}
