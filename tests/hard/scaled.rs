//! What changes no bit of a picture: powers of two, mirrors, the order of things, threads and
//! tiles: rows 47 and 68.

use lucarne::film::{Depth, Film, develop};
use lucarne::math::Vector;
use lucarne::math::elementary::pow;
use lucarne::picture::{Format, encode};
use lucarne::plan::{Antialias, Frame, PlanOptions, Region, plan};
use lucarne::trace::{TraceOptions, Unwatched, trace};

use crate::held::{apart, compiled};

const SIZE: (u32, u32) = (28, 21);

/// Cameras of both kinds, all lengths times `K`.
const CAMERAS: [&str; 2] = [
    "camera { location <1, 3, 9>*K look_at <0, 1, 0>*K angle 45 }",
    "camera { orthographic location <4, 5, 9>*K direction <-0.4, -0.5, -0.9>*K right <6, 0, -3>*K up <0, 5, -1>*K }",
];

/// All that the language can place, all lengths times `K`: every kind of light, a light that fades,
/// clear things, filled and tinted, touching and one in the other. An object is a line.
const THINGS: &str = "
    global_settings { max_trace_level 5 }
    background { rgb <0.1, 0.2, 0.3> }
    sky_sphere { pigment { gradient <0.3, 0.8, 0.5> color_map { [0 rgbt <0.1, 0.2, 0.4, 0.3>] [1 rgb <0.9, 0.7, 0.4>] } scale 0.3 } /* moved */ }
    light_source { <5, 8, 9>*K, rgb 0.4 }
    light_source { <-5, 8, 1>*K, rgb <0.2, 0.1, 0.1> parallel point_at <0, 1, 0>*K }
    light_source { direction <-2, 3, 1> color rgb <0.2, 0.2, 0.4> }
    light_source { <-4, 7, 5>*K, rgb <0.5, 0.4, 0.2> spotlight radius 8 falloff 20 tightness 3 point_at <-1.5, 1, 0>*K }
    light_source { <2, 6, 4>*K, rgb <0.3, 0.5, 0.4> spotlight radius 10 falloff 30 point_at <1, 0, 1>*K fade_distance 5*K fade_power 3 }
    light_source { <0.5, 7, 3>*K, rgb <0.4, 0.3, 0.5> cylinder radius 0.7*K falloff 1.9*K tightness 1 point_at <0.2, 0, 1>*K }
    light_source { <-3, 2, 4>*K, rgb <0.4, 0.4, 0.1> fade_distance 1.7*K fade_power 1.5 }
    light_source { <3, 4, -1>*K, rgb <0.1, 0.3, 0.2> parallel point_at <0, 0, 1>*K fade_distance 3*K fade_power 2 shadowless }
    plane { y, 0 pigment { checker rgb 0.9 rgb 0.3 scale K rotate 20*y translate 0.3*K } finish { reflection 0.3 } }
    plane { <0.1, 0.2, 1>, -5*K pigment { gradient <1, 2, 3> color_map { [0 rgb x] [0.4 rgb y] [1 rgb z] } scale 0.7*K } }
    sphere { <-1.5, 1, 0>*K, K pigment { rgb <0.9, 0.3, 0.2> } finish { phong 0.7 reflection 0.2 } }
    sphere { <0.1, 0, 0>, 1 pigment { checker rgb 1 rgb 0.2 scale 0.3 } scale <1, 0.5, 0.8> rotate 30*z scale K translate <0.2, 2.4, -1>*K }
    box { -0.8, 0.8 rotate <20, 30, 0> scale K translate <1.6, 1.2, 0.3>*K pigment { rgb <0.2, 0.4, 0.9> } finish { specular 0.5 metallic } }
    box { 0, K matrix <1, 0.2, 0, 0.3, 1, 0.1, 0, 0.4, 1, 0, 0, 0> translate <-1, 0, 3>*K pigment { rgb <0.4, 0.9, 0.2> } }
    box { <-3, 0.7, 2>*K, <-2, 0.7, 3>*K pigment { rgb <0.8, 0.7, 0.2> } finish { brilliance 2 } double_illuminate }
    union { #for (I, 1, 9) sphere { <0.5*I - 2.5, 0.2, 4>*K, 0.2*K } #end pigment { rgb 0.7 } finish { kd 0.6 ks 0.3 phong_exponent 20 } }
    sphere { <0.3, 0.9, 2.6>*K, 0.6*K pigment { rgbf <0.9, 1, 0.9, 0.9> } finish { phong 0.5 reflection { 0, 0.9 fresnel } conserve_energy } interior { ior 1.5 } }
    sphere { <0.3, 0.9, 2.6>*K, 0.25*K pigment { rgbft <0.9, 0.5, 0.9, 0.5, 0.3> } interior { ior 1.2 } }
    sphere { 0, 1 scale <0.5, 0.3, 0.4> rotate 25*z scale K translate <1.7, 0.4, 3.2>*K pigment { checker rgbt <1, 0.3, 0.2, 0.7> rgb 0.4 scale 0.21*K } interior { ior 1.33 } hollow }
    box { <-1.9, 0.3, 2.1>*K, <-0.9, 1.3, 2.2>*K pigment { rgbf <0.4, 0.7, 1, 0.8> } interior { ior 1.1 } }
    box { <-1.9, 0.3, 2.2>*K, <-0.9, 1.3, 2.3>*K pigment { rgbf <1, 0.7, 0.4, 0.8> } interior { ior 2.4 } no_reflection }
    plane { y, 0.05*K pigment { rgbt <0.7, 0.9, 1, 0.8> } finish { diffuse 0.1 } interior { ior 1.33 } }
    plane { -y, -30*K inverse pigment { gradient x color_map { [0 rgbt 1] [1 rgbf <1, 0.8, 0.6, 0.9>] } scale 3*K } no_shadow }
";

/// The first object's line begins so.
const FIRST_OBJECT: &str = "plane";

/// In the line of a box on which the next one lies.
const TOUCHING: &str = "ior 1.1";

fn scene(k: f64, camera: &str) -> String {
    format!("#declare K = {k:e};\n{camera}\n{THINGS}")
}

fn film(text: &str, antialias: Antialias, threads: usize) -> Film {
    let (world, origins) = compiled(text);
    let frame = Frame::whole(SIZE.0, SIZE.1);
    let plan = plan(&world, &origins, &PlanOptions { antialias, ..PlanOptions::new(frame) });
    trace(&world, &plan, &TraceOptions::on_threads(threads), &Unwatched).film
}

fn png(film: &Film) -> Vec<u8> {
    encode(&develop(film, Depth::Sixteen), Format::Png).expect("a picture")
}

fn two_to(exponent: i32) -> f64 {
    pow(2.0, f64::from(exponent))
}

#[test]
fn row_47_a_power_of_two_times_every_length_changes_no_byte_of_the_picture() {
    for camera in CAMERAS {
        let plain = film(&scene(1.0, camera), Antialias::Off, 1);
        let file = png(&plain);
        // A fault planted in one length shows.
        let faulty = scene(4.0, camera).replace("scale 0.7*K", "scale 0.7");
        assert_ne!(png(&film(&faulty, Antialias::Off, 1)), file);
        for exponent in -200..=200 {
            let scaled = film(&scene(two_to(exponent), camera), Antialias::Off, 1);
            assert_eq!(scaled.radiance, plain.radiance, "2^{exponent}: {camera}");
            assert!(png(&scaled) == file, "2^{exponent}: {camera}");
        }
    }
}

/// Each light and each object, with the text around it.
fn each_thing() -> impl Iterator<Item = &'static str> {
    let starts = ["sky_sphere", "light_source", "plane", "sphere", "box", "union"];
    THINGS.lines().filter(move |line| starts.iter().any(|start| line.trim().starts_with(start)))
}

