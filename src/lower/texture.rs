//! Lowers textures: turns pigments, finishes and maps into shared trees, and transforms into places.
//!
//! **In:** a surface: a texture with the placement of its slots. **Out:** indices into the World's lists.
//! **Invariant:** equal textures, and equal lists of places, share one entry, in the order of first use.

use std::hash::BuildHasher;
use std::sync::Arc;

use rustc_hash::{FxBuildHasher, FxHashMap, FxHashSet};
use smallvec::SmallVec;

use super::cause::{pattern_site, pigments_in};
use super::finish::{BARE, lower_finish};
use super::pigment::{Nodes, entry, inverse_map, mean, too_deep};
use super::shape::LocalFace;
use super::surface::{Slot, Surface};
use super::transform::Affine;
use super::{Fault, Lowering};
use crate::color::Color;
use crate::scene::{self, FinishId, NormalId, PigmentId, TextureId, TextureKind};
use crate::source::{Site, Span};
use crate::texture::space::Start;
use crate::texture::{Blend, DEEPEST};
use crate::world::{
    Extras, FaceCoordinates, Finish, Pigment, Plain, Sky, SkyOrigin, SurfacePart, Texture,
    TextureOrigin, TexturePart, World,
};

/// The entries of the World's lists of textures and places so far.
#[derive(Default)]
pub struct Textures {
    /// The texture of each combination of what is written.
    known: FxHashMap<Written, u32>,
    /// The texture of each solid whose parts have their own, by the solid and its own.
    pub(super) of_faces: FxHashMap<(*const (), Written), u32>,
    /// Textures that share the hash of the numbers in which most differ, to be compared for equality.
    alike: FxHashMap<u64, SmallVec<[u32; 1]>>,
    maps: FxHashMap<Vec<u64>, u32>,
    /// The sites already listed in the origins that have many.
    pub(super) noted: FxHashSet<(u32, TexturePart, Span)>,
}

/// A texture, with the pigment, the normal and the finish that replace its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Written {
    texture: TextureId,
    pigment: Option<PigmentId>,
    normal: Option<NormalId>,
    finish: Option<FinishId>,
}

impl Written {
    pub(super) fn of(surface: &Surface) -> Self {
        let &Surface { texture, pigment, normal, finish, .. } = surface;
        Self { texture, pigment, normal, finish }
    }

    /// A texture as it is.
    pub(super) const fn own(texture: TextureId) -> Self {
        Self { texture, pigment: None, normal: None, finish: None }
    }
}

