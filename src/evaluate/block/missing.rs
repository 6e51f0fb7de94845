//! What to say of a part that is missing, and where it belongs.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::vocabulary::Word;

use super::super::Evaluator;
use super::super::stream::{Token, TokenKind};

impl Evaluator<'_> {
    /// `next` stands where `wanted` should, which belongs to `after`.
    pub(super) fn missing(
        &mut self,
        after: &Token,
        next: Option<&Token>,
        wanted: &str,
    ) -> Diagnostic {
        let message = format!("expected {wanted} after {}", self.describe(after));
        let (code, place) = (Code::MissingPart, self.end_of_parts(after));
        let diagnostic = match (next, place) {
            (Some(found), _) => {
                Diagnostic::new(code, format!("{message}, found {}", self.describe(found)))
                    .at(found.span_head(), format!("expected {wanted}"))
                    .also(after.span, "for this")
            }
            (None, Some(end)) => Diagnostic::new(code, message)
                .at(end, format!("expected {wanted} here"))
                .also(after.span, "for this"),
            (None, None) => Diagnostic::new(code, message)
                .at(after.span, format!("{wanted} is missing after this")),
        };
        let diagnostic = match after.kind {
            TokenKind::Word(word) => diagnostic.help(self.form_of(word)),
            _ => diagnostic,
        };
        let diagnostic = match self.announced.take() {
            Some((count, found)) if found > 0 && count.file == after.span.file => {
                let text = self.sources.text(count).to_owned();
                let help = format!("if these are all, write `{found}` instead of `{text}`");
                diagnostic.also(count, "so many were announced").help(help)
            }
            _ => diagnostic,
        };
        let diagnostic = match place.filter(|_| next.is_none()) {
            Some(end) if self.has_lost_comma(Span { start: after.span.end, ..end }) => {
                diagnostic.help("`a -b` is one value, and `a, -b` are two: is a comma missing?")
            }
            _ => diagnostic,
        };
        self.meant_by_word(diagnostic, next, wanted)
    }

    /// `Base() -x`: whether a sign without a blank behind it rather begins a value of its own.
    fn has_lost_comma(&self, parts: Span) -> bool {
        let text = self.sources.text(parts);
        text.match_indices(" -").any(|(at, _)| {
            let ends = |c: char| c.is_ascii_alphanumeric() || matches!(c, ')' | '>' | '_' | '.');
            let begins = |c: char| c.is_ascii_alphanumeric() || matches!(c, '(' | '<' | '.');
            text[..at].ends_with(ends) && text[at + 2..].starts_with(begins)
        })
    }

    /// Behind the last part that was taken for `after` in its block; `None` before the first, and in a block
    /// without an end.
    fn end_of_parts(&self, after: &Token) -> Option<Span> {
        let (taken, after) = (self.taken?, after.here.site(after.span));
        self.within_block()?;
        let is_part = taken.expansion == after.expansion
            && taken.span.file == after.span.file
            && taken.span.start >= after.span.end
            && self.taken != self.blocks.last().copied();
        is_part.then(|| taken.span.after())
    }

    /// How what `word` begins is written where it stands: the parts of a blob have a strength.
    pub(super) fn form_of(&self, word: Word) -> &'static str {
        let blob = |opener: &Span| self.sources.text(*opener) == Word::Blob.name();
        let in_blob = self.openers.iter().rev().take(2).any(blob);
        match word {
            Word::Sphere if in_blob => "`sphere { <centre>, radius, strength }`: a ball of a blob",
            Word::Cylinder if in_blob => {
                "`cylinder { <end>, <end>, radius, strength }`: a bar of a blob"
            }
            _ => word.sentence(),
        }
    }
}
