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
