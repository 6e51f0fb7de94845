//! Prints textures, pigments, normals and finishes of a World.

use std::fmt::{self, Write};
use std::sync::Arc;

use super::affine;
use crate::texture::normal::Bumps;
use crate::texture::space::Start;
use crate::texture::{Normal, Pattern, Source, Space, Step};
use crate::world::{Extras, Finish, Irid, LobeKind, Pigment, Texture};

/// Prints a texture; its entries and layers are indented.
pub(super) fn texture(out: &mut String, texture: &Texture, indent: &str) -> fmt::Result {
    let inner = format!("{indent}  ");
    match texture {
        Texture::Plain(plain) => {
            pigment(out, &plain.pigment, indent)?;
            if let Some(normal) = &plain.normal {
                self::normal(out, normal, indent)?;
            }
            finish(out, &plain.finish, indent)
        }
        Texture::Blend(blend) => {
            writeln!(out, "{indent}texture {}", pattern(&blend.pattern, &blend.space))?;
            for (value, entry) in &blend.entries {
                writeln!(out, "{inner}{value}")?;
                self::texture(out, entry, &format!("{inner}  "))?;
            }
            Ok(())
        }
        Texture::Average { space, entries } => {
            writeln!(out, "{indent}texture average{}", moved(space))?;
            for (weight, entry) in entries {
                writeln!(out, "{inner}{weight}")?;
                self::texture(out, entry, &format!("{inner}  "))?;
            }
            Ok(())
        }
        Texture::Faces(textures) => {
            for texture in textures {
                writeln!(out, "{indent}of faces")?;
                self::texture(out, texture, &inner)?;
            }
            Ok(())
        }
        Texture::Layers(layers) => {
            for layer in layers {
                writeln!(out, "{indent}layer")?;
                self::texture(out, layer, &inner)?;
            }
            Ok(())
        }
    }
}

pub(super) fn pigment(out: &mut String, pigment: &Pigment, indent: &str) -> fmt::Result {
    let inner = format!("{indent}  ");
    match pigment {
        Pigment::Color(c) => writeln!(out, "{indent}color {}", c),
        Pigment::Faces(colors) => writeln!(out, "{indent}{} colors by faces", colors.len()),
        Pigment::Ramp(blend) => {
            writeln!(out, "{indent}{}", pattern(&blend.pattern, &blend.space))?;
            for (value, c) in &blend.entries {
                writeln!(out, "{indent}  {value} {}", c)?;
            }
            Ok(())
        }
        Pigment::Blend(blend) => {
            writeln!(out, "{indent}{}", pattern(&blend.pattern, &blend.space))?;
            for (value, entry) in &blend.entries {
                writeln!(out, "{inner}{value}")?;
                self::pigment(out, entry, &format!("{inner}  "))?;
            }
            Ok(())
        }
        Pigment::Image { space, .. } => writeln!(out, "{indent}image_map{}", moved(space)),
        Pigment::Average { space, entries } => {
            writeln!(out, "{indent}average{}", moved(space))?;
            for (weight, entry) in entries {
                writeln!(out, "{inner}{weight}")?;
                self::pigment(out, entry, &format!("{inner}  "))?;
            }
            Ok(())
        }
    }
}

fn normal(out: &mut String, normal: &Normal, indent: &str) -> fmt::Result {
    let inner = format!("{indent}  ");
    let scale = |keeps_depth: &bool| if *keeps_depth { " no_bump_scale" } else { "" };
    match normal {
        Normal::Bumps(bumps) => {
            let Bumps { space, pattern, amount, accuracy, slopes, keeps_depth } = bumps;
            let pattern = self::pattern(pattern, space);
            write!(out, "{indent}normal {pattern} amount {amount} accuracy {accuracy}")?;
            writeln!(out, "{}", scale(keeps_depth))?;
            for one in slopes {
                writeln!(out, "{inner}{} height {} slope {}", one.value, one.height, one.slope)?;
            }
            Ok(())
        }
        Normal::Image { space, amount, keeps_depth, .. } => {
            let scale = scale(keeps_depth);
            writeln!(out, "{indent}normal bump_map{} amount {amount}{scale}", moved(space))
        }
        Normal::Blend { blend, keeps_depth } => {
            let pattern = self::pattern(&blend.pattern, &blend.space);
            writeln!(out, "{indent}normal {pattern}{}", scale(keeps_depth))?;
            entries(out, &blend.entries, &inner)
        }
        Normal::Average { space, entries, keeps_depth } => {
            writeln!(out, "{indent}normal average{}{}", moved(space), scale(keeps_depth))?;
            self::entries(out, entries, &inner)
        }
    }
}

