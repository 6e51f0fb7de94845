//! What a block takes over from `#default`, measured on POV-Ray 3.7.

use super::*;
use crate::color::Rgb;
use crate::scene::{Finish, NormalKind, Reflection, Scene};

/// The scene of a text without mistakes.
fn scene(text: &str) -> Scene {
    let mut road = Road::new(&Shadowing, Options::new(Dialect::Pov));
    let file = road.read("a.pov", text.as_bytes().to_vec());
    let ast = road.parse(file);
    let scene = road.evaluate(ast);
    assert!(!road.diagnostics.has_errors(), "{text}");
    scene
}

/// The reflection of the last finish.
fn reflection(default: &str, own: &str) -> Reflection {
    let text = format!(
        "#default {{ finish {{ reflection {{ 0.8, 0.9 {default} }} }} }}
        sphere {{ 0, 1 finish {{ reflection {{ {own} }} }} }}"
    );
    match scene(&text).finishes.last() {
        Some(Finish::Classic(finish)) => *finish.reflection.clone().expect("it reflects"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn one_colour_is_the_greatest_only_with_fresnel_of_its_own() {
    let half = Rgb::gray(0.5);
    for (default, own, minimum, fresnel) in [
        ("", "0.5", half, false),
        ("", "0.5 fresnel", Rgb::BLACK, true),
        ("fresnel", "0.5", half, true),
        ("fresnel", "0.5 fresnel", Rgb::BLACK, true),
        ("fresnel", "0.5 fresnel off", half, false),
    ] {
        let read = reflection(default, own);
        assert_eq!((read.minimum, read.maximum), (minimum, half), "{default} {own}");
        assert_eq!(read.fresnel, fresnel, "{default} {own}");
    }
}

#[test]
fn a_pattern_with_an_amount_may_follow_a_normal_map_that_is_inherited() {
    let scene = scene(
        "#default { texture { pigment { rgb 1 } normal { gradient x normal_map { [0 bumps] [1 dents] } } } }
        sphere { 0, 1 normal { spiral1 4 0.6 } }",
    );
    let own = scene.normals.last().expect("a normal");
    match &own.kind {
        NormalKind::Map { entries, .. } => assert_eq!(entries.len(), 2),
        other => panic!("{other:?}"),
    }
}
