//! Lowers pigments: trees of patterns and colours in canonical form.
//!
//! **Invariant:** a pigment of a single colour has no pattern; equal branches of one written pigment are
//! shared; every number is finite.

use std::hash::Hash;
use std::sync::Arc;

use rustc_hash::{FxHashMap, FxHashSet};

use super::Fault;
use super::transform::{Affine, Transforms};
use crate::color::Color;
use crate::diagnostic::Code;
use crate::math::Vector;
use crate::math::double::Double;
use crate::math::placement::Map;
use crate::pattern::{Setting, Warp, Wave, warp};
use crate::scene::texture::Layers;
use crate::scene::{
    self, ColorMap, Colors, NormalId, PigmentId, PigmentKind, Scene, TextureId, TransformId,
};
use crate::source::{Site, Span};
use crate::texture::space::Start;
use crate::texture::{self, Blend, DEEPEST, Normal, Pattern, Pigment, Space, Step, Texture};
use crate::vocabulary::Word;
use crate::world::{SurfaceOrigin, SurfacePart};

/// The nodes inside of others that are lowered so far.
#[derive(Default)]
pub struct Branches {
    pigments: Known<PigmentId, Pigment>,
    pub(super) normals: Known<NormalId, Normal>,
    pub(super) textures: Known<TextureId, Texture>,
    /// What all textures consist of, each place once.
    pub(super) parts: Vec<SurfaceOrigin>,
    noted: FxHashSet<(SurfacePart, &'static str, Option<Span>)>,
}

/// Nodes by what is written, each with the greatest depth at which it was lowered: further down, what it contains
/// may be too deep.
pub(super) struct Known<Id, T>(FxHashMap<Id, (Arc<T>, usize)>);

impl<Id: Eq + Hash, T> Known<Id, T> {
    pub(super) fn get(&self, id: Id, depth: usize) -> Option<Arc<T>> {
        let (node, at) = self.0.get(&id)?;
        (depth <= *at).then(|| node.clone())
    }

    /// Adds a node, and returns it as a branch.
    pub(super) fn add(&mut self, id: Id, depth: usize, node: T) -> Arc<T> {
        let node = Arc::new(node);
        self.0.insert(id, (node.clone(), depth));
        node
    }
}

impl<Id, T> Default for Known<Id, T> {
    fn default() -> Self {
        Self(FxHashMap::default())
    }
}

impl Branches {
    pub(super) fn note(&mut self, part: SurfacePart, word: &'static str, site: Option<Site>) {
        if self.noted.insert((part, word, site.map(|site| site.span))) {
            self.parts.push(SurfaceOrigin { part, word, site });
        }
    }
}

/// What lowering a node needs.
pub(super) struct Nodes<'a, 's> {
    pub scene: &'s Scene,
    pub transforms: &'a mut Transforms<'s>,
    pub branches: &'a mut Branches,
}

impl Nodes<'_, '_> {
    /// Returns a pigment whose points come from `start`. `outer` are the transforms around its own.
    ///
    /// From a slot, the transforms after the last warp are left out: they are part of the slot's place.
    pub fn pigment(
        &mut self,
        id: PigmentId,
        start: Start,
        outer: &[TransformId],
        depth: usize,
    ) -> Result<Pigment, Fault> {
        if depth > DEEPEST {
            return Err(too_deep());
        }
        let written = &self.scene.pigments[id.index()];
        let pigment = match &written.kind {
            PigmentKind::Color(color) => Pigment::Color(finite(*color)?),
            PigmentKind::Faces(colors) => faces(colors)?,
            PigmentKind::Patterned { pattern, colors } => {
                if let Some(color) = colors.lone_color() {
                    return Ok(Pigment::Color(finite(color)?));
                }
                let word = match colors {
                    Colors::Image => Word::ImageMap.name(),
                    _ => pattern.source.word(),
                };
                self.branches.note(SurfacePart::Pigment, word, Some(pattern.site));
                let space = self.space(start, &written.steps, outer, Some(pattern))?;
                self.patterned(pattern, colors, space, depth)?
            }
        };
        Ok(pigment)
    }

