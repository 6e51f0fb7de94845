//! Old forms and their fixes.

use crate::diagnostic::mend::apply;
use crate::diagnostic::{Code, Diagnostic, Severity};
use crate::road::{Options, Road};
use crate::source::NoFiles;
use crate::vocabulary::Dialect;
use crate::world::World;

/// What a text becomes, and what is said of it.
fn compiled(text: &str) -> (World, Vec<Diagnostic>) {
    let mut options = Options::new(Dialect::Pov);
    options.legacy = true;
    options.levels.set(Code::LegacyForm, crate::diagnostic::Level::Warn);
    let mut road = Road::new(&NoFiles, options);
    let (world, _) = road.compile("a.pov", text);
    let told = road.diagnostics.iter().filter(|one| one.code != Code::NotSupportedYet).cloned();
    (world, told.collect())
}

const BEFORE: &str = "#version 3.7; global_settings { assumed_gamma 1 }\n";

/// The text is told once, as an old form; its fix gives `new`, the same World, and nothing to tell.
#[track_caller]
fn becomes(old: &str, new: &str) {
    let (world, told) = compiled(&format!("{BEFORE}{old}"));
    assert!(told.iter().all(|one| one.code == Code::LegacyForm), "{told:#?}");
    assert_eq!(told.len(), 1, "{told:#?}");
    let (fixed, _) = apply(&format!("{BEFORE}{old}"), told.iter());
    assert_eq!(fixed, format!("{BEFORE}{new}"));
    let (after, rest) = compiled(&fixed);
    assert_eq!(rest, []);
    assert_eq!(world, after);
}

/// The text is told, and no fix is offered.
#[track_caller]
fn is_told(old: &str, words: &str) {
    let (_, told) = compiled(&format!("{BEFORE}{old}"));
    let legacy: Vec<_> = told.iter().filter(|one| one.code == Code::LegacyForm).collect();
    assert_eq!(legacy.len(), 1, "{told:#?}");
    assert!(legacy[0].message.contains(words), "{}", legacy[0].message);
    assert!(legacy[0].fixes.is_empty(), "{:?}", legacy[0].fixes);
}

#[track_caller]
fn is_todays(text: &str) {
    let (_, told) = compiled(&format!("{BEFORE}{text}"));
    assert!(told.iter().all(|one| one.severity != Severity::Warning), "{told:#?}");
}

#[test]
fn components_of_a_colour_become_a_vector() {
    let sphere = |color: &str| format!("sphere {{ 0, 1 pigment {{ {color} }} }}");
    for (old, new) in [
        ("color red 1 green 0.5", "color rgb <1, 0.5, 0>"),
        ("colour blue 0.25+.5", "colour rgb <0, 0, 0.25+.5>"),
        ("red 1", "rgb <1, 0, 0>"),
        ("color filter 0.5 red 0.3", "color rgbf <0.3, 0, 0, 0.5>"),
        ("color red 1 transmit 0.25", "color rgbt <1, 0, 0, 0.25>"),
        ("color green 1 filter .1 transmit .2", "color rgbft <0, 1, 0, .1, .2>"),
    ] {
        becomes(&sphere(old), &sphere(new));
    }
    is_todays(&sphere("color rgb 1 filter 0.5"));
    is_todays("#declare C = rgb 1; sphere { 0, 1 pigment { color C red 0.5 } }");
    is_told("sphere { 0, 1 pigment { color red /* r */ 1 } }", "components");
}

#[test]
fn an_entry_with_two_values_becomes_two() {
    let map = |entry: &str| {
        format!("sphere {{ 0, 1 pigment {{ gradient y color_map {{ {entry} [1 rgb 1] }} }} }}")
    };
    for (old, new) in [
        ("[0 0.5 color rgb x color rgb y]", "[0 color rgb x] [0.5 color rgb y]"),
        ("[0, .5 rgb x rgb y]", "[0 rgb x] [.5 rgb y]"),
    ] {
        becomes(&map(old), &map(new));
    }
    is_todays(&map("[0.5 rgb x filter 0.5]"));
    is_todays(&format!("#declare C = rgb 1; {}", map("[0.5 C filter 0.5]")));
}

#[test]
fn a_declared_number_vector_or_colour_gets_its_semicolon() {
    becomes("#declare A = 1\nsphere { 0, A }", "#declare A = 1;\nsphere { 0, A }");
    becomes("#declare A = 2*<1,2,3> // a\n", "#declare A = 2*<1,2,3>; // a\n");
    becomes("#local A = color rgb 1\n", "#local A = color rgb 1;\n");
    becomes("#declare A = sqrt(4)\n", "#declare A = sqrt(4);\n");
    is_todays("#declare A = \"a\" #declare B = sphere { 0, 1 } #declare C = A #declare D = 1;");
    is_todays("#declare A = array[2] { 1, 2 } #macro M() 1 #end #declare B = M()");
}

