//! What is suggested for what, and what for nothing.

use super::*;

const WORDS: &[&str] =
    &["sphere", "box", "pigment", "finish", "color_map", "translate", "rotate", "red", "rgb"];

fn near(word: &str) -> Option<&'static str> {
    closest(word, WORDS.iter().copied())
}

#[test]
fn a_word_in_the_wrong_case_is_known_however_short() {
    assert_eq!(near("BOX"), Some("box"));
    assert_eq!(closest("X", ["x", "y"]), Some("x"));
}

#[test]
fn a_name_of_parts_is_known_by_their_beginnings_and_in_any_order() {
    let names = ["LeafPig", "Copper_Old", "low_error_factor", "Ball1", "Ball2"];
    for (word, meant) in [
        ("LeafPigment", Some("LeafPig")),
        ("Old_Copper", Some("Copper_Old")),
        ("low_error", Some("low_error_factor")),
        ("LeafColor", None),
        ("Ball", None),
    ] {
        assert_eq!(abridged(word, names), meant, "{word}");
    }
}

#[test]
fn a_word_with_another_ending_is_known_by_its_stem() {
    let words = ["spacing", "scattering", "extinction", "contained_by", "gather"];
    for (word, meant) in [
        ("space", Some("spacing")),
        ("scatter", Some("scattering")),
        ("extinct", Some("extinction")),
        ("spa", None),
        ("gas", None),
    ] {
        assert_eq!(begun(word, words), meant, "{word}");
    }
}

#[test]
fn a_slip_of_the_keyboard_is_known() {
    assert_eq!(near("pigmnet"), Some("pigment"));
    assert_eq!(near("shpere"), Some("sphere"));
    assert_eq!(near("colour_map"), Some("color_map"));
    assert_eq!(near("colormap"), Some("color_map"));
    assert_eq!(near("bxo"), Some("box"));
}

#[test]
fn another_spelling_of_a_word_is_nearer_than_a_slip() {
    let grays = ["Grey", "Gray05", "Gray10", "Gray50", "Gray15"];
    assert_eq!(closest("Grey5", grays), Some("Gray05"));
    assert_eq!(closest("Grey50", grays), Some("Gray50"));
    assert_eq!(closest("LightColour", ["LightColor", "LightColours"]), Some("LightColor"));
    assert_eq!(closest("A0", ["A00", "A10"]), Some("A00"));
}

#[test]
fn a_word_of_the_same_parts_is_known_by_what_they_mean() {
    let words = ["pretrace_start", "pretrace_end", "maximum_reuse", "nearest_count", "max_sample"];
    for (word, meant) in [
        ("pretrace_begin", "pretrace_start"),
        ("pretrace_stop", "pretrace_end"),
        ("max_reuse", "maximum_reuse"),
        ("count_nearest", "nearest_count"),
        ("num_nearest", "nearest_count"),
    ] {
        assert_eq!(reworded(word, words), Some(meant), "{word}");
    }
    for word in ["start", "retrace_x", "begin_finish", "max", "pretrace"] {
        assert_eq!(reworded(word, words), None, "{word}");
    }
}

#[test]
fn a_word_that_resembles_nothing_gets_no_hint() {
    assert_eq!(near("wood"), None);
    assert_eq!(near("xy"), None);
    assert_eq!(near("bax1"), None);
    assert_eq!(near(""), None);
    assert_eq!(near(&"pigment".repeat(1000)), None);
}

#[test]
fn members_of_a_series_are_told_from_slips() {
    for (a, b) in [("Ball1", "Ball2"), ("Ball", "Ball1"), ("RadiusA", "RadiusB"), ("p_a", "p_b")] {
        assert!(are_of_a_series(a, b) && are_of_a_series(b, a), "{a} {b}");
    }
    for (a, b) in [("Ball", "Bal"), ("Radius", "Radiuz"), ("RED", "REC"), ("RadiusA", "Radiusa")] {
        assert!(!are_of_a_series(a, b), "{a} {b}");
    }
}

#[test]
fn the_order_of_candidates_does_not_matter() {
    assert_eq!(closest("cat", ["bat", "car"]), Some("car"));
    assert_eq!(closest("cat", ["car", "bat"]), Some("car"));
    assert_eq!(closest("cat", ["cap", "can"]), Some("can"));
}

#[test]
fn other_tools_words_are_known_in_any_case() {
    assert!(foreign("Cube").eq(["box"]));
    assert!(foreign("shininess").eq(["phong_size"]));
    assert!(foreign("target").eq(["point_at", "look_at"]));
    assert_eq!(foreign("sphere").next(), None);
}

#[test]
fn each_pair_of_a_foreign_word_and_ours_stands_once() {
    for (at, pair @ (word, ours)) in FOREIGN.iter().enumerate() {
        assert_ne!(word, ours);
        assert_eq!(FOREIGN.iter().position(|other| other == pair), Some(at), "{word}");
    }
}
