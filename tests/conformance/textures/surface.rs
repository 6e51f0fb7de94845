//! Draws pigments, normals, finishes and textures.

use std::fmt::Write as _;

use super::pattern::Of;
use crate::conformance::drawn::draw::{CLEAR, Draw};

/// How deep blocks of maps are nested.
pub const DEEPEST: usize = 2;

/// Runs a draw one block deeper.
fn deeper<T>(draw: &mut Draw, inner: impl FnOnce(&mut Draw) -> T) -> T {
    draw.depth += 1;
    let drawn = inner(draw);
    draw.depth -= 1;
    drawn
}

/// The size of patterns: smaller in inner blocks.
fn size(draw: &mut Draw) -> f64 {
    draw.dice.one_of(&[0.25, 0.4, 0.7]) / (1.0 + 0.5 * draw.depth as f64)
}

/// The items of a pigment. `is_clear`: some of its colours let light through.
pub fn pigment(draw: &mut Draw, is_clear: bool) -> String {
    if draw.depth > DEEPEST || draw.chance(if draw.depth > 0 { 45 } else { 10 }) {
        return draw.color(is_clear);
    }
    let size = size(draw);
    if draw.chance(9) {
        return image(draw, is_clear);
    }
    if draw.chance(6) {
        let entries = deeper(draw, |draw| draw.entries(4, |draw| pigment(draw, is_clear)));
        return format!("average pigment_map {{ {entries} }}{}", draw.modifiers(size));
    }
    if draw.chance(4) {
        let colors = [draw.color(is_clear), draw.color(is_clear)];
        return format!(
            "object {{ {} {} {} }}{}",
            region(draw),
            colors[0],
            colors[1],
            draw.transforms(1.0)
        );
    }
    let pattern = deeper(draw, |draw| draw.pattern(Of::Pigment));
    let map = match pattern.list {
        Some(_) if draw.chance(15) => String::new(),
        Some(count) => {
            let pigments = draw.chance(35);
            let items = (0..count).map(|_| match pigments {
                true => format!("pigment {{ {} }}", deeper(draw, |draw| pigment(draw, is_clear))),
                false => draw.color(is_clear),
            });
            items.collect::<Vec<_>>().join(", ")
        }
        None if draw.chance(10) => String::new(),
        None if draw.depth < DEEPEST && draw.chance(30) => {
            let entries = deeper(draw, |draw| draw.entries(3, |draw| pigment(draw, is_clear)));
            format!("pigment_map {{ {entries} }}")
        }
        None => format!("color_map {{ {} }}", draw.entries(5, |draw| draw.color(is_clear))),
    };
    let modifiers = draw.modifiers(size);
    format!("{} {map}{}{modifiers}", pattern.head, pattern.parameters)
}

fn image(draw: &mut Draw, is_clear: bool) -> String {
    let mut inside = draw.picture(false);
    if is_clear && !inside.contains(CLEAR) {
        let word = draw.word(&["filter", "transmit"]);
        let _ = write!(inside, " {word} all {}", draw.number(0.0, 1.0));
    }
    let modifiers = draw.modifiers(0.8);
    format!("image_map {{ {inside} }}{modifiers}")
}

/// A shape for the pattern `object`.
fn region(draw: &mut Draw) -> String {
    let size = draw.number(0.5, 1.0);
    match draw.dice.below(4) {
        0 => format!("sphere {{ {}, {size} }}", draw.vector(-0.6, 0.6)),
        1 => format!("box {{ -{size}, {size} rotate {} }}", draw.vector(-90.0, 90.0)),
        2 => format!("torus {{ {size}, 0.35 rotate {} }}", draw.vector(-90.0, 90.0)),
        _ => format!("cylinder {{ -2*{axis}, 2*{axis}, {size} }}", axis = draw.axis()),
    }
}

