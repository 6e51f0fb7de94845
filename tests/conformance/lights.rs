//! Lights drawn at random look as POV-Ray 3.7 shows them.

use std::fmt::Write as _;

use super::drawn::draw::Draw;
use super::drawn::thing::{Look, thing};
use super::drawn::{Drawn, Kind, SIZE, difference, hold, repeat};

const KIND: Kind = Kind { name: "lights", count: 12, scene, difference };

#[test]
fn lights_drawn_at_random_look_the_same() {
    hold(&KIND);
}

#[test]
fn a_number_draws_the_same_lights_again() {
    repeat(&KIND);
}

/// Where things are.
const PLACES: [[f64; 3]; 5] =
    [[-2.1, 0.0, 0.3], [0.0, 0.1, -0.6], [2.0, 0.2, 0.4], [-0.7, 0.6, 2.2], [1.3, -0.4, -1.9]];

fn scene(number: u64) -> Drawn {
    let mut draw = Draw::new(number);
    let draw = &mut draw;
    let mut text = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n\
        camera { location <0, 3, -7> look_at <0, 0.1, 0> angle 45 }\n"
        .to_owned();
    let _ = writeln!(text, "background {{ rgb {} }}", draw.vector(0.0, 0.5));
    let finish =
        draw.maybe(50, |d| format!(" finish {{ phong 0.5 diffuse {} }}", d.number(0.4, 0.8)));
    let _ = writeln!(text, "plane {{ y, -1 pigment {{ checker rgb 0.9, rgb 0.5 }}{finish} }}");
    if draw.chance(30) {
        text += "plane { z, 4 pigment { rgb 0.8 } }\n";
    }
    let count = draw.whole(1, 3);
    for _ in 0..count {
        let _ = writeln!(text, "{}", light(draw));
    }
    for (i, place) in PLACES.into_iter().enumerate() {
        let look = match i {
            0 | 1 => Look::Solid,
            2 => Look::Clear,
            _ => draw.dice.one_of(&[Look::Solid, Look::Clear, Look::Mirror]),
        };
        let size = draw.number(0.5, 1.0);
        let more = match draw.dice.below(14) {
            0 => " no_shadow",
            1 => " double_illuminate",
            2 => " no_image",
            3 => " no_reflection",
            _ => "",
        };
        let object = thing(draw, place, size, look, more);
        if !draw.chance(15) {
            text += &object;
            continue;
        }
        let lights: String = (0..draw.whole(1, 2)).map(|_| light(draw)).collect();
        let global = draw.maybe(60, |d| format!(" global_lights {}", d.word(&["on", "off"])));
        let _ = writeln!(text, "light_group {{ {lights}\n {object} {global} }}");
    }
    Drawn { text, size: SIZE }
}

/// Returns a point for a light.
fn place(draw: &mut Draw) -> String {
    match draw.dice.below(10) {
        // In or behind a thing.
        0 => {
            let [x, y, z] = draw.dice.one_of(&PLACES);
            format!("<{x}, {y}, {z}>")
        }
        1 => draw.vector(-1.5, 1.5),
        // Below the plane, or far away.
        2 => format!("<{}, -3, {}>", draw.number(-3.0, 3.0), draw.number(-3.0, 3.0)),
        3 => {
            let far = draw.dice.size(2.0, 7.0).round();
            format!("<{}, 1, {}>*{far}", draw.number(-1.0, 1.0), draw.number(-1.0, 0.5))
        }
        _ => {
            let [x, y, z] = [(-5.0, 5.0), (1.0, 7.0), (-6.0, 3.0)].map(|(a, b)| draw.number(a, b));
            format!("<{x}, {y}, {z}>")
        }
    }
}

