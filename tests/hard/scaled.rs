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

/// All that the language can place, all lengths times `K`.
const THINGS: &str = "
    global_settings { max_trace_level 4 }
    background { rgb <0.1, 0.2, 0.3> }
    light_source { <5, 8, 9>*K, rgb 0.8 }
    light_source { <-5, 8, 1>*K, rgb <0.2, 0.1, 0.1> parallel point_at <0, 1, 0>*K }
    light_source { direction <-2, 3, 1> color rgb <0.2, 0.2, 0.4> }
    plane { y, 0 pigment { checker rgb 0.9 rgb 0.3 scale K rotate 20*y translate 0.3*K } finish { reflection 0.3 } }
    plane { <0.1, 0.2, 1>, -5*K pigment { gradient <1, 2, 3> color_map { [0 rgb x] [0.4 rgb y] [1 rgb z] } scale 0.7*K } }
    sphere { <-1.5, 1, 0>*K, K pigment { rgb <0.9, 0.3, 0.2> } finish { phong 0.7 reflection 0.2 } }
    sphere { <0.1, 0, 0>, 1 pigment { checker rgb 1 rgb 0.2 scale 0.3 } scale <1, 0.5, 0.8> rotate 30*z scale K translate <0.2, 2.4, -1>*K }
    box { -0.8, 0.8 rotate <20, 30, 0> scale K translate <1.6, 1.2, 0.3>*K pigment { rgb <0.2, 0.4, 0.9> } finish { specular 0.5 } }
    box { 0, K matrix <1, 0.2, 0, 0.3, 1, 0.1, 0, 0.4, 1, 0, 0, 0> translate <-1, 0, 3>*K pigment { rgb <0.4, 0.9, 0.2> } }
    box { <-3, 0.7, 2>*K, <-2, 0.7, 3>*K pigment { rgb <0.8, 0.7, 0.2> } }
    union { #for (I, 1, 9) sphere { <0.5*I - 2.5, 0.2, 4>*K, 0.2*K } #end pigment { rgb 0.7 } finish { kd 0.6 ks 0.3 phong_exponent 20 } }
";

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
    let (settings, things) = THINGS.split_at(THINGS.find("light_source").expect("a light"));
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
    // The objects in another order: every solid is a line of its own.
    let mut lines: Vec<&str> = text.lines().collect();
    let first = lines.iter().position(|line| line.trim().starts_with("plane")).expect("a plane");
    for shift in 1..4 {
        lines[first..].rotate_left(shift);
        assert!(png(&film(&lines.join("\n"), antialias, 1)) == file, "shifted by {shift}");
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
