//! What changes no bit of a picture: powers of two, mirrors, the order of things, threads and
//! tiles: rows 47 and 68.

use lucarne::color::{Gamma, Rgb};
use lucarne::film::{Depth, Film, Pixel};
use lucarne::math::Vector;
use lucarne::math::elementary::pow;
use lucarne::picture::{Format, encode};
use lucarne::plan::{Antialias, Frame, PlanOptions, Region, plan};
use lucarne::trace::{TraceOptions, Unwatched, trace};

use super::held::{apart, compiled, unrounded};
use super::things::{CAMERAS, SHAPES, THINGS};

const SIZE: (u32, u32) = (28, 21);

/// Of several tiles.
const LARGE: (u32, u32) = (70, 52);

/// The first object's line begins so.
const FIRST_OBJECT: &str = "plane";

/// In the line of a box on which the next one lies.
const TOUCHING: &str = "ior 1.1";

/// All that can be placed.
const WORLDS: [&str; 2] = [THINGS, SHAPES];

fn scene(things: &str, k: f64, camera: &str) -> String {
    format!("#declare K = {k:e};\n{camera}\n{things}")
}

fn film(text: &str, antialias: Antialias, threads: usize) -> Film {
    film_of(text, antialias, SIZE, TraceOptions::on_threads(threads))
}

fn film_of(text: &str, antialias: Antialias, size: (u32, u32), options: TraceOptions) -> Film {
    let (world, origins) = compiled(text);
    let frame = Frame::whole(size.0, size.1);
    let plan = plan(&world, &origins, &PlanOptions { antialias, ..PlanOptions::new(frame) });
    trace(&world, &plan, &options, &Unwatched).film
}

/// The film of these pixels.
fn filmed(radiances: &[Rgb]) -> Film {
    let pixels = radiances.iter().map(|&radiance| Pixel::new(radiance, 1)).collect();
    Film { pixels, ..Film::new(Frame::whole(SIZE.0, SIZE.1), Gamma::LINEAR) }
}

fn png(film: &Film) -> Vec<u8> {
    encode(film, Depth::Sixteen, Format::Png).expect("a picture")
}

fn two_to(exponent: i32) -> f64 {
    pow(2.0, f64::from(exponent))
}

/// At each exponent to one of the cameras after the other, or to all.
fn assert_same_at_any_power_of_two(things: &str, fault: [&str; 2], in_turn: bool) {
    for (number, camera) in CAMERAS.into_iter().enumerate() {
        let plain = unrounded(&scene(things, 1.0, camera), SIZE);
        let file = png(&filmed(&plain));
        // A fault planted in one length shows.
        let faulty = scene(things, 4.0, camera).replace(fault[0], fault[1]);
        assert_ne!(png(&film(&faulty, Antialias::Off, 1)), file);
        let step = if in_turn { CAMERAS.len() } else { 1 };
        for exponent in (-200..=200).skip(number % step).step_by(step) {
            let scaled = unrounded(&scene(things, two_to(exponent), camera), SIZE);
            assert_eq!(scaled, plain, "2^{exponent}: {camera}");
            assert!(png(&filmed(&scaled)) == file, "2^{exponent}: {camera}");
        }
    }
}

#[test]
fn row_47_a_power_of_two_times_every_length_changes_no_byte_of_the_picture() {
    assert_same_at_any_power_of_two(THINGS, ["scale 0.7*K", "scale 0.7"], false);
}

#[test]
fn row_47_a_power_of_two_times_every_shape_changes_no_byte_of_the_picture() {
    assert_same_at_any_power_of_two(SHAPES, ["0.3*K open", "0.3 open"], true);
}

