//! Adds missing `{`s of blocks whose `}` exists: `pigment rgb 1 }`, `Engine scale 2 }`.
//!
//! **In:** tokens with more `}` than `{`. **Out:** the same with a `{` after each keyword that lacks it, and
//! `object {` before each name. **Invariant:** a `{` is added only where a `}` without a partner follows in
//! the same statement.

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};
use crate::syntax::layout::Layout;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::{Family, Role, Word};

/// Adds each missing `{`, and reports it.
pub(super) fn open_missing(
    tokens: Vec<Token>,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Vec<Token> {
    let mut lacking = lacking(&tokens);
    if lacking.is_empty() {
        return tokens;
    }
    lacking.sort_unstable();
    let mut opened = Vec::with_capacity(tokens.len() + lacking.len());
    let mut next = lacking.into_iter().peekable();
    for (at, token) in tokens.into_iter().enumerate() {
        opened.push(token);
        let TokenKind::Word(word) = token.kind else { continue };
        if next.next_if_eq(&at).is_some() {
            let span = Span::new(file, token.start as usize, token.end as usize);
            let name = word.name();
            diagnostics.push(
                Diagnostic::new(Code::MissingPart, format!("expected `{{` after `{name}`"))
                    .at(span, "its block is closed, and not opened")
                    .help(word.sentence())
                    .fix(span.after(), " {"),
            );
            let kind = TokenKind::Mark(Mark::Open(Bracket::Brace));
            opened.push(Token { kind, start: token.end, end: token.end });
        }
    }
    opened
}

/// Adds `object {` before declared names whose `}` exists: `Engine translate x }`, a line of its own at the
/// top level or among objects.
pub(super) fn open_objects(
    tokens: Vec<Token>,
    text: &str,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Vec<Token> {
    let surplus = super::surplus(&tokens)[Bracket::Brace as usize];
    let lone = lone_objects(&tokens, &Layout::of(&tokens, text), surplus.unsigned_abs() as usize);
    if lone.is_empty() {
        return tokens;
    }
    let mut opened = Vec::with_capacity(tokens.len() + 2 * lone.len());
    let mut next = lone.into_iter().peekable();
    for (at, token) in tokens.into_iter().enumerate() {
        if next.next_if_eq(&at).is_some() {
            let span = Span::new(file, token.start as usize, token.end as usize);
            let name = text.get(span.range()).unwrap_or("");
            diagnostics.push(
                Diagnostic::new(Code::MissingPart, format!("expected `object {{` before `{name}`"))
                    .at(span, "its block is closed, and not opened")
                    .help(Word::Object.sentence())
                    .fix(Span { end: span.start, ..span }, "object { "),
            );
            for kind in [TokenKind::Word(Word::Object), TokenKind::Mark(Mark::Open(Bracket::Brace))]
            {
                opened.push(Token { kind, start: token.start, end: token.start });
            }
        }
        opened.push(token);
    }
    opened
}

/// Returns up to `most` names that lack an `object {` before them.
fn lone_objects(tokens: &[Token], layout: &Layout, most: usize) -> Vec<usize> {
    let open = TokenKind::Mark(Mark::Open(Bracket::Brace));
    let close = TokenKind::Mark(Mark::Close(Bracket::Brace));
    let (mut around, mut lone) = (Vec::new(), Vec::new());
    for (at, token) in tokens.iter().enumerate() {
        let before = at.checked_sub(1).map(|before| tokens[before].kind);
        match token.kind {
            kind if kind == open => around.push(before),
            kind if kind == close => drop(around.pop()),
            TokenKind::Name if lone.len() < most && layout.place(at).first => {
                let among_objects = match around.last() {
                    None => true,
                    Some(Some(TokenKind::Word(word))) => word.family() == Family::Csg,
                    Some(_) => false,
                };
                let changed = tokens.get(at + 1).is_some_and(|next| {
                    matches!(next.kind, TokenKind::Word(word) if word.role() == Role::Statement)
                });
                // Its line closes one more than it opens, at its end.
                let mut line = (at + 1..tokens.len()).take_while(|&next| !layout.place(next).first);
                let mut depth = 0_i32;
                let end = line.find(|&next| {
                    depth += i32::from(tokens[next].kind == open)
                        - i32::from(tokens[next].kind == close);
                    depth < 0
                });
                if among_objects && changed && end.is_some_and(|end| layout.place(end + 1).first) {
                    lone.push(at);
                    around.push(Some(TokenKind::Word(Word::Object)));
                }
            }
            _ => {}
        }
    }
    lone
}

/// Returns the keywords that lack a `{` after them.
fn lacking(tokens: &[Token]) -> Vec<usize> {
    let (mut depth, mut waiting, mut found) = (0_usize, Vec::new(), Vec::new());
    for (at, token) in tokens.iter().enumerate() {
        match token.kind {
            TokenKind::Mark(Mark::Open(Bracket::Brace)) => depth += 1,
            TokenKind::Mark(Mark::Close(Bracket::Brace)) if depth > 0 => depth -= 1,
            TokenKind::Mark(Mark::Close(Bracket::Brace)) => found.extend(waiting.pop()),
            TokenKind::Directive(_) if depth == 0 => waiting.clear(),
            TokenKind::Word(word) if wants_a_block(word) => {
                // A statement of its own, unless it is in one that was not opened.
                let inside =
                    waiting.last().is_some_and(|&outer: &usize| holds(tokens[outer], word));
                if depth == 0 && !inside {
                    waiting.clear();
                }
                if tokens.get(at + 1).is_some_and(|next| begins_contents(word, next.kind)) {
                    waiting.push(at);
                }
            }
            _ => {}
        }
    }
    found
}

/// Returns whether the block of `outer` may contain `inner`, which is then not a separate statement.
fn holds(outer: Token, inner: Word) -> bool {
    let TokenKind::Word(outer) = outer.kind else { return false };
    let is_object = |word: Word| matches!(word.family(), Family::Shape | Family::Csg);
    match inner {
        _ if outer.family() == Family::Csg => true,
        _ if is_object(inner) => outer == Word::LightSource,
        Word::Camera | Word::LightSource | Word::GlobalSettings | Word::SkySphere => false,
        _ => true,
    }
}

/// Returns whether a keyword always has a block, except in the cases of `begins_contents`.
fn wants_a_block(word: Word) -> bool {
    const OTHERS: [Word; 11] = [
        Word::Camera,
        Word::LightSource,
        Word::Pigment,
        Word::Texture,
        Word::Finish,
        Word::Interior,
        Word::Material,
        Word::GlobalSettings,
        Word::SkySphere,
        Word::Background,
        Word::ColorMap,
    ];
    word.role() == Role::Statement
        && (matches!(word.family(), Family::Shape | Family::Csg) || OTHERS.contains(&word))
}

/// Returns whether `next` begins the content of the block of `word`, and not another construct in which
/// `word` has no block: `cylinder` of a light, `material` of a picture.
fn begins_contents(word: Word, next: TokenKind) -> bool {
    match next {
        TokenKind::Number | TokenKind::Numbers | TokenKind::Vectors => true,
        TokenKind::Mark(Mark::Less | Mark::Minus) => true,
        TokenKind::Mark(Mark::Open(Bracket::Square)) => word == Word::ColorMap,
        TokenKind::Word(next) => {
            next.role() == Role::Statement && !matches!(word, Word::Cylinder | Word::Object)
        }
        _ => false,
    }
}
