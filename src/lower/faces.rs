//! Lowers textures of single faces of a mesh, by corner, and of components of a blob: several textures, or the
//! colours of one.

use std::sync::Arc;

use rustc_hash::FxHashSet;
use smallvec::SmallVec;

use super::finish::lower_finish;
use super::inherited::Inherited;
use super::pigment::faces;
use super::surface::{Parts, Slot, Surface, add_slots};
use super::texture::{Written, plain};
use super::transform::Affine;
use super::{Fault, Lowering};
use crate::color::Color;
use crate::scene::{self, FinishId, PigmentId, PigmentKind, TextureId, TextureKind};
use crate::source::Site;
use crate::world::{Finish, Texture};

impl Surface {
    /// Returns the surface for a solid; it is visible where a part has no texture of its own.
    fn of_parts(&self, parts: Parts) -> Self {
        let Some(first) = parts.textures().first().copied().filter(|_| parts.is_painted()) else {
            return self.clone();
        };
        if parts.is_seen_bare() {
            return Self { faces: Some(parts), ..self.clone() };
        }
        let faces = Some(parts);
        Self { texture: first, pigment: None, normal: None, finish: None, faces, ..self.clone() }
    }

    /// Returns the pigments and finishes of all textures that may be visible: those of faces, in their order,
    /// and then its own. An entry of a blend that several share counts once.
    pub fn all(&self, scene: &scene::Scene) -> SmallVec<[(PigmentId, FinishId); 1]> {
        let mut all = SmallVec::new();
        let mut entries = FxHashSet::default();
        let textures = self.faces.iter().flat_map(|parts| parts.textures());
        textures.for_each(|id| add_plains(scene, *id, &mut entries, &mut all));
        add_plains(scene, self.texture, &mut FxHashSet::default(), &mut all);
        if let Some(own) = all.last_mut() {
            *own = (self.pigment.unwrap_or(own.0), self.finish.unwrap_or(own.1));
        }
        all
    }

    /// Returns the sites of the patterns that select among its textures.
    pub fn patterns(&self, scene: &scene::Scene) -> Vec<Site> {
        let (mut seen, mut sites) = (FxHashSet::default(), Vec::new());
        let textures = self.faces.iter().flat_map(|parts| parts.textures()).copied();
        for id in textures.chain([self.texture]) {
            add_patterns(scene, id, &mut seen, &mut sites);
        }
        sites
    }
}

/// Adds the site of each pattern that selects among textures, of each texture once.
fn add_patterns(
    scene: &scene::Scene,
    id: TextureId,
    seen: &mut FxHashSet<TextureId>,
    sites: &mut Vec<Site>,
) {
    let kind = &scene.textures[id.index()].kind;
    if matches!(kind, TextureKind::Plain { .. }) || !seen.insert(id) {
        return;
    }
    match kind {
        TextureKind::Plain { .. } => {}
        TextureKind::Blend { pattern, entries, .. } => {
            sites.extend((pattern.source != scene::Source::Average).then_some(pattern.site));
            entries.iter().for_each(|(_, id)| add_patterns(scene, *id, seen, sites));
        }
        TextureKind::Layers(layers) => {
            layers.iter().for_each(|id| add_patterns(scene, *id, seen, sites));
        }
    }
}

/// Adds the pigment and the finish of each part of a texture, of the entries of blends each once.
fn add_plains(
    scene: &scene::Scene,
    id: TextureId,
    entries: &mut FxHashSet<TextureId>,
    all: &mut SmallVec<[(PigmentId, FinishId); 1]>,
) {
    match &scene.textures[id.index()].kind {
        TextureKind::Plain { pigment, finish, .. } => all.push((*pigment, *finish)),
        TextureKind::Blend { entries: parts, .. } => {
            for &(_, id) in parts {
                if entries.insert(id) {
                    add_plains(scene, id, entries, all);
                }
            }
        }
        TextureKind::Layers(layers) => {
            layers.iter().for_each(|id| add_plains(scene, *id, entries, all));
        }
    }
}