    fn patterned(
        &mut self,
        pattern: &scene::Pattern,
        colors: &Colors,
        space: Space,
        depth: usize,
    ) -> Result<Pigment, Fault> {
        match colors {
            Colors::Map(ColorMap(map)) => {
                let entries = map.iter().map(|&(value, color)| entry(value, finite(color)?));
                let entries = entries.collect::<Result<_, Fault>>()?;
                let pattern = self.pattern(pattern, map.len(), depth)?;
                Ok(Pigment::Ramp(Box::new(Blend { space, pattern, entries })))
            }
            Colors::Image => match &pattern.source {
                scene::Source::Image(image) => Ok(Pigment::Image { space, image: image.clone() }),
                _ => Ok(Pigment::Color(Color::BLACK)),
            },
            Colors::Pigments(pigments) => {
                let entries = pigments
                    .iter()
                    .map(|&(value, id)| entry(value, self.inner_pigment(id, depth + 1)?));
                let mut entries = entries.collect::<Result<Vec<_>, Fault>>()?;
                if pattern.source != scene::Source::Average {
                    let pattern = self.pattern(pattern, entries.len(), depth)?;
                    return Ok(Pigment::Blend(Box::new(Blend { space, pattern, entries })));
                }
                mean(&mut entries)?;
                Ok(Pigment::Average { space, entries })
            }
        }
    }

    fn inner_pigment(&mut self, id: PigmentId, depth: usize) -> Result<Arc<Pigment>, Fault> {
        if let Some(known) = self.branches.pigments.get(id, depth) {
            return Ok(known);
        }
        let pigment = self.pigment(id, Start::Outer, &[], depth)?;
        Ok(self.branches.pigments.add(id, depth, pigment))
    }

    /// Returns a pattern of `count` entries with its parameters in canonical form.
    pub fn pattern(
        &mut self,
        written: &scene::Pattern,
        count: usize,
        depth: usize,
    ) -> Result<Pattern, Fault> {
        let modifiers = &written.modifiers;
        let source = match &written.source {
            scene::Source::Kind(kind) => texture::Source::Kind(kind.canonical()),
            scene::Source::Function(function) => texture::Source::Function(function.clone()),
            scene::Source::Pigment(id) => {
                texture::Source::Pigment(self.inner_pigment(*id, depth + 1)?)
            }
            scene::Source::Image(image) => texture::Source::Image(image.clone()),
            scene::Source::Material(image) => {
                texture::Source::Material { image: image.clone(), count }
            }
            scene::Source::Density(grid) => texture::Source::Density(grid.clone()),
            scene::Source::Object(region) => texture::Source::Object(region.clone()),
            scene::Source::Slope(slope) => texture::Source::Slope(*slope),
            scene::Source::Aoi => texture::Source::Aoi,
            scene::Source::Average => {
                let message = "`average` has no values of its own";
                return Err(Fault::new(Code::WrongType, message).label("expected what it is of"));
            }
        };
        let usual = source.wave();
        let frequency = modifiers.frequency.unwrap_or(usual.frequency());
        let phase = modifiers.phase.unwrap_or(0.0);
        let wave = Wave::new(modifiers.wave.unwrap_or(usual.kind()), frequency, phase);
        let amount = modifiers.turbulence.unwrap_or_default();
        let setting = Setting {
            amount,
            frequency: modifiers.frequency.unwrap_or(1.0),
            phase,
            ..modifiers.setting
        };
        let numbers = [frequency, phase].into_iter().chain(amount.to_array());
        if !numbers.into_iter().all(f64::is_finite) {
            return Err(Fault::not_finite("this pattern"));
        }
        Ok(Pattern { source, setting, wave })
    }