/// The items of a normal.
pub fn normal(draw: &mut Draw) -> String {
    let size = size(draw);
    let deep = draw.depth >= DEEPEST;
    if !deep && draw.chance(6) {
        let entries = deeper(draw, |draw| draw.entries(3, normal));
        return format!("average normal_map {{ {entries} }}{}", draw.modifiers(size));
    }
    if draw.chance(5) {
        let inside = draw.picture(false);
        let amount = draw.number(0.2, 2.0);
        return format!("bump_map {{ {inside} bump_size {amount} }}{}", draw.modifiers(0.8));
    }
    let pattern = deeper(draw, |draw| draw.pattern(Of::Normal));
    let is_facets = pattern.head.starts_with("facets");
    let amount = if is_facets {
        String::new()
    } else {
        draw.maybe(80, |d| format!(" {}", d.number(-0.6, 1.0)))
    };
    let map = match pattern.list {
        Some(count) if !deep && draw.chance(60) => {
            let items = (0..count).map(|_| format!("normal {{ {} }}", deeper(draw, normal)));
            return format!(
                "{} {}{}{}",
                pattern.head,
                items.collect::<Vec<_>>().join(", "),
                pattern.parameters,
                draw.modifiers(size)
            );
        }
        Some(_) => String::new(),
        None if is_facets => String::new(),
        None if !deep && draw.chance(15) => {
            let entries = deeper(draw, |draw| draw.entries(3, normal));
            return format!(
                "{} normal_map {{ {entries} }}{}{}",
                pattern.head,
                pattern.parameters,
                draw.modifiers(size)
            );
        }
        None if draw.chance(20) => {
            let slopes =
                draw.entries(4, |d| format!("<{}, {}>", d.number(0.0, 1.0), d.number(-1.0, 1.0)));
            format!(" slope_map {{ {slopes} }}")
        }
        None => String::new(),
    };
    let modifiers = draw.modifiers(size);
    let accuracy = draw.maybe(8, |draw| format!(" accuracy {}", draw.number(0.002, 0.1)));
    let keeps = if draw.chance(6) { " no_bump_scale" } else { "" };
    format!("{}{amount}{map}{}{modifiers}{accuracy}{keeps}", pattern.head, pattern.parameters)
}

/// The items of a finish.
pub fn finish(draw: &mut Draw) -> String {
    let mut text = String::new();
    if draw.chance(50) {
        let _ = match draw.chance(60) {
            true => write!(text, " ambient {}", draw.number(0.0, 0.5)),
            false => write!(text, " ambient rgb {}", draw.vector(0.0, 0.4)),
        };
    }
    if draw.chance(15) {
        let _ = write!(text, " emission rgb {}", draw.vector(0.0, 0.3));
    }
    if draw.chance(50) {
        let albedo = if draw.chance(20) { "albedo " } else { "" };
        let _ = write!(text, " diffuse {albedo}{}", draw.number(0.3, 0.9));
        if draw.chance(20) {
            let _ = write!(text, ", {}", draw.number(0.1, 0.6));
        }
    }
    if draw.chance(25) {
        let _ = write!(text, " brilliance {}", draw.number(0.5, 4.0));
    }
    if draw.chance(30) {
        let albedo = if draw.chance(20) { "albedo " } else { "" };
        let _ = write!(text, " phong {albedo}{}", draw.number(0.1, 1.0));
        let _ =
            write!(text, "{}", draw.maybe(60, |d| format!(" phong_size {}", d.number(3.0, 90.0))));
    }
    if draw.chance(30) {
        let albedo = if draw.chance(20) { "albedo " } else { "" };
        let _ = write!(text, " specular {albedo}{}", draw.number(0.1, 1.0));
        let _ =
            write!(text, "{}", draw.maybe(60, |d| format!(" roughness {}", d.number(0.005, 0.2))));
    }
    if draw.chance(20) {
        text += " metallic";
        let _ = write!(text, "{}", draw.maybe(50, |d| format!(" {}", d.number(0.2, 1.0))));
    }
    if draw.chance(8) {
        let (amount, thickness) = (draw.number(0.1, 0.6), draw.number(0.1, 1.0));
        let turbulence = draw.maybe(50, |d| format!(" turbulence {}", d.number(0.0, 0.8)));
        let _ = write!(text, " irid {{ {amount} thickness {thickness}{turbulence} }}");
    }
    if draw.chance(30) {
        text += &reflection(draw);
    }
    text + if !draw.has_once && draw.chance(10) { " conserve_energy" } else { "" }
}