impl Lowering<'_, '_> {
    /// Returns what a solid inherits whose parts may have textures of their own, which move with it.
    pub(super) fn of_parts(&mut self, here: &Inherited, parts: Parts) -> Result<Inherited, Fault> {
        let mut surface = here.surface.of_parts(parts.clone());
        if surface.faces.is_some() && self.colors_of_faces(&surface)?.is_none() {
            let mut places = SmallVec::new();
            for &id in parts.textures() {
                let added = add_slots(self.scene, &mut self.transforms, id, &[], &mut |own| {
                    let place = here.world_from_here.after(&own);
                    let set_from_solid = Affine::IDENTITY;
                    places.push(Slot { place, set_place: own, set_from_solid });
                });
                added.map_err(|(fault, _)| fault)?;
            }
            if parts.is_seen_bare() {
                places.extend(surface.places.iter().cloned());
            }
            surface.places = std::rc::Rc::new(places);
        }
        let mut cut = here.cut.clone();
        if parts.is_painted() {
            cut.whole = Some(here.surface.clone());
        }
        Ok(Inherited { surface, cut, ..here.clone() })
    }

    /// Returns the colours of a solid whose parts have textures of their own, and their finish, if each is of
    /// one colour and all have the same finish.
    fn colors_of_faces(&self, surface: &Surface) -> Result<Option<(Vec<Color>, Finish)>, Fault> {
        let scene = self.scene;
        let (mut colors, mut shared) = (Vec::new(), None);
        let textures = surface.faces.iter().flat_map(|parts| parts.textures());
        let textures = textures.map(|id| (*id, None, None, None));
        let own = (surface.texture, surface.pigment, surface.normal, surface.finish);
        for (id, own_pigment, own_normal, own_finish) in textures.chain([own]) {
            let TextureKind::Plain { pigment, normal, finish } = scene.textures[id.index()].kind
            else {
                return Ok(None);
            };
            let pigment = &scene.pigments[own_pigment.unwrap_or(pigment).index()];
            let PigmentKind::Color(color) = pigment.kind else { return Ok(None) };
            if own_normal.or(normal).is_some() {
                return Ok(None);
            }
            let finish = own_finish.unwrap_or(finish);
            match &shared {
                Some((known, _)) if *known == finish => {}
                _ => {
                    let lowered = lower_finish(&scene.finishes[finish.index()], &scene.settings)?;
                    if shared.as_ref().is_some_and(|(_, first)| *first != lowered) {
                        return Ok(None);
                    }
                    shared = Some((finish, lowered));
                }
            }
            colors.push(color);
        }
        Ok(shared.map(|(_, finish)| (colors, finish)))
    }

    /// Returns the World's index of the texture of a solid whose parts have textures of their own.
    pub(super) fn texture_of_faces(&mut self, surface: &Surface, site: Site) -> Result<u32, Fault> {
        let Some(parts) = &surface.faces else { return Ok(self.texture(surface, site)) };
        let key = (parts.key(), Written::of(surface));
        if let Some(&known) = self.textures.of_faces.get(&key) {
            return Ok(known);
        }
        let lowered = match self.colors_of_faces(surface)? {
            Some((colors, finish)) => Texture::Plain(plain(faces(&colors)?, finish)),
            None => {
                let mut slot = 0;
                let own = parts.is_seen_bare().then(|| Written::of(surface));
                let all = parts.textures().iter().map(|id| Written::own(*id)).chain(own);
                let mut textures = Vec::new();
                for written in all {
                    let texture = self.node(written, &[], Some(&mut slot), 1);
                    textures.push(Arc::new(texture.map_err(|(fault, _)| fault)?));
                }
                Texture::Faces(textures)
            }
        };
        let (pigment, polish) = surface.plain(self.scene);
        let origin = self.origin(pigment, polish);
        let index = self.index(lowered, origin);
        self.note_texture(index, surface);
        self.textures.of_faces.insert(key, index);
        Ok(index)
    }
}