    /// Returns the space of a node that `steps` and then `outer` move.
    pub fn space(
        &mut self,
        start: Start,
        steps: &[scene::Step],
        outer: &[TransformId],
        pattern: Option<&scene::Pattern>,
    ) -> Result<Space, Fault> {
        let is_uv = pattern.is_some_and(|pattern| pattern.modifiers.uv_mapping);
        let mut all: Vec<scene::Step> = steps.to_vec();
        // Around coordinates on the surface, transforms do not count.
        match start {
            // The rest is in the slot's place.
            Start::Slot(_) if !is_uv => {
                let last_warp = all.iter().rposition(|step| matches!(step, scene::Step::Warp(_)));
                all.truncate(last_warp.map_or(0, |at| at + 1));
            }
            Start::Outer | Start::Uv | Start::UvTurned(_) if !is_uv => {
                all.extend(outer.iter().map(|id| scene::Step::Transform(*id)));
            }
            _ => {}
        }
        let start = if is_uv { Start::Uv } else { start };
        let mut applied = Vec::new();
        let mut transforms: Vec<TransformId> = Vec::new();
        for step in all.iter().rev() {
            match step {
                scene::Step::Transform(id) => transforms.push(*id),
                scene::Step::Warp(warp) => {
                    applied.extend(self.inverse_of(&mut transforms)?);
                    applied.push(Step::Warp(warp.canonical()));
                }
            }
        }
        applied.extend(self.inverse_of(&mut transforms)?);
        if let Some(pattern) = pattern {
            applied.extend(turbulence(pattern).map(Step::Warp));
        }
        Ok(Space { start, steps: applied })
    }

    /// Returns the map back from transforms that are listed from the last on; `None` if they move nothing.
    fn inverse_of(&mut self, transforms: &mut Vec<TransformId>) -> Result<Option<Step>, Fault> {
        transforms.reverse();
        let place = self.transforms.product(&std::mem::take(transforms))?;
        if place.moves_nothing() {
            return Ok(None);
        }
        Ok(Some(Step::Map(inverse_map(&place)?)))
    }
}

/// Returns the displacement by the turbulence of a pattern's block, which is nearest to the pattern; `None` if
/// the pattern applies it to its value.
fn turbulence(pattern: &scene::Pattern) -> Option<Warp> {
    if let scene::Source::Kind(kind) = &pattern.source
        && kind.applies_turbulence()
    {
        return None;
    }
    let amount = pattern.modifiers.turbulence.filter(|amount| *amount != Vector::ZERO)?;
    let Layers { octaves, lambda, omega } = pattern.modifiers.layers;
    let warp = warp::Turbulence::new(amount, octaves, lambda, omega);
    Some(Warp::Turbulence(warp).canonical())
}

/// Returns the map from the world back to a node placed by `place`.
pub(super) fn inverse_map(place: &Affine) -> Result<Map, Fault> {
    let map = Map::new(place.offset().round(), place.checked()?.matrix(Double::ONE));
    if map.centre.is_finite() && map.matrix.is_finite() {
        Ok(map)
    } else {
        Err(Fault::not_finite("this texture's place"))
    }
}

pub(super) fn entry<T>(value: f64, of: T) -> Result<(f64, T), Fault> {
    match value.is_finite() {
        true => Ok((value, of)),
        false => Err(Fault::not_finite("this map")),
    }
}

/// Divides the weights of an average by their sum.
pub(super) fn mean<T>(entries: &mut [(f64, T)]) -> Result<(), Fault> {
    let sum: f64 = entries.iter().map(|(weight, _)| weight).sum();
    entries.iter_mut().for_each(|(weight, _)| *weight /= sum);
    match entries.iter().all(|(weight, _)| weight.is_finite()) {
        true => Ok(()),
        false => Err(Fault::not_finite("the weights of this average")),
    }
}

pub(super) fn too_deep() -> Fault {
    let message = format!("textures nest more than {DEEPEST} deep here");
    Fault::new(Code::OutOfRange, message).label("too many textures within each other")
}

fn finite(color: Color) -> Result<Color, Fault> {
    let color = color.of_numbers();
    let numbers = [color.filter, color.transmit];
    match color.rgb.is_finite() && numbers.into_iter().all(f64::is_finite) {
        true => Ok(color),
        false => Err(Fault::not_finite("this pigment")),
    }
}

/// Returns the pigment of a mesh whose faces have these colours.
pub(super) fn faces(colors: &[Color]) -> Result<Pigment, Fault> {
    match colors {
        [] => Ok(Pigment::Color(Color::BLACK)),
        [color, others @ ..] if others.iter().all(|other| other == color) => {
            Ok(Pigment::Color(finite(*color)?))
        }
        _ => {
            let colors = colors.iter().map(|color| finite(*color));
            Ok(Pigment::Faces(colors.collect::<Result<_, Fault>>()?))
        }
    }
}
