//! Which files a scene may read, and what a scene without text is.

use super::*;

#[test]
fn a_scene_reads_what_it_names_wherever_that_is() {
    let place = Place::new();
    fs::create_dir(place.path("scenes")).expect("a folder");
    place.write("lib.inc", "#declare Size = 2;\n");
    let write = |include: &str| {
        let ball = "sphere { 0, Size pigment { rgb 1 } }";
        place.write("scenes/o.scene", &format!("#include \"{include}\"\n{SCENE}{ball}\n"));
    };
    let absolute = place.path("lib.inc").display().to_string();
    for name in ["../lib.inc", "../lib", &absolute] {
        write(name);
        for command in ["check", "plan", "show"] {
            place.run(&format!("{command} scenes/o.scene")).ends(0, &[]);
            let said = ["forbidden-file", "without `--sandbox` any file is read", "`-I FOLDER`"];
            place.run(&format!("{command} scenes/o.scene --sandbox")).ends(1, &said);
            place.run(&format!("{command} scenes/o.scene --sandbox -I .")).ends(0, &[]);
        }
        place.run("scenes/o.scene --size 8x6").ends(0, &["o.png"]);
        place.run("scenes/o.scene --size 8x6 --sandbox").ends(1, &["forbidden-file"]);
    }
    place.write("values.txt", "3\n");
    let read = "#fopen F \"../values.txt\" read #read (F, Size) #fclose F\n";
    place
        .write("scenes/v.scene", &format!("{read}{SCENE}sphere {{ 0, Size pigment {{ rgb 1 }} }}"));
    place.run("check scenes/v.scene").ends(0, &[]);
    place.run("check scenes/v.scene --sandbox").ends(1, &["forbidden-file"]);
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_out_is_followed_but_in_a_sandbox() {
    let place = Place::new();
    fs::create_dir(place.path("scenes")).expect("a folder");
    place.write("h.pgm", "P2\n2 2\n255\n0 9 9 0\n");
    std::os::unix::fs::symlink("../h.pgm", place.path("scenes/h.pgm")).expect("a link");
    let hills = "height_field { pgm \"h.pgm\" pigment { rgb 1 } }";
    place.write("scenes/h.scene", &format!("{hills}\n{SCENE}"));
    place.run("check scenes/h.scene").ends(0, &["no messages"]);
    place.run("check scenes/h.scene --sandbox").ends(1, &["forbidden-file"]);
}

#[test]
fn a_path_of_another_computer_is_missing_and_its_file_here_suggested() {
    let place = Place::new();
    fs::create_dir(place.path("libs")).expect("a folder");
    place.write("libs/lib.inc", "\n");
    for name in ["C:\\POV\\lib.inc", "C:/POV/lib.inc", "/no/such/lib.inc", "../../lib.inc"] {
        place.write("w.scene", &format!("#include \"{name}\"\n{SCENE}"));
        let alone = place.run("check w.scene").ends(1, &["missing-include", "searched in"]);
        assert!(!alone.stderr().contains("did you mean"), "{}", alone.stderr());
        let said = ["missing-include", "did you mean `lib.inc`?"];
        let run = place.run("check w.scene -I libs").ends(1, &said);
        assert!(!run.stderr().contains("parted by"), "{}", run.stderr());
    }
    place.write("w.scene", &format!("#include \"D:\\lib.inc\"\n{SCENE}"));
    place.run("check w.scene -I libs --fix").ends(0, &["w.scene: 1 fix applied"]);
    assert!(place.read("w.scene").starts_with(b"#include \"lib.inc\"\n"));
}

#[test]
fn an_empty_file_is_no_scene_and_an_empty_include_is_fine() {
    let place = Place::new();
    place.write("e.scene", "");
    place.write("b.pov", "\u{feff} \r\n\t\n");
    for command in ["render", "check", "check --fix", "plan", "show", "accuracy"] {
        place.run(&format!("{command} e.scene")).ends(1, &["`e.scene` is empty"]);
        place.run(&format!("{command} b.pov")).ends(1, &["`b.pov` has nothing but blanks"]);
        let stdin = format!("{command} -").replace(" --fix", "");
        place.run(&stdin).ends(1, &["`standard input` is empty", "pipe a scene into it"]);
    }
    place.write("part.inc", "");
    place.run("check part.inc").ends(0, &["part.inc: no messages"]);
    place.write("i.scene", &format!("#include \"part.inc\"\n{SCENE}"));
    place.run("check i.scene").ends(0, &["no messages"]);
    place.run("fmt e.scene --check").ends(0, &[]);
    // As in POV-Ray, a comment is a scene, and black.
    for (name, code) in [("c.pov", "old-version"), ("d.scene", "empty-scene")] {
        place.write(name, "// nothing yet\n");
        place.run(&format!("{name} --size 8x6")).ends(0, &[code, ".png: 8×6, 0 objects"]);
    }
}
