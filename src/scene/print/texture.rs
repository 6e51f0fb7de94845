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
        // Layers and maps may contain a texture twice, and so on.
        let mut left = MOST_STEPS;
        let mut stack = vec![(None, id, indent.to_owned())];
        while let Some((value, id, indent)) = stack.pop() {
            if left == 0 {
                return writeln!(out, "{indent}…");
            }
            left -= 1;
            if let Some(value) = value {
                writeln!(out, "{indent}{value}")?;
            }
            let texture = &self.scene.textures[id.index()];
            let inner = format!("{indent}  ");
            match &texture.kind {
                TextureKind::Plain { pigment, normal, finish } => {
                    self.pigment(out, *pigment, &indent)?;
                    if let Some(normal) = normal {
                        self.normal(out, *normal, &indent)?;
                    }
                    self.finish(out, &self.scene.finishes[finish.index()], &indent)?;
                }
                TextureKind::Blend { pattern, steps, entries } => {
                    writeln!(out, "{indent}texture {}", described(pattern))?;
                    self.steps(out, steps, &inner)?;
                    let entries = entries.iter().rev();
                    stack
                        .extend(entries.map(|(at, id)| (Some(at.to_string()), *id, inner.clone())));
                }
                TextureKind::Layers(layers) => {
                    let layers = layers.iter().rev();
                    let layer = || Some("layer".to_owned());
                    stack.extend(layers.map(|id| (layer(), *id, inner.clone())));
                }
            }
            for &id in &texture.transforms {
                self.transform(out, id, &indent)?;
            }
        }
        Ok(())
    }

    pub(super) fn pigment(&self, out: &mut String, id: PigmentId, indent: &str) -> fmt::Result {
        let mut left = MOST_STEPS;
        let mut stack = vec![(None, id, indent.to_owned())];
        while let Some((value, id, indent)) = stack.pop() {
            if left == 0 {
                return writeln!(out, "{indent}…");
            }
            left -= 1;
            if let Some(value) = value {
                writeln!(out, "{indent}{value}")?;
            }
            let pigment = &self.scene.pigments[id.index()];
            let inner = format!("{indent}  ");
            match &pigment.kind {
                PigmentKind::Color(c) => writeln!(out, "{indent}pigment color {}", c)?,
                PigmentKind::Faces(colors) => {
                    writeln!(out, "{indent}pigment of {} colors by faces", colors.len())?;
                }
                PigmentKind::Patterned { pattern, colors } => {
                    writeln!(out, "{indent}pigment {}", described(pattern))?;
                    match colors {
                        Colors::Map(map) => {
                            for (value, c) in &map.0 {
                                writeln!(out, "{indent}  {value} {}", c)?;
                            }
                        }
                        Colors::Image => {}
                        Colors::Pigments(all) => {
                            let all = all.iter().rev();
                            let entry = |(at, id): &(f64, PigmentId)| {
                                (Some(at.to_string()), *id, inner.clone())
                            };
                            stack.extend(all.map(entry));
                        }
                    }
                }
            }
            self.steps(out, &pigment.steps, &inner)?;
        }
        Ok(())
    }

    pub(super) fn normal(&self, out: &mut String, id: NormalId, indent: &str) -> fmt::Result {
        let mut left = MOST_STEPS;
        let mut stack = vec![(None, id, indent.to_owned())];
        while let Some((value, id, indent)) = stack.pop() {
            if left == 0 {
                return writeln!(out, "{indent}…");
            }
            left -= 1;
            if let Some(value) = value {
                writeln!(out, "{indent}{value}")?;
            }
            let normal = &self.scene.normals[id.index()];
            let inner = format!("{indent}  ");
            let scale = if normal.keeps_depth { " no_bump_scale" } else { "" };
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
                NormalKind::Map { pattern, entries } => {
                    writeln!(out, "{indent}normal {}{scale}", described(pattern))?;
                    let entries = entries.iter().rev();
                    stack
                        .extend(entries.map(|(at, id)| (Some(at.to_string()), *id, inner.clone())));
                }
            }
            self.steps(out, &normal.steps, &inner)?;
        }
        Ok(())
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
