//! What cannot change the picture is not in the World: it is told with its place and the reason, and the
//! picture, the counters and the other lines are as if it had never been written.

use lucarne::plan::print;

use super::*;

/// Flags that hide an object from every ray.
const HIDE: &str = "no_image no_reflection no_shadow";

/// Mirrors, glass, a pattern and a shadow: every kind of ray.
const ROOM: &str = "camera { location <0, 1, 6> look_at 0 }
light_source { <4, 8, 6>, rgb 1 }
plane { y, -1.5 pigment { checker rgb 1 rgb 0.2 } finish { reflection 0.2 } }
sphere { <-1.5, 0, 0>, 1 pigment { rgb 1 } finish { reflection 0.6 } }
sphere { <1.5, 0, 1>, 1 pigment { rgbf <1, 0.9, 0.9, 0.9> } finish { reflection { 0, 1 fresnel } }
  interior { ior 1.5 } }
";

/// What was dropped, as the plan says it.
fn told(seen: &Seen) -> Vec<String> {
    let text = print::dump(&seen.plan, &seen.sources);
    let lines = text.lines().skip_while(|line| *line != "dropped").skip(1);
    lines.take_while(|line| line.starts_with("  ")).map(|line| line.trim().to_owned()).collect()
}

fn png(world: &World, plan: &Plan) -> Vec<u8> {
    encode(&traced(world, plan).film, Depth::Sixteen, Format::Png).expect("a picture")
}

/// The scene with an object that lacks its flags in the text, and has them in the World: what would be
/// traced if nothing was dropped.
fn left_in(scene: &str, object: &str) -> Vec<u8> {
    let before = see_text(scene).world.objects.len();
    let Seen { mut world, plan, .. } = see_text(&format!("{scene}{object}"));
    assert!(world.objects.len() > before, "{object}");
    for object in &mut world.objects[before..] {
        (object.in_image, object.in_reflections, object.casts_shadow) = (false, false, false);
    }
    png(&world, &Plan { stages: Stage::ALL.to_vec(), ..plan })
}

#[test]
fn an_object_that_its_flags_hide_is_dropped_and_no_effect_is_called_for_by_it() {
    let objects = [
        "sphere { x, 0.8 pigment { checker rgb 1 rgb x } finish { reflection 0.5 phong 1 } HIDE }",
        "box { -0.5, 0.5 pigment { rgbt 1 } interior { ior 1.7 } rotate 30 double_illuminate HIDE }",
        "sphere { y, 0.7 scale <1, 2, 1> texture { pigment { rgb y } } HIDE }",
        "plane { y, -1 finish { kd 0.5 ks 0.6 phong_exponent 60 } HIDE }",
        "union { sphere { 0, 1 } box { 1, 2 } union { plane { x, -2 } } HIDE }",
    ];
    for scene in [BARE, LIT, CLEAR, ROOM] {
        let before = see_text(scene);
        for object in objects {
            let seen = see_text(&format!("{scene}{}", object.replace("HIDE", HIDE)));
            assert_eq!(seen.errors, "", "{object}");
            assert_eq!(seen.world, before.world, "{object}");
            assert_eq!(lines(&seen), lines(&before), "{object}");
            assert_eq!(seen.plan.left_out, before.plan.left_out, "{object}");
            let word = object.split(' ').next().unwrap_or_default();
            let line = scene.lines().count() + 1;
            let why = "`no_image`, `no_reflection` and `no_shadow` hide it";
            let mut expected = told(&before);
            expected.push(format!("{word}: {why}  (a.scene:{line}:1)"));
            assert_eq!(told(&seen), expected);
            let counters = traced(&seen.world, &seen.plan).counters;
            assert_eq!(counters, traced(&before.world, &before.plan).counters, "{object}");
            let picture = png(&seen.world, &seen.plan);
            assert_eq!(picture, left_in(scene, &object.replace("HIDE", "")), "{object}");
        }
    }
}