fn entries(out: &mut String, entries: &[(f64, Arc<Normal>)], indent: &str) -> fmt::Result {
    for (value, entry) in entries {
        writeln!(out, "{indent}{value}")?;
        normal(out, entry, &format!("{indent}  "))?;
    }
    Ok(())
}

/// Returns a pattern with its parameters, modifiers and space.
fn pattern(pattern: &Pattern, space: &Space) -> String {
    let mut text = match &pattern.source {
        Source::Kind(kind) => kind.to_string(),
        Source::Function(_) => "function".to_owned(),
        Source::Pigment(_) => "pigment_pattern".to_owned(),
        Source::Image(_) => "image_pattern".to_owned(),
        Source::Material { .. } => "material_map".to_owned(),
        Source::Density(_) => "density_file".to_owned(),
        Source::Object(_) => "object".to_owned(),
        Source::Slope(_) => "slope".to_owned(),
        Source::Aoi => "aoi".to_owned(),
    };
    if pattern.wave != pattern.source.wave() {
        text.push_str(&format!(" {}", pattern.wave));
    }
    text + &moved(space)
}

fn moved(space: &Space) -> String {
    let mut text = match space.start {
        Start::Uv | Start::UvTurned(_) => " uv_mapping".to_owned(),
        Start::Outer | Start::Slot(0) => String::new(),
        Start::Slot(slot) => format!(" slot {slot}"),
    };
    for step in &space.steps {
        text.push_str(&match step {
            Step::Map(map) => format!(" at {}", affine(map)),
            Step::Warp(warp) => format!(" warp {warp}"),
        });
    }
    text
}

fn finish(out: &mut String, finish: &Finish, indent: &str) -> fmt::Result {
    let mut parts = Vec::new();
    if finish.seed {
        parts.push("seed".to_owned());
    }
    if !finish.emission.is_black() {
        parts.push(format!("emission {}", finish.emission));
    }
    if finish.diffuse != 0.0 {
        parts.push(format!("diffuse {}", finish.diffuse));
    }
    if finish.brilliance != 1.0 {
        parts.push(format!("brilliance {}", finish.brilliance));
    }
    for lobe in &finish.lobes {
        let kind = match lobe.kind {
            LobeKind::Phong => "phong",
            LobeKind::Blinn => "blinn",
        };
        parts.push(format!(
            "{kind} weight {} exponent {} metallic {}",
            lobe.weight, lobe.exponent, lobe.metallic
        ));
    }
    if let Some(r) = &finish.reflection {
        parts.push(format!(
            "reflection {} to {}{} exponent {} metallic {}",
            r.minimum,
            r.maximum,
            if r.fresnel { " fresnel".to_owned() } else { format!(" falloff {}", r.falloff) },
            r.exponent,
            r.metallic
        ));
    }
    if finish.conserve_energy {
        parts.push("conserve_energy".to_owned());
    }
    if let Some(extras) = &finish.extras {
        parts.extend(rare(extras));
    }
    match parts.is_empty() {
        true => writeln!(out, "{indent}black"),
        false => writeln!(out, "{indent}{}", parts.join(", ")),
    }
}

/// Returns the rare properties that are not neutral.
fn rare(extras: &Extras) -> Vec<String> {
    let &Extras { behind, grain, irid, passed } = extras;
    let mut parts = Vec::new();
    if behind != 0.0 {
        parts.push(format!("diffuse behind {behind}"));
    }
    if grain != 0.0 {
        parts.push(format!("crand {grain}"));
    }
    if let Some(Irid { amount, thickness, turbulence, wavelengths, .. }) = irid {
        parts.push(format!(
            "irid {amount} thickness {thickness} turbulence {turbulence} wavelengths {wavelengths}"
        ));
    }
    if passed != 1.0 {
        parts.push(format!("refraction {passed}"));
    }
    parts
}
