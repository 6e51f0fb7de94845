//! Each effect is quoted by the words that call for it: one place for each, with its values.
//!
//! Where all that is quoted is cut out of a scene of `scenes/`, the effect is off, with these exceptions:
//!
//! * of the clear colours of a map only the first is quoted, so the others still call for their effects;
//! * a pattern leaves its colours behind, and `ks` the seed's other words, so the scene is invalid.
//!
//! Besides, a word that is cut may uncover the same word of a declared or default finish, interior or light; no
//! scene of `scenes/` has that.

use lucarne::pattern::Kind;
use lucarne::vocabulary::{Family, Word};

use super::*;

/// The words with which a quote of an effect begins; besides, it may begin with a name or a macro's call.
fn words(effect: Effect) -> &'static [&'static str] {
    match effect {
        Effect::Diffuse | Effect::Shadows => &["light_source", "object"],
        Effect::Highlights => &["phong", "specular", "ks"],
        Effect::Attenuation => &["spotlight", "cylinder", "fade_distance", "media_attenuation"],
        Effect::AreaLights => &["area_light"],
        Effect::Projections => &["projected_through"],
        Effect::LightGroups => &["light_group"],
        Effect::DoubleIllumination => &["double_illuminate", "diffuse"],
        Effect::Reflection => &["reflection", "ks"],
        // Also every colour's word.
        Effect::Transparency | Effect::ColoredShadows => &["image_map"],
        Effect::Refraction => &["ior"],
        Effect::Absorption => &["fade_distance"],
        Effect::Dispersion => &["dispersion"],
        Effect::Hiding => &["no_image", "no_reflection"],
        Effect::Sky => &["pigment"],
        Effect::FocalBlur => &["aperture"],
        Effect::CameraNormal => &["normal"],
        Effect::Fog => &["fog"],
        Effect::Rainbows => &["rainbow"],
        // Also every pattern's word.
        Effect::Patterns => &["object", "material_map"],
        Effect::Antialiasing => &[],
    }
}

/// Whether a quote begins with a word that can call for the effect, after the bracket and the values of a map's
/// entry.
fn begins_well(effect: Effect, quote: &str) -> bool {
    let is_letter = |c: char| c.is_ascii_alphabetic();
    let text = quote.trim_start_matches(|c: char| c == '[' || !is_letter(c));
    let word = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next();
    let word = word.unwrap_or_default();
    let family = Word::from_name(word).map(Word::family);
    match effect {
        Effect::Patterns if Kind::of_word(word).is_some() => return true,
        Effect::Patterns if family == Some(Family::Pattern) || word == "function" => return true,
        Effect::Transparency | Effect::ColoredShadows if family == Some(Family::Color) => {
            return true;
        }
        _ => {}
    }
    words(effect).contains(&word) || word.starts_with(|c: char| c.is_ascii_uppercase())
}

/// What a scene quotes for an effect that is on.
fn quoted(seen: &Seen, effect: Effect) -> Option<Vec<Span>> {
    let called = seen.plan.called(effect)?;
    Some(called.by.iter().map(|site| site.span).collect())
}

fn texts(seen: &Seen, spans: &[Span]) -> Vec<String> {
    spans.iter().map(|span| seen.sources.text(*span).to_owned()).collect()
}

#[test]
fn without_what_is_quoted_no_scene_has_the_effect() {
    let (mut called_for, mut cut) = (BTreeSet::from([Effect::Antialiasing]), 0);
    for name in scenes() {
        let seen = see(&name, &Changed::default());
        assert_eq!(seen.errors, "", "{name}");
        for effect in Effect::ALL.into_iter().filter(|effect| *effect != Effect::Antialiasing) {
            let Some(spans) = quoted(&seen, effect) else { continue };
            let colored = matches!(effect, Effect::Transparency | Effect::ColoredShadows);
            called_for.insert(effect);
            let quotes = texts(&seen, &spans);
            assert!(!quotes.is_empty(), "{name}: nothing calls for {effect:?}");
            for quote in &quotes {
                assert!(begins_well(effect, quote), "{name}: {quote:?} calls for {effect:?}");
            }
            let rest = see(&name, &without(&spans, &seen.sources));
            if rest.errors.is_empty() {
                cut += 1;
                let left = quoted(&rest, effect).map(|spans| texts(&rest, &spans));
                let is_of_map = |quote: &String| colored && quote.starts_with('[');
                let is_gone = left.is_none_or(|quotes| quotes.iter().all(is_of_map));
                assert!(is_gone, "{name}: {effect:?} without {quotes:#?}");
                continue;
            }
            let may_break =
                effect == Effect::Patterns || quotes.iter().any(|quote| quote.starts_with("ks"));
            assert!(may_break, "{name}: invalid without {quotes:#?}\n{}", rest.errors);
        }
    }
    assert!(cut > 500, "{cut} cuts");
    assert_eq!(called_for, BTreeSet::from(Effect::ALL), "each effect in some scene");
}