impl<'s> Lowering<'s, '_> {
    /// Returns the World's index of a surface's texture; `site` is the object's, for faults of its finish.
    pub(super) fn texture(&mut self, surface: &Surface, site: Site) -> u32 {
        let written = Written::of(surface);
        if let Some(&known) = self.textures.known.get(&written) {
            return known;
        }
        let mut slot = 0;
        let lowered = self.node(written, &[], Some(&mut slot), 0);
        let lowered = match lowered {
            Ok(texture) => texture,
            Err((fault, at)) => {
                self.reporter.fault(fault, at.unwrap_or(site));
                bare()
            }
        };
        let (pigment, finish) = surface.plain(self.scene);
        let index = self.index(lowered, self.origin(pigment, finish));
        self.note_texture(index, surface);
        self.textures.known.insert(written, index);
        index
    }

    /// Returns a texture that `outer` moves; with the number of the next slot, if its nodes have slots.
    pub(super) fn node(
        &mut self,
        of: Written,
        outer: &[scene::TransformId],
        mut slot: Option<&mut u32>,
        depth: usize,
    ) -> Result<Texture, (Fault, Option<Site>)> {
        let scene = self.scene;
        let written = &scene.textures[of.texture.index()];
        if depth > DEEPEST {
            return Err((too_deep(), None));
        }
        let outer = [&written.transforms, outer].concat();
        let mut start = || {
            let slot = slot.as_mut().map(|slot| {
                **slot += 1;
                **slot - 1
            });
            match slot {
                Some(slot) if written.uv_mapping => Start::UvTurned(slot),
                None if written.uv_mapping => Start::Uv,
                Some(slot) => Start::Slot(slot),
                None => Start::Outer,
            }
        };
        match &written.kind {
            TextureKind::Plain { pigment, normal, finish } => {
                let pigment = of.pigment.unwrap_or(*pigment);
                let finish = of.finish.unwrap_or(*finish);
                let pigment_start = start();
                let site = Some(scene.pigments[pigment.index()].site);
                let paint = self.nodes().pigment(pigment, pigment_start, &outer, depth);
                let paint = paint.map_err(|fault| (fault, site))?;
                let normal = match of.normal.or(*normal) {
                    Some(id) => {
                        let site = Some(scene.normals[id.index()].site);
                        let normal = self.nodes().normal(id, start(), &outer, depth);
                        normal.map_err(|fault| (fault, site))?.map(Box::new)
                    }
                    None => None,
                };
                self.note_folded(pigment);
                let finish = lower_finish(&scene.finishes[finish.index()], &scene.settings);
                let finish = finish.map_err(|fault| (fault, None))?;
                Ok(Texture::Plain(Plain { normal, ..plain(paint, finish) }))
            }
            TextureKind::Blend { pattern, steps, entries } => {
                let (start, site) = (start(), Some(pattern.site));
                let space = self.nodes().space(start, steps, &outer, Some(pattern));
                let mut space = space.map_err(|fault| (fault, site))?;
                if let (Start::Uv, Start::Slot(slot) | Start::UvTurned(slot)) = (space.start, start)
                {
                    space.start = Start::UvTurned(slot);
                }
                let entries = entries.iter().map(|&(value, id)| {
                    let texture = self.inner_texture(id, depth + 1)?;
                    entry(value, texture).map_err(|fault| (fault, site))
                });
                let mut entries = entries.collect::<Result<Vec<_>, _>>()?;
                let word = pattern.source.word();
                self.branches.note(SurfacePart::Texture, word, Some(pattern.site));
                if pattern.source == scene::Source::Average {
                    mean(&mut entries).map_err(|fault| (fault, site))?;
                    return Ok(Texture::Average { space, entries });
                }
                let pattern = self.nodes().pattern(pattern, entries.len(), depth);
                let pattern = pattern.map_err(|fault| (fault, site))?;
                Ok(Texture::Blend(Box::new(Blend { space, pattern, entries })))
            }
            TextureKind::Layers(layers) => {
                let last = layers.len() - 1;
                let first =
                    layers.first().map(|id| scene.textures[id.index()].kind.first_pigment());
                let site = first.and_then(|id| scene.pigments[id.index()].written());
                self.branches.note(SurfacePart::Layers, "layers", site);
                let mut lowered = Vec::with_capacity(layers.len());
                for (place, id) in layers.iter().enumerate() {
                    let layer = Written::own(*id);
                    let layer = if place == last { Written { texture: *id, ..of } } else { layer };
                    let slot = slot.as_deref_mut();
                    let layer = self.node(layer, &outer, slot, depth + 1)?;
                    lowered.push(Arc::new(layer));
                }
                Ok(Texture::Layers(lowered))
            }
        }
    }

    /// Returns an entry of a blend.
    fn inner_texture(
        &mut self,
        id: TextureId,
        depth: usize,
    ) -> Result<Arc<Texture>, (Fault, Option<Site>)> {
        if let Some(known) = self.branches.textures.get(id, depth) {
            return Ok(known);
        }
        let texture = self.node(Written::own(id), &[], None, depth)?;
        Ok(self.branches.textures.add(id, depth, texture))
    }

    pub(super) fn nodes(&mut self) -> Nodes<'_, 's> {
        Nodes { scene: self.scene, transforms: &mut self.transforms, branches: &mut self.branches }
    }

    /// Returns the origin of a texture with this pigment and finish.
    pub(super) fn origin(&self, pigment: PigmentId, finish: FinishId) -> TextureOrigin {
        let pigment = self.scene.pigments[pigment.index()].written();
        let finish = self.scene.finish_origins.get(finish.index()).and_then(|origin| origin.site);
        TextureOrigin { pigment, finish, ..Default::default() }
    }

    /// Returns the texture of an object that no ray hits.
    pub(super) fn bare_texture(&mut self) -> u32 {
        self.index(bare(), TextureOrigin::default())
    }

    /// Returns the World's index of a texture; `origin` is recorded with a new one.
    pub(super) fn index(&mut self, texture: Texture, origin: TextureOrigin) -> u32 {
        let textures = &mut self.world.textures;
        let alike = self.textures.alike.entry(telling_hash(&texture)).or_default();
        let known = alike.iter().copied().find(|&i| textures[i as usize] == texture);
        known.unwrap_or_else(|| {
            let index = textures.len() as u32;
            textures.push(texture);
            self.origins.textures.push(origin);
            alike.push(index);
            index
        })
    }

    /// Returns the World's index of the maps into the slots of a surface's texture; `None` if there is no
    /// pattern or all maps are the identity.
    pub(super) fn places(&mut self, surface: &Surface, texture: u32) -> Result<Option<u32>, Fault> {
        let slots = &surface.places;
        if !is_patterned(&self.world, texture) || slots.iter().all(|slot| slot.place.is_identity())
        {
            return Ok(None);
        }
        let maps = slots.iter().map(|slot| inverse_map(&slot.place));
        let all = maps.collect::<Result<Vec<_>, Fault>>()?;
        let numbers = all
            .iter()
            .flat_map(|map| map.matrix.to_cols_array().into_iter().chain(map.centre.to_array()));
        let key: Vec<u64> = numbers.map(bits).collect();
        let maps = &mut self.world.texture_maps;
        Ok(Some(*self.textures.maps.entry(key).or_insert_with(|| {
            maps.extend(&all);
            (maps.len() - all.len()) as u32
        })))
    }

    /// Returns the World's index of the first entry of the pattern coordinates that are constant over each of
    /// a solid's flat faces, slot by slot.
    pub(super) fn faces(
        &mut self,
        surface: &Surface,
        texture: u32,
        faces: &[LocalFace],
    ) -> Result<Option<u32>, Fault> {
        if !is_patterned(&self.world, texture) {
            return Ok(None);
        }
        let start = self.world.faces.len() as u32;
        for Slot { set_place, set_from_solid, .. } in &*surface.places {
            let pattern_from_solid = set_place.checked()?.after(set_from_solid);
            self.world
                .faces
                .extend(faces.iter().map(|face| coordinates(face, &pattern_from_solid)));
        }
        Ok(Some(start))
    }

    pub(super) fn sky(&mut self) {
        let scene = self.scene;
        let Some(sky) = &scene.sky_sphere else { return };
        let mut pigments = Vec::new();
        for &id in &sky.pigments {
            self.note_folded(id);
            let lowered = self.nodes().pigment(id, Start::Outer, &sky.transforms, 0);
            let site = scene.pigments[id.index()].site;
            pigments.extend(self.reporter.made(lowered, site));
        }
        let emission = sky.emission.bounded();
        self.world.sky = (!pigments.is_empty()).then_some(Sky { pigments, emission });
        let written = sky.pigments.iter().flat_map(|id| pigments_in(scene, *id));
        let pattern = written.filter_map(|id| pattern_site(&scene.pigments[id.index()]));
        let (site, items, pattern) = (sky.site, sky.items.clone(), pattern.collect());
        self.origins.sky = Some(SkyOrigin { site, items, pattern });
    }
}

