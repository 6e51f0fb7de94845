//! Lowers normals: trees of patterns whose values are bumps.

use std::sync::Arc;

use super::Fault;
use super::pigment::{Nodes, entry, too_deep};
use crate::scene::{self, NormalId, NormalKind, TransformId};
use crate::texture::normal::{Bumps, slope_map};
use crate::texture::space::Start;
use crate::texture::{Blend, DEEPEST, Normal};
use crate::vocabulary::Word;
use crate::world::SurfacePart;

impl Nodes<'_, '_> {
    /// Returns a normal whose points come from `start`, as [`Nodes::pigment`] does; `None` if it is flat.
    pub fn normal(
        &mut self,
        id: NormalId,
        start: Start,
        outer: &[TransformId],
        depth: usize,
    ) -> Result<Option<Normal>, Fault> {
        if depth > DEEPEST {
            return Err(too_deep());
        }
        let written = &self.scene.normals[id.index()];
        let keeps_depth = written.keeps_depth;
        match &written.kind {
            NormalKind::Bumps { pattern, amount, accuracy, slopes } => {
                let is_flat = match &pattern.source {
                    scene::Source::Average => true,
                    scene::Source::Kind(kind) => *amount == 0.0 && kind.scales_by_amount(),
                    _ => *amount == 0.0,
                };
                if is_flat {
                    return Ok(None);
                }
                let space = self.space(start, &written.steps, outer, Some(pattern))?;
                let slopes: Vec<_> = slopes
                    .iter()
                    .map(|&[value, height, slope]| slope_map::Entry { value, height, slope })
                    .collect();
                let numbers = slopes.iter().flat_map(|one| [one.value, one.height, one.slope]);
                if !numbers.chain([*amount, *accuracy]).all(f64::is_finite) {
                    return Err(Fault::not_finite("this normal"));
                }
                self.note(pattern, pattern.source.word());
                let pattern = self.pattern(pattern, 1, depth)?;
                let (amount, accuracy) = (*amount, *accuracy);
                let bumps = Bumps { space, pattern, amount, accuracy, slopes, keeps_depth };
                Ok(Some(Normal::Bumps(bumps)))
            }
            NormalKind::Image { pattern, amount } => {
                let scene::Source::Image(image) = &pattern.source else { return Ok(None) };
                let space = self.space(start, &written.steps, outer, Some(pattern))?;
                self.note(pattern, Word::BumpMap.name());
                let (image, amount) = (image.clone(), *amount);
                Ok(Some(Normal::Image { space, image, amount, keeps_depth }))
            }
            NormalKind::Map { pattern, entries } => {
                self.note(pattern, pattern.source.word());
                let space = self.space(start, &written.steps, outer, Some(pattern))?;
                let entries = entries
                    .iter()
                    .map(|&(value, id)| entry(value, self.inner_normal(id, depth + 1)?));
                let entries = entries.collect::<Result<Vec<_>, Fault>>()?;
                if pattern.source == scene::Source::Average {
                    return Ok(Some(Normal::Average { space, entries, keeps_depth }));
                }
                let pattern = self.pattern(pattern, entries.len(), depth)?;
                let blend = Blend { space, pattern, entries };
                Ok(Some(Normal::Blend { blend, keeps_depth }))
            }
        }
    }

    fn note(&mut self, pattern: &scene::Pattern, word: &'static str) {
        self.branches.note(SurfacePart::Normal, word, Some(pattern.site));
    }

    fn inner_normal(&mut self, id: NormalId, depth: usize) -> Result<Arc<Normal>, Fault> {
        if let Some(known) = self.branches.normals.get(id, depth) {
            return Ok(known);
        }
        let normal = self.normal(id, Start::Outer, &[], depth)?;
        // A flat one: the mean of nothing.
        let flat = || Normal::Average {
            space: Default::default(),
            entries: Vec::new(),
            keeps_depth: false,
        };
        Ok(self.branches.normals.add(id, depth, normal.unwrap_or_else(flat)))
    }
}
