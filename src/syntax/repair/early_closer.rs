//! Removes braces that close an object too early: `torus { 2, 1 pigment { rgb 1 } } finish { phong 1 } }`.
//!
//! **In:** tokens with more `}` than `{`. **Out:** the same without a `}` before each keyword that is only
//! valid in an object. **Invariant:** none is removed unless another `}` has no partner.

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::source::{FileId, Span};
use crate::syntax::layout::Layout;
use crate::syntax::token::{Bracket, Mark, Token, TokenKind};
use crate::vocabulary::{Family, Role, Word};

/// The most tokens of objects after a brace that are searched.
const LONGEST: usize = 400;

/// Removes braces that close too early, and reports them.
pub(super) fn close_later(
    tokens: Vec<Token>,
    text: &str,
    file: FileId,
    diagnostics: &mut Diagnostics,
) -> Vec<Token> {
    let open = TokenKind::Mark(Mark::Open(Bracket::Brace));
    let close = TokenKind::Mark(Mark::Close(Bracket::Brace));
    let mut surplus = super::surplus(&tokens)[Bracket::Brace as usize].unsigned_abs();
    let mut kept = Vec::with_capacity(tokens.len());
    let layout = Layout::of(&tokens, text);
    // For each open block, the word before it, if it is an object's, and its line.
    let mut around: Vec<(Option<Token>, usize)> = Vec::new();
    let mut line = 0;
    for (at, token) in tokens.iter().enumerate() {
        let first = layout.place(at).first;
        line += usize::from(first);
        if token.kind == open {
            let before = at.checked_sub(1).map(|before| tokens[before]);
            around.push((before.filter(|before| is_object(before.kind)), line));
        }
        if token.kind == close
            && let Some(&(block, begun)) = around.last()
        {
            // The brace of a block of several lines begins a line of its own.
            let looks_early = !layout.place(at + 1).first || (!first && begun < line);
            let inside = block.map_or(0, |block| {
                let opener = tokens[..at].partition_point(|token| token.start < block.start);
                layout.place(opener).indent
            });
            let next = behind_objects(&tokens, &layout, at + 1, inside).map(|next| tokens[next]);
            let next = next.filter(|next| looks_early && only_in_object(next.kind));
            if let ([_], Some(opener), Some(next), 1..) = (&around[..], block, next, surplus) {
                surplus -= 1;
                let span = |token: Token| Span::new(file, token.start as usize, token.end as usize);
                diagnostics.push(
                    Diagnostic::new(Code::StrayCloser, "this `}` closes the object too early")
                        .at(span(*token), "what follows belongs to it")
                        .also(span(opener), "it is opened here")
                        .also(span(next), "this stands only in an object")
                        .help("remove `}`")
                        .fix(span(*token), ""),
                );
                continue;
            }
            around.pop();
        }
        kept.push(*token);
    }
    kept
}

/// Returns the token after the objects that begin at `at`, as far as they are on lines indented by more than
/// `indent`: they probably belong to the block before them.
fn behind_objects(tokens: &[Token], layout: &Layout, at: usize, indent: u32) -> Option<usize> {
    let mark = |bracket: fn(Bracket) -> Mark| TokenKind::Mark(bracket(Bracket::Brace));
    let mut depth = 0_usize;
    for (next, token) in (at..).zip(tokens.get(at..)?.iter().take(LONGEST)) {
        let place = layout.place(next);
        match token.kind {
            kind if kind == mark(Mark::Open) && next > at => depth += 1,
            kind if kind == mark(Mark::Close) => depth = depth.checked_sub(1)?,
            _ if depth > 0 => {}
            kind if is_object(kind) && place.first && place.indent > indent => {}
            _ => return Some(next),
        }
    }
    None
}

fn is_object(kind: TokenKind) -> bool {
    let TokenKind::Word(word) = kind else { return false };
    matches!(word.family(), Family::Shape | Family::Csg) || word == Word::Object
}

fn only_in_object(kind: TokenKind) -> bool {
    let TokenKind::Word(word) = kind else { return false };
    word.role() == Role::Statement
        && (matches!(word.family(), Family::Transform | Family::Modifier)
            || matches!(word, Word::Pigment | Word::Texture | Word::Finish | Word::Interior))
}
