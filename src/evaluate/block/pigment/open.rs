//! Incremental reading of a pigment: from a block of its own, or from an old texture that contains its items.

use crate::evaluate::stream::Token;
use crate::evaluate::{Evaluator, Outcome, Reported};
use crate::scene::{Pigment, PigmentId};

use super::Written;

/// A pigment during reading.
pub(in crate::evaluate::block) struct OpenPigment {
    pigment: Pigment,
    /// Whether it began as the default.
    is_default: bool,
    written: Written,
    failed: bool,
}

impl OpenPigment {
    /// Allows the next items to replace the colour or the pattern.
    pub(in crate::evaluate::block) fn begin_anew(&mut self) {
        self.written.first = None;
    }
}

impl Evaluator<'_> {
    /// Returns a pigment, begun by `token`, into which items are read.
    pub(in crate::evaluate::block) fn open_pigment(
        &self,
        token: &Token,
        start: PigmentId,
    ) -> OpenPigment {
        let site = token.here.site(token.span);
        let pigment = Pigment { site, ..self.scene.pigments[start.index()].clone() };
        let is_default = start == PigmentId(0);
        OpenPigment { pigment, is_default, written: Written::default(), failed: false }
    }

    pub(in crate::evaluate::block) fn item_of_pigment(
        &mut self,
        token: &Token,
        open: &mut OpenPigment,
    ) {
        if self.pigment_item(token, &mut open.pigment, &mut open.written) == Err(Reported) {
            open.failed = true;
            open.written.mistaken(token);
            self.skip_values();
        }
    }

    pub(in crate::evaluate::block) fn close_pigment(
        &mut self,
        open: OpenPigment,
    ) -> Outcome<PigmentId> {
        let OpenPigment { mut pigment, is_default, written, mut failed } = open;
        // A map may precede its pattern.
        if let Some((given, token, item)) = written.map
            && !failed
        {
            let is_new = is_default && written.first.is_none() && !written.named;
            self.note_map(&mut pigment, &given, item, written.pattern);
            let painted = self.paint(&mut pigment, given.map.clone(), &token, is_new);
            failed |= painted == Err(Reported);
        }
        if failed { Err(Reported) } else { Ok(self.add_pigment(pigment)) }
    }
}