#[test]
fn what_hides_an_object_is_told_where_it_is_whole() {
    let said = |text: &str| {
        let seen = see_text(&format!("{LIT}{text}"));
        assert_eq!(seen.errors, "", "{text}");
        let dropped = seen.plan.dropped.iter();
        let place = |part: &lucarne::world::Dropped| seen.sources.place(part.site.span);
        let told = dropped.map(|part| format!("{} {}", part.what, place(part)));
        (told.collect::<Vec<_>>(), seen.world.objects.len() - 1)
    };
    let at = |word: &str, place: &str| vec![format!("{word} a.scene:{place}")];
    // Declared so, and used twice: the one place says it.
    let declared = format!("#declare S = sphere {{ 0, 1 {HIDE} }};\nobject {{ S }} object {{ S }}");
    assert_eq!(said(&declared), (at("sphere", "4:14"), 0));
    // One of two uses.
    let used = format!("#declare S = sphere {{ 0, 1 }}; object {{ S }}\nobject {{ S {HIDE} }}");
    assert_eq!(said(&used), (at("sphere", "5:1"), 1));
    // Half of it, and the other half on what holds it.
    let halves = "union { sphere { x, 1 no_shadow }\nsphere { x, 1 } no_image no_reflection }";
    assert_eq!(said(halves), (at("sphere", "4:9"), 1));
    let undone = format!("#declare S = sphere {{ 0, 1 {HIDE} }}; object {{ S no_image off }}");
    assert_eq!(said(&undone), (vec![], 1));
    for pair in ["no_image no_shadow", "no_image no_reflection", "no_reflection no_shadow"] {
        assert_eq!(said(&format!("sphere {{ x, 1 {pair} }}")), (vec![], 1), "{pair}");
    }
    // A light in it shines.
    let lamp = format!("union {{ light_source {{ 5, rgb 1 }} sphere {{ 5, 1 }}\n{HIDE} }}");
    let seen = see_text(&format!("{LIT}{lamp}"));
    assert_eq!((seen.world.lights.len(), said(&lamp)), (2, (at("union", "4:1"), 0)));
}

#[test]
fn what_hides_an_object_around_the_camera_leaves_what_it_is_filled_with() {
    let around = "sphere { <0, 1, 6>, 2 pigment { checker rgb 1 rgb 0 } finish { reflection 1 }
interior { ior 1.4 } HIDE }";
    let hidden = around.replace("HIDE", HIDE);
    let (before, seen) = (see_text(ROOM), see_text(&format!("{ROOM}{hidden}")));
    assert_eq!(seen.world.objects.len(), before.world.objects.len() + 1);
    let picture = png(&seen.world, &seen.plan);
    assert_ne!(picture, png(&before.world, &before.plan));
    assert_eq!(picture, left_in(ROOM, &around.replace("HIDE", "")));
    // Nothing else of it is called for.
    let mut expected = lines(&before);
    expected.insert("hidden objects", vec!["no_image".to_owned(), "no_reflection".to_owned()]);
    let refraction = expected.get_mut("refraction").expect("of the glass");
    refraction.push("ior 1.4".to_owned());
    assert_eq!(lines(&seen), expected);
    // Where nothing bends light it is dropped.
    for scene in [BARE, LIT, CLEAR] {
        let plain = hidden.replace("1.4", "1");
        assert_eq!(see_text(&format!("{scene}{plain}")).world, see_text(scene).world);
    }
}

#[test]
fn what_has_no_size_is_told_as_a_mistake_and_dropped() {
    let cases = [
        ("sphere { x, 0 }", "sphere"),
        ("sphere { x, 1e-200 scale 1e-200 }", "sphere"),
        ("box { 1, <1, 2, 1> }", "box"),
        ("box { -1e-200, 1e-200 scale 1e-200 }", "box"),
    ];
    for (object, word) in cases {
        let seen = see_text(&format!("{ROOM}{object}"));
        assert!(seen.errors.starts_with("zero-size"), "{}", seen.errors);
        let before = see_text(ROOM);
        assert_eq!((&seen.world, lines(&seen)), (&before.world, lines(&before)), "{object}");
        assert_eq!(told(&seen), [format!("{word}: it has no size  (a.scene:7:1)")], "{object}");
    }
}

