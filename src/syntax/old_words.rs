//! Words of old versions that POV-Ray 3.7 still reads in a `.pov`: `composite` as `union`, `alpha` as `filter`.

use super::token::{Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};
use crate::vocabulary::{Dialect, Word};

/// The old words, and what each is today (measured).
const OLD: &[(Word, Word)] = &[(Word::Composite, Word::Union), (Word::Alpha, Word::Filter)];

/// Replaces the old words, with a warning for each.
pub(super) fn replace(
    tokens: &mut [Token],
    file: FileId,
    dialect: Dialect,
    diagnostics: &mut Diagnostics,
) {
    if dialect == Dialect::Scene {
        return;
    }
    for token in tokens {
        let TokenKind::Word(word) = token.kind else { continue };
        let Some(&(old, today)) = OLD.iter().find(|(old, _)| *old == word) else { continue };
        token.kind = TokenKind::Word(today);
        let span = Span::new(file, token.start as usize, token.end as usize);
        let (old, today) = (old.name(), today.name());
        let message = format!("`{old}` is a word of old versions, and read as `{today}`");
        let told = Diagnostic::new(Code::UnknownWord, message)
            .at(span, format!("today it is `{today}`"))
            .fix(span, today);
        diagnostics.push(told.as_warning());
    }
}
