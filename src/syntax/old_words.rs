//! What POV-Ray 3.7 still reads of old versions in a `.pov`: `composite` as `union`, `alpha` as `filter`, and that
//! version 1.0 has sums in parentheses only.

use super::token::{Head, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};
use crate::vocabulary::{Dialect, Word};

/// The old words, and what each is today (measured).
const OLD: &[(Word, Word)] = &[(Word::Composite, Word::Union), (Word::Alpha, Word::Filter)];

/// The version from which on there are sums outside of parentheses (measured).
const SUMS_SINCE: f64 = 1.5;

/// Whether the first `#version` of a text is one without sums.
pub(super) fn lacks_sums(tokens: &[Token], text: &str, dialect: Dialect) -> bool {
    let is_version = |token: &Token| token.kind == TokenKind::Directive(Head::Version);
    let number = tokens.iter().position(is_version).and_then(|at| tokens.get(at + 1));
    let number = number.and_then(|token| text.get(token.start as usize..token.end as usize));
    dialect == Dialect::Pov
        && number.and_then(|number| number.parse::<f64>().ok()).is_some_and(|n| n < SUMS_SINCE)
}

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
