//! Records where the author's text calls for an effect of a texture.
//!
//! **Invariant:** each place is listed once a texture, however many loops and macros visit it.

use smallvec::{SmallVec, smallvec};

use super::Lowering;
use super::surface::Surface;
use crate::scene::{self, Colors, FinishId, PigmentId, PigmentKind};
use crate::source::Site;
use crate::vocabulary::Word;
use crate::world::TexturePart;

/// From so many sites on, a set tells which of them a texture's list has.
const FEW: usize = 8;

impl Lowering<'_, '_> {
    /// Records another surface that lowers to the texture `index`.
    pub(super) fn note_texture(&mut self, index: u32, surface: &Surface) {
        for site in surface.patterns(self.scene) {
            self.note_site(index, TexturePart::Pattern, site);
        }
        for (pigment, finish) in surface.all(self.scene) {
            self.note_plain(index, pigment, finish);
        }
    }

    /// Lists a place, unless it is listed.
    fn note_site(&mut self, index: u32, part: TexturePart, site: Site) {
        let list = &mut self.origins.textures[index as usize].sites;
        let is_it = |(of, known): &(TexturePart, Site)| *of == part && known.span == site.span;
        if list.iter().take(FEW).any(is_it) {
            return;
        }
        if list.len() < FEW || self.textures.noted.insert((index, part, site.span)) {
            list.reserve_exact(usize::from(list.is_empty()));
            list.push((part, site));
        }
    }

    fn note_plain(&mut self, index: u32, pigment: PigmentId, finish: FinishId) {
        for id in pigments_in(self.scene, pigment) {
            let pigment = &self.scene.pigments[id.index()];
            if let Some(site) = pattern_site(pigment) {
                self.note_site(index, TexturePart::Pattern, site);
            }
            if let Some(site) = pigment.clear {
                self.note_site(index, TexturePart::Clear, site);
            }
        }
        let scene = self.scene;
        let Some(written) = scene.finish_origins.get(finish.index()) else { return };
        let finish = &scene.finishes[finish.index()];
        let parts = [
            (TexturePart::Highlights, &[Word::Phong, Word::Specular, Word::Ks][..]),
            (TexturePart::Reflection, &[Word::Reflection, Word::Ks]),
            (TexturePart::Behind, &[Word::Diffuse]),
        ];
        for (part, words) in parts {
            for &word in words {
                if let Some(site) = written.of(word).filter(|_| finish.has_weight(word)) {
                    self.note_site(index, part, site);
                }
            }
        }
        for &(word, site) in &written.words {
            if !finish.has_weight(word) && !matches!(word, Word::Diffuse | Word::Ior) {
                self.drop_part(site, word.name(), "its weight is zero");
            }
        }
    }

    /// Records that an object of the texture `index` casts a shadow into which `pigment` may let light.
    pub(super) fn note_filter(&mut self, index: u32, pigment: PigmentId) {
        for id in pigments_in(self.scene, pigment) {
            if let Some(site) = self.scene.pigments[id.index()].clear {
                self.note_site(index, TexturePart::Filter, site);
            }
        }
    }

    /// Records that a pattern whose colours are all the same is dropped.
    pub(super) fn note_folded(&mut self, id: PigmentId) {
        let PigmentKind::Patterned { pattern, colors } = &self.scene.pigments[id.index()].kind
        else {
            return;
        };
        if colors.lone_color().is_some() {
            self.drop_part(pattern.site, pattern.source.word(), "its colours are all the same");
        }
    }
}

/// Returns a pigment and all pigments inside it.
pub(super) fn pigments_in(scene: &scene::Scene, id: PigmentId) -> SmallVec<[PigmentId; 1]> {
    let mut all: SmallVec<[PigmentId; 1]> = smallvec![id];
    let mut at = 0;
    while let Some(id) = all.get(at) {
        at += 1;
        let PigmentKind::Patterned { pattern, colors } = &scene.pigments[id.index()].kind else {
            continue;
        };
        let mut inner = Vec::new();
        if let scene::Source::Pigment(id) = pattern.source {
            inner.push(id);
        }
        if let Colors::Pigments(pigments) = colors {
            inner.extend(pigments.iter().map(|(_, id)| *id));
        }
        let new: Vec<_> = inner.into_iter().filter(|id| !all.contains(id)).collect();
        all.extend(new);
    }
    all
}

/// Returns the site of a pigment's pattern, if it has more than one colour.
pub(super) fn pattern_site(pigment: &scene::Pigment) -> Option<Site> {
    match &pigment.kind {
        PigmentKind::Patterned { pattern, colors } if colors.lone_color().is_none() => {
            Some(pattern.site)
        }
        _ => None,
    }
}
