//! `lucarne plan --json` holds all that `lucarne plan` says: the text is written again from the JSON.

use std::process::Command;

use serde_json::Value;

fn plan(words: &str) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lucarne"));
    command.arg("plan").args(words.split_whitespace()).current_dir(env!("CARGO_MANIFEST_DIR"));
    let output = command.output().expect("runs");
    assert!(output.status.success(), "{words}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn text(value: &Value) -> &str {
    value.as_str().expect("a text")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

/// The text, written from nothing but the JSON.
fn written(plan: &Value) -> String {
    assert_eq!(plan["incomplete"], false);
    let region = &plan["region"];
    let mut out = format!("picture {}×{}", plan["width"], plan["height"]);
    if (&region[2], &region[3]) != (&plan["width"], &plan["height"]) {
        out += &format!(", {}×{} from {},{}", region[2], region[3], region[0], region[1]);
    }
    let antialias = &plan["antialias"];
    let (n, threshold) = (&antialias["n"], &antialias["threshold"]);
    out += &match text(&antialias["kind"]) {
        "off" => "\nantialias off: one ray a pixel\n".to_owned(),
        "grid" => format!("\nantialias {n}: {n}×{n} rays a pixel\n"),
        _ => format!(
            "\nantialias adaptive: up to {n}×{n} rays near edges, where neighbours differ by more than {threshold}\n"
        ),
    };
    out += &format!("max_trace_level {}\n", plan["max_trace_level"]);
    let bailout = number(&plan["adc_bailout"]);
    out += &match 1.0 / bailout {
        parts if parts > 1.0 && parts.fract() == 0.0 => format!("adc_bailout 1/{parts}\n"),
        _ => format!("adc_bailout {bailout}\n"),
    };
    let tolerance = number(&plan["root_tolerance"]);
    if tolerance > 0.0 {
        out += &format!("root_tolerance {tolerance}\n");
    }
    if let Some(most) = plan["julia_iterations"].as_u64() {
        out += &format!("julia_iterations {most}\n");
    }
    for name in ["light_samples", "blur_samples"] {
        if let Some(samples) = plan[name].as_str() {
            out += &format!("{name} {samples}\n");
        }
    }
    let stages: Vec<&str> = list(&plan["stages"]).iter().map(text).collect();
    out += &format!("stages: {}\n", stages.join(", "));
    let (on, off): (Vec<&Value>, Vec<&Value>) =
        list(&plan["effects"]).iter().partition(|row| row["on"] == true);
    let dropped = list(&plan["dropped"]);
    let parts = if dropped.len() == 1 { "part" } else { "parts" };
    let numbers = (on.len(), off.len(), dropped.len());
    let effects = if on.len() == 1 { "effect" } else { "effects" };
    let (on_count, off_count, dropped_count) = numbers;
    out += &format!("{on_count} {effects} on, {off_count} off, {dropped_count} {parts} dropped\n");
    out += if on.is_empty() { "" } else { "on\n" };
    let rays = &plan["rays"];
    for row in on {
        out += &format!("  {}: {}", text(&row["effect"]), text(&row["cost"]));
        if let Some(sent) = row["rays_per_camera_ray"].as_f64() {
            out += &format!("; {}", counted(sent, rays));
        }
        out += "\n";
        let places = list(&row["called_for_by"]);
        for place in places.iter().take(3) {
            out += &format!("    {}{}\n", quote(place), at(place));
        }
        out += &and_more(places, "    ");
        let default = text(&antialias["kind"]) == "adaptive" && *n == 8 && *threshold == 0.05;
        let by = if default { "    by default\n" } else { "    by the options\n" };
        out += if places.is_empty() { by } else { "" };
    }
    out += if off.is_empty() { "" } else { "off\n" };
    for row in off {
        let (effect, why) = (text(&row["effect"]), text(&row["why"]));
        out += &format!("  {effect}: {why}{}\n", at(&row["place"]));
    }
    out += if dropped.is_empty() { "" } else { "dropped\n" };
    for part in dropped {
        out += &format!("  {}: {}{}", text(&part["what"]), text(&part["why"]), at(&part["place"]));
        out += &match list(&part["calls"]) {
            [] => "\n".to_owned(),
            [one] => format!(", in 1 call at {}\n", places(std::slice::from_ref(one))),
            more => format!(", in {} calls at {}\n", more.len(), places(more)),
        };
    }
    for (title, name) in [("shapes", "shape"), ("surfaces", "part")] {
        let kinds = list(&plan[title]);
        out += &if kinds.is_empty() { String::new() } else { format!("{title}\n") };
        for kind in kinds {
            let (word, cost) = (text(&kind[name]), text(&kind["cost"]));
            out += &format!("  {word}, {}: {cost}\n", kind["count"]);
            out += &format!("    ({})\n", places(list(&kind["places"])));
        }
    }
    out += "numerics\n";
    let numerics = &plan["numerics"];
    let (least, most) = (&numerics["smallest_half_width"], &numerics["largest_half_width"]);
    if !least.is_null() {
        let (from, to) = (measured(least), measured(most));
        out += &format!("  half widths from {from} to {to}\n");
    }
    let far = &numerics["farthest_in_half_widths"];
    if !far.is_null() {
        let (value, place) = (digits(&far["value"]), at(&far["place"]));
        out += &format!("  farthest for its size: {value} half widths away{place}\n");
    }
    for endless in list(&numerics["endless"]) {
        let (shape, place) = (text(&endless["shape"]), at(&endless["place"]));
        out += &format!("  no half width: {}{place}\n", lucarne::plan::print::without_end(shape));
    }
    let thin = list(&numerics["thin"]);
    for found in thin.iter().take(3) {
        let (what, times) = (text(&found["what"]), digits(&found["value"]));
        let place = at(&found["place"]);
        out += &format!("  nearly degenerate: {what}, {times} times as long as thick{place}\n");
    }
    out += &and_more(thin, "  ");
    let coinciding = list(&numerics["coinciding"]);
    for found in coinciding.iter().take(3) {
        let part = |i: usize| format!("{}{}", text(&found["shapes"][i]), at(&found["places"][i]));
        out += &format!("  a face in common: {}, {}\n", part(0), part(1));
    }
    out += &and_more(coinciding, "  ");
    let near = list(&numerics["near_singular"]);
    for found in near.iter().take(3) {
        let (piece, place) = (quote(&found["place"]), at(&found["place"]));
        let condition = digits(&found["value"]);
        out += &format!("  nearly flattens space: {piece}, condition {condition}{place}\n");
    }
    out += &and_more(near, "  ");
    out += if near.is_empty() { "  no transform nearly flattens space\n" } else { "" };
    out += &format!("rays: {}", counted(number(&rays["per_camera_ray"]), rays));
    let pilot = &rays["pilot"];
    let all = number(&pilot[0]) * number(&pilot[1]);
    let fewer = number(&rays["pilot_pixels"]) < all;
    let done = if fewer { format!("{} of ", rays["pilot_pixels"]) } else { String::new() };
    out += &format!(" (counted by a pilot of {done}{}×{} pixels", pilot[0], pilot[1]);
    if let Some(depth) = rays["pilot_depth"].as_u64() {
        let deep = &plan["max_trace_level"];
        out += &format!(", only {depth} of {deep} surfaces deep: there are more rays");
    }
    out + ")\n"
}

fn and_more(list: &[Value], indent: &str) -> String {
    match list.len() {
        0..=3 => String::new(),
        more => format!("{indent}and {} more\n", more - 3),
    }
}

/// The first, and how many more.
fn places(list: &[Value]) -> String {
    let first = list.iter().take(3).map(|place| at(place).trim_matches([' ', '(', ')']).to_owned());
    let first: Vec<String> = first.collect();
    let more = list.len().saturating_sub(3);
    first.join(", ") + &if more > 0 { format!(" and {more} more") } else { String::new() }
}

fn measured(found: &Value) -> String {
    digits(&found["value"]) + &at(&found["place"])
}

fn at(place: &Value) -> String {
    match place.is_null() {
        true => String::new(),
        false => format!("  ({}:{}:{})", text(&place["file"]), place["line"], place["column"]),
    }
}

fn quote(place: &Value) -> String {
    let words: Vec<&str> = text(&place["text"]).split_whitespace().collect();
    let whole = words.join(" ");
    match whole.char_indices().nth(48) {
        Some((cut, _)) => format!("`{}…`", whole[..cut].trim_end()),
        None => format!("`{whole}`"),
    }
}

/// Three digits.
fn digits(value: &Value) -> String {
    let rounded: f64 = format!("{:.2e}", number(value)).parse().expect("a number");
    match (1e-3..1e6).contains(&rounded.abs()) || rounded == 0.0 {
        true => rounded.to_string(),
        false => format!("{rounded:e}"),
    }
}

fn counted(sent: f64, rays: &Value) -> String {
    let whole: f64 = format!("{:.1e}", sent * number(&rays["camera"])).parse().expect("a number");
    let mut digits = format!("{whole:.0}");
    for place in
        (1..digits.len()).rev().filter(|place| (digits.len() - place) % 3 == 0).collect::<Vec<_>>()
    {
        digits.insert(place, ',');
    }
    let each = lucarne::plan::print::a_pixel(sent * number(&rays["camera_per_pixel"]));
    if sent == 0.0 { each } else { format!("{each}, about {digits}") }
}

#[test]
fn all_that_the_text_says_is_in_the_json() {
    let folder = tempfile::tempdir().expect("a folder");
    let hard = folder.path().join("hard.scene");
    let flat = "box { 0, 1 scale <1, 1e-9, 1> } box { 0, 1 scale <1e-10, 1, 1> }
box { 0, 1 scale <1, 1, 1e-11> } box { 0, 1 scale <1, 1e-12, 1> translate 1e9*x }";
    let text = format!(
        "global_settings {{ max_trace_level 1 adc_bailout 0.5 }}
light_source {{ <4, 8, 6>, rgb 1 }} light_source {{ 5, rgb 0 }} light_source {{ y*9, rgb 1 shadowless }}
sphere {{ 0, 1 scale <1, 2, 1> finish {{ reflection 0.5 }} }} #declare Unused = 1;
{flat}
#macro Dark(P) light_source {{ P, rgb 0 }} #end Dark(1) Dark(2)
torus {{ 1e9, 1 }} cylinder {{ -2*y, 2*y, 0.6 }} quadric {{ <1, -1, 1>, 0, 0, -1 }}
difference {{ sphere {{ 0, 1 }} box {{ 0, 2 }} }} merge {{ box {{ 0, 2 }} box {{ 0, 1 }} }} disc {{ 0, y, 2 }}
"
    );
    std::fs::write(&hard, text).expect("written");
    let hard = hard.display();
    for words in [
        "scenes/gallery/first.scene".to_owned(),
        "scenes/gallery/first.scene --size 81x60 --antialias 3 --depth 1".to_owned(),
        "scenes/atmosphere/background.scene --antialias off --region 3,4,20,10".to_owned(),
        "scenes/seed/mirror.scene".to_owned(),
        "tests/cases/glass.scene".to_owned(),
        "scenes/gallery/still_life.scene --size 32x24".to_owned(),
        "scenes/shapes/torus.scene --root-tolerance 1e-4".to_owned(),
        "scenes/shapes/julia_fractal.scene --julia-iterations 2 --size 16x12".to_owned(),
        "scenes/lights/area_light.scene --light-samples 16 --size 16x12".to_owned(),
        "scenes/cameras/aperture.scene --blur-samples adaptive:0.1:9 --size 16x12".to_owned(),
        format!("{hard} --size 640x480"),
    ] {
        let said = plan(&words);
        let json: Value = serde_json::from_str(&plan(&format!("{words} --json"))).expect("JSON");
        assert_eq!(written(&json), said, "{words}");
        if words.contains("hard") {
            for part in [
                "in 2 calls at ",
                "  nearly degenerate: box, ",
                "  no half width: where a quadric ends is not known  (",
                "  difference, 1: ",
                "  a face in common: box  (",
            ] {
                assert!(said.contains(part), "{part}\n{said}");
            }
        }
    }
}

/// Shapes as they are written without their last brace, and what the plan says of each: what is nearly
/// degenerate, or nearly flattens space. Flat is what some shapes are.
const THIN: &[(&str, &[&str])] = &[
    ("sphere { 0, 1e-300", &[]),
    ("sphere { 0, 1 scale <1, 1e-7, 1>", &[]),
    ("sphere { 0, 1 scale <1, 1e-15, 1>", &["stretched sphere", "scale <1, 1e-15, 1>"]),
    ("box { 0, <1, 0, 1>", &[]),
    ("box { 0, <1, 1e-9, 1>", &["box"]),
    ("cylinder { 0, y, 1e-12", &["cylinder"]),
    ("cylinder { 0, 1e-12*y, 1", &["cylinder"]),
    ("cone { 0, 1e-12, y, 0", &["cone"]),
    ("torus { 1, 1e-12", &["torus"]),
    ("disc { 0, y, 1", &[]),
    ("disc { 0, y, 1, 0.5", &[]),
    ("disc { 0, y, 1, 0.9999999999", &["disc"]),
    ("triangle { 0, x, y", &[]),
    ("triangle { 0, x, <0.5, 1e-12, 0>", &["triangle of a mesh"]),
    ("mesh { triangle { 0, x, y } triangle { 0, x, z }", &[]),
    ("polygon { 4, 0, x, y, 0", &[]),
    ("polygon { 4, 0, <1, 2, 3>, <3, 1, 1>, 0", &[]),
    ("polygon { 5, <1, 1, 0>, <2, 2, 0>, <2, 2, 1>, <1, 1, 1>, <1, 1, 0>", &[]),
    ("polygon { 4, 0, <1, 1, 1>, <0.5, 0.5, 0.500000000001>, 0", &["polygon"]),
    ("polygon { 4, 0, x, y, 0 scale <1, 1e-15, 1>", &["polygon", "scale <1, 1e-15, 1>"]),
    ("polygon { 4, 0, x, y, 0 scale <1, 1, 1e-15>", &["scale <1, 1, 1e-15>"]),
    ("prism { 0, 1e-12, 4, <0, 0>, <1, 0>, <0, 1>, <0, 0>", &["prism"]),
    ("prism { 0, 1, 4, <0, 0>, <1, 1>, <0.5, 0.500000000001>, <0, 0>", &["prism"]),
    ("prism { 0, 1, 5, <0, 0>, <1, 0>, <1, 1>, <0, 1>, <0, 0> rotate 45*y", &[]),
    ("lathe { linear_spline 3, <1e-12, 0>, <1e-12, 1>, <1e-12, 2>", &["lathe"]),
    ("sor { 5, <1e-12, -1>, <1e-12, 0>, <1e-12, 1>, <1e-12, 2>, <1e-12, 3>", &["sor"]),
    ("sphere_sweep { linear_spline 2, 0, 1e-12, <1, 1, 1>, 1e-12", &["sphere_sweep"]),
    ("sphere_sweep { linear_spline 2, 0, 0, <1, 1, 1>, 0.1", &[]),
    ("superellipsoid { <1e-12, 1>", &[]),
    ("blob { threshold 0.5 sphere { 0, 1, 1 }", &[]),
    ("bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 LEVEL", &[]),
    ("bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 LEVEL rotate <30, 40, 50>", &[]),
    ("bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 SLANTED", &[]),
    ("bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 NEEDLE", &["bicubic_patch"]),
    ("text { \"a\" 0, 0", &[]),
    ("text { \"a\" 1e-12, 0", &["text"]),
    ("ovus { 1, 0.5", &[]),
    ("height_field { function 4, 4 { 0.5 }", &[]),
    ("height_field { function 4, 4 { x } scale <1, 1e-15, 1>", &["scale <1, 1e-15, 1>"]),
    ("parametric { function { u } function { v } function { 0 } <0, 0>, <1, 1>", &[]),
    ("plane { y, 0 scale <1, 1e-15, 1>", &["scale <1, 1e-15, 1>"]),
];

#[test]
fn what_is_flat_by_its_nature_is_not_degenerate_and_what_is_a_line_is() {
    let patch = |place: fn(i32, i32) -> String| {
        let places = (0..16).map(|i| place(i % 4, i / 4));
        places.collect::<Vec<_>>().join(", ")
    };
    let level = patch(|i, j| format!("<{i}, {j}, 0>"));
    let slanted = patch(|i, j| format!("<{i}, {j}, {}>", i + 2 * j));
    let needle = patch(|i, j| format!("<{i}, {}, {}>", 2 * i, f64::from(i) + f64::from(j) * 1e-12));
    let mut scene = String::from("light_source { 9, 1 }\n");
    for (shape, _) in THIN {
        let shape = shape.replace("LEVEL", &level).replace("SLANTED", &slanted);
        scene += &format!("{} pigment {{ rgb 1 }} }}\n", shape.replace("NEEDLE", &needle));
    }
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("thin.scene");
    std::fs::write(&file, scene).expect("written");
    let said = plan(&format!("{} --json --size 8x6", file.display()));
    let said: Value = serde_json::from_str(&said).expect("JSON");
    let mut found: Vec<Vec<String>> = vec![Vec::new(); THIN.len()];
    let mut note = |row: &Value, what: &str| {
        // The light is in the first line.
        let line = row["place"]["line"].as_u64().expect("a line") as usize;
        found[line - 2].push(what.to_owned());
    };
    for row in list(&said["numerics"]["thin"]) {
        note(row, text(&row["what"]));
    }
    for row in list(&said["numerics"]["near_singular"]) {
        note(row, text(&row["place"]["text"]));
    }
    for ((shape, wanted), found) in THIN.iter().zip(found) {
        assert_eq!(found, *wanted, "{shape}");
    }
}

#[test]
fn each_kind_of_pattern_normal_and_layers_has_a_line_with_its_places_and_no_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("surfaces.scene");
    let text = "#declare Unused = pigment { agate }
camera { location <0, 1, 9> look_at 0 } light_source { <5, 9, 9>, rgb 1 }
sphere { 0, 1 pigment { wood } normal { bumps 0.2 } }
sphere { 2*x, 1 pigment { wood turbulence 0.1 } }
sphere { 4*x, 1 pigment { granite color_map { [0 rgb 1] [1 rgb 1] } } }
plane { y, -1 texture { gradient x texture_map { [0 pigment { rgb 1 }] [1 pigment { bozo }] } } }
box { 5, 6 texture { pigment { rgb 1 } } texture { pigment { marble } } }
";
    std::fs::write(&scene, text).expect("written");
    let words = format!("{} --json --size 16x12", scene.display());
    let plan: Value = serde_json::from_str(&plan(&words)).expect("JSON");
    let lines = list(&plan["surfaces"]).iter().map(|kind| {
        let lines = list(&kind["places"]).iter().map(|place| place["line"].to_string());
        format!("{} {}", self::text(&kind["part"]), lines.collect::<Vec<_>>().join(" "))
    });
    assert_eq!(
        lines.collect::<Vec<_>>(),
        [
            "bozo 6",
            "marble 7",
            "wood 3 4",
            "normal of bumps 3",
            "texture of gradient 6",
            "layers 7"
        ]
    );
}