/// Returns a `light_source`.
fn light(draw: &mut Draw) -> String {
    let color = match draw.dice.below(12) {
        0 => format!("rgb {}", draw.vector(-0.5, 1.0)),
        1 => format!("rgb {}", draw.number(1.0, 3.0)),
        2..5 => format!("rgb {}", draw.number(0.3, 1.0)),
        _ => format!("rgb {}", draw.vector(0.1, 1.0)),
    };
    let mut parts = Vec::new();
    let is_parallel = draw.chance(20);
    if is_parallel {
        parts.push("parallel".to_owned());
    }
    let mut is_aimed = is_parallel;
    if draw.chance(50) {
        parts.push(beam(draw));
        is_aimed = true;
    }
    if is_aimed && draw.chance(85) {
        parts.push(format!("point_at {}", draw.vector(-1.5, 1.5)));
    }
    if draw.chance(40) {
        parts.push(area(draw));
    }
    if draw.chance(30) {
        let distance = draw.number(0.5, 12.0);
        let power = match draw.chance(70) {
            true => format!("{}", draw.whole(1, 3)),
            false => format!("{}", draw.number(0.3, 5.0)),
        };
        parts.push(format!("fade_distance {distance} fade_power {power}"));
    }
    if draw.chance(12) {
        let size = draw.number(0.1, 0.5);
        let clear = draw.maybe(30, |_| " filter 0.5".to_owned());
        parts.push(format!(
            "looks_like {{ sphere {{ {}, {size} pigment {{ rgb <1, 0.8, 0.3>{clear} }} finish {{ ambient 0.8 }} }} }}",
            draw.vector(-0.3, 0.3)
        ));
    }
    if draw.chance(10) {
        let point = draw.vector(-1.5, 1.5);
        let through = match draw.chance(50) {
            true => format!("disc {{ {point}, {}, {} }}", draw.direction(), draw.number(0.5, 2.0)),
            false => {
                format!("box {{ -{size}, {size} translate {point} }}", size = draw.number(0.3, 1.5))
            }
        };
        parts.push(format!("projected_through {{ {through} }}"));
    }
    if draw.chance(12) {
        parts.push("shadowless".to_owned());
    }
    if draw.chance(20) {
        parts.push(transform(draw));
    }
    format!("light_source {{ {}, {color} {} }}", place(draw), parts.join(" "))
}

/// Returns the words of a spotlight or a cylinder.
fn beam(draw: &mut Draw) -> String {
    let is_spotlight = draw.chance(65);
    let mut text = if is_spotlight { "spotlight" } else { "cylinder" }.to_owned();
    let most = if is_spotlight { 60.0 } else { 3.0 };
    if draw.chance(85) {
        let _ = write!(text, " radius {}", draw.number(0.0, most));
    }
    if draw.chance(85) {
        let _ = write!(text, " falloff {}", draw.number(0.02 * most, 1.3 * most));
    }
    if draw.chance(40) {
        let _ = match draw.chance(50) {
            true => write!(text, " tightness {}", draw.whole(0, 30)),
            false => write!(text, " tightness {}", draw.number(0.0, 3.0)),
        };
    }
    text
}

/// Returns the words of an area light.
fn area(draw: &mut Draw) -> String {
    let sides = match draw.chance(50) {
        true => {
            let [a, b] = draw.dice.one_of(&[["x", "y"], ["x", "z"], ["z", "y"], ["y", "x"]]);
            format!("{}*{a}, {}*{b}", draw.number(0.1, 3.0), draw.number(0.1, 3.0))
        }
        false => format!("{}, {}", draw.vector(-2.0, 2.0), draw.vector(-2.0, 2.0)),
    };
    // POV-Ray refuses a disc of one node.
    let circular = draw.maybe(30, |_| " circular".to_owned());
    let least = if circular.is_empty() { 1 } else { 2 };
    let nodes = draw.chance(30).then(|| draw.whole(least, 9));
    let [m, n] = [0; 2].map(|_| nodes.unwrap_or_else(|| draw.whole(least, 7)));
    let mut text = format!("area_light {sides}, {m}, {n}");
    if draw.chance(50) {
        let _ = write!(text, " adaptive {}", draw.whole(0, 4));
    }
    text += &circular;
    if draw.chance(25) {
        text += " orient";
    }
    if draw.chance(25) {
        text += " area_illumination";
        text += draw.word(&["", " on", " on", " off"]);
    }
    text
}

fn transform(draw: &mut Draw) -> String {
    match draw.dice.below(3) {
        0 => format!("rotate {}", draw.vector(-90.0, 90.0)),
        1 => format!("translate {}", draw.vector(-2.0, 2.0)),
        _ => format!("scale {}", draw.vector(0.5, 1.5)),
    }
}
