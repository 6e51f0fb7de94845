//! Leaves bodies of directives that cannot be parsed as text until they are run, in a `.pov`.
//!
//! **In:** a text with errors, and their positions. **Out:** the bodies around them, of macros, branches,
//! loops and cases. **Invariant:** without these bodies the text has no error; POV-Ray 3.7 skips word by word
//! what it does not run (measured), so an error inside counts only if it is run.

use std::ops::Range;

use super::ParseOptions;
use super::balance::{Opener, Turn, turn};
use super::blank::blanked;
use super::comment::Quiet;
use super::loose::body_start;
use super::token::{Bracket, Head, Mark, Token, TokenKind, tokens};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::vocabulary::Dialect;

/// The most times that a text is parsed to find errors after those found before.
const MOST_READINGS: usize = 16;

/// Returns whether bodies with errors are left as text: only in a `.pov`.
pub(super) fn is_asked_for(options: &ParseOptions) -> bool {
    options.defers && options.dialect == Dialect::Pov
}

/// Returns the bodies to leave out so that `read` finds no error in the rest; `None` if some error is in no
/// body. `first` are the errors of the whole text.
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
        // An error outside all bodies may follow from those inside: `#esle` makes an `#else` after it
        // surplus.
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

/// Returns whether an error affects everything after it, so that a body there is not one.
fn swallows(mistake: &Diagnostic) -> bool {
    matches!(mistake.code, Code::UnclosedString | Code::UnclosedComment | Code::NestingLimit)
}

/// Returns the smallest body around an error that is not left out already.
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

/// Replaces the bodies that are left out by blanks.
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
    if unread.is_empty() {
        return;
    }
    tokens.extend(unread.iter().map(|body| Token {
        kind: TokenKind::Unread,
        start: body.start as u32,
        end: body.end as u32,
    }));
    // Two sorted runs: merged in linear time.
    tokens.sort_by_key(|token| token.start);
}

/// Returns the bodies of all directives, without the blanks around them.
fn bodies(tokens: &[Token], text: &str) -> Vec<Range<usize>> {
    // The start of each body, and the last keyword of its directive: a second `#else` is skipped with the
    // first.
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

/// Returns whether `head` begins another body of the directive whose current body began with `last`.
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

/// Returns the first token after the head of a directive, including its condition in parentheses.
fn behind_head(tokens: &[Token], at: usize, head: Head) -> Option<usize> {
    match head {
        Head::Else => Some(at + 1),
        Head::Macro => body_start(tokens, at),
        // Nothing is run before its first case.
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
