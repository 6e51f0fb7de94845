//! Skies, fogs and rainbows drawn at random look as POV-Ray 3.7 shows them.

use std::fmt::Write as _;

use super::drawn::draw::Draw;
use super::drawn::thing::{Look, thing};
use super::drawn::{Drawn, Kind, SIZE, difference, hold, repeat};
use super::textures::pigment;

const KIND: Kind = Kind { name: "sky", count: 12, scene, difference };

#[test]
fn skies_drawn_at_random_look_the_same() {
    hold(&KIND);
}

#[test]
fn a_number_draws_the_same_sky_again() {
    repeat(&KIND);
}

fn scene(number: u64) -> Drawn {
    let mut draw = Draw::new(number);
    let draw = &mut draw;
    let mut text = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n\
        camera { location <0, 1, -6> look_at <0, 1.6, 0> angle 75 }\n"
        .to_owned();
    let attenuation = draw.maybe(30, |_| " media_attenuation on".to_owned());
    let interaction = draw.maybe(10, |_| " media_interaction off".to_owned());
    let _ = writeln!(
        text,
        "light_source {{ <{}, 6, -4>, rgb 0.9{attenuation}{interaction} }}",
        draw.number(-5.0, 5.0)
    );
    if draw.chance(70) {
        let _ = writeln!(text, "background {{ {} }}", draw.color(false));
    }
    if draw.chance(65) {
        text += &sky_sphere(draw);
    }
    let fogs = if draw.chance(60) { draw.dice.one_of(&[1, 1, 1, 2, 3]) } else { 0 };
    for _ in 0..fogs {
        text += &fog(draw);
    }
    let rainbows = if draw.chance(35) { draw.dice.one_of(&[1, 1, 2]) } else { 0 };
    for _ in 0..rainbows {
        text += &rainbow(draw);
    }
    if draw.chance(60) {
        text += "plane { y, -1 pigment { checker rgb 0.9, rgb 0.4 } }\n";
    }
    let places = [[-2.5, 0.0, 0.0], [2.4, 0.6, 1.0], [0.0, 1.0, 5.0], [-7.0, 2.0, 14.0]];
    for (i, at) in places.into_iter().enumerate() {
        let look = match i {
            0 => Look::Mirror,
            1 => Look::Clear,
            _ => Look::Solid,
        };
        let size = draw.number(0.5, 1.0) * (1.0 + i as f64 / 2.0);
        let more = draw.word(&["", "", " hollow", " hollow off"]);
        text += &thing(draw, at, size, look, more);
    }
    Drawn { text, size: SIZE }
}

fn sky_sphere(draw: &mut Draw) -> String {
    let mut text = "sky_sphere {".to_owned();
    for i in 0..draw.dice.one_of(&[1, 1, 2, 3]) {
        let is_clear = i > 0 || draw.chance(20);
        let inside = match draw.chance(30) {
            true => {
                let entries = draw.entries(5, |draw| draw.color(is_clear));
                format!("gradient y color_map {{ {entries} }}{}", draw.modifiers(1.0))
            }
            false => pigment(draw, is_clear),
        };
        let _ = write!(text, " pigment {{ {inside} }}");
    }
    if draw.chance(40) {
        let _ = match draw.chance(50) {
            true => write!(text, " emission {}", draw.number(0.0, 1.5)),
            false => write!(text, " emission rgb {}", draw.vector(0.0, 1.3)),
        };
    }
    if draw.chance(40) {
        text += &draw.transforms(1.0);
    }
    text + " }\n"
}

fn fog(draw: &mut Draw) -> String {
    let distance = draw.dice.size(0.0, 2.3);
    let mut parts = vec![format!("distance {distance:.2}")];
    parts.push(match draw.chance(45) {
        true => draw.clear_color(),
        false => draw.solid_color(),
    });
    let is_ground = draw.chance(50);
    if is_ground {
        parts.push("fog_type 2".to_owned());
        if draw.chance(80) {
            parts.push(format!("fog_offset {}", draw.number(-1.5, 2.0)));
        }
        parts.push(format!("fog_alt {}", draw.number(0.05, 2.0)));
        if draw.chance(30) {
            parts.push(match draw.chance(50) {
                true => format!("up {}", draw.direction()),
                false => format!("rotate {}", draw.vector(-60.0, 60.0)),
            });
        }
    } else if draw.chance(30) {
        parts.push("fog_type 1".to_owned());
    }
    if draw.chance(45) {
        parts.push(match draw.chance(70) {
            true => format!("turbulence {}", draw.number(0.05, 1.5)),
            false => format!("turbulence {}", draw.vector(0.0, 1.5)),
        });
        if draw.chance(75) {
            parts.push(format!("turb_depth {}", draw.number(0.0, 1.5)));
        }
        if draw.chance(30) {
            parts.push(format!("octaves {}", draw.whole(1, 8)));
        }
        if draw.chance(30) {
            parts.push(format!("omega {}", draw.number(0.2, 0.9)));
        }
        if draw.chance(30) {
            parts.push(format!("lambda {}", draw.number(1.2, 3.0)));
        }
    }
    format!("fog {{ {} }}\n", parts.join(" "))
}

fn rainbow(draw: &mut Draw) -> String {
    let mut parts = vec![
        format!("direction <{}, {}, 1>", draw.number(-1.0, 1.0), draw.number(-0.6, 0.3)),
        format!("angle {}", draw.number(5.0, 60.0)),
        format!("width {}", draw.number(2.0, 30.0)),
        format!("color_map {{ {} }}", draw.entries(5, |draw| draw.color(true))),
    ];
    if draw.chance(70) {
        parts.push(format!("distance {:.2}", draw.dice.size(0.3, 4.0)));
    }
    if draw.chance(40) {
        parts.push(format!("up {}", draw.direction()));
    }
    if draw.chance(40) {
        let arc = draw.number(30.0, 360.0);
        parts.push(format!("arc_angle {arc}"));
        if draw.chance(60) {
            parts.push(format!("falloff_angle {}", draw.number(0.0, arc)));
        }
    }
    format!("rainbow {{ {} }}\n", parts.join(" "))
}
