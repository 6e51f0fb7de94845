//! Prints textures, pigments, normals and finishes of a World.

use std::collections::HashMap;
use std::fmt::{self, Write};
use std::sync::Arc;

use super::affine;
use crate::texture::normal::Bumps;
use crate::texture::space::Start;
use crate::texture::walk::Node;
use crate::texture::{Normal, Pattern, Source, Space, Step};
use crate::world::{Extras, Finish, Irid, LobeKind, Pigment, Texture};

/// Prints a texture; its entries and layers are indented.
pub(super) fn texture(out: &mut String, texture: &Texture, indent: &str) -> fmt::Result {
    let mut branches = Branches::default();
    branches.count(texture);
    for plain in texture.plains() {
        branches.count(&plain.pigment);
        plain.normal.iter().for_each(|normal| branches.count(&**normal));
    }
    part(out, texture, indent, &mut branches)
}

/// Prints a pigment; its entries are indented.
pub(super) fn pigment(out: &mut String, pigment: &Pigment, indent: &str) -> fmt::Result {
    let mut branches = Branches::default();
    branches.count(pigment);
    paint(out, pigment, indent, &mut branches)
}

/// The branches that several entries share: each is printed once, and named where it occurs again.
#[derive(Debug, Default)]
struct Branches {
    /// How often each branch occurs.
    times: HashMap<*const (), u32>,
    /// The numbers of those printed so far.
    names: HashMap<*const (), usize>,
}

impl Branches {
    /// Counts the occurrences of all branches below a node.
    fn count<N: Node>(&mut self, node: &N) {
        for child in node.children() {
            let times = self.times.entry(std::ptr::from_ref(child).cast()).or_default();
            *times += 1;
            if *times == 1 {
                self.count(child);
            }
        }
    }

    /// Prints the line above a branch; returns whether the branch follows.
    fn head<N: Node>(
        &mut self,
        out: &mut String,
        line: &str,
        node: &N,
    ) -> Result<bool, fmt::Error> {
        let key = std::ptr::from_ref(node).cast();
        let is_shared = self.times.get(&key).is_some_and(|&times| times > 1);
        if !is_shared || node.children().is_empty() {
            writeln!(out, "{line}")?;
            return Ok(true);
        }
        if let Some(name) = self.names.get(&key) {
            writeln!(out, "{line} branch {name} again")?;
            return Ok(false);
        }
        let name = self.names.len() + 1;
        self.names.insert(key, name);
        writeln!(out, "{line} branch {name}")?;
        Ok(true)
    }
}

fn part(out: &mut String, texture: &Texture, indent: &str, branches: &mut Branches) -> fmt::Result {
    let inner = format!("{indent}  ");
    match texture {
        Texture::Plain(plain) => {
            paint(out, &plain.pigment, indent, branches)?;
            if let Some(normal) = &plain.normal {
                self::normal(out, normal, indent, branches)?;
            }
            finish(out, &plain.finish, indent)
        }
        Texture::Blend(blend) => {
            writeln!(out, "{indent}texture {}", pattern(&blend.pattern, &blend.space))?;
            for (value, entry) in &blend.entries {
                if branches.head(out, &format!("{inner}{value}"), &**entry)? {
                    part(out, entry, &format!("{inner}  "), branches)?;
                }
            }
            Ok(())
        }
        Texture::Average { space, entries } => {
            writeln!(out, "{indent}texture average{}", moved(space))?;
            for (weight, entry) in entries {
                if branches.head(out, &format!("{inner}{weight}"), &**entry)? {
                    part(out, entry, &format!("{inner}  "), branches)?;
                }
            }
            Ok(())
        }
        Texture::Faces(textures) => {
            for texture in textures {
                if branches.head(out, &format!("{indent}of faces"), &**texture)? {
                    part(out, texture, &inner, branches)?;
                }
            }
            Ok(())
        }
        Texture::Layers(layers) => {
            for layer in layers {
                if branches.head(out, &format!("{indent}layer"), &**layer)? {
                    part(out, layer, &inner, branches)?;
                }
            }
            Ok(())
        }
    }
}

fn paint(
    out: &mut String,
    pigment: &Pigment,
    indent: &str,
    branches: &mut Branches,
) -> fmt::Result {
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
                if branches.head(out, &format!("{inner}{value}"), &**entry)? {
                    paint(out, entry, &format!("{inner}  "), branches)?;
                }
            }
            Ok(())
        }
        Pigment::Image { space, .. } => writeln!(out, "{indent}image_map{}", moved(space)),
        Pigment::Average { space, entries } => {
            writeln!(out, "{indent}average{}", moved(space))?;
            for (weight, entry) in entries {
                if branches.head(out, &format!("{inner}{weight}"), &**entry)? {
                    paint(out, entry, &format!("{inner}  "), branches)?;
                }
            }
            Ok(())
        }
    }
}

fn normal(out: &mut String, normal: &Normal, indent: &str, branches: &mut Branches) -> fmt::Result {
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
            entries(out, &blend.entries, &inner, branches)
        }
        Normal::Average { space, entries, keeps_depth } => {
            writeln!(out, "{indent}normal average{}{}", moved(space), scale(keeps_depth))?;
            self::entries(out, entries, &inner, branches)
        }
    }
}

fn entries(
    out: &mut String,
    entries: &[(f64, Arc<Normal>)],
    indent: &str,
    branches: &mut Branches,
) -> fmt::Result {
    for (value, entry) in entries {
        if branches.head(out, &format!("{indent}{value}"), &**entry)? {
            normal(out, entry, &format!("{indent}  "), branches)?;
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Color;

    #[test]
    fn a_shared_branch_is_printed_once() {
        let double = |below: Pigment| {
            let below = Arc::new(below);
            let entries = vec![(0.5, below.clone()), (0.5, below)];
            Pigment::Average { space: Space::default(), entries }
        };
        let whole = (0..60).fold(Pigment::Color(Color::WHITE), |below, _| double(below));
        let mut out = String::new();
        assert!(pigment(&mut out, &whole, "").is_ok());
        assert!(out.lines().count() < 250);
        assert!(out.starts_with("average\n  0.5 branch 1\n    average\n"));
        assert!(out.ends_with("\n  0.5 branch 1 again\n"));
    }
}