fn reflection(draw: &mut Draw) -> String {
    if draw.chance(30) {
        return format!(" reflection {}", draw.number(0.05, 0.6));
    }
    let most = draw.solid_color();
    let least = draw.maybe(50, |draw| format!("{}, ", draw.solid_color()));
    let mut text = format!(" reflection {{ {least}{most}");
    if draw.chance(20) {
        text += " fresnel";
    } else if draw.chance(30) {
        let _ = write!(text, " falloff {}", draw.number(0.5, 4.0));
    }
    if draw.chance(25) {
        let _ = write!(text, " exponent {}", draw.number(0.5, 1.5));
    }
    if draw.chance(25) {
        let _ = write!(text, " metallic {}", draw.number(0.2, 1.0));
    }
    text + " }"
}

/// A `pigment`, a `normal` and a `finish`.
pub fn parts(draw: &mut Draw, is_clear: bool) -> String {
    let mut text = format!("pigment {{ {} }}", pigment(draw, is_clear));
    if draw.chance(35) {
        let _ = write!(text, " normal {{ {} }}", normal(draw));
    }
    if draw.chance(60) {
        let _ = write!(text, " finish {{{} }}", finish(draw));
    }
    text
}

/// The items of a texture without layers.
pub fn texture(draw: &mut Draw, is_clear: bool) -> String {
    if draw.depth >= DEEPEST || draw.chance(60) {
        return parts(draw, is_clear);
    }
    let outer = std::mem::replace(&mut draw.in_blend, true);
    let blend = blend(draw, is_clear);
    draw.in_blend = outer;
    blend
}

/// The items of a texture that is made of others.
fn blend(draw: &mut Draw, is_clear: bool) -> String {
    let size = size(draw);
    if draw.chance(15) {
        let picture = draw.whole_picture();
        let textures = deeper(draw, |draw| {
            let count = draw.whole(2, 4);
            (0..count)
                .map(|_| format!(" texture {{ {} }}", parts(draw, is_clear)))
                .collect::<String>()
        });
        return format!("material_map {{ {picture}{textures} }}{}", draw.transforms(0.8));
    }
    if draw.chance(12) {
        let entries = deeper(draw, |draw| draw.entries(3, |draw| texture(draw, is_clear)));
        return format!("average texture_map {{ {entries} }}{}", draw.modifiers(size));
    }
    let pattern = deeper(draw, |draw| draw.pattern(Of::Texture));
    let map = match pattern.list {
        Some(count) => {
            let items = (0..count)
                .map(|_| format!("texture {{ {} }}", deeper(draw, |draw| texture(draw, is_clear))));
            items.collect::<Vec<_>>().join(", ")
        }
        None => {
            let entries = deeper(draw, |draw| draw.entries(3, |draw| texture(draw, is_clear)));
            format!("texture_map {{ {entries} }}")
        }
    };
    format!("{} {map}{}{}", pattern.head, pattern.parameters, draw.modifiers(size))
}

/// One or more `texture` blocks, as an object has them.
pub fn textures(draw: &mut Draw) -> String {
    let is_clear = draw.chance(10);
    if draw.chance(25) {
        let mut text = format!("texture {{ {}{} }}", parts(draw, is_clear), draw.transforms(1.0));
        for _ in 0..draw.whole(1, 2) {
            let top = parts(draw, true);
            let _ =
                write!(text, " texture {{ {top}{} }}", draw.maybe(40, |draw| draw.transforms(1.0)));
        }
        return text;
    }
    match draw.chance(20) {
        true => parts(draw, is_clear),
        false => {
            let items = texture(draw, is_clear);
            format!("texture {{ {items}{} }}", draw.maybe(40, |draw| draw.transforms(1.0)))
        }
    }
}