/// Asserts what a text quotes for an effect beside a light, a sphere and a camera.
fn assert_quotes(effect: Effect, cases: &[(&str, &[&str])]) {
    for (text, expected) in cases {
        let seen = see_text(&format!("{LIT}{text}"));
        assert_eq!(seen.errors, "", "{text}");
        let found = quoted(&seen, effect).map(|spans| texts(&seen, &spans));
        assert_eq!(found.unwrap_or_default(), *expected, "{text}");
    }
}

#[test]
fn the_last_of_each_word_of_a_finish_is_quoted_with_its_values() {
    assert_quotes(
        Effect::Reflection,
        &[
            (
                "sphere { x, 1 finish { reflection { 0.1, 1 falloff 2 } } }",
                &["reflection { 0.1, 1 falloff 2 }"],
            ),
            (
                "sphere { x, 1 finish { reflection 0.3 reflection 0 reflection rgb 0 red 0.5 } }",
                &["reflection rgb 0 red 0.5"],
            ),
            ("sphere { x, 1 finish { reflection 0.3 reflection 0 } }", &[]),
            (
                "#declare F = finish { reflection 0.3 } sphere { x, 1 finish { F reflection 0.5 } } sphere { y, 1 finish { F phong 1 } }",
                &["reflection 0.3", "reflection 0.5"],
            ),
            (
                "#default { finish { reflection 0.1 } } sphere { 0, 1 finish { phong 1 } }",
                &["reflection 0.1"],
            ),
            // Equal finishes are one, and each is quoted.
            (
                "sphere { x, 1 finish { reflection 0.5 } } sphere { y, 1 finish { reflection 1/2 } }",
                &["reflection 0.5", "reflection 1/2"],
            ),
            ("sphere { x, 1 finish { kd 0.5 ks 0.6 phong_exponent 60 } }", &["ks 0.6"]),
            (
                "#declare F = finish { kd 0.5 ks 0.6 phong_exponent 60 } sphere { x, 1 finish { F ks 0.2 } }",
                &["ks 0.2"],
            ),
            (
                "#default { finish { reflection 0.1 } } sphere { 0, 1 finish { kd 0.5 ks 0.6 phong_exponent 60 } }",
                &["ks 0.6"],
            ),
            // A directive belongs to the values around it.
            (
                "sphere { x, 1 finish { reflection #if (1) 0.3 #else 0.5 #end } }",
                &["reflection #if (1) 0.3 #else 0.5 #end"],
            ),
            (
                "sphere { x, 1 finish { #if (1) reflection 0.3 #else reflection 0.5 #end } }",
                &["reflection 0.3"],
            ),
            (
                "#macro M(F) finish { reflection F } #end sphere { x, 1 M(0.2) } sphere { y, 1 M(0.3) }",
                &["reflection F"],
            ),
            (
                "#macro Word() reflection #end #macro Weight() 0.25 #end sphere { x, 1 finish { Word() Weight()*2 } }",
                &["Word() Weight()*2"],
            ),
        ],
    );
    assert_quotes(
        Effect::Highlights,
        &[
            ("sphere { x, 1 finish { phong 1 phong_size 9 specular 0 } }", &["phong 1"]),
            (
                "sphere { x, 1 finish { phong 1 specular 0.5 phong 0 roughness 0.1 } }",
                &["specular 0.5"],
            ),
            ("sphere { x, 1 finish { phong albedo 0.4 phong 0.5 } }", &["phong 0.5"]),
        ],
    );
    assert_quotes(
        Effect::DoubleIllumination,
        &[
            ("disc { x, z, 1 finish { diffuse 0.6, 0.3 } }", &["diffuse 0.6, 0.3"]),
            ("disc { x, z, 1 finish { diffuse 0.6, 0.3 diffuse 1 } }", &[]),
        ],
    );
}