/// Each light and each object, with the text around it.
fn each_thing(things: &'static str) -> impl Iterator<Item = &'static str> {
    let settings = ["global_settings", "background"];
    let is_setting = move |line: &str| settings.iter().any(|word| line.starts_with(word));
    things.lines().filter(move |line| line.contains('{') && !is_setting(line.trim()))
}

#[test]
fn row_47_every_thing_is_seen_and_its_lengths_with_it() {
    let file = |text: &str| png(&film(text, Antialias::Off, 1));
    for things in WORLDS {
        let (one, four) = (scene(things, 1.0, CAMERAS[0]), scene(things, 4.0, CAMERAS[0]));
        let seen = file(&one);
        assert!(each_thing(things).count() > 20);
        for thing in each_thing(things) {
            assert!(file(&one.replace(thing, "")) != seen, "unseen: {thing}");
            // Its lengths alone stay behind. A plane through the origin is as large as ever.
            let left = thing.replace('K', "1");
            let has_no_length = !thing.contains('K');
            assert!(has_no_length || file(&four.replace(thing, &left)) != seen, "left: {thing}");
        }
    }
}

type Map = fn(Vector) -> Vector;

/// A camera by its vectors, and the things in a union, all of it under one map.
fn mapped(things: &str, steps: &str, map: Map, flip: f64) -> String {
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
    let moved = things.replace("/* moved */", steps);
    let (settings, things) = moved.split_at(moved.find("light_source").expect("a light"));
    format!("#declare K = 1; {settings} camera {{ {camera} }} union {{ {things} {steps} }}")
}

#[test]
fn row_47_a_mirrored_scene_is_the_same_picture_to_a_mirrored_camera_and_its_mirror_to_another() {
    let mirrors: [(&str, Map); 4] = [
        ("scale <-1, 1, 1>", |v| Vector::new(-v.x, v.y, v.z)),
        ("scale <1, -1, 1>", |v| Vector::new(v.x, -v.y, v.z)),
        ("scale <1, 1, -1>", |v| Vector::new(v.x, v.y, -v.z)),
        ("scale -1", |v| -v),
    ];
    for things in WORLDS {
        let plain = unrounded(&mapped(things, "", |v| v, 1.0), SIZE);
        let flipped: Vec<_> = (0..SIZE.1)
            .flat_map(|y| (0..SIZE.0).rev().map(move |x| (x, y)))
            .map(|(x, y)| plain[(y * SIZE.0 + x) as usize])
            .collect();
        assert_ne!(plain, flipped);
        for (steps, map) in mirrors {
            let seen = |flip| unrounded(&mapped(things, steps, map, flip), SIZE);
            assert_eq!(seen(1.0), plain, "{steps}");
            assert_eq!(seen(-1.0), flipped, "{steps}");
        }
    }
}

#[test]
fn row_47_a_scene_whose_axes_are_exchanged_is_the_same_picture_but_for_rounding() {
    // A third of a turn about the diagonal, and its inverse.
    let turns: [(&str, Map); 2] = [
        ("matrix <0,1,0, 0,0,1, 1,0,0, 0,0,0>", |v| Vector::new(v.z, v.x, v.y)),
        ("matrix <0,0,1, 1,0,0, 0,1,0, 0,0,0>", |v| Vector::new(v.y, v.z, v.x)),
    ];
    for things in WORLDS {
        let plain = unrounded(&mapped(things, "", |v| v, 1.0), SIZE);
        for (steps, map) in turns {
            let turned = unrounded(&mapped(things, steps, map, 1.0), SIZE);
            let pairs = turned.iter().zip(&plain);
            let off = pairs.map(|(a, b)| apart(a.components(), b.components()));
            let off = off.fold(0.0, f64::max);
            assert!(off < 1e-9, "{steps}: {off:e}");
        }
    }
}

/// The same picture in any order of the objects, on any threads, and in parts.
fn assert_same_in_any_order(things: &str, touching: Option<&str>, antialias: Antialias) {
    let text = scene(things, 1.0, CAMERAS[0]);
    let whole = film(&text, antialias, 1);
    let file = png(&whole);
    let large = |threads, tile_side| {
        let options = TraceOptions { tile_side, ..TraceOptions::on_threads(threads) };
        png(&film_of(&text, antialias, LARGE, options))
    };
    let one_tile = large(1, Some(LARGE.0));
    for (threads, side) in [(1, None), (2, None), (5, Some(7)), (3, Some(1)), (1, Some(33))] {
        assert!(large(threads, side) == one_tile, "{threads} threads, tiles of {side:?}");
    }
    // The objects in another order, but for two that touch: which is first is seen there.
    let mut lines: Vec<&str> = text.lines().collect();
    let first = lines.iter().position(|line| line.trim().starts_with(FIRST_OBJECT)).expect("it");
    let touches = |line: &str| touching.is_some_and(|word| line.contains(word));
    let last = lines.len();
    if let Some(touching) = lines.iter().position(|line| touches(line)) {
        lines.swap(touching, touching + 1);
    }
    lines[first..].reverse();
    assert!(png(&film(&lines.join("\n"), antialias, 1)) == file, "the other way round");
    for shift in 1..last - first {
        lines[first..].rotate_left(1);
        // Those two are never first and last.
        if !touches(lines[last - 1]) {
            assert!(png(&film(&lines.join("\n"), antialias, 1)) == file, "shifted by {shift}");
        }
    }
    // Regions begin tiles of their own: wherever they lie, they are crops.
    let (world, origins) = compiled(&text);
    for (x, y, width, height) in [(0, 0, 1, 1), (5, 3, 20, 17), (27, 20, 1, 1), (3, 20, 25, 1)] {
        let region = Region { x, y, width, height };
        let frame = Frame { region, ..Frame::whole(SIZE.0, SIZE.1) };
        let plan = plan(&world, &origins, &PlanOptions { antialias, ..PlanOptions::new(frame) });
        let part = trace(&world, &plan, &TraceOptions::on_threads(2), &Unwatched).film;
        let crop = whole.clone().crop(region);
        assert!(png(&part) == png(&crop), "{region:?}");
    }
}

#[test]
fn row_68_order_threads_and_tiles_change_no_byte_of_the_picture() {
    assert_same_in_any_order(THINGS, Some(TOUCHING), Antialias::default());
    assert_same_in_any_order(SHAPES, None, Antialias::Off);
}
