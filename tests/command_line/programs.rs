//! What other programs read: messages of services, rules of make, completions and the manual.

use super::*;

#[test]
fn a_log_of_sarif_has_all_files_and_is_one_document() {
    let place = Place::new();
    place.write("other.scene", "box { 0, 1 pigmnt { rgb 1 } }");
    let run = place.run("check broken.scene a.scene other.scene --message-format sarif");
    let log: serde_json::Value = serde_json::from_str(&run.stdout()).expect("one document");
    assert_eq!((run.code(), &log["version"]), (1, &"2.1.0".into()));
    let results = log["runs"][0]["results"].as_array().expect("results");
    let errors: Vec<_> = results.iter().filter(|one| one["level"] == "error").collect();
    assert_eq!(errors.len(), 2);
    let place = &errors[0]["locations"][0]["physicalLocation"];
    assert_eq!(place["artifactLocation"]["uri"], "broken.scene");
    assert_eq!(place["region"]["startLine"], 3);
}

#[test]
fn a_log_of_sarif_has_all_frames_and_each_message_once() {
    let place = Place::new();
    let told =
        "#warning \"each\" #debug \"each\\n\" #debug concat(\"at \", str(clock, 0, 1), \"\\n\")";
    place.write("film.scene", &format!("{told}\n{SCENE}"));
    place.write("late.scene", &format!("{told}\n{SCENE} #if (clock > 0.2) spere {{ 0, 1 }} #end"));
    for (words, code, count) in [
        ("film.scene -o f.png", 0, 1 + 1 + 3),
        ("film.scene -o f.gif", 0, 1 + 1 + 3),
        ("late.scene -o f.png", 1, 1 + 1 + 2 + 1),
    ] {
        let run = place.run(&format!("{words} --size 8x6 --frames 1..3 --message-format sarif"));
        let log: serde_json::Value = serde_json::from_str(&run.stdout()).expect("one document");
        let results = log["runs"][0]["results"].as_array().expect("results");
        assert_eq!((run.code(), results.len()), (code, count), "{words} {results:#?}");
    }
}

#[test]
fn commands_for_github_name_the_line() {
    let run = Place::new().run("check broken.scene --message-format github");
    let line = run.stdout();
    assert!(line.starts_with("::error file=broken.scene,line=3,endLine=3,col="), "{line}");
    assert_eq!((run.code(), line.lines().count()), (1, 1), "{line}");
}

#[test]
fn a_rule_for_make_names_what_the_scene_reads() {
    let place = Place::new();
    place.write("my part.inc", "#declare R = 1;");
    place.write("b.scene", &format!("#include \"my part.inc\" {SCENE}"));
    place.run("b.scene --size 8x6 -o b.png --deps b.d").ends(0, &[]);
    let rule = String::from_utf8(place.read("b.d")).expect("a text");
    assert_eq!(rule, "b.png: b.scene \\\n  my\\ part.inc\n\nmy\\ part.inc:\n");
}

#[test]
fn shells_and_man_know_the_commands() {
    let place = Place::new();
    for shell in ["bash", "zsh", "fish"] {
        let script = place.run(&format!("completions {shell}")).ends(0, &[]).stdout();
        assert!(script.contains("time-budget") && script.contains("merge"), "{shell}");
    }
    let page = place.run("man").ends(0, &[]).stdout();
    assert!(page.contains(".TH lucarne") && page.contains("\\-\\-time\\-budget"), "{page}");
}

#[test]
fn an_ini_file_is_rendered_as_its_options_say_and_the_command_line_counts_more() {
    let place = Place::new();
    std::fs::create_dir(place.path("film")).expect("created");
    place.write("film/a.pov", &format!("#version 3.7; {SCENE} sphere {{ clock*x, 1 }}"));
    let ini = "; a film\nInput_File_Name=a.pov\nWidth=16\nHeight=12\nAntialias=Off\nQuality=9\nDisplay=On\n[film]\nFinal_Frame=3\nSubset_End_Frame=2\n+UA\n";
    place.write("film/a.ini", ini);
    let note = "note: `film/a.ini`: `render` leaves out `quality`;";
    let run = place.run("film/a.ini").ends(0, &["a.png: 16×12", note]);
    assert!(!run.stderr().contains("display"));
    place.run("film/a.pov --size 16x12 --antialias off -o b.png").ends(0, &[]);
    assert!(place.read("a.png") == place.read("b.png"));
    place.run("film/a.ini[Film] -o f.png --size 8x6").ends(0, &["f1.png: 8×6", "f2.png: 8×6"]);
    assert!(!place.path("f3.png").exists());
    place.write("film/deep.ini", "Input_File_Name=a.pov\nWidth=16\nHeight=12\nBits_Per_Color=16\n");
    place.run("film/deep.ini -o deep.jpg").ends(0, &["deep.jpg: 16×12"]);
    place.run("film/a.ini[film] --frames 5..5/1 -o g.png").ends(0, &["g5.png: 16×12"]);
    place.write("film/bad.ini", "Input_File_Name=a.pov\n[other]\nWidht=3\n[film]\n\nHight=3\n");
    place.run("film/bad.ini").ends(0, &["a.png: 640×480"]);
    place
        .run("film/bad.ini[film]")
        .ends(2, &["line 6 of `film/bad.ini` cannot be understood: `Hight=3`"]);
    let none = ["`film/bad.ini` has no section `none`", "it has `other`, `film`"];
    place.run("film/bad.ini[none]").ends(2, &none);
    place.run("film/none.ini").ends(3, &["cannot read `film/none.ini`: there is no such file"]);
    place.write("film/empty.ini", "Width=3\n");
    place.run("film/empty.ini").ends(2, &["names no scene", "Input_File_Name"]);
}
