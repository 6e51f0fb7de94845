//! Macros whose brackets pair only once their `#if`s are decided.
//!
//! Three standard includes write `#if(a) merge { #else union { #end … }` inside a macro. Such a body is
//! kept as text, to be nested after expansion.
//! **Invariant:** a body is kept as text only if it does not pair as written, but does when every `#if`
//! takes its first branch, or every one its `#else`: so a forgotten brace is still told.

use super::balance::{Opener, Turn, pairs, turn};
use super::token::{Bracket, Head, Mark, Token, TokenKind};

/// Replaces the bodies of such macros by [`TokenKind::Raw`].
pub(super) fn keep_raw(tokens: Vec<Token>, text: &str) -> Vec<Token> {
    let mut kept = Vec::with_capacity(tokens.len());
    let ends = macro_ends(&tokens);
    let mut at = 0;
    let mut next_end = 0;
    while at < tokens.len() {
        kept.push(tokens[at]);
        at += 1;
        if tokens[at - 1].kind != TokenKind::Directive(Head::Macro) {
            continue;
        }
        while ends.get(next_end).is_some_and(|&(start, _)| start < at - 1) {
            next_end += 1;
        }
        let Some(&(start, end)) = ends.get(next_end) else { continue };
        let Some(body) = body_start(&tokens, start) else { continue };
        if start != at - 1 || body > end {
            continue;
        }
        let inside = &tokens[body..end];
        if pairs(inside) || !pairs_on_some_path(inside) {
            continue;
        }
        kept.extend_from_slice(&tokens[at..body]);
        let from = tokens[body - 1].end;
        let to = tokens[end].start.min(text.len() as u32);
        kept.push(Token { kind: TokenKind::Raw, start: from, end: to });
        at = end;
    }
    kept
}

/// The `#macro` and `#end` of each macro, by its start.
fn macro_ends(tokens: &[Token]) -> Vec<(usize, usize)> {
    let mut open = Vec::new();
    let mut ends = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        match turn(token.kind) {
            Some(Turn::Open(Opener::Directive)) => open.push(at),
            Some(Turn::Close(Opener::Directive)) => {
                if let Some(start) = open.pop()
                    && tokens[start].kind == TokenKind::Directive(Head::Macro)
                {
                    ends.push((start, at));
                }
            }
            Some(_) | None => {}
        }
    }
    ends.sort_unstable();
    ends
}

/// The first token after the head `#macro Name(a, b)` that starts at `start`.
fn body_start(tokens: &[Token], start: usize) -> Option<usize> {
    let parameters = start + 2;
    if tokens.get(parameters)?.kind != TokenKind::Mark(Mark::Open(Bracket::Round)) {
        return None;
    }
    let close = TokenKind::Mark(Mark::Close(Bracket::Round));
    Some(parameters + tokens[parameters..].iter().position(|token| token.kind == close)? + 1)
}

/// One way through the directives, and how many brackets of each kind it leaves open.
#[derive(Default, Clone, Copy)]
struct Path {
    open: [i32; 3],
}

impl Path {
    fn pairs(self) -> bool {
        self.open == [0; 3]
    }
}

fn pairs_on_some_path(tokens: &[Token]) -> bool {
    let (mut first, mut otherwise, mut all) = (Path::default(), Path::default(), Path::default());
    // For each open directive: whether the two ways run through its present branch.
    let mut branches: Vec<(bool, bool, Head)> = Vec::new();
    for token in tokens {
        let (in_first, in_otherwise) =
            branches.iter().fold((true, true), |(a, b), branch| (a && branch.0, b && branch.1));
        let step = match (turn(token.kind), token.kind) {
            (Some(Turn::Open(Opener::Bracket(bracket))), _) => Some((bracket, 1)),
            (Some(Turn::Close(Opener::Bracket(bracket))), _) => Some((bracket, -1)),
            (Some(Turn::Open(Opener::Directive)), TokenKind::Directive(head)) => {
                // Loops turn once or not at all; an inner macro is not run here.
                branches.push((head != Head::Macro, false, head));
                None
            }
            (Some(Turn::Divide), TokenKind::Directive(head)) => {
                if let Some(branch) = branches.last_mut() {
                    // The first `#case` of a `#switch` is its first branch.
                    let begins = branch.2 == Head::Switch && head != Head::Else;
                    *branch = (begins, head == Head::Else, head);
                }
                None
            }
            (Some(Turn::Close(Opener::Directive)), _) => {
                branches.pop();
                None
            }
            _ => None,
        };
        let Some((bracket, change)) = step else { continue };
        let index = bracket as usize;
        all.open[index] += change;
        if in_first {
            first.open[index] += change;
        }
        if in_otherwise {
            otherwise.open[index] += change;
        }
    }
    first.pairs() || otherwise.pairs() || all.pairs()
}
