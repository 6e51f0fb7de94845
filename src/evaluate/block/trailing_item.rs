//! Diagnostics for items after an object that belong inside it: `sphere { 0, 1 } pigment { rgb 1 }`.
//!
//! **In:** a word at the top level that is only valid in objects. **Out:** one message at the brace that
//! closes too early. If there are surplus braces as well, `syntax/repair/early_closer.rs` has reported it.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{Site, Span};
use crate::vocabulary::{Family, Word};

use super::super::Evaluator;
use super::super::stream::{Token, TokenKind};
use super::is_object_word;

/// Maximum number of objects that are examined: the last one has its parts before it.
const MOST_OBJECTS: usize = 4;

impl Evaluator<'_> {
    /// Reports a `token` that belongs in the object right before it, and skips everything that does. Returns
    /// `false` if no object ends there.
    pub(super) fn closed_too_early(&mut self, token: &Token, word: Word) -> bool {
        if !is_of_object(word) {
            return false;
        }
        let Some(closer) = self.closer_before(token) else { return false };
        // On a line of its own it may belong to what follows, as in other languages.
        let gap = Span { start: closer.end, end: token.span.start, ..closer };
        if word.family() == Family::Transform && self.sources.text(gap).contains('\n') {
            return false;
        }
        let ends_here = |site: Site| {
            let block = Span { end: closer.end, start: site.span.end, ..site.span };
            site.expansion == token.here.expansion
                && site.span.file == closer.file
                && block.start < block.end
                && is_one_block(self.sources.text(block))
        };
        let mut objects = self.scene.objects.iter().rev().take(MOST_OBJECTS);
        let Some(object) = objects.find(|object| ends_here(object.site)) else { return false };
        let name = self.sources.text(object.site.span).to_owned();
        self.skip_arguments(word);
        let mut end = self.whole(token).span;
        while let Some(&Token { kind: TokenKind::Word(next), span, .. }) = self.peek_on()
            && is_of_object(next)
            && self.is_beside(end, span)
        {
            self.next();
            self.skip_arguments(next);
            end = self.whole(token).span;
        }
        let message = format!("this `{name}` is closed before its `{}`", word.name());
        let mut told = Diagnostic::new(Code::MisplacedBlock, message)
            .at(closer, "closed here")
            .also(token.span, "this stands only in an object")
            .help("move the `}` behind all that belongs to it");
        let between = Span { start: closer.end, ..end };
        if end.start == token.span.start
            && end.end > token.span.end
            && !self.sources.text(between).contains(['#', '/'])
        {
            told = told.fix(closer, "").fix(end.after(), " }");
        }
        self.report(&token.here, told);
        true
    }

    /// Returns whether only blanks separate two spans, the second after the first.
    fn is_beside(&self, first: Span, second: Span) -> bool {
        self.sources.between(first, second).is_some_and(|between| between.trim().is_empty())
    }

    /// Returns the `}` that only blanks separate from `token`.
    fn closer_before(&self, token: &Token) -> Option<Span> {
        let text = &self.sources.get(token.span.file).text;
        let before = text.get(..token.span.start as usize)?.trim_end().strip_suffix('}')?;
        Some(Span::new(token.span.file, before.len(), before.len() + 1))
    }
}

/// Returns whether a text is one block with its braces, by counting braces wherever they appear.
fn is_one_block(text: &str) -> bool {
    let mut depth = 0_usize;
    let end = text.trim_start().char_indices().find(|&(_, c)| {
        match c {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 0
    });
    let block = text.trim_start();
    block.starts_with('{') && end.is_some_and(|(at, _)| at + 1 == block.len())
}

/// Returns whether a word is valid in objects and not at the top level.
fn is_of_object(word: Word) -> bool {
    use Word as W;
    matches!(word.family(), Family::Transform | Family::Modifier) && !is_object_word(word)
        || matches!(
            word,
            W::Pigment | W::Texture | W::Normal | W::Finish | W::Interior | W::Material
        )
}
