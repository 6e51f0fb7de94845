//! Draws a scene: lights, defaults, and an object with textures above a plane.

use std::fmt::Write as _;

use super::surface::{finish, normal, pigment, textures};
use crate::conformance::drawn::draw::Draw;
use crate::conformance::drawn::{Drawn, SIZE};

/// The scene of a number.
pub fn scene(number: u64) -> Drawn {
    let mut draw = Draw::new(number);
    let draw = &mut draw;
    let mut text = "#version 3.7;\nglobal_settings { assumed_gamma 1".to_owned();
    text += &draw.maybe(10, |draw| format!(" noise_generator {}", draw.whole(1, 3)));
    text += &draw.maybe(10, |draw| format!(" number_of_waves {}", draw.whole(1, 12)));
    text += &draw.maybe(10, |draw| format!(" ambient_light rgb {}", draw.vector(0.3, 2.0)));
    text += " }\ncamera { location <0, 2, -6> look_at <0, 0.1, 0> angle 32 }\n";
    let _ = writeln!(text, "light_source {{ <{}, 8, -6>, rgb 0.9 }}", draw.number(-6.0, 6.0));
    if draw.chance(40) {
        let _ = writeln!(text, "light_source {{ <-5, 3, -2>, rgb {} }}", draw.vector(0.2, 0.6));
    }
    let _ = writeln!(text, "background {{ rgb {} }}", draw.vector(0.0, 0.6));
    text += &default(draw);
    if draw.chance(85) {
        let _ = writeln!(text, "plane {{ y, -1.1 pigment {{ checker rgb 0.8, rgb 0.4 }} }}");
    } else {
        let _ = writeln!(text, "plane {{ y, -1.1 {} interior {{ ior 1.3 }} }}", textures(draw));
    }
    let is_fresnel = text.contains("fresnel");
    text += &object(draw, is_fresnel);
    Drawn { text, size: SIZE }
}

fn default(draw: &mut Draw) -> String {
    if !draw.chance(12) {
        return String::new();
    }
    draw.is_default = true;
    let items = match draw.dice.below(3) {
        0 => format!("pigment {{ {} }}", pigment(draw, false)),
        1 => format!("finish {{{} }}", finish(draw)),
        _ => format!(
            "texture {{ pigment {{ {} }} normal {{ {} }} }}",
            pigment(draw, false),
            normal(draw)
        ),
    };
    draw.is_default = false;
    format!("#default {{ {items} }}\n")
}

/// An octahedron, its faces as large as its uv coordinates say.
const MESH: &str = "mesh2 { vertex_vectors { 6 <1,0,0>, <-1,0,0>, <0,1,0>, <0,-1,0>, <0,0,1>, <0,0,-1> } \
    uv_vectors { 4 <0,0>, <1,0>, <0.5,1>, <0.2,0.7> } \
    face_indices { 8 <0,2,5>, <5,2,1>, <1,2,4>, <4,2,0>, <0,3,5>, <5,3,1>, <1,3,4>, <4,3,0> } \
    uv_indices { 8 <0,1,2>, <0,1,2>, <0,1,3>, <0,1,2>, <1,3,0>, <1,2,0>, <0,1,2>, <3,1,2> }";
const SMOOTH: &str = "mesh { smooth_triangle { <-1,-0.8,0>, <-0.6,-0.3,-1>, <1,-0.8,0>, <0.6,-0.3,-1>, <0,1,0.3>, <0,0.5,-1> } \
    smooth_triangle { <-1,-0.8,0>, <-0.6,-0.3,-1>, <0,1,0.3>, <0,0.5,-1>, <-1.2,0.9,0>, <-0.6,0.5,-1> }";

fn object(draw: &mut Draw, is_fresnel: bool) -> String {
    // Those that have uv coordinates come first.
    let kind = draw.dice.below(12);
    let shape = match kind {
        0 | 1 => "sphere { 0, 1".to_owned(),
        2 => "box { -0.8, 0.8".to_owned(),
        3 => format!("torus {{ 0.8, {}", draw.number(0.2, 0.4)),
        4 => MESH.to_owned(),
        5 => "cylinder { -0.9*y, 0.9*y, 0.8".to_owned(),
        6 => "cone { -0.9*y, 0.9, 0.9*y, 0.3".to_owned(),
        7 => SMOOTH.to_owned(),
        8 => "superellipsoid { <0.4, 0.6>".to_owned(),
        _ => solid(draw),
    };
    let mut text = shape;
    if kind == 1 && draw.chance(30) {
        text = "sphere { <0.3, 0.1, -0.2>, 0.9".to_owned();
    }
    if draw.chance(25) {
        text += &placed(draw);
    }
    text += "\n  ";
    if kind < 5 && draw.chance(30) {
        text += &match draw.chance(50) {
            true => format!("texture {{ uv_mapping pigment {{ {} }} }}", pigment(draw, false)),
            false => {
                let inside = pigment(draw, false);
                let normal =
                    draw.maybe(40, |draw| format!(" normal {{ uv_mapping {} }}", normal(draw)));
                format!("texture {{ pigment {{ uv_mapping {inside} }}{normal} }}")
            }
        };
    } else {
        text += &textures(draw);
    }
    text += "\n ";
    let has_ior = is_fresnel || text.contains("fresnel") || draw.chance(15);
    if has_ior {
        let _ = write!(text, " interior {{ ior {} }}", draw.number(1.1, 1.6));
    }

    text += &placed(draw);
    text += " }\n";
    text
}

/// Transforms of an object, which stays in view.
fn placed(draw: &mut Draw) -> String {
    let mut text = String::new();
    if draw.chance(50) {
        let _ = write!(text, " rotate {}", draw.vector(-60.0, 60.0));
    }
    if draw.chance(25) {
        let _ = write!(text, " scale {}", draw.vector(0.7, 1.1));
    }
    if draw.chance(25) {
        let _ = write!(text, " translate {}", draw.vector(-0.3, 0.3));
    }
    text
}

/// A solid made of two, up to the end of its parts.
fn solid(draw: &mut Draw) -> String {
    let word = draw.word(&["union", "merge", "intersection", "difference", "difference"]);
    let [first, second] = [0; 2].map(|_| draw.maybe(35, textures));
    let other = match draw.chance(50) {
        true => "sphere { <0.5, 0.5, -0.6>, 0.7",
        false => "cylinder { -2*z, 2*z, 0.5",
    };
    format!("{word} {{ box {{ -0.75, 0.75 {first} }} {other} {second} }}")
}