/// Returns a texture without the settings that have no effect in it.
pub(super) fn plain(pigment: Pigment, mut finish: Finish) -> Plain {
    let is_clear = pigment.is_clear();
    if !is_clear || finish.reflection.is_none() {
        finish.conserve_energy = false;
    }
    if !is_clear && let Some(extras) = finish.extras {
        finish.extras = Extras { passed: 1.0, ..*extras }.kept();
    }
    Plain { pigment, normal: None, finish }
}

/// Returns a black texture.
fn bare() -> Texture {
    Texture::Plain(plain(Pigment::Color(Color::BLACK), BARE))
}

/// Returns whether any node of a texture is evaluated at a point of its object.
fn is_patterned(world: &World, texture: u32) -> bool {
    let mut found = false;
    world.textures[texture as usize].for_each_space(&mut |_, _| found = true);
    found
}

/// A coordinate is constant over a face exactly if its row is parallel to the face's normal, here within the
/// map's bound.
fn coordinates(face: &LocalFace, pattern_from_solid: &Affine) -> FaceCoordinates {
    let offset = pattern_from_solid.offset().components();
    let rows = pattern_from_solid.rows();
    FaceCoordinates(std::array::from_fn(|i| {
        let along = rows[i].dot(face.normal);
        let across = rows[i] - face.normal * along;
        let constant = across.largest() <= pattern_from_solid.bound() * rows[i].largest();
        constant.then(|| (along * face.distance + offset[i]).round())
    }))
}

/// Returns bits that are the same for equal numbers: both zeros give the same.
fn bits(number: f64) -> u64 {
    (number + 0.0).to_bits()
}

/// Returns the hash of the numbers in which most textures differ.
fn telling_hash(texture: &Texture) -> u64 {
    let Texture::Plain(Plain { pigment, finish, .. }) = texture else { return 0 };
    let color = match pigment {
        Pigment::Color(color) => *color,
        Pigment::Ramp(blend) => blend.entries.first().map_or(Color::BLACK, |(_, color)| *color),
        Pigment::Faces(colors) => colors.first().copied().unwrap_or(Color::BLACK),
        Pigment::Blend(_) | Pigment::Average { .. } | Pigment::Image { .. } => Color::BLACK,
    };
    let [red, green, blue] = color.rgb.components();
    let Finish { emission, diffuse, ref lobes, .. } = *finish;
    let lobe = lobes.first().map_or(0.0, |lobe| lobe.weight);
    FxBuildHasher.hash_one([red, green, blue, emission.red, diffuse, lobe].map(bits))
}