#[test]
fn vectors_get_their_commas() {
    becomes("sphere { <1 2,3>, 1 }", "sphere { <1, 2,3>, 1 }");
    becomes("sphere { <1 - 2 3>, 1 }", "sphere { <1 - 2, 3>, 1 }");
    is_todays("sphere { <1, 2 ,3>, 1 }");
}

#[test]
fn a_vector_without_commas_that_lost_a_component_gets_it_back() {
    let text = format!("{BEFORE}camera {{ location <0 3 -10> }} sphere {{ <1 3 - 2>, 1 }}");
    let (_, told) = compiled(&text);
    let (fixed, _) = apply(&text, told.iter().filter(|one| one.code == Code::LegacyForm));
    assert_eq!(&fixed[BEFORE.len()..], "camera { location <0, 3, -10> } sphere { <1, 3 - 2>, 1 }");
    assert!(told[0].message.contains("`3 -10` is one number"), "{}", told[0].message);
}

#[test]
fn old_words_become_todays() {
    let fixed = |old: &str| {
        let text = format!("{BEFORE}{old}");
        let (_, told) = compiled(&text);
        // What is no word any more is an error, with the same fix.
        let old = |one: &&Diagnostic| matches!(one.code, Code::LegacyForm | Code::UnknownWord);
        apply(&text, told.iter().filter(old)).0[BEFORE.len()..].to_owned()
    };
    assert_eq!(fixed("composite { sphere { 0, 1 } }"), "union { sphere { 0, 1 } }");
    assert_eq!(fixed("blob { component 1, 2, <0, 1, 2> }"), "blob { sphere { <0, 1, 2>, 2, 1 } }");
    assert_eq!(fixed("global_settings { hf_gray_16 on }"), "global_settings {  }");
    assert_eq!(
        fixed("#declare F = finish { reflection rgb 0.3 reflection_exponent 2 };"),
        "#declare F = finish { reflection { rgb 0.3 exponent 2 } };"
    );
    assert_eq!(
        fixed("#declare C = color rgb 1 alpha 0.5;"),
        "#declare C = color rgb 1 filter 0.5;"
    );
}

#[test]
fn what_has_no_sure_rewriting_is_told() {
    is_told("sphere { 0, 1 finish { ior 1.5 } pigment { rgbf 1 } }", "`ior` in a finish");
    is_told("#declare F = finish { refraction 1 };", "`refraction` in a finish");
    is_told("#declare F = finish { reflection_exponent 2 };", "`reflection_exponent`");
    is_told("#declare T = texture { tiles { texture { pigment { rgb 1 } } } };", "`tiles`");
    is_todays("sphere { 0, 1 interior { ior 1.5 } pigment { rgbf 1 } }");
}

#[test]
fn branches_and_macros_that_are_not_run_are_looked_at() {
    let text =
        "#if (0) #declare A = 1 #else #macro M() sphere { 0, 1 pigment { color red 1 } } #end #end";
    let (_, told) = compiled(&format!("{BEFORE}{text}"));
    assert_eq!(told.len(), 2, "{told:#?}");
}

#[test]
fn a_file_that_does_not_say_its_version_is_mended_at_the_right_places() {
    let sphere = "sphere { 0, 1 }\n";
    for (old, new) in [
        (
            sphere.to_owned(),
            format!("#version 3.7; global_settings {{ assumed_gamma srgb }}\n{sphere}"),
        ),
        (
            format!("// a\n#version 3.6;\n{sphere}"),
            format!("// a\n#version 3.7;\nglobal_settings {{ assumed_gamma srgb }}\n{sphere}"),
        ),
        (
            format!("global_settings {{ max_trace_level 3 }}\n{sphere}"),
            format!(
                "#version 3.7;\nglobal_settings {{ assumed_gamma srgb max_trace_level 3 }}\n{sphere}"
            ),
        ),
        (
            format!("global_settings {{ assumed_gamma 1 }}\n{sphere}"),
            format!("#version 3.7;\nglobal_settings {{ assumed_gamma 1 }}\n{sphere}"),
        ),
    ] {
        let (mut world, told) = compiled(&old);
        assert_eq!(told.len(), 1, "{told:#?}");
        let (fixed, _) = apply(&old, told.iter());
        assert_eq!(fixed, new);
        // The version counts for a picture with alpha.
        assert!(world.backdrop.only_mirrored);
        world.backdrop.only_mirrored = false;
        assert_eq!(compiled(&fixed), (world, Vec::new()));
    }
}
