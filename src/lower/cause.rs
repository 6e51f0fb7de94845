//! Records where the author's text calls for an effect of a texture.
//!
//! **Invariant:** each place is listed once a texture, however many loops and macros visit it.

use smallvec::{SmallVec, smallvec};

use super::Lowering;
use super::surface::Surface;
use crate::scene::{self, Colors, FinishId, PigmentId, PigmentKind};
use crate::source::Site;
use crate::vocabulary::Word;

/// A part of a texture whose sites are listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Part {
    Pattern,
    Highlights,
    Reflection,
    Behind,
    Clear,
    Filter,
}

impl Lowering<'_, '_> {
    /// Records another surface that lowers to the texture `index`.
    pub(super) fn note_texture(&mut self, index: u32, surface: &Surface) {
        let patterns = surface.patterns(self.scene).into_iter();
        let noted = &mut self.textures.noted;
        let new = patterns.filter(|site| noted.insert((index, Part::Pattern, site.span)));
        self.origins.textures[index as usize].pattern.extend(new);
        for (pigment, finish) in surface.all(self.scene) {
            self.note_plain(index, pigment, finish);
        }
    }

    fn note_plain(&mut self, index: u32, pigment: PigmentId, finish: FinishId) {
        let pigments = pigments_in(self.scene, pigment);
        let origin = &mut self.origins.textures[index as usize];
        let noted = &mut self.textures.noted;
        let mut note = |part: Part, list: &mut Vec<Site>, sites: &mut dyn Iterator<Item = Site>| {
            list.extend(sites.filter(|site| noted.insert((index, part, site.span))));
        };
        for id in pigments {
            let pigment = &self.scene.pigments[id.index()];
            note(Part::Pattern, &mut origin.pattern, &mut pattern_site(pigment).into_iter());
            note(Part::Clear, &mut origin.clear, &mut pigment.clear.into_iter());
        }
        let Some(written) = self.scene.finish_origins.get(finish.index()) else { return };
        let finish = &self.scene.finishes[finish.index()];
        let calls = |word: &Word| written.of(*word).filter(|_| finish.has_weight(*word));
        let shining = [Word::Phong, Word::Specular, Word::Ks];
        note(Part::Highlights, &mut origin.highlights, &mut shining.iter().filter_map(calls));
        let reflecting = [Word::Reflection, Word::Ks];
        note(Part::Reflection, &mut origin.reflection, &mut reflecting.iter().filter_map(calls));
        note(Part::Behind, &mut origin.behind, &mut calls(&Word::Diffuse).into_iter());
        for &(word, site) in &written.words {
            if !finish.has_weight(word) && !matches!(word, Word::Diffuse | Word::Ior) {
                self.drop_part(site, word.name(), "its weight is zero");
            }
        }
    }

    /// Records that an object of the texture `index` casts a shadow into which `pigment` may let light.
    pub(super) fn note_filter(&mut self, index: u32, pigment: PigmentId) {
        let noted = &mut self.textures.noted;
        for id in pigments_in(self.scene, pigment) {
            let clear = self.scene.pigments[id.index()].clear;
            let new =
                clear.into_iter().filter(|site| noted.insert((index, Part::Filter, site.span)));
            self.origins.textures[index as usize].filter.extend(new);
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