#[test]
fn row_47_every_thing_is_seen_and_its_lengths_with_it() {
    let file = |text: &str| png(&film(text, Antialias::Off, 1));
    let (one, four) = (scene(1.0, CAMERAS[0]), scene(4.0, CAMERAS[0]));
    let seen = file(&one);
    assert!(each_thing().count() > 20);
    for thing in each_thing() {
        assert!(file(&one.replace(thing, "")) != seen, "unseen: {thing}");
        // Its lengths alone stay behind. A plane through the origin is as large as ever.
        let left = thing.replace('K', "1");
        let has_no_length = !thing.contains('K');
        assert!(has_no_length || file(&four.replace(thing, &left)) != seen, "left: {thing}");
    }
}

type Map = fn(Vector) -> Vector;

/// A camera by its vectors, and the things in a union, all of it under one map.
fn mapped(steps: &str, map: Map, flip: f64) -> String {
    let frame = [
        ("location", Vector::new(1.0, 3.0, 9.0)),
        ("direction", Vector::new(-0.1, -0.2, -1.0)),
        ("right", Vector::new(1.2, 0.1, 0.05) * flip),
        ("up", Vector::new(0.0, 0.9, -0.1)),
    ];
    let camera: String = frame
        .iter()
        .map(|(word, v)| {
            let v = map(*v);
            format!(" {word} <{:e}, {:e}, {:e}>", v.x, v.y, v.z)
        })
        .collect();
    let moved = THINGS.replace("/* moved */", steps);
    let (settings, things) = moved.split_at(moved.find("light_source").expect("a light"));
    format!("#declare K = 1; {settings} camera {{ {camera} }} union {{ {things} {steps} }}")
}

