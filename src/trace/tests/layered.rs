//! Textures look the same whether a surface is shaded alone or with others of its side.

use super::batch::seen;
use super::*;
use crate::math::random::{Random, tries_in};
use crate::road::{Options, Road};
use crate::scene::Dialect;
use crate::source::{FileError, Files, Found};

struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _: &str, _: &str) -> Result<Found, FileError> {
        Err(FileError::NotFound { searched: Vec::new(), similar: Vec::new() })
    }
}

fn world(text: &str) -> World {
    let mut road = Road::new(&NoFiles, Options::new(Dialect::Pov));
    let file = road.read("a.pov", text.as_bytes().to_vec());
    let ast = road.parse(file);
    let scene = road.evaluate(ast);
    let (world, _) = road.lower(scene);
    let errors: Vec<_> = road.diagnostics.iter().map(|one| &one.message).collect();
    assert!(!road.diagnostics.has_errors(), "{errors:?}\n{text}");
    world
}

const PIGMENTS: [&str; 14] = [
    "granite color_map { [0 rgbt <1, 0.5, 0.2, 0.9>] [0.6 rgbf <0.2, 0.3, 0.9, 0.5>] [1 rgb 0.3] } scale 0.4",
    "marble turbulence 0.7 color_map { [0 rgb <0.9, 0.5, 0.3>] [0.7 rgbt <0.2, 0.4, 0.6, 0.8>] [1 rgb 0] }",
    "marble ramp_wave color_map { [0.2 rgbt 1] [0.9 rgb <0.2, 0.8, 0.3>] } scale 0.3",
    "wood turbulence 0.1 color_map { [0 rgb <0.5, 0.3, 0.1>] [1 rgbt <0.7, 0.5, 0.2, 0.7>] } scale 0.3",
    "wood color_map { [0.1 rgb <0.5, 0.3, 0.1>] [1 rgbt 0.6] } scale 0.2 rotate 30*x",
    "spiral2 3 ramp_wave color_map { [0.1 rgb <0.1, 0.3, 0.8>] [1 rgbt 0.9] }",
    "bozo turbulence <0.3, 0, 1> color_map { [0.3 rgbft <-2, 0.1, -2, 1, 0.2>] [0.6 rgbt <1, 1, 1, 0.9>] }",
    "checker rgb <0.8, 0.2, 0.1>, rgbt <0.3, 0.9, 0.1, 0.5> scale 0.3",
    "agate color_map { [0 rgb 1] [1 rgbt <0.4, 0.2, 0.1, 0.8>] } noise_generator 3 scale 0.5",
    "rgbt <0.4, 0.9, 0.2, 0.5>",
    "rgb <0.3, 0.2, 0.7>",
    "dents color_map { [0 rgbt 1] [0.2 rgb <0.9, 0.8, 0.1>] } warp { turbulence 0.4 } scale 0.2",
    "gradient y pigment_map { [0 wrinkles scale 0.2] [1 rgbt 0.7] } scale 0.7",
    "leopard color_map { [0 rgb 0.2] [1 rgbf <0.9, 0.5, 0.5, 0.8>] } scale 0.05",
];

const REST: [&str; 10] = [
    "",
    "",
    "finish { ambient 0.2 diffuse 0.6 phong 0.8 phong_size 20 }",
    "finish { diffuse 0.4 specular 0.7 roughness 0.05 metallic brilliance 2 }",
    "finish { reflection { 0.1, 0.5 } conserve_energy }",
    "finish { irid { 0.4 thickness 0.3 } }",
    "normal { bumps 0.6 scale 0.1 }",
    "normal { wrinkles 0.5 slope_map { [0 <0, 1>] [1 <1, 0>] } scale 0.2 }",
    "normal { gradient x 0.4 scale 0.1 }",
    "normal { dents 0.7 scale <0.1, 0.2, 0.1> no_bump_scale }",
];

const SHAPES: [&str; 5] = [
    "sphere { <-0.7, 0, 0>, 0.8",
    "box { -0.6, <0.5, 0.6, 0.5> rotate <20, 40, 10>",
    "difference { sphere { 0, 1 } box { 0, 2 }",
    "mesh2 { vertex_vectors { 4, <-1,-1,0>, <1,-1,0.3>, <0,1,0>, <0,-1,-1> }
       normal_vectors { 4, <-1,-0.5,-1>, <1,0,-1>, <0,1,-0.5>, <0,-1,-1> }
       face_indices { 2, <0, 1, 2>, <0, 1, 3> }",
    "plane { y, -0.8",
];

fn scene(random: &mut Random) -> String {
    let mut text = "camera { location <0, 0.3, -3> look_at 0 }
        light_source { <-4, 6, -5>, rgb 1 } light_source { <3, 2, -4>, rgb <0.5, 0.3, 0.2> }
        plane { z, 4 pigment { checker rgb 1, rgb 0.2 } }\n"
        .to_owned();
    for shape in SHAPES {
        if random.below(3) == 0 {
            continue;
        }
        text += shape;
        for _ in 0..1 + random.below(3) {
            let (pigment, rest) =
                (PIGMENTS[random.below(PIGMENTS.len())], REST[random.below(REST.len())]);
            text += &format!(" texture {{ pigment {{ {pigment} }} {rest} }}");
        }
        text += &format!(" rotate {} }}\n", random.number(-30.0, 30.0));
    }
    text
}

#[test]
fn layers_and_patterns_look_the_same_alone_and_with_others() {
    for seed in 0..tries_in(50) as u64 {
        let text = scene(&mut Random::of(seed, 31));
        let world = world(&text);
        let plan = plan(&world, &Origins::default(), &options(24, 18, Antialias::Off));
        let [together, alone] = [true, false].map(|together| seen(&world, &plan, together).0);
        for (place, (together, alone)) in together.iter().zip(&alone).enumerate() {
            assert_eq!(together, alone, "{place} of {seed}\n{text}");
        }
    }
}
