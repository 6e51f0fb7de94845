//! Pairs brackets and directives before anything is nested.
//!
//! **In:** the tokens of a text. **Out:** tokens in which every `{ [ (` has its closer and every directive
//! its `#end`; each token added or removed has been reported, once. **Invariant:** a text that pairs is
//! returned unchanged. Indentation only decides *which* bracket to blame in a text that certainly does not
//! pair. Vectors are not paired here: `<` may be a comparison.

use super::ParseOptions;
use super::loose;
use super::repair;
use super::token::{Token, TokenKind};
use crate::diagnostic::Diagnostics;
use crate::source::{FileId, Span};

/// An opening token that needs a closer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Opener {
    Bracket(super::token::Bracket),
    Directive,
}

/// The effect of a token on the pairing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Turn {
    Open(Opener),
    Close(Opener),
    /// `#else` and the like: everything opened since the directive has to be closed.
    Divide,
}

/// Returns the effect of a token on the pairing, if any.
pub(super) fn turn(kind: TokenKind) -> Option<Turn> {
    use super::token::{Head, Mark};
    match kind {
        TokenKind::Mark(Mark::Open(bracket)) => Some(Turn::Open(Opener::Bracket(bracket))),
        TokenKind::Mark(Mark::Close(bracket)) => Some(Turn::Close(Opener::Bracket(bracket))),
        TokenKind::Directive(Head::End) => Some(Turn::Close(Opener::Directive)),
        TokenKind::Directive(head) if head.opens() => Some(Turn::Open(Opener::Directive)),
        TokenKind::Directive(head) if head.divides() => Some(Turn::Divide),
        TokenKind::Directive(_)
        | TokenKind::Mark(_)
        | TokenKind::Word(_)
        | TokenKind::Name
        | TokenKind::Number
        | TokenKind::String
        | TokenKind::Numbers
        | TokenKind::Vectors
        | TokenKind::Triple
        | TokenKind::Raw
        | TokenKind::Unread
        | TokenKind::LooseOpen
        | TokenKind::LooseClose
        | TokenKind::Stray => None,
    }
}

/// Returns tokens that pair, and whether they end before the text as written does.
pub(super) fn balance(
    mut tokens: Vec<Token>,
    text: &str,
    file: FileId,
    options: &ParseOptions,
    diagnostics: &mut Diagnostics,
) -> (Vec<Token>, bool) {
    if let Some((at, what)) = too_deep(&tokens, options.nesting_limit) {
        let span = Span::new(file, tokens[at].start as usize, tokens[at].end as usize);
        diagnostics.push(super::nesting_limit(span, what, options.nesting_limit));
        // Nothing after it can be parsed.
        tokens.truncate(at);
        return (tokens, true);
    }
    let is_right = |tokens: &[Token]| pairs(tokens) && !holds_statements(tokens, text);
    if is_right(&tokens) {
        return (tokens, false);
    }
    let tokens = loose::loosen(tokens, text, options.loose);
    if is_right(&tokens) {
        return (tokens, false);
    }
    (repair::repair(tokens, text, file, diagnostics), false)
}

/// Returns whether every opener has its closer, and each branch closes what it opens.
pub(super) fn pairs(tokens: &[Token]) -> bool {
    let mut open = Vec::new();
    for token in tokens {
        match turn(token.kind) {
            None => {}
            Some(Turn::Open(opener)) => open.push(opener),
            Some(Turn::Close(closer)) if open.pop() != Some(closer) => return false,
            Some(Turn::Divide) if open.last() != Some(&Opener::Directive) => return false,
            Some(Turn::Close(_) | Turn::Divide) => {}
        }
    }
    open.is_empty()
}

/// Returns whether a `(` or a `[` is closed in another statement than its own.
fn holds_statements(tokens: &[Token], text: &str) -> bool {
    use super::token::{Bracket, Mark};
    if !tokens.iter().any(|token| token.kind == TokenKind::Mark(Mark::Semicolon)) {
        return false;
    }
    // The open brackets, and whether a directive begins inside, to which a `;` may belong.
    let mut open: Vec<(Opener, bool)> = Vec::new();
    tokens.iter().enumerate().any(|(at, token)| {
        match turn(token.kind) {
            Some(Turn::Close(_)) => drop(open.pop()),
            Some(Turn::Open(opener)) => open.push((opener, false)),
            Some(Turn::Divide) | None => {}
        }
        match (token.kind, open.last_mut()) {
            (TokenKind::Directive(_), Some((_, has_directive))) => *has_directive = true,
            (
                TokenKind::Mark(Mark::Semicolon),
                Some((Opener::Bracket(Bracket::Round | Bracket::Square), false)),
            ) => return ends_line(tokens, at, text),
            _ => {}
        }
        false
    })
}

/// Returns whether token `at` is the last of its line.
pub(super) fn ends_line(tokens: &[Token], at: usize, text: &str) -> bool {
    let next = tokens.get(at + 1).map_or(text.len(), |next| next.start as usize);
    let between = text.get(tokens[at].end as usize..next).unwrap_or("");
    between.contains(['\n', '\r'])
}

/// Returns the first token that opens more than `limit` levels, and the most frequent kind of these levels.
fn too_deep(tokens: &[Token], limit: usize) -> Option<(usize, &'static str)> {
    let (mut depth, mut directives) = (0_usize, 0_usize);
    let at = tokens.iter().position(|token| {
        let (opener, opens) = match turn(token.kind) {
            Some(Turn::Open(opener)) => (opener, true),
            Some(Turn::Close(opener)) => (opener, false),
            Some(Turn::Divide) | None => return false,
        };
        let levels =
            [Some(&mut depth), Some(&mut directives).filter(|_| opener == Opener::Directive)];
        for level in levels.into_iter().flatten() {
            *level = if opens { *level + 1 } else { level.saturating_sub(1) };
        }
        depth > limit
    })?;
    Some((at, if 2 * directives > depth { "directives" } else { "brackets" }))
}
