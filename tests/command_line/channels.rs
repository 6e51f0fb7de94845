//! `--channels`: what an OpenEXR picture holds beside its colours.

use std::collections::BTreeMap;

use exr::image::FlatSamples;
use exr::meta::MetaData;
use exr::meta::attribute::LineOrder;
use exr::prelude::read_first_flat_layer_from_file;

use super::Place;

const ALL: &str = "--channels depth,normal,albedo,object";

/// A ball of radius 1 over a plane, seen along z through a screen whose rays are known.
const BALL: &str = "\
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> direction z right 4/3*x up y }
light_source { <4, 8, -6>, rgb 1 }
plane { y, -1 pigment { rgb <0.5, 0.25, 1> } }
union { sphere { 0, 1 } pigment { rgb <1, 0.5, 0.25> transmit 0.75 } }
";

const SIZE: (usize, usize) = (48, 36);

/// The channels of a picture by name, and its width.
struct Read {
    width: usize,
    channels: BTreeMap<String, FlatSamples>,
}

impl Read {
    fn file(place: &Place, name: &str) -> Self {
        let image = read_first_flat_layer_from_file(place.path(name)).expect("an OpenEXR file");
        let layer = image.layer_data;
        let list = layer.channel_data.list.into_iter();
        let channels = list.map(|channel| (channel.name.to_string(), channel.sample_data));
        Self { width: layer.size.width(), channels: channels.collect() }
    }

    fn names(&self) -> Vec<&str> {
        self.channels.keys().map(String::as_str).collect()
    }

    fn floats(&self, name: &str) -> &[f32] {
        match &self.channels[name] {
            FlatSamples::F32(floats) => floats,
            other => panic!("{name}: {other:?}"),
        }
    }

    /// The numbers of three channels at a pixel.
    fn three(&self, names: [&str; 3], index: usize) -> [f64; 3] {
        names.map(|name| self.floats(name)[index].into())
    }

    fn normal(&self, index: usize) -> [f64; 3] {
        self.three(["normal.X", "normal.Y", "normal.Z"], index)
    }

    fn albedo(&self, index: usize) -> [f64; 3] {
        self.three(["albedo.R", "albedo.G", "albedo.B"], index)
    }

    fn objects(&self) -> &[u32] {
        match &self.channels["object"] {
            FlatSamples::U32(numbers) => numbers,
            other => panic!("{other:?}"),
        }
    }
}

/// The distance, normal, albedo and number of what a pixel of [`BALL`] shows.
fn expected((x, y): (usize, usize)) -> (f64, [f64; 3], [f64; 3], u32) {
    let (width, height) = (SIZE.0 as f64, SIZE.1 as f64);
    let right = ((x as f64 + 0.5) / width - 0.5) * 4.0 / 3.0;
    let up = 0.5 - (y as f64 + 0.5) / height;
    let length = (right * right + up * up + 1.0).sqrt();
    let direction = [right, up, 1.0].map(|c| c / length);
    let origin = [0.0, 1.0, -6.0];
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let half = dot(origin, direction);
    let discriminant = half * half - dot(origin, origin) + 1.0;
    if discriminant >= 0.0 {
        let t = -half - discriminant.sqrt();
        let point = std::array::from_fn(|i| origin[i] + t * direction[i]);
        return (t, point, [0.25, 0.125, 0.0625], 3);
    }
    match direction[1] < 0.0 {
        true => (-2.0 / direction[1], [0.0, 1.0, 0.0], [0.5, 0.25, 1.0], 2),
        false => (f64::INFINITY, [0.0; 3], [0.0; 3], 0),
    }
}

fn is_close(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= 1e-6 * b.abs().max(1.0)
}

fn ball() -> Place {
    let place = Place::new();
    place.write("ball.pov", BALL);
    place
}

#[test]
fn channels_hold_the_first_surface_on_the_ray_through_each_pixels_centre() {
    let place = ball();
    place.run(&format!("ball.pov --size 48x36 {ALL} -o a.exr")).ends(0, &["a.exr: 48×36"]);
    let read = Read::file(&place, "a.exr");
    let mut seen = [0; 4];
    for index in 0..SIZE.0 * SIZE.1 {
        let (depth, normal, albedo, object) = expected((index % SIZE.0, index / SIZE.0));
        let z = f64::from(read.floats("Z")[index]);
        assert!(z == depth || (z - depth).abs() <= 1e-6 * depth, "{index}: {z} {depth}");
        for (read, expected) in [(read.normal(index), normal), (read.albedo(index), albedo)] {
            let is_close = read.iter().zip(expected).all(|(&a, b)| is_close(a, b));
            assert!(is_close, "{index}: {read:?} {expected:?}");
        }
        assert_eq!(read.objects()[index], object, "{index}");
        seen[object as usize] += 1;
    }
    assert!(seen[0] > 100 && seen[2] > 100 && seen[3] > 100, "{seen:?}");
}

