//! What is said of words that cannot be read.

use super::*;

#[test]
fn behind_two_dashes_every_word_is_a_file_name() {
    let place = Place::new();
    place.write("-0.scene", SCENE);
    place.run("--size 8x6 -o x.png -- -0.scene").ends(0, &["x.png"]);
    for start in ["render --", "--"] {
        let said = [
            "`-o` stands behind `--`, where every word is a file name: `lucarne render` takes one",
            "options go before it: `lucarne render -o x.png -- -0.scene`",
        ];
        place.run(&format!("{start} -0.scene -o x.png")).ends(2, &said);
    }
    let said = ["`--json` stands behind `--`", "`lucarne plan --size 8x8 --json -- -0.scene`"];
    place.run("plan --size 8x8 -- -0.scene --json").ends(2, &said);
    let two = place.run("show -- -0.scene a.scene").ends(2, &["`a.scene` stands behind `--`"]);
    assert!(!two.stderr().contains("options"), "{}", two.stderr());
    // Of several files, an option is one that is not there.
    for command in ["check", "fmt"] {
        let said = ["cannot read `--lint`: there is no such file", "options go before it"];
        place.run(&format!("{command} -- -0.scene --lint")).ends(3, &said);
    }
    // An option before it is none that stands behind it.
    let run = place.run("render --nothing -- --nothing").ends(2, &["--nothing"]);
    assert!(!run.stderr().contains("stands behind"), "{}", run.stderr());
}

#[test]
fn a_size_in_another_form_is_told_in_the_right_one() {
    let place = Place::new();
    for (words, size) in [
        ("a.scene --width 320", "320x240"),
        ("a.scene --height 240", "320x240"),
        ("a.scene --width=320 --height=200", "320x200"),
        ("--height 200 a.scene --width 320", "320x200"),
        ("a.scene -w 320 -h 200", "320x200"),
        ("a.scene -W320 -H200", "320x200"),
        ("a.scene +w320 +h200", "320x200"),
        ("+W320 +H200 a.scene", "320x200"),
        ("a.scene -h240", "320x240"),
        ("a.scene --size 320*200", "320x200"),
        ("a.scene --size 320,200", "320x200"),
        ("a.scene --size 320 200", "320x200"),
        ("--size 320 200 a.scene", "320x200"),
        ("a.scene --size=320", "320x240"),
        ("check a.scene --size 320*200", "320x200"),
        ("plan a.scene --width 320", "320x240"),
        ("show a.scene --size 320 200", "320x200"),
        ("accuracy a.scene -w320", "320x240"),
    ] {
        let said = format!("did you mean `--size {size}`?");
        let run = place.run(words);
        assert!(run.code() == 2 && run.stderr().contains(&said), "{words}: {}", run.stderr());
    }
    let fmt = place.run("fmt a.scene --width 320").ends(2, &["--width"]);
    assert!(!fmt.stderr().contains("--size"), "{}", fmt.stderr());
}