#[test]
fn what_is_dropped_is_named_with_its_place() {
    let text = format!(
        "{LIT}light_source {{ 5, rgb 0 }}
sphere {{ x, 1 pigment {{ checker rgb 1 rgb 1 }} finish {{ reflection 0 phong 0 }} }}
sphere {{ x, 1 pigment {{ rgb 1 }} finish {{ reflection {{ 0, 0 falloff 2 }} specular 0 }} }}
sphere {{ x, 1 pigment {{ rgb 1 }} finish {{ kd 0.5 ks 0 phong_exponent 9 }} }}
union {{ }}
#declare Wood = rgb 1;
#for (I, 1, 5) light_source {{ I, rgb 0 }} #end
"
    );
    let seen = see_text(&text);
    assert_eq!(seen.errors, "");
    let expected = [
        "light_source: its colour is black  (a.scene:4:1)",
        "checker: its colours are all the same  (a.scene:5:25)",
        "reflection: its weight is zero  (a.scene:5:56)",
        "phong: its weight is zero  (a.scene:5:69)",
        "reflection: its weight is zero  (a.scene:6:42)",
        "specular: its weight is zero  (a.scene:6:72)",
        "ks: its weight is zero  (a.scene:7:49)",
        "union: it is empty  (a.scene:8:1)",
        "light_source: its colour is black  (a.scene:10:16)",
        "#declare Wood: nothing uses it  (a.scene:9:10)",
    ];
    assert_eq!(told(&seen), expected);
    assert_eq!(lines(&seen).keys().copied().collect::<Vec<_>>(), ["diffuse light", "shadows"]);
}

#[test]
fn what_has_no_weight_leaves_the_world_as_if_it_had_never_been_written() {
    let pairs = [
        ("light_source { 5, rgb 0 }", ""),
        ("light_source { 5, rgb 0 spotlight fade_distance 1 fade_power 2 }", ""),
        ("#declare Lamp = light_source { 5, rgb 1 }", ""),
        ("#declare Mirror = sphere { x, 1 finish { reflection 1 } }", ""),
        ("union { union { } }", ""),
        ("sphere { x, 1 finish { reflection 0 } }", "sphere { x, 1 }"),
        ("sphere { x, 1 finish { reflection { 0, 0 fresnel } } }", "sphere { x, 1 }"),
        ("sphere { x, 1 finish { phong 0 phong_size 9 specular 0 } }", "sphere { x, 1 }"),
        (
            "sphere { x, 1 finish { diffuse 0 brilliance 2 } }",
            "sphere { x, 1 finish { diffuse 0 } }",
        ),
        ("sphere { x, 1 pigment { rgbft <1, 1, 1, 0, 0> } }", "sphere { x, 1 pigment { rgb 1 } }"),
        ("sphere { x, 1 pigment { checker rgb 1 rgb 1 } }", "sphere { x, 1 pigment { rgb 1 } }"),
        (
            "sphere { x, 1 pigment { gradient y color_map { [0 rgb x] [1 rgb x] } scale 3 } }",
            "sphere { x, 1 pigment { rgb x } }",
        ),
        ("sphere { x, 1 interior { ior 1.5 } }", "sphere { x, 1 }"),
    ];
    for (with, without) in pairs {
        let [with_it, without_it] = [with, without].map(|text| see_text(&format!("{LIT}{text}")));
        assert_eq!((with_it.errors.as_str(), without_it.errors.as_str()), ("", ""), "{with}");
        assert_eq!(with_it.world, without_it.world, "{with}");
        assert_eq!(lines(&with_it), lines(&without_it), "{with}");
    }
}