#[test]
fn the_colours_are_those_of_a_picture_without_channels_and_others_are_left_out() {
    let place = ball();
    place.run("ball.pov --size 48x36 --antialias 2 --alpha -o plain.exr").ends(0, &[]);
    let plain = Read::file(&place, "plain.exr");
    assert_eq!(plain.names(), ["A", "B", "G", "R"]);
    for (words, names) in [
        ("object,depth,object --alpha", vec!["A", "B", "G", "R", "Z", "object"]),
        ("normal --alpha", vec!["A", "B", "G", "R", "normal.X", "normal.Y", "normal.Z"]),
        ("albedo", vec!["B", "G", "R", "albedo.B", "albedo.G", "albedo.R"]),
    ] {
        let words = format!("ball.pov --size 48x36 --antialias 2 --channels {words} -o a.exr");
        place.run(&words).ends(0, &[]);
        let read = Read::file(&place, "a.exr");
        assert_eq!(read.names(), names);
        for name in ["R", "G", "B"] {
            assert!(read.floats(name) == plain.floats(name), "{words}");
        }
        // Other programs, and scenes, read its colours as ever.
        let shown = image::open(place.path("a.exr")).expect("a picture").to_rgb32f();
        let red: Vec<f32> = shown.pixels().map(|pixel| pixel.0[0]).collect();
        assert!(red == plain.floats("R"));
    }
}

#[test]
fn a_file_has_scan_lines_from_the_top_and_the_same_bytes_for_any_number_of_threads() {
    let place = ball();
    for threads in [1, 2] {
        let words = format!("ball.pov --size 48x36 {ALL} --threads {threads} -o {threads}.exr");
        place.run(&words).ends(0, &[]);
    }
    assert!(place.read("1.exr") == place.read("2.exr"));
    let about = MetaData::read_from_file(place.path("1.exr"), true).expect("an OpenEXR file");
    let header = &about.headers[0];
    assert_eq!((about.headers.len(), header.line_order), (1, LineOrder::Increasing));
    assert!(!header.blocks.has_tiles() && !header.deep);
}

#[test]
fn a_region_has_the_channels_of_its_pixels() {
    let place = ball();
    place.run(&format!("ball.pov --size 48x36 {ALL} -o whole.exr")).ends(0, &[]);
    place.run(&format!("ball.pov --size 48x36 {ALL} --region 9,5,21,19 -o a.exr")).ends(0, &[]);
    let (whole, part) = (Read::file(&place, "whole.exr"), Read::file(&place, "a.exr"));
    assert_eq!((part.width, part.objects().len()), (21, 21 * 19));
    for (index, object) in part.objects().iter().enumerate() {
        let of_whole = (5 + index / 21) * SIZE.0 + 9 + index % 21;
        assert_eq!(*object, whole.objects()[of_whole]);
        assert_eq!(part.floats("Z")[index], whole.floats("Z")[of_whole]);
        assert_eq!(part.normal(index), whole.normal(of_whole));
    }
}

/// The numbers in a row of pixels, from left to right, each once.
fn row(read: &Read) -> Vec<u32> {
    let mut row = read.objects()[..read.width].to_vec();
    row.dedup();
    row
}

#[test]
fn numbers_count_the_objects_and_lights_at_the_top_level_as_written() {
    let place = Place::new();
    place.write(
        "row.scene",
        "camera { orthographic location <0, 0, 9> look_at 0 right 14*x up y }
        light_source { <4, 8, 6>, rgb 1 }
        union { sphere { -6*x, 0.5 } union { sphere { -4*x, 0.5 } sphere { -5*x, 0.5 } } pigment { rgb 1 } }
        light_source { 9*y, rgb 0 }
        light_source { <-2, 0, 0>, rgb 1 looks_like { sphere { 0, 0.5 pigment { rgb 1 } } } }
        sphere { 9*y, 1 no_image pigment { rgb 1 } }
        #declare Ball = difference { sphere { 0, 0.5 } box { <0, 0.1, -1>, 1 } pigment { rgb 1 } }
        object { Ball }
        sphere { (4 - 2*clock)*x, 0.5 pigment { rgb 1 } }
        object { Ball translate 6*x }
",
    );
    place.run("row.scene --size 140x1 --channels object -o a.exr").ends(0, &[]);
    let numbers = row(&Read::file(&place, "a.exr"));
    assert_eq!(numbers, [0, 2, 0, 4, 0, 6, 0, 7, 0, 8, 0]);
    // They are the same in each frame.
    let film = "row.scene --size 140x1 --channels object --frames 1..2 -o f.exr";
    place.run(film).ends(0, &["f1.exr", "f2.exr"]);
    assert_eq!(place.read("f1.exr"), place.read("a.exr"));
    assert_eq!(row(&Read::file(&place, "f2.exr")), numbers);
}

