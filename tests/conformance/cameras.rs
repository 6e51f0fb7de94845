//! Cameras drawn at random show what POV-Ray 3.7's show.
//!
//! What is not drawn, as POV-Ray 3.7 is at fault:
//!
//! * A camera's `normal` with a `normal_map`, or a list of normals: POV-Ray crashes. `camera { normal { bumps
//!   normal_map { [0 dents] [1 bumps] } } }` ends it with a segmentation fault before the first pixel.
//! * A plane. A camera of parallel rays with a `normal` has rays that are level to rounding, and POV-Ray sees
//!   nothing that is farther than 10⁷: `plane { z, 9.9e6 }` is there, and `plane { z, 1.01e7 }` is not.

use lucarne::math::elementary::sin_cos_degrees;

use super::drawn::draw::Draw;
use super::drawn::thing::{Look, thing};
use super::drawn::{Drawn, Kind, SIZE, difference, hold, repeat};
use super::textures::{DEEPEST, normal};
use crate::programs::Size;

const KIND: Kind = Kind { name: "cameras", count: 12, scene, difference };

#[test]
fn cameras_drawn_at_random_show_the_same() {
    hold(&KIND);
}

#[test]
fn a_number_draws_the_same_camera_again() {
    repeat(&KIND);
}

const SIZES: [Size; 5] = [SIZE, [64, 64], [48, 80], [110, 40], [81, 61]];

fn scene(number: u64) -> Drawn {
    let mut draw = Draw::new(number);
    let draw = &mut draw;
    let mut text = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n\
        light_source { <-3, 8, -4>, rgb 0.6 }\nlight_source { <4, 6, 5>, rgb 0.4 shadowless }\n\
        sky_sphere { pigment { gradient y color_map { [0 rgb <0.5, 0.2, 0.1>] [0.5 rgb <0.7, 0.8, 0.9>] \
        [1 rgb <0.1, 0.2, 0.6>] } scale 2 translate -1 } }\n\
        disc { -1.5*y, y, 90 pigment { checker rgb <0.8, 0.8, 0.6>, rgb <0.4, 0.5, 0.4> } }\n"
        .to_owned();
    // All around, as some cameras see behind themselves.
    for i in 0..draw.whole(4, 9) {
        let far = draw.number(3.0, 6.0);
        let angle = draw.number(0.0, 360.0);
        let (sin, cos) = sin_cos_degrees(if i == 0 { 90.0 } else { angle });
        let round = |n: f64| (n * 1000.0).round() / 1000.0;
        let height = draw.number(-0.8, 2.0);
        let at = [round(far * cos), height, round(far * sin)];
        let look = draw.dice.one_of(&[Look::Solid, Look::Solid, Look::Solid, Look::Mirror]);
        let size = draw.number(0.5, 1.3);
        text += &thing(draw, at, size, look, "");
    }
    let size = draw.dice.one_of(&SIZES);
    text += &camera(draw, size);
    Drawn { text, size }
}

