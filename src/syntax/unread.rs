//! Bodies of directives that cannot be read: in a `.pov` each stays text until it is run.
//!
//! **In:** a text that has mistakes, and where they are. **Out:** the bodies around them, of macros, branches,
//! loops and cases. **Invariant:** with these left out the rest of the text has no mistake; POV-Ray 3.7 passes
//! over what it does not run word by word (measured), so a mistake in there is one only where it is run.

use std::ops::Range;

use super::ParseOptions;
use super::balance::{Opener, Turn, turn};
use super::blank::blanked;
use super::comment::Quiet;
use super::loose::body_start;
use super::token::{Bracket, Head, Mark, Token, TokenKind, tokens};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::vocabulary::Dialect;

/// How often a text is read for the mistakes behind those that were found before.
const MOST_READINGS: usize = 16;

/// Whether mistakes in what is never run are looked for at all.
pub(super) fn is_asked_for(options: &ParseOptions) -> bool {
    options.defers && options.dialect == Dialect::Pov
}

/// The bodies to leave unread so that `read` finds no mistake in the rest; `None` where some mistake stands in
/// none. `first` is what it finds in the whole.
pub(super) fn bodies_around_mistakes(
    quiet_text: &str,
    first: &Diagnostics,
    mut read: impl FnMut(&[Range<usize>]) -> Diagnostics,
) -> Option<Vec<Range<usize>>> {
    let bodies = bodies(&tokens(quiet_text), quiet_text);
    let mut unread: Vec<Range<usize>> = Vec::new();
    let mut found = first.clone();
    for _ in 0..MOST_READINGS {
        let mistakes: Vec<&Diagnostic> = found.iter().filter(|one| one.is_error()).collect();
        if mistakes.is_empty() {
            return Some(unread);
        }
        if mistakes.iter().any(|mistake| swallows(mistake)) {
            return None;
        }
        // One outside of all may come of those inside: `#esle` makes an `#else` behind it one too many.
        let around = |mistake: &&Diagnostic| innermost_around(mistake, &bodies, &unread);
        let more: Vec<Range<usize>> = mistakes.iter().filter_map(around).collect();
        if more.is_empty() {
            return None;
        }
        for body in more {
            if unread.iter().any(|known| known.start <= body.start && body.end <= known.end) {
                continue;
            }
            unread.retain(|known| !(body.start <= known.start && known.end <= body.end));
            unread.push(body);
        }
        unread.sort_unstable_by_key(|body| body.start);
        found = read(&unread);
    }
    None
}

/// Whether a mistake takes in what stands behind it, so that a body there is none.
fn swallows(mistake: &Diagnostic) -> bool {
    matches!(mistake.code, Code::UnclosedString | Code::UnclosedComment | Code::NestingLimit)
}

/// The smallest body around a mistake that is not left out already.
fn innermost_around(
    mistake: &Diagnostic,
    bodies: &[Range<usize>],
    unread: &[Range<usize>],
) -> Option<Range<usize>> {
    let place = mistake.primary()?.span.range();
    let holds = |body: &&Range<usize>| {
        body.start <= place.start && place.end <= body.end && !unread.contains(body)
    };
    bodies.iter().filter(holds).min_by_key(|body| body.len()).cloned()
}

/// Puts blanks in the place of what is not read.
pub(super) fn leave_out(quiet: &mut Quiet, unread: &[Range<usize>]) {
    let inside = |at: usize| {
        let before = unread.partition_point(|body| body.start <= at);
        unread[..before].last().is_some_and(|body| at < body.end)
    };
    quiet.comments.retain(|comment| !inside(comment.start as usize));
    quiet.text = blanked(std::mem::take(&mut quiet.text), unread.to_vec());
}

/// Adds a token for each body that was left out.
pub(super) fn stand_in(tokens: &mut Vec<Token>, unread: &[Range<usize>]) {
    tokens.extend(unread.iter().map(|body| Token {
        kind: TokenKind::Unread,
        start: body.start as u32,
        end: body.end as u32,
    }));
    // Two sorted runs: merged in linear time.
    tokens.sort_by_key(|token| token.start);
}

/// The bodies of all directives, without the blanks around them.
fn bodies(tokens: &[Token], text: &str) -> Vec<Range<usize>> {
    // Where each body begins, and what its directive was last: a second `#else` is passed over with the first.
    let (mut open, mut bodies): (Vec<(Option<usize>, Head)>, _) = (Vec::new(), Vec::new());
    let mut close = |begun: Option<usize>, end: usize| {
        let Some(first) = begun.filter(|first| *first < end) else { return };
        bodies.push(tokens[first].start as usize..tokens[end - 1].end as usize);
    };
    for (at, token) in tokens.iter().enumerate() {
        match (turn(token.kind), token.kind) {
            (Some(Turn::Open(Opener::Directive)), TokenKind::Directive(head)) => {
                open.push((behind_head(tokens, at, head), head));
            }
            (Some(Turn::Divide), TokenKind::Directive(head)) => {
                if let Some((begun, last)) =
                    open.last_mut().filter(|(_, last)| divides(*last, head))
                {
                    close(begun.take(), at);
                    (*begun, *last) = (behind_head(tokens, at, head), head);
                }
            }
            (Some(Turn::Close(Opener::Directive)), _) => {
                if let Some((begun, _)) = open.pop() {
                    close(begun, at);
                }
            }
            _ => {}
        }
    }
    debug_assert!(bodies.iter().all(|body| body.end <= text.len()));
    bodies
}

/// Whether `head` begins another body of the directive whose present body `last` began.
fn divides(last: Head, head: Head) -> bool {
    match last {
        Head::If | Head::Ifdef | Head::Ifndef | Head::Elseif => {
            matches!(head, Head::Else | Head::Elseif)
        }
        Head::Switch | Head::Case | Head::Range => {
            matches!(head, Head::Case | Head::Range | Head::Else)
        }
        _ => false,
    }
}

/// The first token behind the head of a directive, with what it asks in parentheses.
fn behind_head(tokens: &[Token], at: usize, head: Head) -> Option<usize> {
    match head {
        Head::Else => Some(at + 1),
        Head::Macro => body_start(tokens, at),
        // Up to its first case nothing is run.
        Head::Switch => None,
        _ => {
            let mut depth = 0_usize;
            for (place, token) in tokens.iter().enumerate().skip(at + 1) {
                match token.kind {
                    TokenKind::Mark(Mark::Open(Bracket::Round)) => depth += 1,
                    TokenKind::Mark(Mark::Close(Bracket::Round)) => {
                        depth = depth.checked_sub(1)?;
                        if depth == 0 {
                            return Some(place + 1);
                        }
                    }
                    TokenKind::Directive(_) => return None,
                    _ if depth == 0 => return None,
                    _ => {}
                }
            }
            None
        }
    }
}