#[test]
fn layers_share_the_albedo_and_bumps_perturb_the_normal() {
    let place = Place::new();
    place.write(
        "wall.scene",
        "camera { location <0, 0, 4> look_at 0 }
        light_source { <4, 8, 6>, rgb 1 }
        global_settings { assumed_gamma 2 }
        plane {
          z, 0
          texture { pigment { rgb <0, 1, 0> } normal { bumps 0.8 scale 0.2 } }
          texture { pigment { rgbt <0.8, 0, 0, 0.5> } normal { bumps 0.8 scale 0.2 } }
        }
",
    );
    place.run(&format!("wall.scene --size 20x15 {ALL} -o a.exr")).ends(0, &[]);
    let read = Read::file(&place, "a.exr");
    let mut normals = Vec::new();
    for index in 0..20 * 15 {
        let albedo = read.albedo(index);
        let is_right = [0.16, 0.25, 0.0].iter().zip(albedo).all(|(a, b)| is_close(*a, b));
        assert!(is_right, "{albedo:?}");
        let normal = read.normal(index);
        let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
        assert!(is_close(length, 1.0), "{normal:?}");
        normals.push(normal[0]);
    }
    assert!(normals.iter().any(|x| *x > 0.1) && normals.iter().any(|x| *x < -0.1), "{normals:?}");
}

#[test]
fn channels_come_with_promises_cameras_of_all_kinds_and_blur() {
    let place = Place::new();
    place.run(&format!("a.scene --size 32x24 {ALL} --max-error 0.2 -o a.exr")).ends(0, &[]);
    assert_eq!(Read::file(&place, "a.exr").objects()[12 * 32 + 16], 2);
    let depth = |camera: &str| {
        place.write("b.scene", &format!("{camera} sphere {{ 0, 1 pigment {{ rgb 1 }} }}"));
        place.run("b.scene --size 33x33 --channels depth -o b.exr --allow no-light").ends(0, &[]);
        let read = Read::file(&place, "b.exr");
        (read.floats("Z")[0], read.floats("Z")[16 * 33 + 16])
    };
    for camera in [
        "camera { fisheye angle 360 right x location 5*z look_at 0 }",
        "camera { right x location 5*z look_at 0 aperture 0.5 focal_point 0 blur_samples 9 }",
        "camera { orthographic right 4*x up 4*y location 5*z look_at 0 }",
    ] {
        // The fisheye has no rays in its corners.
        assert_eq!(depth(camera), (f32::INFINITY, 4.0), "{camera}");
    }
}

#[test]
fn what_cannot_have_channels_is_known_before_the_picture_is_rendered() {
    let place = ball();
    let run = place.run("ball.pov --channels depth,colour -o a.exr");
    run.ends(2, &["invalid value 'colour'", "depth, normal, albedo, object"]);
    for output in ["", "-o a.png", "-o a.hdr", "-o -", "-o a.gif --frames 1..2"] {
        let run = place.run(&format!("ball.pov --size 8x6 --channels depth {output}"));
        run.ends(2, &["only an .exr picture has further channels", "`-o OUT.exr`"]);
    }
    let run = place.run("ball.pov --size 8x6 --channels depth --shard 1/2 -o a.exr");
    run.ends(2, &["a part of a picture has its colours alone", "`--region`"]);
    assert_eq!(place.names(), ["a.scene", "ball.pov", "broken.scene"]);
    // A part of an animation is some of its pictures.
    let run = place.run("ball.pov --size 8x6 --channels depth --frames 1..2 --shard 2/2 -o a.exr");
    run.ends(0, &["a2.exr"]);
    assert!(Read::file(&place, "a2.exr").channels.contains_key("Z"));
}