fn camera(draw: &mut Draw, size: Size) -> String {
    if draw.chance(7) {
        return mesh_camera(draw, size);
    }
    let kind = draw.dice.below(13);
    let head = match kind {
        0..3 => "perspective".to_owned(),
        3 | 4 => "orthographic".to_owned(),
        5 => "fisheye".to_owned(),
        6 => "ultra_wide_angle".to_owned(),
        7 => "omnimax".to_owned(),
        8 => "panoramic".to_owned(),
        9 | 10 => format!("cylinder {}", draw.whole(1, 4)),
        _ => "spherical".to_owned(),
    };
    let mut parts = Vec::new();
    if draw.chance(60) {
        parts.push(match kind {
            0..5 => format!("angle {}", draw.number(10.0, 130.0)),
            11.. if draw.chance(50) => {
                format!("angle {} {}", draw.number(40.0, 360.0), draw.number(20.0, 180.0))
            }
            _ => format!("angle {}", draw.number(30.0, 360.0)),
        });
    }
    let turn = if draw.chance(50) { "look_at" } else { "" };
    if !turn.is_empty() {
        parts.push(format!("look_at <{}, {}, 4>", draw.number(-4.0, 4.0), draw.number(-2.0, 2.0)));
    }
    // Sides with the shape of the picture, or others.
    if draw.chance(50) {
        parts.push(format!("right x*{}/{}", size[0], size[1]));
    } else if draw.chance(50) {
        parts.push(match draw.dice.below(3) {
            0 => format!("right {}*x", draw.number(0.4, 2.5)),
            1 => format!("right -{}*x", draw.number(0.4, 2.5)),
            _ => format!(
                "right <{}, {}, {}>",
                draw.number(0.6, 1.5),
                draw.number(-0.4, 0.4),
                draw.number(-0.4, 0.4)
            ),
        });
    }
    if draw.chance(25) {
        parts.push(match draw.dice.below(3) {
            0 => format!("up {}*y", draw.number(0.4, 2.0)),
            1 => format!("up {}*z", draw.number(0.5, 1.5)),
            _ => format!(
                "up <{}, {}, {}>",
                draw.number(-0.4, 0.4),
                draw.number(0.6, 1.5),
                draw.number(-0.4, 0.4)
            ),
        });
    }
    if draw.chance(25) {
        parts.push(match draw.chance(60) {
            true => format!("direction {}*z", draw.number(0.3, 3.0)),
            false => {
                format!("direction <{}, {}, 1>", draw.number(-0.4, 0.4), draw.number(-0.4, 0.4))
            }
        });
    }
    if draw.chance(25) {
        parts.push(format!("sky {}", draw.vector(-1.0, 1.0)));
    }
    if draw.chance(25) {
        draw.depth = DEEPEST;
        parts.push(format!("normal {{ {} }}", normal(draw)));
    }
    if draw.chance(40) {
        parts.push(format!(
            "location <{}, {}, {}>",
            draw.number(-1.0, 1.0),
            draw.number(-1.2, 1.5),
            draw.number(-1.5, 1.0)
        ));
    }
    // The order of these makes no difference.
    let begin = draw.whole(0, parts.len());
    parts.rotate_left(begin);
    for _ in 0..draw.whole(0, 2) {
        parts.push(match draw.dice.below(4) {
            0 => format!("translate {}", draw.vector(-0.5, 0.5)),
            1 => format!("scale {}", draw.vector(0.6, 1.6)),
            2 => format!("rotate {}*y", draw.number(-180.0, 180.0)),
            _ => format!("rotate {}", draw.vector(-40.0, 40.0)),
        });
    }
    format!("camera {{ {head} {} }}\n", parts.join(" "))
}

/// Returns a camera whose rays start on a bent sheet of faces.
fn mesh_camera(draw: &mut Draw, [width, height]: Size) -> String {
    let kind = draw.whole(0, 3);
    // A face for each pixel, or texture coordinates that cover the picture.
    let [columns, rows] = match kind {
        3 => [draw.whole(2, 7), draw.whole(2, 7)],
        _ => [width as usize, height as usize],
    };
    let [bend, tilt] = [draw.number(-0.6, 0.6), draw.number(-0.5, 0.5)];
    let point = |i: &str, j: &str| {
        format!(
            "<3*({i})/{columns} - 1.5, 1.5 - 2*({j})/{rows}, {bend}*pow(({i})/{columns} - 0.5, 2)*4 + {tilt}*({j})/{rows}>"
        )
    };
    let corners =
        [point("I", "J"), point("I + 1", "J"), point("I", "J + 1"), point("I + 1", "J + 1")];
    let uv = |i: &str, j: &str| format!("<({i})/{columns}, 1 - ({j})/{rows}>");
    let [a, b, c, d] = &corners;
    let triangle = |[p, q, r]: [&str; 3], uvs: [String; 3]| {
        let uvs = if kind == 3 { format!(" uv_vectors {}", uvs.join(", ")) } else { String::new() };
        format!("triangle {{ {p}, {q}, {r}{uvs} }}")
    };
    let first = triangle([a, b, c], [uv("I", "J"), uv("I + 1", "J"), uv("I", "J + 1")]);
    let second = match kind {
        3 => triangle([b, d, c], [uv("I + 1", "J"), uv("I + 1", "J + 1"), uv("I", "J + 1")]),
        _ => String::new(),
    };
    let mesh = format!(
        "mesh {{ #for (J, 0, {rows} - 1) #for (I, 0, {columns} - 1) {first} {second} #end #end }}"
    );
    let direction = draw.word(&["-z", "z", "<0, 0, -0.5>"]);
    let location = draw.maybe(50, |d| format!(" location <0, 0, {}>", d.number(0.0, 0.5)));
    format!("camera {{ mesh_camera {{ 1 {kind} {mesh} }} direction {direction}{location} }}\n")
}