#[test]
fn row_47_a_mirrored_scene_is_the_same_picture_to_a_mirrored_camera_and_its_mirror_to_another() {
    let plain = film(&mapped("", |v| v, 1.0), Antialias::Off, 1);
    let mirrors: [(&str, Map); 4] = [
        ("scale <-1, 1, 1>", |v| Vector::new(-v.x, v.y, v.z)),
        ("scale <1, -1, 1>", |v| Vector::new(v.x, -v.y, v.z)),
        ("scale <1, 1, -1>", |v| Vector::new(v.x, v.y, -v.z)),
        ("scale -1", |v| -v),
    ];
    let flipped: Vec<_> = (0..SIZE.1)
        .flat_map(|y| (0..SIZE.0).rev().map(move |x| (x, y)))
        .map(|(x, y)| plain.radiance[plain.index(x, y)])
        .collect();
    assert_ne!(plain.radiance, flipped);
    for (steps, map) in mirrors {
        let mirrored = |flip| film(&mapped(steps, map, flip), Antialias::Off, 1).radiance;
        assert_eq!(mirrored(1.0), plain.radiance, "{steps}");
        assert_eq!(mirrored(-1.0), flipped, "{steps}");
    }
}

#[test]
fn row_47_a_scene_whose_axes_are_exchanged_is_the_same_picture_but_for_rounding() {
    let plain = film(&mapped("", |v| v, 1.0), Antialias::Off, 1);
    // A third of a turn about the diagonal, and its inverse.
    let turns: [(&str, Map); 2] = [
        ("matrix <0,1,0, 0,0,1, 1,0,0, 0,0,0>", |v| Vector::new(v.z, v.x, v.y)),
        ("matrix <0,0,1, 1,0,0, 0,1,0, 0,0,0>", |v| Vector::new(v.y, v.z, v.x)),
    ];
    for (steps, map) in turns {
        let turned = film(&mapped(steps, map, 1.0), Antialias::Off, 1);
        let pairs = turned.radiance.iter().zip(&plain.radiance);
        let off = pairs.map(|(a, b)| apart(a.components(), b.components())).fold(0.0, f64::max);
        assert!(off < 1e-9, "{steps}: {off:e}");
    }
}

#[test]
fn row_68_order_threads_and_tiles_change_no_byte_of_the_picture() {
    let text = scene(1.0, CAMERAS[0]);
    let antialias = Antialias::default();
    let file = png(&film(&text, antialias, 1));
    for threads in [2, 5] {
        assert!(png(&film(&text, antialias, threads)) == file, "{threads} threads");
    }
    // The objects in another order, but for two that touch: which is first is seen there.
    let mut lines: Vec<&str> = text.lines().collect();
    let first = lines.iter().position(|line| line.trim().starts_with(FIRST_OBJECT)).expect("it");
    let touching = lines.iter().position(|line| line.contains(TOUCHING)).expect("it");
    let last = lines.len();
    lines.swap(touching, touching + 1);
    lines[first..].reverse();
    assert!(png(&film(&lines.join("\n"), antialias, 1)) == file, "the other way round");
    for shift in 1..last - first {
        lines[first..].rotate_left(1);
        // Those two are never first and last.
        if !lines[last - 1].contains(TOUCHING) {
            assert!(png(&film(&lines.join("\n"), antialias, 1)) == file, "shifted by {shift}");
        }
    }
    // Regions begin tiles of their own: wherever they lie, they are crops.
    let (world, origins) = compiled(&text);
    let whole = film(&text, antialias, 1);
    for (x, y, width, height) in [(0, 0, 1, 1), (5, 3, 20, 17), (27, 20, 1, 1), (3, 20, 25, 1)] {
        let region = Region { x, y, width, height };
        let frame = Frame { region, ..Frame::whole(SIZE.0, SIZE.1) };
        let plan = plan(&world, &origins, &PlanOptions { antialias, ..PlanOptions::new(frame) });
        let part = trace(&world, &plan, &TraceOptions::on_threads(2), &Unwatched).film;
        let crop = whole.clone().crop(region);
        assert!(png(&part) == png(&crop), "{region:?}");
    }
}
