//! What stands behind an object and belongs in it: `sphere { 0, 1 } pigment { rgb 1 }`.
//!
//! **In:** a word at the top level that stands only in objects. **Out:** one message at the brace that
//! closes too early. Where braces are too many as well, `syntax/repair/early.rs` has told it.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::{Family, Word};

use super::super::Evaluator;
use super::super::stream::{Token, TokenKind};

impl Evaluator<'_> {
    /// Tells of a `token` that belongs in the object right before it, and passes over all that does.
    /// `false` where no object ends there.
    pub(super) fn closed_too_early(&mut self, token: &Token, word: Word) -> bool {
        if !is_of_object(word) {
            return false;
        }
        let Some(closer) = self.closer_before(token) else { return false };
        // On a line of its own it may belong to what comes, as in other languages.
        let gap = Span { start: closer.end, end: token.span.start, ..closer };
        if word.family() == Family::Transform && self.sources.text(gap).contains('\n') {
            return false;
        }
        let Some(root) = self.scene.roots.last() else { return false };
        let object = &self.scene.objects[root.object.index()];
        let name = self.sources.text(object.site.span).to_owned();
        let ends_here = |site: crate::source::Site| {
            site.expansion == token.here.expansion
                && site.span.file == closer.file
                && site.span.end == closer.end
        };
        if !object.item.is_some_and(ends_here) {
            return false;
        }
        self.skip_arguments(word);
        while let Some(&Token { kind: TokenKind::Word(next), .. }) = self.peek_on()
            && is_of_object(next)
        {
            self.next();
            self.skip_arguments(next);
        }
        let message = format!("this `{name}` is closed before its `{}`", word.name());
        let mut told = Diagnostic::new(Code::MisplacedBlock, message)
            .at(closer, "closed here")
            .also(token.span, "this stands only in an object")
            .help("move the `}` behind all that belongs to it");
        let end = self.whole(token).span;
        let between = Span { start: closer.end, ..end };
        if end.start == token.span.start && !self.sources.text(between).contains(['#', '/']) {
            told = told.fix(closer, "").fix(end.after(), " }");
        }
        self.report(&token.here, told);
        true
    }

    /// The `}` that nothing but blanks parts from `token`.
    fn closer_before(&self, token: &Token) -> Option<Span> {
        let text = &self.sources.get(token.span.file).text;
        let before = text.get(..token.span.start as usize)?.trim_end().strip_suffix('}')?;
        Some(Span::new(token.span.file, before.len(), before.len() + 1))
    }
}

/// Words that stand in objects, and nowhere at the top level.
fn is_of_object(word: Word) -> bool {
    use Word as W;
    matches!(word.family(), Family::Transform | Family::Modifier)
        || matches!(
            word,
            W::Pigment | W::Texture | W::Normal | W::Finish | W::Interior | W::Material
        )
}