#[test]
fn one_index_of_refraction_is_quoted_for_each_interior() {
    let ball = "sphere { x, 1 pigment { rgbt 1 } ";
    for (filling, quote) in [
        ("finish { ior 1.5 ior 1 ior 1.2 }", "ior 1.2"),
        ("interior { ior 1.5 ior 1 ior 1.2 }", "ior 1.2"),
        ("interior { ior 1.3 } finish { ior 1.5 }", "ior 1.5"),
        ("material { interior { ior 1.3 } }", "ior 1.3"),
    ] {
        assert_quotes(Effect::Refraction, &[(&format!("{ball} {filling} }}"), &[quote])]);
    }
    let glass = "#declare Glass = interior { ior 1.3 };";
    let used = format!("{glass} {ball} interior {{ Glass ior 1.5 }} }}");
    // An opaque solid of the same glass is not quoted.
    let opaque =
        format!("{ball} interior {{ ior 1.50 }} }} sphere {{ y, 1 interior {{ ior 1.5 }} }}");
    assert_quotes(Effect::Refraction, &[(&used, &["ior 1.5"]), (&opaque, &["ior 1.50"])]);
}

#[test]
fn of_the_clear_colours_of_a_pigment_the_first_is_quoted() {
    for (pigment, quote) in [
        ("rgb 1 transmit 0.5", "rgb 1 transmit 0.5"),
        ("red 1 transmit 0.5", "red 1 transmit 0.5"),
        ("color Glass red 0", "color Glass red 0"),
        ("rgb Glass*0.5", "rgb Glass*0.5"),
        (
            "rgb 1 transmit #if (1) 0.5 #else 0 #end red 0",
            "rgb 1 transmit #if (1) 0.5 #else 0 #end red 0",
        ),
        ("checker rgb 1, Glass", "Glass"),
        ("checker rgb 0.5 pigment { rgb 1 transmit 0.5 }", "rgb 1 transmit 0.5"),
        ("gradient y color_map { [0 rgb 1] [0.5 rgbt 0.5] [1 rgbf 0.5] }", "[0.5 rgbt 0.5]"),
        (
            "gradient y color_map { [0, 0.5 color rgb 1 color rgbt 1] [1 rgb 1] }",
            "[0, 0.5 color rgb 1 color rgbt 1]",
        ),
        ("gradient y color_map { #for (I, 0.1, 1, 0.3) [I rgbt I] #end }", "[I rgbt I]"),
        ("gradient y color_map { [-1 rgb 0] Tints }", "[0 rgb 1 transmit 0.4]"),
        ("Window", "rgbt 0.9"),
        ("Window rgbt 0.3", "rgbt 0.3"),
        ("Window gradient y color_map { [0 rgbt 1] }", "[0 rgbt 1]"),
        ("Tint(0.3)", "rgb 1 transmit T"),
    ] {
        let scene = format!(
            "#declare Glass = rgbt <1, 1, 1, 0.5>; #macro Tint(T) rgb 1 transmit T #end
            #declare Window = pigment {{ rgbt 0.9 }}
            #declare Tints = color_map {{ [0 rgb 1 transmit 0.4] [1 rgbt 0.5] }}
            sphere {{ x, 1 pigment {{ {pigment} }} }}"
        );
        assert_quotes(Effect::Transparency, &[(&scene, &[quote])]);
        assert_quotes(Effect::ColoredShadows, &[(&scene, &[quote])]);
    }
    // Of equal textures only those whose objects cast shadows colour them.
    let two = "sphere { x, 1 pigment { rgbt 0.5 } no_shadow } sphere { y, 1 pigment { rgbt 1/2 } }";
    assert_quotes(Effect::Transparency, &[(two, &["rgbt 0.5", "rgbt 1/2"])]);
    assert_quotes(Effect::ColoredShadows, &[(two, &["rgbt 1/2"])]);
}

#[test]
fn a_pattern_is_quoted_by_its_word_and_value() {
    let dawn = "#declare Dawn = color_map { [0 rgb 0] [1 rgb 1] }
        plane { y, 0 pigment { gradient y color_map { Dawn } } }";
    let based = "#declare P = pigment { gradient x };
        plane { y, 0 pigment { P scale 2 } } plane { y, -1 pigment { P gradient y } }";
    let inside = "#macro Along(D) gradient D #end plane { y, 0 pigment { Along(y) } }";
    assert_quotes(
        Effect::Patterns,
        &[
            ("plane { y, 0 pigment { checker rgb 1, pigment { rgb 0.5 } } }", &["checker"]),
            ("plane { y, 0 pigment { gradient <0, 1, 1> scale 3 } }", &["gradient <0, 1, 1>"]),
            (
                "box { 0, 1 texture { gradient y texture_map { [0 pigment { rgb 1 }] [1 pigment { rgb 0 }] } } }",
                &["gradient y"],
            ),
            (
                "sky_sphere { pigment { checker rgb 1 rgb 1 } pigment { gradient y } }",
                &["gradient y"],
            ),
            (dawn, &["gradient y"]),
            (based, &["gradient x", "gradient y"]),
            (inside, &["gradient D"]),
        ],
    );
}

