//! `pigment_map`: pigments over the values of a pattern.

use crate::evaluate::block::blend_map::Entry;
use crate::evaluate::stream::Token;
use crate::evaluate::{Evaluator, Outcome};
use crate::scene::{PigmentId, Source};
use crate::vocabulary::Word;

use super::OpenPigment;

impl Evaluator<'_> {
    /// Returns whether the entries of a pigment's map have weights instead of positions.
    pub(super) fn is_average(&self, open: &OpenPigment) -> bool {
        open.pattern.close().is_some_and(|pattern| pattern.source == Source::Average)
    }

    /// Reads `pigment_map { [value pigment] … }`.
    pub(super) fn pigment_map(
        &mut self,
        token: &Token,
        average: bool,
    ) -> Outcome<Vec<(f64, PigmentId)>> {
        let entries = self.entries_of(token, Word::PigmentMap, average)?.into_iter();
        let pigment = |(value, entry)| match entry {
            Entry::Pigment(id) => Some((value, id)),
            _ => None,
        };
        Ok(entries.filter_map(pigment).collect())
    }

    /// Reads the items of a pigment up to the end of an entry.
    pub(in crate::evaluate::block) fn pigment_of_entry(
        &mut self,
        opener: &Token,
    ) -> Outcome<PigmentId> {
        let start = self.scene.textures[self.default_texture.index()].kind.first_pigment();
        let mut open = self.open_pigment(opener, start);
        while let Some(token) = self.next() {
            self.item_of_pigment(&token, &mut open);
        }
        self.close_pigment(open)
    }
}
