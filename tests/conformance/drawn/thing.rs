//! Draws simple things for scenes that are about something else than their surfaces.

use std::fmt::Write as _;

use super::draw::Draw;
use crate::conformance::textures::finish;

/// What a thing lets through.
#[derive(Clone, Copy, PartialEq)]
pub enum Look {
    Solid,
    Clear,
    Mirror,
    /// Without highlights and reflections.
    Dull,
}

/// Returns an object around a point, about `size` large; `more` are words at its end.
pub fn thing(draw: &mut Draw, [x, y, z]: [f64; 3], size: f64, look: Look, more: &str) -> String {
    let shape = match draw.dice.below(6) {
        0 | 1 => "sphere { 0, 1".to_owned(),
        2 => "box { -0.75, 0.75".to_owned(),
        3 => "cylinder { -0.8*y, 0.8*y, 0.7".to_owned(),
        4 => "cone { -0.8*y, 0.9, 0.9*y, 0.2".to_owned(),
        _ => "torus { 0.7, 0.3".to_owned(),
    };
    let turn = draw.vector(-90.0, 90.0);
    let surface = surface(draw, look);
    let ior = match surface.contains("fresnel") {
        true => Some(draw.number(1.1, 1.6)),
        false if look == Look::Clear && draw.chance(40) => Some(draw.number(1.0, 1.6)),
        false => None,
    };
    let interior = ior.map_or(String::new(), |ior| format!(" interior {{ ior {ior} }}"));
    format!(
        "{shape} {surface}{interior} rotate {turn} scale {size} translate <{x}, {y}, {z}>{more} }}\n"
    )
}

/// Returns a `pigment` and a `finish`.
fn surface(draw: &mut Draw, look: Look) -> String {
    let pigment = match look {
        Look::Clear => draw.clear_color(),
        _ if draw.chance(50) => draw.solid_color(),
        _ => {
            let word = draw.word(&["checker", "hexagon", "brick"]);
            let colors: Vec<String> =
                (0..if word == "hexagon" { 3 } else { 2 }).map(|_| draw.solid_color()).collect();
            format!("{word} {} scale {}", colors.join(", "), draw.number(0.2, 0.6))
        }
    };
    let mut text = format!("pigment {{ {pigment} }}");
    let _ = match look {
        Look::Dull => write!(text, " finish {{ diffuse 0.7 ambient 0.1 }}"),
        Look::Mirror => write!(text, " finish {{ reflection {} }}", draw.number(0.5, 1.0)),
        _ => write!(text, "{}", draw.maybe(70, |draw| format!(" finish {{{} }}", finish(draw)))),
    };
    text
}