#[test]
fn a_light_is_quoted_whole_and_its_attenuation_by_a_word() {
    let shadows = |text: &str, quote: &str| {
        let seen = see_text(&format!("sphere {{ 0, 1 }} {text}"));
        assert_eq!(seen.errors, "", "{text}");
        let spans = quoted(&seen, Effect::Shadows).unwrap_or_default();
        assert_eq!(texts(&seen, &spans), [quote], "{text}");
    };
    let lamp = "light_source { 9, rgb 1 }";
    shadows(lamp, lamp);
    shadows("light_source { 9, color red 1 green 0 }", "light_source { 9, color red 1 green 0 }");
    shadows(&format!("#declare L = {lamp} object {{ L }}"), "object { L }");
    shadows(&format!("#macro M() {lamp} #end M() M()"), lamp);
    shadows(&format!("#macro M() {lamp} #end object {{ M() }}"), "object { M() }");
    shadows(
        &format!("#declare U = union {{ {lamp} }} object {{ U }} object {{ U scale 2 }}"),
        lamp,
    );
    let opened = "#macro Open() light_source { #end #macro Close() } #end Open() 9, rgb 1 Close()";
    shadows(opened, "Open() 9, rgb 1 Close()");
    assert_quotes(
        Effect::Attenuation,
        &[
            (
                "light_source { 9, rgb 1 spotlight radius 9 falloff 20 point_at 0 fade_distance 3 fade_power 2 }",
                &["spotlight", "fade_distance 3"],
            ),
            ("light_source { 9, rgb 1 point_at 0 spotlight parallel cylinder }", &["cylinder"]),
            (
                "light_source { 9, rgb 1 fade_distance 3 fade_distance 0 fade_power 2 fade_distance 5 }",
                &["fade_distance 5"],
            ),
            ("light_source { 9, rgb 1 fade_distance 3 fade_power 2 fade_distance 0 }", &[]),
            (
                "#declare L = light_source { 9, rgb 1 fade_power 2 fade_distance 3 } light_source { L } light_source { L fade_distance 5 }",
                &["fade_distance 3", "fade_distance 5"],
            ),
        ],
    );
}

#[test]
fn what_hides_an_object_is_quoted_where_it_holds_for_one() {
    assert_quotes(
        Effect::Hiding,
        &[
            ("sphere { x, 1 no_image no_reflection }", &["no_image", "no_reflection"]),
            // What was undone stays so.
            (
                "#declare S = sphere { x, 1 no_image }; object { S no_image off no_image on }",
                &["no_image on"],
            ),
            ("union { union { sphere { x, 1 no_image } } no_image }", &["no_image", "no_image"]),
            ("union { light_source { 9, rgb 1 } no_image }", &[]),
            ("#declare S = sphere { x, 1 no_image }; object { S no_image off }", &[]),
        ],
    );
}

#[test]
fn of_a_sky_its_pigments_are_quoted() {
    assert_quotes(
        Effect::Sky,
        &[
            (
                "sky_sphere { pigment { rgb 1 } pigment { gradient y } rotate x }",
                &["pigment { rgb 1 }", "pigment { gradient y }"],
            ),
            // The last sky counts.
            (
                "sky_sphere { pigment { rgb 1 } } sky_sphere { pigment { rgb 0.5 } }",
                &["pigment { rgb 0.5 }"],
            ),
        ],
    );
}

#[test]
fn each_rainbow_is_quoted_that_a_ray_can_see() {
    assert_quotes(
        Effect::Rainbows,
        &[(
            "#declare R = rainbow { direction z angle 42 width 5 color_map { [0 rgb 1] } }; rainbow { R } rainbow { R angle 95 }",
            &["rainbow { R }"],
        )],
    );
}

#[test]
fn each_fog_is_quoted_that_veils_something() {
    assert_quotes(
        Effect::Fog,
        &[
            (
                "#declare F = fog { distance 9 rgb 1 }; fog { F } fog { F fog_type 2 }",
                &["fog { F }", "fog { F fog_type 2 }"],
            ),
            ("fog { distance 9 rgb 1 } fog { distance 9 rgbt 1 }", &["fog { distance 9 rgb 1 }"]),
        ],
    );
}
