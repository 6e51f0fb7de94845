//! Handles keywords of old versions that POV-Ray 3.7 still accepts in a `.pov`: `composite` for `union`,
//! `alpha` for `filter`; and version 1.0, which has sums in parentheses only.

use super::token::{Bracket, Head, Mark, Token, TokenKind};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};
use crate::vocabulary::{Dialect, Word};

/// The old keywords, and their replacements (measured).
const OLD: &[(Word, Word)] = &[(Word::Composite, Word::Union), (Word::Alpha, Word::Filter)];

/// The first version with sums outside parentheses (measured).
const SUMS_SINCE: f64 = 1.5;

/// Returns whether the first `#version` of a text is one without sums.
pub(super) fn lacks_sums(tokens: &[Token], text: &str, dialect: Dialect) -> bool {
    let is_version = |token: &Token| token.kind == TokenKind::Directive(Head::Version);
    let number = tokens.iter().position(is_version).and_then(|at| tokens.get(at + 1));
    let number = number.and_then(|token| text.get(token.start as usize..token.end as usize));
    dialect == Dialect::Pov
        && number.and_then(|number| number.parse::<f64>().ok()).is_some_and(|n| n < SUMS_SINCE)
}

/// Replaces the old keywords, with a warning for each.
pub(super) fn replace(
    tokens: &mut [Token],
    file: FileId,
    dialect: Dialect,
    diagnostics: &mut Diagnostics,
) {
    if dialect == Dialect::Scene {
        return;
    }
    for at in 0..tokens.len() {
        let TokenKind::Word(word) = tokens[at].kind else { continue };
        let Some(&(old, today)) = OLD.iter().find(|(old, _)| *old == word) else { continue };
        if begins_finish(&tokens[..at]) {
            continue;
        }
        let token = &mut tokens[at];
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

/// Returns whether `finish {` directly precedes it: `finish { alpha 0.5 }` is rejected, and `finish { ambient
/// 1 alpha 0.5 }` is not.
fn begins_finish(before: &[Token]) -> bool {
    let kinds = before.iter().rev().take(2).map(|token| token.kind);
    kinds.eq([TokenKind::Mark(Mark::Open(Bracket::Brace)), TokenKind::Word(Word::Finish)])
}
