//! Fog as it is read, and flags of objects: which are seen, and which fog fills.

use super::{VERSION, assert_alike, world};

/// Which objects are hollow.
fn hollow(text: &str) -> Vec<bool> {
    let fog = "fog { distance 9 rgb 1 }";
    let (world, said) = world(&format!("{VERSION} {fog} {text}"));
    assert_eq!(said, "", "{text}");
    world.objects.iter().map(|object| object.hollow).collect()
}

#[test]
fn the_last_part_without_an_interior_says_whether_all_are_hollow() {
    // As POV-Ray 3.7 shows them: h is a hollow sphere, s a solid one, i one with an interior.
    let text = |short: &str| {
        let sphere = |of: char, items: &str| (of, format!("sphere {{ 0, 1 {items} }}"));
        let parts = [sphere('h', "hollow"), sphere('s', ""), sphere('i', "interior { ior 1.2 }")];
        let long = |c: char| match parts.iter().find(|(of, _)| *of == c) {
            Some((_, part)) => format!("{part} "),
            None => c.to_string(),
        };
        let words = short.split(' ').map(|word| match word {
            "hollow" | "off" | "union" | "merge" | "{" | "}" => format!("{word} "),
            parts => parts.chars().map(long).collect(),
        });
        words.collect::<String>()
    };
    for (short, filled) in [
        ("h", "h"),
        ("s", "s"),
        ("union { hs }", "ss"),
        ("union { sh }", "hh"),
        ("union { sh hollow off }", "hh"),
        ("union { hs hollow }", "hh"),
        ("union { shs }", "sss"),
        ("union { union { hh } s }", "sss"),
        ("union { s union { hh } }", "hhh"),
        ("union { s union { ss hollow } }", "hhh"),
        ("union { union { ss hollow } s }", "sss"),
        ("union { hi }", "hs"),
        ("union { hi hollow }", "hh"),
        ("union { i union { s hollow } i }", "shs"),
        ("merge { hs }", "ss"),
        ("merge { sh }", "hh"),
    ] {
        let filled: Vec<bool> = filled.chars().map(|c| c == 'h').collect();
        assert_eq!(hollow(&text(short)), filled, "{short}");
    }
}

#[test]
fn off_undoes_hollow_for_a_solid_but_not_for_an_operation() {
    let ball = "#declare Ball = sphere { 0, 1 hollow };";
    assert_eq!(hollow(&format!("{ball} object {{ Ball hollow off }}")), [false]);
    assert_eq!(hollow(&format!("{ball} union {{ object {{ Ball }} hollow off }}")), [true]);
    assert_eq!(hollow(&format!("{ball} union {{ object {{ Ball hollow off }} }}")), [false]);
}

#[test]
fn without_fog_nothing_is_hollow() {
    let (world, said) = world(&format!("{VERSION} sphere {{ 0, 1 hollow }}"));
    assert_eq!((said.as_str(), world.objects[0].hollow), ("", false));
}

#[test]
fn fogs_that_mean_the_same_are_the_same() {
    let fog = |items: &str| format!("fog {{ distance 9 rgb <1, 0.5, 0> {items} }}");
    assert_alike(&fog("fog_offset 3 fog_alt 2 up x"), &fog(""));
    assert_alike(&fog("fog_type 2"), &fog("fog_type 2.7 up 3*y translate 5 scale 2"));
    assert_alike(&fog("fog_type 2 up x"), &fog("fog_type 2 rotate -90*z"));
    assert_alike(&fog("fog_type 2 up x"), &fog("fog_type 2 rotate 40*y up x"));
    assert_alike(&fog("turbulence 0"), &fog("octaves 6"));
    assert_alike(&fog("octaves 3 turbulence 2"), &fog("turbulence <2, 2, 2> octaves 3.5"));
    assert_alike(&fog("turbulence 1 turb_depth 0"), &fog(""));
    assert_alike(&fog("filter 0.5"), "fog { rgbf <1, 0.5, 0, 0.5> distance 9 }");
    assert_alike("fog { rgbt 1 distance 9 }", "fog { rgb 1 distance 1e-11 }");
    assert_alike(&format!("#declare F = {} fog {{ F }}", fog("")), &fog(""));
}

#[test]
fn a_word_of_visibility_holds_for_all_below_and_off_undoes_it_for_the_object_itself() {
    let flags = |text: &str| {
        let (world, said) =
            world(&format!("{VERSION} #declare Ball = sphere {{ 0, 1 no_image }} {text}"));
        assert_eq!(said, "");
        let object = world.objects[0];
        (object.in_image, object.in_reflections, object.double_illuminate)
    };
    assert_eq!(flags("object { Ball }"), (false, true, false));
    assert_eq!(flags("object { Ball no_image off }"), (true, true, false));
    assert_eq!(flags("union { object { Ball } no_image off }"), (false, true, false));
    assert_eq!(
        flags(
            "union { sphere { 0, 1 no_reflection off double_illuminate off } no_reflection double_illuminate }"
        ),
        (true, false, true)
    );
}
