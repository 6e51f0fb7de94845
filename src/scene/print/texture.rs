//! Prints textures, pigments and normals of a Scene.

use std::fmt::{self, Write};

use super::{MOST_STEPS, Printer};
use crate::math::vector::written as vector;
use crate::scene::{
    Colors, NormalId, NormalKind, Pattern, PigmentId, PigmentKind, Source, Step, TextureId,
    TextureKind,
};

impl Printer<'_> {
    pub(super) fn texture(&self, out: &mut String, id: TextureId, indent: &str) -> fmt::Result {
        nested(out, id, indent, |out, id, indent| {
            let texture = &self.scene.textures[id.index()];
            let mut entries = Vec::new();
            match &texture.kind {
                TextureKind::Plain { pigment, normal, finish } => {
                    self.pigment(out, *pigment, indent)?;
                    if let Some(normal) = normal {
                        self.normal(out, *normal, indent)?;
                    }
                    self.finish(out, &self.scene.finishes[finish.index()], indent)?;
                }
                TextureKind::Blend { pattern, steps, entries: all } => {
                    writeln!(out, "{indent}texture {}", described(pattern))?;
                    self.steps(out, steps, &format!("{indent}  "))?;
                    entries = titled(all);
                }
                TextureKind::Layers(layers) => {
                    entries = layers.iter().map(|id| ("layer".to_owned(), *id)).collect();
                }
            }
            for &id in &texture.transforms {
                self.transform(out, id, indent)?;
            }
            Ok(entries)
        })
    }

    pub(super) fn pigment(&self, out: &mut String, id: PigmentId, indent: &str) -> fmt::Result {
        nested(out, id, indent, |out, id, indent| {
            let pigment = &self.scene.pigments[id.index()];
            let mut entries = Vec::new();
            match &pigment.kind {
                PigmentKind::Color(c) => writeln!(out, "{indent}pigment color {c}")?,
                PigmentKind::Faces(colors) => {
                    writeln!(out, "{indent}pigment of {} colors by faces", colors.len())?;
                }
                PigmentKind::Patterned { pattern, colors } => {
                    writeln!(out, "{indent}pigment {}", described(pattern))?;
                    match colors {
                        Colors::Map(map) => {
                            for (value, c) in &map.0 {
                                writeln!(out, "{indent}  {value} {c}")?;
                            }
                        }
                        Colors::Image => {}
                        Colors::Pigments(all) => entries = titled(all),
                    }
                }
            }
            self.steps(out, &pigment.steps, &format!("{indent}  "))?;
            Ok(entries)
        })
    }

    pub(super) fn normal(&self, out: &mut String, id: NormalId, indent: &str) -> fmt::Result {
        nested(out, id, indent, |out, id, indent| {
            let normal = &self.scene.normals[id.index()];
            let inner = format!("{indent}  ");
            let scale = if normal.keeps_depth { " no_bump_scale" } else { "" };
            let mut entries = Vec::new();
            match &normal.kind {
                NormalKind::Bumps { pattern, amount, accuracy, slopes } => {
                    let pattern = described(pattern);
                    write!(out, "{indent}normal {pattern} amount {amount} accuracy {accuracy}")?;
                    writeln!(out, "{scale}")?;
                    for [value, height, slope] in slopes {
                        writeln!(out, "{inner}{value} height {height} slope {slope}")?;
                    }
                }
                NormalKind::Image { pattern, amount } => {
                    writeln!(out, "{indent}normal {} amount {amount}{scale}", described(pattern))?;
                }
                NormalKind::Map { pattern, entries: all } => {
                    writeln!(out, "{indent}normal {}{scale}", described(pattern))?;
                    entries = titled(all);
                }
            }
            self.steps(out, &normal.steps, &inner)?;
            Ok(entries)
        })
    }

    fn steps(&self, out: &mut String, steps: &[Step], indent: &str) -> fmt::Result {
        for step in steps {
            match step {
                Step::Transform(id) => self.transform(out, *id, indent)?,
                Step::Warp(warp) => writeln!(out, "{indent}warp {warp}")?,
            }
        }
        Ok(())
    }
}

/// Prints a texture, pigment or normal, and then what it contains, each below its title and further right. `one`
/// prints a single one and returns what is in it. At most [`MOST_STEPS`] are printed: maps may contain one
/// twice, and so on.
fn nested<Id>(
    out: &mut String,
    first: Id,
    indent: &str,
    mut one: impl FnMut(&mut String, Id, &str) -> Result<Vec<(String, Id)>, fmt::Error>,
) -> fmt::Result {
    let mut left = MOST_STEPS;
    let mut stack = vec![(None, first, indent.to_owned())];
    while let Some((title, id, indent)) = stack.pop() {
        if left == 0 {
            return writeln!(out, "{indent}…");
        }
        left -= 1;
        if let Some(title) = title {
            writeln!(out, "{indent}{title}")?;
        }
        let entries = one(out, id, &indent)?.into_iter().rev();
        stack.extend(entries.map(|(title, id)| (Some(title), id, format!("{indent}  "))));
    }
    Ok(())
}

/// Returns the entries of a map, titled by their values.
fn titled<Id: Copy>(entries: &[(f64, Id)]) -> Vec<(String, Id)> {
    entries.iter().map(|(value, id)| (value.to_string(), *id)).collect()
}

/// Returns a pattern with its parameters and modifiers.
fn described(pattern: &Pattern) -> String {
    let mut text = match &pattern.source {
        Source::Kind(kind) => kind.to_string(),
        source => source.word().to_owned(),
    };
    let modifiers = &pattern.modifiers;
    if let Some(amount) = modifiers.turbulence {
        text.push_str(&format!(" turbulence {}", vector(amount)));
    }
    if let Some(wave) = modifiers.wave {
        text.push_str(&format!(" {wave}"));
    }
    for (word, number) in [("frequency", modifiers.frequency), ("phase", modifiers.phase)] {
        if let Some(number) = number {
            text.push_str(&format!(" {word} {number}"));
        }
    }
    if modifiers.uv_mapping {
        text.push_str(" uv_mapping");
    }
    text
}
